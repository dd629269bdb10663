//! Panels on sheets: each once, inside the margins, and far enough apart.

use equipoise::panels::{
    JointStyle, LineOrder, NestError, NestRequest, NestedSheet, PanelSet, SheetLines, Stock, nest,
};

use super::{cube, dodecahedron, octahedron, regular, request, tetrahedron};

fn stock(length: f64, width: f64) -> Stock {
    Stock {
        size_mm: [length, width],
        count: None,
        is_turned: false,
    }
}

fn nest_request(stock: Vec<Stock>) -> NestRequest {
    NestRequest {
        stock,
        margin_mm: 5.0,
        spacing_mm: 3.0,
        keeps_grain: false,
    }
}

/// Returns the distance of two segments that do not cross, mm.
fn apart_mm(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> f64 {
    let to_segment = |p: [f64; 2], [q, r]: [[f64; 2]; 2]| {
        let way = [r[0] - q[0], r[1] - q[1]];
        let length = way[0] * way[0] + way[1] * way[1];
        let share = ((p[0] - q[0]) * way[0] + (p[1] - q[1]) * way[1]) / length;
        let share = share.clamp(0.0, 1.0);
        (p[0] - q[0] - share * way[0]).hypot(p[1] - q[1] - share * way[1])
    };
    let both = [
        to_segment(a[0], b),
        to_segment(a[1], b),
        to_segment(b[0], a),
        to_segment(b[1], a),
    ];
    both.into_iter().fold(f64::INFINITY, f64::min)
}

/// Holds that every panel lies once on the sheets, inside the margin and with the spacing. Returns
/// the share of the used length that is panels, of the last sheet or of all whole ones.
fn hold_nest(panels: &[Vec<[f64; 2]>], sheets: &[NestedSheet], request: &NestRequest) -> f64 {
    let mut seen: Vec<usize> = Vec::new();
    let (mut used, mut filled) = (0.0, 0.0);
    for sheet in sheets {
        let placed: Vec<Vec<[f64; 2]>> = sheet
            .placements
            .iter()
            .map(|placement| {
                panels[placement.panel]
                    .iter()
                    .map(|at| placement.place(*at))
                    .collect()
            })
            .collect();
        seen.extend(sheet.placements.iter().map(|placement| placement.panel));
        used += sheet.used_mm * sheet.size_mm[1];
        for (index, ring) in placed.iter().enumerate() {
            for [x, y] in ring {
                let free = [*x, *y, sheet.size_mm[0] - x, sheet.size_mm[1] - y];
                let least = free.into_iter().fold(f64::INFINITY, f64::min);
                assert!(least >= request.margin_mm - 1e-6, "{least}");
                assert!(*x <= sheet.used_mm - request.margin_mm + 1e-6);
            }
            let edges = |ring: &[[f64; 2]]| -> Vec<[[f64; 2]; 2]> {
                let next = ring.iter().cycle().skip(1);
                ring.iter().zip(next).map(|(a, b)| [*a, *b]).collect()
            };
            filled += 0.5
                * edges(ring)
                    .iter()
                    .map(|[a, b]| a[0] * b[1] - a[1] * b[0])
                    .sum::<f64>();
            for other in &placed[index + 1..] {
                for a in edges(ring) {
                    for b in edges(other) {
                        let apart = apart_mm(a, b);
                        assert!(apart >= request.spacing_mm - 1e-6, "{apart}");
                    }
                }
            }
        }
    }
    seen.sort_unstable();
    assert_eq!(seen, (0..panels.len()).collect::<Vec<usize>>());
    filled / used
}

#[test]
fn squares_are_nested_without_a_gap_and_offcuts_come_first() {
    let square = |side: f64| vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]];
    // Ten squares of 97 mm with 3 mm between them fill 5 × 2 of a sheet of 1000 × 207 mm.
    let panels: Vec<Vec<[f64; 2]>> = (0..10).map(|_| square(97.0)).collect();
    let request = nest_request(vec![stock(1000.0, 207.0)]);
    let sheets = nest(&panels, &request).unwrap();
    hold_nest(&panels, &sheets, &request);
    assert_eq!(sheets.len(), 1);
    assert!(
        (sheets[0].used_mm - 507.0).abs() < 1e-6,
        "{}",
        sheets[0].used_mm
    );
    assert_eq!(sheets, nest(&panels, &request).unwrap());
    // One of them goes on an offcut that is there once.
    let offcut = Stock {
        count: Some(1),
        ..stock(110.0, 110.0)
    };
    let request = nest_request(vec![offcut, stock(1000.0, 207.0)]);
    let sheets = nest(&panels, &request).unwrap();
    hold_nest(&panels, &sheets, &request);
    let sizes: Vec<f64> = sheets.iter().map(|sheet| sheet.size_mm[0]).collect();
    assert_eq!(sizes, [110.0, 1000.0]);
    assert_eq!(sheets[0].placements.len(), 1);
}

