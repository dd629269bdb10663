//! The kinds of checks as data: the promise, and the void or figure it is about.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::FigureName;

/// The kind of a check, unique in the list of a kit.
///
/// In JSON it is the key `kind`, in kebab case; the void or figure has a key of its own. These keys
/// are stable, so programs may match on them. [`fmt::Display`] writes the English name, which may
/// change.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum CheckKind {
    /// Distance of the centre of mass from the spin axis, or from a yo-yo's spin point.
    AxisOffset,
    /// Angle between the spin axis and the nearest principal axis.
    AxisTilt,
    /// Ratio I_b/I_c, which makes the spin axis the stable one.
    Dominance,
    /// Distance of the contact of a top from its lowest point.
    Contact,
    /// Lean at which more than the tip or the foot of a top touches the floor.
    Lean,
    /// Tilt at which a standing object topples.
    Standing,
    /// Distance of a floating object's waterline from the predicted one.
    Waterline,
    /// Distance of a floating object's centre of mass from the vertical through its centre of
    /// buoyancy.
    Upright,
    /// Metacentric height of a floating object.
    Stability,
    /// Heel from which a floating object rights itself.
    Righting,
    /// Balance quality grade of a rotor.
    BalanceQuality,
    /// Deviation of a match from the wanted mass.
    MatchMass,
    /// Distance of the centre of mass of a match from the wanted one.
    MatchCenter,
    /// Deviation of a match from the wanted inertia.
    MatchInertia,
    /// The figure promised to the buyer.
    PromisedFigure {
        /// The figure.
        figure: FigureName,
    },
    /// Share by which a hollowing may beat the certificate.
    Bound,
    /// Smallest wall between a void and the outside.
    Wall,
    /// Features of the model that are thinner than the printer's least wall.
    ThinFeatures,
    /// Pieces of the model that hang by necks as thin.
    ThinNecks,
    /// Room around the hardware in its sockets.
    Hardware,
    /// Gap between the halves of a yo-yo.
    StringGap,
    /// Length over which each half of a yo-yo holds the axle.
    Grip,
    /// Gap around the ballast.
    BallastRoom,
    /// Files that do not bound a solid.
    BrokenSurfaces,
    /// Pairs of triangles that pierce each other.
    SelfIntersections,
    /// Cavities that no cut opens.
    ClosedCavities,
    /// What a slicer is said to lay beyond the written print, over the most that slicers lay.
    LaidBeyond,
    /// Files that hold more than one body, or none.
    OneBody,
    /// Triangles of the parts that are not where they should be.
    PartSurfaces,
    /// Height of the parts over the plate.
    Resting,
    /// Deviation of the poses from rigid motions.
    Pose,
    /// Room left for the parts in the printer.
    BuildVolume,
    /// Parts that enclose resin while they are printed.
    Cups,
    /// Openings of a void.
    VoidOpen {
        /// The void's id, such as `V1`.
        void: String,
    },
    /// Share of a void's wall that can be cleaned.
    VoidClean {
        /// The void's id, such as `V1`.
        void: String,
    },
    /// Free diameters of the drain holes.
    DrainHoles,
    /// Gaps of the plugs in their drain holes.
    Plugs,
    /// Thickness of the walls between the cells of a piece.
    CellWalls,
    /// Free diameters of the openings by which cells drain.
    CellOpenings,
    /// Agreement of the voids with what the checklist states of them.
    VoidsAsStated,
    /// Sum of the parts' volumes against the uncut body.
    Volumes,
    /// Sizes of the pins and sockets.
    Pins,
    /// Gaps between the pins and their sockets.
    Clearance,
    /// Walls around the sockets.
    SocketWall,
    /// Steps at the rims of the joints, as far as their pins let the parts move.
    JointStep,
    /// Parts that reach into each other.
    Overlap,
    /// Jigs that do not come off.
    JigWay,
    /// Gaps between the jigs and the object.
    JigGap,
    /// Room that the jigs leave along the seams.
    JigSeam,
    /// Films of glue against the faces they join.
    Glue,
    /// Strokes of the engraved ids.
    EngravedIds,
    /// Agreement of `checklist.json` with the files.
    Checklist,
    /// Files that are not as they were made.
    ChangedFiles,
    /// Agreement of the 3MF files with the parts.
    Packages,
    /// Agreement of the papers with those that are printed again.
    Papers,
    /// Agreement of the files with those of a kit that is made again.
    Replay,
    /// Agreement of the outside with the model.
    Model,
    /// Parts whose toolpaths are missing.
    PrintedParts,
    /// Parts that are printed in another size, or mirrored.
    PrintedShapes,
    /// Settings of the slicer that are not those of the kit.
    PrintedSettings,
    /// Mass of the toolpaths of all parts.
    PrintedMass,
    /// Centre of mass of the toolpaths of all parts.
    PrintedCenters,
    /// Tubes of a telescope, round about their helices.
    ShellBodies,
    /// Clearance of sliding shells.
    Sliding,
    /// Poses of sliding shells: where they are stated, and free on the way.
    Poses,
    /// Tips of sliding shells in the places that were asked for.
    Reach,
    /// Stops of sliding shells.
    Stops,
    /// Twist stops of sliding shells.
    TwistStops,
    /// The way back out of a shell, which caps close.
    WayBack,
    /// Shells that touch while a telescope opens.
    Motion,
    /// Placements of shells at the keys of a motion.
    Placements,
    /// Agreement of `motion.glb` with the parts and their keys.
    MotionScene,
    /// Deviation of an open telescope from its curve.
    Deviation,
    /// Boxes of a telescope, all in and all out.
    Sizes,
    /// Mass of all parts.
    Mass,
    /// Centres of mass along a motion.
    Centres,
    /// Toppling angles along a motion.
    Toppling,
    /// Nothing reaches below the foot along a motion.
    Ground,
    /// The certificate that a base keeps its distance from the model's surface.
    Separation,
    /// Distance of a base from the model's surface at sampled points.
    BaseDistance,
    /// Volume of a base outside of the model.
    BaseInside,
    /// Panels that reach into each other.
    PanelOverlap,
    /// Panels that reach out of their base.
    PanelsInBase,
    /// Distance of two polyhedra of a base from the plane between them.
    Polyhedra,
    /// Drawings of sheets that are not those of the panels.
    Drawings,
    /// Paths of the beam beside the outlines of panels.
    BeamPaths,
    /// Distances of panels on a sheet.
    SheetSpacing,
    /// Distances of panels from the edges of a sheet.
    SheetMargin,
    /// Heads of screws in other things.
    ScrewHeads,
    /// Rods between polyhedra that do not hold them.
    Rods,
    /// Brackets outside of their base, or in a panel.
    Brackets,
    /// Units that overlap others on their way out.
    WayOut,
    /// Units whose way out is barred.
    WaysFree,
    /// Parts without a path to the base.
    Held,
    /// Sheets that are none of the stock, or larger than the cutter's bed.
    Stock,
    /// Panels that lie across the grain of their sheet.
    Grain,
}

