//! The pieces of a model that its junctures keep: it is cut where the mouths of its limbs are.

use super::ends::mouths;
use super::skin::Skin;
use super::tree::Tree;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Frame, Plane, Point, Vector};
use crate::mesh::{TriMesh, bodies, move_off_vertices, winding_number};

/// Distance from a cut at which it is asked what lies on its sides, mm.
const ASIDE_MM: f64 = 0.01;

/// A limb at which the model does not come apart, from 0, and why.
pub type NoPieces = (usize, String);

/// Returns the piece of every juncture; the error names the limb that is in the way.
///
/// Between the mouth of its root and its last mouth a limb replaces the model. Everything else
/// stays with the juncture that it hangs on.
pub fn pieces(
    tree: &Tree,
    skin: &Skin,
    watch: &Watch,
) -> Result<Result<Vec<TriMesh>, NoPieces>, Cancelled> {
    let mut mesh = skin.mesh().clone();
    for (limb, own) in tree.network.limbs.iter().enumerate() {
        for mouth in mouths(&own.telescope) {
            watch.check()?;
            let along: Vector = mouth.axes.column(0).into();
            let plane = move_off_vertices(&mesh, &Plane::through(&mouth.origin, &along));
            let Some(ring) = skin.ring_in(&mesh, &plane, &mouth.origin) else {
                let why = "the model cannot be cut there across this branch alone";
                return Ok(Err((limb, why.to_owned())));
            };
            mesh = mesh.cut_along(&ring);
        }
    }
    let parts = Parts {
        bodies: bodies(&mesh),
    };
    Ok(parts.of_junctures(tree))
}

/// The bodies of the model that was cut.
struct Parts {
    bodies: Vec<TriMesh>,
}

impl Parts {
    /// Returns the body of every juncture.
    fn of_junctures(self, tree: &Tree) -> Result<Vec<TriMesh>, NoPieces> {
        let mut owned: Vec<Option<usize>> = vec![None; tree.network.junctures];
        let mut bands = Vec::new();
        for (limb, own) in tree.network.limbs.iter().enumerate() {
            let refused = || {
                (
                    limb,
                    "the model does not come apart at this limb".to_owned(),
                )
            };
            let [root, last] = mouths(&own.telescope);
            let sides = [(&root, -1.0), (&root, 1.0), (&last, -1.0), (&last, 1.0)];
            let found = sides.map(|(mouth, side)| self.holding(&beside(mouth, side)));
            let [Some(from), Some(band), Some(behind), Some(to)] = found else {
                return Err(refused());
            };
            let is_new =
                |juncture: usize, body: usize| owned[juncture].is_none_or(|known| known == body);
            let is_apart = band == behind && from != band && to != band && from != to;
            if !(is_apart && is_new(own.from, from) && is_new(own.to, to)) {
                return Err(refused());
            }
            owned[own.from] = Some(from);
            owned[own.to] = Some(to);
            bands.push((limb, band));
        }
        let twice = |body: usize| owned.iter().flatten().filter(|own| **own == body).count() > 1;
        let is_shared = |(_, band): &&(usize, usize)| owned.contains(&Some(*band));
        let shared = bands.iter().find(is_shared).map(|(limb, _)| *limb);
        let doubled = tree.network.limbs.iter().position(|limb| {
            [limb.from, limb.to]
                .into_iter()
                .any(|juncture| owned[juncture].is_some_and(twice))
        });
        if let Some(limb) = shared.or(doubled) {
            let why = "the model hangs together around this limb";
            return Err((limb, why.to_owned()));
        }
        let pieces = owned.into_iter().flatten();
        Ok(pieces.map(|body| self.bodies[body].clone()).collect())
    }

    /// Returns the body that a point lies in.
    fn holding(&self, p: &Point) -> Option<usize> {
        let holds = |body: &TriMesh| winding_number(body, p) > 0.5;
        self.bodies.iter().position(holds)
    }
}

/// Returns the point beside the middle of a mouth; `side` is one ahead of it.
fn beside(mouth: &Frame, side: f64) -> Point {
    let along: Vector = mouth.axes.column(0).into();
    mouth.origin + along * (side * ASIDE_MM)
}
