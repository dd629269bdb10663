//! Cells: how a model is divided into near cubes, and what is exact about it.
//!
//! # 1. The energy
//! Sites share a solid: each place belongs to the nearest site by the straight distance. So cells
//! are convex, cut off at the surface. The Chebyshev energy of a cell about its site p is
//! E = ∫ ‖x − p‖∞. It is least for cubes: a cube of side a has 3a⁴/8. Six fragments part a cell,
//! one for each direction ±k in which a coordinate is the greatest. In each the norm is linear, so
//! E has a closed form over the cones of the boundary (Bukenberger and Lensch, 2021).
//!
//! Ours is that E is convex in p for a fixed cell. A fragment's side moves with p, but the norm has
//! the same value on both of its sides. So ∂E/∂pₖ is the volume of fragment −k less that of +k. The
//! second derivative lives on the twelve sides: Σ √2 · area · ννᵀ. Newton's method finds the best
//! place of a cell in a few steps ([`crate::cells::Chebyshev`]). The paper hands all sites to
//! L-BFGS-B instead.
//!
//! # 2. Relaxation
//! Lloyd's method moves every site to the best place of its cell and draws the cells anew
//! ([`crate::cells::relax`]). Under L2 that place is the centre of the cell. Under L∞ the walls are
//! still those of the straight distance. True L∞ cells are not convex (Bukenberger, Buchin and
//! Botsch, 2022). So a step may raise the energy of all, though it never does in a fixed cell. It
//! ends in a minimum near its start, not in the least of all.
//!
//! # 3. Exact parts of a solid
//! A cell in the solid is the solid's signed triangles, cut by planes ([`crate::cells::Chain`]).
//! The faces that a cut lays bare are closed by fans of signed triangles, which may overlap.
//! Integrals over them are exact to rounding, so volumes add up to the solid's. For files the same
//! cells are cut again as meshes whose triangles fit edge to edge ([`crate::cells::bodies`]).
//!
//! # 4. Sizes, axes, stretch
//! Walls of thickness t around cubes of side a have the density d = 1 − (1 − t/a)³. So a density
//! wishes the size a(x) = t / (1 − (1 − d)^⅓). The energy is weighed by a(x)⁻⁴: then a cube of any
//! wished size has the same energy. First sites are darts that keep 0.7 of the wished size from
//! each other ([`crate::cells::poisson_sites`]).
//!
//! Turned and stretched cells are cubes in a space of their own, x′ = S⁻¹Rᵀx with |S| = 1
//! ([`crate::cells::Axes`]). The model is relaxed there and taken back. Planes stay planes, so
//! cells stay convex. Axes that vary from place to place turn the norm of each cell, not its walls.
