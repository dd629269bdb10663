//! The facts of a volume mesh, as `inspect` tells them.

use serde::Serialize;

use super::field_facts::{BodyFacts, FieldFacts, body_facts, body_text, field_text, share};
use super::flags::with_flags;
use super::mass_facts::plain;
use crate::base::units::{MM3_PER_CM3, format_count};
use crate::field::Measured;
use crate::io::Volume;
use crate::mass::Moments;
use crate::tets::{Densities, Difference, Quality, SLIVER_DEG, Sampling, Tets};

/// The facts of a volume mesh, model axes, scaled as ordered. Tetrahedra are counted from 1.
#[derive(Debug, Serialize)]
pub(super) struct VolumeFacts {
    tetrahedra: usize,
    corners: usize,
    boundary_triangles: usize,
    /// Edges along which parts only touch.
    contact_edges: usize,
    /// Tetrahedra that were listed in the other order of turning.
    turned: usize,
    size_mm: [f64; 3],
    /// A remedy for a size that nobody prints; `None` if the size is plausible.
    pub size_hint: Option<String>,
    volume_mm3: f64,
    /// Parts of the file that were passed over, in words.
    passed_over: Vec<String>,
    /// The data of the file that is its density, in words; `None` for a mesh that is solid.
    density: Option<String>,
    #[serde(skip)]
    is_at_corners: bool,
    density_range: [f64; 2],
    /// Density of the solid material.
    material_g_cm3: f64,
    mass_g: f64,
    /// Mean density over that of the solid material.
    mean_density_ratio: f64,
    /// `None` for densities without mass.
    body: Option<BodyFacts>,
    shape: ShapeFacts,
    sampling: SamplingFacts,
    /// A field sampled at the corners; `None` without one.
    pub field: Option<FieldSampling>,
}

/// The shapes of the tetrahedra.
#[derive(Debug, Serialize)]
struct ShapeFacts {
    least_angle_deg: f64,
    least_angle_tetrahedron: usize,
    greatest_angle_deg: f64,
    worst_radius_ratio: f64,
    worst_radius_tetrahedron: usize,
    slivers: usize,
    edge_mm: [f64; 2],
}

/// The steps of density between samples, and the error that is estimated.
#[derive(Debug, Serialize)]
struct SamplingFacts {
    greatest_jump: f64,
    greatest_jump_tetrahedron: usize,
    /// Estimated for a density that is smooth between the samples; `None` for a uniform one.
    estimated_error: Option<ErrorFacts>,
}

/// An error of mass, centre and moments.
#[derive(Debug, Serialize)]
pub(super) struct ErrorFacts {
    mass_ratio: f64,
    center_mm: f64,
    inertia_ratio: f64,
}

/// A field over the surface of the mesh, and the error of its samples at the corners.
#[derive(Debug, Serialize)]
pub(super) struct FieldSampling {
    pub exact: FieldFacts,
    /// `None` for a field without mass.
    pub sampling_error: Option<ErrorFacts>,
}

impl From<Difference> for ErrorFacts {
    fn from(difference: Difference) -> Self {
        Self {
            mass_ratio: difference.mass_ratio,
            center_mm: difference.center_mm,
            inertia_ratio: difference.inertia_ratio,
        }
    }
}

impl VolumeFacts {
    /// Measures a volume mesh of a material.
    pub fn of(volume: &Volume, material_g_cm3: f64) -> Self {
        let tets = &volume.tets;
        let moments = tets.moments();
        let volume_mm3 = tets.solid_moments().volume();
        let measured = Measured {
            moments,
            error: Moments::default(),
        };
        let passed_over = volume.ignored.iter();
        let passed_over = passed_over.map(|it| format!("{} {}", it.count, it.kind));
        Self {
            tetrahedra: tets.cells().len(),
            corners: tets.corner_count(),
            boundary_triangles: tets.boundary().mesh().triangles().len(),
            contact_edges: tets.boundary().contacts().len(),
            turned: tets.turned(),
            size_mm: tets.aabb().size().into(),
            size_hint: None,
            volume_mm3,
            passed_over: passed_over.collect(),
            density: volume.density.as_ref().map(ToString::to_string),
            is_at_corners: matches!(tets.densities(), Densities::Corners(_)),
            density_range: density_range(tets),
            material_g_cm3,
            mass_g: moments.volume() * material_g_cm3 / MM3_PER_CM3,
            mean_density_ratio: moments.volume() / volume_mm3,
            body: body_facts(&measured, material_g_cm3 / MM3_PER_CM3),
            shape: shape_facts(&Quality::of(tets)),
            sampling: sampling_facts(Sampling::of(tets)),
            field: None,
        }
    }
}

