//! Reading the kit of several telescopes from its folder, and the judgement of either kind of kit.

use std::path::Path;

use serde::Deserialize;

use super::evidence::TelescopeEvidence;
use super::juncture::{JuncturePartPromise, JuncturePromise};
use super::network::{LimbPromise, NETWORK_SCHEMA, NetworkEvidence, NetworkMotion, NetworkPromise};
use super::network_checks::network_checks;
use super::network_facts::judge_network;
use super::packages::network_packages_check;
use super::reading::{
    MOTION_FILE, TelescopeVerifyError, asked_points, mismatch, pose_files, read_nominal,
    read_parts, verify_curve,
};
use super::scene::network_scene_check;
use crate::base::watch::Watch;
use crate::geom::Vector;
use crate::io::read_model;
use crate::verify::kit_folder::{KitFolder, all_inside_kit};
use crate::verify::{
    CERTIFICATE_FILE, CHECKLIST_FILE, KindJudgement, KitFolderError, PartEvidence, SHEET_FILE,
};

/// The word of a kit of several telescopes.
const NETWORK: &str = "network";

/// Returns the file of a limb's curve, asked and made, in the kit of several telescopes.
pub fn limb_curve_file(limb: &str) -> String {
    format!("curves/{limb}.csv")
}

/// The key that tells one telescope from several.
#[derive(Deserialize)]
struct Head {
    kind: String,
}

/// Reads every file of the kit of a telescope, or of several on junctures, and judges it.
///
/// # Errors
/// There is no such kit in the folder, a file of it cannot be read, or the watch was stopped.
pub fn verify_telescope(
    folder: &Path,
    watch: &Watch,
) -> Result<KindJudgement, TelescopeVerifyError> {
    let folder = KitFolder { path: folder };
    let head: Head = folder.parsed(CHECKLIST_FILE)?;
    if head.kind != NETWORK {
        return verify_curve(&folder, watch);
    }
    let evidence = read(&folder)?;
    let facts = judge_network(&evidence, watch)?;
    let checks = network_checks(&evidence.promise, &facts);
    let papers = [CHECKLIST_FILE, SHEET_FILE, CERTIFICATE_FILE];
    let mut judgement = folder.judgement(checks, &evidence.promise.files, &papers)?;
    judgement
        .checks
        .push(network_packages_check(&folder, &evidence));
    judgement
        .checks
        .push(network_scene_check(&folder, &evidence));
    Ok(judgement)
}

fn read(folder: &KitFolder) -> Result<NetworkEvidence, TelescopeVerifyError> {
    let promise: NetworkPromise = folder.list_of_schema(CHECKLIST_FILE, NETWORK_SCHEMA)?;
    let motion: NetworkMotion = folder.list(MOTION_FILE)?;
    if let Some(why) = network_mismatch(&promise, &motion) {
        return Err(folder.mismatch(MOTION_FILE, why).into());
    }
    if let Some(why) = junctures_mismatch(&promise.junctures) {
        return Err(folder.mismatch(CHECKLIST_FILE, why).into());
    }
    let curves: Vec<String> = promise
        .limbs
        .iter()
        .map(|limb| limb_curve_file(&limb.id))
        .collect();
    refuse_outside(&promise, &curves)?;
    if !curves.iter().all(|curve| promise.files.contains_key(curve)) {
        let why = "it does not list the curve of every limb";
        return Err(folder.mismatch(CHECKLIST_FILE, why).into());
    }
    let limbs = promise.limbs.iter().zip(&motion.limbs).zip(&curves);
    let limbs = limbs.map(|((limb, motion), file)| {
        let asked = asked_points(&folder.bytes(file)?);
        let asked = asked.map_err(|fault| TelescopeVerifyError::Points {
            path: folder.path.join(file),
            fault,
        })?;
        let printed = read_parts(folder, &limb.sheet)?;
        Ok(TelescopeEvidence {
            promise: limb.sheet.clone(),
            motion: motion.clone(),
            parts: TelescopeEvidence::in_shells(&limb.sheet, &printed),
            printed,
            pose_files: Vec::new(),
            asked,
        })
    });
    let limbs = limbs.collect::<Result<Vec<_>, TelescopeVerifyError>>()?;
    let scale = promise.printer.print_scale_ratio.map(Vector::from);
    let part = |own: &JuncturePartPromise| {
        Ok(PartEvidence {
            id: own.id.clone(),
            mesh: read_nominal(folder, &own.file, scale)?,
            inner: Vec::new(),
            pose: own.print_from_model,
        })
    };
    let junctures = promise.junctures.iter();
    let junctures = junctures.map(|own| own.parts.iter().map(part).collect());
    let junctures: Result<Vec<Vec<PartEvidence>>, KitFolderError> = junctures.collect();
    let model = promise.model.as_ref();
    let model = model.map(|file| read_model(&folder.path.join(file)));
    Ok(NetworkEvidence {
        model: model.transpose().map_err(KitFolderError::from)?,
        junctures: junctures?,
        limbs,
        pose_files: pose_files(folder, &promise.poses)?,
        promise,
        motion,
    })
}

