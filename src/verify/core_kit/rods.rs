//! Rods between polyhedra: each passes holes of both panels, is long enough, has its bore through
//! solid material, and is bought.

use std::f64::consts::{FRAC_PI_4, TAU};

use super::ballast::ballast_body;
use super::error::CoreVerifyError;
use super::evidence::CoreEvidence;
use super::joining::of_panel;
use super::panels::{panel_body, shared_mm3};
use super::rod_promise::RodPromise;
use crate::base::units::MM3_PER_CM3;
use crate::cutter::{Fastener, FastenerShape};
use crate::geom::{Bvh, Frame, Point, Vector};
use crate::mesh::{ClipError, Csg, TriMesh, primitives};
use crate::repair::weld;

/// By how much a rod may be beside its hole, or a length be off, mm.
const NEAR_MM: f64 = 1e-3;
/// The least and the greatest play of a rod in its hole, mm: glue fills it.
const PLAY_MM: [f64; 2] = [0.1, 1.0];
/// The greatest volume that a rod may share with anything else, mm³: rounding in files.
const SHARED_MM3: f64 = 0.05;
/// By how much a mass may be off, as a share.
const MASS_RATIO: f64 = 1e-9;
/// By how much the wall about a bore may be less than ordered, mm.
const WALL_SLACK_MM: f64 = 0.01;
/// The width of a saw's cut, mm.
const SAW_MM: f64 = 2.0;
/// Number of sides of a rod's body and of its holes.
const SIDES: u32 = 48;
/// Places along a rod, and about it at each, where there must be material.
const ALONG: usize = 24;
const ABOUT: usize = 8;
/// The share of the wall beside the bore at which it is looked for: a hollow's surface strays.
const DEEP_RATIO: f64 = 0.75;

impl RodPromise {
    /// Returns the unit direction of its axis from its first end; zero if both ends are one point.
    pub(super) fn way(&self) -> Vector {
        let [from, to] = self.ends_mm.map(Point::from);
        (to - from).try_normalize(0.0).unwrap_or_default()
    }

    /// Returns how far along its axis from its first end a point lies, and how far off it, mm.
    fn place_of(&self, at: &Point) -> [f64; 2] {
        let arm = at - Point::from(self.ends_mm[0]);
        let along_mm = arm.dot(&self.way());
        [along_mm, (arm - self.way() * along_mm).norm()]
    }

    /// Returns true if it has a size, and its length between its ends.
    pub(super) fn is_sized(&self) -> bool {
        let [from, to] = self.ends_mm.map(Point::from);
        let off_mm = ((to - from).norm() - self.length_mm).abs();
        self.diameter_mm > 0.0 && self.length_mm > 0.0 && off_mm <= NEAR_MM
    }

    /// Returns its body in the model, a cylinder of many sides.
    pub fn body(&self) -> TriMesh {
        self.bar(0.5 * self.diameter_mm, [0.0, self.length_mm])
    }

    /// Returns a round bar about its axis between two places along it, mm.
    fn bar(&self, radius_mm: f64, [from_mm, to_mm]: [f64; 2]) -> TriMesh {
        let way = self.way();
        let frame = Frame::with_axis(Point::from(self.ends_mm[0]) + way * from_mm, &way);
        primitives::cylinder(radius_mm, to_mm - from_mm, SIDES).map_vertices(|p| frame.to_model(p))
    }
}

/// A hole of a panel on the axis of a rod.
struct RodHole {
    /// The places at which the rod enters it and leaves it, mm from its first end.
    along_mm: [f64; 2],
    diameter_mm: f64,
}

