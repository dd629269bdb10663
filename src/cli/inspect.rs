//! `equipoise inspect`: what a model is, what is wrong with it, and what it could become.

use std::io::Write;

use serde::Serialize;

use super::Exit;
use super::args::InspectArgs;
use super::prepare::Voice;
use crate::geom::Vector;
use crate::io::{ReadError, read_model};
use crate::mass::{Body, moments_of_mesh};
use crate::mesh::{Defects, MeshFacts, Solid, TriMesh, one_body, repair, scaled};
use crate::units::counted;

/// Why `inspect` could not run.
#[derive(Debug, thiserror::Error)]
pub enum InspectError {
    /// The model cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
    /// The facts cannot be put into JSON.
    #[error("the facts cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// What is said of a model.
#[derive(Debug, Serialize)]
struct Findings {
    triangles: usize,
    vertices: usize,
    shells: usize,
    genus: Option<i64>,
    size_mm: [f64; 3],
    area_mm2: f64,
    open_edges: usize,
    crossing_pairs: Option<usize>,
    pinch_vertices: usize,
    degenerate_triangles: usize,
    repairs: String,
    defects: Option<String>,
    not_one_body: Option<String>,
    solid: Option<Mass>,
}

/// The mass properties of a solid of density 1 g/cm³, model axes.
#[derive(Debug, Serialize)]
struct Mass {
    volume_mm3: f64,
    center_mm: [f64; 3],
    principal_moments_ratio: [f64; 3],
    dominant_axis: [f64; 3],
    dominance_ratio_by_axis: [f64; 3],
}

/// Tells the facts and defects of a model on `out`; a model that is no solid of one body ends in [`Exit::NotKept`].
pub fn inspect(args: &InspectArgs, voice: Voice, out: &mut dyn Write) -> Result<Exit, InspectError> {
    let (mesh, repairs) = repair(read_model(&args.model)?);
    let mesh = scaled(&mesh, args.scaling.scaling().factor(mesh.longest_side_mm()));
    let facts = MeshFacts::of(&mesh);
    let solid = Solid::new(mesh);
    let findings = findings(&facts, repairs.to_string(), &solid);
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&findings)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&findings))?;
    }
    let is_sound = findings.defects.is_none() && findings.not_one_body.is_none();
    Ok(if is_sound { Exit::Kept } else { Exit::NotKept })
}

fn findings(facts: &MeshFacts, repairs: String, solid: &Result<Solid, Defects>) -> Findings {
    Findings {
        triangles: facts.triangles,
        vertices: facts.vertices,
        shells: facts.shells,
        genus: facts.genus,
        size_mm: facts.size_mm.into(),
        area_mm2: facts.area_mm2,
        open_edges: facts.open_edges,
        crossing_pairs: facts.crossings.as_ref().map(|crossings| crossings.pairs),
        pinch_vertices: facts.pinch_vertices.len(),
        degenerate_triangles: facts.degenerate_triangles,
        repairs,
        defects: solid.as_ref().err().map(ToString::to_string),
        not_one_body: solid.as_ref().ok().and_then(|solid| Some(one_body(solid).err()?.to_string())),
        solid: solid.as_ref().ok().map(|solid| mass(solid.mesh())),
    }
}

fn mass(mesh: &TriMesh) -> Mass {
    let moments = moments_of_mesh(mesh);
    let body = Body::new(&moments, 1.0);
    let principal = body.principal();
    let largest = principal.moments_g_mm2[2];
    Mass {
        volume_mm3: moments.volume(),
        center_mm: body.center.coords.into(),
        principal_moments_ratio: principal.moments_g_mm2.map(|moment| moment / largest),
        dominant_axis: principal.axes.column(2).into_owned().into(),
        dominance_ratio_by_axis: [0, 1, 2].map(|axis| dominance(&body, axis)),
    }
}

/// The larger moment across a coordinate axis over the one about it.
fn dominance(body: &Body, axis: usize) -> f64 {
    let inertia = body.inertia_g_mm2;
    let about = Vector::ith(axis, 1.0).dot(&(inertia * Vector::ith(axis, 1.0)));
    let across = inertia.remove_row(axis).remove_column(axis).symmetric_eigenvalues();
    across.max() / about
}

fn text(findings: &Findings) -> String {
    let [x, y, z] = findings.size_mm;
    let mut text = format!(
        "{} triangles, {} vertices, {}{}\nsize {x:.3} × {y:.3} × {z:.3} mm, surface {:.1} mm²\nrepaired: {}\n",
        findings.triangles,
        findings.vertices,
        counted(findings.shells, "shell"),
        findings.genus.map_or(String::new(), |genus| format!(", genus {genus}")),
        findings.area_mm2,
        findings.repairs,
    );
    for (count, what) in [
        (
            findings.crossing_pairs.unwrap_or(0),
            "pairs of triangles pass through each other (moments count the overlap twice)",
        ),
        (findings.pinch_vertices, "vertices in which surfaces only touch"),
        (findings.degenerate_triangles, "triangles without area"),
    ] {
        if count > 0 {
            text += &format!("{count} {what}\n");
        }
    }
    if let Some(reason) = &findings.not_one_body {
        text += &format!("prepare needs one body: {reason}\n");
    }
    match (&findings.solid, &findings.defects) {
        (Some(mass), _) => text + &mass_text(mass),
        (_, Some(defects)) => text + defects + "\n",
        _ => text,
    }
}

fn mass_text(mass: &Mass) -> String {
    let [cx, cy, cz] = mass.center_mm;
    let [ax, ay, az] = mass.dominant_axis;
    let mut text = format!(
        "a solid of {:.1} mm³, centre of mass ({cx:.3}, {cy:.3}, {cz:.3}) mm\nlargest moment of inertia about ({ax:.4}, {ay:.4}, {az:.4}), which --up principal takes\n",
        mass.volume_mm3
    );
    for (axis, ratio) in ["x", "y", "z"].iter().zip(mass.dominance_ratio_by_axis) {
        let word = if ratio < 1.0 {
            "it can spin about this axis as it is"
        } else {
            "only hollowing could make it spin"
        };
        text += &format!("about {axis}: I_b/I_c {ratio:.3}, {word}\n");
    }
    text
}
