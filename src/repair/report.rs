//! The report of a repair: how often each rung changed something, and how far the surface moved.

use std::fmt;

use crate::base::units::{format_count, show_mm};

/// Counts of the changes that [`super::repair`] made to a mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Repairs {
    /// Vertices merged with another at exactly the same place.
    pub merged_vertices: usize,
    /// Vertices on open edges merged with another within a millionth of the model's diagonal.
    pub merged_near_vertices: usize,
    /// Dropped triangles that repeated a corner.
    pub dropped_degenerate: usize,
    /// Dropped triangles that repeated another triangle.
    pub dropped_duplicates: usize,
    /// Triangles flipped to agree with their neighbours or to face outward.
    pub flipped_triangles: usize,
    /// Vertices added to separate surfaces that only touch in a vertex or an edge.
    pub split_vertices: usize,
    /// Dropped vertices that no triangle used.
    pub dropped_vertices: usize,
    /// Open edges along cracks that were stitched.
    pub stitched_edges: usize,
    /// Largest distance by which a vertex moved in stitching, as a share of the diagonal.
    pub stitched_ratio: f64,
    /// Holes that were filled. Nothing moved.
    pub filled_holes: usize,
    /// Area of the fillings over that of the surface before.
    pub filled_area_ratio: f64,
    /// Pairs of triangles of one surface that crossed, and cross no more.
    pub untangled_pairs: usize,
    /// Largest distance by which the surface moved in untangling, as a share of the diagonal.
    pub untangled_ratio: f64,
    /// Surfaces inside the model that were dropped: it is filled there.
    pub filled_shells: usize,
    /// Surfaces inside the model that bound cavities.
    pub cavities: usize,
    /// The new surface that was drawn; `None` if the old one was kept.
    pub redrawn: Option<Redrawn>,
    /// Closed surfaces that were united with those they overlap.
    pub united_shells: usize,
}

/// A new surface in place of the old one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Redrawn {
    /// Its tolerance, mm.
    pub within_mm: f64,
    /// Largest distance that was measured between it and the old one, mm. Of the old one what does
    /// not part inside from outside is left out.
    pub moved_mm: f64,
    /// Pieces of it that were dropped as smaller than its tolerance can tell.
    pub dropped_specks: usize,
}

impl Repairs {
    /// Returns true if nothing had to be done.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Describes what the rungs did that close the surface or unite it.
    fn describe_closing(&self) -> Vec<String> {
        let stitched = (self.stitched_edges > 0).then(|| {
            format!(
                "open edges stitched along cracks: {} ({})",
                self.stitched_edges,
                moved_at_most(self.stitched_ratio)
            )
        });
        let filled = (self.filled_holes > 0).then(|| {
            format!(
                "{} filled, {:.2} % of the surface (nothing moved)",
                format_count(self.filled_holes, "hole"),
                100.0 * self.filled_area_ratio
            )
        });
        let untangled = (self.untangled_pairs > 0).then(|| {
            format!(
                "crossings of the surface with itself resolved: {} ({})",
                self.untangled_pairs,
                moved_at_most(self.untangled_ratio)
            )
        });
        let united = (self.united_shells > 0).then(|| {
            format!(
                "closed surfaces that overlap united: {}",
                self.united_shells
            )
        });
        let closed = stitched.into_iter().chain(filled);
        closed.chain(untangled).chain(united).collect()
    }

    /// Describes what was done because the owner ordered it.
    fn describe_ordered(&self) -> Vec<String> {
        let filled = (self.filled_shells > 0).then(|| {
            format!(
                "{} inside the model filled (the outside did not move)",
                format_count(self.filled_shells, "surface")
            )
        });
        let cavities = (self.cavities > 0).then(|| {
            format!(
                "{} inside the model kept as {} (nothing moved)",
                format_count(self.cavities, "surface"),
                if self.cavities == 1 {
                    "a cavity"
                } else {
                    "cavities"
                }
            )
        });
        let redrawn = self.redrawn.map(|redrawn| {
            let specks = match redrawn.dropped_specks {
                0 => String::new(),
                count => format!("; dropped as too small: {}", format_count(count, "piece")),
            };
            format!(
                "a new surface drawn within {} (no point moved by more than {}{specks})",
                show_mm(redrawn.within_mm),
                show_mm(redrawn.moved_mm)
            )
        });
        redrawn.into_iter().chain(filled).chain(cavities).collect()
    }

    /// Returns the counts that a user should know. Leaves out the merging of equal vertices,
    /// which every STL file needs, and the dropping of unused ones, which nobody sees.
    pub fn notable(self) -> Self {
        Self {
            merged_vertices: 0,
            dropped_vertices: 0,
            ..self
        }
    }
}

impl fmt::Display for Repairs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let done = [
            (
                self.merged_vertices,
                "vertices merged with another at the same place",
            ),
            (
                self.merged_near_vertices,
                "vertices on open edges merged with one next to them",
            ),
            (self.dropped_degenerate, "triangles without area dropped"),
            (self.dropped_duplicates, "doubled triangles dropped"),
            (self.flipped_triangles, "triangles turned to face outward"),
            (
                self.split_vertices,
                "vertices added where surfaces only touch",
            ),
            (self.dropped_vertices, "unused vertices dropped"),
        ];
        let descriptions: Vec<String> = done
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, description)| format!("{description}: {count}"))
            .chain(self.describe_closing())
            .chain(self.describe_ordered())
            .collect();
        if descriptions.is_empty() {
            f.write_str("nothing")
        } else {
            f.write_str(&descriptions.join(", "))
        }
    }
}

/// Least move that is told, percent of the diagonal: 0.001 mm on a metre. Less would read as none.
const LEAST_TOLD_PERCENT: f64 = 1e-4;

/// Says how far the surface moved, given as a share of the diagonal.
fn moved_at_most(ratio: f64) -> String {
    if ratio == 0.0 {
        return "nothing moved".to_owned();
    }
    let percent = (100.0 * ratio).max(LEAST_TOLD_PERCENT);
    format!("no point moved by more than {percent:.4} % of the model's diagonal")
}
