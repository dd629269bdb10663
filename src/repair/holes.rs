//! Holes: fills rims with triangles over their own corners. No vertex moves and none is added.

use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Point, Vector};
use crate::mesh::edges::{EdgeKind, EdgeTable};
use crate::mesh::fans::Fans;
use crate::mesh::shells::Shells;
use crate::mesh::{TriMesh, area_mm2};

/// Largest area of all fillings of a shell, as a share of its own area, if a filling is not flat.
/// Beyond a quarter the surface is a sheet rather than a body with holes.
const MAX_FILLED_RATIO: f64 = 0.25;

/// The same share if all fillings are flat. A box without a side needs 0.2, half a ball 0.5, the
/// lid of a teapot 0.8. A flat sheet would need 1 and enclose nothing.
const MAX_FLAT_RATIO: f64 = 0.9;

/// Excess of a filling's area over the area of its rim's projection up to which it is flat. Single
/// precision leaves 1e-7 and less.
const FLAT_RATIO: f64 = 1e-5;

/// Largest number of triples of corners that are compared for all rims together. It takes about two
/// seconds, and lets a rim of 800 corners be filled.
const MAX_TRIPLES: usize = 100_000_000;

/// A mesh with its holes filled.
pub(super) struct Filled {
    /// The mesh: the old triangles come first, in their order.
    pub mesh: TriMesh,
    /// Number of holes filled.
    pub holes: usize,
    /// The area of the fillings over that of the surface before.
    pub area_ratio: f64,
}

/// Fills the holes of a mesh whose edges are otherwise sound; `None` if a hole must stay open.
///
/// A flat rim is filled flat (by the least area: Barequet and Sharir, CAGD 12, 1995). Any other is
/// filled with the least folds, then the least area (Liepa, "Filling holes in meshes", SGP 2003). A
/// shell whose fillings exceed a quarter of its area stays open, nine tenths if all are flat.
/// So does one whose rims are too long. Takes time cubic in the corners of a rim, up to a limit of
/// about two seconds.
///
/// # Errors
/// The watch was stopped.
pub(super) fn fill_holes(mesh: &TriMesh, watch: &Watch) -> Result<Option<Filled>, Cancelled> {
    let Some(open) = Open::of(mesh) else {
        return Ok(None);
    };
    let mut fillings = Vec::with_capacity(open.rims.len());
    for rim in &open.rims {
        let Some(filling) = fill_rim(&open.mesh, rim, watch)? else {
            return Ok(None);
        };
        fillings.push(filling);
    }
    Ok(open.close(&fillings))
}

/// A mesh with rims of its own for each hole.
struct Open {
    mesh: TriMesh,
    shells: Shells,
    rims: Vec<Rim>,
}

impl Open {
    /// Finds the rims; `None` if there are none, if an edge is bad otherwise, or if they are too
    /// long.
    fn of(mesh: &TriMesh) -> Option<Self> {
        let table = EdgeTable::of(mesh);
        let is_bad = |kind| table.of_kind(kind).next().is_some();
        if is_bad(EdgeKind::Crowded) || is_bad(EdgeKind::Misoriented) || is_bad(EdgeKind::Collapsed)
        {
            return None;
        }
        // Each rim has vertices of its own then, so that it is a loop.
        let split = Fans::of(mesh, &table).split(mesh);
        let table = EdgeTable::of(&split);
        let shells = Shells::of(&split, &table);
        let rims = find_rims(&split, &table);
        let triples = |rim: &Rim| rim.corners.len().saturating_pow(3) / 6;
        let budget = rims.iter().map(triples).fold(0, usize::saturating_add);
        let is_bounded = !rims.is_empty() && budget <= MAX_TRIPLES;
        is_bounded.then_some(Self {
            mesh: split,
            shells,
            rims,
        })
    }

