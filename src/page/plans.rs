//! The page of plans side by side: each seen from four sides, with what it reaches and costs.

use maud::{Markup, html};
use rayon::prelude::*;

use super::document::styled_document;
use crate::base::watch::Watch;
use crate::draw::{Camera, Item, PictureError, Scene, base64, part_color, render, view_direction};
use crate::geom::{Vector, orthonormal_basis};
use crate::mesh::TriMesh;

/// Number of sides from which a plan is seen.
const SIDES: usize = 4;
/// Angles of the viewer to the right of a side and above the ground, radians: enough to show depth.
const TURN_AND_LIFT: [f64; 2] = [0.3, 0.3];
/// Width and height of a picture, pixels.
const SIZE_PX: [usize; 2] = [420, 420];
/// The style of the plans beside the shop's own: columns on a screen, one plan a page on paper.
const STYLE: &str = ".plans{display:grid;grid-template-columns:repeat(auto-fit,minmax(19rem,1fr));\
gap:1.5rem}.plan{break-inside:avoid}.sides{display:grid;grid-template-columns:1fr 1fr;gap:.25rem}\
.sides img{width:100%}";

/// A plan on the page.
#[derive(Debug, Clone)]
pub struct PlanCard {
    /// Its name.
    pub title: String,
    /// Names and values, row by row.
    pub rows: Vec<[String; 2]>,
    /// Things to know before it is chosen.
    pub notes: Vec<String>,
    /// Pictures from four sides, as PNG.
    pub pictures: Vec<Vec<u8>>,
}

/// Draws the parts of a plan in their places, from four sides.
///
/// # Errors
/// A picture cannot be encoded, or the watch was stopped.
pub fn draw_sides(
    parts: &[TriMesh],
    up: &Vector,
    watch: &Watch,
) -> Result<Vec<Vec<u8>>, PictureError> {
    let item = |(index, mesh)| Item::new(mesh, part_color(index));
    let scene = Scene {
        items: parts.iter().enumerate().map(item).collect(),
        cut: None,
    };
    let (across, front) = orthonormal_basis(up);
    let picture = |side: usize| {
        watch.check()?;
        let (sin, cos) = (std::f64::consts::TAU * side as f64 / SIDES as f64).sin_cos();
        let normal = front * cos + across * sin;
        let camera = Camera {
            size_px: SIZE_PX,
            ..Camera::new(view_direction(&normal, up, TURN_AND_LIFT), *up)
        };
        render(&scene, &camera).to_png()
    };
    (0..SIDES).into_par_iter().map(picture).collect()
}

/// Returns the page of plans side by side, as one file that loads nothing.
pub fn plans(job: &str, cards: &[PlanCard], how_to_choose: &str) -> String {
    let body = html! {
        header { h1 { "Plans for " (job) } p { (how_to_choose) } }
        main { div class="plans" { @for card in cards { (plan(card)) } } }
    };
    styled_document(&format!("Plans: {job}"), &body, STYLE)
}

fn plan(card: &PlanCard) -> Markup {
    html! {
        section class="plan" {
            h2 { (card.title) }
            div class="sides" {
                @for (side, picture) in card.pictures.iter().enumerate() {
                    img src=(format!("data:image/png;base64,{}", base64(picture)))
                        alt=(format!("{}, side {}", card.title, side + 1));
                }
            }
            table { @for [name, value] in &card.rows { tr { th { (name) } td { (value) } } } }
            @for note in &card.notes { p class="small" { (note) } }
        }
    }
}
