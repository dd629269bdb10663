//! The pieces of the body cut by all planes, their cut faces and the joints between them.

use std::cmp::Reverse;

use crate::{
    base::watch::Watch,
    cut::{
        error::{CutError, Obstacle},
        geometry::{
            chart::{Chart, Point2},
            outline::Outline,
            overlap::Flat,
            tree::CutTree,
        },
        ids::PartId,
    },
    geom::{Plane, Point, Vector},
    mesh::{Csg, TriMesh, bodies, shells, union_find::UnionFind},
};

/// Volume below which a piece is a sheet left by a plane along a face, mm³. A real piece of that
/// size would be a hundredth of a millimetre across, and no printer makes it.
const SHEET_VOLUME_MM3: f64 = 1e-6;

/// Distance within which a vertex lies on the cut face, mm. Caps are flat to 1e-13, and a planned
/// cut keeps 1e-6 away from the model's own vertices.
const ON_PLANE_MM: f64 = 1e-7;

/// A piece of the cut body, bounded by its own surface and by cut faces.
#[derive(Clone)]
pub(crate) struct Piece {
    pub(crate) mesh: TriMesh,
    pub(crate) volume_mm3: f64,
    pub(crate) caps: Vec<Cap>,
}

/// A connected flat face that a cut leaves on a piece.
#[derive(Clone)]
pub(crate) struct Cap {
    /// The index of the cut.
    pub(crate) cut: usize,
    /// `true` if the piece lies above the plane, so that the face looks against the plane's normal.
    pub(crate) is_above: bool,
    pub(crate) outline: Outline,
    pub(crate) area_mm2: f64,
    /// The indices of its triangles in the piece's mesh, ascending.
    pub(crate) faces: Vec<usize>,
    pub(crate) triangles: Vec<[Point2; 3]>,
}

/// Two pieces that meet at a cut.
pub(crate) struct Joint {
    pub(crate) cut: usize,
    /// The piece below the plane.
    pub(crate) below: usize,
    /// The piece above it.
    pub(crate) above: usize,
    /// The faces in which they meet, as the piece below has them; of a cap that meets several
    /// pieces, the shared region.
    pub(crate) faces: Vec<Cap>,
}

impl Joint {
    /// Returns whether a piece is one of the two.
    pub(crate) fn touches(&self, piece: usize) -> bool {
        self.below == piece || self.above == piece
    }

    /// Returns the ids of the parts that the pieces below and above become.
    pub(crate) fn parts(&self) -> [PartId; 2] {
        [self.below, self.above].map(PartId::of)
    }

    /// Returns the area of the faces in which the two meet, mm².
    pub(crate) fn area_mm2(&self) -> f64 {
        self.faces.iter().map(|face| face.area_mm2).sum()
    }

    /// Returns the other piece of the two.
    pub(crate) fn other(&self, piece: usize) -> usize {
        if self.below == piece {
            self.above
        } else {
            self.below
        }
    }
}

impl Piece {
    /// Returns whether the piece lies above a plane that does not pass through it.
    pub(crate) fn is_above(&self, plane: &Plane) -> bool {
        let heights = self.mesh.vertices().iter().map(|p| plane.distance(p));
        heights.fold(0.0, |far: f64, h| if h.abs() > far.abs() { h } else { far }) > 0.0
    }
}

/// Returns the pieces of a closed mesh between the cuts, in the order of [`sort_pieces`]. Cut by
/// booleans, so that they can be made into parts.
pub(crate) fn split(mesh: &TriMesh, tree: &CutTree, watch: &Watch) -> Result<Vec<Piece>, CutError> {
    let cells = tree.cells(&Csg::of_mesh(mesh)?, watch)?;
    let cells = cells.iter().map(Csg::to_mesh);
    find_pieces(&cells.collect::<Result<Vec<_>, _>>()?, tree, watch)
}

/// Returns the pieces as in [`split`], only to be looked at: cut without booleans, with thin
/// triangles along the cuts.
pub(crate) fn split_for_trial(
    mesh: &TriMesh,
    tree: &CutTree,
    watch: &Watch,
) -> Result<Vec<Piece>, CutError> {
    find_pieces(&tree.cells(mesh, watch)?, tree, watch)
}

/// Returns the pieces in the cells between the cuts.
fn find_pieces(cells: &[TriMesh], tree: &CutTree, watch: &Watch) -> Result<Vec<Piece>, CutError> {
    let mut pieces = Vec::new();
    for cell in cells {
        watch.check()?;
        pieces.extend(bodies(cell).into_iter().map(|mesh| piece(mesh, tree)));
    }
    pieces.retain(|piece| piece.volume_mm3 > SHEET_VOLUME_MM3);
    Ok(sort_pieces(pieces))
}

