//! The limits of the checks, with their reasons.

/// The centre of mass of a written top or yo-yo may lie this far from its axis, mm. Above it the
/// wobble is felt; far below it the printer's own accuracy decides.
pub const AXIS_OFFSET_LIMIT_MM: f64 = 0.005;
/// The principal axis may lean this far from the spin axis, degrees; for the same reasons.
pub const AXIS_TILT_LIMIT_DEG: f64 = 0.05;
/// I_b/I_c must be below this for the spin axis to be the stable one (intermediate axis theorem).
pub const DOMINANCE_LIMIT_RATIO: f64 = 1.0;
/// The contact of a top may be this far from its lowest point, mm. The rounding of files is far
/// below it, a layer or a speck of dust above.
pub const CONTACT_LIMIT_MM: f64 = 0.05;
/// The best of all hollowings may beat the certificate by this share, by the judge's own integral.
/// Cells of twice the size change it by some ten thousandths.
pub const BOUND_LIMIT_RATIO: f64 = 0.01;
/// Figures below these are held against them, degrees and mm: the integral's error does not shrink
/// with the figure.
pub const BOUND_SCALE_DEG: f64 = 5.0;
/// The same for lengths, mm.
pub const BOUND_SCALE_MM: f64 = 5.0;
/// A standing object without a promised angle must topple at more than this tilt, degrees.
pub const STANDING_LIMIT_DEG: f64 = 0.0;
/// A floating object's waterline may be this far from the predicted one, mm. The meniscus hides far
/// more.
pub const WATERLINE_LIMIT_MM: f64 = 0.02;
/// The metacentre must lie more than this above the centre of mass, mm, or the object does not stay
/// upright.
pub const METACENTRIC_LIMIT_MM: f64 = 0.0;
/// A floating object must right itself from this heel, degrees; with less, a ripple turns it over.
pub const RIGHTING_LIMIT_DEG: f64 = 5.0;
/// The wall may be this much thinner than ordered, mm, for the chords of a curved surface. Above it
/// a printed wall loses a pixel.
pub const WALL_TOLERANCE_MM: f64 = 0.01;
/// Each half of a yo-yo holds its axle over this many diameters. With less the axle tears out at
/// the first drop.
pub const LEAST_GRIP_DIAMETERS: f64 = 1.0;
/// The grip may be this much shorter, mm, for the rounding of a file.
pub const GRIP_TOLERANCE_MM: f64 = 1e-3;
/// The string gap of a yo-yo may be this far from the ordered one, mm, for the rounding of a file.
/// It is far below a layer.
pub const STRING_GAP_TOLERANCE_MM: f64 = 1e-3;
/// The volumes of the parts add up to the body within this share. STL's f32 coordinates leave about
/// 1e-7 of 100 mm.
pub const VOLUME_SUM_LIMIT_RATIO: f64 = 1e-6;
/// A part rests on the plate within this distance, mm: two f32 steps at 300 mm. Above it a slicer's
/// first layer is thin.
pub const RESTING_LIMIT_MM: f64 = 1e-4;
/// A part in a vat may enclose this much resin, mm³: a socket or a letter drains and causes no
/// suction.
pub const CUP_LIMIT_MM3: f64 = 150.0;
/// A drain hole may be this much narrower than stated, mm. The rounding of files is far below it,
/// and a printer's pixel above.
pub const HOLE_LIMIT_MM: f64 = 0.01;
/// The matrix of a pose is rigid within this. Rounding of a 4×4 matrix gives 1e-15, a mirror 2, a
/// stretch of 0.01 % gives 2e-4.
pub const POSE_LIMIT_RATIO: f64 = 1e-9;
/// A pin or socket may be this far from its promised radius, length or depth, mm. The flats of a
/// circle of 48 sides lie 0.004 mm inside it at 4 mm across. Above it a pin may bind or rattle.
pub const PIN_LIMIT_MM: f64 = 0.02;
/// Pins whose values differ by less are equally bad, and the first is named, mm. Rounding to single
/// precision changes values by up to 1e-5; without it a part saved again names another pin.
pub const EQUAL_PINS_MM: f64 = 1e-4;
/// A jig must leave this much room along the seam, mm, so that glue can be wiped off it and does
/// not reach the jig.
pub(super) const JIG_SEAM_LIMIT_MM: f64 = 3.0;
/// The gap between a pin and its socket may be this much narrower than ordered, mm, for the
/// rounding of files. A greater limit would consume the shop's own clearance, though printers are
/// far less accurate.
pub const GAP_TOLERANCE_MM: f64 = 1e-3;
/// The written assembly may miss the promised figure by this share. It is above the rounding of STL
/// (1e-6) and below anything a person can measure.
pub const FIGURE_SLACK_RATIO: f64 = 1e-3;
/// A match may miss the wanted mass, and an entry of the inertia tensor as a share of its trace, by
/// this. It is far above the rounding of STL, and a scale of 0.1 g does not tell it at 100 g. Its
/// centre has the limit of [`AXIS_OFFSET_LIMIT_MM`].
pub const MATCH_LIMIT_RATIO: f64 = 1e-3;
/// A film of glue may differ from the faces in the files by this share. Pins, sockets and engraved
/// ids take about as much off one side.
pub const FILM_LIMIT_RATIO: f64 = 0.1;
/// A measured opening may fall short of the least by this share, since the widest disc is found by
/// steps.
pub(super) const OPENING_SLACK_RATIO: f64 = 2e-3;
/// A stated share in sight may differ from the found one by this. Four standard deviations of two
/// samples of 2000 and 3000 points are at most 0.058, at a share of a half. At 95 % they are 0.025.
pub const SIGHT_TOLERANCE_RATIO: f64 = 0.06;
/// A number of the checklist may differ by this share of the largest number beside it. Both are
/// exact integrals of the same triangles, which another machine rounds by 1e-12. Above 1e-5 a tenth
/// of a gram could be taken off a heavy part unseen.
pub const SHEET_LIMIT_RATIO: f64 = 1e-6;
