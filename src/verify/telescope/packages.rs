//! The 3MF files of a telescope: the parts all in, all out, and on their plates.

use super::evidence::TelescopeEvidence;
use super::juncture::Piece;
use super::motion::MotionKey;
use super::network::{NetworkEvidence, NetworkKey};
use crate::geom::Vector;
use crate::mesh::TriMesh;
use crate::verify::Check;
use crate::verify::kind_packages::{Named, Packages};
use crate::verify::kit_folder::KitFolder;

/// The file of shells that are printed in each other.
pub const NESTED_FILE: &str = "in-place.3mf";
/// The name of their one object.
pub const NESTED_NAME: &str = "in-place";

/// Checks all packages that a kit lists.
pub fn packages_check(folder: &KitFolder, evidence: &TelescopeEvidence) -> Check {
    let promise = &evidence.promise;
    let scale = Vector::from(promise.printer.print_scale_ratio.unwrap_or([1.0; 3]));
    let parts = promise.parts.iter().zip(&evidence.parts);
    let printed = parts.map(|(part, mesh)| Named {
        name: part.id.clone(),
        body: mesh.map_vertices(|p| {
            let at = part.print_from_shell.to_print(p);
            at.coords.component_mul(&scale).into()
        }),
    });
    let keys = &evidence.motion.keys;
    let ends = [
        ("collapsed.3mf", keys.first()),
        ("extended.3mf", keys.last()),
    ];
    let placed = ends
        .into_iter()
        .filter_map(|(file, key)| Some((file, together(evidence, key?))));
    let mut packages = Packages {
        folder: folder.path,
        placed: placed.collect(),
        printed: printed.collect(),
    };
    if promise.in_place {
        // One package holds all shells as they are printed, in each other, as one object.
        let printed = std::mem::take(&mut packages.printed);
        let bodies = printed.iter().map(|part| &part.body);
        let nested = Named {
            name: NESTED_NAME.to_owned(),
            body: bodies.fold(TriMesh::default(), |all, part| all.joined(part)),
        };
        packages.placed.push((NESTED_FILE, vec![nested]));
    }
    packages.check(promise.files.keys())
}

/// Returns the parts in their places at a key of the motion.
fn together(evidence: &TelescopeEvidence, key: &MotionKey) -> Vec<Named> {
    let frames = evidence.motion.frames(&key.states);
    let parts = evidence.promise.parts.iter().zip(&evidence.parts);
    let placed = parts.map(|(part, mesh)| {
        let frame = &frames[part.shell - 1];
        Named {
            name: part.id.clone(),
            body: mesh.map_vertices(|p| frame.to_model(p)),
        }
    });
    placed.collect()
}

/// Checks all packages that the kit of several telescopes lists.
pub fn network_packages_check(folder: &KitFolder, evidence: &NetworkEvidence) -> Check {
    let promise = &evidence.promise;
    let scale = Vector::from(promise.printer.print_scale_ratio.unwrap_or([1.0; 3]));
    let limbs = evidence.limbs.iter().flat_map(|limb| {
        let parts = limb.promise.parts.iter().zip(&limb.parts);
        parts.map(|(part, mesh)| (&part.id, &part.print_from_shell, mesh))
    });
    let pieces: Vec<Piece> = evidence.pieces().collect();
    let junctures = pieces.iter().map(|piece| {
        let own = piece.promise;
        (&own.id, &own.print_from_model, &piece.mesh)
    });
    let printed = limbs.chain(junctures).map(|(id, pose, mesh)| Named {
        name: id.clone(),
        body: mesh.map_vertices(|p| pose.to_print(p).coords.component_mul(&scale).into()),
    });
    let keys = &evidence.motion.keys;
    let ends = [
        ("collapsed.3mf", keys.first()),
        ("extended.3mf", keys.last()),
    ];
    let placed = ends
        .into_iter()
        .filter_map(|(file, key)| Some((file, all_together(evidence, key?))));
    let packages = Packages {
        folder: folder.path,
        placed: placed.collect(),
        printed: printed.collect(),
    };
    packages.check(promise.files.keys())
}

/// Returns the parts of several telescopes in their places at a key.
fn all_together(evidence: &NetworkEvidence, key: &NetworkKey) -> Vec<Named> {
    let places = evidence.places(&key.states);
    let limbs = evidence.limbs.iter().zip(&places.shells);
    let shells = limbs.flat_map(|(limb, frames)| {
        let parts = limb.promise.parts.iter().zip(&limb.parts);
        parts.map(|(part, mesh)| (&part.id, &frames[part.shell - 1], mesh))
    });
    let pieces: Vec<Piece> = evidence.pieces().collect();
    let junctures = pieces.iter().map(|piece| {
        let frame = &places.junctures[piece.juncture];
        (&piece.promise.id, frame, &piece.mesh)
    });
    let all = shells.chain(junctures).map(|(id, frame, mesh)| Named {
        name: id.clone(),
        body: mesh.map_vertices(|p| frame.to_model(p)),
    });
    all.collect()
}
