//! Cells inside of a region of a solid: walls with openings between their voids, and no skin of
//! their own. What is around the region is their skin.

use rayon::prelude::*;

use super::build::union_of;
use super::doors::{APART_RATIO, Door, Sizes, doors};
use super::error::CombError;
use super::pockets::Pockets;
use super::rooms::{Void, Voids, voids};
use crate::base::watch::Watch;
use crate::cells::{Body, Cell, Norm, Order, Room, cells, poisson_sites, relax};
use crate::geom::{Point, Vector};
use crate::mesh::union_find::UnionFind;
use crate::mesh::{Csg, MeshDistance, Solid, TriMesh};
use crate::printer::{Printer, Undrainable};

/// Most steps of the relaxation of cells.
const STEPS: usize = 16;
/// The movement of a site that is no movement any more, in sizes of a cell.
const STILL_RATIO: f64 = 0.01;
/// The usual size of a cell, in sizes of the least cube whose sides hold an opening. Relaxed cells
/// are no cubes: their sides are smaller, and a hole from outside must end in one.
const USUAL_RATIO: f64 = 2.25;
/// The same in a vat. Each cell encloses some resin below its openings, whatever its size.
const VAT_RATIO: f64 = 4.0;
/// Least volume of connected voids, in voids of a whole cell. Less stays solid: where a region
/// only just enters a cell, its void would come and go with every step of a solve.
const LEAST_SHARE: f64 = 0.5;
/// Volume of all places of cells together that may enclose resin in a vat, mm³. Poses count a part
/// with 75 mm³ as one that makes a cup, by another grid.
const MOST_POCKETS_MM3: f64 = 60.0;
/// Seed of the first sites.
const SEED: u64 = 0;

/// The sizes of cells inside of a region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InnerSizes {
    /// The size of a cell: there are as many as cubes of this side fill the region, mm.
    pub size_mm: f64,
    /// The wall between two voids, mm.
    pub wall_mm: f64,
    /// The free diameter of each opening, mm.
    pub opening_mm: f64,
    /// The unit direction in which openings lie as far as they can; `None` for the middle of walls.
    /// In a vat that is where a cell begins: what lies farther down would catch resin.
    pub down: Option<Vector>,
}

impl InnerSizes {
    /// Returns the usual sizes for a printer: walls of this thickness, and openings of the least
    /// width that empties a void by itself.
    ///
    /// # Errors
    /// No opening empties a void of this process.
    pub fn for_printer(printer: &Printer, wall_mm: f64) -> Result<Self, Undrainable> {
        printer.drain_need(None)?;
        // A cell may have one opening only, so that the width that two may have does not do.
        let opening_mm = printer.min_opening_mm.value;
        let plain = Self {
            size_mm: 0.0,
            wall_mm,
            opening_mm,
            down: None,
        };
        let usual_ratio = match printer.prints_in_vat() {
            true => VAT_RATIO,
            false => USUAL_RATIO,
        };
        Ok(Self {
            size_mm: (2.0 * usual_ratio * plain.least_mm()).ceil() / 2.0,
            ..plain
        })
    }

    /// Returns the least size of a cell: two walls, and a cube whose sides hold an opening, mm.
    pub fn least_mm(&self) -> f64 {
        let cube_mm = self.wall_mm + 2.0 * self.doors().room_mm();
        cube_mm.max(2.0 * self.wall_mm)
    }

    /// Returns the printed share of cubes of this size between such walls, openings left out.
    pub fn cube_density(&self) -> f64 {
        1.0 - self.cube_void_mm3() / self.size_mm.powi(3)
    }

    fn cube_void_mm3(&self) -> f64 {
        (self.size_mm - self.wall_mm).max(0.0).powi(3)
    }

    fn doors(&self) -> Sizes {
        Sizes {
            wall_mm: self.wall_mm,
            opening_mm: self.opening_mm,
            room_ratio: APART_RATIO,
        }
    }
}

/// Voids that are made.
struct Connected {
    /// The sets that openings connect.
    sets: Vec<Vec<usize>>,
    doors: Vec<Door>,
}

/// A region divided into cells, of which any part can be made of their walls.
#[derive(Debug, Clone)]
pub struct InnerCells {
    /// Their sizes.
    pub sizes: InnerSizes,
    cells: Vec<Cell>,
}

