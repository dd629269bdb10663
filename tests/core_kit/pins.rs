//! Pins between the parts of a panel that are cut for the printer's room.

use std::fs;
use std::path::Path;

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

/// Holds that a picture shows each panel's parts apart with their pins, and the page has it.
pub fn hold_pictures(kit: &Path, sheet: &Value) {
    let units = list(sheet, "units");
    let holds = |unit: &Value, pin: &Value| {
        ["on", "into"].map(|key| list(unit, "parts").contains(&pin[key])) == [true; 2]
    };
    let page = fs::read_to_string(kit.join("job.html")).unwrap();
    for (index, unit) in units.iter().enumerate() {
        let file = kit.join(format!("pictures/bench-{:02}.svg", index + 1));
        let has_pins = list(sheet, "pins").iter().any(|pin| holds(unit, pin));
        assert_eq!(file.exists(), has_pins, "{}", file.display());
        let name = unit["id"].as_str().unwrap();
        let caption = format!("{name}: its parts on the bench");
        assert_eq!(page.contains(&caption), has_pins, "{caption}");
        if has_pins {
            let drawn = fs::read_to_string(file).unwrap();
            let parts = list(unit, "parts").iter().filter_map(Value::as_str);
            let parts: Vec<&str> = parts.filter(|part| part.len() > 1).collect();
            let named = parts
                .iter()
                .filter(|part| drawn.contains(&format!(">{part}<")));
            assert!(named.count() >= 2, "{name}: {parts:?}");
        }
    }
}