/// Sorts pieces into the order in which parts are numbered: along a direction slanted to every
/// axis. So parts keep their numbers when the plan cuts slightly different voids. An order by
/// volume would not keep them for the halves of a symmetric model.
pub(crate) fn sort_pieces(pieces: Vec<Piece>) -> Vec<Piece> {
    let slanted = Vector::new(0.331, 0.497, 0.802);
    let position = |piece: &Piece| slanted.dot(&piece.mesh.aabb().center().coords);
    let mut placed: Vec<(f64, Piece)> = pieces
        .into_iter()
        .map(|piece| (position(&piece), piece))
        .collect();
    placed.sort_by(|a, b| b.0.total_cmp(&a.0));
    placed.into_iter().map(|(_, piece)| piece).collect()
}

/// Returns an error if a piece encloses a cavity.
pub(crate) fn check_no_cavity(pieces: &[Piece]) -> Result<(), CutError> {
    for (part, piece) in pieces.iter().enumerate() {
        let cavities = shells(&piece.mesh)
            .iter()
            .filter(|shell| shell.signed_volume_mm3() < 0.0)
            .count();
        if cavities > 0 {
            let part = PartId::of(part);
            return Err(Obstacle::ClosedCavity { part, cavities }.into());
        }
    }
    Ok(())
}

/// Returns a piece with its cut faces. If two cuts lie in one plane, each has the faces in its own
/// region.
pub(crate) fn piece(mesh: TriMesh, tree: &CutTree) -> Piece {
    let of_cut = |(cut, plane): (usize, &Plane)| {
        let chart = Chart::of_plane(plane);
        let is_made = move |cap: &Cap| tree.acts_at(cut, &chart.lift(plane, &cap.inner_point()));
        caps(&mesh, plane, cut)
            .into_iter()
            .filter(is_made)
            .collect::<Vec<Cap>>()
    };
    let caps = tree.planes.iter().enumerate().flat_map(of_cut).collect();
    Piece {
        volume_mm3: mesh.signed_volume_mm3(),
        caps,
        mesh,
    }
}

/// Returns true if a corner lies in a plane, but for rounding.
pub(crate) fn is_on_plane(plane: &Plane, corner: &Point) -> bool {
    plane.distance(corner).abs() <= ON_PLANE_MM
}

/// Returns the faces that the plane has left on a piece, in the order of their first triangles.
pub(crate) fn caps(mesh: &TriMesh, plane: &Plane, cut: usize) -> Vec<Cap> {
    let on_plane: Vec<bool> = mesh
        .vertices()
        .iter()
        .map(|p| is_on_plane(plane, p))
        .collect();
    let is_flat = |&face: &usize| mesh.triangles()[face].iter().all(|&v| on_plane[v as usize]);
    let flat: Vec<usize> = (0..mesh.triangles().len()).filter(is_flat).collect();
    let mut sets = UnionFind::new(mesh.vertices().len());
    for &face in &flat {
        let [a, b, c] = mesh.triangles()[face];
        sets.merge(a, b);
        sets.merge(b, c);
    }
    let mut groups: Vec<(u32, Vec<usize>)> = Vec::new();
    for face in flat {
        let name = sets.root(mesh.triangles()[face][0]);
        match groups.iter_mut().find(|(known, _)| *known == name) {
            Some((_, faces)) => faces.push(face),
            None => groups.push((name, vec![face])),
        }
    }
    let chart = Chart::of_plane(plane);
    groups
        .into_iter()
        .map(|(_, faces)| cap(mesh, faces, &chart, cut))
        .filter(Cap::has_area)
        .collect()
}

fn cap(mesh: &TriMesh, faces: Vec<usize>, chart: &Chart, cut: usize) -> Cap {
    let corners = mesh.vertices().iter().map(|p| chart.flat(p)).collect();
    let flat = Flat {
        corners,
        triangles: faces.iter().map(|&face| mesh.triangles()[face]).collect(),
    };
    Cap {
        faces,
        ..cap_of(&flat, cut)
    }
}

/// Returns the cut face of a flat region, without triangles of a piece.
pub(crate) fn cap_of(flat: &Flat, cut: usize) -> Cap {
    let at = |v: u32| flat.corners[v as usize];
    let boundary = boundary_edges(&flat.triangles)
        .into_iter()
        .map(|(a, b)| [at(a), at(b)])
        .collect();
    let triangles = flat.shapes();
    let signed: f64 = triangles
        .iter()
        .map(|[a, b, c]| (b - a).perp(&(c - a)) / 2.0)
        .sum();
    let (is_above, area_mm2) = (signed < 0.0, signed.abs());
    Cap {
        cut,
        is_above,
        outline: Outline::new(boundary),
        area_mm2,
        faces: Vec::new(),
        triangles,
    }
}

