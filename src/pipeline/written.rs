//! A part as it is written: its STL file, read back.

use super::Error;
use crate::cut::Part;
use crate::geom::Vector;
use crate::io::stl;
use crate::mesh::{Crossings, TriMesh, weld};
use crate::verify::{PartEvidence, Pose};

/// Places on the plate that are tried until a part's file is free of folds. Each of them folds another sliver of a
/// thousand, so few are needed.
const PLACES: usize = 6;
/// From one place to the next, mm: far less than a part's room on the plate, and no multiple of a file's steps.
const PLACE_STEP_MM: [f64; 2] = [0.013_7, 0.009_1];

/// A part as it is written.
#[derive(Debug, Clone)]
pub struct WrittenPart {
    /// The part.
    pub part: Part,
    /// Its file, relative to the kit.
    pub file: String,
    /// The bytes of its STL file.
    pub bytes: Vec<u8>,
    /// The triangles read back from those bytes, print pose.
    pub read_back: TriMesh,
}

impl WrittenPart {
    /// The part as it is written and read back, at the first place on the plate where the rounding of the file's
    /// coordinates folds no sliver of its surface.
    ///
    /// The file is larger than the part by `scale_ratio` along x, y and z; what is read back is in the part's own size.
    pub fn of(part: Part, job: &str, count: usize, scale_ratio: [f64; 3]) -> Result<Self, Error> {
        let name = format!("{job}_{}of{count:02}", part.id);
        let mut written = Self::at_place(part.clone(), &name, 0, scale_ratio)?;
        for place in 1..PLACES {
            if Crossings::of(&weld(&written.read_back)).pairs == 0 {
                break;
            }
            written = Self::at_place(part.clone(), &name, place, scale_ratio)?;
        }
        Ok(written)
    }

    /// The part written at one of the places tried.
    fn at_place(mut part: Part, name: &str, place: usize, scale_ratio: [f64; 3]) -> Result<Self, Error> {
        let pose = &mut part.pose.print_from_model;
        pose[0][3] += PLACE_STEP_MM[0] * place as f64;
        pose[1][3] += PLACE_STEP_MM[1] * place as f64;
        let pose = Pose { rows: *pose };
        let scale = Vector::from(scale_ratio);
        let laid = part.solid.mesh().map_vertices(|p| pose.to_print(p).coords.component_mul(&scale).into());
        let bytes = stl::encode(&laid, name);
        let read_back = stl::decode(&bytes)?.map_vertices(|p| p.coords.component_div(&scale).into());
        Ok(Self { part, file: format!("parts/{name}.stl"), bytes, read_back })
    }

    /// The part as the judge sees it.
    pub fn evidence(&self) -> PartEvidence {
        let pose = Pose { rows: self.part.pose.print_from_model };
        PartEvidence { id: self.part.id.clone(), mesh: self.read_back.clone(), pose }
    }
}
