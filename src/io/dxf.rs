//! DXF for cutters: AutoCAD 2000 in ASCII, millimetres, polylines and circles alone.
//!
//! Times, handles and names are fixed, so that the same drawing gives the same bytes.

use super::drawing::{CutDrawing, CutLayer, DrawnShape, Rgb, number};

/// Units of the drawing: millimetres.
const MILLIMETRES: u32 = 4;
/// The handle of the first entity; those below are of tables, blocks and dictionaries.
const FIRST_ENTITY: u32 = 0x100;
/// The owner of all entities: the model space.
const MODEL_SPACE: &str = "1F";

/// Colours by number that all readers know: red, yellow, green, cyan, blue, magenta, black.
const COLORS: [(u8, Rgb); 7] = [
    (1, [255, 0, 0]),
    (2, [255, 255, 0]),
    (3, [0, 255, 0]),
    (4, [0, 255, 255]),
    (5, [0, 0, 255]),
    (6, [255, 0, 255]),
    (7, [0, 0, 0]),
];

/// Writes a drawing as DXF. Lines are in the order of the work: engraving, holes, outlines.
pub fn encode_dxf(drawing: &CutDrawing) -> String {
    let mut entities = String::new();
    let mut handle = FIRST_ENTITY;
    for layer in CutLayer::ALL {
        for shape in drawing.on(layer) {
            write_entity(&mut entities, shape, layer, handle);
            handle += 1;
        }
    }
    let [width, height] = drawing.size_mm.map(number);
    let mut text = pairs(&[
        ("0", "SECTION"),
        ("2", "HEADER"),
        ("9", "$ACADVER"),
        ("1", "AC1015"),
        ("9", "$DWGCODEPAGE"),
        ("3", "ANSI_1252"),
        ("9", "$HANDSEED"),
        ("5", &format!("{:X}", handle + 1)),
        ("9", "$INSUNITS"),
        ("70", &MILLIMETRES.to_string()),
        ("9", "$MEASUREMENT"),
        ("70", "1"),
        ("9", "$EXTMIN"),
        ("10", "0"),
        ("20", "0"),
        ("30", "0"),
        ("9", "$EXTMAX"),
        ("10", &width),
        ("20", &height),
        ("30", "0"),
        ("0", "ENDSEC"),
    ]);
    text += &tables(drawing);
    text += &blocks();
    text += &pairs(&[("0", "SECTION"), ("2", "ENTITIES")]);
    text += &entities;
    text += &pairs(&[("0", "ENDSEC")]);
    text += &objects();
    text + &pairs(&[("0", "EOF")])
}

/// Writes codes and values, a line each.
fn pairs(pairs: &[(&str, &str)]) -> String {
    let lines = pairs
        .iter()
        .map(|(code, value)| format!("{code:>3}\n{value}\n"));
    lines.collect()
}

fn write_entity(text: &mut String, shape: &DrawnShape, layer: CutLayer, handle: u32) {
    let handle = format!("{handle:X}");
    let head = |kind: &str| {
        pairs(&[
            ("0", kind),
            ("5", &handle),
            ("330", MODEL_SPACE),
            ("100", "AcDbEntity"),
            ("8", layer.name()),
        ])
    };
    let polyline = |points: &[[f64; 2]], flag: &str| {
        let mut text = head("LWPOLYLINE");
        text += &pairs(&[
            ("100", "AcDbPolyline"),
            ("90", &points.len().to_string()),
            ("70", flag),
        ]);
        for [x, y] in points {
            text += &pairs(&[("10", &number(*x)), ("20", &number(*y))]);
        }
        text
    };
    *text += &match shape {
        DrawnShape::Closed(corners) => polyline(corners, "1"),
        DrawnShape::Open(line) => polyline(line, "0"),
        DrawnShape::Circle {
            center_mm: [x, y],
            radius_mm,
        } => {
            head("CIRCLE")
                + &pairs(&[
                    ("100", "AcDbCircle"),
                    ("10", &number(*x)),
                    ("20", &number(*y)),
                    ("30", "0"),
                    ("40", &number(*radius_mm)),
                ])
        }
    };
}

/// Returns the number of the colour that is nearest.
fn color_number(color: Rgb) -> u8 {
    let apart = |other: &Rgb| -> u32 {
        let differences = color
            .iter()
            .zip(other)
            .map(|(a, b)| u32::from(a.abs_diff(*b)));
        differences.map(|by| by * by).sum()
    };
    let nearest = COLORS.iter().min_by_key(|(_, known)| apart(known));
    nearest.map_or(7, |(number, _)| *number)
}

