//! The part of a body below a level, and the section there: exact for the mesh.

use super::moments::Moments;
use super::of_mesh::MomentSum;
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// The area moments of the region that a plane z = constant cuts out of a body.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Section {
    /// Area, mm².
    pub area_mm2: f64,
    /// ∫x and ∫y over it, mm³.
    pub first_mm3: [f64; 2],
    /// ∫x², ∫xy and ∫y² over it, mm⁴.
    pub second_mm4: [f64; 3],
}

/// The part of a body below a level, and its section at that level.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Submerged {
    /// Moments of the part below.
    pub below: Moments,
    /// Section at the level: the waterplane.
    pub section: Section,
}

impl Section {
    /// Adds the region between the origin and the directed edge from `a` to `b` (Green's theorem).
    fn add_edge(&mut self, a: &Point, b: &Point) {
        let twice = a.x * b.y - b.x * a.y;
        self.area_mm2 += twice / 2.0;
        self.first_mm3[0] += twice * (a.x + b.x) / 6.0;
        self.first_mm3[1] += twice * (a.y + b.y) / 6.0;
        self.second_mm4[0] += twice * (a.x * a.x + a.x * b.x + b.x * b.x) / 12.0;
        self.second_mm4[1] +=
            twice * (a.x * b.y + 2.0 * a.x * a.y + 2.0 * b.x * b.y + b.x * a.y) / 24.0;
        self.second_mm4[2] += twice * (a.y * a.y + a.y * b.y + b.y * b.y) / 12.0;
    }

    /// Returns the least and greatest second moments about axes in the plane through the section's
    /// centroid, mm⁴; zero if the section is empty.
    pub fn principal_mm4(&self) -> [f64; 2] {
        if self.area_mm2 <= 0.0 {
            return [0.0; 2];
        }
        let [x, y] = self.first_mm3;
        let [xx, xy, yy] = self.second_mm4;
        let about = |second: f64, a: f64, b: f64| second - a * b / self.area_mm2;
        let (xx, xy, yy) = (about(xx, x, x), about(xy, x, y), about(yy, y, y));
        let (mean, spread) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        [mean - spread, mean + spread]
    }
}

/// Returns the part of the region bounded by a closed mesh that lies at z ≤ `level_mm`, and the
/// section there. Exact up to rounding.
///
/// Each triangle's part below the level spans a cone with a point of the level's plane. The cap
/// lies in that plane and spans none, so it need not be built. The cap's own moments come from its
/// boundary, the edges at which triangles are clipped.
pub fn clip_below(mesh: &TriMesh, level_mm: f64) -> Submerged {
    let middle = mesh.aabb().center();
    let apex = Vector::new(middle.x, middle.y, level_mm);
    let mut below = MomentSum::default();
    let mut section = Section::default();
    for corners in mesh.iter_corners() {
        let clipped = clip_to_below(corners.map(|corner| corner - apex));
        let polygon = &clipped.corners[..clipped.count];
        for pair in polygon.windows(2).skip(1) {
            below.add_tetrahedron([polygon[0], pair[0], pair[1]].map(|corner| corner.coords));
        }
        if let Some([leaves, enters]) = clipped.crossing {
            section.add_edge(&enters, &leaves);
        }
    }
    Submerged {
        below: below.total().translated(&apex),
        section: section.moved([apex.x, apex.y]),
    }
}

impl Section {
    /// Returns the region moved by a shift.
    fn moved(self, [dx, dy]: [f64; 2]) -> Self {
        let (area, [x, y], [xx, xy, yy]) = (self.area_mm2, self.first_mm3, self.second_mm4);
        Self {
            area_mm2: area,
            first_mm3: [x + area * dx, y + area * dy],
            second_mm4: [
                xx + dx * (2.0 * x + area * dx),
                xy + dx * y + dy * x + area * dx * dy,
                yy + dy * (2.0 * y + area * dy),
            ],
        }
    }
}

/// The part of a triangle at z ≤ 0.
struct Clipped {
    corners: [Point; 4],
    count: usize,
    /// Points in which its boundary leaves upward and comes back.
    crossing: Option<[Point; 2]>,
}

