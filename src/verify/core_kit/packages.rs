//! The 3MF files of a kit: everything in its place, and the parts on their plates.

use super::evidence::CoreEvidence;
use super::panels::panel_body;
use crate::geom::Vector;
use crate::verify::Check;
use crate::verify::kind_packages::{Named, Packages};
use crate::verify::kit_folder::KitFolder;

/// The assembly.
const ASSEMBLY: &str = "assembly.3mf";

/// Checks all packages that a kit lists.
pub fn packages_check(folder: &KitFolder, evidence: &CoreEvidence) -> Check {
    let promise = &evidence.promise;
    let scale = Vector::from(promise.printer.print_scale_ratio.unwrap_or([1.0; 3]));
    let parts = || promise.parts.iter().zip(&evidence.parts);
    let printed = parts().map(|(part, mesh)| Named {
        name: part.id.clone(),
        body: mesh.map_vertices(|p| {
            let at = part.print_from_model.to_print(p);
            at.coords.component_mul(&scale).into()
        }),
    });
    let placed = parts().map(|(part, mesh)| Named {
        name: part.id.clone(),
        body: mesh.clone(),
    });
    let panels = (0..evidence.panels.panels.len()).map(|at| Named {
        name: format!("panel {}", at + 1),
        body: panel_body(evidence, at),
    });
    let rods = promise.rods.iter().map(|rod| Named {
        name: format!("rod {}", rod.name),
        body: rod.body(),
    });
    let packages = Packages {
        folder: folder.path,
        placed: vec![(ASSEMBLY, placed.chain(panels).chain(rods).collect())],
        printed: printed.collect(),
    };
    packages.check(promise.files.keys())
}