/// The tables that AutoCAD 2000 asks for. The handles of tables and records are fixed.
fn tables(drawing: &CutDrawing) -> String {
    let mut text = pairs(&[("0", "SECTION"), ("2", "TABLES")]);
    text += &table("VPORT", "8", &[]);
    let line_type = |handle: &str, name: &str| {
        record(["LTYPE", "AcDbLinetypeTableRecord", "5"], handle, name)
            + &pairs(&[
                ("70", "0"),
                ("3", ""),
                ("72", "65"),
                ("73", "0"),
                ("40", "0"),
            ])
    };
    text += &table(
        "LTYPE",
        "5",
        &[
            line_type("14", "ByBlock"),
            line_type("15", "ByLayer"),
            line_type("16", "Continuous"),
        ],
    );
    let layer = |handle: &str, name: &str, color: u8| {
        record(["LAYER", "AcDbLayerTableRecord", "2"], handle, name)
            + &pairs(&[("70", "0"), ("62", &color.to_string()), ("6", "Continuous")])
    };
    let mut layers = vec![layer("10", "0", 7)];
    for (index, one) in CutLayer::ALL.into_iter().enumerate() {
        let handle = format!("{:X}", 0x40 + index);
        layers.push(layer(&handle, one.name(), color_number(drawing.color(one))));
    }
    text += &table("LAYER", "2", &layers);
    let style = record(["STYLE", "AcDbTextStyleTableRecord", "3"], "11", "Standard")
        + &pairs(&[
            ("70", "0"),
            ("40", "0"),
            ("41", "1"),
            ("50", "0"),
            ("71", "0"),
            ("42", "2.5"),
            ("3", "txt"),
            ("4", ""),
        ]);
    text += &table("STYLE", "3", &[style]);
    text += &table("VIEW", "6", &[]);
    text += &table("UCS", "7", &[]);
    let application = record(["APPID", "AcDbRegAppTableRecord", "9"], "12", "ACAD");
    text += &table("APPID", "9", &[application + &pairs(&[("70", "0")])]);
    text += &dimension_styles();
    let block = |handle: &str, name: &str| {
        record(["BLOCK_RECORD", "AcDbBlockTableRecord", "1"], handle, name)
    };
    text += &table(
        "BLOCK_RECORD",
        "1",
        &[
            block(MODEL_SPACE, "*Model_Space"),
            block("1B", "*Paper_Space"),
        ],
    );
    text + &pairs(&[("0", "ENDSEC")])
}

/// The table of dimension styles, whose records have a handle of their own kind.
fn dimension_styles() -> String {
    pairs(&[
        ("0", "TABLE"),
        ("2", "DIMSTYLE"),
        ("5", "A"),
        ("330", "0"),
        ("100", "AcDbSymbolTable"),
        ("70", "1"),
        ("100", "AcDbDimStyleTable"),
        ("71", "0"),
        ("0", "DIMSTYLE"),
        ("105", "27"),
        ("330", "A"),
        ("100", "AcDbSymbolTableRecord"),
        ("100", "AcDbDimStyleTableRecord"),
        ("2", "Standard"),
        ("70", "0"),
        ("0", "ENDTAB"),
    ])
}

fn table(name: &str, handle: &str, records: &[String]) -> String {
    let head = pairs(&[
        ("0", "TABLE"),
        ("2", name),
        ("5", handle),
        ("330", "0"),
        ("100", "AcDbSymbolTable"),
        ("70", &records.len().to_string()),
    ]);
    head + &records.concat() + &pairs(&[("0", "ENDTAB")])
}

/// Returns a record of a table: its handle and name. `kind` is its kind, its class and the handle
/// of its table.
fn record(kind: [&str; 3], handle: &str, name: &str) -> String {
    let [kind, class, owner] = kind;
    pairs(&[
        ("0", kind),
        ("5", handle),
        ("330", owner),
        ("100", "AcDbSymbolTableRecord"),
        ("100", class),
        ("2", name),
    ])
}

/// The blocks of model space and paper space, both empty.
fn blocks() -> String {
    let block = |[begin, end, owner]: [&str; 3], name: &str, paper: &[(&str, &str)]| {
        let entity = |kind, handle| {
            pairs(&[
                ("0", kind),
                ("5", handle),
                ("330", owner),
                ("100", "AcDbEntity"),
            ]) + &pairs(paper)
                + &pairs(&[("8", "0")])
        };
        entity("BLOCK", begin)
            + &pairs(&[
                ("100", "AcDbBlockBegin"),
                ("2", name),
                ("70", "0"),
                ("10", "0"),
                ("20", "0"),
                ("30", "0"),
                ("3", name),
                ("1", ""),
            ])
            + &entity("ENDBLK", end)
            + &pairs(&[("100", "AcDbBlockEnd")])
    };
    pairs(&[("0", "SECTION"), ("2", "BLOCKS")])
        + &block(["20", "21", MODEL_SPACE], "*Model_Space", &[])
        + &block(["1C", "1D", "1B"], "*Paper_Space", &[("67", "1")])
        + &pairs(&[("0", "ENDSEC")])
}

/// The dictionary that every drawing has, with an empty one of groups.
fn objects() -> String {
    pairs(&[
        ("0", "SECTION"),
        ("2", "OBJECTS"),
        ("0", "DICTIONARY"),
        ("5", "C"),
        ("330", "0"),
        ("100", "AcDbDictionary"),
        ("281", "1"),
        ("3", "ACAD_GROUP"),
        ("350", "D"),
        ("0", "DICTIONARY"),
        ("5", "D"),
        ("330", "C"),
        ("100", "AcDbDictionary"),
        ("281", "1"),
        ("0", "ENDSEC"),
    ])
}
