//! The coupons of a cutter as a drawing: squares, slots and joints in rows.

use super::set::{CutCouponError, CutCouponSet, JointTrial};
use crate::cutter::Dialect;
use crate::io::{CutDrawing, CutLayer, DrawnLine, DrawnShape};
use crate::panels::{FingerJoint, FingerSide, Outline, beam_path, engraved};

/// Greatest width of the drawing, mm: what a small cutter takes.
const WIDTH_MM: f64 = 280.0;
/// Distance from the edge of the drawing, mm.
const EDGE_MM: f64 = 5.0;
/// Height of engraved characters, mm.
const TEXT_MM: f64 = 5.0;
/// Depth of the plate with slots and of a slot, and the land between two slots, mm.
const PLATE_MM: f64 = 30.0;
const SLOT_DEPTH_MM: f64 = 14.0;
const LAND_MM: f64 = 9.0;
/// Ends and stretches of a joint, in thicknesses of the sheet and at least in mm.
const END_RATIO: f64 = 2.0;
const STRETCH_RATIO: f64 = 3.0;
const LEAST_STRETCH_MM: f64 = 8.0;
const STRETCHES: usize = 3;
/// Depth of a panel beyond its gaps, mm: room for its name.
const PANEL_MM: f64 = 14.0;

/// A piece to be cut, with its engraving.
struct Item {
    outline: Outline,
    engraving: Vec<Vec<[f64; 2]>>,
}

/// Lays all coupons out in rows, the first at the bottom.
///
/// # Errors
/// A gap is too narrow for the cut, a panel has no room for its joint, or the drawing is larger
/// than the room.
pub(super) fn lay_out(set: &CutCouponSet, dialect: Dialect) -> Result<CutDrawing, CutCouponError> {
    let [width, depth] = set.room_mm;
    let width_mm = WIDTH_MM.min(width.max(depth));
    let mut rows = Rows::new(width_mm, set.gap_mm);
    for _ in 0..set.squares {
        // On the line itself: what is missing afterwards is the kerf.
        rows.add(Item {
            outline: Outline::rectangle([0.0; 2], [set.side_mm; 2]),
            engraving: Vec::new(),
        });
    }
    rows.add(slot_plate(set)?);
    for joint in &set.joints {
        for side in [FingerSide::First, FingerSide::Second] {
            rows.add(panel(set, joint, side)?);
        }
    }
    let size_mm = rows.size_mm();
    let fits = |[a, b]: [f64; 2]| size_mm[0] <= a && size_mm[1] <= b;
    if !(fits([width, depth]) || fits([depth, width])) {
        return Err(CutCouponError::NoRoom {
            width_mm: size_mm[0],
            depth_mm: size_mm[1],
        });
    }
    Ok(CutDrawing {
        size_mm,
        lines: rows.lines,
        colors: dialect.colors(),
    })
}

/// Returns the plate with open slots and their numbers.
fn slot_plate(set: &CutCouponSet) -> Result<Item, CutCouponError> {
    let mut corners = vec![[0.0, 0.0]];
    let mut engraving = Vec::new();
    let mut teeth = vec![[0.0, PLATE_MM]];
    let mut x_mm = LAND_MM;
    for slot in &set.slots {
        let [from, to] = [x_mm, x_mm + slot.width_mm];
        let ground_mm = PLATE_MM - SLOT_DEPTH_MM;
        teeth.extend([
            [from, PLATE_MM],
            [from, ground_mm],
            [to, ground_mm],
            [to, PLATE_MM],
        ]);
        let text_mm = [from + 0.5 * slot.width_mm - 0.25 * TEXT_MM, 5.0];
        engraving.extend(engraved(&slot.number.to_string(), text_mm, TEXT_MM));
        x_mm = to + LAND_MM;
    }
    teeth.push([x_mm, PLATE_MM]);
    corners.push([x_mm, 0.0]);
    corners.extend(teeth.into_iter().rev());
    let outline = Outline::new(corners).ok_or(CutCouponError::TooThick(set.thickness_mm))?;
    Ok(Item {
        outline: beam_path(&outline, set.offset_kerf_mm)?,
        engraving,
    })
}

