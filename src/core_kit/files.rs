//! The files of a kit besides its parts and papers.

use super::asked::Asked;
use super::error::CoreRunError;
use super::made::{Made, WrittenPart};
use super::rods::rods;
use crate::draw::part_color;
use crate::geom::{Matrix, Plane, Point, Vector};
use crate::io::threemf::{Build, Object, Package, Transform};
use crate::io::{encode_cut_svg, encode_dxf, stl};
use crate::make::{File, plates, print_settings};
use crate::mesh::TriMesh;
use crate::panels::{EdgeJoint, Hole, PanelEdge};
use crate::polyhedra::{BasePlan, Obstacles, Separation};
use crate::verify::{
    BaseCertificate, CoreCertificate, CutSheetPromise, EdgePromise, HolePromise, MODEL_FILE,
    PanelPromise, PanelsFile, PlacedPanel, RodPromise,
};

/// The version of the keys of panels and certificate.
const SCHEMA: u32 = 1;
/// The assembly in a kit.
const ASSEMBLY: &str = "assembly.3mf";
/// The number from which panels are coloured in the assembly.
const PANEL_COLOR: usize = 7;

/// Returns the model in single precision, as a file.
pub fn model_stl(asked: &Asked) -> Vec<u8> {
    stl::encode(asked.ground.solid().mesh(), &asked.job.name())
}

/// Returns the certificate of a base, found anew on the model as it is written.
pub fn certificate(
    asked: &Asked,
    made: &Made,
    model_stl: &[u8],
) -> Result<CoreCertificate, CoreRunError> {
    let plan = &made.built.plan;
    let longest_mm = asked.ground.obstacles().longest_edge_mm();
    let obstacles = Obstacles::of_mesh(&stl::decode(model_stl)?, longest_mm);
    let distance_mm = asked.base.distance_mm;
    let numbers = |plane: &Plane| {
        let [x, y, z] = plane.normal.into();
        [x, y, z, plane.offset_mm]
    };
    let bases = plan.polyhedra.iter().enumerate().map(|(index, body)| {
        let planes = body.planes();
        Ok(BaseCertificate {
            faces: Separation::find(&planes, &obstacles, distance_mm)?.faces,
            planes: planes.iter().map(numbers).collect(),
            sides: plan.sides(index).iter().map(numbers).collect(),
        })
    });
    let mut bases: Vec<BaseCertificate> = bases.collect::<Result<_, CoreRunError>>()?;
    let others = bases.split_off(bases.len().min(1));
    Ok(CoreCertificate {
        schema: SCHEMA,
        model: MODEL_FILE.to_owned(),
        distance_mm,
        longest_edge_mm: longest_mm,
        base: bases.pop().unwrap_or_default(),
        others,
    })
}

/// Returns the polyhedron of a face of the whole base, and the face's index in it.
fn face_in(plan: &BasePlan, face: usize) -> [usize; 2] {
    let counts = 0..plan.polyhedra.len();
    let own = counts.rev().find(|at| plan.faces_before(*at) <= face);
    let polyhedron = own.unwrap_or(0);
    [polyhedron, face - plan.faces_before(polyhedron)]
}

/// Returns the panels as plain data.
pub fn panels(made: &Made) -> PanelsFile {
    let set = &made.built.shell.panels;
    let hole = |hole: &Hole| HolePromise {
        at_mm: hole.at_mm,
        diameter_mm: hole.diameter_mm,
    };
    let panels = set.panels.iter().enumerate().map(|(index, panel)| {
        let axis = |column: usize| panel.frame.axes.column(column).into_owned().into();
        let edges = set.edges.iter().filter(|edge| edge.panels.contains(&index));
        let [polyhedron, plane] = face_in(&made.built.plan, panel.face);
        PanelPromise {
            panel: index + 1,
            polyhedron: polyhedron + 1,
            plane,
            origin_mm: panel.frame.origin.into(),
            axes: [0, 1, 2].map(axis),
            outline_mm: panel.outline.corners().to_vec(),
            holes: panel.holes.iter().map(hole).collect(),
            edges: edges.map(|edge| edge_promise(edge, index)).collect(),
        }
    });
    PanelsFile {
        schema: SCHEMA,
        panels: panels.collect(),
    }
}

fn edge_promise(edge: &PanelEdge, panel: usize) -> EdgePromise {
    let [first, second] = edge.panels;
    EdgePromise {
        to: if first == panel { second } else { first } + 1,
        angle_deg: edge.angle_rad.to_degrees(),
        length_mm: edge.length_mm(),
        joint: joint_word(&edge.joint).to_owned(),
    }
}

