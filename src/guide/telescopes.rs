//! Telescopes: why shells slide, stop and hold, and what of that is proved.
//!
//! # 1. Why shells are helices
//! A rigid shell that touches its rigid parent all around can move by one constant twist only. Its
//! wall is then swept along a helix ([`crate::curve::Helix`]). Frames along a helix compose, H(a)
//! H(b) = H(a + b). So a tube slides in a cavity about its own helix with one gap, at every slide.
//! That identity is the proof that a joint does not jam. (Yu, Crane and Coros, "Computational
//! Design of Telescoping Structures", ACM TOG 36(4), 2017.)
//!
//! # 2. From a curve to a chain
//! A chain of helices of one length is fitted to the curve by positions, from many starts
//! ([`crate::curve::fit()`]). Unlike neighbours cost wall, about hypot(|Δκ| l²/2, κ |Δτ| l³/6), and
//! pay for it in the fit. A turn about the tangent parts the centre lines at the ends of an overlap
//! o, by e = κ (o/2)² sin(|θ|/2). It is bound by the clearance, less what a seat needs.
//!
//! A torsion of their own brings shells nearer to a curve than turns between them. With many shells
//! that matters little. Below is the rms deviation, mm, as `examples/telescope_table` prints it
//! (Fig. 7 of the paper). Curvature is at most 0.04/mm, in the trefoil 0.75/14. Starts differ, so
//! more shells are not always nearer.
//!
//! | curve | shells | own torsion | turns alone | one curvature, turns alone |
//! |---|---|---|---|---|
//! | Viviani, 300 mm | 4 | 2.09 | 2.16 | 2.30 |
//! | | 8 | 1.02 | 0.98 | 1.87 |
//! | | 12 | 0.44 | 0.43 | 1.10 |
//! | sine, 300 mm | 4 | 2.03 | 2.03 | 2.04 |
//! | | 8 | 1.76 | 1.79 | 2.02 |
//! | | 12 | 0.84 | 0.84 | 0.94 |
//! | trefoil, 900 mm | 4 | 25.10 | 27.74 | 27.76 |
//! | | 6 | 10.26 | 19.23 | 24.82 |
//! | | 8 | 14.09 | 18.58 | 24.48 |
//! | | 12 | 6.30 | 6.35 | 13.16 |
//!
//! # 3. The joint
//! Flange and lip end in cones of 45°, so an error of a radius moves the stop by as much. A turned
//! flange is out of the middle by e, and the stop leaves room for that. A rib on the bore passes a
//! gap in the flange, and bounds the turn. A ring closes the clearance over the last millimetres.
//! It holds the shell. A glued cap with a key and a vent closes every shell from behind.
//!
//! # 4. The opening
//! Bodies are unions of discs across a centre line. A curve of curvature at most K has a reach of
//! 1/K over an arc of less than π/K ([`crate::telescope::Gap`]). So discs thinner than that cannot
//! meet there. All other pairs are measured: by balls along chords, and by planes
//! across their ends. From each state the next is so near that no point moves by more than half of
//! the least gap. No more than 8 mm come out. So no collision lies between two states.
//!
//! # 5. Balance
//! Mass is constant along the opening, the centre is not. A foot is chosen so that the
//! telescope stands at every state. All play is taken up: every joint tilts by 2 g/o of its
//! seat, the same way, and moves the centre by the sum. Of the orders that are free, the one
//! that stands on the least foot is taken, unless one was ordered. Where no foot holds it, the
//! answer tells the least ballast in the middle of the foot that would. If it is ordered, the
//! lightest stack of steel discs is taken that does. It counts as light as its stock allows,
//! and lies in a pocket under the foot.
//!
//! # 6. Figures
//! A figure is a tree of junctures and limbs ([`crate::telescope::Network`]). Each limb is a
//! telescope of its own, and everything above holds for it. Its root is glued into a socket: a flat
//! on its cap and in the socket keeps it one way. A groove beside it lets the air of the vent out.
//! The last mouth holds the next juncture by a peg, whose slot fits a key in the bore. Roots begin
//! as deep in their juncture as its balls and the other roots leave room. If none is left they are
//! pushed outwards along their limbs, up to 40 %, and a collar holds them. A limb without such a
//! place stays solid, and the search begins again without it.
//!
//! The limbs open one after the other. Shells of one limb are proved free as above. Every body that
//! a move carries is held against every other one. Two states are so near that no point goes
//! farther than the gap that all pairs keep. So no collision lies between them. The first sequence
//! that is free is taken, from the root on. What is behind a root's mouth needs no look.
//!
//! Junctures of a model are its own pieces. A plane across a branch cuts only the ring around that
//! branch ([`crate::mesh::SectionRing`]). So a heel that hangs back across the plane stays with its
//! foot. Between the mouth of its root and its last mouth a limb replaces the model, and all else
//! stays. A root is as thick as the wall around its bore allows. A section that reaches farther
//! than three radii of its ball belongs to more than the branch. The root is then pushed outwards,
//! or the limb stays solid. The judge finds every triangle of a piece on the model, in a cut or in
//! a bore. Of the model it finds nothing lost but the bands that limbs replace.
//!
//! A juncture larger than the printer's room is cut by the planner of [`crate::cut`]. Sockets,
//! their rims and pegs are convex regions that no plane enters ([`crate::cut::KeepWhole`]), each
//! with a wall around it. Planes are tried in 33 directions and 33 places, and rated by the boxes
//! of their halves. Next comes what is seen of the seam. The best are cut, until all parts fit.
//! The parts are one body in the motion. The judge finds their faces in each other's, pins in
//! their sockets with the gap, and no point in two parts. Their volumes add up to the uncut
//! juncture, but for the joints. No part shares the socket or the peg of a limb with another.
//!
//! A figure that is to stand gets a foot under its first juncture, which stands still. Its disc
//! lies about the juncture's lowest point. The least radius is taken on which the figure comes
//! back at every state from the promised lean, with all play taken up. A figure of which a part
//! comes below that foot is refused. So are pieces of a model: they get no foot.
//!
//! # 7. The motion on a screen
//! Between two keys, slides and turns go evenly ([`crate::telescope::JointState`]). The page moves
//! a shell by the screw of its helix (Chasles), so it shows the true path. In `motion.glb` every
//! shell is a node on the one before it. That format goes straight between its keys. A chord of
//! length c leaves a path of curvature κ by κ c²/8. Keys are so near that this is 2 µm at most. The
//! judge holds the file against its own screws: at the keys, and at three states between two.
//!
//! # 8. Poses
//! A joint has one way: its shell slides out, then it turns. So it has one unknown, the way it has
//! gone, and its range has two ends and a corner. The velocity of a tip is that of a screw. It is
//! that of the inner helix while it slides, and about the tangent at the pivot while it turns.
//! Damped least squares within these bounds start from 48 states, all out first
//! ([`crate::telescope::Network::reach`]). Of 20 places that eight shells of 40 mm reach, all are
//! met to 1e-6 mm (`telescope/tests/pose.rs`).
//!
//! A search that ends far off is no proof. But no arc is longer than what its shell shows. So a
//! place beyond the sum of all is proved too far ([`crate::telescope::Network::too_far`]). The way
//! there goes joint after joint from all in, and is swept as in section 4.
//!
//! # 9. In place
//! Shells of one curvature and one torsion can be printed in each other
//! ([`crate::telescope::Tails`]). All in, their helices are one, and all tails lie in one
//! plane. A ring closes every bore behind. It leaves the lip's radius b + g open, and its inner
//! side is a cone of 45°. The flange of the shell in it begins with a cone of 45° too, at b + g
//! − c − √2 g for a chamfer c. So the two are apart by g square to the cones. In a bend of
//! curvature κ a cone on the inside is steeper, and √2 becomes √(1 + q²)/q with q = 1 − κ B.
//! The ring holds the flange by the engagement, and both cones print without support. The last
//! shell is closed by a disc. Two holes through every shell that holds another let powder out.
//!
//! Filament hangs over by no more than the profile allows, so shells may bend by no more than
//! that. Powder may bend up to 90°, for the mouth must stay above the plane of the tails. Resin
//! and jetted support would stay in the gaps. A slicer shows in all layers as many islands as
//! there are shells (`tests/telescopes/in_place.rs`, PrusaSlicer).
//!
//! # 10. Limits
//! Three theorems refuse curves ([`crate::telescope::Limit`]). Walls may not fit into the root,
//! strands may be nearer than the tubes are thick, arcs too long for the ball that holds them. A
//! poor deviation alone is no proof, and is told as the best that was found.