/// The voids of cells in a part of the region.
#[derive(Debug, Clone, Default)]
pub struct InnerVoids {
    /// The bodies of air, the largest first.
    pub made: Vec<CellVoid>,
    /// The cells that the part enters and that stay solid. They do not touch each other.
    pub solid: TriMesh,
    /// The share of their own places in the whole region that the cells with air print.
    pub density: f64,
}

/// A body of air: voids of cells that openings connect.
#[derive(Debug, Clone)]
pub struct CellVoid {
    /// Its surface, outward.
    pub body: Solid,
    /// A place in each of its cells.
    pub places: Vec<Point>,
    /// The ends of the axes of its openings.
    pub doors: Vec<[Point; 2]>,
}

impl InnerCells {
    /// Divides a region into relaxed cells, near cubes along the axes of the model.
    ///
    /// # Errors
    /// The watch was stopped.
    pub fn divide(region: &TriMesh, sizes: InnerSizes, watch: &Watch) -> Result<Self, CombError> {
        let triangles: Vec<_> = region.iter_corners().collect();
        if triangles.is_empty() {
            let cells = Vec::new();
            return Ok(Self { sizes, cells });
        }
        let room = Room::of_triangles(&triangles, sizes.size_mm);
        let count = (room.volume_mm3() / sizes.size_mm.powi(3)).round().max(1.0);
        let mut sites = poisson_sites(&room, count as usize, &|_| sizes.size_mm, SEED);
        let order = Order {
            norm: Norm::Linf,
            steps: STEPS,
            still_mm: STILL_RATIO * sizes.size_mm,
            frame: None,
            weight: None,
        };
        relax(&mut sites, &room, &order, || watch.check().is_err());
        watch.check()?;
        let cells = cells(&sites, &room);
        Ok(Self { sizes, cells })
    }

    /// Returns the number of cells.
    pub fn count(&self) -> usize {
        self.cells.len()
    }

    /// Returns the voids of the cells in a part of the region.
    ///
    /// Every wall between two voids that can hold an opening gets one. Connected voids that
    /// together are less than half a cell stay solid. So do those that would enclose resin in a
    /// vat.
    ///
    /// # Errors
    /// A void cannot be drawn, or the watch was stopped.
    pub fn within(&self, region: &TriMesh, watch: &Watch) -> Result<InnerVoids, CombError> {
        if region.is_empty() || self.cells.is_empty() {
            return Ok(InnerVoids::default());
        }
        let voids = voids(&self.cells, region, self.sizes.wall_mm, watch)?;
        watch.check()?;
        let drained = self.drained(&voids, &MeshDistance::new(region));
        let join = |set: &Vec<usize>| {
            watch.check()?;
            self.join(&voids, set, &drained.doors)?.cleaned(watch)
        };
        let bodies: Result<Vec<CellVoid>, CombError> = drained.sets.par_iter().map(join).collect();
        let mut made = bodies?;
        let volume = |void: &CellVoid| void.body.mesh().signed_volume_mm3();
        made.sort_by(|a, b| volume(b).total_cmp(&volume(a)));
        let mut has_air = vec![false; self.cells.len()];
        let voids_made = drained.sets.iter().flatten();
        voids_made.for_each(|&void| has_air[voids.all[void].cell] = true);
        let parts = self
            .cells
            .iter()
            .zip(&has_air)
            .filter(|(_, has_air)| **has_air);
        let parts_mm3: f64 = parts.map(|(cell, _)| cell.part.volume_mm3()).sum();
        let air_mm3: f64 = made.iter().map(volume).sum();
        Ok(InnerVoids {
            made,
            solid: self.solid(&voids, &has_air),
            density: 1.0 - air_mm3 / parts_mm3.max(f64::MIN_POSITIVE),
        })
    }

    /// Joins the cells that have voids and no air.
    fn solid(&self, voids: &Voids, has_air: &[bool]) -> TriMesh {
        let mut solid: Vec<usize> = voids.all.iter().map(|void| void.cell).collect();
        solid.dedup();
        solid.retain(|&cell| !has_air[cell]);
        // Voids lie half a wall inside, so that nothing is lost between these bodies.
        let apart_mm = 0.25 * self.sizes.wall_mm;
        let bodies = solid.into_iter().filter_map(|cell| {
            let polytope = self.cells[cell].polytope.drawn_in(apart_mm);
            Body::of_polytope(&polytope)
        });
        bodies.fold(TriMesh::default(), |all, body| all.joined(&body.mesh()))
    }

