//! The rows of the written parts.

use rayon::prelude::*;

use super::facts::Facts;
use super::finished::cup_mm3;
use super::hardware::{half_of, halves};
use super::promise::{infill_order, mark, pin, socket};
use super::support::{Surfaces, support_row};
use crate::base::digest::sha256_hex;
use crate::cut::Lie;
use crate::geom::Vector;
use crate::run::{Placed, WrittenPart};
use crate::sheet::{PartRow, part_picture_file};
use crate::verify::{Fingerprint, PartFacts, Peg};

/// The process whose parts are printed against a film.
const VAT: &str = "sla";

/// Least vertical component of the normal of a level face: within 0.8°.
const LEVEL_COSINE: f64 = 0.9999;

/// Returns a row for each part.
pub fn part_rows(facts: &Facts) -> Vec<PartRow> {
    let halves = halves(facts.placed);
    let surfaces = Surfaces::of(facts.made);
    let is_vat = is_printed_in_vat(facts.placed);
    let wall_mm = facts.placed.minimum_wall_mm();
    let infill = infill_order(facts.placed, facts.made);
    let parts = facts.made.parts.par_iter().zip(&facts.judgement.parts);
    let row = |(written, measured): (&WrittenPart, &PartFacts)| {
        let (part, plan) = (&written.part, &facts.made.plan);
        let pins: Vec<Peg> = part.pins.iter().map(|site| pin(site, plan)).collect();
        let sockets = part.sockets.iter().map(|site| socket(site, plan));
        let sockets: Vec<Peg> = sockets.collect();
        let volume_mm3 = measured.surface.volume_mm3;
        let infill = infill.as_ref().filter(|_| written.sparse.is_some());
        let density_g_cm3 = facts.placed.density_g_cm3();
        let infill_g = infill.map_or(0.0, |infill| infill.extra_g(density_g_cm3));
        PartRow {
            id: part.id.to_string(),
            file: written.file.clone(),
            sha256: sha256_hex(&[&written.bytes]),
            fingerprint: Some(Fingerprint::of(&written.read_back)),
            triangles: measured.surface.triangles,
            volume_mm3,
            mass_g: volume_mm3 * facts.placed.shop.material.density_g_mm3() + infill_g,
            size_mm: measured.size_mm,
            lies: pose_words(written, facts),
            print_from_model: written.evidence().pose,
            support: support_row(facts.placed, &surfaces, written, [&pins, &sockets]),
            pins,
            sockets,
            marks: part.labels.iter().map(mark).collect(),
            half: half_of(written, &halves),
            cup_mm3: if is_vat {
                cup_mm3(&written.read_back, wall_mm)
            } else {
                0.0
            },
            drains_over: if is_vat {
                drains(written, facts)
            } else {
                Vec::new()
            },
            picture: Some(part_picture_file(&part.id.to_string())),
        }
    };
    parts.map(row).collect()
}

/// Returns whether parts are printed in a vat, against a film.
pub fn is_printed_in_vat(placed: &Placed) -> bool {
    placed.shop.printer.process.as_deref() == Some(VAT)
}

/// Returns the cuts of a part through which its open hollow drains: those that open a void of it.
fn drains(written: &WrittenPart, facts: &Facts) -> Vec<String> {
    let plan = &facts.made.plan;
    let opens = |cut: &&crate::cut::Cut| {
        let mut voids = plan.voids.iter();
        voids
            .any(|void| written.part.voids.contains(&void.void) && void.opened_by.contains(&cut.id))
    };
    let cuts = plan.cuts_of(written.part.id).filter(opens);
    cuts.map(|cut| cut.id.to_string()).collect()
}

/// Words the pose of a part on the plate: the cut faces that look down or up.
fn pose_words(written: &WrittenPart, facts: &Facts) -> String {
    if written.part.pose.lies == Lie::InnerEndDown {
        return "narrow end down".to_owned();
    }
    let pose = written.evidence().pose;
    let center = written.part.solid.mesh().aabb().center();
    let facing = |cut: &crate::cut::Cut| {
        let plane = cut.plane().ok()?;
        let outward: Vector = -plane.normal * plane.distance(&center).signum();
        match (pose.rotation() * outward).z {
            z if z < -LEVEL_COSINE => Some(format!("cut face {} down", cut.id)),
            z if z > LEVEL_COSINE => Some(format!("cut face {} up", cut.id)),
            _ => None,
        }
    };
    let facing: Vec<String> = facts
        .made
        .plan
        .cuts_of(written.part.id)
        .filter_map(facing)
        .collect();
    if facing.is_empty() {
        let up = facts.placed.placement.goal.frame.axis();
        match (pose.rotation() * up).z {
            z if z > LEVEL_COSINE => "as the model stands".to_owned(),
            z if z < -LEVEL_COSINE => "upside down".to_owned(),
            _ => "leaning, as in the picture".to_owned(),
        }
    } else {
        facing.join(", ")
    }
}
