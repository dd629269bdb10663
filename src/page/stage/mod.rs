//! The view of a page in three dimensions: rigid bodies as data for its scripts, and its controls.
//!
//! * `pack` simplifies bodies and packs each in its own box.
//! * `film` is the view of telescopes, `units` that of objects on a base.
//! * `controls` draws the section with all that moves it.

mod controls;
mod film;
mod pack;
mod units;

pub(super) use controls::viewer;
pub use film::{Film, FilmBody, FilmLimb, FilmPlace, FilmPose};
pub(super) use pack::{Body, simplify_all};

use serde::Serialize;

use self::pack::PackedBody;
use crate::draw::{Color, PictureError};
use crate::geom::{Aabb, Matrix};

/// The script that draws bodies, and turns and cuts them.
const STAGE: &str = include_str!("stage.js");
/// The script that takes the parts of a kit apart along its cuts.
const SHIFTS: &str = include_str!("shifts.js");
/// The script of the slider that goes from step to step, of its buttons and of playing.
const PLAYER: &str = include_str!("player.js");
/// The script of telescopes.
const HELICES: &str = include_str!("helices.js");
/// The script of units that leave along their ways.
const WAYS: &str = include_str!("ways.js");

/// A view in three dimensions, packed for the scripts of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    packed: String,
    toggles: Vec<Toggle>,
    scripts: &'static [&'static str],
    words: Words,
    /// The steps of the slider; `None` for parts that are drawn apart all at once.
    player: Option<Player>,
}

/// The words of a view's controls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Words {
    /// The name of the view for those who do not see it.
    subject: &'static str,
    /// The name of the slider.
    slider: &'static str,
    /// The title of the list of steps.
    order: &'static str,
    /// The name of the line that is drawn besides bodies, if there is one.
    line: Option<&'static str>,
}

/// A control that shows and hides bodies.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Toggle {
    name: String,
    color: Option<Color>,
    /// The indices of its bodies.
    bodies: Vec<usize>,
}

/// The steps of a slider.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Player {
    /// Its greatest value.
    moves: usize,
    steps: Vec<Step>,
    /// The names of the poses.
    poses: Vec<String>,
}

/// A step: its name, and the value of the slider at its end.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
struct Step {
    name: String,
    to: usize,
}

/// Words beside a body.
#[derive(Debug, Serialize)]
struct Named {
    body: usize,
    words: String,
}

/// The data that the scripts read. `M` is what moves the bodies.
#[derive(Serialize)]
struct Packed<'a, M> {
    /// The box of all bodies in all their places, upright, mm.
    #[serde(rename = "box")]
    bounds: [[f64; 3]; 2],
    /// Columns of the rotation from the model's axes to upright ones.
    upright: [f64; 9],
    /// True if a cut goes through the bodies where they are moved to.
    cuts_moved: bool,
    items: Vec<PackedBody>,
    lines: Vec<PackedBody>,
    /// The words that are written beside bodies.
    named: Vec<Named>,
    /// True if they wait until their body is out of its place, where others hide it.
    names_wait: bool,
    steps: &'a [Step],
    motion: M,
}

/// Columns of a rotation, one after the other.
fn columns(rotation: &Matrix) -> [f64; 9] {
    let mut all = [0.0; 9];
    all.copy_from_slice(rotation.as_slice());
    all
}

fn corners(bounds: &Aabb) -> [[f64; 3]; 2] {
    [bounds.min, bounds.max].map(|corner| corner.coords.into())
}

fn packed<M: Serialize>(data: &Packed<M>) -> Result<String, PictureError> {
    Ok(serde_json::to_string(data)?)
}

impl Stage {
    /// Packs the parts of a kit, upright, each with the way by which it is drawn apart.
    pub(super) fn of_parts(bodies: &[Body], shifts: Vec<[f64; 3]>) -> Result<Self, PictureError> {
        let bounds = bodies.iter().map(|body| body.mesh.aabb());
        let bounds = bounds.fold(Aabb::EMPTY, |all, next| all.union(&next));
        let data = Packed {
            bounds: corners(&bounds),
            upright: columns(&Matrix::identity()),
            cuts_moved: false,
            items: bodies.iter().map(PackedBody::of).collect(),
            lines: Vec::new(),
            named: Vec::new(),
            names_wait: false,
            steps: &[],
            motion: shifts,
        };
        let toggles = bodies.iter().enumerate().map(|(index, body)| Toggle {
            name: body.name.clone(),
            color: Some(body.color),
            bodies: vec![index],
        });
        Ok(Self {
            packed: packed(&data)?,
            toggles: toggles.collect(),
            scripts: &[STAGE, SHIFTS],
            words: Words {
                subject: "The assembly",
                slider: "Take apart",
                order: "",
                line: None,
            },
            player: None,
        })
    }
}
