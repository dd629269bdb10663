//! The rows of the checklist: sheets, parts, and what is bought.

use std::collections::BTreeSet;

use super::asked::Asked;
use super::hardware::EPOXY_FILM_MM;
use super::home::home_panel;
use super::made::{Made, WrittenPart};
use super::mass::Weighed;
use super::rods::buy_rods;
use crate::base::digest::sha256_hex;
use crate::base::units::{MM3_PER_CM3, format_count};
use crate::cladding::Holding;
use crate::cutting::CutSheet;
use crate::mass::moments_of_mesh;
use crate::sheet::core_kit::{BALLAST_GLUE, BuyRow, CorePartRow, CutSheetRow};
use crate::verify::CorePartPromise;

/// Returns the figures of all sheets.
pub fn sheet_rows(asked: &Asked, made: &Made) -> Vec<CutSheetRow> {
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

/// Returns what is promised of a part.
pub fn promise(part: &WrittenPart) -> CorePartPromise {
    CorePartPromise {
        id: part.id.clone(),
        kind: part.kind,
        panel: part.panel,
        file: part.file.clone(),
        sha256: sha256_hex(&[&part.bytes]),
        print_from_model: part.pose,
        void_mm3: part.void_mm3,
        bores_mm3: part.bores_mm3,
        pins_mm3: part.pins_mm3,
        cuts: part.cuts.clone(),
        bosses: part.bosses.clone(),
    }
}

/// Returns what the shop needs to know of each part.
pub fn part_rows(asked: &Asked, made: &Made) -> Vec<CorePartRow> {
    let shell = &made.built.shell;
    let rows = made.parts.iter().enumerate().map(|(index, part)| {
        let held_by = match shell.parts.get(index) {
            Some(_) => held_by(made, index),
            None => bracket_words(made, index - shell.parts.len()),
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

/// Words the size of a sheet, and whether it is one of the offcuts at hand.
fn size_words(sheet: &CutSheet) -> String {
    let [length, width] = sheet.nested.size_mm;
    let offcut = if sheet.nested.is_offcut {
        " (an offcut at hand)"
    } else {
        ""
    };
    format!("{length} × {width} mm{offcut}")
}

/// Returns the pieces of ballast, all of one kind, and their glue.
fn ballast(weighed: &Weighed) -> Option<[BuyRow; 2]> {
    let first = weighed.ballast.first()?;
    let radii = weighed
        .ballast
        .iter()
        .map(|piece| piece.lump.shape.radius_mm());
    let area_mm2: f64 = radii
        .map(|radius| std::f64::consts::PI * radius.powi(2))
        .sum();
    let glue_ml = (area_mm2 * EPOXY_FILM_MM / MM3_PER_CM3).ceil();
    let name = crate::ballast::find(&first.id).map_or_else(|_| first.id.clone(), |part| part.name);
    let pieces = BuyRow {
        id: first.id.clone(),
        name,
        count: weighed.ballast.len(),
    };
    let glue = BuyRow {
        id: "epoxy".to_owned(),
        name: format!("{BALLAST_GLUE} for metal and wood, at least {glue_ml} ml"),
        count: 1,
    };
    Some([pieces, glue])
}

/// Words what holds a part of the shell.
fn held_by(made: &Made, index: usize) -> String {
    let shell = &made.built.shell;
    let panel = made.names.panels[index];
    let screws = shell.screws.iter().find(|screws| screws.part == index);
    let pins = |to: usize| {
        let joints = shell.pins.iter();
        let own = joints.filter(|pins| pins.parts.contains(&index) && pins.parts.contains(&to));
        own.map(|pins| pins.sites.len()).sum::<usize>()
    };
    match shell.parts[index].holding {
        Holding::Panel { .. } => match screws.map_or(0, |screws| screws.screws.len()) {
            0 => format!("glue on panel {panel}"),
            1 => format!("a screw through panel {panel}, and glue"),
            count => format!("{count} screws through panel {panel}"),
        },
        Holding::Pinned { to, .. } => match (pins(to), &made.names.parts[to]) {
            (0, name) => format!("glue alone on {name}"),
            (count, name) => format!("{} and glue on {name}", format_count(count, "pin")),
        },
        Holding::Nothing => "nothing".to_owned(),
    }
}

/// Words what holds a bracket.
fn bracket_words(made: &Made, bracket: usize) -> String {
    let built = &made.built;
    let bracket = &built.brackets[bracket];
    let home = home_panel(&built.plan, &built.shell, bracket);
    let panels = built.shell.panels.edges[bracket.edge].panels;
    let [own, other] = [panels[home.flange], panels[1 - home.flange]].map(|panel| panel + 1);
    if home.is_screwed {
        format!("2 screws on panel {own}, and glue on panel {other}")
    } else {
        format!("glue on panels {own} and {other}")
    }
}

/// Returns what is bought: sheets by their sizes, fasteners, rods and ballast.
pub fn buy(asked: &Asked, made: &Made, weighed: &Weighed) -> Vec<BuyRow> {
    let sizes: BTreeSet<String> = made.built.sheets.iter().map(size_words).collect();
    let sheets = sizes.into_iter().map(|size| {
        let own = made.built.sheets.iter();
        BuyRow {
            id: asked.shop.sheet.id.clone(),
            name: format!("{}, {size}", asked.shop.sheet.name),
            count: own.filter(|sheet| size_words(sheet) == size).count(),
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
    let ballast = ballast(weighed).into_iter().flatten();
    sheets
        .chain(fasteners)
        .chain(buy_rods(made))
        .chain(ballast)
        .collect()
}
