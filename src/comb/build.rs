//! Builds the printable solid of a model made of cells.

use super::doors::{Door, ROOM_RATIO, Sizes, doors};
use super::error::CombError;
use super::escapes::{Escape, air, escapes};
use super::flow::Flow;
use super::prism::{area_mm2, prism};
use super::rooms::{Voids, voids};
use crate::base::watch::Watch;
use crate::cells::Cell;
use crate::mesh::{Csg, MeshDistance, Solid, TriMesh};
use crate::voids::{Cavity, CavitySpec};

/// The order of a model made of cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CombOrder {
    /// The wall between two voids, mm.
    pub wall_mm: f64,
    /// The skin around all voids, mm.
    pub skin_mm: f64,
    /// The tolerance of the inner surface of the skin, mm.
    pub tolerance_mm: f64,
    /// The free diameter of each opening, mm.
    pub opening_mm: f64,
    /// The holes to the outside of each set of connected voids.
    pub holes: usize,
}

impl CombOrder {
    /// Returns the room that an opening's axis needs to the sides of its wall, mm.
    pub(super) fn room_mm(&self) -> f64 {
        let sizes = Sizes {
            wall_mm: self.wall_mm,
            opening_mm: self.opening_mm,
            room_ratio: ROOM_RATIO,
        };
        sizes.room_mm()
    }
}

/// A model made of cells.
#[derive(Debug, Clone)]
pub struct Comb {
    /// The printable solid.
    pub solid: Solid,
    /// The cells, in the order of their sites.
    pub cells: Vec<CombCell>,
    /// The openings through inner walls.
    pub doors: Vec<Door>,
    /// The holes to the outside.
    pub escapes: Vec<Escape>,
    /// The voids as bodies of air, without openings.
    pub voids: Vec<TriMesh>,
    /// The volume that the openings through inner walls take, mm³.
    pub doors_mm3: f64,
    /// The volume that the holes to the outside take, mm³.
    pub escapes_mm3: f64,
}

/// A cell of a printed model.
#[derive(Debug, Clone, PartialEq)]
pub struct CombCell {
    /// Its part of the model, mm³.
    pub volume_mm3: f64,
    /// The air of its voids that drain, mm³; openings are not counted.
    pub air_mm3: f64,
    /// The cells on the way out, itself first; none if it stays solid.
    pub path: Vec<usize>,
    /// The hole at the end of that way, by its place in [`Comb::escapes`].
    pub escape: Option<usize>,
}

impl CombCell {
    /// Returns true if it stays solid.
    pub fn is_solid(&self) -> bool {
        self.escape.is_none()
    }

    /// Returns the printed share of its volume.
    pub fn density(&self) -> f64 {
        1.0 - self.air_mm3 / self.volume_mm3
    }
}

