//! The duration of each stage of a run.

use serde::de::{MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Names and seconds of the stages, in the order they ran; a JSON object.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Timing(pub Vec<(String, f64)>);

impl Timing {
    /// Adds a stage.
    pub fn push(&mut self, stage: &str, seconds: f64) {
        self.0.push((stage.to_owned(), seconds));
    }

    /// Returns the duration of all stages together, s.
    pub fn total_s(&self) -> f64 {
        self.0.iter().map(|(_, seconds)| seconds).sum()
    }
}

impl Serialize for Timing {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (stage, seconds) in &self.0 {
            map.serialize_entry(stage, seconds)?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for Timing {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(InOrder)
    }
}

/// Reads a JSON object and keeps the order of its keys.
struct InOrder;

impl<'de> Visitor<'de> for InOrder {
    type Value = Timing;

    fn expecting(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        formatter.write_str("an object of seconds by stage")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Timing, M::Error> {
        let mut stages = Vec::new();
        while let Some(entry) = map.next_entry()? {
            stages.push(entry);
        }
        Ok(Timing(stages))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_keep_their_order_through_json() {
        let timing = Timing(vec![("solve".into(), 0.5), ("load".into(), 0.25)]);
        let text = serde_json::to_string(&timing).unwrap();
        assert_eq!(text, r#"{"solve":0.5,"load":0.25}"#);
        assert_eq!(serde_json::from_str::<Timing>(&text).unwrap(), timing);
        assert_eq!(timing.total_s(), 0.75);
    }
}
