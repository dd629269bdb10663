//! The defects that keep a mesh from bounding a solid: each kind with its count, first places and
//! remedy.

use std::fmt;

use super::TriMesh;
use super::edges::{EdgeKind, EdgeTable, Side};
use super::union_find::UnionFind;
use crate::geom::Point;

/// Largest number of places that a defect lists; nobody would look up more.
const MAX_PLACES: usize = 3;

/// Least volume of a solid, as a share of the cube over its diagonal. Below 1e-12 a flat sheet,
/// whose volume is rounding error, would pass. Above 1e-9 a sound sheet of 0.001 mm at 100 mm would
/// be refused.
const MIN_VOLUME_RATIO: f64 = 1e-12;

/// One way in which a mesh fails to bound a solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum DefectKind {
    /// There are no triangles.
    Empty,
    /// A coordinate is NaN or infinite.
    NotFinite,
    /// A triangle repeats a vertex.
    RepeatedCorner,
    /// A hole: connected edges that belong to one triangle only.
    Hole,
    /// An edge that belongs to three or more triangles.
    CrowdedEdge,
    /// An edge along which two triangles run the same way: one of them faces inward.
    MisorientedEdge,
    /// The surface encloses nothing: its volume is zero.
    NoVolume,
    /// The surface faces inward: its volume is negative.
    InsideOut,
}

impl DefectKind {
    /// Describes the defect in words that a count can follow.
    fn description(self) -> &'static str {
        match self {
            Self::Empty => "there are no triangles",
            Self::NotFinite => "vertices whose coordinates are not finite numbers",
            Self::RepeatedCorner => "triangles that name one vertex twice",
            Self::Hole => "holes (rims of edges with a triangle on one side only)",
            Self::CrowdedEdge => "edges shared by three or more triangles",
            Self::MisorientedEdge => "edges where the two triangles face opposite ways",
            Self::NoVolume => "the surface encloses no volume",
            Self::InsideOut => "the surface faces inward",
        }
    }

    /// Returns the defect in the few words that fit on a picture.
    pub fn name(self) -> &'static str {
        match self {
            Self::Empty => "no triangles",
            Self::NotFinite => "no finite number",
            Self::RepeatedCorner => "no area",
            Self::Hole => "hole",
            Self::CrowdedEdge => "three faces on an edge",
            Self::MisorientedEdge => "faces opposite ways",
            Self::NoVolume => "no volume",
            Self::InsideOut => "faces inward",
        }
    }

    /// Returns true if a new surface by winding number has no such defect.
    pub fn is_drawn_over(self) -> bool {
        matches!(
            self,
            Self::Hole | Self::CrowdedEdge | Self::MisorientedEdge | Self::InsideOut
        )
    }

    /// Returns the remedy, as a request to the user.
    pub fn remedy(self) -> &'static str {
        match self {
            Self::Empty => "export the model again with its faces",
            Self::NotFinite => "export the model again; the file is damaged",
            Self::RepeatedCorner => "repair the mesh: such triangles can be dropped",
            Self::Hole => {
                "close the holes in a mesh editor (fill holes, make solid), then export again"
            }
            Self::CrowdedEdge => {
                "unite the overlapping bodies in a modelling program (boolean union), then export again"
            }
            Self::MisorientedEdge => {
                "make the triangles agree (recalculate normals); if that fails, the surface is one-sided"
            }
            Self::NoVolume => "give the surface a thickness; a flat sheet cannot be printed",
            Self::InsideOut => "reverse all triangles (flip normals)",
        }
    }
}

/// A kind of defect with its count and its first places.
#[derive(Debug, Clone, PartialEq)]
pub struct Defect {
    /// The kind.
    pub kind: DefectKind,
    /// Number of occurrences.
    pub count: usize,
    /// The first places, at most three, in the mesh's own coordinates.
    pub places: Vec<Point>,
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind.description())?;
        if !self.places.is_empty() {
            write!(f, ": {}", self.count)?;
        }
        for (i, p) in self.places.iter().enumerate() {
            let lead = if i == 0 { ", first at" } else { " and" };
            write!(
                f,
                "{lead} ({}, {}, {})",
                format_coordinate(p.x),
                format_coordinate(p.y),
                format_coordinate(p.z)
            )?;
        }
        let frame = if self.places.is_empty() {
            ""
        } else {
            " in the file's own coordinates"
        };
        write!(f, "{frame}; {}", self.kind.remedy())
    }
}

