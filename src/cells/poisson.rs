//! First sites that keep their distance: darts, of which those too near to others are lost.

use std::collections::HashMap;

use super::room::Room;
use crate::base::random::Random;
use crate::base::words::choice;
use crate::geom::Point;

/// The least distance of two first sites, as a share of the size wished there. Darts alone can fill
/// a space up to 0.9.
const SHARE: f64 = 0.7;
/// Part by which the distance shrinks after so many darts were lost.
const SHRINKING: f64 = 0.95;
/// Darts lost one after another before the distance shrinks.
const MOST_LOST: usize = 2000;
/// Most throws for a site.
const MOST_THROWS: usize = 20_000;
/// Places along each side of the box at which sizes are sampled.
const SAMPLES: usize = 40;

choice! {
    /// The throw of the first sites.
    Start, "start" {
        /// Sites that keep their distance, as dense as cells are small.
        Poisson = "poisson",
        /// Sites anywhere.
        Random = "random",
    }
}

/// The size of a cell wished at a place, mm.
pub type SizeAt<'a> = dyn Fn(&Point) -> f64 + Sync + 'a;

/// The sizes of cells that are wished in a room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sizes {
    /// The least of the samples, mm.
    pub least_mm: f64,
    /// The greatest of the samples, mm.
    pub most_mm: f64,
    /// ∫ 1/a³, the number of cells of these sizes.
    pub count: f64,
}

impl Sizes {
    /// Samples the sizes in a room at a grid of places. A constant size has its exact count.
    pub fn of(room: &Room, size: &SizeAt<'_>) -> Self {
        let [mut least_mm, mut most_mm] = [f64::INFINITY, 0.0_f64];
        let (mut sum, mut found) = (0.0, 0_usize);
        for at in samples(room) {
            let here = size(&at);
            least_mm = least_mm.min(here);
            most_mm = most_mm.max(here);
            sum += here.powi(-3);
            found += 1;
        }
        Self {
            least_mm,
            most_mm,
            count: room.volume_mm3() * sum / found.max(1) as f64,
        }
    }
}

/// Returns the places of a grid that lie in a room. In one too thin for any it is the middle.
pub fn samples(room: &Room) -> Vec<Point> {
    let bounds = room.bounds();
    let along = |axis: usize, k: usize| {
        let share = (k as f64 + 0.5) / SAMPLES as f64;
        bounds.min[axis] + share * (bounds.max[axis] - bounds.min[axis])
    };
    let places = (0..SAMPLES.pow(3)).map(|k| {
        let [i, j] = [k % SAMPLES, k / SAMPLES % SAMPLES];
        Point::new(along(0, i), along(1, j), along(2, k / SAMPLES / SAMPLES))
    });
    let mut found: Vec<Point> = places.filter(|at| room.holds(at)).collect();
    if found.is_empty() {
        found.push(bounds.center());
    }
    found
}

/// Returns so many points of a room that are as dense as the wished sizes are small.
///
/// No two are nearer than 0.7 of the lesser size wished at them. Where so many do not fit, that
/// share shrinks by steps of 5 %. A room that hardly any dart meets gets fewer. The same seed gives
/// the same points on any machine.
pub fn poisson_sites(room: &Room, count: usize, size: &SizeAt<'_>, seed: u64) -> Vec<Point> {
    let bounds = room.bounds();
    let least_mm = Sizes::of(room, size).least_mm;
    let mut random = Random::new(seed);
    let mut thrown = Thrown::new(least_mm);
    let (mut share, mut lost) = (SHARE, 0);
    for _ in 0..count.saturating_mul(MOST_THROWS) {
        if thrown.sites.len() == count {
            break;
        }
        let at = [0, 1, 2].map(|axis| random.between(bounds.min[axis], bounds.max[axis]));
        let at = Point::from(at);
        let chance = random.between(0.0, 1.0);
        if !room.holds(&at) {
            continue;
        }
        let here_mm = size(&at);
        // Sizes between the samples may be a little less than the least one.
        if chance > (least_mm / here_mm).powi(3) {
            continue;
        }
        if thrown.is_near(&at, [share, here_mm]) {
            lost += 1;
        } else {
            thrown.add(at, here_mm);
            lost = 0;
        }
        if lost == MOST_LOST {
            share *= SHRINKING;
            lost = 0;
        }
    }
    thrown.sites
}

