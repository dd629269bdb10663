//! The checklist of a network, filled from what was made, and judged from the written files.

use std::collections::BTreeMap;

use super::super::error::TelescopeRunError;
use super::super::files::curve_csv;
use super::super::judge::texts;
use super::super::made::Made;
use super::super::motion_file::{MOTION_SCHEMA, motion, pose_of};
use super::super::posed::Poses;
use super::super::posing::Posed;
use super::super::sheet::{checklist, foot_row, leaning, material, printer, untried};
use super::foot::StoodFoot;
use super::made::{Workshop, prefix};
use super::posing::joints;
use super::rows;
use super::tree::Tree;
use super::written::WrittenJuncture;
use crate::base::units::MM3_PER_CM3;
use crate::base::watch::Phase;
use crate::geom::{Aabb, Point, Vector};
use crate::io::{PointsError, stl};
use crate::mass::moments_of_mesh;
use crate::mesh::TriMesh;
use crate::printer::Support;
use crate::sheet::Verdict;
use crate::sheet::network::{LimbRow, NETWORK_SHEET_SCHEMA, NetworkSheet};
use crate::sheet::telescope::CurveRow;
use crate::telescope::motion::Key;
use crate::telescope::nest::JointState;
use crate::verify::{
    MODEL_FILE, NetworkEvidence, NetworkKey, NetworkMotion, NetworkPromise, TelescopeEvidence,
    asked_points, judge_network, network_checks,
};
use crate::wing::{Unwritable, json, read_back};

/// A network that was made.
pub struct MadeNetwork<'a> {
    pub tree: Tree<'a>,
    pub limbs: Vec<Made>,
    pub junctures: Vec<WrittenJuncture>,
    /// The limbs in the order in which they open, from 0.
    pub sequence: Vec<usize>,
    /// The limbs that stay solid, in words.
    pub solid: Vec<String>,
    /// The foot under the first juncture; `None` if it need not stand.
    pub foot: Option<StoodFoot>,
    /// The poses of the job.
    pub poses: Vec<Posed>,
}

/// A network that was judged.
pub struct NetworkDraft {
    pub sheet: NetworkSheet,
    pub motion_json: String,
    /// The curve of each limb, asked and made.
    pub curves: Vec<String>,
    /// The model in single precision, if junctures are pieces of it.
    pub model_stl: Option<Vec<u8>>,
}

impl MadeNetwork<'_> {
    /// Returns the states between moves.
    pub fn keys(&self) -> Vec<Vec<Key>> {
        self.tree.network.keys(&self.sequence)
    }

    /// Returns all parts where they are in a state, those of the limbs first.
    pub fn placed(&self, state: &[Key]) -> Vec<TriMesh> {
        let frames = self.tree.network.frames(state);
        let mut parts = Vec::new();
        for (made, frames) in self.limbs.iter().zip(&frames.shells) {
            let placed = made.parts.iter().map(|part| {
                let frame = &frames[part.shell];
                part.in_shell().map_vertices(|p| frame.to_model(p))
            });
            parts.extend(placed);
        }
        let junctures = self.junctures.iter().zip(&frames.junctures);
        let pieces = junctures.flat_map(|(own, frame)| {
            let pieces = own.parts.iter();
            pieces.map(|part| part.in_model().map_vertices(|p| frame.to_model(p)))
        });
        parts.extend(pieces);
        parts
    }

    /// Returns the poses as they are written. `joints` are the ids of every limb's joints.
    pub fn written_poses<'a>(&'a self, joints: &'a [Vec<String>]) -> Poses<'a> {
        Poses {
            network: &self.tree.network,
            joints,
            posed: &self.poses,
        }
    }

    fn motion(&self, up: &Vector) -> NetworkMotion {
        let limbs = &self.tree.network.limbs;
        let key = |state: &Vec<Key>| NetworkKey {
            states: state.iter().map(written).collect(),
            junctures: self
                .tree
                .network
                .frames(state)
                .junctures
                .iter()
                .map(pose_of)
                .collect(),
        };
        NetworkMotion {
            schema: MOTION_SCHEMA,
            up: (*up).into(),
            limbs: self.limbs.iter().map(motion).collect(),
            order: self
                .sequence
                .iter()
                .map(|limb| limbs[*limb].id.clone())
                .collect(),
            keys: self.keys().iter().map(key).collect(),
            poses: self.written_poses(&joints(&self.limbs)).motions(),
        }
    }
}

