//! Cuts and pins ordered by a user: the part of a plan that can be written to a file, edited, and
//! read again.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{
    base::toml_text::{self, TextFault},
    cut::{
        error::CutError,
        ids::{CutId, PinId},
        joints::pin_shape::PinSite,
        plan::{Cut, CutPlan, SolidEnd, UncutFace, index_of, tree_of},
        seam::clear::KeepClear,
    },
    geom::Parting,
};

/// The header of every written file.
const FILE_HEADER: &str = r#"# Cuts and pins, mm, in the frame of the scaled model. Edit, then: equipoise prepare, with this file as its cuts.
# Without pins they are placed anew; `pins = []` makes none. Faces listed as uncut stay whole where a cut passes; a cut with
# `within = [{ cut = "C1", side = "above" }]` is made on that side only. Of the interior stays solid what hangs together with
# `at_mm` between the corners of the box of a `[[solid]]`. No seam enters the ball of a `[[keep_clear]]` with `center_mm` and
# `radius_mm`; a file with such balls and no cuts leaves the cuts to the planner.

"#;

/// The cuts that a user orders and, if given, the pins. What follows from them is not part of it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Given")]
pub struct CutOrder {
    /// The pins; `None` if the planner is to place them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pins: Option<Vec<PinSite>>,
    /// The cuts, each through the whole model unless it is limited to sides of others.
    pub cuts: Vec<Cut>,
    /// Faces at which a cut leaves the body whole.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub uncut: Vec<UncutFace>,
    /// Regions of the interior that stay solid.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub solid: Vec<SolidEnd>,
    /// Balls that no seam enters.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub keep_clear: Vec<KeepClear>,
}

/// An order as it stands in a file, before it is checked.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Given {
    pins: Option<Vec<PinSite>>,
    #[serde(default)]
    cuts: Vec<Cut>,
    #[serde(default)]
    uncut: Vec<UncutFace>,
    #[serde(default)]
    solid: Vec<SolidEnd>,
    #[serde(default)]
    keep_clear: Vec<KeepClear>,
}

/// The reason why an order makes no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OrderError {
    /// Two cuts have the same name.
    #[error("cut {0} is there twice; remedy: give each its own id")]
    TwinCuts(CutId),
    /// Two pins have the same name.
    #[error("pin {0} is there twice; remedy: give each its own id")]
    TwinPins(PinId),
    /// The plane of a cut is degenerate or not finite.
    #[error(
        "cut {0} has no direction, or numbers that are not finite; remedy: give a normal X, Y, Z and a point in mm"
    )]
    NoPlane(CutId),
    /// A pin, an uncut face or a cut names a cut that is not in the order.
    #[error("{by} names cut {cut}, which is not there; remedy: name one of the cuts")]
    NoCut {
        /// The entry that names the cut.
        by: Namer,
        /// The cut it names.
        cut: CutId,
    },
    /// Cuts limit each other, or one is limited to both sides of another.
    #[error(
        "cuts are kept to sides of each other, so that none can be made first, or one to both sides of another, so that it is made nowhere; remedy: take one of them out of the other's `within`"
    )]
    Circular,
    /// A solid region has no volume, or its point lies outside.
    #[error(
        "solid region {0} is none; remedy: give `low_mm` below `high_mm` on each axis, and `at_mm` between them"
    )]
    NoRegion(usize),
    /// A ball to keep clear has no radius, or numbers that are not finite.
    #[error(
        "ball {0} to keep clear is none; remedy: give `center_mm` as three numbers, and a `radius_mm` above zero"
    )]
    NoBall(usize),
    /// A pin cannot be made.
    #[error("pin {id}: {reason}")]
    BadPin {
        /// The pin's id.
        id: PinId,
        /// The fault.
        reason: PinFault,
    },
}

/// An entry of an order that names a cut.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Namer {
    /// A cut that is limited to a side of another.
    Cut(CutId),
    /// A face that is left whole.
    UncutFace,
    /// A pin.
    Pin(PinId),
}

impl fmt::Display for Namer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cut(id) => write!(f, "cut {id}"),
            Self::UncutFace => f.write_str("an uncut face"),
            Self::Pin(id) => write!(f, "pin {id}"),
        }
    }
}

