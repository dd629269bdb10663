//! The methods of the papers, as they have them: many numbers, one general optimiser.
//!
//! Each describes the void by numbers between 0 and 1 ([`Choice`]): the ends of a solid segment on
//! every ray ([`ByRays`]), a share of every voxel ([`ByVoxels`]), a share of every leaf of an
//! octree ([`ByOctree`]). All see the same columns as the quadric, so whatever they find is one of
//! the interiors that its bound speaks of, and the comparison is exact. They minimise the goal's
//! own formula f(s) subject to As = 0 by an augmented Lagrangian,
//!
//! ```text
//! minimise over 0 ≤ x ≤ 1:  f(s(x)) + λ·As(x) + ½ρ ‖As(x)‖²,    then λ ← λ + ρAs
//! ```
//!
//! each by projected L-BFGS with exact gradients. With g = ∇f + Aᵀ(λ + ρAs) the gradient by a
//! cell's share is −∫ over the cell of g·m: at the end it has one sign inside the quadric g and the
//! other outside of it. They look for the same surface, cell by cell.
//!
//! What they cannot do: prove that nothing is better or that nothing is possible; objectives
//! without a gradient, which is the toppling angle ([`super::MethodError::NotSmooth`]). The λ_max
//! of critical speed and dominance is smoothed.
//!
//! The files, in reading order: `target` f and A · `descent` L-BFGS between bounds · `lagrangian`
//! the constraints · `rays`, `voxels`, `octree` the three methods.
//!
//! Sources: Wu, Kramer, Westermann 2016; Bächer, Whiting, Bickel, Sorkine-Hornung 2014
//! ([`crate::hollow`]). Hestenes, "Multiplier and gradient methods", J. Optim. Theory Appl. 4,
//! 1969. Byrd, Lu, Nocedal, Zhu, "A limited memory algorithm for bound constrained optimization",
//! SIAM J. Sci. Comput. 16, 1995; Bertsekas, "Projected Newton methods for optimization problems
//! with simple constraints", SIAM J. Control Optim. 20, 1982.

#[cfg(test)]
mod conformance;
mod descent;
mod lagrangian;
mod measure;
mod method;
mod octree;
mod quadric;
mod rays;
mod target;
mod voxels;

pub use lagrangian::Accuracy;
pub use method::{Found, Method, MethodError, Outcome, Rounding};
pub use octree::ByOctree;
pub use quadric::ByQuadric;
pub use rays::ByRays;
pub use voxels::ByVoxels;