fn written(key: &Key) -> Vec<[f64; 2]> {
    let state = |state: &JointState| [state.slide_mm, state.turn_rad];
    key.iter().map(state).collect()
}

/// Fills the checklist and judges what is written, from the texts of its files.
pub fn draft(workshop: &Workshop, made: &MadeNetwork) -> Result<NetworkDraft, TelescopeRunError> {
    workshop.watch.enter(Phase::Verify);
    let mut curves = Vec::new();
    let (mut limbs, mut warnings) = (Vec::new(), Vec::new());
    let tree = &made.tree;
    for ((limb, designed), own) in tree.network.limbs.iter().zip(&tree.limbs).zip(&made.limbs) {
        let asked = designed.order.asked(workshop.shop, &prefix(&limb.id))?;
        curves.push(curve_csv(&asked, own));
        // What is true of the printer is told once, and the clearance is tried on the first limb.
        if warnings.is_empty() {
            warnings.extend(asked.warnings.iter().cloned().chain(untried(&asked, own)));
        }
        warnings.extend(leaning(&asked, own));
        limbs.push(LimbRow {
            id: limb.id.clone(),
            from: limb.from + 1,
            to: limb.to + 1,
            sheet: checklist(&asked, own),
        });
    }
    warnings.extend(round(workshop));
    for (index, own) in made.junctures.iter().enumerate() {
        warnings.extend(rows::warnings(workshop, own));
        warnings.extend(rows::peg_warning(workshop, tree, index, own));
    }
    let skin = workshop.form.skin();
    let model_stl = skin.map(|skin| stl::encode(skin.mesh(), &workshop.job.name()));
    let mut sheet = sheet(workshop, made, limbs)?;
    sheet.warnings = warnings;
    let motion = made.motion(&workshop.loaded.up);
    let motion_json = json("motion.json", &motion)?;
    let promise: NetworkPromise = read_back("checklist.json", &json("checklist.json", &sheet)?)?;
    let evidence = NetworkEvidence {
        limbs: evidence(&promise, made, &motion, &curves)?,
        motion: read_back("motion.json", &motion_json)?,
        junctures: made
            .junctures
            .iter()
            .map(WrittenJuncture::evidence)
            .collect(),
        pose_files: texts(made.written_poses(&joints(&made.limbs)).files()),
        model: model_stl.as_deref().map(stl::decode).transpose()?,
        promise,
    };
    let facts = judge_network(&evidence, workshop.watch)?;
    sheet.checks = network_checks(&evidence.promise, &facts);
    sheet.verdict = Verdict::of(&sheet.checks);
    for limb in &mut sheet.limbs {
        // Its checks are among those of the whole.
        limb.sheet.verdict = sheet.verdict;
    }
    Ok(NetworkDraft {
        sheet,
        motion_json,
        curves,
        model_stl,
    })
}

fn evidence(
    promise: &NetworkPromise,
    made: &MadeNetwork,
    motion: &NetworkMotion,
    curves: &[String],
) -> Result<Vec<TelescopeEvidence>, TelescopeRunError> {
    let limbs = promise.limbs.iter().zip(&made.limbs).zip(&motion.limbs);
    let limbs = limbs.zip(curves).map(|(((limb, made), motion), curve)| {
        let points = asked_points(curve.as_bytes());
        let fault = |error: PointsError| Unwritable::new("curve.csv", &error);
        let motion_json = json("motion.json", motion)?;
        Ok(TelescopeEvidence {
            promise: limb.sheet.clone(),
            motion: read_back("motion.json", &motion_json)?,
            parts: made.parts.iter().map(|part| part.in_shell()).collect(),
            printed: made
                .parts
                .iter()
                .map(|part| part.read_back.clone())
                .collect(),
            pose_files: Vec::new(),
            asked: points.map_err(fault)?,
        })
    });
    limbs.collect()
}

