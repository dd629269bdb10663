//! The checklist of an object on a base, from what was asked and made.

use std::collections::BTreeMap;

use super::asked::{Asked, margin_mm};
use super::ballast_rows::{ballast_edges, ballast_panel, ballast_rows};
use super::estimates::estimates;
use super::files::{cut_sheets, joint_word};
use super::hardware::pins;
use super::made::Made;
use super::mass::{Weighed, paper_estimate, toppling_deg};
use super::rows::{buy, part_rows, promise, sheet_rows};
use super::units::{joins, units};
use crate::base::sourced::Sure;
use crate::cladding::{HAND_MM2, Holding};
use crate::job::base_choice::Polyhedra;
use crate::job::core_kit::CoreShell;
use crate::mesh::{TriMesh, surface_mm2};
use crate::polyhedra::{Breach, LimitKind};
use crate::sheet::Verdict;
use crate::sheet::core_kit::{
    BaseRow, CORE_SHEET_SCHEMA, CoreMaterialRow, CoreModelRow, CorePrinterRow, CoreSheet,
    CutterRow, MassRow, PolyhedronRow, SheetRow, VerticesRow,
};
use crate::verify::{CutPromise, PrinterLimits, StockPromise};

/// Returns the checklist, but for its checks and the hashes of other files.
pub fn checklist(asked: &Asked, made: &Made, weighed: &Weighed) -> CoreSheet {
    let goal = asked.goal.as_ref();
    let ballast_edges = ballast_edges(made, weighed);
    let masses = masses(asked, made, weighed);
    CoreSheet {
        schema: CORE_SHEET_SCHEMA,
        kind: "core",
        job: asked.job.name(),
        version: env!("CARGO_PKG_VERSION"),
        verdict: Verdict::Fail,
        model: model(asked),
        printer: printer(asked),
        material: material(asked),
        cutter: cutter(asked),
        sheet: sheet(asked),
        base: base(asked, made),
        wall_mm: asked.wall_mm,
        is_solid: asked.job.shell == CoreShell::Solid,
        distance_mm: asked.base.distance_mm,
        gap_mm: asked.gap_mm,
        stock: stock_rows(asked),
        cut_sheets: cut_sheets(made),
        sheet_rows: sheet_rows(asked, made),
        parts: made.parts.iter().map(promise).collect(),
        part_rows: part_rows(asked, made),
        fasteners: weighed.fasteners.clone(),
        rods: weighed.rods.clone(),
        pins: pins(made),
        glue: weighed.glue.clone(),
        ballast: weighed.ballast.clone(),
        ballast_panel_mm: ballast_panel(made, weighed),
        ballast_rows: ballast_rows(&ballast_edges, weighed),
        ballast_edges,
        units: units(made),
        joins: joins(made),
        buy: buy(asked, made, weighed),
        up: asked.up.into(),
        mass_g: weighed.mass_g(),
        estimates: estimates(asked, made, &masses),
        masses,
        centre_mm: weighed.center().into(),
        toppling_deg: goal.map(|goal| toppling_deg(goal, weighed)),
        least_angle_deg: goal.map(|_| asked.job.least_angle_deg),
        warnings: warnings(asked, made),
        checks: Vec::new(),
        files: BTreeMap::new(),
    }
}

fn model(asked: &Asked) -> CoreModelRow {
    CoreModelRow {
        source: asked.job.in_kit().model.path.display().to_string(),
        sha256: asked.job.model.sha256.clone(),
        size_mm: asked.ground.solid().mesh().aabb().size().into(),
        volume_mm3: asked.ground.volume_mm3(),
    }
}

fn printer(asked: &Asked) -> CorePrinterRow {
    let printer = &asked.shop.printer;
    let scale = printer.print_scale_ratio();
    CorePrinterRow {
        id: printer.id.clone(),
        name: printer.name.clone(),
        layer_mm: printer.layer_mm.value,
        glue: printer.glue.clone(),
        glue_safety: printer.glue_safety.clone(),
        limits: PrinterLimits {
            process: printer.process.clone(),
            build_volume_mm: printer.usable_volume_mm(),
            print_scale_ratio: (scale != [1.0; 3]).then_some(scale),
            minimum_wall_mm: printer.min_wall_mm.value,
            ..PrinterLimits::default()
        },
    }
}