/// Returns the directed edges without an opposite among the triangles, sorted.
fn boundary_edges(triangles: &[[u32; 3]]) -> Vec<(u32, u32)> {
    let mut edges: Vec<(u32, u32)> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
        .collect();
    edges.sort_unstable();
    let is_inner = |&(a, b): &(u32, u32)| edges.binary_search(&(b, a)).is_ok();
    edges
        .iter()
        .filter(|edge| !is_inner(edge))
        .copied()
        .collect()
}

impl Cap {
    fn has_area(&self) -> bool {
        self.area_mm2 > 0.0
    }

    /// Returns whether the face contains a point of the plane.
    pub(crate) fn holds(&self, p: &Point2) -> bool {
        self.triangles.iter().any(|[a, b, c]| {
            let signs = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp(&(p - from)));
            signs.iter().all(|&s| s >= 0.0) || signs.iter().all(|&s| s <= 0.0)
        })
    }

    /// Returns the centroid of the largest triangle: a point well inside the face.
    pub(crate) fn inner_point(&self) -> Point2 {
        let area = |[a, b, c]: &[Point2; 3]| (b - a).perp(&(c - a)).abs();
        let largest = self
            .triangles
            .iter()
            .max_by(|s, t| area(s).total_cmp(&area(t)));
        largest.map_or(Point2::origin(), |[a, b, c]| {
            Point2::from((a.coords + b.coords + c.coords) / 3.0)
        })
    }
}

/// Returns the piece whose face of this cut, on this side, contains the point.
pub(crate) fn piece_at(pieces: &[Piece], cut: usize, is_above: bool, p: &Point2) -> Option<usize> {
    pieces.iter().position(|piece| {
        piece
            .caps
            .iter()
            .any(|cap| cap.cut == cut && cap.is_above == is_above && cap.holds(p))
    })
}

/// Returns all pairs of pieces that meet at a cut, in an order in which they can be glued one after
/// the other. Cuts with more limits come first; then by cut, then by the pieces.
pub(crate) fn joints(pieces: &[Piece], tree: &CutTree) -> Vec<Joint> {
    let caps = |is_above: bool| {
        let all = pieces
            .iter()
            .enumerate()
            .flat_map(|(i, piece)| piece.caps.iter().map(move |cap| (i, cap)));
        all.filter(move |(_, cap)| cap.is_above == is_above)
    };
    let mut joints: Vec<Joint> = Vec::new();
    for (below, low) in caps(false) {
        for (above, high) in caps(true).filter(|(_, high)| high.cut == low.cut) {
            let faces = intersect_caps(low, high, tree);
            let same = |j: &&mut Joint| (j.cut, j.below, j.above) == (low.cut, below, above);
            match joints.iter_mut().find(same) {
                Some(joint) => joint.faces.extend(faces),
                None if faces.is_empty() => {}
                None => joints.push(Joint {
                    cut: low.cut,
                    below,
                    above,
                    faces,
                }),
            }
        }
    }
    joints.sort_by_key(|joint| {
        (
            Reverse(tree.depth(joint.cut)),
            joint.cut,
            joint.below,
            joint.above,
        )
    });
    joints
}

/// Returns the region that two caps of one cut share, as the one below has it. Both lie in the
/// section of the body, but other cuts may end on one side of either.
fn intersect_caps(low: &Cap, high: &Cap, tree: &CutTree) -> Vec<Cap> {
    let meets = |face: &Cap| face.has_area() && high.holds(&face.inner_point());
    if tree.is_everywhere() {
        return if meets(low) {
            vec![low.clone()]
        } else {
            Vec::new()
        };
    }
    let own = &tree.planes[low.cut];
    let (mut flat, other) = (Flat::of(&low.triangles), Flat::of(&high.triangles));
    let mut is_whole = true;
    for plane in (0..tree.planes.len())
        .filter(|&cut| cut != low.cut)
        .map(|cut| &tree.planes[cut])
    {
        let Some(is_above) = other.side_of(own, plane) else {
            continue;
        };
        if flat.is_crossed_by(own, plane) {
            (flat, is_whole) = (flat.clip_to_side(own, plane, is_above), false);
        }
    }
    if is_whole {
        return if meets(low) {
            vec![low.clone()]
        } else {
            Vec::new()
        };
    }
    let faces = flat.pieces();
    faces
        .iter()
        .map(|piece| cap_of(piece, low.cut))
        .filter(meets)
        .collect()
}
