//! Stock pins for the tip of a top: as short, thin and light as the promised lean allows.

use super::drill::Drill;
use super::hardware::{Rod, STEEL_G_CM3};
use super::lean::least_height_mm;
use super::site::Site;
use crate::base::units::Length;
use crate::geom::Point;

/// The diameters of parallel steel pins, mm (ISO 2338 and 8734).
const DIAMETERS_MM: [f64; 11] = [1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0];
/// The lengths of parallel steel pins, mm (ISO 2338 and 8734).
const LENGTHS_MM: [f64; 32] = [
    4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0, 24.0, 26.0, 28.0, 30.0, 32.0,
    35.0, 40.0, 45.0, 50.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0, 90.0, 95.0, 100.0, 120.0,
    140.0,
];
/// The least diameter, as a part of the model's longest side: 3 mm below 100 mm. A thinner pin digs
/// into the table and bends when the top falls.
const LEAST_DIAMETER_RATIO: f64 = 0.029;
/// The greatest length of a tip outside the model, in its diameters. A thinner one bends, and looks
/// like a stilt.
const SLENDER_DIAMETERS: f64 = 6.0;
/// The greatest length of a pin, as a part of the model's longest side. Nobody would call a longer
/// one a tip.
const LONGEST_RATIO: f64 = 0.5;
/// The least length outside, in diameters: its end is a half ball, and the rest is seen.
const LEAST_OUT_DIAMETERS: f64 = 1.0;
/// The least depth inside, in diameters. Less glue does not hold a pin against a blow.
const LEAST_DEPTH_DIAMETERS: f64 = 1.5;
/// The least depth inside, as a part of the length outside, against its lever.
const LEAST_DEPTH_RATIO: f64 = 0.5;
/// Lengths outside are rounded up to whole steps, mm: a shop measures no finer when it glues.
const STEP_MM: f64 = 0.5;
/// The length added before rounding, mm, for what single-precision files and glue take.
const SPARE_MM: f64 = 0.05;
/// The gap around a pin in its socket that is reckoned with, mm: the widest of any printer.
const CLEARANCE_MM: f64 = 0.3;
/// The number of pins that are handed on, should the first not fit its socket.
const MOST_PINS: usize = 6;

/// The place and the promise of a tip.
pub(super) struct TipPlace<'a> {
    pub site: &'a Site<'a>,
    /// The point of the surface at which the tip goes in, upright frame.
    pub seat: Point,
    pub wall_mm: f64,
    pub least_lean_rad: f64,
}