fn material(asked: &Asked) -> CoreMaterialRow {
    let material = &asked.shop.material;
    CoreMaterialRow {
        id: material.id.clone(),
        name: material.name.clone(),
        density_g_cm3: material.density_g_cm3.value,
    }
}

fn cutter(asked: &Asked) -> CutterRow {
    let (cutter, kerf) = (&asked.shop.cutter, &asked.shop.kerf);
    CutterRow {
        id: cutter.id.clone(),
        name: cutter.name.clone(),
        kerf_mm: kerf.kerf_mm,
        kerf_source: kerf.provenance.clone(),
        is_kerf_measured: kerf.sure == Sure::Measured,
        compensates_kerf: cutter.compensates_kerf.value,
        bed_mm: cutter.bed_mm.value,
    }
}

fn sheet(asked: &Asked) -> SheetRow {
    let (cutter, sheet) = (&asked.shop.cutter, &asked.shop.sheet);
    let kerf_mm = asked.shop.kerf.kerf_mm;
    let spacing_mm = cutter.spacing_mm(kerf_mm);
    SheetRow {
        id: sheet.id.clone(),
        name: sheet.name.clone(),
        cut: CutPromise {
            thickness_mm: sheet.thickness_mm.value,
            density_g_cm3: sheet.density_g_cm3.value,
            offset_kerf_mm: cutter.offset_mm(kerf_mm),
            spacing_mm,
            margin_mm: margin_mm(asked.shop),
            keeps_grain: asked.keeps_grain,
        },
        thickness_source: sheet.thickness_mm.provenance(),
    }
}

fn stock_rows(asked: &Asked) -> Vec<StockPromise> {
    let stock = asked.stock.iter().map(|stock| StockPromise {
        size_mm: stock.size_mm,
        count: stock.count,
        is_turned: stock.is_turned,
    });
    stock.collect()
}

fn base(asked: &Asked, made: &Made) -> BaseRow {
    let plan = &made.built.plan;
    let edges = &made.built.shell.panels.edges;
    let count = |word: &str| {
        let own = edges.iter().filter(|edge| joint_word(&edge.joint) == word);
        own.count()
    };
    BaseRow {
        panels: made.built.shell.panels.panels.len(),
        vertices: made.built.vertices.map(|of| VerticesRow {
            start: of.start.word(),
            volume_mm3: of.volume_mm3,
            sampled_mm: of.sampled_mm,
            certified_mm: of.certified_mm,
            moved_mm: of.moved_mm,
        }),
        polyhedra: polyhedra(made),
        volume_mm3: plan.volume_mm3(),
        volume_ratio: plan.volume_mm3() / asked.ground.volume_mm3(),
        panels_mm2: made.built.sheets.iter().map(|sheet| sheet.panels_mm2).sum(),
        finger_edges: count("fingers"),
        bracket_edges: count("brackets"),
        glued_edges: count("glue"),
    }
}

/// Returns the rows of several polyhedra; none for one.
fn polyhedra(made: &Made) -> Vec<PolyhedronRow> {
    let plan = &made.built.plan;
    let panels = &made.built.shell.panels.panels;
    let assembly = &made.built.shell.assembly;
    let last = &assembly.order[assembly.order.len() - assembly.last..];
    let all = plan.polyhedra.iter().enumerate();
    let several = all.filter(|_| plan.polyhedra.len() > 1);
    let rows = several.map(|(index, body)| {
        let own = plan.faces_before(index)..plan.faces_before(index + 1);
        let number = |face: usize| panels.iter().position(|panel| panel.face == face);
        let mut closing = last.iter().map(|&unit| &assembly.units[unit]);
        let closing = closing.find(|unit| unit.polyhedron == index && unit.has_panel);
        PolyhedronRow {
            panels: own.clone().filter_map(number).map(|at| at + 1).collect(),
            volume_mm3: body.volume_mm3(),
            closed_by: closing.and_then(|unit| number(unit.face)).map(|at| at + 1),
        }
    });
    rows.collect()
}