    /// Adds the fillings; `None` if a shell grows too much, or an edge is bad afterwards.
    fn close(self, fillings: &[Filling]) -> Option<Filled> {
        let (split, shells) = (self.mesh, self.shells);
        let mut triangles = split.triangles().to_vec();
        let mut areas = vec![0.0; shells.count()];
        let mut limits = vec![MAX_FLAT_RATIO; shells.count()];
        for (rim, filling) in self.rims.iter().zip(fillings) {
            let shell = shells.shell_of(rim.triangles[0]);
            areas[shell] += area(&split, &filling.triangles);
            if !filling.is_flat {
                limits[shell] = MAX_FILLED_RATIO;
            }
            triangles.extend(&filling.triangles);
        }
        let mut area_before = 0.0;
        for (shell, members) in shells.members().iter().enumerate() {
            let own = members
                .iter()
                .map(|&t| area_mm2(&split.corners(t as usize)));
            let own: f64 = own.sum();
            area_before += own;
            let is_body = areas[shell] <= limits[shell] * own;
            is_body.then_some(())?;
        }
        let filled = TriMesh::from_parts(split.into_vertices(), triangles);
        let is_closed = EdgeTable::of(&filled).bad_count() == 0;
        is_closed.then(|| Filled {
            mesh: filled,
            holes: self.rims.len(),
            area_ratio: areas.iter().sum::<f64>() / area_before,
        })
    }
}

/// The rim of a hole.
struct Rim {
    /// Its vertices in the order in which a filling runs along them.
    corners: Vec<u32>,
    /// The triangles across the edge after each corner.
    triangles: Vec<usize>,
}

/// Follows the open edges around each hole, in the order of their smallest vertices.
fn find_rims(mesh: &TriMesh, table: &EdgeTable) -> Vec<Rim> {
    const NONE: u32 = u32::MAX;
    let mut next = vec![NONE; mesh.vertices().len()];
    let mut triangle = vec![0; mesh.vertices().len()];
    for sides in table.of_kind(EdgeKind::Open) {
        let side = &sides[0];
        let (from, to) = if side.forward {
            (side.high, side.low)
        } else {
            (side.low, side.high)
        };
        next[from as usize] = to;
        triangle[from as usize] = side.triangle();
    }
    let mut rims = Vec::new();
    for start in 0..next.len() {
        let (mut corners, mut triangles) = (Vec::new(), Vec::new());
        let mut at = start as u32;
        while next[at as usize] != NONE {
            corners.push(at);
            triangles.push(triangle[at as usize]);
            at = std::mem::replace(&mut next[at as usize], NONE);
        }
        if !corners.is_empty() {
            rims.push(Rim { corners, triangles });
        }
    }
    rims
}

/// The weight of a triangulation: the least first by its sharpest fold, then by its area.
#[derive(Debug, Clone, Copy, Default, PartialEq, PartialOrd)]
struct Weight {
    /// One less the cosine of the sharpest fold; 0 if folds do not count.
    fold: f64,
    /// The area, in the square of the file's unit.
    area: f64,
}

/// The corners of a rim, and what lies across its edges.
struct Gap<'a> {
    places: Vec<Point>,
    /// The normals across the edge after each corner; `None` if folds do not count.
    across: Option<&'a [Vector]>,
    /// The corner of the triangle between corners i and k, at i · count + k.
    apexes: Vec<usize>,
}

impl<'a> Gap<'a> {
    /// Returns the gap inside a rim. Folds count if `across` has the normals beyond the rim.
    fn new(mesh: &TriMesh, rim: &[u32], across: Option<&'a [Vector]>) -> Self {
        Self {
            places: rim.iter().map(|&v| mesh.vertices()[v as usize]).collect(),
            across,
            apexes: vec![0; rim.len() * rim.len()],
        }
    }

    /// Returns the normal of the filling at the edge from corner i to corner k, or of the surface
    /// beyond an edge of the rim.
    fn normal(&self, across: &[Vector], i: usize, k: usize) -> Vector {
        if k == i + 1 {
            return across[i];
        }
        let apex = self.apexes[i * self.places.len() + k];
        normal(&[self.places[i], self.places[apex], self.places[k]])
    }

