//! The printed parts of an object as files: shell parts and brackets, in print pose and read back.

use rayon::prelude::*;

use super::asked::Asked;
use super::build::Built;
use super::error::CoreRunError;
use super::home::home_panel;
use super::names::{Names, bracket_id};
use super::pockets::Pocket;
use crate::base::watch::{Phase, Watch};
use crate::cladding::{BoundKind, CladdingError, Lie, Part, PartPins, Room};
use crate::cut::PinSite;
use crate::geom::{Frame, Point, Vector};
use crate::io::stl;
use crate::make::write_free_of_folds;
use crate::mesh::TriMesh;
use crate::verify::{BossPromise, CorePartKind, Pose};

/// Side of the room of a printer whose own is not known, mm.
const ANY_ROOM_MM: f64 = 1e6;

/// A part as it was written.
pub struct WrittenPart {
    pub id: String,
    pub kind: CorePartKind,
    /// The number of the panel along whose normal it leaves, or on which a bracket stands, from 1.
    pub panel: usize,
    pub pose: Pose,
    /// True if it lies on the side that bears on its panel.
    pub lies_on_panel_side: bool,
    pub file: String,
    pub bytes: Vec<u8>,
    /// The triangles read back, in print pose, in the part's own size.
    pub read_back: TriMesh,
    pub void_mm3: f64,
    pub bores_mm3: f64,
    /// The volumes that its pins add and that its sockets take away.
    pub pins_mm3: [f64; 2],
    pub cuts: Vec<[f64; 4]>,
    pub bosses: Vec<BossPromise>,
}

impl WrittenPart {
    /// Returns the mesh in the model's frame, as the file holds it.
    pub fn in_model(&self) -> TriMesh {
        self.read_back.map_vertices(|p| self.pose.to_model(p))
    }
}

/// An object with its printed parts.
pub struct Made {
    pub built: Built,
    pub names: Names,
    /// The parts of the shell in their order, then the brackets.
    pub parts: Vec<WrittenPart>,
}

impl Made {
    /// Returns the brackets among the parts.
    pub fn brackets(&self) -> &[WrittenPart] {
        &self.parts[self.built.shell.parts.len()..]
    }
}

/// Writes all printed parts and reads them back.
pub fn make(asked: &Asked, built: Built, watch: &Watch) -> Result<Made, CoreRunError> {
    watch.enter(Phase::Parts);
    let names = Names::of(&built);
    let writer = Writer {
        asked,
        built: &built,
        names: &names,
        watch,
    };
    let shell = (0..built.shell.parts.len()).into_par_iter();
    let shell = shell.map(|index| writer.shell_part(index));
    let mut parts: Vec<WrittenPart> = shell.collect::<Result<_, CoreRunError>>()?;
    let brackets = (0..built.brackets.len()).into_par_iter();
    let brackets = brackets.map(|index| writer.bracket(index));
    let brackets: Vec<WrittenPart> = brackets.collect::<Result<_, CoreRunError>>()?;
    parts.extend(brackets);
    Ok(Made {
        built,
        names,
        parts,
    })
}

struct Writer<'a> {
    asked: &'a Asked<'a>,
    built: &'a Built,
    names: &'a Names,
    watch: &'a Watch,
}