    /// Returns these cells with openings as far down as that one of some directions lets them, with
    /// which the most of a region is air.
    ///
    /// # Errors
    /// A void cannot be drawn, or the watch was stopped.
    pub fn turned(
        &self,
        downs: &[Vector],
        region: &TriMesh,
        watch: &Watch,
    ) -> Result<Self, CombError> {
        let voids = voids(&self.cells, region, self.sizes.wall_mm, watch)?;
        let distance = MeshDistance::new(region);
        let mut best = (self.clone(), 0.0);
        for down in downs {
            watch.check()?;
            let mut turned = self.clone();
            turned.sizes.down = Some(*down);
            let made = turned.drained(&voids, &distance).sets.into_iter().flatten();
            let air_mm3: f64 = made.map(|void| voids.all[void].volume_mm3).sum();
            if air_mm3 > best.1 {
                best = (turned, air_mm3);
            }
        }
        Ok(best.0)
    }

    /// Returns the voids that are made, with the openings between them.
    fn drained(&self, voids: &Voids, region: &MeshDistance) -> Connected {
        let sizes = self.sizes.doors();
        let mut doors = doors(voids, region, sizes, self.sizes.down);
        let mut kept = vec![true; voids.all.len()];
        if let Some(down) = &self.sizes.down {
            kept = Pockets::of(voids, &doors, sizes.opening_mm, down).kept(MOST_POCKETS_MM3);
            doors.retain(|door| door.voids.iter().all(|&void| kept[void]));
        }
        let least_mm3 = LEAST_SHARE * self.sizes.cube_void_mm3();
        let mut sets = connected(voids, &doors);
        sets.retain(|set| {
            let volumes = set.iter().map(|&void| voids.all[void].volume_mm3);
            kept[set[0]] && volumes.sum::<f64>() >= least_mm3
        });
        Connected { sets, doors }
    }

    /// Joins connected voids by the openings between them.
    fn join(&self, voids: &Voids, set: &[usize], doors: &[Door]) -> Result<CellVoid, CombError> {
        let is_own = |door: &&Door| set.binary_search(&door.voids[0]).is_ok();
        let own: Vec<Door> = doors.iter().filter(is_own).copied().collect();
        let body = union_of(voids, set, &own, self.sizes.doors())?;
        let place = |&void: &usize| place_in(&voids.all[void], void, &own);
        Ok(CellVoid {
            body: body.to_solid()?,
            places: set.iter().map(place).collect(),
            doors: own.iter().map(|door| door.ends).collect(),
        })
    }
}

impl CellVoid {
    /// Returns it without slivers that the rounding of a file would fold.
    fn cleaned(self, watch: &Watch) -> Result<Self, CombError> {
        let body = Csg::of_solid(&self.body)?;
        let body = body.without_slivers_watched(watch)?.to_solid()?;
        Ok(Self { body, ..self })
    }
}

/// Returns the sets of voids that openings connect, each in the order of its voids.
fn connected(voids: &Voids, doors: &[Door]) -> Vec<Vec<usize>> {
    let mut sets = UnionFind::new(voids.all.len());
    for door in doors {
        let [one, other] = door.voids.map(|void| void as u32);
        sets.merge(one, other);
    }
    let (labels, count) = sets.labels();
    let mut found = vec![Vec::new(); count];
    for (void, label) in labels.into_iter().enumerate() {
        found[label as usize].push(void);
    }
    found
}

/// Returns a place inside of a void: its middle, or else the end of an opening in it.
fn place_in(void: &Void, index: usize, doors: &[Door]) -> Point {
    let corners = void.mesh.vertices();
    let sum = corners
        .iter()
        .fold(Vector::zeros(), |sum, p| sum + p.coords);
    let middle = Point::from(sum / corners.len().max(1) as f64);
    if void.distance.signed(&middle) > 0.0 {
        return middle;
    }
    let sides = doors
        .iter()
        .flat_map(|door| [0, 1].map(|side| (door, side)));
    let mut own = sides.filter(|(door, side)| door.voids[*side] == index);
    own.next().map_or(middle, |(door, side)| door.ends[side])
}
