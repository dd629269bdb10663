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
//!
//! # 5. Cells in place of voids
//! A kit with an inside of cells is solved with two densities: solid, and that of its cells
//! ([`crate::hollow::Fill`]). The inside is divided once, and the density is measured with all of
//! it made of cells ([`crate::comb::InnerCells`]). Where the quadric is positive, the cells are
//! drawn in from their walls and cut off by the surface of that region. Each wall that can hold an
//! opening gets one. What is drawn differs from the assumed density, most of all at the border of
//! the region. Parts of cells without an opening stay solid there. That difference is one of the
//! defects that are made up for
//! ([theory §10](crate::guide::theory#10-from-the-solution-to-the-print)). Sites stay where they
//! are, so that it changes little from round to round. From the third round on, a cell that turns
//! solid stays so, or it would come and go.
//!
//! Openings keep 0.58 walls from the edges of theirs. So two of them beside each other leave a
//! wall between them where cells meet at 120°.
//!
//! In a vat, a cell encloses resin below the lowest way out, as every cup does. It is least where
//! a cube stands on its corner and its openings lie as low as they can. So openings are placed for
//! one of the lower corners of a cube along the axes of the model. It is the one with which the
//! most stays hollow. The summit of the lowest way from each cell to the lowest one is found by
//! joining cells at their openings, the lowest first (`comb/pockets.rs`). The cells with the
//! largest pockets stay solid until the rest has 60 mm³ or less. The drain hole is bored where the
//! cells are lowest in that pose, and the search for poses knows these corners.
