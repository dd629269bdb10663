//! The kit of a network in memory: its files, its checklist, its pages and pictures.

use std::path::Path;

use serde::Serialize;

use super::super::animate::motion_scene;
use super::super::error::TelescopeRunError;
use super::draft::{MadeNetwork, NetworkDraft};
use super::film::moving;
use super::made::Workshop;
use super::posing::joints;
use crate::base::watch::Phase;
use crate::draw::part_color;
use crate::geom::{Frame, Matrix, Vector};
use crate::io::threemf::{Build, Object, Package, Transform};
use crate::job::ModelChoice;
use crate::kit::Kit;
use crate::make::{Arrangement, File, plates, print_settings};
use crate::mesh::TriMesh;
use crate::page::{
    NetworkPage, NetworkView, ShownBody, draw_network, network_certificate, network_job,
};
use crate::sheet::network::{LimbRow, NetworkSheet};
use crate::sheet::telescope::ShellRow;
use crate::telescope::motion::Key;
use crate::telescope::prepare::made::from_print;
use crate::verify::{
    CERTIFICATE_FILE, MODEL_FILE, MODEL_FOLDER, MOTION_FILE, MOTION_SCENE_FILE, Pose, SHEET_FILE,
    limb_curve_file,
};
use crate::wing::{Papers, Prepared, Unwritable};

/// File of the job in a kit.
const JOB: &str = "job.toml";
/// File of the telescopes as plain data in a kit.
const TELESCOPE: &str = "telescope.toml";
/// File of the skeleton in a kit, for editing.
const SKELETON: &str = "skeleton.toml";

/// Puts a judged kit together, with its pages.
pub fn finish(
    workshop: &Workshop,
    made: &MadeNetwork,
    draft: NetworkDraft,
) -> Result<Prepared<NetworkSheet>, TelescopeRunError> {
    workshop.watch.enter(Phase::Report);
    let mut kit = Kit::default();
    for part in made.limbs.iter().flat_map(|limb| &limb.parts) {
        kit.add(&part.file, part.bytes.clone());
    }
    for part in made.junctures.iter().flat_map(|own| &own.parts) {
        kit.add(&part.file, part.bytes.clone());
    }
    for (file, bytes) in packages(workshop, made)? {
        kit.add(&file, bytes);
    }
    let moving = moving(workshop, made)?;
    let stage = moving.stage(workshop.watch)?;
    kit.add(MOTION_FILE, draft.motion_json.into_bytes());
    let scene = motion_scene(&workshop.job.name(), &moving)?;
    kit.add(MOTION_SCENE_FILE, scene);
    if let Some(model) = draft.model_stl {
        kit.add(MODEL_FILE, model);
    }
    for (limb, curve) in draft.sheet.limbs.iter().zip(draft.curves) {
        kit.add(&limb_curve_file(&limb.id), curve.into_bytes());
    }
    for (file, text) in made.written_poses(&joints(&made.limbs)).files() {
        kit.add(&file, text.into_bytes());
    }
    kit.add(TELESCOPE, telescope_toml(&draft.sheet)?.into_bytes());
    let skeleton = made.tree.skeleton.to_toml(&workshop.job.name());
    kit.add(SKELETON, skeleton.into_bytes());
    let mut job = workshop.job.in_kit();
    let file = &workshop.loaded.file;
    job.curve.sha256 = Some(file.sha256.clone());
    let copy = ModelChoice::copy_name(Path::new(&job.curve.source), &job.name());
    kit.add(&format!("{MODEL_FOLDER}{copy}"), file.bytes.clone());
    kit.add(JOB, job.to_toml()?.into_bytes());
    let pictures = draw_network(&view(workshop, made))?;
    for picture in &pictures {
        kit.add(&picture.file, picture.bytes());
    }
    workshop.watch.check()?;
    let papers = Papers::listed(kit, draft.sheet)?;
    let page = NetworkPage {
        sheet: &papers.sheet,
        sha256: &papers.sha256,
        pictures: &pictures,
        view: Some(&stage),
    };
    let (job, certificate) = (network_job(&page), network_certificate(&page));
    Ok(papers.sealed([(SHEET_FILE, job), (CERTIFICATE_FILE, certificate)]))
}

/// The telescopes as plain data: `telescope.toml`.
#[derive(Serialize)]
struct Written<'a> {
    kind: &'static str,
    order: &'a [String],
    limb: Vec<WrittenLimb<'a>>,
}

#[derive(Serialize)]
struct WrittenLimb<'a> {
    id: &'a str,
    from: usize,
    to: usize,
    overlap_mm: f64,
    clearance_mm: f64,
    wall_mm: f64,
    order: &'a [Vec<String>],
    turns_deg: Vec<f64>,
    shells: &'a [ShellRow],
}

fn telescope_toml(sheet: &NetworkSheet) -> Result<String, TelescopeRunError> {
    let limb = |limb: &'_ LimbRow| {
        limb.sheet
            .joint_rows
            .iter()
            .map(|row| row.turn_deg)
            .collect()
    };
    let limbs = sheet.limbs.iter().map(|own| WrittenLimb {
        id: &own.id,
        from: own.from,
        to: own.to,
        overlap_mm: own.sheet.joint_sizes.overlap_mm,
        clearance_mm: own.sheet.clearance_mm,
        wall_mm: own.sheet.wall_mm,
        order: &own.sheet.order,
        turns_deg: limb(own),
        shells: &own.sheet.shells,
    });
    let written = Written {
        kind: "network",
        order: &sheet.order,
        limb: limbs.collect(),
    };
    let text = toml::to_string(&written);
    Ok(text.map_err(|error| Unwritable::new(TELESCOPE, &error))?)
}