/// Formats a coordinate with enough digits to find the place in models of any size.
fn format_coordinate(x: f64) -> String {
    if x == 0.0 || x.abs() >= 1.0 {
        format!("{x:.2}")
    } else {
        format!("{x:.6}")
    }
}

/// Every defect of a mesh, in the order of [`DefectKind`].
#[derive(Debug, Clone, PartialEq)]
pub struct Defects(Vec<Defect>);

impl Defects {
    /// Finds all defects of `mesh`; `None` if it bounds a solid.
    pub fn of(mesh: &TriMesh) -> Option<Self> {
        let mut found = vec![no_triangles(mesh), not_finite(mesh)];
        if found.iter().all(|defect| defect.count == 0) {
            let table = EdgeTable::of(mesh);
            found.extend([repeated_corners(mesh), holes(mesh, &table)]);
            found.extend([crowded_edges(mesh, &table), misoriented_edges(mesh, &table)]);
            if found.iter().all(|defect| defect.count == 0) {
                found.extend(volume_defects(mesh));
            }
        }
        found.retain(|defect| defect.count > 0);
        if found.is_empty() {
            None
        } else {
            Some(Self(found))
        }
    }

    /// Returns the defects, one for each kind that occurs.
    pub fn list(&self) -> &[Defect] {
        &self.0
    }

    /// Returns true if a new surface by winding number has none of them.
    pub fn can_draw_over(&self) -> bool {
        self.0.iter().all(|defect| defect.kind.is_drawn_over())
    }

    /// Returns the number of occurrences of `kind`.
    pub fn count(&self, kind: DefectKind) -> usize {
        self.0
            .iter()
            .filter(|defect| defect.kind == kind)
            .map(|defect| defect.count)
            .sum()
    }
}

impl std::error::Error for Defects {}

impl fmt::Display for Defects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the mesh does not bound a solid:")?;
        self.0
            .iter()
            .try_for_each(|defect| write!(f, "\n  {defect}"))
    }
}

/// Makes a defect from the places of all its occurrences.
fn defect(kind: DefectKind, places: impl Iterator<Item = Point>) -> Defect {
    let mut named = Vec::new();
    let mut count = 0;
    for place in places {
        count += 1;
        if named.len() < MAX_PLACES {
            named.push(place);
        }
    }
    Defect {
        kind,
        count,
        places: named,
    }
}

fn no_triangles(mesh: &TriMesh) -> Defect {
    Defect {
        kind: DefectKind::Empty,
        count: usize::from(mesh.triangles().is_empty()),
        places: Vec::new(),
    }
}

fn not_finite(mesh: &TriMesh) -> Defect {
    let finite = |p: &&Point| p.coords.iter().all(|x| x.is_finite());
    defect(
        DefectKind::NotFinite,
        mesh.vertices().iter().filter(|p| !finite(p)).copied(),
    )
}

fn repeated_corners(mesh: &TriMesh) -> Defect {
    let repeats = |&&[a, b, c]: &&[u32; 3]| a == b || b == c || c == a;
    let places = mesh
        .triangles()
        .iter()
        .filter(repeats)
        .map(|t| mesh.vertices()[t[0] as usize]);
    defect(DefectKind::RepeatedCorner, places)
}

fn holes(mesh: &TriMesh, table: &EdgeTable) -> Defect {
    defect(DefectKind::Hole, hole_places(mesh, table).into_iter())
}

/// Returns the middle of the first open edge of each hole. Open edges that share a vertex are one
/// hole.
pub(super) fn hole_places(mesh: &TriMesh, table: &EdgeTable) -> Vec<Point> {
    let rims: Vec<&[Side]> = table.of_kind(EdgeKind::Open).collect();
    if rims.is_empty() {
        return Vec::new();
    }
    let mut sets = UnionFind::new(mesh.vertices().len());
    rims.iter()
        .for_each(|sides| _ = sets.merge(sides[0].low, sides[0].high));
    let first_of_hole = |sides: &&[Side]| sets.root(sides[0].low) == sides[0].low;
    let mut firsts: Vec<&[Side]> = rims.into_iter().filter(first_of_hole).collect();
    firsts.dedup_by_key(|sides| sides[0].low);
    firsts
        .into_iter()
        .map(|sides| middle(mesh, sides))
        .collect()
}

