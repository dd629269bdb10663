//! Writing a part: its STL file in memory, read back, free of folds.

use crate::base::watch::Watch;
use crate::cut::{Jig, JointId, Part};
use crate::error::Error;
use crate::geom::Vector;
use crate::io::stl;
use crate::mesh::{Crossings, TriMesh};
use crate::repair::unfold;
use crate::run::{Placed, WrittenJig, WrittenPart};
use crate::verify::Pose;

/// Writings that are tried until a part's file is free of folds. The first is the part as it is,
/// the second unfolded, the others unfolded at other places on the plate. Each place folds another
/// sliver of a thousand.
const WRITINGS: usize = 7;
/// Step from one place to the next, mm: far less than a part's room on the plate, and no multiple
/// of a file's steps.
const PLACE_STEP_MM: [f64; 2] = [0.013_7, 0.009_1];

/// Writes a part and reads it back.
///
/// It lies at the first place on the plate where the rounding of the file's coordinates folds no
/// sliver of its surface. The file is larger than the part by `scale_ratio` along x, y and z; what
/// is read back is in the part's own size.
///
/// # Errors
/// The file does not read back, or the watch was stopped.
pub fn write(
    part: Part,
    name: &str,
    scale_ratio: [f64; 3],
    watch: &Watch,
) -> Result<WrittenPart, Error> {
    let writer = Writer {
        name,
        scale: Vector::from(scale_ratio),
        watch,
    };
    let mut written = writer.write(part.clone(), 0)?;
    for writing in 1..WRITINGS {
        if Crossings::of_watched(&written.read_back, watch)?.pairs == 0 {
            break;
        }
        written = writer.write(part.clone(), writing)?;
    }
    Ok(written)
}

/// Writes a jig and reads it back, in the size in which the printer makes it right.
///
/// # Errors
/// The file does not read back, or the watch was stopped.
pub fn write_jig(placed: &Placed, jig: Jig, watch: &Watch) -> Result<WrittenJig, Error> {
    let scale = Vector::from(placed.shop.printer.print_scale_ratio());
    let pose = Pose {
        rows: jig.print_from_model,
    };
    let mesh = jig.solid.mesh();
    let laid = mesh.map_vertices(|p| pose.to_print(p).coords.component_mul(&scale).into());
    let name = format!("{}_jig-{}", placed.name(), JointId::of(jig.joint));
    let bytes = write_free_of_folds(&laid, &name, watch)?;
    let read_back = stl::decode(&bytes)?;
    Ok(WrittenJig {
        jig,
        file: format!("jigs/{name}.stl"),
        bytes,
        read_back: read_back.map_vertices(|p| p.coords.component_div(&scale).into()),
    })
}

/// Returns the bytes of a mesh's STL file: as it is, or unfolded if rounding folds it.
///
/// # Errors
/// The file does not read back, or the watch was stopped.
pub fn write_free_of_folds(mesh: &TriMesh, name: &str, watch: &Watch) -> Result<Vec<u8>, Error> {
    let bytes = stl::encode(mesh, name);
    let is_folded = Crossings::of_watched(&stl::decode(&bytes)?, watch)?.pairs > 0;
    if is_folded {
        return Ok(stl::encode(&unfold(mesh, watch)?, name));
    }
    Ok(bytes)
}

/// Writes a part again and again.
struct Writer<'a> {
    name: &'a str,
    /// Size of the file over that of the part, along x, y and z.
    scale: Vector,
    watch: &'a Watch,
}

impl Writer<'_> {
    /// Writes a part in one of the writings.
    fn write(&self, mut part: Part, writing: usize) -> Result<WrittenPart, Error> {
        let Self { name, scale, watch } = self;
        let rows = &mut part.pose.print_from_model;
        let place = writing.saturating_sub(1);
        rows[0][3] += PLACE_STEP_MM[0] * place as f64;
        rows[1][3] += PLACE_STEP_MM[1] * place as f64;
        let pose = Pose { rows: *rows };
        let mesh = part.solid.mesh();
        let laid = mesh.map_vertices(|p| pose.to_print(p).coords.component_mul(scale).into());
        let laid = if writing > 0 {
            unfold(&laid, watch)?
        } else {
            laid
        };
        watch.check()?;
        let bytes = stl::encode(&laid, name);
        let read_back = stl::decode(&bytes)?;
        Ok(WrittenPart {
            part,
            file: format!("parts/{name}.stl"),
            bytes,
            sparse: None,
            read_back: read_back.map_vertices(|p| p.coords.component_div(scale).into()),
        })
    }
}
