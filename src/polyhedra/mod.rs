//! Convex polyhedra inside a model: the base of an object that is larger than the printer.
//!
//! A polyhedron P = { x : nᵢ·x ≤ hᵢ } is the intersection of half-spaces. It must keep a distance
//! d from the surface of the model. It does if every triangle of the surface is *parted* from it
//! by one of its faces. Then all corners of the triangle lie at least d above that face. One face
//! a triangle is the whole certificate ([`Separation`]), checked in linear time.
//!
//! * **One polyhedron:** [`grow_polyhedron`] grows it in a [`Ground`] as a [`Request`] says. Each
//!   face in turn is a linear programme in three unknowns: two tilts and a shift. The shift of the
//!   face's centroid times its area is the first variation of the volume. Every step keeps the
//!   certificate, and only steps that raise the volume are taken. Faces that cost least are
//!   dropped until few are left.
//! * **Limits:** [`Limits`] of the sheet and the joints. Rows of the same programmes keep the turns
//!   between neighbours; short edges, narrow faces and large faces have a price that rises. What
//!   cannot be kept is named by a [`Breach`].
//! * **Several:** [`grow_polyhedra`] parts the model by planes and grows a polyhedron on each side,
//!   with a face locked on the plane. [`Connection`]s join them: bolts where the faces bear on
//!   each other, or rods where the model is too thin for that between them.
//!
//! * **By hand:** a [`BasePlan`] is written as a file of planes and read back, proved anew.
//!
//! * **Cross-check:** [`vertices`] is the paper's own method, which moves vertices.
//!
//! The volume is a local optimum, the best of several starts. Limbs that no polyhedron reaches are
//! left to the shell. All lengths are in mm, angles in radians.

mod base_file;
mod base_plan;
mod branch;
mod connection;
mod convex;
mod dealing;
mod disc;
mod dropping;
mod ground;
mod growth;
mod inscribe;
mod limits;
mod mending;
mod neck;
mod obstacles;
mod plan;
mod polyhedron;
mod programme;
mod search;
mod separation;
mod side;
mod starts;
mod unjoined;
pub mod vertices;

pub use base_file::BaseFileError;
pub use base_plan::{BasePlan, Child, Split};
pub use connection::{Connection, ConnectorRequest, Joint, RodRoom};
pub(crate) use convex::Convex;
pub use convex::Edge;
pub use ground::Ground;
pub use inscribe::{
    FACES, LEAST_FACES, MOST_FACES, NoRoom, Request, RequestError, grow_polyhedron,
};
pub use limits::{Breach, LimitKind, Limits};
pub use obstacles::Obstacles;
pub use plan::{Count, Several, grow_polyhedra};
pub use polyhedron::{Face, NotInside, Polyhedron};
pub use separation::{ROUNDING_MM, Separation, SeparationError};
pub use side::Side;
pub use unjoined::{NoPlan, Unjoined};