/// Returns a panel of a joint with its name.
fn panel(set: &CutCouponSet, trial: &JointTrial, side: FingerSide) -> Result<Item, CutCouponError> {
    let sheet_mm = set.thickness_mm;
    let stretch_mm = (STRETCH_RATIO * sheet_mm).max(LEAST_STRETCH_MM);
    let end_mm = END_RATIO * sheet_mm;
    let joint = FingerJoint {
        sheet_mm,
        angle_rad: trial.angle_deg.to_radians(),
        edge_mm: STRETCHES as f64 * stretch_mm + 2.0 * end_mm,
        end_mm,
        stretches: STRETCHES,
        press_mm: trial.press_mm,
    };
    let depth_mm = joint.gap_mm() + PANEL_MM;
    let outline = joint.panel(side, depth_mm);
    let outline = outline.ok_or(CutCouponError::TooThick(sheet_mm))?;
    let text_mm = [0.5 * joint.edge_mm - 3.0, depth_mm - 2.0 - TEXT_MM];
    Ok(Item {
        outline: beam_path(&outline, set.offset_kerf_mm)?,
        engraving: engraved(&trial.name, text_mm, TEXT_MM),
    })
}

/// Pieces side by side in rows of a width.
struct Rows {
    width_mm: f64,
    gap_mm: f64,
    /// The low corner of the next piece, mm.
    next_mm: [f64; 2],
    /// The depth of the row so far, mm.
    depth_mm: f64,
    /// The right end of the longest row, mm.
    right_mm: f64,
    lines: Vec<DrawnLine>,
}

impl Rows {
    fn new(width_mm: f64, gap_mm: f64) -> Self {
        Self {
            width_mm,
            gap_mm,
            next_mm: [EDGE_MM; 2],
            depth_mm: 0.0,
            right_mm: EDGE_MM,
            lines: Vec::new(),
        }
    }

    fn add(&mut self, item: Item) {
        let [low, high] = item.outline.bounds_mm();
        let size = [high[0] - low[0], high[1] - low[1]];
        let is_first = self.next_mm[0] == EDGE_MM;
        if !is_first && self.next_mm[0] + size[0] > self.width_mm - EDGE_MM {
            self.next_mm = [EDGE_MM, self.next_mm[1] + self.depth_mm + self.gap_mm];
            self.depth_mm = 0.0;
        }
        let by = [self.next_mm[0] - low[0], self.next_mm[1] - low[1]];
        for line in item.engraving {
            let moved = line.into_iter().map(|[x, y]| [x + by[0], y + by[1]]);
            self.lines.push(DrawnLine {
                layer: CutLayer::Engrave,
                shape: DrawnShape::Open(moved.collect()),
            });
        }
        self.lines.push(DrawnLine {
            layer: CutLayer::Outer,
            shape: DrawnShape::Closed(item.outline.moved(by).corners().to_vec()),
        });
        self.right_mm = self.right_mm.max(self.next_mm[0] + size[0]);
        self.next_mm[0] += size[0] + self.gap_mm;
        self.depth_mm = self.depth_mm.max(size[1]);
    }