/// Names the joint along an edge.
pub fn joint_word(joint: &EdgeJoint) -> &'static str {
    match joint {
        EdgeJoint::Fingers(_) => "fingers",
        EdgeJoint::Brackets(places) if places.is_empty() => "glue",
        EdgeJoint::Brackets(_) => "brackets",
    }
}

/// Returns the drawings of all sheets, two files each.
pub fn drawings(asked: &Asked, made: &Made) -> Vec<File> {
    let sheets = made.built.sheets.iter().zip(cut_sheets(made));
    let files = sheets.flat_map(|(sheet, promise)| {
        let drawing = sheet.drawing(asked.shop.cutter.dialect);
        [
            (promise.dxf, encode_dxf(&drawing).into_bytes()),
            (promise.svg, encode_cut_svg(&drawing).into_bytes()),
        ]
    });
    files.collect()
}

/// Returns the sheets with the places of their panels.
pub fn cut_sheets(made: &Made) -> Vec<CutSheetPromise> {
    let sheets = made.built.sheets.iter().enumerate();
    sheets
        .map(|(index, sheet)| CutSheetPromise {
            dxf: format!("sheets/sheet-{}.dxf", index + 1),
            svg: format!("sheets/sheet-{}.svg", index + 1),
            size_mm: sheet.nested.size_mm,
            is_turned: sheet.nested.is_turned,
            panels: sheet
                .nested
                .placements
                .iter()
                .map(|at| PlacedPanel {
                    panel: at.panel + 1,
                    turn_rad: at.turn_rad,
                    at_mm: at.at_mm,
                })
                .collect(),
        })
        .collect()
}

/// Returns the plates with the printed parts, and everything together.
pub fn packages(asked: &Asked, made: &Made) -> Result<Vec<File>, CoreRunError> {
    let scale = Vector::from(asked.shop.printer.print_scale_ratio());
    let sized = |p: &Point| p.coords.component_mul(&scale).into();
    let printed: Vec<TriMesh> = made
        .parts
        .iter()
        .map(|part| part.read_back.map_vertices(sized))
        .collect();
    let parts = made.parts.iter().zip(&printed).enumerate();
    let mut objects: Vec<Object> = parts
        .map(|(index, (part, mesh))| Object::new(&part.id, part_color(index), mesh))
        .collect();
    let job = asked.job.name();
    let encode = |file: String, objects: &[Object], description: String, build: Build| {
        let package = Package {
            title: format!("{job} {}", file.trim_end_matches(".3mf")),
            description,
            job: job.clone(),
            objects,
            build,
            settings: print_settings(&asked.shop.printer),
        };
        Ok::<File, CoreRunError>((file, package.encode()?))
    };
    let mut files = Vec::new();
    for (file, (description, build)) in plates(&asked.shop.printer, &printed) {
        files.push(encode(file, &objects, description, build)?);
    }
    let mut places = together(asked, &made.parts);
    for (index, panel) in made.built.shell.panels.panels.iter().enumerate() {
        let name = format!("panel {}", index + 1);
        objects.push(Object::new(&name, part_color(PANEL_COLOR), &panel.body()));
        places.push((objects.len() - 1, Transform::default()));
    }
    let rods = rods(made);
    let bodies: Vec<TriMesh> = rods.iter().map(RodPromise::body).collect();
    for (rod, body) in rods.iter().zip(&bodies) {
        objects.push(Object::new(
            &format!("rod {}", rod.name),
            part_color(PANEL_COLOR),
            body,
        ));
        places.push((objects.len() - 1, Transform::default()));
    }
    let words = "Everything in its place, in the axes of the model; panels without their holes.";
    let build = Build::Assembly(job.clone(), places);
    files.push(encode(
        ASSEMBLY.to_owned(),
        &objects,
        words.to_owned(),
        build,
    )?);
    Ok(files)
}

/// Returns the places of the parts in the model: what was done to print them is undone.
fn together(asked: &Asked, parts: &[WrittenPart]) -> Vec<(usize, Transform)> {
    let unscaled = Vector::from(asked.shop.printer.print_scale_ratio()).map(f64::recip);
    let size = Transform {
        linear: Matrix::from_diagonal(&unscaled),
        shift: Vector::zeros(),
    };
    let place = |(index, part): (usize, &WrittenPart)| {
        let back = part.pose.rotation().transpose();
        let placed = Transform {
            linear: back,
            shift: -(back * part.pose.translation()),
        };
        (index, size.then(&placed))
    };
    parts.iter().enumerate().map(place).collect()
}