    /// Returns the weight of the triangle with corners i, j and k where it meets what lies beyond.
    fn weight(&self, [i, j, k]: [usize; 3]) -> Weight {
        let corners = [self.places[i], self.places[j], self.places[k]];
        let area = area_mm2(&corners);
        let Some(across) = self.across else {
            return Weight { fold: 0.0, area };
        };
        let own = normal(&corners);
        let fold = |other: Vector| 1.0 - own.dot(&other);
        let mut sharpest = fold(self.normal(across, i, j)).max(fold(self.normal(across, j, k)));
        if i == 0 && k + 1 == self.places.len() {
            sharpest = sharpest.max(fold(across[k]));
        }
        Weight {
            fold: sharpest,
            area,
        }
    }
}

/// Returns the unit normal; zero for a triangle without area.
fn normal([a, b, c]: &[Point; 3]) -> Vector {
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0);
    normal.unwrap_or_else(Vector::zeros)
}

/// Returns the triangles of least weight between the corners of a loop; `None` for fewer than three
/// corners or an area that is not finite. Folds count if `across` has the normals beyond the rim.
fn triangulate(
    mut gap: Gap,
    rim: &[u32],
    watch: &Watch,
) -> Result<Option<Vec<[u32; 3]>>, Cancelled> {
    let count = rim.len();
    if count < 3 {
        return Ok(None);
    }
    let mut weights = vec![Weight::default(); count * count];
    for span in 2..count {
        watch.check()?;
        for i in 0..count - span {
            let k = i + span;
            let mut best = Weight {
                fold: f64::INFINITY,
                area: f64::INFINITY,
            };
            for j in i + 1..k {
                let own = gap.weight([i, j, k]);
                let (one, other) = (weights[i * count + j], weights[j * count + k]);
                let all = Weight {
                    fold: own.fold.max(one.fold).max(other.fold),
                    area: own.area + one.area + other.area,
                };
                if all < best {
                    best = all;
                    gap.apexes[i * count + k] = j;
                }
            }
            weights[i * count + k] = best;
        }
    }
    if !weights[count - 1].area.is_finite() {
        return Ok(None);
    }
    let mut triangles = Vec::with_capacity(count - 2);
    let mut open = vec![[0, count - 1]];
    while let Some([i, k]) = open.pop() {
        if k - i >= 2 {
            let j = gap.apexes[i * count + k];
            triangles.push([rim[i], rim[j], rim[k]]);
            open.extend([[i, j], [j, k]]);
        }
    }
    Ok(Some(triangles))
}

/// Returns the filling of a rim, and sets `is_flat` if it lies in a plane.
///
/// In a plane the least area is the only one without overlaps. Elsewhere the filling that folds
/// least is taken, as the one of least area may pass through the surface beside it.
fn fill_rim(mesh: &TriMesh, rim: &Rim, watch: &Watch) -> Result<Option<Filling>, Cancelled> {
    let gap = Gap::new(mesh, &rim.corners, None);
    let Some(least) = triangulate(gap, &rim.corners, watch)? else {
        return Ok(None);
    };
    let own_area = area(mesh, &least);
    let base = mesh.vertices()[rim.corners[0] as usize];
    let doubled = least.iter().map(|t| {
        let [a, b, c] = t.map(|v| mesh.vertices()[v as usize] - base);
        (b - a).cross(&(c - a))
    });
    if own_area <= (1.0 + FLAT_RATIO) * doubled.sum::<Vector>().norm() / 2.0 {
        return Ok(Some(Filling {
            triangles: least,
            is_flat: true,
        }));
    }
    let across: Vec<Vector> = rim
        .triangles
        .iter()
        .map(|&t| normal(&mesh.corners(t)))
        .collect();
    let gap = Gap::new(mesh, &rim.corners, Some(&across));
    let bent = triangulate(gap, &rim.corners, watch)?;
    Ok(bent.map(|triangles| Filling {
        triangles,
        is_flat: false,
    }))
}

/// The triangles that fill a rim.
struct Filling {
    triangles: Vec<[u32; 3]>,
    is_flat: bool,
}

