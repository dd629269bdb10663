//! Objects larger than the printer: why the base is inside, why panels fit, and why all comes
//! apart.
//!
//! The idea of a laser-cut base below printed parts is that of CofiFab
//! ([`super::bibliography`], \[CofiFab\]). Its authors move the vertices of a polyhedron and
//! sample its surface. Here planes move and nothing is sampled. Cells, joints and certificates
//! below are this program's.
//!
//! # 1. The base is inside, with proof
//! The base is P = {x : n_i·x ≤ h_i}. A triangle of the model is *parted* by face i if n_i·v −
//! h_i ≥ d at its three corners v. Let every triangle be parted by some face, and let one point
//! of P be in the model. Then P is inside, and nowhere nearer than d to the surface. A segment
//! in P from that point never meets the surface, which lies outside of P. The proof is one
//! index a triangle. The kit holds it, and the judge looks at every triangle again
//! ([`crate::polyhedra::Separation`]).
//!
//! A model that is only just too thin gets no base: a plane must part each triangle whole. Long
//! triangles are cut at the middles of their edges first, which changes no surface.
//!
//! # 2. The base is large
//! Each triangle goes to the face that parts it best. Then every face alone is a linear
//! programme in three unknowns: two tilts of its normal and its offset. The volume grows to
//! first order by the face's area times its shift, so that is what the programme makes largest.
//! Every step keeps the proof. Limits of the joints are further rows. The result is a local
//! optimum: the share of the model that it fills is told, and no bound is claimed.
//!
//! # 3. Panels do not meet
//! A laser cuts square edges. The outline of a panel is the face of P moved inward by the
//! thickness s on *all* sides, laid back on the face's plane. Let p be in panel i, below its
//! plane by t < s. Move all planes inward by s. Then p is above plane i by s − t, and above
//! every other plane by less, as n_i·n_j < 1. So p is in no other panel. Neighbours touch in
//! one line on the bisector, s·cot(φ/2) from the edge.
//!
//! # 4. Fingers at any angle
//! Two panels of thickness s meet at the inner angle φ. Distances are from the edge on the
//! outer side. A finger ends at max(0, s·cot φ), its gap at s (1 + max(0, cos φ))/sin φ. Both
//! are s/sin φ long ([`crate::panels::FingerJoint`]). All sides of fingers are square to the
//! edge and to the sheet. So a panel leaves along its own normal at every φ, and cannot slide
//! along the edge.
//!
//! Near a corner a finger could reach through the plane of the next face, and two gaps could
//! meet. So the ends of every edge stay plain. The inner side of a finger then lies below all
//! other planes by s. Half a thickness is left from a gap to the corner's bisector.
//!
//! # 5. Everything comes apart
//! The cell of face i is {x : n_i·x − h_i ≥ n_j·x − h_j for all j}. Add n_i to a point of it:
//! the left side grows by 1, and the right side by n_j·n_i ≤ 1. So the cell moved along n_i
//! stays within itself. A part in it leaves that way without touching a part of another cell
//! ([`crate::cladding::cells`]). Panel i leaves that way too, by section 4. So a panel with its
//! parts is a *unit* that leaves as a whole, and any unit can be the last one. Cuts for the
//! printer's room are parallel to n_i, which keeps all of it. A piece that bears on no panel is
//! glued to a part that does. Where that part is of another cell, the order is found by
//! looking.
//!
//! Pieces that bear on no panel may hook into others, so that none leaves first. Then the answer
//! names a circle of parts, each with the next one in its way. Planes beside and between two of
//! them are tried, along the way and across it. A plane counts if it frees a piece that leaves
//! first, and if all units then find an order past each other. The one with the least section is
//! told ([`crate::cladding::FreeingCut`]).
//!
//! Pins need a way along themselves. Cuts of one part form a tree: each parts what the ones before
//! it left in two. So its pieces come together in the reverse order, each time square to one
//! plane, and pins may stand in all of these planes. That is done on the bench, before the panel
//! is screwed on. A limb in cell i on a part of cell j touches it in the bisector. Its pins stand
//! square to that, and n_i does not. So it gets pins only if it also leaves along n_i − n_j past
//! all that still stands, which is found by looking. On that way it never meets the base, as
//! n_i·(n_i − n_j) ≥ 0 ([`crate::cladding::PartPins`]).
//!
//! # 6. Several polyhedra
//! A plane parts the model, and each side grows a polyhedron with one face locked beside the
//! plane. Where two such faces overlap in a wide disc, their panels bear on each other and are
//! bolted through. Cells end at the plane. So all of one side lies below it, and all of the
//! other above it. Two sides that are put together come together along the plane's normal, and
//! nothing bars them.
//!
//! A unit alone may not be so free. Near a waist the normals of both sides lean over the plane:
//! each side's units would run into the other's. So every polyhedron is put together before it
//! meets the others, and only what closes it comes afterwards
//! ([`crate::cladding::Sides`]). That is a side whose way no other polyhedron bars, found by
//! looking at all triangles. If there is none, the answer names the faces that bar.
//!
//! Grown by the gap g, a polyhedron would reach over the plane. Its locked face lies half the
//! bearing gap below, which is less than g. So on its own side it ends at the plane, no part is
//! missing there, and volumes still add up to the model's.
//!
//! **Rods.** At a neck the disc may be too small. Then the planes that lock a face move off it,
//! along the plane's normal N through the neck's deepest point. They go as far as a face needs for
//! its room on either side. Two rods along N join them. Each starts in a face whose normal is N
//! (or −N). The cell of that face is closed under translation by N, so the rod stays in it up to
//! the plane. It passes no parts but those of its two panels, and no unit that leaves its own cell
//! meets it. Polyhedra come together along N, so they slide on the rods and no order becomes a
//! circle. A rod keeps the wall about its bore to the surface, measured from its axis to all
//! triangles. A single rod would be an axle: `verify` refuses it ([`crate::cladding::rods()`]).
//!
//! # 7. Ballast
//! Take an edge of the support with inward normal n and offset d, and the slope t = tan θ. A mass M
//! with its centre at c leans by θ over that edge if M (n·c − d − t c_z) ≥ 0. The left side is
//! linear in the mass, so that a piece adds its own term. It helps if its own place satisfies the
//! condition, which low places well inside do. Pieces are laid one by one where the object then
//! leans the farthest. That is a greedy choice, and no bound is claimed.
//!
//! # 8. What is not proved
//! The base does not lock by its shape: glue, screws and brackets hold it. A wall is kept, but
//! how much it carries is not worked out. How wide the beam cuts is a figure of the profile,
//! until the shop cuts its coupon.
//!
//! # 9. How much it fills
//! Shares of the model's volume, at 600 mm and 5 mm below the surface, as `examples/core_table`
//! prints them. The reference is a prototype's. Without limits 0.98 of it is asked. The limits are
//! those of a sheet of 5 mm on a bed of 900 × 600. With them 0.85 is asked, or the name of the one
//! that binds. All rows reach it, and none breaks a limit.
//!
//! Seconds are processor time of all threads, of the development build on a busy machine. Those of
//! the first table are the sum of both searches of a row.
//!
//! | model | reference | no limits | of it | with limits | of it | broken limits | s, both |
//! | --- | --- | --- | --- | --- | --- | --- | --- |
//! | bunny | 0.473 | 0.487 | 1.03 | 0.478 | 1.01 | none | 7.7 |
//! | homer | 0.293 | 0.310 | 1.06 | 0.272 | 0.93 | none | 7.3 |
//! | humpty | 0.406 | 0.425 | 1.05 | 0.425 | 1.05 | none | 10.7 |
//! | elephant | 0.229 | 0.242 | 1.06 | 0.237 | 1.04 | none | 5.7 |
//! | fertility | 0.175 | 0.178 | 1.02 | 0.150 | 0.86 | none | 7.6 |
//! | cheburashka | 0.197 | 0.257 | 1.30 | 0.257 | 1.30 | none | 7.5 |
//!
//! | two polyhedra | asked | found | common disc, mm | s |
//! | --- | --- | --- | --- | --- |
//! | bunny | 0.55 | 0.564 | 83 | 28.6 |
//! | homer | 0.37 | 0.393 | 39 | 21.4 |
//!
//! # 10. Planes and vertices
//! The same models by the method of the paper ([`crate::polyhedra::vertices`]): first by its
//! samples. Then its faces moved inward until every piece of the surface was parted, since only
//! that can be a base. Planes have at most 12 faces, the cube has 6, the dodecahedron 12, the
//! icosahedron 20.
//!
//! | model | method | sampled | faces prove, mm | moved, mm | proved | s |
//! | --- | --- | --- | --- | --- | --- | --- |
//! | bunny | cube | 0.301 | -1.0 | 6.0 | 0.286 | 2.8 |
//! | bunny | dodecahedron | 0.503 | -3.6 | 10.0 | 0.460 | 3.3 |
//! | bunny | icosahedron | 0.515 | -5.3 | 14.0 | 0.468 | 0.8 |
//! | bunny | planes |  | 5.0 | 0 | 0.487 | 3.3 |
//! | homer | cube | 0.034 | -3.8 | 12.3 | 0.015 | 2.3 |
//! | homer | dodecahedron | 0.037 | 2.7 | 2.3 | 0.035 | 3.0 |
//! | homer | icosahedron | 0.230 | -0.2 | 5.2 | 0.225 | 0.6 |
//! | homer | planes |  | 5.0 | 0 | 0.310 | 2.2 |
//! | humpty | cube | 0.287 | -0.5 | 8.6 | 0.250 | 3.9 |
//! | humpty | dodecahedron | 0.054 | 1.4 | 3.6 | 0.052 | 4.0 |
//! | humpty | icosahedron | 0.080 | 3.6 | 1.4 | 0.079 | 1.5 |
//! | humpty | planes |  | 5.0 | 0 | 0.425 | 4.8 |
//! | elephant | cube | 0.213 | -1.0 | 6.0 | 0.176 | 2.0 |
//! | elephant | dodecahedron | 0.048 | -1.0 | 8.7 | 0.040 | 2.5 |
//! | elephant | icosahedron | 0.258 | 1.3 | 3.9 | 0.252 | 0.7 |
//! | elephant | planes |  | 5.0 | 0 | 0.242 | 2.5 |
//! | fertility | cube | no room |  |  |  | 0.9 |
//! | fertility | dodecahedron | 0.116 | 1.2 | 3.8 | 0.108 | 2.7 |
//! | fertility | icosahedron | 0.172 | -0.5 | 5.7 | 0.158 | 0.6 |
//! | fertility | planes |  | 5.0 | 0 | 0.178 | 2.0 |
//! | cheburashka | cube | 0.142 | -3.7 | 8.7 | 0.123 | 2.0 |
//! | cheburashka | dodecahedron | 0.106 | -0.3 | 5.3 | 0.094 | 4.1 |
//! | cheburashka | icosahedron | 0.133 | 2.4 | 2.6 | 0.129 | 1.2 |
//! | cheburashka | planes |  | 5.0 | 0 | 0.257 | 3.3 |
//!
//! Samples alone reach more than planes in the bunny and the elephant, but none of that is a base.
//! The faces prove at most 3.6 of 5 mm, and in 11 of 17 rows they cut the model. Proved, planes
//! fill more in five of six models. The elephant's icosahedron is proved at 0.252, planes at 0.242.
//!
//! Two polyhedra by that method move together, so that a face of each meets one of the other
//! ([`crate::polyhedra::vertices::grow_pair_by_vertices`]). They do so in one of four rows. There
//! the bunny's two cubes share a disc of 67 mm. Their normals are opposed to 0.01°, and their
//! centres lie 0.25 mm beside each other. In the others the centres stay 33 to 101 mm beside each
//! other. Only library and tests have it. Two polyhedra by planes fill 0.564 and 0.393.
//!
//! | model | start | sampled | proved | s |
//! | --- | --- | --- | --- | --- |
//! | bunny | cube | 0.377 | 0.310 | 20.9 |
//! | bunny | dodecahedron | 0.255 | 0.251 | 14.4 |
//! | homer | cube | 0.010 | 0.003 | 15.2 |
//! | homer | dodecahedron | 0.086 | 0.080 | 21.1 |
//! The descent often stalls where a vertex meets the surface.