impl CheckKind {
    /// Returns the id of the void this check is about, or `None` if it is about no single void.
    pub fn void(&self) -> Option<&str> {
        match self {
            Self::VoidOpen { void } | Self::VoidClean { void } => Some(void),
            _ => None,
        }
    }

    /// Returns the English name of a check that only toolpaths, telescopes and bases have.
    fn name_elsewhere(&self) -> &'static str {
        match self {
            Self::PrintedParts => "printed parts",
            Self::PrintedShapes => "printed shapes",
            Self::PrintedSettings => "slicer settings",
            Self::PrintedMass => "printed mass",
            Self::PrintedCenters => "printed centres",
            Self::ShellBodies => "shell bodies",
            Self::Sliding => "sliding",
            Self::Poses => "poses",
            Self::Reach => "reach",
            Self::Stops => "stops",
            Self::TwistStops => "twist stops",
            Self::WayBack => "way back",
            Self::Motion => "motion",
            Self::Placements => "placements",
            Self::MotionScene => "motion.glb",
            Self::Deviation => "deviation",
            Self::Sizes => "sizes",
            Self::Mass => "mass",
            Self::Centres => "centres",
            Self::Toppling => "toppling",
            Self::Ground => "ground",
            Self::Separation => "separation",
            Self::BaseDistance => "base distance",
            Self::BaseInside => "base inside",
            Self::PanelOverlap => "panel overlap",
            Self::PanelsInBase => "panels in base",
            Self::Polyhedra => "polyhedra",
            Self::Drawings => "drawings",
            Self::BeamPaths => "beam paths",
            Self::SheetSpacing => "sheet spacing",
            Self::SheetMargin => "sheet margin",
            Self::ScrewHeads => "screw heads",
            Self::Rods => "rods",
            Self::Brackets => "brackets",
            Self::WayOut => "way out",
            Self::WaysFree => "free ways",
            Self::Held => "held parts",
            Self::Stock => "stock",
            Self::Grain => "grain",
            _ => "check",
        }
    }
}

