//! `equipoise skeleton`: the curves inside a model, written for editing, with a picture of them.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::SkeletonArgs;
use super::exit::Exit;
use super::new_files::{NewFileError, check_free, write_all};
use super::show::table;
use super::signals::Stop;
use super::skeleton_picture::picture;
use super::voice::Voice;
use crate::base::toml_text::TextFault;
use crate::base::units::{format_count, show_mm};
use crate::base::watch::{Cancelled, Watch};
use crate::draw::PictureError;
use crate::goal::find_upright;
use crate::io::{ReadError, read_bytes, read_model};
use crate::mesh::{Defects, MeshFacts, Solid, scaled};
use crate::repair::{NotOneBody, one_body, repair};
use crate::skeleton::{Chain, Limbs, ShellSizes, Skeleton, SkeletonError};
use crate::telescope::prepare::choose_root;

/// The ending of a skeleton file.
const SKELETON_ENDING: &str = "toml";

/// A reason why no skeleton was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SkeletonCommandError {
    /// The model cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The model bounds no solid.
    #[error("{} is not a solid", path.display())]
    NotSolid {
        /// The model's file.
        path: PathBuf,
        /// The defects.
        source: Box<Defects>,
    },
    /// The model is not one body.
    #[error("{} is not one body", path.display())]
    NotOneBody {
        /// The model's file.
        path: PathBuf,
        /// The shells, or the places where it crosses itself.
        source: Box<NotOneBody>,
    },
    /// It has no skeleton.
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
    /// The skeleton file cannot be used.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// The picture cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] NewFileError),
    /// The command was stopped.
    #[error(transparent)]
    Stopped(#[from] Cancelled),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] io::Error),
    /// The facts cannot be put into JSON.
    #[error("the facts cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// The facts of a skeleton that are printed.
#[derive(Debug, Serialize)]
struct Findings {
    /// The skeleton file.
    file: PathBuf,
    /// The picture; `None` if a file was only checked.
    picture: Option<PathBuf>,
    nodes: usize,
    branches: usize,
    tips: Vec<u32>,
    rings: Vec<Vec<u32>>,
    /// The line that cuts all rings.
    open_line: Option<String>,
    /// The number of handles of the model; `None` if a file was only checked.
    genus: Option<i64>,
    root: u32,
    root_at_mm: [f64; 3],
    root_radius_mm: f64,
    limbs: Vec<LimbFacts>,
    solid: Vec<SolidFacts>,
}

/// A limb on which shells slide.
#[derive(Debug, Serialize)]
struct LimbFacts {
    from: u32,
    to: u32,
    free_mm: f64,
    radii_mm: [f64; 2],
    most_shells: usize,
}

/// A branch that stays solid.
#[derive(Debug, Serialize)]
struct SolidFacts {
    ends: [u32; 2],
    why: String,
}

/// Writes the skeleton of a model and its picture, or checks a skeleton file; says on `out` what is
/// in it.
pub fn skeleton(
    args: &SkeletonArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, SkeletonCommandError> {
    let is_text = args
        .model
        .extension()
        .is_some_and(|ending| ending == SKELETON_ENDING);
    let watch = Watch::silent_until(stop.flag());
    let found = if is_text {
        check(args)
    } else {
        write(args, &watch)
    };
    if found.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    let findings = found?;
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&findings)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&findings))?;
    }
    Ok(Exit::Kept)
}

/// Reads a skeleton file and returns what is in it.
fn check(args: &SkeletonArgs) -> Result<Findings, SkeletonCommandError> {
    let bytes = read_bytes(&args.model)?;
    let text = String::from_utf8_lossy(&bytes);
    let mut skeleton = Skeleton::from_toml(&args.model.to_string_lossy(), &text)?;
    choose_root(&mut skeleton, args.root)?;
    let mut findings = findings(&skeleton, &sizes(args));
    findings.file.clone_from(&args.model);
    Ok(findings)
}

/// Finds the skeleton of a model and writes it with its picture.
fn write(args: &SkeletonArgs, watch: &Watch) -> Result<Findings, SkeletonCommandError> {
    let file = args
        .out
        .clone()
        .unwrap_or_else(|| default_file(&args.model));
    let image = file.with_extension("svg");
    for path in [&file, &image] {
        check_free(path, args.force)?;
    }
    let solid = read_solid(args, watch)?;
    let sizes = sizes(args);
    let mut skeleton = Skeleton::of(&solid, watch)?;
    choose_root(&mut skeleton, args.root)?;
    skeleton.mark_solid(&solid, &sizes);
    let name = args.model.file_name().unwrap_or_default().to_string_lossy();
    let up = find_upright(&solid, watch)?.first().map(|pose| pose.up);
    let drawn = picture(&solid, &skeleton, up)?.to_file(&format!("the skeleton of {name}"));
    write_all([(&file, &skeleton.to_toml(&name)), (&image, &drawn)])?;
    let mut findings = findings(&skeleton, &sizes);
    findings.genus = MeshFacts::of(solid.mesh()).genus;
    (findings.file, findings.picture) = (file, Some(image));
    Ok(findings)
}

fn default_file(model: &Path) -> PathBuf {
    let stem = model.file_stem().unwrap_or_default().to_string_lossy();
    PathBuf::from(format!("{stem}-skeleton.{SKELETON_ENDING}"))
}