/// A part with its colour, its pose and its mesh in print pose.
struct Printed<'a> {
    id: &'a str,
    color: usize,
    pose: &'a Pose,
    mesh: TriMesh,
}

/// Returns all parts in the size that is printed: the limbs' first, then the junctures.
fn printed<'a>(made: &'a MadeNetwork, scale: &Vector) -> Vec<Printed<'a>> {
    let sized = |mesh: &TriMesh| mesh.map_vertices(|p| p.coords.component_mul(scale).into());
    let limbs = made.limbs.iter().flat_map(|limb| &limb.parts);
    let limbs = limbs.map(|part| Printed {
        id: &part.id,
        color: part.shell + 1,
        pose: &part.pose,
        mesh: sized(&part.read_back),
    });
    let pieces = made.junctures.iter().flat_map(|own| &own.parts);
    let junctures = pieces.map(|own| Printed {
        id: &own.id,
        color: 0,
        pose: &own.pose,
        mesh: sized(&own.read_back),
    });
    limbs.chain(junctures).collect()
}

/// Returns the plates, and the parts together, all in and all out.
fn packages(workshop: &Workshop, made: &MadeNetwork) -> Result<Vec<File>, TelescopeRunError> {
    let printer = &workshop.shop.printer;
    let scale = Vector::from(printer.print_scale_ratio());
    let parts = printed(made, &scale);
    let objects: Vec<Object> = parts
        .iter()
        .map(|part| Object::new(part.id, part_color(part.color), &part.mesh))
        .collect();
    let meshes: Vec<TriMesh> = parts.iter().map(|part| part.mesh.clone()).collect();
    let keys = made.keys();
    let ends = [
        ("collapsed.3mf", "all in", keys.first()),
        ("extended.3mf", "all out", keys.last()),
    ];
    let name = workshop.job.name();
    let poses: Vec<&Pose> = parts.iter().map(|part| part.pose).collect();
    let together = ends.into_iter().filter_map(|(file, words, key)| {
        let frames = frames(made, key?);
        let unscaled = scale.map(f64::recip);
        let places = frames.iter().zip(&poses).enumerate();
        let places = places.map(|(index, (frame, pose))| {
            (
                index,
                placed(&frame.frame_to_model(&from_print(pose)), &unscaled),
            )
        });
        let description = format!("The telescopes, {words}, in the axes of the model.");
        let build = Build::Assembly(name.clone(), places.collect());
        Some((file.to_owned(), (description, build)))
    });
    let jobs: Vec<(String, Arrangement)> = together.chain(plates(printer, &meshes)).collect();
    let jobs = jobs.into_iter().map(|(file, (description, build))| {
        let title = file.trim_end_matches(".3mf");
        let package = Package {
            title: format!("{name} {title}"),
            description,
            job: name.clone(),
            objects: &objects,
            build,
            settings: print_settings(printer),
        };
        Ok((file, package.encode()?))
    });
    jobs.collect()
}

fn placed(frame: &Frame, unscaled: &Vector) -> Transform {
    let size = Transform {
        linear: Matrix::from_diagonal(unscaled),
        shift: Vector::zeros(),
    };
    size.then(&Transform {
        linear: frame.axes,
        shift: frame.origin.coords,
    })
}

/// Returns the frame of every part in a state, in the order of the printed ones.
fn frames(made: &MadeNetwork, state: &[Key]) -> Vec<Frame> {
    let frames = made.tree.network.frames(state);
    let limbs = made.limbs.iter().zip(&frames.shells);
    let shells = limbs.flat_map(|(limb, frames)| limb.parts.iter().map(|part| frames[part.shell]));
    let junctures = made.junctures.iter().zip(&frames.junctures);
    let pieces = junctures.flat_map(|(own, frame)| own.parts.iter().map(|_| *frame));
    shells.chain(pieces).collect()
}

fn view(workshop: &Workshop, made: &MadeNetwork) -> NetworkView {
    let keys = made.keys();
    let state = |key: Option<&Vec<Key>>| made.placed(key.unwrap_or(&keys[0]));
    let shells = made.limbs.iter().flat_map(|limb| &limb.parts);
    let shells = shells.map(|part| ShownBody {
        id: part.id.clone(),
        color: part.shell + 1,
        is_named: false,
    });
    let pieces = made.junctures.iter().flat_map(|own| &own.parts);
    let roots = pieces.map(|own| ShownBody {
        id: own.id.clone(),
        color: 0,
        is_named: true,
    });
    let bodies: Vec<ShownBody> = shells
        .chain(roots)
        .map(|own| named_root(own, made))
        .collect();
    NetworkView {
        bodies,
        collapsed: state(keys.first()),
        half: state(keys.get(keys.len() / 2)),
        extended: state(keys.last()),
        poses: made
            .poses
            .iter()
            .map(|posed| (posed.name.clone(), state(posed.keys.last())))
            .collect(),
        up: workshop.loaded.up,
        junctures: made.junctures.iter().map(|own| own.parts.len()).collect(),
    }
}

/// Names a limb by its second shell, which is the first that is seen.
fn named_root(own: ShownBody, made: &MadeNetwork) -> ShownBody {
    let mut limbs = made.limbs.iter();
    let is_second = limbs.any(|limb| limb.shell_id(1) == own.id);
    ShownBody {
        is_named: own.is_named || is_second,
        ..own
    }
}