/// The reason why a pin cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PinFault {
    /// Its centre or direction is not finite, or its direction has no length.
    #[error("its centre and direction must be finite, and the direction have a length")]
    NoPlace,
    /// A diameter, its length or its depth is not a positive number.
    #[error("its diameters, length and depth must be positive numbers, mm")]
    NoSize,
    /// A chamfer is negative.
    #[error("its chamfers must be zero or positive, mm")]
    NegativeChamfer,
    /// The density of its dowel is not a positive number.
    #[error("its dowel's density must be a positive number, g/cm³")]
    NoDensity,
    /// Its dowel is longer than both sockets are deep.
    #[error("its dowel must be no longer than both sockets are deep")]
    LongDowel,
    /// Its chamfer takes up all of its tip.
    #[error("its chamfer must be less than its radius and its length")]
    WideChamfer,
    /// The chamfer of its socket takes up all of the socket.
    #[error("its socket's chamfer must be less than the socket's depth")]
    DeepChamfer,
    /// Its socket is too narrow or too shallow for it.
    #[error(
        "its socket must be wider than it and as deep as it is long; remedy: add the printer's clearance"
    )]
    TightSocket,
}

impl CutOrder {
    /// Returns the order of exactly this plan, its pins included.
    pub fn of(plan: &CutPlan) -> Self {
        Self {
            pins: Some(plan.pins.clone()),
            cuts: plan.cuts.clone(),
            uncut: plan.uncut.clone(),
            solid: plan.solid.clone(),
            keep_clear: Vec::new(),
        }
    }

    /// Returns its cuts with the half-spaces within which they are made, in their order. Errors as
    /// [`Cut::plane`].
    pub fn partings(&self) -> Result<Vec<Parting>, CutError> {
        Ok(tree_of(&self.cuts)?.partings().collect())
    }

    /// Returns whether it names balls to keep clear and nothing else, so that the planner cuts.
    pub fn is_only_clear(&self) -> bool {
        let bare = Self {
            keep_clear: self.keep_clear.clone(),
            ..Self::default()
        };
        !self.keep_clear.is_empty() && *self == bare
    }

    /// Returns the order with its cuts named as the planner names them: C1, C2, …
    pub(crate) fn numbered(&self) -> Self {
        let number = |id: &mut CutId| {
            if let Some(index) = index_of(&self.cuts, id) {
                *id = CutId::of(index);
            }
        };
        let mut renamed = self.clone();
        renamed
            .cuts
            .iter_mut()
            .flat_map(|cut| &mut cut.within)
            .for_each(|side| number(&mut side.cut));
        renamed.cuts.iter_mut().for_each(|cut| number(&mut cut.id));
        renamed
            .uncut
            .iter_mut()
            .for_each(|face| number(&mut face.cut));
        renamed
            .pins
            .iter_mut()
            .flatten()
            .for_each(|pin| number(&mut pin.cut));
        renamed
    }

    /// Reads an order from the TOML `text` of the file that messages call `file`. Returns an error
    /// with its place if the text is not TOML or not a valid order.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, TextFault> {
        toml_text::read(file, text)
    }

    /// Returns the order as the text of a file to edit. It reads back equal, to the bit.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        Ok(format!("{FILE_HEADER}{}", toml::to_string(self)?))
    }
}

impl TryFrom<Given> for CutOrder {
    type Error = OrderError;

    fn try_from(given: Given) -> Result<Self, OrderError> {
        let Given {
            pins,
            cuts,
            uncut,
            solid,
            keep_clear,
        } = given;
        if let Some(id) = find_duplicate(cuts.iter().map(|cut| &cut.id)) {
            return Err(OrderError::TwinCuts(id.clone()));
        }
        if let Some(id) = find_duplicate(pins.iter().flatten().map(|pin| &pin.id)) {
            return Err(OrderError::TwinPins(id.clone()));
        }
        if let Some(cut) = cuts.iter().find(|cut| cut.plane().is_err()) {
            return Err(OrderError::NoPlane(cut.id.clone()));
        }
        let known = |id: &CutId| index_of(&cuts, id).is_some();
        let mut sides = cuts
            .iter()
            .flat_map(|cut| cut.within.iter().map(move |side| (cut, side)));
        if let Some((cut, side)) = sides.find(|(_, side)| !known(&side.cut)) {
            return Err(OrderError::NoCut {
                by: Namer::Cut(cut.id.clone()),
                cut: side.cut.clone(),
            });
        }
        if tree_of(&cuts).is_err() {
            return Err(OrderError::Circular);
        }
        if let Some(face) = uncut.iter().find(|face| !known(&face.cut)) {
            return Err(OrderError::NoCut {
                by: Namer::UncutFace,
                cut: face.cut.clone(),
            });
        }
        for pin in pins.iter().flatten() {
            if !known(&pin.cut) {
                return Err(OrderError::NoCut {
                    by: Namer::Pin(pin.id.clone()),
                    cut: pin.cut.clone(),
                });
            }
            check_pin(pin).map_err(|reason| OrderError::BadPin {
                id: pin.id.clone(),
                reason,
            })?;
        }
        if let Some(index) = solid.iter().position(|end| !end.is_sound()) {
            return Err(OrderError::NoRegion(index + 1));
        }
        if let Some(index) = keep_clear.iter().position(|ball| !ball.is_sound()) {
            return Err(OrderError::NoBall(index + 1));
        }
        Ok(Self {
            pins,
            cuts,
            uncut,
            solid,
            keep_clear,
        })
    }
}

