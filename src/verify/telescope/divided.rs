//! Junctures in several parts: pins in their sockets, faces that meet, and parts that make the
//! whole.

use rayon::prelude::*;

use super::juncture::{DividedPromise, JuncturePromise, in_model};
use super::network::NetworkEvidence;
use super::network_ends::Ends;
use super::pinned::joint_faults;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Plane, Point, Vector};
use crate::mass::moments_of_mesh;
use crate::verify::cover::{Lie, ON_SHEET_MM, Sheet, Sheets, Whose};
use crate::verify::part_probe::PartProbe;
use crate::verify::pegs::{PegBearer, count_overlaps, lone_sockets, measure_pins};
use crate::verify::{Mark, PartEvidence, Peg, PegFacts};

/// A triangle, mm.
type Corners = [Point; 3];

/// The facts about a juncture in several parts.
#[derive(Debug, Clone, PartialEq)]
pub struct DividedFacts {
    /// Its name.
    pub id: String,
    /// The pins with their sockets.
    pub pegs: Vec<PegFacts>,
    /// Points of its parts that lie in another part too.
    pub overlaps: usize,
    /// Faces in cuts that meet no other part, and pins, sockets or ids that are not there.
    pub strays: Vec<String>,
    /// Difference of the parts' volume from that of the whole with its joints, as a share.
    pub volume_error_ratio: f64,
    /// Sockets of roots, and pegs, that lie in several parts.
    pub cut_through: Vec<String>,
}

/// The cuts of a juncture, with the surfaces that its parts have in them.
pub(super) struct Joints<'a> {
    promise: &'a JuncturePromise,
    divided: &'a DividedPromise,
    read: &'a [PartEvidence],
    /// The triangles of every part in the model's frame.
    parts: Vec<Vec<Corners>>,
    planes: Vec<Plane>,
    /// The surfaces of pins, sockets and ids, each of its part.
    own: Vec<Vec<Corners>>,
    reliefs: Sheets,
}

impl<'a> Joints<'a> {
    /// Prepares a juncture; `None` if it is in one part.
    pub fn of(evidence: &'a NetworkEvidence, juncture: usize) -> Option<Self> {
        let promise = &evidence.promise.junctures[juncture];
        let read = &evidence.junctures[juncture];
        let divided = promise.divided.as_ref()?;
        let cuts = divided.cuts.iter();
        let planes =
            cuts.map(|cut| Plane::through(&cut.point_mm.into(), &Vector::from(cut.normal)));
        let own = promise.parts.iter().map(|part| {
            let pins = part.pins.iter().map(Peg::pin_relief);
            let sockets = part.sockets.iter().map(Peg::socket_relief);
            let marks = part.marks.iter().map(Mark::relief);
            let reliefs = pins.chain(sockets).chain(marks);
            reliefs.flat_map(|relief| relief.own).collect()
        });
        let own: Vec<Vec<Corners>> = own.collect();
        Some(Self {
            promise,
            divided,
            read,
            parts: read
                .iter()
                .map(|part| in_model(part).iter_corners().collect())
                .collect(),
            planes: planes.collect(),
            reliefs: owned(&own),
            own,
        })
    }

    /// Returns whether a triangle of a part lies in a cut, or on a pin, a socket or an id.
    pub fn holds(&self, part: usize, corners: &Corners) -> bool {
        self.is_in_cut(corners) || self.is_on_relief(part, corners)
    }

    fn is_in_cut(&self, corners: &Corners) -> bool {
        self.planes.iter().any(|plane| {
            let mut corners = corners.iter();
            corners.all(|p| plane.distance(p).abs() <= ON_SHEET_MM)
        })
    }

    fn is_on_relief(&self, part: usize, corners: &Corners) -> bool {
        matches!(self.reliefs.lie(corners, Some(part)), Lie::On(_))
    }

