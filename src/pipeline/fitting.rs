//! The hardware of a run: put in before anything is solved, and told of afterwards.

use super::{Error, Setup, stopwatch::Stopwatch, written::WrittenPart};
use crate::base::units::{MM3_PER_CM3, show_mm};
use crate::hardware::{Allowances, Fitted, Kind, Piece, fitted};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{TriMesh, bodies, winding_number};
use crate::verify::Hardware;

/// The setup with its hardware put in, where the job has any: from then on the model is the one
/// with the sockets, and the goal's moments count what is not printed.
pub fn equipped(setup: Setup, watch: &mut Stopwatch) -> Result<Setup, Error> {
    let Some(hardware) = setup.request.hardware else {
        return Ok(setup);
    };
    let allowances = Allowances {
        clearance_mm: setup.printer.clearance_per_side_mm.value,
        wall_mm: setup.wall.wall_mm,
    };
    let fitted = fitted(
        &setup.model.solid,
        &setup.placement.goal,
        &hardware,
        &allowances,
    )?;
    watch.lap("hardware");
    Ok(fitted.map_or(setup.clone(), |fitted| with(setup, fitted)))
}

fn with(mut setup: Setup, fitted: Fitted) -> Setup {
    let bare = std::mem::replace(&mut setup.model.solid, fitted.solid.clone());
    setup.fitted = Some(fitted);
    setup.bare = Some(bare);
    let whole = moments_of_mesh(setup.model.solid.mesh()) + setup.hardware_moments();
    let goal = &mut setup.placement.goal;
    goal.solid = whole.in_frame(&goal.frame);
    setup
}

impl Setup {
    /// The moments of what is not printed, as so much of the material, model frame; zero without
    /// hardware.
    pub fn hardware_moments(&self) -> Moments {
        let density_g_cm3 = self.material.density_g_cm3.value;
        self.fitted
            .as_ref()
            .map_or(Moments::default(), |fitted| fitted.moments(density_g_cm3))
    }

    /// The hardware as the judge sees it.
    pub fn hardware(&self) -> Vec<Hardware> {
        let pieces = self.fitted.iter().flat_map(|fitted| &fitted.pieces);
        pieces
            .enumerate()
            .map(|(index, piece)| seen(index, piece))
            .collect()
    }

    /// How far the halves of a yo-yo are apart, mm; none where there is one body.
    pub fn string_gap_mm(&self) -> Option<f64> {
        self.fitted
            .as_ref()
            .map(|fitted| fitted.gap_mm)
            .filter(|gap_mm| *gap_mm > 0.0)
    }
}

/// What to mind of an axle that goes in by less than its diameter, where the model is thin.
pub fn shallow_axle(setup: &Setup) -> Option<String> {
    let pieces = setup.fitted.iter().flat_map(|fitted| &fitted.pieces);
    let axle = pieces.into_iter().find(|piece| piece.kind == Kind::Axle)?;
    let (depth_mm, diameter_mm) = (axle.depth_mm, 2.0 * axle.bar.radius_mm);
    let words = || {
        let depth = show_mm(depth_mm);
        format!(
            "the axle goes {depth} deep into each half, less than its diameter: the model is thin at the spin point; glue it well, or take a thinner axle"
        )
    };
    (depth_mm < diameter_mm).then(words)
}

/// The halves of a yo-yo, the one above the spin point first; none where there is one body.
pub fn halves(setup: &Setup) -> Vec<TriMesh> {
    if setup.string_gap_mm().is_none() {
        return Vec::new();
    }
    let axis = setup.placement.goal.frame.axis();
    let height = |half: &TriMesh| axis.dot(&moments_of_mesh(half).centroid().coords);
    let mut halves = bodies(setup.model.solid.mesh());
    halves.sort_by(|a, b| height(b).total_cmp(&height(a)));
    halves
}

/// Corners of a part that are looked at to tell its half.
const LOOKS: usize = 8;

/// The half that holds the corners of a part: about those on a surface it winds in part, the other
/// not at all.
pub fn half_of(written: &WrittenPart, halves: &[TriMesh]) -> Option<String> {
    let corners = written.part.solid.mesh().vertices();
    let looks = || corners.iter().step_by(corners.len().div_ceil(LOOKS).max(1));
    let share = |half: &TriMesh| looks().map(|p| winding_number(half, p)).sum::<f64>();
    let shares = halves.iter().map(share).zip(["A", "B"]);
    shares
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, half)| half.to_owned())
}

fn seen(index: usize, piece: &Piece) -> Hardware {
    let bar = &piece.bar;
    Hardware {
        id: format!("H{}", index + 1),
        what: piece.kind.word().to_owned(),
        from_mm: bar.from.into(),
        to_mm: bar.to.into(),
        diameter_mm: 2.0 * bar.radius_mm,
        hole_mm: 2.0 * bar.hole_mm,
        round_end: bar.is_round,
        density_g_cm3: piece.density_g_cm3,
        mass_g: bar.moments().volume() * piece.density_g_cm3 / MM3_PER_CM3,
        depth_mm: piece.depth_mm,
        socket_mm: piece.bore_mm,
    }
}