/// Returns the hole of a panel, by its number, on the axis of a rod.
fn hole_of(evidence: &CoreEvidence, rod: &RodPromise, panel: usize) -> Option<RodHole> {
    let panel = panel.wrapping_sub(1);
    let of = evidence.panels.panels.get(panel)?;
    let frame = evidence.frame(panel);
    let thickness_mm = evidence.promise.sheet.thickness_mm;
    of.holes.iter().find_map(|hole| {
        let [x, y] = hole.at_mm;
        let ends = [0.0, -thickness_mm].map(|z| frame.to_model(&Point::new(x, y, z)));
        let [a, b] = ends.map(|end| rod.place_of(&end));
        (a[1].max(b[1]) <= NEAR_MM).then_some(RodHole {
            along_mm: [a[0].min(b[0]), a[0].max(b[0])],
            diameter_mm: hole.diameter_mm,
        })
    })
}

/// Returns the body of a panel, by its index, with the holes through which rods go.
pub(super) fn panel_for_rods(evidence: &CoreEvidence, panel: usize) -> Result<TriMesh, ClipError> {
    let rods = evidence.promise.rods.iter();
    let own = rods.filter(|rod| rod.is_sized() && rod.panels.contains(&(panel + 1)));
    let holes = own.filter_map(|rod| Some((rod, hole_of(evidence, rod, panel + 1)?)));
    let mut body = panel_body(evidence, panel);
    for (rod, hole) in holes {
        let [from_mm, to_mm] = hole.along_mm;
        let half_rad = 0.5 * TAU / f64::from(SIDES);
        let radius_mm = 0.5 * hole.diameter_mm / half_rad.cos();
        let bore = rod.bar(radius_mm, [from_mm - 1.0, to_mm + 1.0]);
        let bored = Csg::of_mesh(&body)?.subtract(&Csg::of_mesh(&bore)?)?;
        body = bored.to_mesh()?;
    }
    Ok(body)
}

/// Returns what is wrong with the rods, in words.
///
/// # Errors
/// The boolean engine fails.
pub fn rod_faults(evidence: &CoreEvidence) -> Result<Vec<String>, CoreVerifyError> {
    let rods = &evidence.promise.rods;
    let wrong = rods.iter().filter(|rod| !rod.is_sized());
    let mut faults: Vec<String> = wrong
        .map(|rod| format!("{} has not its length between its ends", rod.name))
        .collect();
    if faults.is_empty() {
        let judge = RodJudge::new(evidence)?;
        for (index, rod) in rods.iter().enumerate() {
            let words = |why: &str| format!("{} {why}", rod.name);
            faults.extend(judge.misfit(rod).map(words));
            faults.extend(judge.reaches(index, rod)?.map(|why| words(&why)));
        }
    }
    faults.extend(unbought(evidence));
    Ok(faults)
}

/// Returns the reason why a rod is not what the catalogue has under its id; `None` if it is.
fn misnamed(rod: &RodPromise) -> Option<&'static str> {
    let Ok(stocked) = Fastener::find(&rod.id) else {
        return Some("is in no catalogue");
    };
    let FastenerShape::Dowel {
        diameter_mm,
        length_mm,
        ..
    } = stocked.shape
    else {
        return Some("is no rod in the catalogue");
    };
    if [diameter_mm, length_mm] != [rod.diameter_mm, rod.stock_mm] {
        return Some("has another size than the rod of its name");
    }
    let stock_mm3 = FRAC_PI_4 * diameter_mm.powi(2) * length_mm;
    let density_g_cm3 = stocked.mass_g / stock_mm3 * MM3_PER_CM3;
    let is_heavy = (rod.density_g_cm3 / density_g_cm3 - 1.0).abs() <= MASS_RATIO;
    (!is_heavy).then_some("has another density than the rod of its name")
}

