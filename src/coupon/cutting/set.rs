//! The sizes of the coupons of a cutter and a sheet.

use serde::Serialize;

use crate::cutter::{CannotCut, Cutter, StockSheet};
use crate::panels::BeamError;

/// Number of squares in the row. A calliper reads the row to 0.05 mm, and a kerf to 0.005 mm.
const SQUARES: usize = 10;
/// Side of a square, mm.
const SIDE_MM: f64 = 20.0;
/// Number of slots on each side of the measured thickness, and the step between two, mm.
const SLOTS: i32 = 4;
const SLOT_STEP_MM: f64 = 0.05;
/// Inner angles of the joints, degrees.
const ANGLES_DEG: [f64; 4] = [60.0, 90.0, 120.0, 150.0];
/// By how much fingers are wider than their gaps, mm: loose, line to line, pressed.
const PRESSES_MM: [f64; 3] = [-0.1, 0.0, 0.1];
/// Letters of the angles.
const LETTERS: [&str; 4] = ["A", "B", "C", "D"];

/// A reason why there are no coupons for a cutter and a sheet.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CutCouponError {
    /// The cutter does not cut the sheet.
    #[error(transparent)]
    CannotCut(#[from] CannotCut),
    /// A gap is narrower than the cut.
    #[error("the coupons cannot be cut: {0}; remedy: check the kerf in the cutter's profile")]
    Beam(#[from] BeamError),
    /// A sheet so thick that its joints at a flat angle need more room than a panel has.
    #[error(
        "a sheet of {0} mm is too thick for the joints of the coupons; remedy: use a thinner one"
    )]
    TooThick(f64),
    /// No sheet has room for them.
    #[error(
        "the coupons need {width_mm:.0} × {depth_mm:.0} mm, and no size of this sheet leaves that \
         on the bed; remedy: add a larger size to the sheet's profile"
    )]
    NoRoom {
        /// Width of the drawing, mm.
        width_mm: f64,
        /// Depth of the drawing, mm.
        depth_mm: f64,
    },
    /// The sizes cannot be written as JSON.
    #[error("the sizes of the coupons cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// A slot into which the sheet's edge is pushed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Slot {
    /// The number beside it, from 1.
    pub number: usize,
    /// Its width as it should come out, mm.
    pub width_mm: f64,
    /// Its width less the thickness of the sheet, mm.
    pub fit_mm: f64,
}

/// A finger joint to be tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointTrial {
    /// The name on both panels, such as `B2`.
    pub name: String,
    /// The inner angle, degrees.
    pub angle_deg: f64,
    /// By how much fingers are wider than their gaps, mm.
    pub press_mm: f64,
}

/// The coupons of a cutter and a sheet.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CutCouponSet {
    /// The cutter's id.
    pub cutter: String,
    /// Its name.
    pub cutter_name: String,
    /// The sheet's id.
    pub sheet: String,
    /// Its name.
    pub sheet_name: String,
    /// The material.
    pub material: String,
    /// The thickness for which slots and joints are drawn, mm.
    pub thickness_mm: f64,
    /// The kerf of the profile, mm.
    pub kerf_mm: f64,
    /// The source of that kerf.
    pub kerf_source: String,
    /// The part of the kerf by which slots and joints are offset: none of it if the shop's software
    /// does that, mm.
    pub offset_kerf_mm: f64,
    /// Number of squares in the row.
    pub squares: usize,
    /// Drawn side of a square, mm.
    pub side_mm: f64,
    /// The slots, the narrowest first.
    pub slots: Vec<Slot>,
    /// The joints.
    pub joints: Vec<JointTrial>,
    /// Least distance between two outlines, mm.
    pub gap_mm: f64,
    /// The room in which the drawing must lie, mm.
    pub room_mm: [f64; 2],
}

impl CutCouponSet {
    /// Computes the coupons of a cutter and a sheet.
    ///
    /// # Errors
    /// The cutter does not cut the sheet.
    pub fn of(cutter: &Cutter, sheet: &StockSheet) -> Result<Self, CutCouponError> {
        let kerf = cutter.check_sheet(sheet)?;
        let thickness_mm = sheet.thickness_mm.value;
        let slot = |step: i32| {
            let fit_mm = f64::from(step) * SLOT_STEP_MM;
            Slot {
                number: (step + SLOTS + 1) as usize,
                width_mm: thickness_mm + fit_mm,
                fit_mm,
            }
        };
        let joints = ANGLES_DEG.into_iter().zip(LETTERS);
        let joints = joints.flat_map(|(angle_deg, letter)| {
            let presses = PRESSES_MM.into_iter().enumerate();
            presses.map(move |(index, press_mm)| JointTrial {
                name: format!("{letter}{}", index + 1),
                angle_deg,
                press_mm,
            })
        });
        let rooms = cutter.rooms_mm(sheet).into_iter();
        let room_mm = rooms.reduce(|a, b| if b[0] * b[1] > a[0] * a[1] { b } else { a });
        Ok(Self {
            cutter: cutter.id.clone(),
            cutter_name: cutter.name.clone(),
            sheet: sheet.id.clone(),
            sheet_name: sheet.name.clone(),
            material: sheet.material.to_string(),
            thickness_mm,
            kerf_mm: kerf.kerf_mm,
            kerf_source: kerf.provenance,
            offset_kerf_mm: cutter.offset_mm(kerf.kerf_mm),
            squares: SQUARES,
            side_mm: SIDE_MM,
            slots: (-SLOTS..=SLOTS).map(slot).collect(),
            joints: joints.collect(),
            gap_mm: cutter.spacing_mm(kerf.kerf_mm),
            room_mm: room_mm.unwrap_or(cutter.bed_mm.value),
        })
    }
}
