//! Panels as drawings for a cutter: a judge of other people reads both files of every sheet.

use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

use equipoise::cutter::{Cutter, StockSheet};
use equipoise::cutting::{CutSheet, SheetError, SheetOrder, cut_sheets};
use equipoise::io::{encode_cut_svg, encode_dxf};
use equipoise::panels::{JointStyle, PanelRequest, PanelSet, Stock};
use serde_json::{Value, json};

use super::{cube, cuboctahedron, dodecahedron, octahedron, regular, request, tetrahedron};

const JUDGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_sheets.py");

/// Returns `EQUIPOISE_JUDGE_PYTHON`, or `python3`; `None`, with a message, if it lacks a package.
fn find_python() -> Option<OsString> {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let mut command = Command::new(&python);
    let output = command.args(["-c", "import ezdxf, shapely"]).output();
    let has_packages = output.is_ok_and(|output| output.status.success());
    if !has_packages {
        println!("SKIPPED: no Python with ezdxf and shapely here; pip install them");
    }
    has_packages.then_some(python)
}

/// A base to be cut, and what it is cut from.
struct Shop {
    cutter: Cutter,
    sheet: StockSheet,
    stock: Vec<Stock>,
}

impl Shop {
    fn of(cutter: &str, sheet: &str) -> Self {
        Self {
            cutter: Cutter::find(cutter).unwrap(),
            sheet: StockSheet::find(sheet).unwrap(),
            stock: Vec::new(),
        }
    }

    fn order(&self) -> SheetOrder<'_> {
        SheetOrder {
            cutter: &self.cutter,
            sheet: &self.sheet,
            stock: &self.stock,
            keeps_grain: false,
        }
    }

    fn kerf_mm(&self) -> f64 {
        self.cutter.check_sheet(&self.sheet).unwrap().kerf_mm
    }

    /// Writes the sheets, and what is promised of them.
    fn write(&self, folder: &Path, set: &PanelSet, sheets: &[CutSheet]) {
        let kerf_mm = self.kerf_mm();
        let panels = sheets.iter().enumerate().flat_map(|(index, sheet)| {
            let placements = sheet.nested.placements.iter();
            placements.map(move |at| {
                let panel = &set.panels[at.panel];
                let holes: Vec<f64> = panel.holes.iter().map(|hole| hole.diameter_mm).collect();
                json!({
                    "sheet": index + 1,
                    "area_mm2": panel.outline.area_mm2(),
                    "holes_mm": holes,
                    "inner_corners": panel.outline.corners().len(),
                })
            })
        });
        let promised = json!({
            "kerf_mm": self.cutter.offset_mm(kerf_mm),
            "spacing_mm": self.cutter.spacing_mm(kerf_mm),
            "margin_mm": self.cutter.spacing_mm(kerf_mm),
            "panels": panels.collect::<Vec<Value>>(),
        });
        std::fs::write(folder.join("sheets.json"), promised.to_string()).unwrap();
        for (index, sheet) in sheets.iter().enumerate() {
            let drawing = sheet.drawing(self.cutter.dialect);
            let path = |kind: &str| folder.join(format!("sheet-{}.{kind}", index + 1));
            std::fs::write(path("dxf"), encode_dxf(&drawing)).unwrap();
            std::fs::write(path("svg"), encode_cut_svg(&drawing)).unwrap();
        }
    }
}

/// Lets the judge look at a folder; returns its exit code and what it printed.
fn judge(python: &OsString, folder: &Path) -> (Option<i32>, String) {
    let mut command = Command::new(python);
    let command = command.env("PYTHONDONTWRITEBYTECODE", "1").arg(JUDGE);
    let output = command.arg(folder).output().unwrap();
    let printed = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8(printed).unwrap())
}

fn panels_for(shop: &Shop, normals: &[equipoise::geom::Vector], joints: JointStyle) -> PanelSet {
    let request = PanelRequest {
        sheet_mm: shop.sheet.thickness_mm.value,
        ..request(joints)
    };
    PanelSet::of(&regular(normals), &request).unwrap()
}

