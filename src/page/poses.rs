//! The poses of a telescope or a figure on its job sheet.

use maud::{Markup, html};

use super::fields::file_name;
use super::figure::{Picture, Role, figures};
use crate::base::numbers::{measured, number};
use crate::sheet::pose::{PoseJointRow, PoseRow};
use crate::verify::PoseTipPromise;

/// A stroke or a turn below which a joint stays where it is, mm and degrees: it is not seen.
const UNSEEN: f64 = 0.05;

/// Returns the poses as the shop sets them; nothing without poses.
pub(super) fn poses(rows: &[PoseRow], pictures: &[Picture]) -> Markup {
    html! {
        @for pose in rows {
            h3 { "Pose " (pose.name) }
            p {
                "From all in, set the joints in this order; other orders were not proved free. "
                "The file " code { (file_name(&pose.file)) } " in " code { "poses" } " holds the pose, to be edited and ordered anew."
            }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Joint" } th scope="col" class="n" { "Comes out" }
                        th scope="col" { "Then turns" } th scope="col" { "Set" }
                    }
                }
                tbody { @for joint in &pose.joints { (line(joint)) } }
            }
            @for tip in &pose.tips {
                @if let Some(words) = tip_words(tip) { p { (words) } }
            }
            @if pose.joints.iter().any(is_between) {
                p class="small" { "A shell that is not all out is held by friction alone, and slides under a load." }
            }
        }
        (figures(pictures, Role::Pose))
    }
}

fn is_between(joint: &PoseJointRow) -> bool {
    joint.stroke_mm < joint.whole_mm - UNSEEN
}

fn line(joint: &PoseJointRow) -> Markup {
    html! {
        tr {
            th scope="row" { (joint.id) }
            td class="n" data-head="Comes out" {
                (measured(joint.stroke_mm, "mm"))
                @if is_between(joint) { " of " (measured(joint.whole_mm, "mm")) } @else { ", all" }
            }
            td data-head="Then turns" {
                @if joint.turn_deg.abs() < UNSEEN { "not at all" }
                @else if joint.turn_deg > 0.0 { "left by " (measured(joint.turn_deg, "°")) }
                @else { "right by " (measured(-joint.turn_deg, "°")) }
            }
            td data-head="Set" { "☐" }
        }
    }
}

/// Words where a tip is that was to reach a place.
fn tip_words(tip: &PoseTipPromise) -> Option<String> {
    let wanted = tip.wanted_mm?;
    let off = (0..3).map(|axis| tip.reached_mm[axis] - wanted[axis]);
    let off_mm = off.map(|off| off * off).sum::<f64>().sqrt();
    let place = wanted.map(number).join(", ");
    Some(format!(
        "The end of {} is at {place} mm, in the axes of the model, and {} off.",
        match tip.id.as_str() {
            "tip" => "the last shell".to_owned(),
            limb => format!("limb {limb}"),
        },
        measured(off_mm, "mm")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_half_way_is_said_to_be_held_by_nothing_and_its_place_is_told() {
        let joint = |stroke_mm: f64, turn_deg: f64| PoseJointRow {
            id: "J01".to_owned(),
            stroke_mm,
            whole_mm: 30.0,
            turn_deg,
        };
        let mut pose = PoseRow {
            name: "reach".to_owned(),
            file: "poses/reach.toml".to_owned(),
            tips: vec![PoseTipPromise {
                id: "tip".to_owned(),
                limb: 1,
                wanted_mm: Some([1.0, 2.0, 3.0]),
                reached_mm: [1.0, 2.0, 3.4],
            }],
            off_mm: Some(0.4),
            joints: vec![joint(12.0, 0.0)],
            least_gap_mm: None,
        };
        let shown = |pose: &PoseRow| poses(std::slice::from_ref(pose), &[]).into_string();
        let page = shown(&pose);
        assert!(page.contains("friction alone"), "{page}");
        assert!(page.contains("1, 2, 3 mm"), "{page}");
        pose.joints = vec![joint(30.0, -20.0)];
        let page = shown(&pose);
        assert!(
            !page.contains("friction alone") && page.contains("right by"),
            "{page}"
        );
    }
}