#[test]
fn of_several_sizes_those_are_cut_that_take_the_least_area() {
    let square = |side: f64| vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]];
    // Two large squares need a long sheet. The small ones beside them need no other one.
    let panels = [square(190.0), square(190.0), square(90.0), square(90.0)];
    let sizes = vec![
        stock(230.0, 230.0),
        stock(610.0, 210.0),
        stock(120.0, 120.0),
    ];
    let request = nest_request(sizes.clone());
    let sheets = nest(&panels, &request).unwrap();
    hold_nest(&panels, &sheets, &request);
    let found: Vec<[f64; 2]> = sheets.iter().map(|sheet| sheet.size_mm).collect();
    assert_eq!(found, [[610.0, 210.0]]);
    // A single small square gets the smallest sheet, wherever that is named.
    let request = nest_request(sizes);
    let sheets = nest(&panels[3..], &request).unwrap();
    assert_eq!(sheets[0].size_mm, [120.0, 120.0]);
    assert!(sheets.iter().all(|sheet| !sheet.is_offcut));
}

#[test]
fn grain_keeps_panels_from_being_turned_and_too_large_panels_are_named() {
    let bar = vec![[0.0, 0.0], [30.0, 0.0], [30.0, 300.0], [0.0, 300.0]];
    let request = nest_request(vec![stock(400.0, 100.0)]);
    let free = nest(std::slice::from_ref(&bar), &request).unwrap();
    hold_nest(std::slice::from_ref(&bar), &free, &request);
    let grain = NestRequest {
        keeps_grain: true,
        ..request.clone()
    };
    assert_eq!(
        nest(std::slice::from_ref(&bar), &grain),
        Err(NestError::TooLarge(0))
    );
    let one = Stock {
        count: Some(1),
        ..stock(400.0, 50.0)
    };
    let request = nest_request(vec![one]);
    assert_eq!(
        nest(&[bar.clone(), bar], &request),
        Err(NestError::NoSheetLeft(1))
    );
}

#[test]
fn panels_keep_to_the_grain_of_a_sheet_that_lies_turned() {
    let bar = vec![[0.0, 0.0], [30.0, 0.0], [30.0, 300.0], [0.0, 300.0]];
    let turned = Stock {
        is_turned: true,
        ..stock(400.0, 100.0)
    };
    let request = NestRequest {
        keeps_grain: true,
        ..nest_request(vec![turned])
    };
    let sheets = nest(std::slice::from_ref(&bar), &request).unwrap();
    hold_nest(std::slice::from_ref(&bar), &sheets, &request);
    assert!(sheets[0].is_turned);
    let turn_rad = sheets[0].placements[0].turn_rad;
    assert!(turn_rad.cos().abs() < 1e-12, "{turn_rad}");
    // Across the grain it would fit, so that it fits no more.
    let across: Vec<[f64; 2]> = bar.iter().map(|[x, y]| [*y, -*x]).collect();
    assert_eq!(nest(&[across], &request), Err(NestError::TooLarge(0)));
}

#[test]
fn panels_of_a_dodecahedron_lie_on_one_sheet() {
    let set = PanelSet::of(&regular(&dodecahedron()), &request(JointStyle::Auto)).unwrap();
    let panels: Vec<Vec<[f64; 2]>> = set
        .panels
        .iter()
        .map(|panel| panel.outline.corners().to_vec())
        .collect();
    let request = nest_request(vec![stock(900.0, 600.0)]);
    let sheets = nest(&panels, &request).unwrap();
    let share = hold_nest(&panels, &sheets, &request);
    println!(
        "{} sheet, {:.1} mm used, {:.1} % filled",
        sheets.len(),
        sheets[0].used_mm,
        100.0 * share
    );
    assert_eq!(sheets.len(), 1);
    assert!(share > 0.55, "{share}");
}

