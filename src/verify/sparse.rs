//! Sparse infill in one piece, as a kit declares it: its regions, and what they weigh.

use serde::{Deserialize, Serialize};

use crate::base::units::MM3_PER_CM3;
use crate::geom::{Frame, Vector};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::TriMesh;

use super::PRINTED_CENTER_LIMIT_MM;

/// The regions of sparse infill in a print of one piece.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InfillOrder {
    /// The pattern of the infill, in the words of slicers.
    pub pattern: String,
    /// The density to set in the slicer for the outermost regions, over that of solid print.
    pub nominal_ratio: f64,
    /// The density that is laid there, over that of solid print.
    pub laid_ratio: f64,
    /// Number of the outermost regions: the closed cavities of the part.
    pub regions: usize,
    /// Their volume with all that lies in them, mm³.
    pub volume_mm3: f64,
    /// The mass laid at their density, g; without that of the regions in them.
    pub mass_g: f64,
    /// The infill that the slicer was seen to lay, over what the printer's profile says of it. The
    /// densities that are laid count with it; `None` for the profile's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slicer_ratio: Option<f64>,
    /// The moments of what a slicer lays beyond this, in the model frame, mm³ to mm⁵. They are
    /// those of 1, x, y, z, xy, yz, xz, x², y² and z². `None` if it was not asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beyond: Option<[f64; 10]>,
    /// The distances between the centre of the toolpaths and the promised one, round by round, mm.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub misses_mm: Vec<f64>,
    /// The file that bounds them, relative to the kit; `None` if they are in the part's file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The field of densities that the regions follow, in words that `inspect` reads; `None` if
    /// they are the best for the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub field: Option<String>,
    /// The density without steps that does what the regions do, in the same words; `None` if they
    /// are not near a wished infill.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smooth: Option<String>,
    /// The regions in them, each in the one before.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inner: Vec<InfillLevel>,
}

/// The regions of one density inside of regions of another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InfillLevel {
    /// The density to set in the slicer, over that of solid print.
    pub nominal_ratio: f64,
    /// The density that is laid, over that of solid print.
    pub laid_ratio: f64,
    /// Number of the regions.
    pub regions: usize,
    /// Their volume with all that lies in them, mm³.
    pub volume_mm3: f64,
    /// The mass laid at their density, g; without that of the regions in them.
    pub mass_g: f64,
    /// The file that bounds them, relative to the kit; `None` if they are in the part's file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

impl InfillOrder {
    /// Returns the moments of what a slicer lays beyond surfaces and regions, model frame.
    pub(super) fn beyond(&self) -> Moments {
        self.beyond.map_or(Moments::default(), Moments)
    }

    /// Returns the regions of every density, the outermost first.
    pub fn levels(&self) -> Vec<InfillLevel> {
        let outermost = InfillLevel {
            nominal_ratio: self.nominal_ratio,
            laid_ratio: self.laid_ratio,
            regions: self.regions,
            volume_mm3: self.volume_mm3,
            mass_g: self.mass_g,
            file: self.file.clone(),
        };
        std::iter::once(outermost)
            .chain(self.inner.iter().cloned())
            .collect()
    }

    /// Returns the files that bound the regions, the outermost first.
    pub(super) fn files(&self) -> impl Iterator<Item = &String> {
        let inner = self.inner.iter().filter_map(|level| level.file.as_ref());
        self.file.iter().chain(inner)
    }

    /// Returns the mass laid at all densities of infill, g.
    pub fn infill_g(&self) -> f64 {
        self.mass_g + self.inner.iter().map(|level| level.mass_g).sum::<f64>()
    }

    /// Returns the mass that is laid besides solid print, g.
    pub fn extra_g(&self, density_g_cm3: f64) -> f64 {
        self.infill_g() + self.beyond().volume() * density_g_cm3 / MM3_PER_CM3
    }
}

/// The most that a slicer lays beyond surfaces and regions, as a share of the print's volume. A
/// bunny of 40 mm got 3.3 %, larger models less.
const BEYOND_RATIO: f64 = 0.05;
/// The most by which that moves the centre, mm: twice what toolpaths may be off. The same bunny's
/// centre moved by 0.143 mm.
const BEYOND_SHIFT_MM: f64 = 2.0 * PRINTED_CENTER_LIMIT_MM;
/// The same as a share of the mean distance of the print from its centre, for large models.
const BEYOND_SHIFT_RATIO: f64 = 0.01;
/// Square of the distance of a surface from the centre, over the mean one of the print inside.
const SURFACE_SPREAD: f64 = 6.0;

/// The most by which the infill of a slicer differs from what profiles say, as a share. CuraEngine
/// laid 7.6 % more gyroid than PrusaSlicer, of which the profiles tell.
const SLICER_RATIO: f64 = 0.2;

/// Returns how far the infill of a slicer is said to be from the profile's, over the most by which
/// slicers differ. Above 1 none does. `ratio` is what it lays over what the profile says.
pub fn infill_share(ratio: f64) -> f64 {
    match ratio.is_finite() {
        true => (ratio - 1.0).abs() / SLICER_RATIO,
        false => f64::INFINITY,
    }
}