#[test]
fn a_judge_of_other_people_finds_every_panel_on_its_sheet_as_wide_as_promised() {
    let Some(python) = find_python() else { return };
    let bodies = [
        cube(),
        tetrahedron(),
        octahedron(),
        dodecahedron(),
        cuboctahedron(),
    ];
    let shops = [
        ("makerspace-900x600", "birch-5"),
        ("speedy-400", "acrylic-3"),
    ];
    for (cutter, sheet) in shops {
        let shop = Shop::of(cutter, sheet);
        for (index, normals) in bodies.iter().enumerate() {
            for joints in [JointStyle::Auto, JointStyle::Brackets] {
                let set = panels_for(&shop, normals, joints);
                let sheets = match cut_sheets(&set, &shop.order()) {
                    Err(SheetError::Nest(_)) => continue,
                    sheets => sheets.unwrap(),
                };
                let folder = tempfile::tempdir().unwrap();
                shop.write(folder.path(), &set, &sheets);
                let (code, said) = judge(&python, folder.path());
                let name = format!("{cutter}, body {index}, {joints:?}");
                assert_eq!(code, Some(0), "{name}: {said}");
                hold_figures(&sheets, &said, &name);
            }
        }
    }
}

/// Holds our own figures of sheets against those that the judge measured.
fn hold_figures(sheets: &[CutSheet], said: &str, name: &str) {
    let measured: Vec<Value> = serde_json::from_str(said).unwrap();
    assert_eq!(measured.len(), sheets.len());
    for (sheet, measured) in sheets.iter().zip(&measured) {
        let figures = sheet.figures();
        let number = |key: &str| measured[key].as_f64().unwrap();
        for (ours, theirs) in [
            (figures.cut_mm, number("cut_mm")),
            (figures.engraved_mm, number("engraved_mm")),
            (sheet.panels_mm2, number("area_mm2")),
        ] {
            assert!(
                (ours - theirs).abs() < 1e-4 * theirs + 1e-3,
                "{name}: {ours} {theirs}"
            );
        }
        let whole_mm2 = sheet.nested.size_mm[0] * sheet.nested.size_mm[1];
        assert!((figures.sheet_ratio * whole_mm2 - number("area_mm2")).abs() < 1e-3);
        assert!(figures.used_ratio >= figures.sheet_ratio && figures.used_ratio < 1.0);
    }
}

#[test]
fn the_judge_finds_a_panel_that_is_cut_on_its_line_and_one_that_lies_too_near() {
    let Some(python) = find_python() else { return };
    let shop = Shop::of("makerspace-900x600", "birch-5");
    let set = panels_for(&shop, &cube(), JointStyle::Auto);
    let sheets = cut_sheets(&set, &shop.order()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    shop.write(folder.path(), &set, &sheets);
    let path = folder.path().join("sheets.json");
    let promised = std::fs::read_to_string(&path).unwrap();
    let mut wrong: Value = serde_json::from_str(&promised).unwrap();
    wrong["kerf_mm"] = json!(0.0);
    wrong["spacing_mm"] = json!(12.0);
    std::fs::write(&path, wrong.to_string()).unwrap();
    let (code, said) = judge(&python, folder.path());
    assert_eq!(code, Some(1));
    assert!(
        said.contains("mm², not") && said.contains("mm apart"),
        "{said}"
    );
}

#[test]
fn offcuts_are_used_first_and_a_sheet_without_a_size_is_refused() {
    let mut shop = Shop::of("makerspace-900x600", "birch-5");
    let set = panels_for(&shop, &cube(), JointStyle::Auto);
    let size = |size_mm: [f64; 2], count: Option<usize>| Stock {
        size_mm,
        count,
        is_turned: false,
    };
    // Offcuts are used first, wherever they are named.
    shop.stock = vec![size([600.0, 400.0], None), size([230.0, 450.0], Some(1))];
    let sheets = cut_sheets(&set, &shop.order()).unwrap();
    assert_eq!(sheets[0].nested.size_mm, [230.0, 450.0]);
    assert_eq!(sheets[0].nested.placements.len(), 2);
    let placed: usize = sheets
        .iter()
        .map(|sheet| sheet.nested.placements.len())
        .sum();
    assert_eq!(placed, 6);
    // The offcut alone has no room for six panels.
    shop.stock.remove(0);
    let error = cut_sheets(&set, &shop.order()).unwrap_err().to_string();
    assert!(error.contains("no room for panel"), "{error}");
    shop.stock.clear();
    shop.sheet.sizes.clear();
    let error = cut_sheets(&set, &shop.order()).unwrap_err().to_string();
    assert!(
        error.contains("remedy: add `sizes` to its profile"),
        "{error}"
    );
}
