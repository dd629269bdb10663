//! Repair: the ladder from a mesh as it was read to one that can be proved solid.
//!
//! # The ladder
//!
//! [`repair`] climbs these rungs in order. None keeps a result that lacks its proof. Rungs 2 and 6
//! move vertices on rims that nearly meet, and rung 10 moves some along crossings. An edge is *bad*
//! unless exactly two triangles share it in opposite directions.
//!
//! 1. **Merge equal vertices** (`weld`). Also drops the triangles that lose a corner. *Cost:* one
//!    sort of the vertices. *Proof:* no vertex moves, and a second weld changes nothing.
//! 2. **Close seams** (`weld`), if an edge is open. Merges vertices on open edges within a
//!    millionth of the diagonal. *Cost:* linear, with a hash grid. *Proof:* kept only if no edge is
//!    open or crowded afterwards.
//! 3. **Drop duplicates** (`ladder`), if an edge is bad. Drops triangles that repeat another one.
//!    *Cost:* linear, with a hash set. *Proof:* kept only if fewer edges are bad afterwards.
//! 4. **Drop unused vertices** (`weld`). *Cost:* linear. *Proof:* no triangle changes.
//! 5. **Orient neighbours** (`orient`), if two disagree. Flips triangles, the smaller part of each
//!    shell. *Cost:* linear. *Proof:* only orientations change. A one-sided surface cannot agree
//!    and stays misoriented.
//! 6. **Stitch cracks** (`sew`), if an edge is open and at most 4000 are. Joins rims within 1e-5 of
//!    the diagonal, which is 0.01 mm on a model of a metre. *Cost:* quadratic in the open edges.
//!    *Proof:* kept only if fewer edges are open afterwards, no other edge is bad, and no vertex is
//!    farther from the new surface than that.
//! 7. **Fill holes** (`holes`), if all bad edges are open. Fills flat rims flat, others with
//!    the least folds. *Cost:* cubic in the corners of a rim, with a limit. *Proof:* no vertex
//!    moves, and no edge is bad afterwards. No shell grows by more than a quarter of its area, or
//!    nine tenths if all its rims are flat.
//! 8. **Separate touching surfaces** (`unstitch`), if an edge is bad or a vertex is pinched.
//!    Doubles their vertices. *Cost:* linear, plus a sort of the triangles at each crowded edge.
//!    *Proof:* no vertex moves, and the result is kept only if no edge is bad afterwards.
//! 9. **Face outward** (`orient`), if the mesh is closed. Flips whole shells. *Cost:* linear, plus
//!    a pass over the triangles for each pair of shells. *Proof:* exact predicates decide which
//!    shell encloses which.
//! 10. **Resolve self-intersections** (`untangle`), if a shell crosses itself. Keeps what bounds
//!     the space around which it winds at least once. *Cost:* n log n, and more only where it
//!     crosses, with a limit. *Proof:* kept only if the result is closed, does not cross itself,
//!     and has moved no more than the stitching of cracks may. What lay inside does not count.
//! 11. **Settle inner surfaces** (`inner`), only if ordered. Drops the shells inside others, or
//!     turns them to bound cavities. *Cost:* a pass over the triangles for each pair of shells.
//!     *Proof:* no vertex moves.
//! 12. **Unite overlapping shells** (`unite`), if closed shells cross and none lies inside
//!     another. *Cost:* a few booleans for each of at most 200 shells. *Proof:* kept only if the
//!     result is a solid that does not cross itself.
//!
//! At the top stands [`Solid::new`](crate::mesh::Solid::new), which proves the result or lists all
//! remaining [`Defects`](crate::mesh::Defects). A shell that still crosses itself stays as it is,
//! and [`one_body`] refuses it. What the ladder cannot mend, [`crate::mend`] draws anew on order.
//!
//! # Beside the ladder
//!
//! * [`RepairOrder`] is what a person orders beyond the rungs that everyone gets.
//! * [`one_body`] checks that a solid is a single body, as every kit requires.
//! * `sew` joins parts along their rims, within a tolerance that its caller judges.
//! * [`unfold()`] mends the slivers that the rounding of a written file would fold.

mod holes;
mod inner;
mod ladder;
mod one_body;
mod order;
mod orient;
mod report;
mod sew;
mod unfold;
mod unite;
mod unstitch;
mod untangle;
mod weld;

pub use inner::settle_inner;
pub use ladder::{repair, repair_with};
pub use one_body::{NotOneBody, ShellFact, ShellRole, one_body, one_body_with};
pub use order::{InnerSurfaces, Remesh, RepairOrder, RepairOrderError};
pub use report::{Redrawn, Repairs};
pub(crate) use sew::sew;
pub use unfold::unfold;
pub use weld::weld;
