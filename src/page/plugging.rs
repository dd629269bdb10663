//! The closing of drain holes with their plugs.

use maud::{Markup, html};

use super::cleaning::side_of;
use crate::base::numbers::{coordinates, measured};
use crate::sheet::Checklist;

/// Returns the step in which the drain holes are closed; `None` without plugs.
pub(super) fn close_holes(sheet: &Checklist) -> Option<Markup> {
    let mut plugs = sheet.plugs().peekable();
    plugs.peek()?;
    let known = sheet.printer.glue.as_ref();
    let glue = known.map_or("glue", |glue| &glue.name);
    let safety = known.and_then(|glue| glue.safety.as_ref());
    Some(html! {
        p {
            "Close a hole only when its void is empty, clean and dry. Coat the flank of its plug \
             thinly with " (glue) ", and push the narrow end in until the outer end is flush. It may go \
             deeper: stop at flush, and hold it until the glue grips. Wipe off what comes out. \
             Sand what stands out once the glue has set. Each plug fits its own hole alone: keep \
             it in a bag with its name."
        }
        @if let Some(safety) = safety { p { strong { "Safety: " } (safety) } }
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Plug" }
                    th scope="col" { "Hole" }
                    th scope="col" class="n" { "Gap on each side" }
                }
            }
            tbody {
                @for (hole, plug) in plugs {
                    tr {
                        th scope="row" { "☐ " (plug.part) }
                        td data-head="Hole" {
                            (hole.id) " on its " (side_of(sheet, hole))
                            " at " (coordinates(&hole.from_mm)) " mm"
                        }
                        td class="n" data-head="Gap on each side" { (measured(plug.gap_mm, "mm")) }
                    }
                }
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;
    use crate::verify::{PromisedHole, PromisedPlug};

    #[test]
    fn every_plug_is_told_with_its_hole_and_without_plugs_there_is_no_step() {
        let mut sheet = sample().0;
        assert!(close_holes(&sheet).is_none());
        sheet.drains = vec![PromisedHole {
            id: "D1".to_owned(),
            void: "V1".to_owned(),
            from_mm: [1.0, 2.0, -3.0],
            to_mm: [1.0, 2.0, 0.0],
            diameter_mm: 5.0,
            mouth_mm: Some(6.25),
            plug: Some(PromisedPlug {
                part: "P02".to_owned(),
                gap_mm: 0.1,
            }),
            volume_mm3: 60.0,
        }];
        let words = close_holes(&sheet).unwrap().into_string();
        for said in ["☐ P02", "D1 on its", "0.1\u{a0}mm", "narrow end in"] {
            assert!(words.contains(said), "{said}: {words}");
        }
    }
}
