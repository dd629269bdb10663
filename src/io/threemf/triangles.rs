//! Meshes as text of a package, in single precision.

use std::fmt::Write as _;

use crate::geom::Point;
use crate::mesh::TriMesh;
use crate::repair::weld;

/// The attribute of a triangle that PrusaSlicer keeps free of support: a whole triangle (no low
/// bits) in the second state of its painting tool.
const BLOCKER: &str = " slic3rpe:custom_supports=\"8\"";
/// The value of that attribute.
pub(super) const BLOCKED: &str = "8";

/// A triangle to be written.
pub struct Facet {
    corners: [u32; 3],
    is_blocked: bool,
}

/// Rounds a mesh to single precision, and merges corners that coincide then.
pub fn round(mesh: &TriMesh) -> TriMesh {
    weld(&mesh.map_vertices(round_to_single))
}

/// Returns the triangles of a mesh that have three corners. `is_blocked` is asked with the corners
/// of each.
pub fn whole_facets(mesh: &TriMesh, is_blocked: impl Fn(&[Point; 3]) -> bool) -> Vec<Facet> {
    let triangles = mesh.triangles().iter().filter(|t| is_whole(t));
    let corners = |t: &[u32; 3]| t.map(|corner| mesh.vertices()[corner as usize]);
    let facet = |t: &[u32; 3]| Facet {
        corners: *t,
        is_blocked: is_blocked(&corners(t)),
    };
    triangles.map(facet).collect()
}

/// Returns whether a triangle has three corners.
fn is_whole([a, b, c]: &[u32; 3]) -> bool {
    a != b && b != c && c != a
}

/// Writes a mesh in single precision, with these of its triangles.
pub fn mesh_xml(mesh: &TriMesh, triangles: &[Facet]) -> String {
    let mut xml = String::from("<mesh><vertices>");
    for p in mesh.vertices() {
        // Writing into a string cannot fail.
        let _ = write!(
            xml,
            "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>",
            p.x as f32, p.y as f32, p.z as f32
        );
    }
    xml.push_str("</vertices>\n<triangles>");
    for facet in triangles {
        let [a, b, c] = facet.corners;
        let blocker = if facet.is_blocked { BLOCKER } else { "" };
        let _ = write!(xml, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"{blocker}/>");
    }
    xml.push_str("</triangles></mesh>\n");
    xml
}

/// Rounds a point to single precision, without −0.0.
fn round_to_single(p: &Point) -> Point {
    p.map(|x| f64::from(x as f32) + 0.0)
}