/// Builds a model of cells by taking out its voids.
///
/// Every inner wall that holds an opening gets one, and connected voids get holes to the outside.
/// Voids that no such way drains stay solid.
///
/// # Errors
/// A length is not positive, the skin or a void cannot be drawn, or the watch was stopped.
pub fn build(
    solid: &Solid,
    cells: &[Cell],
    order: &CombOrder,
    watch: &Watch,
) -> Result<Comb, CombError> {
    check(order)?;
    let spec = CavitySpec {
        wall_mm: order.skin_mm,
        tolerance_mm: order.tolerance_mm,
        quadric_tolerance_mm: order.tolerance_mm,
        keeps: &[],
        min_void_mm: 0.0,
    };
    let cavity = Cavity::extract(solid, &spec, watch)?;
    let voids = voids(cells, cavity.mesh(), order.wall_mm, watch)?;
    watch.check()?;
    let sizes = Sizes {
        wall_mm: order.wall_mm,
        opening_mm: order.opening_mm,
        room_ratio: ROOM_RATIO,
    };
    let all_doors = doors(&voids, &MeshDistance::new(cavity.mesh()), sizes, None);
    let possible = escapes(&voids, &MeshDistance::new(solid.mesh()), sizes);
    let flow = Flow::of(&possible, &all_doors, order.holes);
    watch.check()?;
    let drains = |void: usize| flow.ways[void].is_some();
    let kept = all_doors.into_iter();
    let doors: Vec<Door> = kept.filter(|door| drains(door.voids[0])).collect();
    let kept: Vec<usize> = (0..voids.all.len()).filter(|&void| drains(void)).collect();
    let mut air_body = union_of(&voids, &kept, &doors, sizes)?;
    // All of it lies inside the skin.
    let before_mm3 = air_body.to_mesh()?.signed_volume_mm3();
    for hole in &flow.escapes {
        air_body = air_body.union(&Csg::of_mesh(&air(hole, sizes))?)?;
        watch.check()?;
    }
    let printed = Csg::of_solid(solid)?.subtract(&air_body)?;
    let printed = printed.without_slivers_watched(watch)?.to_solid()?;
    let solid_mm3 = printed.mesh().signed_volume_mm3();
    Ok(Comb {
        cells: facts(cells, &voids, &flow),
        escapes_mm3: solid.mesh().signed_volume_mm3() - before_mm3 - solid_mm3,
        doors_mm3: doors.len() as f64 * area_mm2(sizes.opening_mm) * sizes.wall_mm,
        escapes: flow.escapes,
        voids: kept
            .iter()
            .map(|&void| voids.all[void].mesh.clone())
            .collect(),
        doors,
        solid: printed,
    })
}

/// Returns an error unless all lengths are above zero.
fn check(order: &CombOrder) -> Result<(), CombError> {
    for (name, value_mm) in [
        ("the wall", order.wall_mm),
        ("the skin", order.skin_mm),
        ("the tolerance", order.tolerance_mm),
        ("the opening", order.opening_mm),
    ] {
        if !(value_mm > 0.0 && value_mm.is_finite()) {
            return Err(CombError::NotPositive { name, value_mm });
        }
    }
    Ok(())
}

/// Unites voids and the openings between them.
pub(super) fn union_of(
    voids: &Voids,
    kept: &[usize],
    doors: &[Door],
    sizes: Sizes,
) -> Result<Csg, CombError> {
    // Voids are a wall apart from each other, and openings lie in walls of their own.
    let join = |all: TriMesh, mesh: &TriMesh| all.joined(mesh);
    let meshes = kept.iter().map(|&void| &voids.all[void].mesh);
    let air = meshes.fold(TriMesh::default(), join);
    let prisms = doors.iter().map(|door| prism(door.ends, sizes.opening_mm));
    let prisms = prisms.fold(TriMesh::default(), |all, mesh| all.joined(&mesh));
    Ok(Csg::of_mesh(&air)?.union(&Csg::of_mesh(&prisms)?)?)
}

fn facts(cells: &[Cell], voids: &Voids, flow: &Flow) -> Vec<CombCell> {
    let mut facts: Vec<CombCell> = cells
        .iter()
        .map(|cell| CombCell {
            volume_mm3: cell.part.volume_mm3(),
            air_mm3: 0.0,
            path: Vec::new(),
            escape: None,
        })
        .collect();
    let mut largest = vec![0.0; cells.len()];
    for (index, void) in voids.all.iter().enumerate() {
        let Some(way) = flow.ways[index] else {
            continue;
        };
        let cell = &mut facts[void.cell];
        cell.air_mm3 += void.volume_mm3;
        // Of several voids in a cell the largest one says where it drains.
        if void.volume_mm3 > largest[void.cell] {
            largest[void.cell] = void.volume_mm3;
            let path = flow.path(index).into_iter();
            cell.path = path.map(|void| voids.all[void].cell).collect();
            cell.escape = Some(way.escape);
        }
    }
    facts
}