    /// Measures the joints.
    pub fn facts(
        &self,
        evidence: &NetworkEvidence,
        ends: &[Ends],
        watch: &Watch,
    ) -> Result<DividedFacts, Cancelled> {
        let probes: Vec<PartProbe> = self.read.iter().map(PartProbe::new).collect();
        let bearers = self.promise.parts.iter().zip(&probes);
        let bearers: Vec<PegBearer> = bearers
            .map(|(part, probe)| PegBearer {
                pins: &part.pins,
                sockets: &part.sockets,
                part: probe,
            })
            .collect();
        let whole = Bvh::new(self.outside());
        watch.check()?;
        let pegs = measure_pins(&bearers, |_| self.divided.clearance_mm, &whole);
        let pegs = pegs.chain(lone_sockets(&bearers)).collect();
        let mut strays = self.strays();
        strays.extend(joint_faults(
            self.promise,
            &evidence.promise.juncture_joints,
        ));
        Ok(DividedFacts {
            id: self.promise.id.clone(),
            pegs,
            overlaps: count_overlaps(&probes, watch)?,
            strays,
            volume_error_ratio: self.volume_error_ratio(),
            cut_through: self.cut_through(evidence, ends),
        })
    }

    /// Returns the surface of the parts but for their joints.
    fn outside(&self) -> Vec<Corners> {
        let parts = self.parts.par_iter().enumerate();
        let outside = parts.flat_map_iter(|(part, triangles)| {
            let triangles = triangles.iter().copied();
            triangles.filter(move |corners| !self.holds(part, corners))
        });
        outside.collect()
    }

    /// Returns the parts whose faces in cuts meet no other part, or that lack what they promise.
    fn strays(&self) -> Vec<String> {
        let meets = self.facing();
        let found = owned(&self.parts);
        let parts = self.promise.parts.iter().enumerate();
        let faults = parts.flat_map(|(index, part)| {
            let is_off = |sheets: &Sheets, corners: &Corners| {
                matches!(sheets.lie(corners, Some(index)), Lie::Off(_))
            };
            let faces = self.parts[index].par_iter();
            let faces = faces.filter(|corners| self.is_in_cut(corners));
            let bare = faces.filter(|corners| is_off(&meets, corners)).count();
            let own = self.own[index].par_iter();
            let lost = own.filter(|corners| is_off(&found, corners)).count();
            let id = &part.id;
            let bare =
                (bare > 0).then(|| format!("{id} has {bare} triangles in a cut that meet no part"));
            let lost = (lost > 0)
                .then(|| format!("{id} lacks {lost} triangles of its pins, sockets and ids"));
            bare.into_iter().chain(lost)
        });
        faults.collect()
    }

    /// Returns the sheets that a face in a cut may meet: turned faces of other parts, and the
    /// mouths of what is sunk into them.
    fn facing(&self) -> Sheets {
        let parts = self.promise.parts.iter().zip(&self.parts).enumerate();
        let sheets = parts.flat_map(|(index, (part, triangles))| {
            let whose = Whose::AllBut(index);
            let faces = triangles.iter().filter(|corners| self.is_in_cut(corners));
            let turned = faces.map(|&[a, b, c]| [a, c, b]);
            let sockets = part.sockets.iter().map(Peg::socket_relief);
            let marks = part.marks.iter().map(Mark::relief);
            let mouths = sockets.chain(marks).flat_map(|relief| relief.mouth);
            let all = turned.chain(mouths);
            all.map(|corners| Sheet { corners, whose })
                .collect::<Vec<_>>()
        });
        Sheets::new(sheets.collect())
    }

    fn volume_error_ratio(&self) -> f64 {
        let sum = |pegs: &[Peg]| pegs.iter().map(|peg| peg.volume_mm3).sum::<f64>();
        let joints = self.promise.parts.iter().map(|part| {
            let marks: f64 = part.marks.iter().map(|mark| mark.volume_mm3).sum();
            sum(&part.pins) - sum(&part.sockets) - marks
        });
        let parts = self.read.iter();
        let found: f64 = parts.map(|part| moments_of_mesh(&part.mesh).volume()).sum();
        let whole_mm3 = self.divided.volume_mm3;
        (found - joints.sum::<f64>() - whole_mm3).abs() / whole_mm3
    }