/// Returns what is said to be laid beyond surfaces and regions, over the most that slicers lay.
/// Above 1 no toolpaths do. `written` are the moments of the print without it.
pub fn beyond_ratio(beyond: &[f64; 10], written: &Moments) -> f64 {
    if !beyond.iter().all(|moment| moment.is_finite()) {
        return f64::INFINITY;
    }
    let volume = written.volume();
    let about = Frame {
        origin: written.centroid(),
        ..Frame::identity()
    };
    let spread_mm2: f64 = written.in_frame(&about).0[7..].iter().sum::<f64>() / volume;
    let [laid, x, y, z, second @ ..] = Moments(*beyond).in_frame(&about).0;
    let shift_mm = Vector::new(x, y, z).norm() / volume;
    let most_mm = BEYOND_SHIFT_MM.max(BEYOND_SHIFT_RATIO * spread_mm2.sqrt());
    let most_second = BEYOND_RATIO * SURFACE_SPREAD * spread_mm2 * volume;
    let second = second.into_iter().map(f64::abs).fold(0.0, f64::max);
    let shares = [
        laid.abs() / (BEYOND_RATIO * volume),
        shift_mm / most_mm,
        second / most_second,
    ];
    shares.into_iter().fold(0.0, f64::max)
}

/// Returns the moments of what is laid in the cavities of a surface, in volumes of solid print.
/// Cavities are turned inward, the regions in them are not. Each region takes the place of what is
/// laid around it.
pub(super) fn sparse_moments<'a>(
    infill: &InfillOrder,
    cavities: &TriMesh,
    inner: impl IntoIterator<Item = &'a TriMesh>,
) -> Moments {
    let mut around = infill.laid_ratio;
    let laid = moments_of_mesh(cavities) * -around;
    let levels = infill.inner.iter().zip(inner);
    levels.fold(laid, |sum, (level, region)| {
        let step = level.laid_ratio - around;
        around = level.laid_ratio;
        sum + moments_of_mesh(region) * step
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::{ball, cuboid};

    #[test]
    fn no_more_is_believed_to_be_laid_than_slicers_lay() {
        let at = Point::new(40.0, -10.0, 25.0);
        let print = moments_of_mesh(&ball(&at, 20.0, 4));
        // A film all around is what slicers lay: 0.1 mm are 1.5 % of this ball.
        let film = moments_of_mesh(&ball(&at, 20.1, 4)) - print;
        assert!(beyond_ratio(&film.0, &print) < 0.5);
        let thick = moments_of_mesh(&ball(&at, 20.4, 4)) - print;
        assert!(beyond_ratio(&thick.0, &print) > 1.0);
        // The same film moves the centre by more than 0.3 mm if it all lies on one side.
        let mut aside = film;
        aside.0[1] += 0.35 * print.volume();
        assert!(beyond_ratio(&aside.0, &print) > 1.0);
        let mut turned = film;
        turned.0[4] += print.in_frame(&Frame::identity()).0[7];
        assert!(beyond_ratio(&turned.0, &print) > 1.0);
        for wrong in [f64::NAN, f64::INFINITY, 1e300] {
            let mut beyond = film.0;
            beyond[5] = wrong;
            assert!(beyond_ratio(&beyond, &print) > 1.0, "{wrong}");
        }
    }

    #[test]
    fn a_region_weighs_its_share_of_solid_print_in_its_place() {
        let region = cuboid(&Point::new(1.0, 2.0, 3.0), &Point::new(3.0, 6.0, 11.0));
        let order = InfillOrder {
            pattern: "gyroid".to_owned(),
            nominal_ratio: 0.15,
            laid_ratio: 0.142,
            regions: 1,
            volume_mm3: 64.0,
            mass_g: 0.011,
            slicer_ratio: None,
            beyond: None,
            misses_mm: Vec::new(),
            field: None,
            smooth: None,
            file: None,
            inner: Vec::new(),
        };
        let laid = sparse_moments(&order, &region.reversed(), []);
        assert!((laid.volume() - 0.142 * 64.0).abs() < 1e-12);
        assert!((laid.centroid() - Point::new(2.0, 4.0, 7.0)).norm() < 1e-12);
    }

    #[test]
    fn a_region_in_a_region_takes_the_place_of_what_is_around_it() {
        let outer = cuboid(&Point::new(0.0, 0.0, 0.0), &Point::new(10.0, 10.0, 10.0));
        let half = cuboid(&Point::new(0.0, 0.0, 0.0), &Point::new(5.0, 10.0, 10.0));
        let level = InfillLevel {
            nominal_ratio: 0.15,
            laid_ratio: 0.14,
            regions: 1,
            volume_mm3: 500.0,
            mass_g: 0.0,
            file: None,
        };
        let order = InfillOrder {
            pattern: "gyroid".to_owned(),
            nominal_ratio: 0.5,
            laid_ratio: 0.46,
            regions: 1,
            volume_mm3: 1000.0,
            mass_g: 0.0,
            slicer_ratio: None,
            beyond: None,
            misses_mm: Vec::new(),
            field: None,
            smooth: None,
            file: None,
            inner: vec![level],
        };
        let laid = sparse_moments(&order, &outer.reversed(), [&half]);
        assert!((laid.volume() - (0.46 + 0.14) * 500.0).abs() < 1e-9);
        let x_mm = (0.46 * 7.5 + 0.14 * 2.5) / 0.6;
        assert!((laid.centroid().x - x_mm).abs() < 1e-9);
    }
}