/// Returns the area of some triangles over the vertices of a mesh.
fn area(mesh: &TriMesh, triangles: &[[u32; 3]]) -> f64 {
    let corners = |t: &[u32; 3]| t.map(|v| mesh.vertices()[v as usize]);
    triangles.iter().map(|t| area_mm2(&corners(t))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Solid;
    use crate::mesh::primitives::{ball, cuboid};

    fn fill(mesh: &TriMesh) -> Option<Filled> {
        fill_holes(mesh, &Watch::silent()).unwrap()
    }

    fn without(mesh: &TriMesh, is_dropped: impl Fn(&[Point; 3]) -> bool) -> TriMesh {
        let kept = (0..mesh.triangles().len()).filter(|&t| !is_dropped(&mesh.corners(t)));
        let triangles = kept.map(|t| mesh.triangles()[t]).collect();
        TriMesh::new(mesh.vertices().to_vec(), triangles).unwrap()
    }

    fn cube() -> TriMesh {
        cuboid(&Point::origin(), &Point::new(1.0, 1.0, 1.0))
    }

    #[test]
    fn a_box_without_a_side_gets_it_back() {
        let open = without(&cube(), |corners| corners.iter().all(|p| p.z == 1.0));
        let filled = fill(&open).unwrap();
        assert_eq!(filled.holes, 1);
        assert!((filled.area_ratio - 0.2).abs() < 1e-12);
        let solid = Solid::new(filled.mesh).unwrap();
        assert!((solid.mesh().signed_volume_mm3() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_flat_rim_that_is_not_convex_is_filled_without_overlap() {
        // An upright wall around an L of area 3, with a floor; only the lid is missing.
        let outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
        let at = |z: i32| outline.map(|(x, y)| Point::new(x.into(), y.into(), z.into()));
        let vertices = [at(0), at(4)].concat();
        let mut triangles = vec![[0, 5, 3], [5, 4, 3], [0, 3, 1], [1, 3, 2]];
        for i in 0..6 {
            let j = (i + 1) % 6;
            triangles.extend([[i, j, j + 6], [i, j + 6, i + 6]]);
        }
        let filled = fill(&TriMesh::new(vertices, triangles).unwrap()).unwrap();
        let volume = filled.mesh.signed_volume_mm3();
        assert!((volume - 12.0).abs() < 1e-12, "{volume}");
        assert_eq!(crate::mesh::Crossings::of(&filled.mesh).pairs, 0);
    }

    #[test]
    fn holes_that_meet_in_a_vertex_are_filled_one_by_one() {
        let ball = ball(&Point::origin(), 1.0, 3);
        let fan: Vec<usize> = (0..ball.triangles().len())
            .filter(|&t| ball.triangles()[t].contains(&0))
            .collect();
        let kept = (0..ball.triangles().len()).filter(|t| *t != fan[0] && *t != fan[2]);
        let triangles = kept.map(|t| ball.triangles()[t]).collect();
        let open = TriMesh::new(ball.vertices().to_vec(), triangles).unwrap();
        let filled = fill(&open).unwrap();
        assert!((filled.mesh.signed_volume_mm3() / ball.signed_volume_mm3() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_saddle_is_a_sheet_and_stays_open() {
        // A ribbon of a ball whose rim is far from flat.
        let ball = ball(&Point::origin(), 1.0, 3);
        let sheet = without(&ball, |corners| corners.iter().any(|p| p.z > p.x * p.x));
        let filled = fill(&sheet);
        assert!(filled.is_none());
    }

    #[test]
    fn a_flat_sheet_stays_open() {
        let sheet = without(&cube(), |corners| corners.iter().any(|p| p.z != 0.0));
        assert!(fill(&sheet).is_none());
    }

    #[test]
    fn a_hole_over_a_bend_is_filled_along_it() {
        let ball = ball(&Point::origin(), 1.0, 4);
        let hole = Point::new(0.0, 0.6, 0.8);
        let open = without(&ball, |corners| {
            corners.iter().any(|p| (p - hole).norm() < 0.3)
        });
        let filled = fill(&open).unwrap();
        assert_eq!(crate::mesh::Crossings::of(&filled.mesh).pairs, 0);
        let ratio = filled.mesh.signed_volume_mm3() / ball.signed_volume_mm3();
        // A cap of height 0.045 has 0.15 % of the ball.
        assert!((0.997..1.0).contains(&ratio), "{ratio}");
    }
}
