//! Ballast on the inner side of the lowest panel: which pieces, how many, and where.

use super::asked::Asked;
use super::hardware::epoxy_film;
use super::made::Made;
use super::mass::{Weighed, lean_deg, point};
use crate::ballast::{BallastError, MOST_PARTS, Order, Part, catalogue, find};
use crate::cladding::{FlatThing, places_on};
use crate::cutter::FastenerShape;
use crate::geom::{Frame, Plane, Point};
use crate::goal::Goal;
use crate::mass::{Lump, LumpShape, Moments, rims};
use crate::verify::BallastPromise;

/// Distance of pieces from each other and from the other panels, mm.
const APART_MM: f64 = 1.0;

/// Returns the object with the ballast that is ordered, as far as that finds room. It stays as it
/// is if none is ordered, or if it stands without. Too little room is told by
/// [`too_few`](super::advise::too_few).
///
/// All pieces are of one kind. Each goes to the place at which the object then leans the farthest.
/// Of all kinds, those are taken that weigh the least together. They do even if each is lighter by
/// what its stock allows.
///
/// # Errors
/// The catalogue is at fault, or a part is ordered that does not lie flat.
pub fn ballasted(
    asked: &Asked,
    made: &Made,
    weighed: Weighed,
    order: &Order,
) -> Result<Weighed, BallastError> {
    let (Some(goal), Some(floor)) = (&asked.goal, Floor::find(asked, made)) else {
        return Ok(weighed);
    };
    let stands = lean_deg(goal, &weighed.whole) >= asked.job.least_angle_deg;
    let laid = match order {
        Order::None => None,
        Order::Auto if stands => None,
        Order::Auto => {
            let mut flat = catalogue()?;
            flat.retain(is_flat);
            let all = flat
                .iter()
                .filter_map(|part| floor.fewest(goal, &weighed, part));
            all.reduce(|a, b| if b.mass_g() < a.mass_g() { b } else { a })
        }
        Order::Parts { id, count: None } => floor.fewest(goal, &weighed, &flat_part(id)?),
        Order::Parts {
            id,
            count: Some(count),
        } => floor.laid(goal, &weighed, &flat_part(id)?, *count as usize),
    };
    Ok(match laid {
        Some(laid) => floor.add(weighed, &laid),
        None => weighed,
    })
}

fn is_flat(part: &Part) -> bool {
    matches!(part.shape, LumpShape::Disc { .. })
}

/// Returns the part of an id, if it lies flat.
fn flat_part(id: &str) -> Result<Part, BallastError> {
    let part = find(id)?;
    if is_flat(&part) {
        return Ok(part);
    }
    let flat = catalogue()?.into_iter().rev().filter(is_flat);
    let flat: Vec<String> = flat.map(|part| part.id).collect();
    Err(BallastError::Unknown {
        id: id.to_owned(),
        remedy: format!(
            "it does not lie flat on a panel; use one of {}",
            flat.join(", ")
        ),
    })
}

/// The lowest panel of an object, seen from inside.
struct Floor<'a> {
    asked: &'a Asked<'a>,
    made: &'a Made,
    /// The index of the panel.
    panel: usize,
    /// The planes of its polyhedron, but for its own.
    others: Vec<Plane>,
}

/// Pieces of one kind on the floor.
struct Laid {
    part: Part,
    /// The middles of the sides on which they lie, in the frame of the panel, mm.
    places_mm: Vec<[f64; 2]>,
}

impl Laid {
    fn mass_g(&self) -> f64 {
        self.part.mass_g * self.places_mm.len() as f64
    }
}

impl<'a> Floor<'a> {
    fn find(asked: &'a Asked, made: &'a Made) -> Option<Self> {
        let plan = &made.built.plan;
        let face = plan.bottom_face(&asked.up)?;
        let panels = &made.built.shell.panels.panels;
        let panel = panels.iter().position(|panel| panel.face == face)?;
        let mut bodies = plan.polyhedra.iter().enumerate();
        let (first, own) = bodies.find_map(|(index, body)| {
            let first = plan.faces_before(index);
            (face < first + body.faces().len()).then_some((first, body))
        })?;
        let mut others = own.planes();
        others.remove(face - first);
        Some(Self {
            asked,
            made,
            panel,
            others,
        })
    }

    /// Returns the fewest pieces of a kind that let the object lean as far as asked; `None` if no
    /// number that finds room does.
    fn fewest(&self, goal: &Goal, weighed: &Weighed, part: &Part) -> Option<Laid> {
        let least_deg = self.asked.job.least_angle_deg;
        let mut laid = self.laid(goal, weighed, part, MOST_PARTS as usize)?;
        let light = |count: usize| self.lean_with(goal, weighed, &laid, count);
        let count = (1..=laid.places_mm.len()).find(|&count| light(count) >= least_deg)?;
        laid.places_mm.truncate(count);
        Some(laid)
    }