fn crowded_edges(mesh: &TriMesh, table: &EdgeTable) -> Defect {
    defect(
        DefectKind::CrowdedEdge,
        table
            .of_kind(EdgeKind::Crowded)
            .map(|sides| middle(mesh, sides)),
    )
}

fn misoriented_edges(mesh: &TriMesh, table: &EdgeTable) -> Defect {
    let places = table
        .of_kind(EdgeKind::Misoriented)
        .map(|sides| middle(mesh, sides));
    defect(DefectKind::MisorientedEdge, places)
}

/// Returns the middle of the edge on which these sides lie.
pub(super) fn middle(mesh: &TriMesh, sides: &[Side]) -> Point {
    let [a, b] = [sides[0].low, sides[0].high].map(|v| mesh.vertices()[v as usize]);
    nalgebra::center(&a, &b)
}

fn volume_defects(mesh: &TriMesh) -> [Defect; 2] {
    let least = MIN_VOLUME_RATIO * mesh.aabb().size().norm().powi(3);
    let volume = mesh.signed_volume_mm3();
    let volume_defect = |kind, is: bool| Defect {
        kind,
        count: usize::from(is),
        places: Vec::new(),
    };
    let inside_out = volume < -least;
    let is_sound = volume > least && volume.is_finite();
    [
        volume_defect(DefectKind::NoVolume, !is_sound && !inside_out),
        volume_defect(DefectKind::InsideOut, inside_out),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Solid;
    use crate::mesh::primitives::cuboid;

    fn cube() -> TriMesh {
        cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0))
    }

    fn kinds(mesh: TriMesh) -> Vec<(DefectKind, usize)> {
        let defects = Solid::new(mesh).unwrap_err();
        defects
            .list()
            .iter()
            .map(|defect| (defect.kind, defect.count))
            .collect()
    }

    fn with_triangles(triangles: Vec<[u32; 3]>) -> TriMesh {
        TriMesh::new(cube().vertices().to_vec(), triangles).unwrap()
    }

    #[test]
    fn each_kind_is_found_and_counted() {
        use DefectKind::*;
        let sides = cube().triangles().to_vec();
        assert_eq!(kinds(TriMesh::default()), [(Empty, 1)]);
        assert_eq!(kinds(cube().map_vertices(|p| p / p.x)), [(NotFinite, 4)]);
        assert_eq!(kinds(cube().reversed()), [(InsideOut, 1)]);
        assert_eq!(
            kinds(with_triangles(vec![[0, 1, 2], [0, 2, 1]])),
            [(NoVolume, 1)]
        );
        // The first triangles of the low and the high x face do not touch: two holes.
        let two_open = [&sides[1..2], &sides[3..]].concat();
        assert_eq!(kinds(with_triangles(two_open)), [(Hole, 2)]);
        assert_eq!(
            kinds(with_triangles([&sides[..], &[[0, 1, 7]]].concat())),
            [(Hole, 1), (CrowdedEdge, 2)]
        );
        let turned = [&sides[1..], &[[sides[0][0], sides[0][2], sides[0][1]]]].concat();
        assert_eq!(kinds(with_triangles(turned)), [(MisorientedEdge, 3)]);
        assert_eq!(
            kinds(with_triangles([&sides[..], &[[0, 0, 1]]].concat())),
            [(RepeatedCorner, 1), (CrowdedEdge, 1)]
        );
    }

    #[test]
    fn all_defects_are_listed_at_once_with_places_and_remedies() {
        let mut triangles = cube().triangles()[1..].to_vec();
        triangles.push([1, 1, 2]);
        let message = Solid::new(with_triangles(triangles))
            .unwrap_err()
            .to_string();
        let lines: Vec<&str> = message.lines().collect();
        assert_eq!(lines[0], "the mesh does not bound a solid:");
        assert!(
            lines[1].contains("triangles that name one vertex twice: 1")
                && lines[1].contains("drop")
        );
        assert!(
            lines[2].contains("holes")
                && lines[2].contains(": 1, first at")
                && lines[2].contains("(0.00, 0.00, 5.00) in the file's own")
                && lines[2].contains("fill")
        );
    }

    #[test]
    fn a_thin_plate_is_a_solid() {
        let plate = cuboid(&Point::origin(), &Point::new(100.0, 100.0, 0.001));
        assert!(Solid::new(plate).is_ok());
    }
}