impl Writer<'_> {
    /// Writes a part of the shell.
    fn shell_part(&self, index: usize) -> Result<WrittenPart, CoreRunError> {
        let shell = &self.built.shell;
        let part = &shell.parts[index];
        let room = Room {
            size_mm: self.asked.room_mm().unwrap_or([ANY_ROOM_MM; 3]),
            wall_mm: self.asked.wall_mm,
        };
        let no_cut = CladdingError::NoCut { face: part.face };
        let face = self.built.plan.face(part.face);
        let up = face.map_or_else(Vector::zeros, |face| face.plane.normal);
        let pegs = PartPins::on(&shell.pins, index, 0).into_iter();
        let tips = pegs.map(PinSite::protruding_body);
        let tips: Vec<Point> = tips.flat_map(TriMesh::into_vertices).collect();
        let lie = Lie::of_part(part, &tips, &up, &room).ok_or(no_cut)?;
        let cup = &shell.cups[index];
        let [pegs_mm3, sockets_mm3] = cup.pins_mm3;
        let written = self.write(&cup.body, &lie.frame, &self.names.parts[index])?;
        Ok(WrittenPart {
            kind: CorePartKind::Shell,
            panel: self.names.panels[index],
            lies_on_panel_side: part.is_on_panel() && lie.frame.axis().dot(&up) > 1.0 - 1e-9,
            void_mm3: cup.void_mm3,
            bores_mm3: part.volume_mm3() - cup.void_mm3 + pegs_mm3
                - sockets_mm3
                - cup.body.signed_volume_mm3(),
            pins_mm3: cup.pins_mm3,
            cuts: cuts(part),
            bosses: self.bosses(index),
            ..written
        })
    }

    /// Writes a bracket. It lies on its side, so that its section is printed without support.
    fn bracket(&self, index: usize) -> Result<WrittenPart, CoreRunError> {
        let bracket = &self.built.brackets[index];
        let edge = &self.built.shell.panels.edges[bracket.edge];
        let along: Vector = edge.ends[1] - edge.ends[0];
        let upright = Frame::with_axis(Point::origin(), &along);
        let low = bracket.body.in_frame(&upright).aabb().min;
        let frame = Frame {
            origin: upright.to_model(&low),
            ..upright
        };
        let home = home_panel(&self.built.plan, &self.built.shell, bracket);
        Ok(WrittenPart {
            panel: home.panel + 1,
            ..self.write(&bracket.body, &frame, &bracket_id(index))?
        })
    }

    /// Writes a body that lies in a frame.
    fn write(&self, body: &TriMesh, frame: &Frame, id: &str) -> Result<WrittenPart, CoreRunError> {
        self.watch.check()?;
        let pose = Pose::new(
            &frame.axes.transpose(),
            &-frame.axes.tr_mul(&frame.origin.coords),
        );
        let name = format!("{}_{id}", self.asked.job.name());
        let scale = Vector::from(self.asked.shop.printer.print_scale_ratio());
        let at = |p: &Point| pose.to_print(p).coords.component_mul(&scale).into();
        let bytes = write_free_of_folds(&body.map_vertices(at), &name, self.watch)?;
        let read_back = stl::decode(&bytes)?;
        Ok(WrittenPart {
            id: id.to_owned(),
            kind: CorePartKind::Bracket,
            panel: 1,
            pose,
            lies_on_panel_side: false,
            file: format!("parts/{name}.stl"),
            bytes,
            read_back: read_back.map_vertices(|p| p.coords.component_div(&scale).into()),
            void_mm3: 0.0,
            bores_mm3: 0.0,
            pins_mm3: [0.0; 2],
            cuts: Vec::new(),
            bosses: Vec::new(),
        })
    }

    /// Returns the bores of a part, for its inserts, the heads of bracket screws and rods.
    fn bosses(&self, index: usize) -> Vec<BossPromise> {
        let kit = &self.asked.screws;
        let own = self.built.shell.screws.iter();
        let own = own.filter(|screws| screws.part == index);
        let bores = own
            .flat_map(|screws| &screws.screws)
            .map(|screw| BossPromise {
                foot_mm: screw.foot.into(),
                depth_mm: kit.depth_mm(),
                bore_mm: kit.bore_mm(),
            });
        let panel = self.names.panels[index] - 1;
        let pockets = self.built.pockets.iter();
        let pockets = pockets.filter(|pocket| pocket.panel == panel);
        let rods = self.built.rod_bores[panel].iter();
        let rods = rods.map(|bore| BossPromise {
            foot_mm: bore.ends[0].into(),
            depth_mm: bore.depth_mm(),
            bore_mm: bore.diameter_mm,
        });
        let over = pockets.map(Pocket::promise).chain(rods);
        bores.chain(over).collect()
    }
}

/// Returns the planes of cuts along a part's sides, and of those to other polyhedra.
fn cuts(part: &Part) -> Vec<[f64; 4]> {
    let bounds = part.region.bounds().iter();
    let cuts = bounds.filter(|bound| matches!(bound.kind, BoundKind::Cut | BoundKind::Split));
    cuts.map(|bound| {
        let [x, y, z] = bound.plane.normal.into();
        [x, y, z, bound.plane.offset_mm]
    })
    .collect()
}
