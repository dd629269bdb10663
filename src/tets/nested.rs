//! A density in steps: one outside of regions, another in each of them, and they are nested.

use rayon::prelude::*;

use super::parts::Densities;
use super::volume::Tets;
use crate::geom::{Point, Vector};
use crate::mass::{ConeRule, Moments, Tetrahedron, moments_of_mesh};
use crate::mesh::{MeshDistance, TriMesh};

/// Degree of the rule that samples cells in which the density steps: 27 points.
const STEP_DEGREE: usize = 5;

/// A region, and the density in it.
#[derive(Debug)]
struct Region {
    surface: MeshDistance,
    moments: Moments,
    density: f64,
}

/// A density that is constant between nested closed surfaces, as infill is printed.
#[derive(Debug)]
pub struct NestedDensity {
    around: f64,
    regions: Vec<Region>,
}

impl NestedDensity {
    /// Takes the density around all regions, and regions with theirs, each inside the one before.
    pub fn new(around: f64, regions: &[(TriMesh, f64)]) -> Self {
        let region = |(mesh, density): &(TriMesh, f64)| Region {
            surface: MeshDistance::new(mesh),
            moments: moments_of_mesh(mesh),
            density: *density,
        };
        Self {
            around,
            regions: regions.iter().map(region).collect(),
        }
    }

    /// Returns the density at a place.
    pub fn at(&self, at: &Point) -> f64 {
        let inside = self.regions.iter().rev();
        let mut inside = inside.filter(|region| region.surface.signed(at) > 0.0);
        inside.next().map_or(self.around, |region| region.density)
    }

    /// Returns the exact moments of a body with this density, mm³ to mm⁵ of solid material; `body`
    /// are those of the whole body, in which all regions lie.
    pub fn moments(&self, body: &Moments) -> Moments {
        let mut sum = *body * self.around;
        let mut outside = self.around;
        for region in &self.regions {
            sum += region.moments * (region.density - outside);
            outside = region.density;
        }
        sum
    }

    /// Returns a mesh with the mean density of each tetrahedron.
    ///
    /// The density jumps, so a value for each corner would smear every step over the cells beside
    /// it. A mean for each tetrahedron keeps its mass. Bitwise the same on any number of threads.
    #[must_use]
    pub fn on(&self, tets: &Tets) -> Tets {
        let rule = ConeRule::of_degree(STEP_DEGREE);
        let cells = (0..tets.cells().len()).into_par_iter();
        let means = cells.map(|cell| self.mean(&tets.tetrahedron(cell), &rule));
        tets.with_densities(Densities::Cells(means.collect()))
    }

    /// Returns the mean density in a tetrahedron.
    fn mean(&self, tetrahedron: &Tetrahedron, rule: &ConeRule) -> f64 {
        let middle = Point::from(tetrahedron.0.iter().sum::<Vector>() / 4.0);
        let reach = tetrahedron
            .0
            .iter()
            .map(|corner| (corner - middle.coords).norm());
        let reach = reach.fold(0.0, f64::max);
        let steps = |region: &Region| {
            let nearest = region.surface.bvh().closest(&middle, reach, &[]);
            nearest.is_some()
        };
        if !self.regions.iter().any(steps) {
            return self.at(&middle);
        }
        let volume = tetrahedron.volume_mm3();
        let mass = tetrahedron.by_rule(rule, |at| self.at(&Point::from(*at)));
        (mass.volume() / volume).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Difference, stuff};
    use super::*;
    use crate::mesh::Solid;
    use crate::mesh::primitives::ball;

    #[test]
    fn nested_balls_have_their_mass_exactly_and_nearly_on_a_mesh() {
        let middle = Point::new(1.0, 0.0, 0.0);
        let shell = |radius| ball(&middle, radius, 4);
        let solid = Solid::new(shell(10.0)).unwrap();
        let regions = [(shell(8.0), 0.2), (shell(5.0), 0.6)];
        let density = NestedDensity::new(1.0, &regions);
        for (x, expected) in [(1.0, 0.6), (7.0, 0.2), (10.0, 1.0)] {
            assert_eq!(density.at(&Point::new(x, 0.0, 0.0)), expected);
        }
        let [whole, outer, inner] = [10.0, 8.0, 5.0].map(|r| moments_of_mesh(&shell(r)).volume());
        let exact = density.moments(&moments_of_mesh(solid.mesh()));
        let want = whole - 0.8 * outer + 0.4 * inner;
        assert!((exact.volume() / want - 1.0).abs() < 1e-14);
        let tets = Tets::new(stuff(&solid, 1.5).unwrap()).unwrap();
        let off = Difference::between(&density.on(&tets).moments(), &exact).unwrap();
        assert!(off.mass_ratio < 0.01 && off.center_mm < 0.02, "{off:?}");
    }
}
