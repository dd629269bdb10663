//! The papers' own methods: many variables and one general optimiser (feature `papers`).
//!
//! Each describes the void by numbers between 0 and 1 ([`Choice`](crate::interior::Choice)).
//! [`ByRays`] has the ends of a solid segment on every ray. [`ByVoxels`] has a share of every
//! voxel, and [`ByOctree`] one of every leaf of an octree. All use the same columns as the quadric.
//! So each result is an interior that the quadric's bound covers, and the comparison is exact. They
//! minimise the goal's own formula f(s) subject to As = 0 by an augmented Lagrangian,
//!
//! ```text
//! minimise over 0 ≤ x ≤ 1:  f(s(x)) + λ·As(x) + ½ρ ‖As(x)‖²,    then λ ← λ + ρAs
//! ```
//!
//! each by projected L-BFGS with exact gradients. Put g = ∇f + Aᵀ(λ + ρAs). The gradient by a
//! cell's share is then −∫ of g·m over the cell. At the end it has one sign inside the quadric g
//! and the other outside. The methods look for the same surface, cell by cell.
//!
//! They cannot prove that nothing is better, or that nothing is possible. They cannot optimise an
//! objective without a gradient, which is the toppling angle ([`MethodError::NotSmooth`]). The
//! λ_max of critical speed and dominance is smoothed.
//!
//! # Agreement
//! One suite (`conformance`) compares all of them with the quadric. Let q be the optimal quadric,
//! and R = ∫|q| over the region where a method's void differs from the best: its regret. R is never
//! negative. The volume of that region is at most √(2R Σ area/|∂q/∂z|) to first order; measured are
//! half of that to all of it. For cells of height h put L = Σ area |∂q/∂z| h²/8 over the surface. R
//! is at most 2L for voxels (measured: L/10 to L/3). It is at most 8L for the octree, which merges
//! and rounds (measured: 1.5 L to 2 L). Rays end at R < 1e-5 of the solid's volume, or 1e-4 more if
//! λ_max is smoothed for them. `benches/README.md` has the times.
//!
//! # Files
//! | file | holds |
//! |---|---|
//! | `method` | the trait |
//! | `target` | f and A |
//! | `descent` | L-BFGS between bounds |
//! | `lagrangian` | the constraints |
//! | `measure` | the result |
//! | `rays`, `voxels`, `octree` | the three methods |
//! | `quadric` | the solver behind the same trait |
//!
//! Sources: Wu, Kramer, Westermann 2016; Bächer, Whiting, Bickel, Sorkine-Hornung 2014
//! ([`crate::hollow`]). Hestenes, "Multiplier and gradient methods", J. Optim. Theory Appl. 4,
//! 1969. Byrd, Lu, Nocedal, Zhu, "A limited memory algorithm for bound constrained optimization",
//! SIAM J. Sci. Comput. 16, 1995. Bertsekas, "Projected Newton methods for optimization problems
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