impl TipPlace<'_> {
    /// Returns the stock pins that fit there and keep the lean, the lightest first; none if the
    /// model has no room for any.
    pub fn pins(&self) -> Vec<Rod> {
        let corners: Vec<Point> = self
            .site
            .hull_corners()
            .map(|corner| Point::from(corner - self.seat))
            .collect();
        let reach_mm = 0.5 * DIAMETERS_MM[DIAMETERS_MM.len() - 1] + CLEARANCE_MM + self.wall_mm;
        let drill = Drill::new(self.site, &self.seat, reach_mm);
        let least_mm = LEAST_DIAMETER_RATIO * self.site.solid.mesh().longest_side_mm();
        let least_mm = least_mm.min(DIAMETERS_MM[DIAMETERS_MM.len() - 1]);
        let diameters = DIAMETERS_MM.iter().filter(|mm| **mm >= least_mm);
        let pins = diameters.filter_map(|diameter_mm| {
            let out_mm = self.out_mm(&corners, *diameter_mm)?;
            self.pin(&drill, *diameter_mm, out_mm)
        });
        let mut pins: Vec<Rod> = pins.collect();
        let bulk = |pin: &Rod| pin.radius_mm().powi(2) * pin.length_mm();
        pins.sort_by(|a, b| bulk(a).total_cmp(&bulk(b)));
        pins.truncate(MOST_PINS);
        pins
    }

    /// Returns the length that a pin of this diameter must stand out, mm; `None` if it would be too
    /// slender.
    fn out_mm(&self, corners: &[Point], diameter_mm: f64) -> Option<f64> {
        let needed = least_height_mm(corners, 0.5 * diameter_mm, self.least_lean_rad) + SPARE_MM;
        let out_mm = needed.max(LEAST_OUT_DIAMETERS * diameter_mm);
        let out_mm = (out_mm / STEP_MM).ceil() * STEP_MM;
        (out_mm <= SLENDER_DIAMETERS * diameter_mm).then_some(out_mm)
    }

    /// Returns the shortest stock pin that stands out by `out_mm` and is held in its socket.
    fn pin(&self, drill: &Drill, diameter_mm: f64, out_mm: f64) -> Option<Rod> {
        let least_depth_mm = (LEAST_DEPTH_DIAMETERS * diameter_mm).max(LEAST_DEPTH_RATIO * out_mm);
        let bore = drill.bore(0.5 * diameter_mm + CLEARANCE_MM, self.wall_mm);
        let longest_mm = LONGEST_RATIO * self.site.solid.mesh().longest_side_mm();
        let lengths = LENGTHS_MM
            .iter()
            .filter(|length_mm| **length_mm <= longest_mm);
        let depths = lengths.map(|length_mm| length_mm - out_mm);
        let depth_mm = depths
            .filter(|depth_mm| *depth_mm >= least_depth_mm)
            .find(|depth_mm| bore.holds(*depth_mm))?;
        Some(Rod {
            diameter: Length::from_mm(diameter_mm).ok()?,
            length: Some(Length::from_mm(out_mm + depth_mm).ok()?),
            depth: Some(Length::from_mm(depth_mm).ok()?),
            density_g_cm3: STEEL_G_CM3,
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::goal::testing::{arch, block, prism};
    use crate::goal::{
        Contact, Footing, GoalError, GoalKind, Placement, Request, TipChoice, Warning, place,
    };
    use crate::mesh::Solid;
    use crate::mesh::primitives::{cylinder, ellipsoid};

    fn place_default(solid: &Solid) -> Placement {
        place(solid, 1.0, &Request::new(GoalKind::Top)).unwrap()
    }

    #[test]
    fn a_flat_top_gets_a_pin_on_which_it_leans_as_promised_and_hardly_more() {
        let slab = block([-30., -30., 0.], [30., 30., 20.]);
        let placed = place_default(&slab);
        let Some(Footing::Tip { rod, lean, .. }) = placed.footing else {
            panic!("{:?}", placed.footing)
        };
        // The corners are 42.43 mm from the axis. They reach the floor at 10° if a pin of 2 mm
        // stands out by h = 7.466 mm: (h − 1) cos 10° = 42.43 sin 10° − 1. In whole steps that is
        // 8 mm. It goes 4 mm in, which makes 12 mm.
        assert_eq!(rod.to_string(), "2mmx12mmx4mm");
        assert!((placed.goal.frame.origin.z + 8.0).abs() < 1e-12);
        let lean_deg = lean.lean_rad.to_degrees();
        assert!((10.0..10.8).contains(&lean_deg), "{lean_deg}");
        assert!(placed.keeps.is_empty() && placed.warnings.is_empty());
    }

    #[test]
    fn a_round_bottom_keeps_its_own_lowest_point() {
        let egg = ellipsoid(
            &crate::geom::Point::origin(),
            &crate::geom::Vector::new(20.0, 20.0, 16.0),
            5,
        );
        let placed = place_default(&Solid::new(egg).unwrap());
        let Some(Footing::Foot { lean }) = placed.footing else {
            panic!("{:?}", placed.footing)
        };
        // Leaned by θ, it touches at a² sin θ/√(a² sin² θ + c² cos² θ) from its axis. At 10° that
        // is 4.305 mm, as on a ball of 24.8 mm.
        assert!((lean.radius_mm - 24.8).abs() < 1.5, "{lean:?}");
        assert!((placed.goal.frame.origin.z + 16.0).abs() < 1e-9);
    }

    #[test]
    fn without_room_for_a_pin_the_contact_stays_bare_and_the_sheet_says_so() {
        // The plate between the legs is 2 mm thick: no socket with a wall behind it fits.
        let placed = place_default(&arch());
        assert!(placed.warnings.contains(&Warning::NoTip), "{placed:?}");
        assert!(placed.footing.unwrap().tip().is_none());
    }

    #[test]
    fn a_waived_tip_leaves_the_top_on_its_foot_with_the_lean_it_has() {
        let post = Solid::new(cylinder(8.0, 30.0, 72)).unwrap();
        let request = Request {
            contact: Some(Contact::Lowest),
            tip: TipChoice::None,
            ..Request::new(GoalKind::Top)
        };
        let placed = place(&post, 1.0, &request).unwrap();
        assert_eq!(placed.warnings, [Warning::OnFoot { lean_deg: 0.0 }]);
        assert_eq!(request.promised_lean_deg(), Some(0.0));
        // With a tip the same foot is lifted off the floor.
        let request = Request {
            tip: TipChoice::Auto,
            ..request
        };
        let placed = place(&post, 1.0, &request).unwrap();
        assert!(placed.footing.unwrap().tip().is_some() && placed.warnings.is_empty());
    }

    #[test]
    fn a_tip_that_is_too_short_is_refused_at_once_with_a_pin_that_does_it() {
        let slab = block([-30., -30., 0.], [30., 30., 20.]);
        let with_tip = |tip: &str| Request {
            tip: tip.parse().unwrap(),
            ..Request::new(GoalKind::Top)
        };
        let refused = place(&slab, 1.0, &with_tip("4mmx9mmx4mm")).unwrap_err();
        let GoalError::ShortTip { lean_deg, pin, .. } = &refused else {
            panic!("{refused}")
        };
        // The corners are 42.43 mm from the axis and 3 mm over the middle of the round end. They
        // reach the floor at asin(2/42.54) + atan(3/42.43) = 6.74°.
        assert!((lean_deg - 6.74).abs() < 0.01, "{lean_deg}");
        assert_eq!(pin.unwrap().to_string(), "2mmx12mmx4mm");
        assert!(refused.to_string().contains("2mmx12mmx4mm"), "{refused}");
        // Nobody is kept from a top that leans less.
        let waived = Request {
            least_lean_deg: 6.0,
            ..with_tip("4mmx9mmx4mm")
        };
        assert!(place(&slab, 1.0, &waived).is_ok());
    }

    #[test]
    fn no_pin_is_longer_than_half_the_model() {
        // A gate of 60 mm with legs of this length below a thick roof, into which the pin goes.
        let gate = |legs_mm: f64| {
            let (top, low) = (25.0 + legs_mm, legs_mm);
            let outline = [
                [0., 0.],
                [10., 0.],
                [10., low],
                [50., low],
                [50., 0.],
                [60., 0.],
                [60., top],
                [0., top],
            ];
            let faces: [&[u32]; 3] = [&[0, 1, 2, 7], &[2, 3, 6, 7], &[3, 4, 5, 6]];
            place_default(&prism(&outline, &faces, 60.0))
        };
        // Its corners are 42.43 mm from the axis. So the pin stands out by the legs and some
        // 7.5 mm, and goes in by half of that.
        let short = gate(8.0).footing.unwrap().tip().unwrap();
        assert!((23.0..=30.0).contains(&short.length_mm()), "{short}");
        // Here it would be 45 mm long.
        assert!(gate(20.0).warnings.contains(&Warning::NoTip));
    }

    #[test]
    fn a_trial_without_promises_looks_for_no_lean() {
        let request = Request::new(GoalKind::Top).unpromised();
        let placed = place(&block([0., 0., 0.], [4., 4., 4.]), 0.5, &request).unwrap();
        assert_eq!((placed.footing, placed.warnings.len()), (None, 0));
    }
}
