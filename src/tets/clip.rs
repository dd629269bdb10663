//! The part of a tetrahedron that lies inside a solid, as tetrahedra.
//!
//! What is left is a convex body whose corners are corners of the tetrahedron and cuts of its
//! edges. It is parted from its corner of the least number, and so is each face. Neighbours see the
//! same faces with the same numbers, so their parts fit together.

use super::faces::FACES;

use crate::geom::Point;

/// The place where an edge leaves a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cut {
    /// The end inside.
    pub inner: u32,
    /// The end outside.
    pub outer: u32,
    /// The share of the edge from the inner end.
    pub share: f64,
}

impl Cut {
    /// Returns both ends, the inner one first.
    pub fn ends(&self) -> [u32; 2] {
        [self.inner, self.outer]
    }

    /// Returns the edge, its lesser end first.
    fn edge(&self) -> [u32; 2] {
        [self.inner.min(self.outer), self.inner.max(self.outer)]
    }

    /// Returns the place, mm.
    pub fn place(&self, vertices: &[Point]) -> Point {
        let [inner, outer] = self.ends().map(|end| vertices[end as usize]);
        inner + (outer - inner) * self.share
    }
}

/// Cuts tetrahedra by values at their corners, which are positive inside.
pub(super) struct Clipper<'a> {
    pub values: &'a [f64],
    /// The cuts, in the order of their edges.
    pub cuts: &'a [Cut],
    /// The number of the first cut; others follow it.
    pub first: u32,
}

impl Clipper<'_> {
    /// Returns the part inside; nothing if no corner lies inside.
    pub fn clip(&self, cell: &[u32; 4]) -> Vec<[u32; 4]> {
        let value = |vertex: &u32| self.values[*vertex as usize];
        if !cell.iter().any(|vertex| value(vertex) > 0.0) {
            return Vec::new();
        }
        if cell.iter().all(|vertex| value(vertex) >= 0.0) {
            return vec![*cell];
        }
        let faces = FACES.map(|face| self.inside(face.map(|corner| cell[corner])));
        let mut faces: Vec<Vec<u32>> = faces.into_iter().filter(|face| face.len() > 2).collect();
        faces.push(lid(&faces));
        let Some(apex) = faces.iter().flatten().min().copied() else {
            return Vec::new();
        };
        let opposite = faces.iter().filter(|face| !face.contains(&apex));
        let fans = opposite.flat_map(|face| fan(face));
        // A face is seen from outside, so that the apex lies below it.
        fans.map(|[a, b, c]| [apex, a, b, c]).collect()
    }

    /// Returns the part of a face inside; fewer than three corners if it has no area.
    fn inside(&self, face: [u32; 3]) -> Vec<u32> {
        let value = |vertex: u32| self.values[vertex as usize];
        let mut ring = Vec::with_capacity(4);
        for (index, &from) in face.iter().enumerate() {
            let to = face[(index + 1) % 3];
            if value(from) >= 0.0 {
                ring.push(from);
            }
            if value(from) * value(to) < 0.0 {
                ring.extend(self.cut([from.min(to), from.max(to)]));
            }
        }
        ring
    }

    /// Returns the number of the cut of an edge.
    fn cut(&self, edge: [u32; 2]) -> Option<u32> {
        let at = self.cuts.binary_search_by_key(&edge, Cut::edge).ok()?;
        Some(self.first + at as u32)
    }
}

/// Returns the face that closes others: its edges are those that only one of them has, turned.
fn lid(faces: &[Vec<u32>]) -> Vec<u32> {
    let edges = faces.iter().flat_map(|face| {
        let next = face.iter().cycle().skip(1);
        face.iter().copied().zip(next.copied())
    });
    let edges: Vec<(u32, u32)> = edges.collect();
    let is_open = |&(from, to): &(u32, u32)| !edges.contains(&(to, from));
    let open: Vec<(u32, u32)> = edges.iter().copied().filter(is_open).collect();
    let Some(&(_, start)) = open.first() else {
        return Vec::new();
    };
    let mut ring = vec![start];
    while ring.len() < open.len() {
        let last = ring[ring.len() - 1];
        // Against the edges, as neighbours run.
        match open.iter().find(|(_, to)| *to == last) {
            Some((from, _)) => ring.push(*from),
            None => break,
        }
    }
    ring
}

/// Parts a face into triangles from its corner of the least number.
fn fan(face: &[u32]) -> Vec<[u32; 3]> {
    let least = (0..face.len()).min_by_key(|&at| face[at]).unwrap_or(0);
    let at = |step: usize| face[(least + step) % face.len()];
    (2..face.len())
        .map(|step| [at(0), at(step - 1), at(step)])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::mass::Tetrahedron;

    const CORNERS: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];

    /// Returns the volume of the part inside, whose tetrahedra are all turned alike.
    fn volume(values: [f64; 4]) -> f64 {
        let vertices = CORNERS.map(Point::from);
        let mut cuts = Vec::new();
        for low in 0..4_usize {
            for high in low + 1..4 {
                if values[low] * values[high] < 0.0 {
                    let [inner, outer] = if values[low] > 0.0 {
                        [low, high]
                    } else {
                        [high, low]
                    };
                    cuts.push(Cut {
                        inner: inner as u32,
                        outer: outer as u32,
                        share: values[inner] / (values[inner] - values[outer]),
                    });
                }
            }
        }
        let places = cuts.iter().map(|cut| cut.place(&vertices));
        let all: Vec<Vector> = vertices
            .iter()
            .copied()
            .chain(places)
            .map(|at| at.coords)
            .collect();
        let clipper = Clipper {
            values: &values,
            cuts: &cuts,
            first: 4,
        };
        let parts = clipper.clip(&[0, 1, 2, 3]).into_iter();
        let volumes = parts.map(|part| Tetrahedron(part.map(|at| all[at as usize])).volume_mm3());
        volumes
            .inspect(|volume| assert!(*volume > 0.0, "{values:?}"))
            .sum()
    }

    #[test]
    fn every_case_of_signs_keeps_what_lies_inside() {
        let signs = [-1.0, 0.0, 1.0];
        for case in 0..81_usize {
            let values = [case % 3, case / 3 % 3, case / 9 % 3, case / 27].map(|it| signs[it]);
            let inside = volume(values);
            let outside = volume(values.map(|value: f64| -value));
            let is_cut = values.iter().any(|it| *it > 0.0) || values.iter().any(|it| *it < 0.0);
            if is_cut {
                assert!((inside + outside - 1.0 / 6.0).abs() < 1e-15, "{values:?}");
            }
        }
    }

    #[test]
    fn a_plane_cuts_off_the_tip_that_lies_beyond_it() {
        // x + y + z < 1/2: an eighth.
        assert!((volume([0.5, -0.5, -0.5, -0.5]) - 1.0 / 48.0).abs() < 1e-16);
        assert!((volume([-0.5, 0.5, 0.5, 0.5]) - 7.0 / 48.0).abs() < 1e-16);
    }
}
