//! The checklist of an object on a base, from what was asked and made.

use std::collections::{BTreeMap, BTreeSet};

use super::advise::toppling_deg;
use super::asked::Asked;
use super::files::{cut_sheets, joint_word};
use super::home::home_panel;
use super::made::{Made, WrittenPart};
use super::mass::{Weighed, paper_estimate};
use super::units::{joins, units};
use crate::base::digest::sha256_hex;
use crate::base::sourced::Sure;
use crate::cladding::{HAND_MM2, Holding};
use crate::cutter::CutterNumber;
use crate::job::base_choice::Polyhedra;
use crate::job::core_kit::CoreShell;
use crate::mass::moments_of_mesh;
use crate::mesh::{TriMesh, surface_mm2};
use crate::polyhedra::{Breach, LimitKind};
use crate::sheet::Verdict;
use crate::sheet::core_kit::{
    BaseRow, BuyRow, CORE_SHEET_SCHEMA, CoreMaterialRow, CoreModelRow, CorePartRow, CorePrinterRow,
    CoreSheet, CutSheetRow, CutterRow, MassRow, PolyhedronRow, SheetRow,
};
use crate::verify::{CorePartPromise, CutPromise, PrinterLimits};

/// Returns the checklist, but for its checks and the hashes of other files.
pub fn checklist(asked: &Asked, made: &Made, weighed: &Weighed) -> CoreSheet {
    let goal = asked.goal.as_ref();
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
        cut_sheets: cut_sheets(made),
        sheet_rows: sheet_rows(asked, made),
        parts: made.parts.iter().map(promise).collect(),
        part_rows: part_rows(asked, made),
        fasteners: weighed.fasteners.clone(),
        glue: weighed.glue.clone(),
        units: units(made),
        joins: joins(made),
        buy: buy(asked, made, weighed),
        up: asked.up.into(),
        mass_g: weighed.mass_g(),
        masses: masses(asked, made, weighed),
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
    }
}

fn sheet(asked: &Asked) -> SheetRow {
    let (cutter, sheet) = (&asked.shop.cutter, &asked.shop.sheet);
    let kerf_mm = asked.shop.kerf.kerf_mm;
    let spacing_mm = cutter.spacing_mm(kerf_mm);
    let margin = cutter.numbers.get(&CutterNumber::MarginMm);
    SheetRow {
        id: sheet.id.clone(),
        name: sheet.name.clone(),
        cut: CutPromise {
            thickness_mm: sheet.thickness_mm.value,
            density_g_cm3: sheet.density_g_cm3.value,
            offset_kerf_mm: cutter.offset_mm(kerf_mm),
            spacing_mm,
            margin_mm: margin.map_or(spacing_mm, |margin| margin.value.max(spacing_mm)),
        },
        thickness_source: sheet.thickness_mm.provenance(),
    }
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

fn sheet_rows(asked: &Asked, made: &Made) -> Vec<CutSheetRow> {
    let kerfs = asked.shop.cutter.kerfs.iter();
    let own = kerfs.filter(|kerf| kerf.material == asked.shop.sheet.material);
    let thickness_mm = asked.shop.sheet.thickness_mm.value;
    let off = |at_mm: f64| (at_mm - thickness_mm).abs();
    let nearest = own.min_by(|a, b| off(a.thickness_mm).total_cmp(&off(b.thickness_mm)));
    let speed = nearest.and_then(|kerf| kerf.speed_mm_s);
    let sheets = made.built.sheets.iter().map(|sheet| sheet.figures());
    sheets
        .map(|figures| CutSheetRow {
            sheet_ratio: figures.sheet_ratio,
            used_ratio: figures.used_ratio,
            cut_mm: figures.cut_mm,
            pierces: figures.pierces,
            engraved_mm: figures.engraved_mm,
            cut_s: speed.map(|speed| figures.cut_mm / speed),
        })
        .collect()
}

fn promise(part: &WrittenPart) -> CorePartPromise {
    CorePartPromise {
        id: part.id.clone(),
        kind: part.kind,
        panel: part.panel,
        file: part.file.clone(),
        sha256: sha256_hex(&[&part.bytes]),
        print_from_model: part.pose,
        void_mm3: part.void_mm3,
        bores_mm3: part.bores_mm3,
        cuts: part.cuts.clone(),
        bosses: part.bosses.clone(),
    }
}

fn part_rows(asked: &Asked, made: &Made) -> Vec<CorePartRow> {
    let shell = &made.built.shell;
    let rows = made.parts.iter().enumerate().map(|(index, part)| {
        let held_by = match shell.parts.get(index).map(|part| part.holding) {
            Some(Holding::Panel { .. }) => {
                let screws = shell.screws.iter().find(|screws| screws.part == index);
                let count = screws.map_or(0, |screws| screws.screws.len());
                match count {
                    0 => format!("glue on panel {}", part.panel),
                    1 => format!("a screw through panel {}, and glue", part.panel),
                    count => format!("{count} screws through panel {}", part.panel),
                }
            }
            Some(Holding::Pinned { to, .. }) => format!("glue on {}", made.names.parts[to]),
            Some(Holding::Nothing) => "nothing".to_owned(),
            None => bracket_words(made, index - shell.parts.len()).to_owned(),
        };
        let lies = match (part.lies_on_panel_side, shell.parts.get(index)) {
            (true, _) => "panel side down",
            (false, Some(_)) => "as in its file",
            (false, None) => "on its side",
        };
        CorePartRow {
            id: part.id.clone(),
            lies: lies.to_owned(),
            held_by,
            size_mm: part.read_back.aabb().size().into(),
            mass_g: moments_of_mesh(&part.read_back).volume() * asked.print_g_mm3(),
        }
    });
    rows.collect()
}

/// Words what holds a bracket.
fn bracket_words(made: &Made, bracket: usize) -> &'static str {
    let built = &made.built;
    let home = home_panel(&built.plan, &built.shell, &built.brackets[bracket]);
    if home.is_screwed {
        "2 screws, and glue on the other panel"
    } else {
        "glue on both panels"
    }
}

fn buy(asked: &Asked, made: &Made, weighed: &Weighed) -> Vec<BuyRow> {
    let sizes: BTreeSet<String> = made
        .built
        .sheets
        .iter()
        .map(|sheet| sheet.nested.size_mm)
        .map(|[length, width]| format!("{length} × {width} mm"))
        .collect();
    let sheets = sizes.into_iter().map(|size| {
        let own = made.built.sheets.iter();
        let own = own.filter(|sheet| {
            let [length, width] = sheet.nested.size_mm;
            format!("{length} × {width} mm") == size
        });
        BuyRow {
            id: asked.shop.sheet.id.clone(),
            name: format!("{}, {size}", asked.shop.sheet.name),
            count: own.count(),
        }
    });
    let ids: BTreeSet<&String> = weighed.fasteners.iter().map(|one| &one.id).collect();
    let fasteners = ids.into_iter().map(|id| {
        let mut stock = asked.shop.fasteners.iter();
        let name = stock.find(|one| one.id == *id).map(|one| one.name.clone());
        BuyRow {
            id: id.clone(),
            name: name.unwrap_or_default(),
            count: weighed.fasteners.iter().filter(|one| one.id == *id).count(),
        }
    });
    sheets.chain(fasteners).collect()
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
        glue_g: weighed.glue_g,
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
        Some(format!(
            "no hand passes the open side of polyhedron {}, panel {panel}: glue its nuts to their \
             panel on the bench, or hold them by long pliers",
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
