//! Mass and balance of a telescope along its motion.

use super::error::TelescopeError;
use super::motion::{Opening, between};
use super::nest::{JointState, Telescope};
use super::tube::TubeMass;
use crate::geom::{Frame, Point, Vector};
use crate::mass::moments_of_mesh;

/// States of each move at which the balance is taken.
const STATES: usize = 20;

/// A round foot under the root: a disc about the root's axis, below its start. A root that is
/// printed in place has it around its tail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscFoot {
    /// The radius, mm.
    pub radius_mm: f64,
    /// The height, mm.
    pub height_mm: f64,
    /// The radius and the depth of a round pocket in the middle of its lower face, mm; `None`
    /// without ballast.
    pub pocket_mm: Option<[f64; 2]>,
}

/// The balance in a state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// The volume of all parts, mm³; the mass is this times the density.
    pub volume_mm3: f64,
    /// The centre of volume, mm.
    pub centre: Point,
    /// The angle by which the foot may lean before the telescope falls, rad: negative if it falls
    /// where it stands.
    pub toppling_rad: f64,
}

impl Telescope {
    /// Returns the volume and centre of every shell with its cap, in the shell's frame.
    ///
    /// Exact integrals over the meshes of [`Self::shell_solid`] and [`Self::cap_solid`], with lips,
    /// ribs and vents; in place, of [`Self::nested_solid`].
    pub fn weigh(&self) -> Result<Vec<TubeMass>, TelescopeError> {
        let weigh = |shell: usize| {
            let whole = match self.sizes.is_in_place() {
                true => moments_of_mesh(self.nested_solid(shell, None)?.mesh()),
                false => {
                    let tube = moments_of_mesh(self.shell_solid(shell)?.mesh());
                    tube + moments_of_mesh(self.cap_solid(shell)?.mesh())
                }
            };
            Ok(TubeMass {
                volume_mm3: whole.volume(),
                centre: Point::from(whole.first() / whole.volume()),
            })
        };
        (0..self.shells.len()).map(weigh).collect()
    }

    /// Returns the balance on a foot in a state. `shells` are the masses in the shells' frames.
    ///
    /// The foot stands on the plane below it, across the root's tangent. Its lean is about the edge
    /// nearest to the centre: atan((r − d) / h).
    pub fn balance(&self, shells: &[TubeMass], foot: &DiscFoot, states: &[JointState]) -> Balance {
        let frames = self.frames(states);
        let placed = shells.iter().zip(&frames);
        let placed = placed.map(|(mass, frame)| TubeMass {
            volume_mm3: mass.volume_mm3,
            centre: frame.to_model(&mass.centre),
        });
        let all: Vec<TubeMass> = placed.chain([foot.mass(&self.start)]).collect();
        let volume_mm3: f64 = all.iter().map(|mass| mass.volume_mm3).sum();
        let first: Vector = all
            .iter()
            .map(|mass| mass.centre.coords * mass.volume_mm3)
            .sum();
        let centre = Point::from(first / volume_mm3);
        Balance {
            volume_mm3,
            centre,
            toppling_rad: foot.toppling_rad(&self.start.to_local(&centre)),
        }
    }

    /// Returns the state of an opening in which the telescope topples first, of 20 in each move,
    /// with its balance.
    pub fn worst_balance(
        &self,
        shells: &[TubeMass],
        foot: &DiscFoot,
        opening: &Opening,
    ) -> (Vec<JointState>, Balance) {
        let states = opening.keys.windows(2).flat_map(|pair| {
            let state = |i| between(&pair[0], &pair[1], i as f64 / STATES as f64);
            (0..=STATES).map(state).collect::<Vec<_>>()
        });
        let closed = self.closed();
        let first = self.balance(shells, foot, &closed);
        states.fold((closed, first), |worst, state| {
            let balance = self.balance(shells, foot, &state);
            let is_worse = balance.toppling_rad < worst.1.toppling_rad;
            if is_worse { (state, balance) } else { worst }
        })
    }
}

impl DiscFoot {
    fn mass(&self, root: &Frame) -> TubeMass {
        let area = std::f64::consts::PI * self.radius_mm.powi(2);
        TubeMass {
            volume_mm3: area * self.height_mm,
            centre: root.to_model(&Point::new(-0.5 * self.height_mm, 0.0, 0.0)),
        }
    }

    /// Returns the lean at which a centre, given in the root's frame, is over the edge.
    fn toppling_rad(&self, centre: &Point) -> f64 {
        let margin = self.radius_mm - centre.y.hypot(centre.z);
        margin.atan2(centre.x + self.height_mm)
    }
}