/// Returns the kinds of rods of which fewer are bought than are cut.
fn unbought(evidence: &CoreEvidence) -> Vec<String> {
    let promise = &evidence.promise;
    let mut ids: Vec<&String> = promise.rods.iter().map(|rod| &rod.id).collect();
    ids.sort_unstable();
    ids.dedup();
    let short = ids.into_iter().filter_map(|id| {
        let own = || promise.rods.iter().filter(|rod| rod.id == *id);
        let cut_mm: f64 = own().map(|rod| rod.length_mm).sum();
        let lengths_mm: Vec<f64> = own().map(|rod| rod.length_mm).collect();
        let stock_mm = own().map(|rod| rod.stock_mm).fold(f64::INFINITY, f64::min);
        let bought = promise.buy.iter().filter(|row| row.id == *id);
        let count: usize = bought.map(|row| row.count).sum();
        let is_long = lengths_mm.iter().any(|length_mm| *length_mm > stock_mm);
        let is_short = is_long || needed(lengths_mm, stock_mm) > count;
        is_short.then(|| format!("{count} of {id} are bought, too few for {cut_mm:.1} mm"))
    });
    short.collect()
}

/// Returns the number of rods as sold from which lengths are sawn, the longest first, each from
/// the first that has enough left.
fn needed(mut lengths_mm: Vec<f64>, stock_mm: f64) -> usize {
    lengths_mm.sort_by(|a, b| b.total_cmp(a));
    let mut left_mm: Vec<f64> = Vec::new();
    for length_mm in lengths_mm {
        match left_mm.iter_mut().find(|left| **left >= length_mm) {
            Some(left) => *left -= length_mm + SAW_MM,
            None => left_mm.push(stock_mm - length_mm - SAW_MM),
        }
    }
    left_mm.len()
}

/// Everything that rods may meet.
struct RodJudge<'a> {
    evidence: &'a CoreEvidence,
    surface: Bvh,
    /// The printed parts, and one search tree of each.
    trees: Vec<Bvh>,
    bodies: Vec<TriMesh>,
}

impl<'a> RodJudge<'a> {
    fn new(evidence: &'a CoreEvidence) -> Result<Self, CoreVerifyError> {
        let count = evidence.panels.panels.len();
        let panels = (0..count).map(|panel| panel_for_rods(evidence, panel));
        let panels: Vec<TriMesh> = panels.collect::<Result<_, ClipError>>()?;
        let laid = evidence.promise.ballast.iter().map(ballast_body);
        let parts = evidence.parts.iter().map(weld);
        Ok(Self {
            evidence,
            surface: Bvh::new(evidence.model.iter_corners()),
            trees: evidence
                .parts
                .iter()
                .map(|part| Bvh::new(part.iter_corners()))
                .collect(),
            bodies: parts.chain(panels).chain(laid).collect(),
        })
    }