    /// Returns the lean with the first so many pieces, each as light as its stock allows, degrees.
    fn lean_with(&self, goal: &Goal, weighed: &Weighed, laid: &Laid, count: usize) -> f64 {
        let lighter = 1.0 - laid.part.mass_spread_ratio;
        let places = laid.places_mm[..count].iter();
        let more = places.map(|at| self.moments(&laid.part, *at, lighter));
        lean_deg(goal, &more.fold(weighed.whole, |all, one| all + one))
    }

    /// Lays pieces of a kind one by one, each where the object then leans the farthest. `None` if
    /// none finds room.
    fn laid(&self, goal: &Goal, weighed: &Weighed, part: &Part, count: usize) -> Option<Laid> {
        let mut free = self.places(part);
        let mut whole = weighed.whole;
        let mut places_mm: Vec<[f64; 2]> = Vec::new();
        let apart_mm = 2.0 * part.shape.radius_mm() + APART_MM;
        while places_mm.len() < count {
            let with = |at: &[f64; 2]| whole + self.moments(part, *at, 1.0);
            let leans = free.iter().map(|at| (lean_deg(goal, &with(at)), *at));
            let best = leans.reduce(|a, b| if b.0 > a.0 { b } else { a });
            let Some((_, best)) = best else { break };
            whole = with(&best);
            places_mm.push(best);
            free.retain(|at| (at[0] - best[0]).hypot(at[1] - best[1]) >= apart_mm);
        }
        (!places_mm.is_empty()).then(|| Laid {
            part: part.clone(),
            places_mm,
        })
    }

    /// Returns the places at which a piece has room.
    fn places(&self, part: &Part) -> Vec<[f64; 2]> {
        let shell = &self.made.built.shell;
        let screws = [&self.asked.screws.screw, &self.asked.bracket_screw];
        let heads = screws.map(|screw| match screw.shape {
            FastenerShape::Screw {
                head_diameter_mm, ..
            } => head_diameter_mm,
            _ => 0.0,
        });
        let thing = FlatThing {
            diameter_mm: 2.0 * part.shape.radius_mm(),
            height_mm: 2.0 * part.shape.half_height_mm(),
            heads_mm: heads.into_iter().fold(0.0, f64::max),
        };
        let mut places = places_on(&shell.panels, self.panel, &self.asked.panels, &thing);
        let inside_mm = -(self.asked.panels.sheet_mm + APART_MM);
        places.retain(|at| {
            let lump = self.lump(part, *at);
            let sizes = [part.shape.radius_mm(), part.shape.half_height_mm()];
            let rim = rims(&Point::from(lump.center_mm), &self.frame().axis(), sizes);
            let is_inside = |plane: &Plane| rim.iter().all(|p| plane.distance(p) <= inside_mm);
            self.others.iter().all(is_inside)
        });
        places
    }

    fn frame(&self) -> &Frame {
        &self.made.built.shell.panels.panels[self.panel].frame
    }

    /// Returns a piece in its place on the panel.
    fn lump(&self, part: &Part, [x, y]: [f64; 2]) -> Lump {
        let height_mm = self.asked.panels.sheet_mm + part.shape.half_height_mm();
        Lump {
            shape: part.shape,
            mass_g: part.mass_g,
            center_mm: self.frame().to_model(&Point::new(x, y, -height_mm)).into(),
            axis: self.frame().axis().into(),
        }
    }

    /// Returns the moments of a piece of a share of its mass, as a point, with its glue.
    fn moments(&self, part: &Part, at: [f64; 2], share: f64) -> Moments {
        let film = self.film(part, at);
        let lump = self.lump(part, at);
        point(share * lump.mass_g, lump.center_mm) + point(film.mass_g, film.center_mm)
    }

    /// Returns the glue below a piece.
    fn film(&self, part: &Part, [x, y]: [f64; 2]) -> crate::verify::GluePromise {
        let area_mm2 = std::f64::consts::PI * part.shape.radius_mm().powi(2);
        let foot = Point::new(x, y, -self.asked.panels.sheet_mm);
        let joint = format!("ballast and panel {}", self.panel + 1);
        epoxy_film(joint, area_mm2, self.frame().to_model(&foot))
    }

    /// Adds pieces to what is weighed.
    fn add(&self, mut weighed: Weighed, laid: &Laid) -> Weighed {
        for &at in &laid.places_mm {
            let film = self.film(&laid.part, at);
            weighed.ballast_g += laid.part.mass_g;
            weighed.glue_g += film.mass_g;
            weighed.whole += self.moments(&laid.part, at, 1.0);
            weighed.glue.push(film);
            weighed.ballast.push(BallastPromise {
                id: laid.part.id.clone(),
                panel: self.panel + 1,
                at_mm: at,
                lump: self.lump(&laid.part, at),
            });
        }
        weighed
    }
}