pub fn lines_of(set: &PanelSet, kerf_mm: f64) -> (Vec<NestedSheet>, Vec<SheetLines>) {
    let panels: Vec<Vec<[f64; 2]>> = set
        .panels
        .iter()
        .map(|panel| panel.inner_outline().corners().to_vec())
        .collect();
    let sheets = nest(&panels, &nest_request(vec![stock(900.0, 600.0)])).unwrap();
    let order = LineOrder {
        kerf_mm,
        text_mm: 12.0,
    };
    let lines = sheets
        .iter()
        .map(|sheet| SheetLines::of(set, sheet, &order).unwrap());
    let lines = lines.collect();
    (sheets, lines)
}

/// Returns the distance of a point from a ring, mm: more than zero inside.
fn inside_mm(ring: &[[f64; 2]], at: [f64; 2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    let mut is_inside = false;
    let mut least = f64::INFINITY;
    for (a, b) in ring.iter().zip(next) {
        if (a[1] > at[1]) != (b[1] > at[1]) {
            let x = a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            is_inside ^= at[0] < x;
        }
        least = least.min(apart_mm([*a, *b], [at, at.map(|v| v + 1e-9)]));
    }
    if is_inside { least } else { -least }
}

#[test]
fn panels_are_cut_larger_by_half_the_kerf_and_their_holes_smaller() {
    let set = PanelSet::of(&regular(&cube()), &request(JointStyle::Brackets)).unwrap();
    let [(_, exact), (_, wide)] = [0.0, 0.2].map(|kerf_mm| lines_of(&set, kerf_mm));
    // Squares of 190 mm with round corners of half the kerf.
    let [exact, wide] = [&exact[0], &wide[0]];
    assert_eq!((exact.outlines.len(), exact.holes.len()), (6, 96));
    for (path, larger) in exact.outlines.iter().zip(&wide.outlines) {
        assert!((path.area_mm2() - 190.0 * 190.0).abs() < 1e-6);
        let [low, high] = larger.bounds_mm();
        let sides = [high[0] - low[0], high[1] - low[1]];
        assert!(
            sides.iter().all(|side| (side - 190.2).abs() < 1e-3),
            "{sides:?}"
        );
    }
    let diameters = |lines: &SheetLines| -> Vec<f64> {
        lines.holes.iter().map(|hole| hole.diameter_mm).collect()
    };
    assert!(diameters(exact).iter().all(|mm| (mm - 3.4).abs() < 1e-9));
    assert!(diameters(wide).iter().all(|mm| (mm - 3.2).abs() < 1e-9));
    let cut_mm = 6.0 * 4.0 * 190.0 + 96.0 * std::f64::consts::PI * 3.4;
    assert!(
        (exact.cut_mm() - cut_mm).abs() < 1e-6,
        "{} {cut_mm}",
        exact.cut_mm()
    );
    let too_wide = LineOrder {
        kerf_mm: 3.4,
        text_mm: 12.0,
    };
    let (sheets, _) = lines_of(&set, 0.0);
    assert!(SheetLines::of(&set, &sheets[0], &too_wide).is_err());
}

#[test]
fn numbers_are_engraved_on_the_panels_and_clear_of_joints_and_holes() {
    for joints in [JointStyle::Auto, JointStyle::Brackets] {
        for normals in [cube(), tetrahedron(), octahedron(), dodecahedron()] {
            let set = PanelSet::of(&regular(&normals), &request(joints)).unwrap();
            let (sheets, lines) = lines_of(&set, 0.1);
            for (sheet, lines) in sheets.iter().zip(&lines) {
                assert!(lines.engraved_mm() > 0.0);
                for at in lines.strokes.iter().flatten() {
                    let inside = lines
                        .outlines
                        .iter()
                        .map(|path| inside_mm(path.corners(), *at));
                    let inside = inside.fold(f64::NEG_INFINITY, f64::max);
                    assert!(inside > 1.0, "{at:?}: {inside}");
                    for hole in &lines.holes {
                        let [x, y] = [at[0] - hole.at_mm[0], at[1] - hole.at_mm[1]];
                        assert!(x.hypot(y) > 0.5 * hole.diameter_mm + 1.0);
                    }
                }
                // Each stroke lies on the panel of its own placement.
                assert_eq!(lines.outlines.len(), sheet.placements.len());
            }
        }
    }
}
