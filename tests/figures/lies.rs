//! Lies about the parts of a juncture that is cut, for the judges to find.

use std::fs;
use std::path::{Path, PathBuf};

use equipoise::geom::{Frame, Point, Vector};
use equipoise::io::stl;
use equipoise::mesh::{Csg, primitives};
use equipoise::repair::weld;
use equipoise::verify::{Peg, Pose};
use serde_json::Value;

use crate::common::{self, verify};

/// Something that is wrong with a part of the cut trunk.
#[derive(Debug, Clone, Copy)]
pub enum Lie {
    /// Its pose is a tenth of a millimetre aside.
    Moved,
    /// Its file is that of another.
    Swapped,
    /// It is not on the list.
    Lost,
    /// A pin is cut off.
    NoPin,
    /// It states no cuts.
    NoCuts,
    /// No pin is on the list, and the sockets are left.
    NoPins,
    /// No pin and no socket is on the list.
    NoPegs,
    /// A cut is stated elsewhere.
    Elsewhere,
    /// It reaches into its neighbour.
    Overlapping,
}

/// All of them.
pub const LIES: [Lie; 9] = [
    Lie::Moved,
    Lie::Swapped,
    Lie::Lost,
    Lie::NoPin,
    Lie::NoCuts,
    Lie::NoPins,
    Lie::NoPegs,
    Lie::Elsewhere,
    Lie::Overlapping,
];

impl Lie {
    /// Returns the exit code of `verify`, and words of a promise that it breaks.
    fn found(self) -> (i32, &'static str) {
        match self {
            Self::Moved | Self::Swapped | Self::NoPin | Self::NoPins => {
                (1, "every pin and socket has its size")
            }
            Self::Lost => (1, "add up to the uncut juncture"),
            Self::NoCuts => (2, "states no cuts"),
            Self::NoPegs => (1, "with all pins, sockets and ids"),
            Self::Elsewhere => (1, "keep the model's surface"),
            Self::Overlapping => (1, "no part reaches into another"),
        }
    }
}

/// Copies the kit and lies in the copy.
pub fn lie_about_a_part(folder: &Path, kit: &Path, lie: Lie) -> PathBuf {
    let copy = folder.join(format!("{lie:?}"));
    common::copy(kit, &copy);
    let list = copy.join("checklist.json");
    let mut sheet: Value = serde_json::from_slice(&fs::read(&list).unwrap()).unwrap();
    let junctures = sheet["junctures"].as_array_mut().unwrap();
    let mut junctures = junctures.iter_mut();
    let cut = junctures.find(|own| own.get("divided").is_some()).unwrap();
    let divided = cut["divided"].take();
    let parts = cut["parts"].as_array_mut().unwrap();
    let file = |part: &Value| copy.join(part["file"].as_str().unwrap());
    match lie {
        Lie::Moved => {
            let shift = &mut parts[1]["print_from_model"][0][3];
            *shift = (shift.as_f64().unwrap() + 0.1).into();
        }
        Lie::Swapped => {
            let bytes = [&parts[0], &parts[1]].map(|part| fs::read(file(part)).unwrap());
            fs::write(file(&parts[0]), &bytes[1]).unwrap();
            fs::write(file(&parts[1]), &bytes[0]).unwrap();
        }
        Lie::Lost => drop(parts.pop()),
        Lie::NoPin => cut_off_a_pin(parts, file),
        Lie::NoPins => forget(parts, &["pins"]),
        Lie::NoPegs => forget(parts, &["pins", "sockets"]),
        Lie::Overlapping => push_together(parts, &divided["cuts"][0]["normal"]),
        Lie::NoCuts | Lie::Elsewhere => {}
    }
    match lie {
        Lie::NoCuts => drop(cut.as_object_mut().unwrap().remove("divided")),
        _ => cut["divided"] = divided,
    }
    if let Lie::Elsewhere = lie {
        let at = &mut cut["divided"]["cuts"][0]["point_mm"];
        *at = at.as_array().unwrap().iter().map(aside).collect();
    }
    fs::write(&list, sheet.to_string()).unwrap();
    copy
}

/// Returns a coordinate of a point a millimetre away.
fn aside(at_mm: &Value) -> f64 {
    at_mm.as_f64().unwrap() + 1.0
}

/// Takes keys off every part.
fn forget(parts: &mut [Value], keys: &[&str]) {
    for part in parts {
        let part = part.as_object_mut().unwrap();
        part.retain(|key, _| !keys.contains(&key.as_str()));
    }
}

/// Moves the first part by a tenth of a millimetre along a cut, to the side of the second.
fn push_together(parts: &mut [Value], normal: &Value) {
    let normal: [f64; 3] = serde_json::from_value(normal.clone()).unwrap();
    let pose = |part: &Value| -> Pose {
        serde_json::from_value(part["print_from_model"].clone()).unwrap()
    };
    let peg = |part: &Value, kind: &str| part[kind].get(0).cloned();
    // A pin's axis leads out of the part that has it, a socket's into its own.
    let out = peg(&parts[0], "pins").map(|pin| (1.0, pin));
    let out = out.or_else(|| peg(&parts[0], "sockets").map(|socket| (-1.0, socket)));
    let (sign, peg) = out.unwrap();
    let axis: [f64; 3] = serde_json::from_value(peg["axis"].clone()).unwrap();
    let way = Vector::from(axis).dot(&Vector::from(normal)) * sign;
    let shift = Vector::from(normal) * 0.1 * way.signum();
    let mut moved = pose(&parts[0]);
    for row in &mut moved.rows {
        row[3] -= row[0] * shift.x + row[1] * shift.y + row[2] * shift.z;
    }
    parts[0]["print_from_model"] = serde_json::to_value(moved).unwrap();
}

/// Cuts the first pin off the part that has it.
fn cut_off_a_pin(parts: &[Value], file: impl Fn(&Value) -> PathBuf) {
    let has_pin = |part: &&Value| part["pins"].as_array().is_some_and(|pins| !pins.is_empty());
    let part = parts.iter().find(has_pin).unwrap();
    let pose: Pose = serde_json::from_value(part["print_from_model"].clone()).unwrap();
    let pin: Peg = serde_json::from_value(part["pins"][0].clone()).unwrap();
    // A block from just above the cut to beyond the tip.
    let frame = Frame::with_axis(Point::from(pin.center_mm), &Vector::from(pin.axis));
    let (wide, low) = (pin.diameter_mm, 0.01);
    let block = primitives::cuboid(
        &Point::new(-wide, -wide, low),
        &Point::new(wide, wide, 2.0 * pin.length_mm),
    );
    let block = block.map_vertices(|p| pose.to_print(&frame.to_model(p)));
    let mesh = weld(&stl::decode(&fs::read(file(part)).unwrap()).unwrap());
    let rest = Csg::of_mesh(&mesh).unwrap();
    let rest = rest.subtract(&Csg::of_mesh(&block).unwrap()).unwrap();
    fs::write(file(part), stl::encode(&rest.to_mesh().unwrap(), "part")).unwrap();
}

/// Asserts that `verify` finds a lie.
pub fn assert_found(untrue: &Path, lie: Lie) {
    let (code, said) = verify(untrue);
    let (wanted, expected) = lie.found();
    assert_eq!(code, Some(wanted), "{lie:?}: {said}");
    let mut broken = said
        .lines()
        .filter(|line| wanted == 2 || line.contains("FAIL"));
    assert!(
        broken.any(|line| line.contains(expected)),
        "{lie:?}: {said}"
    );
}