fn sizes(args: &SkeletonArgs) -> ShellSizes {
    ShellSizes {
        least_radius_mm: args.tip_radius.mm(),
        pitch_mm: args.shell_pitch.mm(),
    }
}

fn read_solid(args: &SkeletonArgs, watch: &Watch) -> Result<Solid, SkeletonCommandError> {
    let (mesh, _) = repair(read_model(&args.model)?, watch)?;
    let factor = args.scaling.scaling().factor(mesh.longest_side_mm());
    let path = || args.model.clone();
    let solid = Solid::new(scaled(&mesh, factor)).map_err(|defects| {
        let source = Box::new(Defects::of(&mesh).unwrap_or(defects));
        SkeletonCommandError::NotSolid {
            path: path(),
            source,
        }
    })?;
    one_body(&solid, watch)?.map_err(|source| SkeletonCommandError::NotOneBody {
        path: path(),
        source: Box::new(source),
    })?;
    Ok(solid)
}

/// Returns what is in a skeleton, for shells of these sizes.
fn findings(skeleton: &Skeleton, sizes: &ShellSizes) -> Findings {
    let id = |node: usize| skeleton.nodes[node].id;
    let root = &skeleton.nodes[skeleton.root];
    let limb = |chain: &Chain| LimbFacts {
        from: id(chain.nodes[0]),
        to: id(chain.nodes[chain.nodes.len() - 1]),
        free_mm: chain.free_mm(),
        radii_mm: [chain.start_mm, chain.end_mm].map(|arc_mm| chain.radius_at_mm(arc_mm)),
        most_shells: chain.most_shells(sizes),
    };
    let limbs = Limbs::of(skeleton, sizes).map_or(Vec::new(), |limbs| limbs.chains);
    let solid = skeleton.branches.iter().filter_map(|branch| {
        Some(SolidFacts {
            ends: [branch.nodes[0], branch.nodes[branch.nodes.len() - 1]].map(id),
            why: branch.solid?.to_string(),
        })
    });
    let ring = |ring: &crate::skeleton::Ring| ring.nodes.iter().map(|node| id(*node)).collect();
    Findings {
        file: PathBuf::new(),
        picture: None,
        nodes: skeleton.nodes.len(),
        branches: skeleton.branches.len(),
        tips: skeleton.tips().into_iter().map(id).collect(),
        rings: skeleton.rings().iter().map(ring).collect(),
        open_line: skeleton.open_line(),
        genus: None,
        root: root.id,
        root_at_mm: root.at.coords.into(),
        root_radius_mm: root.radius_mm,
        limbs: limbs.iter().map(limb).collect(),
        solid: solid.collect(),
    }
}

fn text(findings: &Findings) -> String {
    let tips = format_count(findings.tips.len(), "tip");
    let rings = format_count(findings.rings.len(), "ring");
    let mut rows = vec![[
        "skeleton".to_owned(),
        format!(
            "{}: {}, {}, {tips}, {rings}",
            findings.file.display(),
            format_count(findings.nodes, "node"),
            if findings.branches == 1 {
                "1 branch".to_owned()
            } else {
                format!("{} branches", findings.branches)
            },
        ),
    ]];
    let mut add = |head: &str, words: String| rows.push([head.to_owned(), words]);
    if let Some(picture) = &findings.picture {
        add("picture", picture.display().to_string());
    }
    let [x, y, z] = findings.root_at_mm;
    let radius = show_mm(findings.root_radius_mm);
    add(
        "root",
        format!(
            "node {} at ({x:.1}, {y:.1}, {z:.1}) mm, radius {radius}",
            findings.root
        ),
    );
    for limb in &findings.limbs {
        let [first, last] = limb.radii_mm.map(show_mm);
        add(
            "limb",
            format!(
                "{} to {}: {} long, radius {first} to {last}, up to {}",
                limb.from,
                limb.to,
                show_mm(limb.free_mm),
                format_count(limb.most_shells, "shell")
            ),
        );
    }
    for branch in &findings.solid {
        let [from, to] = branch.ends;
        add("stays solid", format!("{from} to {to}: {}", branch.why));
    }
    add_rings(findings, &mut add);
    table(&rows)
}

/// Adds the rings and the line that cuts them, and what is odd about their number.
fn add_rings(findings: &Findings, add: &mut impl FnMut(&str, String)) {
    for ring in &findings.rings {
        let (first, middle) = (ring[0], ring[ring.len() / 2]);
        let words = format!(
            "of {}, through {first} and {middle}",
            format_count(ring.len(), "node")
        );
        add("ring", words);
    }
    if let Some(line) = &findings.open_line {
        add(
            "to cut them",
            format!("write {line} into the skeleton file"),
        );
    }
    let found = i64::try_from(findings.rings.len()).unwrap_or(i64::MAX);
    if let Some(genus) = findings.genus.filter(|genus| *genus != found) {
        add(
            "look at it",
            format!("the model has {genus} holes through it, and the skeleton has {found} rings"),
        );
    }
    if findings.branches == 0 {
        add(
            "no limbs",
            "the model is one round body; nothing of it can slide out".to_owned(),
        );
    }
}
