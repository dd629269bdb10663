//! The certificate of an object on a base: its checks, its separation, joints, mass and volume.

use maud::{Markup, html};

use super::core_kit::{CorePage, promise};
use super::document::styled_document;
use super::proof;
use super::running::style;
use super::wing_frame as frame;
use crate::base::numbers::{number, quantity};
use crate::base::units::MM3_PER_CM3;
use crate::sheet::core_kit::CoreSheet;
use crate::verify::{
    BaseCertificate, CheckKind, CoreCertificate, CorePartKind, CorePartPromise, FastenerKind,
    PanelsFile,
};

/// Moves below this are rounding, mm.
const LEAST_MOVE_MM: f64 = 1e-3;

/// The proofs of a base as the kit holds them.
#[derive(Debug, Clone, Copy)]
pub struct CoreProof<'a> {
    /// Its certificate of separation.
    pub certificate: &'a CoreCertificate,
    /// Its panels.
    pub panels: &'a PanelsFile,
}

/// Returns the certificate of an object's kit as a self-contained HTML page.
pub fn core_certificate(page: &CorePage, proof: &CoreProof) -> String {
    let (sheet, job) = (page.sheet, page.job_id());
    let body = html! {
        (frame::certificate_head(&job, &promise(sheet)))
        main {
            (proof::checks(&sheet.checks))
            (separation(sheet, proof))
            (joints(sheet))
            (mass(sheet))
            (volume(sheet))
            (frame::files(page.sha256, &sheet.files))
        }
    };
    styled_document(&format!("Certificate: {}", sheet.job), &body, &style(&job))
}