    /// Returns the sockets of roots, and the pegs, that no part holds alone.
    fn cut_through(&self, evidence: &NetworkEvidence, ends: &[Ends]) -> Vec<String> {
        let id = &self.promise.id;
        let limbs = evidence.promise.limbs.iter().zip(ends);
        let is_own = |number: usize| evidence.promise.junctures[number - 1].id == *id;
        let faults = limbs.flat_map(|(limb, ends)| {
            let [sockets, pegs] = holders(&self.parts, ends);
            let socket = is_own(limb.from) && sockets != 1;
            let peg = is_own(limb.to) && pegs != 1;
            let name = &limb.id;
            let socket =
                socket.then(|| format!("no part of {id} holds the socket of {name} alone"));
            let peg = peg.then(|| format!("no part of {id} has the peg in {name} alone"));
            socket.into_iter().chain(peg)
        });
        faults.collect()
    }
}

/// Counts the parts with a piece of a limb's bore, and those with a piece of its peg.
fn holders(parts: &[Vec<Corners>], ends: &Ends) -> [usize; 2] {
    let holding = |is_of: &(dyn Fn(&Corners) -> bool + Sync)| {
        let holding = parts.iter().filter(|part| part.par_iter().any(is_of));
        holding.count()
    };
    [
        holding(&|corners| ends.is_in_bore(corners)),
        holding(&|corners| ends.is_on_peg(corners)),
    ]
}

/// Returns the sheets of triangles that belong to parts.
fn owned(parts: &[Vec<Corners>]) -> Sheets {
    let parts = parts.iter().enumerate();
    let sheets = parts.flat_map(|(index, triangles)| {
        let whose = Whose::Only(index);
        let triangles = triangles.iter();
        triangles.map(move |&corners| Sheet { corners, whose })
    });
    Sheets::new(sheets.collect())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::network_ends::tests::with_straight;
    use super::*;

    /// Returns the walls of a rod of 10 mm along x between two heights.
    fn wall(radius_mm: f64, from_mm: f64, to_mm: f64) -> Vec<Corners> {
        let at = |i: usize, x: f64| {
            let (sin, cos) = (TAU * i as f64 / 24.0).sin_cos();
            Point::new(x, radius_mm * cos, radius_mm * sin)
        };
        let flats = (0..24).flat_map(|i| {
            let [a, b] = [at(i, from_mm), at(i + 1, from_mm)];
            let [c, d] = [at(i, to_mm), at(i + 1, to_mm)];
            [[a, c, b], [b, c, d]]
        });
        flats.collect()
    }

    #[test]
    fn a_bore_and_a_peg_that_are_split_by_hand_are_held_by_two_parts() {
        with_straight(|ends| {
            let beside = wall(30.0, 0.0, 10.0);
            let whole = vec![
                [wall(5.0, 0.0, 10.0), beside.clone()].concat(),
                beside.clone(),
            ];
            assert_eq!(holders(&whole, ends), [1, 0]);
            let split = vec![wall(5.0, 0.0, 4.0), wall(5.0, 4.0, 10.0)];
            assert_eq!(holders(&split, ends)[0], 2);
            assert_eq!(holders(&[beside.clone(), beside], ends), [0, 0]);
            let peg = |from_mm, to_mm| wall(3.0, from_mm, to_mm);
            assert_eq!(holders(&[peg(100.0, 110.0)], ends), [0, 1]);
            assert_eq!(
                holders(&[peg(100.0, 105.0), peg(105.0, 110.0)], ends),
                [0, 2]
            );
        });
    }
}