/// The darts that are kept, in the boxes of a grid.
struct Thrown {
    side_mm: f64,
    sites: Vec<Point>,
    sizes_mm: Vec<f64>,
    boxes: HashMap<[i64; 3], Vec<usize>>,
}

impl Thrown {
    fn new(side_mm: f64) -> Self {
        Self {
            side_mm,
            sites: Vec::new(),
            sizes_mm: Vec::new(),
            boxes: HashMap::new(),
        }
    }

    fn place(&self, at: &Point) -> [i64; 3] {
        [0, 1, 2].map(|axis| (at[axis] / self.side_mm).floor() as i64)
    }

    fn add(&mut self, at: Point, size_mm: f64) {
        let place = self.place(&at);
        self.boxes.entry(place).or_default().push(self.sites.len());
        self.sites.push(at);
        self.sizes_mm.push(size_mm);
    }

    /// Returns true if a site is nearer than a share of its own size and of the size here.
    fn is_near(&self, at: &Point, [share, here_mm]: [f64; 2]) -> bool {
        let reach_mm = share * here_mm;
        let [low, high] = [-reach_mm, reach_mm].map(|by| {
            let moved = at.map(|x| x + by);
            self.place(&moved)
        });
        let is_too_near = |&index: &usize| {
            let apart_mm = (self.sites[index] - at).norm();
            apart_mm < share * here_mm.min(self.sizes_mm[index])
        };
        (low[2]..=high[2]).any(|z| {
            (low[1]..=high[1]).any(|y| {
                (low[0]..=high[0]).any(|x| {
                    let found = self.boxes.get(&[x, y, z]);
                    found.is_some_and(|sites| sites.iter().any(is_too_near))
                })
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Aabb;

    fn room() -> Room {
        Room::of_box(Aabb {
            min: Point::origin(),
            max: Point::new(10.0, 10.0, 10.0),
        })
    }

    fn nearest_mm(sites: &[Point]) -> f64 {
        let pairs = sites.iter().enumerate().flat_map(|(k, a)| {
            let others = sites[..k].iter();
            others.map(move |b| (a - b).norm())
        });
        pairs.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn sites_keep_their_distance_and_are_as_many_as_asked() {
        for seed in 0..5 {
            let sites = poisson_sites(&room(), 1000, &|_| 1.0, seed);
            assert_eq!(sites.len(), 1000);
            assert!(nearest_mm(&sites) >= 0.7, "{}", nearest_mm(&sites));
        }
        assert_eq!(
            poisson_sites(&room(), 50, &|_| 2.5, 3),
            poisson_sites(&room(), 50, &|_| 2.5, 3)
        );
    }

    #[test]
    fn more_sites_than_fit_come_nearer_and_stay_as_even_as_they_can() {
        let sites = poisson_sites(&room(), 3000, &|_| 1.0, 1);
        assert_eq!(sites.len(), 3000);
        let nearest = nearest_mm(&sites);
        assert!((0.45..0.7).contains(&nearest), "{nearest}");
    }

    #[test]
    fn sites_are_as_dense_as_sizes_are_small() {
        let size = |at: &Point| if at.x < 5.0 { 1.0 } else { 2.0 };
        let sizes = Sizes::of(&room(), &size);
        assert!((sizes.count - (500.0 + 500.0 / 8.0)).abs() < 1e-9);
        assert_eq!((sizes.least_mm, sizes.most_mm), (1.0, 2.0));
        let sites = poisson_sites(&room(), 562, &size, 4);
        let fine = sites.iter().filter(|at| at.x < 5.0).count();
        // A ninth of 562 lies in the coarse half; the deviation is that of a few dozen throws.
        assert!((480..520).contains(&fine), "{fine}");
        let coarse: Vec<Point> = sites.into_iter().filter(|at| at.x >= 5.0).collect();
        assert!(nearest_mm(&coarse) >= 1.3, "{}", nearest_mm(&coarse));
    }

    #[test]
    fn a_constant_size_has_its_exact_count() {
        let sizes = Sizes::of(&room(), &|_| 2.0);
        assert!((sizes.count - 125.0).abs() < 1e-9);
    }
}
