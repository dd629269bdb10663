//! The theory: why the optimal void is one quadric, and how the solver finds and certifies it.
//!
//! # 1. The reachable set
//! Let m(x) = (1, x, y, z, xy, yz, xz, x², y², z²) in the goal frame, and s = ρ ∫ m dV over the
//! material. Mass, centre and inertia tensor are functions of these ten numbers alone (Spin-It, eq.
//! 4). The wall stays. A region Ω may be emptied, by any fraction β(x) in [0, 1] of its material.
//! The set K of all reachable s is convex and compact. By Lyapunov's theorem every point of it is
//! reached by a void with a sharp boundary, β in {0, 1}.
//!
//! For a direction g the least g·s over K empties exactly { x in Ω : g·m(x) > 0 }: the inside of
//! one quadric. So for any goal the optimal void is Ω cut by a single quadric. The unknown of the
//! whole problem is g in R¹⁰, at any resolution. There are no variables per voxel, and there is no
//! rounding step. Wu, Kramer and Westermann prove that each vertical ray carries at most two
//! changes. Here that is a corollary: a quadratic has at most two roots on a line.
//!
//! # 2. Goals
//! Every goal minimises a quasi-convex function over K under linear equations: a convex function
//! divided by a positive linear one ([`crate::goal`] lists them). Dinkelbach's method turns the
//! quotient into a few convex problems N(s) − τ e·s. Each of these is solved in its dual. The
//! unknowns are a point y of a ball, a disc or a simplex, and one multiplier per equation. They are
//! at most ten numbers. The dual is concave with gradient (J s(g), A s(g)) and Hessian −[J; A] W
//! [J; A]ᵀ. Here W = ρ Σ m mᵀ/|∂q/∂z| over the quadric's crossings, so Newton's method applies.
//! [`crate::hollow`] has the method.
//!
//! A top is quasi-convex only at a fixed height ℓ of its centre. The search over the one number ℓ
//! uses the multiplier of the row s_z − ℓ s₁ = 0 as derivative (envelope theorem).
//!
//! A floating object has equations for its mass and for the horizontal place of its centre. The
//! height of the centre is the linear function to minimise. The metacentre c_b + I_w/V_b depends on
//! the outside alone, so the lowest centre is the most stable. A free waterline is one more number
//! to search ([`crate::prepare`]).
//!
//! A rotor's axis is free if s_x = s_y = s_xz = s_yz = 0. A linear programme then removes the least
//! material. If the equations cannot be met, the unbalances U_A, U_B in two planes are linear in s.
//! So ‖(U_A, U_B)‖/s₁ is again a norm over a positive linear function, and its bound limits the
//! grade from below.
//!
//! # 3. Hardware
//! Parts that are not printed add constant moments. Their sockets are outside surface like any
//! other ([`crate::hardware`]). A yo-yo's halves are moved apart before the solve. The optimum is
//! then one quadric q in the moved position, and two in the model. The upper half's is q(x, y, z +
//! gap/2) > 0 and the lower half's q(x, y, z − gap/2) > 0. Both have the same multipliers. Values,
//! bounds and proofs hold for hollowings of these halves, each with its wall towards the gap.
//!
//! # 4. A few columns find the dual points
//! For any symmetric T the image TK + b of a convex set is convex. Its extreme points are T s(Tg) +
//! b, their derivatives T W(Tg) T. Let K' be the set of a sixteenth of the columns. It can be
//! mapped to touch K at the extreme point of a given g with the same curvature. T is then the map
//! of optimal transport between two Gaussians of covariance W' and W. The search runs in that set,
//! and so does the choice of multipliers for the proof over all heights. All columns are evaluated
//! at the g where it ends. Bounds hold at any multipliers, so no claim rests on the few columns.
//!
//! # 5. The certificate
//! Any dual point gives a lower bound: no hollowing of this model with this wall can do better. The
//! value, the bound and their gap are part of every solution. If the dual grows without limit, its
//! direction is a quadric that separates the goal from all reachable points. This proves that no
//! hollowing meets the goal.
//!
//! A kit carries the dual point of its first solution, before anything was kept solid for cleaning
//! ([`crate::verify::BoundProof`]). For any ratio it gives a quadric g, and the least of all
//! hollowings along g is the body with { g·m > 0 } emptied. So the judge needs one integral over
//! the inside, which it takes over its own cells, and no search. The ratio at which the integral
//! meets its limit is its own bound. A top has a point at each of several heights of its centre;
//! the margin of each reaches to the next. The judge finds the best ratio at which they leave no
//! height out.
//!
//! # 6. Impossible goals
//! Three facts make it cheap to find remedies ([`crate::advice`]):
//!
//! * Only the ratio of wall to size counts, and a thinner wall only adds to Ω. So one number
//!   divides possible from impossible sizes.
//! * The proof of impossibility is the integral of a quadric. By the envelope theorem, its slope as
//!   contact or axis move is that of the same moments in a moved frame. So the way to the nearest
//!   possible place is known without solving.
//! * With a denser material the reachable set is still convex. A grain at x is emptied if g·m > 0.
//!   It is replaced if g·m is far enough below zero to be worth the price. These are two level sets
//!   of one quadric ([`crate::hollow::least_ballast`]).
//!
//! # 7. Ballast and fillings
//! A stock part of mass m at x adds (m/ρ) φ(x) to the moments of the print, φ = (1, x, y, z, …).
//! Its pocket is subtracted from them. With the parts in place this is one more known constant. The
//! interior around them is solved for with the same certificate. The places are found by descent.
//! To first order a part changes the value by g·(part − pocket). So the quadric g of the current
//! answer, or of the proof that there is none, shows where the next part acts most
//! ([`crate::ballast`]). Other places may do better. That less steel cannot do is proved by the
//! bound of [`crate::hollow::least_ballast`].
//!
//! A filling of density ρ_f in the voids gives s = s_fixed − (1 − ρ_f/ρ) ∫ β m. K is scaled by that
//! factor, and reflected if the filling is the heavier material. Nothing else changes
//! ([`crate::hollow::Fill`]).
//!
//! # 8. Densities
//! The interior may have a relative density d between a lower and an upper bound, as infill does.
//! The moments s = ∫ d m dV are linear in d, so the reachable set is again convex. With β = (high −
//! d)/(high − low) it is that of hollowing, scaled by high − low. Three things follow.
//!
//! * **The best for a goal has two densities, across one quadric.** A density that varies smoothly
//!   is a restriction, and never does better ([`crate::hollow::best_densities`]).
//! * **The least change is a clamped quadric.** Let d be as near as can be to a wished d₀, in the
//!   mean square. It must meet A s(d) = b. Then d = clamp(d₀ − q, low, high), where the quadric is
//!   q = (Aᵀλ)·m. The dual in λ is concave and smooth, and its value is a bound
//!   ([`crate::hollow::least_change`]). If only the centre is prescribed, q is linear. Then a ramp
//!   is the best there is.
//! * **A few levels meet the rows exactly.** The cost is replaced by its chords between printable
//!   densities. Then the best are nested level sets of one quadric. Nothing is rounded, and it
//!   costs at most an eighth of the square of a step more ([`crate::hollow::least_level_change`]).
//! * **Cuts keep a share of the best.** With the height of the centre fixed, bounds of speeds and
//!   ratios are convex in the moments. Rows that touch them are added where the last answer broke
//!   them, until none is broken.
//!
//! The fields of a paper have four numbers each. A ramp has its slope and place. A wave of the
//! distance to a point has its centre and length. They are fitted to A s = b by Levenberg's and
//! Marquardt's method from sixty starts, with ∂s/∂θ = ∫ ∂d/∂θ m dV. If only the centre is
//! prescribed, the best ramp is the least change itself. Where the axis is prescribed too, four
//! equations meet four numbers, so that a field is a chance ([`crate::hollow::fit_smooth`]). What
//! is printed are nested regions, between planes for a ramp and in balls for a wave. So the last
//! fit is of the moments of these regions ([`crate::hollow::PrintField`]).
//!
//! Any other given field f is printed between its own level sets. The printable densities are l₁ <
//! … < l_N, and region i is { f < (lᵢ + lᵢ₊₁)/2 }. So the regions are nested whatever f is, and
//! each place has the density nearest to it. Those of a skin are offsets of the surface. The
//! others are marched, with bounds of f over boxes to tell where there is no surface. They do not
//! depend on the goal, so they are drawn before the solve ([`crate::hollow::DrawnField`]).
//!
//! A match prescribes all ten moments. Two densities across one quadric reach only the rim of the
//! set of moments. Three levels and more reach its inside, if the mean of what is wanted is one of
//! them. A body of nearly uniform density between two levels would need a mixture of both. What
//! lies outside has a nearest point on the rim, and its distance is proved
//! ([`crate::hollow::match_moments`]).
//!
//! Whether bounds are enough is known before any solve. Put F = A s − b at the upper density
//! everywhere. Some density does it if and only if (high − low) ∫(u·A m)₊ ≥ u·F for every u.
//! The greatest u·F over the integral is the least span, and that u is the proof
//! ([`crate::hollow::greatest_low`]).
//!
//! Masses of fields are exact. The signed cones from any point over the triangles of the surface
//! add up to the solid. So any density is integrated over it without a tetrahedral mesh
//! ([`crate::mass::Cones`]). A linear density has a closed form in each cone (Bukenberger and
//! Lensch, eq. 1 and 2, and ours for the second moments). Cones are split at planes where a density
//! has kinks. A wave of the distance to a point, and level sets of a quadric, are integrated along
//! rays in closed form. What is left is quadrature, and its error is told ([`crate::field`]).
//!
//! Two materials print any density between theirs, a pixel at a time. The share of the heavier one
//! is s = (d − ρ₂/ρ₁)/(1 − ρ₂/ρ₁). Error diffusion hands what each pixel lacks on to its
//! neighbours, so sums over a region are right within about a pixel. Pixels that the surface cuts
//! are whole or none, and that is the greater error. The share gets the quadratic of least squares
//! that makes it up, and single pixels make up the rest ([`crate::slice`]).
//!
//! Real infill has a boundary. A prism of width a weighs u = w + b a + c r a² over its height and
//! the density of solid print. Here r is the density of its core, c a² its area, and b holds walls
//! and the ends of lines. Two widths give r ([`crate::coupon::DensitySet::core_ratios`]).
//!
//! A volume mesh with densities at its corners is exact too, for the density that is linear in each
//! tetrahedron ([`crate::tets`]). That density is not the one that was sampled: between corners it
//! misses the curvature, and steps are smeared. Once all tetrahedra have positive volume, the
//! winding number of their surface counts how many hold a point. So a mesh fills space once if that
//! surface does not cross itself and no shell of it lies inside another's filling. The sum of the
//! volumes says nothing of this: it always equals what the surface encloses.
//!
//! # 9. Bosses
//! If walls leave no room for pins, material around the pins is taken out of Ω and the same problem
//! is solved again. The certificate then holds for the rest of Ω. Filling a set B of the void
//! changes the value by ∫_B g·m to first order. This price compares the places
//! ([`crate::cut::bosses()`]). A lip around a thin ring would register it as well. But it takes two
//! walls and a gap all around, more than the ring has, and it does not fix the turn about the axis.
//! Even with keys all around it leaves a step of c·R/r or more. Here c is the gap, r the lip's
//! radius and R the joint's. A boss needs its room in two places only, or in three if the joint is
//! round.
//!
//! # 10. From the solution to the print
//! The print is a triangle mesh with pins, sockets and clearances, not the solver's columns. Its
//! difference is measured exactly, δ = s(mesh) − s(columns). The problem is solved again with δ
//! added to the material that stays. This δ hardly depends on g, so a few rounds bring the written
//! parts to the constraints ([`crate::prepare`]).