/// Refuses files that lie outside of the kit.
fn refuse_outside(promise: &NetworkPromise, curves: &[String]) -> Result<(), KitFolderError> {
    let of_limbs = promise.limbs.iter().flat_map(|limb| &limb.sheet.parts);
    let parts = of_limbs.map(|part| &part.file);
    let pieces = promise.junctures.iter().flat_map(|own| &own.parts);
    all_inside_kit(
        parts
            .chain(pieces.map(|part| &part.file))
            .chain(promise.files.keys())
            .chain(&promise.model)
            .chain(curves)
            .chain(promise.poses.iter().map(|pose| &pose.file)),
    )
}

/// Returns the reason why a motion is not that of the promises.
fn network_mismatch(promise: &NetworkPromise, motion: &NetworkMotion) -> Option<&'static str> {
    let count = promise.junctures.len();
    if promise.limbs.is_empty() || promise.limbs.len() != motion.limbs.len() {
        return Some("it has another number of limbs");
    }
    let limbs = promise.limbs.iter().zip(&motion.limbs);
    let mut whys = limbs.map(|(limb, motion)| mismatch(&limb.sheet, motion));
    if let Some(why) = whys.find_map(|why| why) {
        return Some(why);
    }
    if !is_tree(&promise.limbs, count) {
        return Some("its limbs and junctures are no tree");
    }
    let fits = |states: &Vec<Vec<[f64; 2]>>| {
        let joints = motion.limbs.iter().map(|limb| limb.joints.len());
        states.iter().map(Vec::len).eq(joints)
    };
    let is_keyed = !motion.keys.is_empty() && motion.keys.iter().all(|key| fits(&key.states));
    if !is_keyed {
        return Some("its keys do not fit its joints");
    }
    let names: Vec<&String> = promise.limbs.iter().map(|limb| &limb.id).collect();
    let is_told = promise.order == motion.order && motion.opens_in_order(&names);
    (!is_told).then_some("its keys do not open the limbs in the order of the sheet")
}

/// Returns the reason why junctures are not as this program writes them.
fn junctures_mismatch(junctures: &[JuncturePromise]) -> Option<&'static str> {
    if junctures.iter().any(|own| own.parts.is_empty()) {
        return Some("a juncture has no part");
    }
    let is_told = |own: &JuncturePromise| (own.parts.len() > 1) == own.divided.is_some();
    let is_told = junctures.iter().all(is_told);
    (!is_told).then_some("a juncture in several parts states no cuts, or one in one part does")
}

/// Returns true if every juncture but the first is carried by one limb.
///
/// That limb grows from a juncture that is reached before.
fn is_tree(limbs: &[LimbPromise], count: usize) -> bool {
    let mut is_reached = vec![false; count];
    if let Some(first) = is_reached.first_mut() {
        *first = true;
    }
    let steps = limbs.iter().all(|limb| {
        let from = limb
            .from
            .checked_sub(1)
            .and_then(|from| is_reached.get(from));
        let is_known = from.copied().unwrap_or(false);
        let to = limb.to.checked_sub(1).and_then(|to| is_reached.get_mut(to));
        match to {
            Some(to) if is_known && !*to => {
                *to = true;
                true
            }
            _ => false,
        }
    });
    steps && is_reached.iter().all(|reached| *reached)
}
