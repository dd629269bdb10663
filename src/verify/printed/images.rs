//! Layer images as material: what a machine of pixels hardens, in the shape of toolpaths.

use std::path::Path;

use super::error::PrintedError;
use crate::base::watch::Watch;
use crate::io::gcode::{
    Deposits, DiameterSource, Facts, Feature, Feed, Place, PrintedObject, Tally, Toolpath,
};
use crate::io::layers::{LayerPlate, PixelSum, read_layer_places, read_layers};

/// Reads the layer images of each plate in a file, each with the name of its plate if it is stated.
pub(super) fn read_images(
    path: &Path,
    watch: &Watch,
) -> Result<Vec<(Option<String>, Toolpath)>, PrintedError> {
    let plates = read_layers(path, watch)?;
    Ok(plates
        .iter()
        .map(|plate| (plate.plate.clone(), toolpath(plate)))
        .collect())
}

/// Reads what lies in each of these places of one plate, counted from 0.
pub(super) fn read_image_places(
    path: &Path,
    plate: usize,
    places: &[Place],
    watch: &Watch,
) -> Result<Vec<Deposits>, PrintedError> {
    let sums = read_layer_places(path, plate, places, watch)?;
    Ok(sums.iter().map(deposits).collect())
}

/// Returns what images harden as the material of one object without a label.
fn toolpath(plate: &LayerPlate) -> Toolpath {
    let mut facts = Facts {
        layer_height_mm: Some(plate.layer_mm),
        layers: Some(plate.layers),
        ..Facts::default()
    };
    // Pixels reach to their own edges: nothing lies beyond them, as half a line does.
    facts.line_widths.external_perimeter_mm = Some(0.0);
    Toolpath {
        facts,
        objects: vec![PrintedObject {
            label: None,
            deposits: deposits(&plate.whole),
        }],
        places: plate.places.iter().map(deposits).collect(),
        supports: Vec::new(),
        feed: Feed::default(),
        diameters_mm: Vec::new(),
        diameter_source: DiameterSource::Unneeded,
        layers: plate.layers,
        lines: 0,
    }
}

/// Returns pixels as material without lines.
fn deposits(sum: &PixelSum) -> Deposits {
    let volume_mm3 = sum.moments.volume();
    let tally = (volume_mm3 > 0.0).then_some(Tally {
        feature: Feature::Other,
        tool: 0,
        moments: sum.moments,
        bounds: sum.bounds,
        flowed_mm3: volume_mm3,
        length_mm: 0.0,
        side_mm2: 0.0,
        beads: sum.layers,
    });
    Deposits {
        tallies: tally.into_iter().collect(),
        layers: sum.layers,
        retractions: 0,
    }
}
