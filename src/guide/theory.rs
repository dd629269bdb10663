//! Why the optimal void is one quadric, and how the solver finds and certifies it.
//!
//! # The reachable set
//! Let m(x) = (1, x, y, z, xy, yz, xz, x², y², z²) in the goal frame and s = ρ ∫ m dV over the
//! material. Mass, centre and inertia tensor are functions of these ten numbers alone (Spin-It, eq.
//! 4). The wall stays; a region Ω may be emptied, by any fraction β(x) in [0, 1] of its material.
//! The set K of all reachable s is convex and compact, and by Lyapunov's theorem every point of it
//! is reached by a void with a sharp boundary, β in {0, 1}.
//!
//! For a direction g the least g·s over K empties exactly { x in Ω : g·m(x) > 0 }: the inside of
//! one quadric. So whatever the goal, the optimal void is Ω cut by a single quadric and the unknown
//! of the whole problem is g in R¹⁰, whatever the resolution. There are no per-voxel variables and
//! there is no rounding step. That each vertical ray carries at most two changes (Wu, Kramer and
//! Westermann's completeness proof) is a corollary: a quadratic has at most two roots on a line.
//!
//! # Goals
//! Every goal minimises a quasi-convex function over K under linear equations ([`crate::goal`] has
//! them one by one): a convex function divided by a positive linear one. Dinkelbach's method turns
//! the quotient into a few convex problems N(s) − τ e·s, and each of these is solved in its dual,
//! whose unknowns are a point y of a small convex set (a ball, a disc, a simplex) and one
//! multiplier per equation: at most ten numbers. The dual is concave with gradient (J s(g), A s(g))
//! and Hessian −[J; A] W [J; A]ᵀ where W = ρ Σ m mᵀ/|∂q/∂z| over the quadric's crossings, so
//! Newton's method applies. [`crate::hollow`] has the method.
//!
//! A top is quasi-convex only at a fixed height ℓ of its centre; the search over the one number ℓ
//! uses the multiplier of the row s_z − ℓ s₁ = 0 as derivative (envelope theorem).
//!
//! What floats has its mass, and the place of its centre seen from above, as equations, and the
//! height of the centre as a linear function to make least; the metacentre c_b + I_w/V_b depends on
//! the outside alone, so the lowest centre is the most stable. A free waterline is one more number
//! to search ([`crate::prepare`]).
//!
//! A rotor's axis is free when s_x = s_y = s_xz = s_yz = 0, and the least material is removed by a
//! linear programme. Where the equations cannot be met, the unbalances U_A, U_B in two planes are
//! linear in s, and ‖(U_A, U_B)‖/s₁ is again a norm over a positive linear function, whose bound
//! limits the grade from below.
//!
//! # Hardware
//! What is not printed adds constant moments, and its sockets are outside like any other surface
//! ([`crate::hardware`]). A yo-yo's halves are moved apart before anything is solved; what is
//! optimal is then one quadric q where the halves are, and in the model two, q(x, y, z + gap/2) > 0
//! for the upper half and q(x, y, z − gap/2) > 0 for the lower, with the same multipliers. Values,
//! bounds and proofs speak of hollowings of those halves, each with its wall towards the gap.
//!
//! # A few columns know where to ask
//! For any symmetric T the image TK + b of a convex set is convex, with extreme points T s(Tg) + b
//! and derivatives T W(Tg) T. So the set K' of a sixteenth of the columns can be made to touch K at
//! the extreme point of a given g with the same curvature: T is then the map of optimal transport
//! between two Gaussians of covariance W' and W. The search, and the choice of multipliers for the
//! proof over all heights, go on in that set; all columns are asked at the g it ends at. Bounds
//! hold at any multipliers, so nothing that is claimed rests on the few.
//!
//! # The certificate
//! Any dual point gives a lower bound: no hollowing of this model with this wall can do better. The
//! value, the bound and their gap are part of every solution. Where the dual grows without limit,
//! its direction is a quadric that separates the goal from everything reachable: a proof that no
//! hollowing meets the goal.
//!
//! # When it is impossible
//! Three facts make it cheap to say what would help ([`crate::advice`]). Only the wall over the
//! size counts, and a thinner wall only adds to Ω, so possible and impossible sizes are parted by
//! one number. The proof of impossibility is the integral of a quadric, and by the envelope theorem
//! its slope, as contact or axis move, is that of the same moments seen from a moved frame; so the
//! way to the nearest possible place is known without solving. And with a denser material at hand
//! the reachable set is still convex: a grain at x is emptied where g·m > 0 and replaced where g·m
//! is so far below zero that it is worth the price, two level sets of one quadric
//! ([`crate::hollow::least_ballast`]).
//!
//! # Ballast and fillings
//! A stock part of mass m at x adds (m/ρ) φ(x), φ = (1, x, y, z, …), to the moments of the print
//! and takes its pocket away from them; with the parts at their places this is one more known
//! constant, and the interior around them is solved for with the same certificate. The places are
//! found by descent: to first order a part changes the value by g·(part − pocket), so the quadric g
//! of the answer at hand, or of the proof that there is none, tells where the next part acts most
//! ([`crate::ballast`]). That other places may do better is not excluded; that less steel cannot do
//! is, by the bound of [`crate::hollow::least_ballast`].
//!
//! A filling of density ρ_f in the voids gives s = s_fixed − (1 − ρ_f/ρ) ∫ β m: K is stretched by
//! that factor, and turned over where the filling is the heavier material. Nothing else changes
//! ([`crate::hollow::Fill`]).
//!
//! # Bosses
//! Where walls leave no room for pins, material around them is taken out of Ω and the same problem
//! is solved again; the certificate is then for what is left of Ω. Filling a set B of the void
//! changes the value by ∫_B g·m to first order, so that is the price by which places are compared
//! ([`crate::cut::bosses()`]). A lip around a thin ring would register it as well, but takes two
//! walls and a gap all around, more than the ring has, and does not tell one turn from another; a
//! boss needs its room in two places only.
//!
//! # From the solution to the print
//! What is printed is a triangle mesh with pins, sockets and clearances, not the solver's columns.
//! It is measured exactly, δ = s(mesh) − s(columns), and the problem is solved again with δ added
//! to the material that stays. δ hardly depends on g, so a few rounds bring the written parts to
//! the constraints ([`crate::prepare`]).
