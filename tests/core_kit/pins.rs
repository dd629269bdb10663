//! Pins between the parts of a panel that are cut for the printer's room.

use serde_json::Value;

use super::common::{list, number};

/// Holds the pins of the box. Its long sides are cut in two, so that two of its panels carry two
/// parts each.
pub fn hold_pins(sheet: &Value) {
    let pins = list(sheet, "pins");
    let joints = |pin: &Value| [pin["on"].clone(), pin["into"].clone()];
    let mut pairs: Vec<[Value; 2]> = pins.iter().map(joints).collect();
    pairs.dedup();
    assert!(
        pairs.len() >= 2 && pins.len() >= 2 * pairs.len(),
        "{pairs:?}"
    );
    for pin in pins {
        let [on, into] = ["on", "into"].map(|key| pin[key].as_str().unwrap());
        // Both lie on one panel: their names begin with its number.
        assert_eq!(on[..1], into[..1]);
        assert!(number(pin, "/socket_diameter_mm") > number(pin, "/diameter_mm"));
        assert!(number(pin, "/socket_depth_mm") > number(pin, "/length_mm"));
    }
    let printed = list(sheet, "parts").iter();
    let changed: Vec<f64> = printed
        .filter(|part| !part["pins_mm3"].is_null())
        .flat_map(|part| [number(part, "/pins_mm3/0"), number(part, "/pins_mm3/1")])
        .collect();
    assert_eq!(changed.len(), 4 * pairs.len());
    assert!(changed.iter().filter(|mm3| **mm3 > 10.0).count() >= 2 * pairs.len());
}