/// Returns the checklist, but for its checks and the hashes of other files.
fn sheet(
    workshop: &Workshop,
    made: &MadeNetwork,
    limbs: Vec<LimbRow>,
) -> Result<NetworkSheet, TelescopeRunError> {
    let tree = &made.tree;
    let first = tree.limbs[0].order.asked(workshop.shop, "")?;
    let keys = made.keys();
    let whole = Whole::of(made, first.shop.material.density_g_cm3.value);
    let ends = [keys.first(), keys.last()];
    let [collapsed_mm, extended_mm] =
        ends.map(|key| key.map_or([0.0; 3], |key| size_mm(made, key)));
    let loaded = workshop.loaded;
    let junctures = || made.junctures.iter();
    Ok(NetworkSheet {
        schema: NETWORK_SHEET_SCHEMA,
        kind: "network",
        job: workshop.job.name(),
        version: env!("CARGO_PKG_VERSION"),
        verdict: Verdict::Fail,
        printer: printer(&first),
        material: material(&first),
        input: CurveRow {
            source: workshop.job.in_kit().curve.source,
            sha256: Some(loaded.file.sha256.clone()),
            length_mm: loaded.longest_mm,
        },
        glue_mm: first.least.glue_mm,
        groove_mm: first.least.groove_mm(),
        model: workshop.form.skin().map(|_| MODEL_FILE),
        junctures: junctures()
            .map(|own| rows::promise(workshop, own))
            .collect(),
        juncture_rows: junctures()
            .flat_map(|own| rows::rows(workshop, own))
            .collect(),
        juncture_joints: junctures().flat_map(rows::joint_rows).collect(),
        order: made
            .sequence
            .iter()
            .map(|limb| tree.network.limbs[*limb].id.clone())
            .collect(),
        solid: made.solid.clone(),
        mass_g: whole.mass_g,
        toppling_deg: topplings(made, &whole.centres_mm),
        worst_toppling_deg: made.foot.map(|own| own.worst_deg),
        least_angle_deg: made.foot.map(|_| workshop.job.least_angle_deg),
        foot: made.foot.map(|own| foot_row(own.foot.disc)),
        centres_mm: whole.centres_mm,
        collapsed_mm,
        extended_mm,
        poses: made.written_poses(&joints(&made.limbs)).rows(),
        warnings: Vec::new(),
        limbs,
        checks: Vec::new(),
        files: BTreeMap::new(),
    })
}

/// Returns the lean at which a figure topples at every key, degrees; none without a foot.
fn topplings(made: &MadeNetwork, centres_mm: &[[f64; 3]]) -> Vec<f64> {
    let Some(StoodFoot { foot, .. }) = &made.foot else {
        return Vec::new();
    };
    let lean = |centre: &[f64; 3]| foot.lean_rad(&Point::from(*centre), 0.0).to_degrees();
    centres_mm.iter().map(lean).collect()
}

/// Mass and centre of all parts.
struct Whole {
    mass_g: f64,
    centres_mm: Vec<[f64; 3]>,
}

impl Whole {
    fn of(made: &MadeNetwork, density_g_cm3: f64) -> Self {
        let junctures = made.junctures.iter();
        let junctures: Vec<_> = junctures
            .map(|own| moments_of_mesh(&own.in_model()))
            .collect();
        let limbs = made.limbs.iter().flat_map(|limb| &limb.masses);
        let volume_mm3: f64 = limbs.map(|mass| mass.volume_mm3).sum::<f64>()
            + junctures
                .iter()
                .map(|moments| moments.volume())
                .sum::<f64>();
        let centre = |state: &Vec<Key>| {
            let frames = made.tree.network.frames(state);
            let mut first = Vector::zeros();
            for (limb, frames) in made.limbs.iter().zip(&frames.shells) {
                for (mass, frame) in limb.masses.iter().zip(frames) {
                    first += frame.to_model(&mass.centre).coords * mass.volume_mm3;
                }
            }
            for (moments, frame) in junctures.iter().zip(&frames.junctures) {
                let centre: Point = frame.to_model(&moments.centroid());
                first += centre.coords * moments.volume();
            }
            (first / volume_mm3).into()
        };
        Self {
            mass_g: volume_mm3 / MM3_PER_CM3 * density_g_cm3,
            centres_mm: made.keys().iter().map(centre).collect(),
        }
    }
}

/// Returns the box of all parts in a state, along the model's axes.
fn size_mm(made: &MadeNetwork, state: &[Key]) -> [f64; 3] {
    let parts = made.placed(state);
    let boxes = parts.iter().map(TriMesh::aabb);
    let whole = boxes.fold(Aabb::EMPTY, |whole, part| whole.union(&part));
    whole.size().into()
}

/// Returns the warning that junctures need support.
fn round(workshop: &Workshop) -> Option<String> {
    let needs_support = workshop.shop.printer.support == Support::Breakaway;
    let words = match workshop.form.skin() {
        Some(_) => {
            "Junctures keep the model's surface: support what overhangs, and sockets that lie across."
        }
        None => "Junctures are round: support them below, and in sockets that lie across.",
    };
    needs_support.then(|| words.to_owned())
}