fn masses(asked: &Asked, made: &Made, weighed: &Weighed) -> MassRow {
    let model = asked.ground.solid().mesh();
    let densities = [asked.print_g_mm3(), asked.shop.sheet.mass_per_area_g_mm2()];
    let bodies = made.built.plan.polyhedra.iter();
    let bodies = bodies.filter_map(|body| body.mesh().ok());
    let base = bodies.fold(TriMesh::default(), |all, body| all.joined(&body));
    let (paper_g, paper_centre) = paper_estimate(model, &base, densities);
    MassRow {
        shell_g: weighed.shell_g,
        panels_g: weighed.panels_g,
        brackets_g: weighed.brackets_g,
        fasteners_g: weighed.fasteners_g,
        rods_g: weighed.rods_g,
        glue_g: weighed.glue_g,
        ballast_g: weighed.ballast_g,
        paper_g,
        paper_centre_mm: paper_centre.into(),
        if_solid_g: asked.ground.volume_mm3() * asked.print_g_mm3(),
        if_skin_g: surface_mm2(model) * asked.wall_mm * asked.print_g_mm3(),
    }
}

fn warnings(asked: &Asked, made: &Made) -> Vec<String> {
    let mut warnings = asked.warnings.clone();
    warnings.push(
        "glue, screws and brackets hold the base together: it does not lock by its shape"
            .to_owned(),
    );
    let bodies = &made.built.plan.polyhedra;
    warnings.extend(bodies.iter().flat_map(|body| body.breaches()).map(breach));
    warnings.extend(narrow(made));
    let wanted = asked.job.polyhedra;
    if asked.job.base.is_none() && wanted != Polyhedra::Auto && bodies.len() < wanted.most() {
        warnings.push(format!(
            "the base has {} of {wanted} polyhedra: no plane leaves room for one more",
            bodies.len()
        ));
    }
    let shell = &made.built.shell;
    let parts = shell.parts.iter().enumerate();
    let unheld = parts.filter(|(_, part)| part.holding == Holding::Nothing);
    let unheld: Vec<&str> = unheld
        .map(|(at, _)| made.names.parts[at].as_str())
        .collect();
    if !unheld.is_empty() {
        let names = unheld.join(", ");
        warnings.push(format!(
            "{names} touch nothing in a face: hold them by hand while gluing"
        ));
    }
    if asked.shop.kerf.sure != Sure::Measured {
        warnings.push(format!(
            "the cut's width of {:.3} mm was not measured on this machine: cut its coupon first",
            asked.shop.kerf.kerf_mm
        ));
    }
    warnings
}

/// Names the polyhedra, of several, whose open side is narrower than a hand.
fn narrow(made: &Made) -> Vec<String> {
    let panels = &made.built.shell.panels.panels;
    let area_mm2 = |number: usize| {
        let face = panels.get(number - 1).map(|panel| panel.face);
        let face = face.and_then(|face| made.built.plan.face(face));
        face.map_or(0.0, |face| face.area_mm2)
    };
    let rows = polyhedra(made).into_iter().enumerate();
    let narrow = rows.filter_map(|(index, row)| {
        let panel = row.closed_by.filter(|panel| area_mm2(*panel) < HAND_MM2)?;
        let bolts = made.built.bolts.iter();
        let mut joined = bolts.map(|bolt| made.built.plan.connections[bolt.connection].polyhedra);
        let help = if joined.any(|pair| pair.contains(&index)) {
            "glue its nuts to their panel on the bench, or hold them by long pliers"
        } else {
            "put glue about its rods by a long brush"
        };
        Some(format!(
            "no hand passes the open side of polyhedron {}, panel {panel}: {help}",
            index + 1
        ))
    });
    narrow.collect()
}

/// Words a limit that the base breaks.
fn breach(breach: &Breach) -> String {
    let (found, asked, unit) = match breach.kind {
        LimitKind::Flat | LimitKind::Sharp => {
            (breach.found.to_degrees(), breach.asked.to_degrees(), "°")
        }
        _ => (breach.found, breach.asked, " mm"),
    };
    format!(
        "the base breaks the limit of the {}: {found:.1}{unit}, and {asked:.1}{unit} were asked for",
        breach.kind
    )
}
