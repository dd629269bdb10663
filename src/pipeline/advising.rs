//! What a run asks of the advice: the axis where it was left open, and remedies where its goal is
//! impossible.

use super::{Failure, Impossible, Prepared, Setup, phase, setup::Model};
use crate::advice::{Case, Remedy, best_orientation, remedies};
use crate::base::numbers::quantity;
use crate::base::watch::Watch;
use crate::goal::{GoalKind, Request, Up};
use crate::printer::{Material, Printer, WallChoice};
use crate::verify::Check;

/// What to do where hardware is in the way: the remedies are sought on models as they are.
const BARE: &str =
    "leave the hardware out, to be told by how much the model as it is can or cannot";

/// What a case is made of besides the request.
#[derive(Debug, Clone, Copy)]
pub struct Means<'a> {
    /// The model.
    pub model: &'a Model,
    /// The printer.
    pub printer: &'a Printer,
    /// What it prints.
    pub material: &'a Material,
    /// The wall that is printed.
    pub wall: &'a WallChoice,
}

impl<'a> Means<'a> {
    fn case(self, request: Request) -> Case<'a> {
        Case {
            solid: &self.model.solid,
            request,
            wall_mm: self.wall.wall_mm,
            least_wall_mm: self.printer.min_wall_mm.value,
            wall_step_mm: self.wall.step_mm,
            density_g_cm3: self.material.density_g_cm3.value,
            greatest_size_mm: self.printer.greatest_length_mm(),
        }
    }

    /// A request with its axis settled, and the sentence on how it was, if it had been left open.
    pub fn settled(self, request: &Request) -> (Request, Option<String>) {
        if request.up != Up::Auto {
            return (*request, None);
        }
        if let Some(best) = best_orientation(&self.case(*request)) {
            let choice = format!(
                "--up={} was chosen: of {} axes tried {} allow it; on this one, the best near any of them, it {}",
                best.request.up, best.tried, best.possible, best.reached
            );
            return (best.request, Some(choice));
        }
        let up = if request.kind == GoalKind::Stand {
            Up::Z
        } else {
            Up::Principal
        };
        let choice = format!("no axis that was tried allows it; this is for --up={up}");
        (Request { up, ..*request }, Some(choice))
    }
}

/// The answer that the goal is impossible, with what would help.
pub fn advised(setup: &Setup, impossible: Impossible, progress: &Watch) -> Impossible {
    if setup.job.fill.is_some() {
        // The searches know of air only.
        return impossible;
    }
    progress.report(phase::ADVISE, 0.0);
    if setup.fitted.is_some() {
        let hints = impossible
            .hints
            .into_iter()
            .chain([BARE.to_owned()])
            .collect();
        return Impossible {
            hints,
            ..impossible
        };
    }
    let Setup {
        model,
        printer,
        material,
        wall,
        ..
    } = setup;
    let remedies = remedies(
        &Means {
            model,
            printer,
            material,
            wall,
        }
        .case(setup.request),
    );
    let hints = if remedies.iter().any(Remedy::helps) {
        Vec::new()
    } else {
        impossible.hints
    };
    Impossible {
        remedies,
        hints,
        ..impossible
    }
}

/// What is worth a try where a promise is broken, by the beginning of its check's name.
const HINTS: [(&str, &str); 8] = [
    ("standing", "lay ballast into its foot (--ballast=auto)"),
    (
        "axis",
        "a finer --pitch brings the written parts nearer to the optimum",
    ),
    (
        "dominance",
        "spin it about the axis of its largest moment (--up=principal, or --up=auto for the best of all)",
    ),
    (
        "wall",
        "give a thicker --wall, so that what is lost at sharp edges does not count",
    ),
    (
        "build volume",
        "make it smaller (--size), or choose a printer with more room",
    ),
    (
        "void",
        "make it larger with the same wall, or give the cuts yourself: edit cuts.toml and give it back with --cut",
    ),
    (
        "socket wall",
        "give a thicker --wall, or align the parts by dowels (--pins=dowel)",
    ),
    ("waterline", "leave the waterline free (--waterline=auto)"),
];
/// What helps most goals a little.
const MORE_ROOM: &str = "make it larger with the same wall, or the wall thinner: either leaves the solver more to choose from";

/// A kit with the reason why it fails and what helps, where it does.
pub fn after(setup: &Setup, prepared: Prepared, progress: &Watch) -> Prepared {
    if prepared.passes() {
        return prepared;
    }
    progress.report(phase::ADVISE, 0.0);
    let checks = &prepared.checklist.checks;
    let broken: Vec<&Check> = checks.iter().filter(|check| !check.pass).collect();
    let stands = broken.iter().any(|check| check.name == "standing");
    let hints = HINTS
        .iter()
        .filter(|(name, _)| broken.iter().any(|check| check.name.starts_with(name)));
    let hints = hints
        .map(|(_, hint)| *hint)
        .chain([MORE_ROOM])
        .map(str::to_owned)
        .collect();
    let remedies = if stands {
        other_faces(setup)
    } else {
        Vec::new()
    };
    let failure = Some(Failure {
        reason: reason(&prepared, &broken),
        remedies,
        hints,
    });
    Prepared {
        failure,
        ..prepared
    }
}

/// What the goal could have reached, and what became of it.
fn reason(prepared: &Prepared, broken: &[&Check]) -> String {
    let proof = &prepared.checklist.certificate;
    let names: Vec<&str> = broken.iter().map(|check| check.name.as_str()).collect();
    let unit = proof.figure.unit();
    match proof.written_value {
        Some(written) => format!(
            "the kit breaks {}: the best void there is reaches a {} of {}, and of that the parts that can be made keep {}; what \
             pins, cuts and cleaning take is more than there is to spare",
            names.join(", "),
            proof.figure.name(),
            quantity(proof.bound, unit),
            quantity(written, unit)
        ),
        None => format!("the kit breaks {}", names.join(", ")),
    }
}

/// The nearest other face that it surely stands on.
fn other_faces(setup: &Setup) -> Vec<Remedy> {
    let Setup {
        model,
        printer,
        material,
        wall,
        ..
    } = setup;
    let found = remedies(
        &Means {
            model,
            printer,
            material,
            wall,
        }
        .case(setup.request),
    );
    let is_face =
        |remedy: &Remedy| remedy.kind == crate::advice::Kind::NearestFace && remedy.helps();
    found.into_iter().filter(is_face).collect()
}