    /// Returns the reason why a rod does not hold its panels; `None` if it does.
    fn misfit(&self, rod: &RodPromise) -> Option<&'static str> {
        if let Some(why) = misnamed(rod) {
            return Some(why);
        }
        let [a, b] = rod.panels.map(|panel| of_panel(self.evidence, panel));
        if a.is_none() || b.is_none() || a == b {
            return Some("does not join two polyhedra");
        }
        let [Some(first), Some(second)] =
            rod.panels.map(|panel| hole_of(self.evidence, rod, panel))
        else {
            return Some("does not pass a hole of each panel");
        };
        let plays = [&first, &second].map(|hole| hole.diameter_mm - rod.diameter_mm);
        if plays
            .iter()
            .any(|play| !(PLAY_MM[0]..=PLAY_MM[1]).contains(play))
        {
            return Some("has another play in its holes than glue needs");
        }
        let outside = first.along_mm[1] < second.along_mm[0];
        let stands = [first.along_mm[0], rod.length_mm - second.along_mm[1]];
        let is_told = |found: &f64| *found >= 0.0 && (found - rod.stands_mm).abs() <= NEAR_MM;
        if !outside || !stands.iter().all(is_told) {
            return Some("does not stand out of both panels inside as far as told");
        }
        let [from, to] = rod.ends_mm.map(Point::from);
        let least_mm = 0.5 * rod.diameter_mm + self.evidence.promise.wall_mm - WALL_SLACK_MM;
        let inner = [first.along_mm[1], second.along_mm[0]].map(|along| from + rod.way() * along);
        if self
            .surface
            .segment_distance(&inner[0], &inner[1], f64::INFINITY)
            < least_mm
        {
            return Some("has no wall between it and the surface");
        }
        if !self.is_embedded(rod, [&first, &second]) {
            return Some("has no solid material about its bore");
        }
        let expected_g =
            FRAC_PI_4 * rod.diameter_mm.powi(2) * rod.length_mm * rod.density_g_cm3 / MM3_PER_CM3;
        let middle = nalgebra::center(&from, &to);
        let is_weighed = (rod.mass_g / expected_g - 1.0).abs() <= MASS_RATIO
            && (middle - Point::from(rod.center_mm)).norm() <= NEAR_MM;
        (!is_weighed).then_some("does not weigh what its size and density make")
    }

    /// Returns true if there is material all about a rod, between its panels and off its bore.
    fn is_embedded(&self, rod: &RodPromise, [first, second]: [&RodHole; 2]) -> bool {
        let promise = &self.evidence.promise;
        let (Some(bore_mm), false) = (self.bore_mm(rod), promise.wall_mm.is_nan()) else {
            return false;
        };
        let room_mm = promise.gap_mm + DEEP_RATIO * promise.wall_mm;
        let (from_mm, to_mm) = (first.along_mm[1] + room_mm, second.along_mm[0] - room_mm);
        let away_mm = 0.5 * bore_mm + DEEP_RATIO * promise.wall_mm;
        let frame = Frame::with_axis(Point::from(rod.ends_mm[0]), &rod.way());
        let mut places = (0..ALONG * ABOUT).map(|place| {
            let share = ((place / ABOUT) as f64 + 0.5) / ALONG as f64;
            let angle = TAU * (place % ABOUT) as f64 / ABOUT as f64;
            let (sine, cosine) = angle.sin_cos();
            let along_mm = from_mm + (to_mm - from_mm) * share;
            frame.to_model(&Point::new(away_mm * cosine, away_mm * sine, along_mm))
        });
        places.all(|at| self.trees.iter().any(|tree| tree.winding(&at) > 0))
    }

    /// Returns the diameter of the widest listed bore on the axis of a rod, mm; `None` if none is
    /// wider than the rod.
    fn bore_mm(&self, rod: &RodPromise) -> Option<f64> {
        let parts = self.evidence.promise.parts.iter();
        let bosses = parts.flat_map(|part| &part.bosses);
        let own = bosses.filter(|boss| {
            let off_mm = rod.place_of(&Point::from(boss.foot_mm))[1];
            off_mm <= NEAR_MM && boss.bore_mm > rod.diameter_mm
        });
        own.map(|boss| boss.bore_mm).reduce(f64::max)
    }

    /// Returns words about what a rod shares with anything else; `None` if it does not.
    fn reaches(&self, index: usize, rod: &RodPromise) -> Result<Option<String>, CoreVerifyError> {
        let body = rod.body();
        let before = self.evidence.promise.rods[..index].iter();
        let before: Vec<TriMesh> = before.map(RodPromise::body).collect();
        // In the printed parts it must slide: a bar with the least play has room there.
        let loose = rod.bar(0.5 * (rod.diameter_mm + PLAY_MM[0]), [0.0, rod.length_mm]);
        let (parts, others) = self.bodies.split_at(self.trees.len());
        let mut shared = 0.0;
        for part in parts {
            shared += shared_mm3(&loose, part)?;
        }
        for other in others.iter().chain(&before) {
            shared += shared_mm3(&body, other)?;
        }
        Ok((shared > SHARED_MM3).then(|| format!("shares {shared:.1} mm³ with others")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_rods_longer_than_half_a_stock_need_three_and_saw_cuts_count() {
        assert_eq!(needed(vec![600.0; 3], 1000.0), 3);
        assert_eq!(needed(vec![499.0; 2], 1000.0), 1);
        assert_eq!(needed(vec![499.5; 2], 1000.0), 2);
        assert_eq!(needed(Vec::new(), 1000.0), 0);
    }
}