/// Returns the least id that occurs twice; `None` if every id is unique.
fn find_duplicate<'a, T: Ord>(ids: impl Iterator<Item = &'a T>) -> Option<&'a T> {
    let mut ids: Vec<&T> = ids.collect();
    ids.sort_unstable();
    let mut pairs = ids.windows(2);
    pairs.find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

/// Returns an error if the pin cannot be made.
fn check_pin(pin: &PinSite) -> Result<(), PinFault> {
    let sizes = [
        pin.diameter_mm,
        pin.length_mm,
        pin.socket_diameter_mm,
        pin.socket_depth_mm,
    ];
    let chamfers = [pin.chamfer_mm, pin.socket_chamfer_mm];
    let places = [pin.center_mm, pin.direction];
    if !places.as_flattened().iter().all(|x| x.is_finite()) || pin.direction == [0.0; 3] {
        return Err(PinFault::NoPlace);
    }
    if !sizes.iter().all(|size| size.is_finite() && *size > 0.0) {
        return Err(PinFault::NoSize);
    }
    if !chamfers
        .iter()
        .all(|chamfer| chamfer.is_finite() && *chamfer >= 0.0)
    {
        return Err(PinFault::NegativeChamfer);
    }
    if let Some(dowel) = &pin.dowel {
        if !(dowel.density_g_cm3 > 0.0 && dowel.density_g_cm3.is_finite()) {
            return Err(PinFault::NoDensity);
        }
        if !(dowel.length_mm > 0.0 && dowel.length_mm <= 2.0 * pin.socket_depth_mm) {
            return Err(PinFault::LongDowel);
        }
    }
    if 2.0 * pin.chamfer_mm >= pin.diameter_mm || pin.chamfer_mm >= pin.length_mm {
        return Err(PinFault::WideChamfer);
    }
    if pin.socket_chamfer_mm >= pin.socket_depth_mm {
        return Err(PinFault::DeepChamfer);
    }
    if pin.socket_diameter_mm <= pin.diameter_mm || pin.socket_depth_mm < pin.length_mm {
        return Err(PinFault::TightSocket);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::scenes::{ball, plan, plan_by, request, with_balls};
    use crate::cut::{LabelStyle, PlanRequest};

    fn ball_and_plan() -> (crate::cut::Hollowed, CutPlan) {
        let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
        let plan = plan(&body, &request()).unwrap();
        (body, plan)
    }

    #[test]
    fn a_plan_written_as_an_order_and_read_again_is_made_again_to_the_bit() {
        let (body, plan) = ball_and_plan();
        let text = CutOrder::of(&plan).to_toml().unwrap();
        let order = CutOrder::from_toml("cuts.toml", &text).unwrap();
        assert_eq!(order, CutOrder::of(&plan));
        let again = plan_by(&body, &request(), &order).unwrap();
        assert_eq!(
            (&again.cuts, &again.pins, &again.joints),
            (&plan.cuts, &plan.pins, &plan.joints)
        );
    }

    #[test]
    fn solid_regions_are_read_as_written_and_a_box_without_volume_is_refused() {
        let (body, plan) = ball_and_plan();
        let end = SolidEnd {
            at_mm: [0.5, 1.0 / 3.0, 8.0],
            low_mm: [0.0; 3],
            high_mm: [1.0, 2.0, 9.0],
        };
        let order = CutOrder {
            solid: vec![end],
            ..CutOrder::of(&plan)
        };
        let text = order.to_toml().unwrap();
        let read = CutOrder::from_toml("cuts.toml", &text).unwrap();
        assert_eq!(read, order);
        assert_eq!(
            CutOrder::of(&plan_by(&body, &request(), &read).unwrap()),
            order,
            "a plan made by it says it again"
        );
        for bad in [
            "high_mm = [1.0, 2.0, 0.0]",
            "high_mm = [1.0, 2.0, 7.9]",
            "high_mm = [1.0, nan, 9.0]",
        ] {
            let text = text.replace("high_mm = [1.0, 2.0, 9.0]", bad);
            let message = CutOrder::from_toml("cuts.toml", &text)
                .unwrap_err()
                .to_string();
            assert!(
                message.contains("solid region 1 is none; remedy: give `low_mm` below"),
                "{message}"
            );
        }
    }

    #[test]
    fn a_cut_keeps_its_given_name_everywhere_in_the_plan() {
        let (body, plan) = ball_and_plan();
        let text = CutOrder::of(&plan)
            .to_toml()
            .unwrap()
            .replace("\"C1\"", "\"waist\"");
        let order = CutOrder::from_toml("cuts.toml", &text).unwrap();
        let made = plan_by(&body, &request(), &order).unwrap();
        assert_eq!(
            serde_json::to_string(&made).unwrap().replace("waist", "C1"),
            {
                let notes = made.notes.clone();
                serde_json::to_string(&CutPlan { notes, ..plan }).unwrap()
            }
        );
    }

    #[test]
    fn a_face_without_room_for_an_id_is_named_by_the_users_cut() {
        let style = LabelStyle {
            stroke_mm: 30.0,
            depth_mm: 0.5,
            numbered: 0,
        };
        let request = PlanRequest {
            labels: Some(style),
            ..request()
        };
        let (body, plan) = ball_and_plan();
        let mut order = CutOrder::of(&plan).numbered();
        order.pins = None;
        order.cuts[0].id = "waist".into();
        let notes = plan_by(&body, &request, &order).unwrap().notes;
        let words = "no room for an id in the face of P01 in cut waist: write it on";
        assert!(
            notes.iter().any(|note| note.to_string() == words),
            "{notes:?}"
        );
    }

    #[test]
    fn pins_not_given_are_placed_and_an_empty_list_makes_none() {
        let (body, plan) = ball_and_plan();
        let cuts = CutOrder {
            pins: None,
            ..CutOrder::of(&plan)
        };
        assert_eq!(plan_by(&body, &request(), &cuts).unwrap().pins, plan.pins);
        let none = CutOrder {
            pins: Some(Vec::new()),
            ..cuts
        };
        assert!(plan_by(&body, &request(), &none).unwrap().pins.is_empty());
    }

    #[test]
    fn two_equal_ordered_pins_fit_in_two_ways_and_the_plan_says_so() {
        let (body, plan) = ball_and_plan();
        let mut order = CutOrder::of(&plan);
        let mut pins = plan.pins[..2].to_vec();
        let first = pins[0].clone();
        pins[1] = PinSite {
            id: "N2".into(),
            center_mm: pins[1].center_mm,
            ..first
        };
        order.pins = Some(pins);
        let made = plan_by(&body, &request(), &order).unwrap();
        assert!(
            !made.joints[0].one_way
                && made
                    .notes
                    .iter()
                    .any(|n| n.to_string().contains("more than one way")),
            "{made:?}"
        );
    }

    /// Text to replace in a written order, its replacement, and words of the expected message.
    const BROKEN: [(&str, &str, &str); 9] = [
        (
            "id = \"C1\"\npoint",
            "id = \"C2\"\npoint",
            "names cut C1, which is not there",
        ),
        ("id = \"N2\"", "id = \"N1\"", "pin N1 is there twice"),
        (
            "normal = ",
            "normal = [0.0, 0.0, 0.0] # ",
            "cut C1 has no direction",
        ),
        (
            "point_mm = ",
            "point_mm = [nan, 0.0, 0.0] # ",
            "cut C1 has no direction, or numbers that are not finite",
        ),
        (
            "diameter_mm = ",
            "diametre_mm = ",
            "did you mean `diameter_mm`",
        ),
        ("length_mm = ", "length_mm = -", "must be positive numbers"),
        (
            "chamfer_mm = ",
            "chamfer_mm = 9 # ",
            "chamfer must be less than its radius",
        ),
        (
            "socket_diameter_mm = ",
            "socket_diameter_mm = 0.01 # ",
            "its socket must be wider",
        ),
        (
            "direction = ",
            "direction = [0.0, 1.0] # ",
            "array of length 3",
        ),
    ];

    #[test]
    fn every_broken_order_is_refused_with_its_reason() {
        let whole = CutOrder::of(&ball_and_plan().1).to_toml().unwrap();
        for (from, to, reason) in BROKEN {
            assert!(whole.contains(from), "{from} in\n{whole}");
            let refused = CutOrder::from_toml("cuts.toml", &whole.replacen(from, to, 1));
            let message = refused.expect_err(to).to_string();
            assert!(
                message.starts_with("cuts.toml:") && message.contains(reason),
                "{to}: {message}"
            );
        }
    }
}