    fn size_mm(&self) -> [f64; 2] {
        [
            self.right_mm + EDGE_MM,
            self.next_mm[1] + self.depth_mm + EDGE_MM,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cutter::{Cutter, StockSheet};

    fn set(cutter: &str, sheet: &str) -> Result<CutCouponSet, CutCouponError> {
        CutCouponSet::of(
            &Cutter::find(cutter).unwrap(),
            &StockSheet::find(sheet).unwrap(),
        )
    }

    fn outlines(drawing: &CutDrawing) -> Vec<Outline> {
        let closed = drawing.lines.iter().filter_map(|line| match &line.shape {
            DrawnShape::Closed(corners) => Outline::new(corners.iter().copied()),
            _ => None,
        });
        closed.collect()
    }

    #[test]
    fn every_coupon_lies_apart_on_the_drawing() {
        let mut made = 0;
        for cutter in Cutter::all().unwrap() {
            for sheet in StockSheet::all().unwrap() {
                let Ok(set) = CutCouponSet::of(&cutter, &sheet) else {
                    continue;
                };
                made += 1;
                let drawing = lay_out(&set, cutter.dialect).unwrap();
                let all = outlines(&drawing);
                assert_eq!(all.len(), set.squares + 1 + 2 * set.joints.len());
                let bounds: Vec<_> = all.iter().map(Outline::bounds_mm).collect();
                for (index, [low, high]) in bounds.iter().enumerate() {
                    let inside = (0..2).all(|i| low[i] > 4.9 && high[i] < drawing.size_mm[i] - 4.9);
                    assert!(inside, "{} {}", set.cutter, set.sheet);
                    for [other_low, other_high] in &bounds[..index] {
                        let apart = (0..2).any(|i| {
                            low[i] > other_high[i] + set.gap_mm - 1e-6
                                || other_low[i] > high[i] + set.gap_mm - 1e-6
                        });
                        assert!(apart, "{} {}", set.cutter, set.sheet);
                    }
                }
            }
        }
        assert!(made > 20, "{made}");
    }

    #[test]
    fn slots_come_out_in_their_widths_and_squares_lack_the_kerf() {
        let set = set("makerspace-900x600", "birch-5").unwrap();
        let drawing = lay_out(&set, Dialect::Boxes).unwrap();
        let all = outlines(&drawing);
        let [low, high] = all[0].bounds_mm();
        assert!((high[0] - low[0] - set.side_mm).abs() < 1e-9);
        // The beam widens a slot by half a kerf on each side.
        let top_mm = all[set.squares].bounds_mm()[1][1];
        let edges: Vec<_> = all[set.squares].edges().collect();
        let ground = edges.iter().filter(|[a, b]| {
            (a[1] - b[1]).abs() < 1e-9 && a[1] < top_mm - 10.0 && a[1] > top_mm - 20.0
        });
        let widths: Vec<f64> = ground
            .map(|[a, b]| (b[0] - a[0]).abs())
            .filter(|mm| *mm > 2.0)
            .collect();
        assert_eq!(widths.len(), set.slots.len());
        let beam_mm = set.offset_kerf_mm;
        let relief_mm = 2.0 * (2.0_f64.sqrt() - 1.0) * 0.5 * beam_mm;
        for (width, slot) in widths.iter().rev().zip(&set.slots) {
            let made = width + relief_mm + beam_mm;
            assert!((made - slot.width_mm).abs() < 1e-6, "{made} {slot:?}");
        }
    }

    #[test]
    fn a_sheet_that_the_cutter_does_not_cut_and_one_without_room_are_refused() {
        let cutter = Cutter::find("makerspace-900x600").unwrap();
        let thick = StockSheet::find("birch-6").unwrap();
        let thick = thick.measured(9.5, "a calliper");
        let error = CutCouponSet::of(&cutter, &thick).unwrap_err().to_string();
        assert!(error.contains("cuts plywood up to 8 mm"), "{error}");
        let small = CutCouponSet {
            room_mm: [100.0, 100.0],
            ..set("makerspace-900x600", "birch-5").unwrap()
        };
        let error = lay_out(&small, Dialect::Boxes).unwrap_err().to_string();
        assert!(error.contains("remedy: add a larger size"), "{error}");
        let wide = CutCouponSet {
            offset_kerf_mm: 6.0,
            ..set("makerspace-900x600", "birch-5").unwrap()
        };
        let error = lay_out(&wide, Dialect::Boxes).unwrap_err().to_string();
        assert!(error.contains("narrower than the cut"), "{error}");
    }
}