impl fmt::Display for CheckKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::AxisOffset => "axis offset",
            Self::AxisTilt => "axis tilt",
            Self::Dominance => "dominance",
            Self::Contact => "contact",
            Self::Lean => "lean",
            Self::Standing => "standing",
            Self::Waterline => "waterline",
            Self::Upright => "upright",
            Self::Stability => "stability",
            Self::Righting => "righting",
            Self::BalanceQuality => "balance quality",
            Self::MatchMass => "mass of the match",
            Self::MatchCenter => "centre of the match",
            Self::MatchInertia => "inertia of the match",
            Self::PromisedFigure { figure } => figure.name(),
            Self::Bound => "bound",
            Self::Wall => "wall",
            Self::ThinFeatures => "thin features",
            Self::ThinNecks => "thin necks",
            Self::Hardware => "hardware",
            Self::StringGap => "string gap",
            Self::Grip => "grip",
            Self::BallastRoom => "ballast room",
            Self::BrokenSurfaces => "broken surfaces",
            Self::SelfIntersections => "self-intersections",
            Self::ClosedCavities => "closed cavities",
            Self::LaidBeyond => "laid beyond",
            Self::OneBody => "one body",
            Self::PartSurfaces => "part surfaces",
            Self::Resting => "resting",
            Self::Pose => "pose",
            Self::BuildVolume => "build volume",
            Self::Cups => "cups",
            Self::VoidOpen { void } => return write!(f, "void {void} open"),
            Self::VoidClean { void } => return write!(f, "void {void} clean"),
            Self::DrainHoles => "drain holes",
            Self::Plugs => "plugs",
            Self::CellWalls => "walls of cells",
            Self::CellOpenings => "openings of cells",
            Self::VoidsAsStated => "voids as stated",
            Self::Volumes => "volumes",
            Self::Pins => "pins",
            Self::Clearance => "clearance",
            Self::SocketWall => "socket wall",
            Self::JointStep => "joint step",
            Self::Overlap => "overlap",
            Self::JigWay => "jig off",
            Self::JigGap => "jig gap",
            Self::JigSeam => "jig at seam",
            Self::Glue => "glue",
            Self::EngravedIds => "ids",
            Self::Checklist => "checklist",
            Self::ChangedFiles => "changed files",
            Self::Packages => "3MF files",
            Self::Papers => "papers",
            Self::Replay => "replay",
            Self::Model => "model",
            _ => self.name_elsewhere(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// The keys and names of all kinds without data.
    const KEYS: [(CheckKind, &str, &str); 92] = [
        (CheckKind::CellWalls, "cell-walls", "walls of cells"),
        (
            CheckKind::CellOpenings,
            "cell-openings",
            "openings of cells",
        ),
        (CheckKind::Held, "held", "held parts"),
        (CheckKind::Stock, "stock", "stock"),
        (CheckKind::Grain, "grain", "grain"),
        (CheckKind::Plugs, "plugs", "plugs"),
        (CheckKind::DrainHoles, "drain-holes", "drain holes"),
        (CheckKind::MatchMass, "match-mass", "mass of the match"),
        (
            CheckKind::MatchCenter,
            "match-center",
            "centre of the match",
        ),
        (
            CheckKind::MatchInertia,
            "match-inertia",
            "inertia of the match",
        ),
        (CheckKind::Papers, "papers", "papers"),
        (CheckKind::Replay, "replay", "replay"),
        (CheckKind::AxisOffset, "axis-offset", "axis offset"),
        (CheckKind::AxisTilt, "axis-tilt", "axis tilt"),
        (CheckKind::Dominance, "dominance", "dominance"),
        (CheckKind::Contact, "contact", "contact"),
        (CheckKind::Lean, "lean", "lean"),
        (CheckKind::Standing, "standing", "standing"),
        (CheckKind::Waterline, "waterline", "waterline"),
        (CheckKind::Upright, "upright", "upright"),
        (CheckKind::Stability, "stability", "stability"),
        (CheckKind::Righting, "righting", "righting"),
        (
            CheckKind::BalanceQuality,
            "balance-quality",
            "balance quality",
        ),
        (CheckKind::Wall, "wall", "wall"),
        (CheckKind::ThinFeatures, "thin-features", "thin features"),
        (CheckKind::ThinNecks, "thin-necks", "thin necks"),
        (CheckKind::Hardware, "hardware", "hardware"),
        (CheckKind::StringGap, "string-gap", "string gap"),
        (CheckKind::Grip, "grip", "grip"),
        (CheckKind::BallastRoom, "ballast-room", "ballast room"),
        (
            CheckKind::BrokenSurfaces,
            "broken-surfaces",
            "broken surfaces",
        ),
        (
            CheckKind::SelfIntersections,
            "self-intersections",
            "self-intersections",
        ),
        (
            CheckKind::ClosedCavities,
            "closed-cavities",
            "closed cavities",
        ),
        (CheckKind::LaidBeyond, "laid-beyond", "laid beyond"),
        (CheckKind::OneBody, "one-body", "one body"),
        (CheckKind::PartSurfaces, "part-surfaces", "part surfaces"),
        (CheckKind::Resting, "resting", "resting"),
        (CheckKind::Pose, "pose", "pose"),
        (CheckKind::BuildVolume, "build-volume", "build volume"),
        (CheckKind::Cups, "cups", "cups"),
        (
            CheckKind::VoidsAsStated,
            "voids-as-stated",
            "voids as stated",
        ),
        (CheckKind::Volumes, "volumes", "volumes"),
        (CheckKind::Pins, "pins", "pins"),
        (CheckKind::Clearance, "clearance", "clearance"),
        (CheckKind::SocketWall, "socket-wall", "socket wall"),
        (CheckKind::JointStep, "joint-step", "joint step"),
        (CheckKind::Overlap, "overlap", "overlap"),
        (CheckKind::JigWay, "jig-way", "jig off"),
        (CheckKind::JigGap, "jig-gap", "jig gap"),
        (CheckKind::JigSeam, "jig-seam", "jig at seam"),
        (CheckKind::Glue, "glue", "glue"),
        (CheckKind::EngravedIds, "engraved-ids", "ids"),
        (CheckKind::Checklist, "checklist", "checklist"),
        (CheckKind::ChangedFiles, "changed-files", "changed files"),
        (CheckKind::Packages, "packages", "3MF files"),
        (CheckKind::Model, "model", "model"),
        (CheckKind::PrintedParts, "printed-parts", "printed parts"),
        (CheckKind::PrintedShapes, "printed-shapes", "printed shapes"),
        (
            CheckKind::PrintedSettings,
            "printed-settings",
            "slicer settings",
        ),
        (CheckKind::PrintedMass, "printed-mass", "printed mass"),
        (
            CheckKind::PrintedCenters,
            "printed-centers",
            "printed centres",
        ),
        (CheckKind::ShellBodies, "shell-bodies", "shell bodies"),
        (CheckKind::Sliding, "sliding", "sliding"),
        (CheckKind::Poses, "poses", "poses"),
        (CheckKind::Reach, "reach", "reach"),
        (CheckKind::Stops, "stops", "stops"),
        (CheckKind::TwistStops, "twist-stops", "twist stops"),
        (CheckKind::WayBack, "way-back", "way back"),
        (CheckKind::Motion, "motion", "motion"),
        (CheckKind::Placements, "placements", "placements"),
        (CheckKind::MotionScene, "motion-scene", "motion.glb"),
        (CheckKind::Deviation, "deviation", "deviation"),
        (CheckKind::Sizes, "sizes", "sizes"),
        (CheckKind::Mass, "mass", "mass"),
        (CheckKind::Centres, "centres", "centres"),
        (CheckKind::Toppling, "toppling", "toppling"),
        (CheckKind::Ground, "ground", "ground"),
        (CheckKind::Separation, "separation", "separation"),
        (CheckKind::BaseDistance, "base-distance", "base distance"),
        (CheckKind::BaseInside, "base-inside", "base inside"),
        (CheckKind::PanelOverlap, "panel-overlap", "panel overlap"),
        (CheckKind::PanelsInBase, "panels-in-base", "panels in base"),
        (CheckKind::Polyhedra, "polyhedra", "polyhedra"),
        (CheckKind::Drawings, "drawings", "drawings"),
        (CheckKind::BeamPaths, "beam-paths", "beam paths"),
        (CheckKind::SheetSpacing, "sheet-spacing", "sheet spacing"),
        (CheckKind::SheetMargin, "sheet-margin", "sheet margin"),
        (CheckKind::ScrewHeads, "screw-heads", "screw heads"),
        (CheckKind::Rods, "rods", "rods"),
        (CheckKind::Brackets, "brackets", "brackets"),
        (CheckKind::WayOut, "way-out", "way out"),
        (CheckKind::WaysFree, "ways-free", "free ways"),
    ];

    fn assert_reads_back(kind: &CheckKind, value: &serde_json::Value) {
        assert_eq!(json!(kind), *value);
        let back: CheckKind = serde_json::from_value(value.clone()).unwrap();
        assert_eq!(back, *kind);
    }

    #[test]
    fn the_keys_and_names_of_the_kinds_are_these() {
        for (kind, key, name) in KEYS {
            assert_reads_back(&kind, &json!({ "kind": key }));
            assert_eq!(kind.to_string(), name);
        }
    }

    #[test]
    fn a_kind_that_speaks_of_a_void_or_figure_writes_it_in_a_key_of_its_own() {
        let void = || "V2".to_owned();
        let open = CheckKind::VoidOpen { void: void() };
        let clean = CheckKind::VoidClean { void: void() };
        let figure = FigureName::CriticalSpeedRpm;
        let promised = CheckKind::PromisedFigure { figure };
        assert_reads_back(&open, &json!({ "kind": "void-open", "void": "V2" }));
        assert_reads_back(&clean, &json!({ "kind": "void-clean", "void": "V2" }));
        let row = json!({ "kind": "promised-figure", "figure": "critical_speed_rpm" });
        assert_reads_back(&promised, &row);
        let names = [&open, &clean, &promised].map(CheckKind::to_string);
        assert_eq!(names, ["void V2 open", "void V2 clean", "critical speed"]);
        let voids = [&open, &clean, &promised].map(CheckKind::void);
        assert_eq!(voids, [Some("V2"), Some("V2"), None]);
    }
}
