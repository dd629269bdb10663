//! Pockets of voids that enclose resin in a vat: what lies below the lowest way out.

use super::doors::Door;
use super::prism::rims;
use super::rooms::Voids;
use crate::cells::{Chain, Corners};
use crate::geom::{Plane, Point, Vector};
use crate::mesh::union_find::UnionFind;

/// The heights of voids and openings in a vat.
pub(super) struct Pockets<'a> {
    voids: &'a Voids,
    up: Vector,
    /// The lowest point of each void, mm.
    low_mm: Vec<f64>,
    /// The openings, the lowest first.
    passes: Vec<Pass>,
}

/// An opening between two voids.
struct Pass {
    voids: [usize; 2],
    /// The height from which resin passes, mm.
    height_mm: f64,
}

impl<'a> Pockets<'a> {
    /// Measures the heights of voids and openings.
    pub fn of(voids: &'a Voids, doors: &[Door], opening_mm: f64, down: &Vector) -> Self {
        let up = -down;
        let least = |points: &[Point]| {
            let heights = points.iter().map(|at| up.dot(&at.coords));
            heights.fold(f64::INFINITY, f64::min)
        };
        let pass = |door: &Door| {
            let ends = rims(door.ends, opening_mm).map(|rim| least(&rim));
            Pass {
                voids: door.voids,
                height_mm: ends[0].max(ends[1]),
            }
        };
        let mut passes: Vec<Pass> = doors.iter().map(pass).collect();
        passes.sort_by(|a, b| a.height_mm.total_cmp(&b.height_mm));
        let low = voids.all.iter().map(|void| least(void.mesh.vertices()));
        Self {
            voids,
            up,
            low_mm: low.collect(),
            passes,
        }
    }

    /// Returns for each void if it is made: the worst stay solid until the pockets of the rest
    /// together have at most this volume, mm³.
    ///
    /// Connected voids are drained where they are lowest.
    pub fn kept(&self, most_mm3: f64) -> Vec<bool> {
        let mut kept = vec![true; self.low_mm.len()];
        let mut known = vec![(f64::NAN, 0.0); kept.len()];
        loop {
            let spills = self.spills(&kept);
            let mut worst = (0.0, None);
            let mut all_mm3 = 0.0;
            for (void, spill_mm) in spills.into_iter().enumerate().filter(|(v, _)| kept[*v]) {
                if known[void].0 != spill_mm {
                    known[void] = (spill_mm, self.below_mm3(void, spill_mm));
                }
                let (_, pocket_mm3) = known[void];
                all_mm3 += pocket_mm3;
                if pocket_mm3 > worst.0 {
                    worst = (pocket_mm3, Some(void));
                }
            }
            match worst.1 {
                Some(void) if all_mm3 > most_mm3 => kept[void] = false,
                _ => return kept,
            }
        }
    }

    /// Returns the height up to which each void encloses resin, mm.
    ///
    /// That is the summit of the lowest way to where its voids are drained. Openings join voids
    /// from the lowest on (Kruskal 1956).
    fn spills(&self, kept: &[bool]) -> Vec<f64> {
        let open = |pass: &&Pass| pass.voids.iter().all(|&void| kept[void]);
        let passes = || self.passes.iter().filter(open);
        let mut spills = vec![f64::INFINITY; kept.len()];
        for void in self.lowest(passes()) {
            spills[void] = self.low_mm[void];
        }
        let waits = |void: usize| match spills[void].is_finite() {
            true => Vec::new(),
            false => vec![void],
        };
        // The voids of each set that has no way out yet. A set with one waits for nothing.
        let mut waiting: Vec<Vec<usize>> = (0..kept.len()).map(waits).collect();
        let mut sets = UnionFind::new(kept.len());
        for pass in passes() {
            let [a, b] = pass.voids.map(|void| sets.root(void as u32));
            if a == b {
                continue;
            }
            sets.merge(a, b);
            let [one, other] = [a, b].map(|set| std::mem::take(&mut waiting[set as usize]));
            let is_out = one.is_empty() || other.is_empty();
            let both = one.into_iter().chain(other);
            match is_out {
                true => both.for_each(|void| spills[void] = pass.height_mm),
                false => waiting[sets.root(a) as usize] = both.collect(),
            }
        }
        spills
    }