/// Returns the least and the greatest density in the tetrahedra.
fn density_range(tets: &Tets) -> [f64; 2] {
    let all = (0..tets.cells().len()).flat_map(|cell| tets.densities_of(cell));
    all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

fn shape_facts(quality: &Quality) -> ShapeFacts {
    ShapeFacts {
        least_angle_deg: quality.least_angle_deg,
        least_angle_tetrahedron: quality.least_angle_cell + 1,
        greatest_angle_deg: quality.greatest_angle_deg,
        worst_radius_ratio: quality.worst_radius_ratio,
        worst_radius_tetrahedron: quality.worst_radius_cell + 1,
        slivers: quality.slivers,
        edge_mm: [quality.shortest_edge_mm, quality.longest_edge_mm],
    }
}

fn sampling_facts(sampling: Sampling) -> SamplingFacts {
    SamplingFacts {
        greatest_jump: sampling.jump.density,
        greatest_jump_tetrahedron: sampling.jump.cell + 1,
        estimated_error: sampling.estimate.map(Into::into),
    }
}

/// Returns the facts in words.
pub(super) fn volume_text(facts: &VolumeFacts) -> String {
    let [x, y, z] = facts.size_mm.map(|mm| plain(mm, ""));
    let mut text = format!(
        "a volume mesh of {}, {}, {}\nsize {x} × {y} × {z} mm, volume {}\n",
        of_tetrahedra(facts.tetrahedra),
        format_count(facts.corners, "corner"),
        format_count(facts.boundary_triangles, "boundary triangle"),
        plain(facts.volume_mm3, "mm³"),
    );
    text += &facts.size_hint.as_ref().map_or(String::new(), |hint| {
        format!("warning: {}\n", with_flags(hint))
    });
    if facts.turned > 0 {
        text += &format!(
            "{} list their corners in the other order of turning, and were turned\n",
            of_tetrahedra(facts.turned)
        );
    }
    if facts.contact_edges > 0 {
        let edges = format_count(facts.contact_edges, "edge");
        text += &format!("parts of it touch along {edges} only: it is no solid of one piece\n");
    }
    if !facts.passed_over.is_empty() {
        text += &format!("passed over: {}\n", facts.passed_over.join(", "));
    }
    text += &density_text(facts);
    text += &match &facts.body {
        Some(body) => body_text(body),
        None => "the densities have no mass, so there is no centre of mass\n".to_owned(),
    };
    text += &shape_text(&facts.shape);
    text += &sampling_text(facts);
    if let Some(field) = &facts.field {
        text += &field_text(&field.exact);
        text += &field
            .sampling_error
            .as_ref()
            .map_or(String::new(), |error| {
                format!(
                    "sampled at the corners of this mesh it is off by {}\n",
                    error_text(error)
                )
            });
    }
    text
}

fn of_tetrahedra(count: usize) -> String {
    match count {
        1 => "1 tetrahedron".to_owned(),
        _ => format!("{count} tetrahedra"),
    }
}

fn density_text(facts: &VolumeFacts) -> String {
    let [low, high] = facts.density_range.map(|density| plain(density, ""));
    let density = match &facts.density {
        Some(density) => format!("density: {density}, from {low} to {high}"),
        None => "density: none in the file, so it is solid".to_owned(),
    };
    format!(
        "{density}\nmass {} of {} material, mean density {}\n",
        plain(facts.mass_g, "g"),
        plain(facts.material_g_cm3, "g/cm³"),
        plain(100.0 * facts.mean_density_ratio, "%"),
    )
}

fn shape_text(shape: &ShapeFacts) -> String {
    let [shortest, longest] = shape.edge_mm.map(|mm| plain(mm, "mm"));
    let slivers = match shape.slivers {
        0 => "no slivers".to_owned(),
        count => format_count(count, "sliver"),
    };
    format!(
        "angles between faces from {} (tetrahedron {}) to {}, edges from {shortest} to {longest}\n\
         worst radius ratio {} (tetrahedron {}; 1 is regular), {slivers} (an angle below {} or \
         above {})\n",
        plain(shape.least_angle_deg, "°"),
        shape.least_angle_tetrahedron,
        plain(shape.greatest_angle_deg, "°"),
        plain(shape.worst_radius_ratio, ""),
        shape.worst_radius_tetrahedron,
        plain(SLIVER_DEG, "°"),
        plain(180.0 - SLIVER_DEG, "°"),
    )
}

fn sampling_text(facts: &VolumeFacts) -> String {
    let sampling = &facts.sampling;
    let Some(error) = &sampling.estimated_error else {
        return String::new();
    };
    let [within, smooth] = if facts.is_at_corners {
        ["within a tetrahedron", "between the corners"]
    } else {
        ["between neighbours", "and not in steps"]
    };
    format!(
        "the density changes by at most {} {within} (tetrahedron {})\n\
         estimated error of sampling, if the true density is smooth {smooth}: {}\n",
        plain(sampling.greatest_jump, ""),
        sampling.greatest_jump_tetrahedron,
        error_text(error),
    )
}

pub(super) fn error_text(error: &ErrorFacts) -> String {
    format!(
        "{} of the mass, {} of the centre, {} of the largest moment",
        share(error.mass_ratio),
        plain(error.center_mm, "mm"),
        share(error.inertia_ratio),
    )
}