/// Returns how many pieces of the surface each plane of the base parts from it.
fn separation(sheet: &CoreSheet, proof: &CoreProof) -> Markup {
    let certificate = proof.certificate;
    let pieces: usize = certificate.bases().map(|base| base.faces.len()).sum();
    let mut checks = sheet.checks.iter();
    let parted = checks.find(|check| check.kind == CheckKind::Separation);
    let parted = parted.and_then(|check| check.value);
    let is_one = certificate.others.is_empty();
    html! {
        section {
            h2 { "What parts the base from the surface" }
            p {
                "Every piece of the surface of " code { (certificate.model) } " lies beyond a plane of the base, at least "
                (quantity(certificate.distance_mm, "mm")) " away. So no point of the base is nearer to the surface. Triangles with an edge longer than "
                (quantity(certificate.longest_edge_mm, "mm")) " are halved until none is. That makes " (pieces) " pieces"
                @if let Some(parted) = parted { "; the nearest is parted by " (quantity(parted, "mm")) }
                ". " code { "certificate.json" } " names the plane of each, and the judge looked at every one."
            }
            (moved_vertices(sheet))
            table class="stack" {
                thead {
                    tr {
                        @if !is_one { th scope="col" { "Polyhedron" } }
                        th scope="col" { "Plane" } th scope="col" { "Panel" }
                        th scope="col" class="n" { "Pieces" } th scope="col" class="n" { "Normal and offset, mm" }
                    }
                }
                tbody {
                    @for (polyhedron, base) in certificate.bases().enumerate() {
                        @for (plane, numbers) in base.planes.iter().enumerate() {
                            tr {
                                @if !is_one { td data-head="Polyhedron" { (polyhedron + 1) } }
                                th scope="row" { (plane + 1) }
                                td data-head="Panel" { (panel(proof.panels, [polyhedron, plane])) }
                                td class="n" data-head="Pieces" { (pieces_of(base, plane)) }
                                td class="n" data-head="Normal and offset" { (numbers.map(number).join(", ")) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns what the method of the paper yielded, and what its proof cost; nothing for other bases.
fn moved_vertices(sheet: &CoreSheet) -> Markup {
    let Some(found) = &sheet.base.vertices else {
        return html! {};
    };
    let lost = 100.0 * (1.0 - sheet.base.volume_mm3 / found.volume_mm3);
    html! {
        p {
            "The base is that of CofiFab (2016): the vertices of the " (found.start) " moved. That method samples the surface of its polyhedron. "
            (proof_of_faces([found.sampled_mm, found.certified_mm], found.moved_mm))
            " " (proof_cost(lost))
        }
    }
}

/// Tells how far samples and faces keep from the surface, and by how much faces then moved, mm.
fn proof_of_faces([sampled_mm, certified_mm]: [f64; 2], moved_mm: f64) -> String {
    let [sampled, certified] = [sampled_mm, certified_mm].map(|mm| quantity(mm, "mm"));
    if moved_mm < LEAST_MOVE_MM {
        return format!(
            "Here the samples keep {sampled}, and the faces alone prove {certified}. So no face \
             had to move."
        );
    }
    format!(
        "Here the samples keep {sampled}, but the faces alone prove {certified}. So its faces were \
         moved inward, by up to {}, until every piece was parted.",
        quantity(moved_mm, "mm")
    )
}

/// Tells the share of the volume that a proof cost, %. Less than nothing is a gain: each plane
/// begins as far out as the farthest corner of its face.
fn proof_cost(lost: f64) -> String {
    if lost >= 0.0 {
        return format!("That cost {} of its volume.", quantity(lost, "%"));
    }
    format!(
        "The flat faces, each as far out as its farthest corner, hold {} more than the bent ones.",
        quantity(-lost, "%")
    )
}

/// Returns the number of pieces that a plane parts.
fn pieces_of(base: &BaseCertificate, plane: usize) -> usize {
    let faces = base.faces.iter();
    faces.filter(|face| **face as usize == plane).count()
}

/// Returns the number of the panel on a plane of a polyhedron, both from 0.
fn panel(panels: &PanelsFile, [polyhedron, plane]: [usize; 2]) -> String {
    let mut panels = panels.panels.iter();
    let own = panels.find(|panel| panel.polyhedron == polyhedron + 1 && panel.plane == plane);
    own.map_or("none".to_owned(), |panel| panel.panel.to_string())
}

fn joints(sheet: &CoreSheet) -> Markup {
    let base = &sheet.base;
    let count = |kind: FastenerKind| {
        let own = sheet.fasteners.iter().filter(|one| one.kind == kind);
        own.count().to_string()
    };
    let rows = [
        ("Edges with fingers", base.finger_edges.to_string()),
        ("Edges with brackets", base.bracket_edges.to_string()),
        ("Edges that are glued alone", base.glued_edges.to_string()),
        ("Screws", count(FastenerKind::Screw)),
        ("Inserts", count(FastenerKind::Insert)),
        ("Bolts between polyhedra", count(FastenerKind::Bolt)),
        ("Rods between polyhedra", sheet.rods.len().to_string()),
        ("Films of glue", sheet.glue.len().to_string()),
    ];
    table("Joints", ["Joint", "Number"], &rows)
}

fn mass(sheet: &CoreSheet) -> Markup {
    let masses = &sheet.masses;
    let grams = |g: f64| quantity(g, "g");
    let point = |mm: [f64; 3]| format!("{} mm", mm.map(number).join(", "));
    let rows = [
        ("Printed parts", grams(masses.shell_g)),
        ("Panels", grams(masses.panels_g)),
        ("Brackets", grams(masses.brackets_g)),
        ("Screws, inserts and bolts", grams(masses.fasteners_g)),
        ("Rods", grams(masses.rods_g)),
        ("Glue", grams(masses.glue_g)),
        ("Ballast", grams(masses.ballast_g)),
        ("The whole", grams(sheet.mass_g)),
        ("Its centre of mass", point(sheet.centre_mm)),
        (
            "Solid down to the base, by the supplement to CofiFab (2016)",
            grams(masses.paper_g),
        ),
        (
            "The centre by the supplement",
            point(masses.paper_centre_mm),
        ),
    ];
    table("Mass", ["Thing", "Figure"], &rows)
}

/// Returns where the volume of the model goes.
fn volume(sheet: &CoreSheet) -> Markup {
    let shell = sheet.parts.iter();
    let shell = shell.filter(|part| part.kind == CorePartKind::Shell);
    let total = |of: fn(&CorePartPromise) -> f64| shell.clone().map(of).sum::<f64>();
    let (hollows, bores) = (total(|part| part.void_mm3), total(|part| part.bores_mm3));
    let (pins, sockets) = (
        total(|part| part.pins_mm3[0]),
        total(|part| part.pins_mm3[1]),
    );
    let printed = sheet.masses.shell_g / sheet.material.density_g_cm3 * MM3_PER_CM3;
    let whole = sheet.model.volume_mm3;
    let share = |mm3: f64| {
        format!(
            "{} ({})",
            quantity(mm3 / MM3_PER_CM3, "cm³"),
            quantity(100.0 * mm3 / whole, "%")
        )
    };
    let rows = [
        ("The model", share(whole)),
        ("Printed parts without their pins", share(printed - pins)),
        ("Their sockets for pins", share(sockets)),
        ("Their hollows", share(hollows)),
        ("Their bores", share(bores)),
        (
            "The rest: the base with the gap around it, and what marks take",
            share(whole - (printed - pins) - sockets - hollows - bores),
        ),
        ("The base", share(sheet.base.volume_mm3)),
    ];
    table("Volume", ["Region", "Volume"], &rows)
}

fn table(title: &str, heads: [&str; 2], rows: &[(&str, String)]) -> Markup {
    html! {
        section {
            h2 { (title) }
            table {
                thead { tr { th scope="col" { (heads[0]) } th scope="col" class="n" { (heads[1]) } } }
                tbody {
                    @for (name, figure) in rows {
                        tr { th scope="row" { (name) } td class="n" { (figure) } }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_proof_that_moves_no_face_and_costs_nothing_is_told_as_such() {
        let still = proof_of_faces([5.0, 5.0], 0.0);
        assert!(
            still.contains("the faces alone prove 5\u{a0}mm. So no face"),
            "{still}"
        );
        let moved = proof_of_faces([5.0, -1.0], 6.0);
        assert!(moved.contains("by up to 6\u{a0}mm"), "{moved}");
        assert_eq!(proof_cost(4.0), "That cost 4\u{a0}% of its volume.");
        let gained = proof_cost(-0.4);
        assert!(gained.contains("hold 0.4\u{a0}% more"), "{gained}");
    }
}