    /// Returns the lowest void of each set that openings connect.
    fn lowest<'p>(&self, passes: impl Iterator<Item = &'p Pass>) -> Vec<usize> {
        let mut sets = UnionFind::new(self.low_mm.len());
        for pass in passes {
            let [a, b] = pass.voids.map(|void| void as u32);
            sets.merge(a, b);
        }
        let (labels, count) = sets.labels();
        let mut lowest: Vec<Option<usize>> = vec![None; count];
        for (void, label) in labels.into_iter().enumerate() {
            let known = &mut lowest[label as usize];
            if known.is_none_or(|known| self.low_mm[void] < self.low_mm[known]) {
                *known = Some(void);
            }
        }
        lowest.into_iter().flatten().collect()
    }

    /// Returns the volume of a void below a height, mm³.
    fn below_mm3(&self, void: usize, height_mm: f64) -> f64 {
        if height_mm <= self.low_mm[void] {
            return 0.0;
        }
        let triangles: Vec<Corners> = self.voids.all[void].mesh.iter_corners().collect();
        let plane = Plane {
            normal: self.up,
            offset_mm: height_mm,
        };
        Chain::new(triangles).below(&plane).volume_mm3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comb::rooms::Void;
    use crate::mesh::MeshDistance;
    use crate::mesh::primitives::cuboid;

    /// Three cubes of 9 mm in a row along x, the last one 5 mm lower.
    fn row() -> Voids {
        let void = |cell: usize| {
            let low = Point::new(10.0 * cell as f64, 0.0, [0.0, 0.0, -5.0][cell]);
            let mesh = cuboid(&low, &(low + Vector::new(9.0, 9.0, 9.0)));
            Void {
                cell,
                distance: MeshDistance::new(&mesh),
                volume_mm3: mesh.signed_volume_mm3(),
                mesh,
            }
        };
        Voids {
            all: (0..3).map(void).collect(),
            drawn_in: Vec::new(),
        }
    }

    /// An opening of 2 mm from the void before this one, whose middle is at this height.
    fn door(to: usize, height_mm: f64) -> Door {
        let at = |x: f64| Point::new(x, 4.5, height_mm);
        let x = 10.0 * to as f64;
        Door {
            voids: [to - 1, to],
            cells: [to - 1, to],
            ends: [at(x - 1.0), at(x)],
            room_mm: 3.0,
        }
    }

    #[test]
    fn resin_stays_below_the_summit_of_the_lowest_way_to_the_lowest_void() {
        let voids = row();
        let pockets = Pockets::of(&voids, &[door(1, 2.0), door(2, 3.0)], 2.0, &-Vector::z());
        let spills = pockets.spills(&[true; 3]);
        // The lowest place of an opening is 1 mm and a little below its middle.
        assert!((spills[0] - 2.0).abs() < 0.05 && (spills[1] - 2.0).abs() < 0.05);
        assert_eq!(spills[2], -5.0);
        let alone = pockets.spills(&[true, false, true]);
        assert_eq!([alone[0], alone[2]], [0.0, -5.0]);
        assert!((pockets.below_mm3(0, 2.0) - 162.0).abs() < 1e-9);
    }

    #[test]
    fn the_voids_with_the_largest_pockets_stay_solid() {
        let voids = row();
        let doors = [door(1, 1.2), door(2, 1.2)];
        let pockets = Pockets::of(&voids, &doors, 2.0, &-Vector::z());
        assert_eq!(pockets.kept(100.0), [true; 3]);
        // Of two alike the first stays solid, and the second is behind the high opening still.
        let high = [door(1, 1.2), door(2, 4.0)];
        let pockets = Pockets::of(&voids, &high, 2.0, &-Vector::z());
        assert_eq!(pockets.kept(100.0), [false, false, true]);
        assert_eq!(pockets.kept(300.0), [false, true, true]);
    }
}
