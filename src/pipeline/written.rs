//! A part as it is written: its STL file, read back.

use super::Error;
use crate::cut::Part;
use crate::geom::Vector;
use crate::io::stl;
use crate::mesh::{Crossings, TriMesh};
use crate::repair::{unfolded, weld};
use crate::verify::{PartEvidence, Pose};

/// Writings that are tried until a part's file is free of folds: as it is, without folds at the
/// same place, and at other places on the plate. Each place folds another sliver of a thousand, so
/// few are needed.
const WRITINGS: usize = 7;
/// From one place to the next, mm: far less than a part's room on the plate, and no multiple of a
/// file's steps.
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
    /// The part as it is written and read back, at the first place on the plate where the rounding
    /// of the file's coordinates folds no sliver of its surface.
    ///
    /// The file is larger than the part by `scale_ratio` along x, y and z; what is read back is in
    /// the part's own size.
    pub fn of(part: Part, job: &str, count: usize, scale_ratio: [f64; 3]) -> Result<Self, Error> {
        let name = format!("{job}_{}of{count:02}", part.id);
        let mut written = Self::writing(part.clone(), &name, 0, scale_ratio)?;
        for writing in 1..WRITINGS {
            if Crossings::of(&weld(&written.read_back)).pairs == 0 {
                break;
            }
            written = Self::writing(part.clone(), &name, writing, scale_ratio)?;
        }
        Ok(written)
    }

    /// The part in one of the writings tried.
    fn writing(
        mut part: Part,
        name: &str,
        writing: usize,
        scale_ratio: [f64; 3],
    ) -> Result<Self, Error> {
        let pose = &mut part.pose.print_from_model;
        let place = writing.saturating_sub(1);
        pose[0][3] += PLACE_STEP_MM[0] * place as f64;
        pose[1][3] += PLACE_STEP_MM[1] * place as f64;
        let pose = Pose { rows: *pose };
        let scale = Vector::from(scale_ratio);
        let laid = part
            .solid
            .mesh()
            .map_vertices(|p| pose.to_print(p).coords.component_mul(&scale).into());
        let laid = if writing > 0 { unfolded(&laid) } else { laid };
        let bytes = stl::encode(&laid, name);
        let read_back =
            stl::decode(&bytes)?.map_vertices(|p| p.coords.component_div(&scale).into());
        Ok(Self {
            part,
            file: format!("parts/{name}.stl"),
            bytes,
            read_back,
        })
    }

    /// The part as the judge sees it.
    pub fn evidence(&self) -> PartEvidence {
        let pose = Pose {
            rows: self.part.pose.print_from_model,
        };
        PartEvidence {
            id: self.part.id.clone(),
            mesh: self.read_back.clone(),
            pose,
        }
    }
}
