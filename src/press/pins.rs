//! The cuts and pins of `cuts.toml`, held against those of the checklist.

use std::collections::BTreeSet;

use crate::cut::{Cut, CutOrder, CutSide, PinSite};
use crate::sheet::{Checklist, CutRow, SideRow};
use crate::verify::Peg;

/// Lengths and directions that were copied differ by no more than this.
const COPIED: f64 = 1e-9;

/// Returns what `cuts.toml` and the checklist say differently of cuts and pins, a sentence each.
pub(super) fn find_false_pins(sheet: &Checklist, order: &CutOrder) -> Vec<String> {
    let mut faults = Vec::new();
    let are_cuts = sheet.cuts.len() == order.cuts.len()
        && sheet
            .cuts
            .iter()
            .zip(&order.cuts)
            .all(|(row, cut)| is_cut(row, cut));
    if !are_cuts {
        faults.push("cuts.toml has other cuts than the checklist".to_owned());
    }
    let sites = order.pins.iter().flatten();
    let known: BTreeSet<String> = sites.clone().map(|site| site.id.to_string()).collect();
    let parts = || sheet.parts.iter();
    let pegs = || parts().flat_map(|part| part.pins.iter().chain(&part.sockets));
    let stated: BTreeSet<String> = pegs().map(|peg| peg.id.clone()).collect();
    if known != stated {
        faults.push(format!(
            "cuts.toml has the pins {known:?}, the checklist {stated:?}"
        ));
    }
    for site in sites {
        let id = site.id.to_string();
        let own = |peg: &&Peg| peg.id == id;
        let pins = parts().flat_map(|part| &part.pins).filter(own);
        let sockets = parts().flat_map(|part| &part.sockets).filter(own);
        let is_right = pins.clone().all(|pin| is_pin(pin, site))
            && sockets.clone().all(|socket| is_socket(socket, site));
        let has_both = (site.dowel.is_some() || pins.count() == 1) && sockets.count() > 0;
        if !(is_right && has_both) {
            faults.push(format!("cuts.toml has another pin {id} than the checklist"));
        }
    }
    faults
}

fn is_cut(row: &CutRow, cut: &Cut) -> bool {
    let is_side = |(row, side): (&SideRow, &CutSide)| {
        row.cut == side.cut.to_string() && row.side == side.side.word()
    };
    row.id == cut.id.to_string()
        && are_near(&row.point_mm, &cut.point_mm)
        && are_near(&row.normal, &cut.normal)
        && row.within.len() == cut.within.len()
        && row.within.iter().zip(&cut.within).all(is_side)
}

fn is_pin(pin: &Peg, site: &PinSite) -> bool {
    let sizes = [site.diameter_mm, site.length_mm];
    are_near(&pin.center_mm, &site.center_mm)
        && are_near(&pin.axis, &site.direction)
        && are_near(&[pin.diameter_mm, pin.length_mm], &sizes)
}

/// Returns whether a socket is that of a pin, on either side of the cut for a dowel.
fn is_socket(socket: &Peg, site: &PinSite) -> bool {
    let sizes = [site.socket_diameter_mm, site.socket_depth_mm];
    let turned = site.direction.map(|x| -x);
    let is_along = are_near(&socket.axis, &site.direction)
        || (site.dowel.is_some() && are_near(&socket.axis, &turned));
    are_near(&socket.center_mm, &site.center_mm)
        && is_along
        && are_near(&[socket.diameter_mm, socket.length_mm], &sizes)
}

fn are_near<const N: usize>(a: &[f64; N], b: &[f64; N]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= COPIED)
}
