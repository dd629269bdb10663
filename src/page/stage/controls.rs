//! The section of a view with its controls.

use maud::{Markup, PreEscaped, html};

use super::{Player, Stage, Toggle};
use crate::draw::hex;

/// The least part of a step by which the slider moves: an arrow key moves a twentieth of a step.
const SLIDER_STEP: &str = "0.05";

/// Returns the view with its controls, hidden until the script finds that it can draw.
pub(in crate::page) fn viewer(stage: &Stage) -> Markup {
    let subject = stage.words.subject;
    html! {
        section id="view" class="screen-only" aria-labelledby="view-title" hidden {
            h2 id="view-title" { "3D view" }
            div class="stage" {
                canvas id="view-canvas" tabindex="0" role="application"
                    aria-label=(format!("{subject} in three dimensions. Drag or press the arrow keys to turn it, plus and minus to zoom, Home to reset. The pictures of this sheet show the same.")) {}
                div id="view-names" aria-hidden="true" {}
            }
            div class="controls" {
                @match &stage.player {
                    Some(player) => (played(stage, player)),
                    None => {
                        label for="view-explode" { (stage.words.slider) }
                        input id="view-explode" type="range" min="0" max="100" value="0";
                    }
                }
                label for="view-axis" { "Cut open" }
                span {
                    select id="view-axis" {
                        option value="-1" selected { "off" }
                        option value="0" { "side" }
                        option value="1" { "front" }
                        option value="2" { "top" }
                    }
                    " " span id="view-place" {}
                }
                label for="view-section" { "Where" }
                input id="view-section" type="range" min="0" max="100" step="0.5" value="50" disabled;
                fieldset {
                    legend { "Show" }
                    @for one in &stage.toggles { (toggle(one)) }
                    @if let Some(line) = stage.words.line {
                        label class="item" { input id="view-line" type="checkbox" checked; (line) }
                    }
                    @if stage.player.is_some() {
                        label class="item" { input id="view-named" type="checkbox" checked; "Names" }
                    }
                }
                button id="view-reset" type="button" { "Reset view" }
            }
            // The packed text has no `<`, so nothing in it can end the script.
            script id="view-data" type="application/json" { (PreEscaped(&stage.packed)) }
            script { @for script in stage.scripts { (PreEscaped(script)) } }
        }
    }
}

fn toggle(toggle: &Toggle) -> Markup {
    let bodies: Vec<String> = toggle.bodies.iter().map(usize::to_string).collect();
    html! {
        label class="item" {
            input type="checkbox" checked data-bodies=(bodies.join(" "));
            @if let Some(color) = toggle.color {
                span class="swatch" style=(format!("background:{}", hex(color))) {}
            }
            " " (toggle.name)
        }
    }
}

/// Returns the slider of a motion with its buttons and its steps.
fn played(stage: &Stage, player: &Player) -> Markup {
    html! {
        label for="view-at" { (stage.words.slider) }
        input id="view-at" type="range" min="0" max=(player.moves) step=(SLIDER_STEP) value="0";
        div class="player" {
            button id="view-back" type="button" { "Step back" }
            button id="view-play" type="button" { "Play" }
            button id="view-on" type="button" { "Step on" }
            output id="view-state" for="view-at" {}
        }
        p id="view-figures" class="small" {}
        fieldset {
            legend { (stage.words.order) }
            ol class="chips" {
                @for step in &player.steps {
                    li { button type="button" data-to=(step.to) { (step.name) } }
                }
            }
        }
        @if !player.poses.is_empty() {
            fieldset {
                legend { "Poses" }
                ol class="chips" {
                    @for name in &player.poses {
                        li { button type="button" data-pose=(name) { (name) } }
                    }
                }
            }
        }
    }
}