/// Returns the part of a triangle at z ≤ 0.
fn clip_to_below(triangle: [Point; 3]) -> Clipped {
    let mut clipped = Clipped {
        corners: [Point::origin(); 4],
        count: 0,
        crossing: None,
    };
    let [mut leaves, mut enters] = [None; 2];
    for (from, to) in
        [(0, 1), (1, 2), (2, 0)].map(|(i, j): (usize, usize)| (triangle[i], triangle[j]))
    {
        if from.z <= 0.0 {
            clipped.push(from);
        }
        if from.z <= 0.0 && to.z > 0.0 {
            leaves = Some(clipped.push(level_point(&from, &to)));
        } else if from.z > 0.0 && to.z <= 0.0 {
            enters = Some(clipped.push(level_point(&to, &from)));
        }
    }
    clipped.crossing = leaves.zip(enters).map(|(leaves, enters)| [leaves, enters]);
    clipped
}

impl Clipped {
    fn push(&mut self, corner: Point) -> Point {
        self.corners[self.count] = corner;
        self.count += 1;
        corner
    }
}

/// Returns the point in which the edge from a corner below to one above meets the level. Both
/// triangles at the edge get the same bits.
fn level_point(below: &Point, above: &Point) -> Point {
    let share = below.z / (below.z - above.z);
    Point::new(
        below.x + share * (above.x - below.x),
        below.y + share * (above.y - below.y),
        0.0,
    )
}

#[cfg(test)]
mod tests {
    use super::super::moments_of_mesh;
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    #[test]
    fn a_box_submerged_to_a_third_is_a_third_of_the_box() {
        let mesh = cuboid(&Point::new(1.0, -2.0, 5.0), &Point::new(4.0, 3.0, 11.0));
        let got = clip_below(&mesh, 7.0);
        let want = moments_of_mesh(&cuboid(
            &Point::new(1.0, -2.0, 5.0),
            &Point::new(4.0, 3.0, 7.0),
        ));
        for (got, want) in got.below.0.iter().zip(want.0) {
            assert!(
                (got - want).abs() < 1e-12 * want.abs().max(1.0),
                "{got} {want}"
            );
        }
        // 3 × 5: I = b h³/12 about its middle.
        let [least, greatest] = got.section.principal_mm4();
        assert!((got.section.area_mm2 - 15.0).abs() < 1e-12);
        assert!(
            (least - 5.0 * 27.0 / 12.0).abs() < 1e-11
                && (greatest - 3.0 * 125.0 / 12.0).abs() < 1e-11
        );
        assert!((got.section.first_mm3[0] / 15.0 - 2.5).abs() < 1e-13);
    }

    #[test]
    fn a_ball_has_the_cap_and_the_circle_of_the_textbook() {
        // A ball of radius r to depth h: V = π h² (3r − h)/3, I of the circle π a⁴/4 with a² = h
        // (2r − h).
        let (r, h) = (10.0_f64, 7.0_f64);
        let got = clip_below(&ball(&Point::new(3.0, 4.0, r), r, 6), h);
        let volume = std::f64::consts::PI * h * h * (3.0 * r - h) / 3.0;
        let second = std::f64::consts::PI * (h * (2.0 * r - h)).powi(2) / 4.0;
        // An icosphere of six halvings is inscribed: it lacks 3e-4 of its volume, and twice that of
        // a fourth moment.
        assert!((got.below.volume() / volume - 1.0).abs() < 1e-3);
        assert!(
            got.section
                .principal_mm4()
                .iter()
                .all(|found| (found / second - 1.0).abs() < 2e-3)
        );
    }

    #[test]
    fn a_level_below_the_body_gives_nothing_and_one_above_it_the_whole() {
        let mesh = cuboid(&Point::origin(), &Point::new(1.0, 2.0, 3.0));
        assert_eq!(clip_below(&mesh, -0.5).below.volume(), 0.0);
        for level in [3.0, 4.0] {
            let got = clip_below(&mesh, level);
            assert!((got.below.volume() - 6.0).abs() < 1e-14);
            assert_eq!(got.section, Section::default());
        }
    }

    #[test]
    fn a_cavity_displaces_no_water() {
        let cavity = cuboid(&Point::new(1.0, 1.0, 1.0), &Point::new(2.0, 2.0, 2.0)).reversed();
        let mesh = cuboid(&Point::origin(), &Point::new(3.0, 3.0, 3.0)).joined(&cavity);
        let got = clip_below(&mesh, 1.5);
        assert!((got.below.volume() - 13.0).abs() < 1e-13);
        assert!((got.section.area_mm2 - 8.0).abs() < 1e-13);
    }
}
