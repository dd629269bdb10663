//! The triangles of a mesh on its way to fewer triangles.

/// Triangles over some vertices of a mesh, and the removed vertices that each stands for.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Parts {
    pub triangles: Vec<[u32; 3]>,
    /// Removed vertices, triangle by triangle.
    pub points: Vec<u32>,
    /// For each triangle, the end of its removed vertices in `points`.
    pub ends: Vec<u32>,
}

impl Parts {
    /// Adds a triangle that stands for these vertices.
    pub fn push(&mut self, triangle: [u32; 3], points: impl Iterator<Item = u32>) {
        self.triangles.push(triangle);
        self.points.extend(points);
        self.ends.push(self.points.len() as u32);
    }

    /// Adds all triangles of another.
    pub fn append(&mut self, other: &Self) {
        let before = self.points.len() as u32;
        self.triangles.extend_from_slice(&other.triangles);
        self.points.extend_from_slice(&other.points);
        self.ends.extend(other.ends.iter().map(|end| before + end));
    }

    /// Returns the removed vertices that a triangle stands for.
    pub fn points_of(&self, triangle: u32) -> &[u32] {
        let t = triangle as usize;
        let start = if t == 0 { 0 } else { self.ends[t - 1] as usize };
        &self.points[start..self.ends[t] as usize]
    }
}

/// A mesh between two rounds.
pub(super) struct State {
    pub parts: Parts,
    /// For each vertex, whether it may still be removable: it was on a seam, or a neighbour has
    /// changed since it was tried.
    pub is_open: Vec<bool>,
}

impl State {
    /// Opens the vertices beside open ones, as only now can they be merged into those.
    pub fn open_beside_seams(&mut self) {
        let beside = |t: &&[u32; 3]| t.iter().any(|&v| self.is_open[v as usize]);
        let near: Vec<u32> = self
            .parts
            .triangles
            .iter()
            .filter(beside)
            .flatten()
            .copied()
            .collect();
        near.into_iter()
            .for_each(|v| self.is_open[v as usize] = true);
    }
}
