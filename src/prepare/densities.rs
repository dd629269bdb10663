//! The densities of a graded print: nested regions from what a job orders and a printer lays.

use super::spread::around;
use super::{fit, given};
use crate::error::GradedError;
use crate::field::DensityRange;
use crate::goal::GoalKind;
use crate::hollow::{Fill, NearWished, PrintLevels, TILT_MARGIN_RAD};
use crate::job::{
    DensityOrder, FieldOrder, GivenField, InfillDensity, Job, KeptShare, LevelCount, PartFormat,
};
use crate::printer::{InfillPattern, Printer, Quantity};
use crate::run::{Extent, Level, Nested};

/// The most that lines of infill may be apart below denser print, mm: it hangs between them.
const MOST_SPACING_MM: f64 = 4.5;

/// A printer's infill, and the least of it that carries what is printed over it.
struct Stock<'a> {
    pattern: &'a InfillPattern,
    least_ratio: f64,
    /// The least and the greatest density of a field inside the walls, as far as they are known.
    inside: Option<[f64; 2]>,
}

/// Returns the regions of infill that a graded job orders of a printer.
///
/// # Errors
/// The printer has no infill, or does not print what the job orders.
pub fn nested(job: &Job, printer: &Printer) -> Result<Nested, GradedError> {
    nested_inside(job, printer, None)
}

/// Returns the regions of a job whose field has these densities inside the walls.
///
/// # Errors
/// As those of [`nested`].
pub fn nested_inside(
    job: &Job,
    printer: &Printer,
    inside: Option<[f64; 2]>,
) -> Result<Nested, GradedError> {
    let no_infill = || GradedError::NoInfill {
        printer: printer.name.clone(),
    };
    let stock = Stock {
        pattern: printer.infill.as_ref().ok_or_else(no_infill)?,
        least_ratio: least_ratio(printer).ok_or_else(no_infill)?,
        inside,
    };
    let order = order(job, printer, &stock)?;
    let nested = match wished(job, order) {
        Some(wished) => near(job, &stock, order, wished)?,
        None => two(&stock, order),
    };
    let regions = nested.levels.len();
    if job.format == PartFormat::ThreeMf && regions > 1 {
        return Err(GradedError::OnlyThreeMf { regions });
    }
    Ok(nested)
}

/// Returns the least infill that carries solid print over it; `None` for a printer without infill.
fn least_ratio(printer: &Printer) -> Option<f64> {
    let least = printer.number(Quantity::LeastInfillRatio)?.value;
    Some(least.max(printer.pixel_x_mm.value / MOST_SPACING_MM))
}

/// Returns the filling that stands for the regions where voids are solved for.
pub fn fill(nested: &Nested) -> Option<Fill> {
    let outermost = nested.levels.first()?;
    let high = match outermost.extent {
        Extent::Interior => outermost.laid_ratio,
        Extent::Above(_) | Extent::Body(_) => 1.0,
    };
    let range = DensityRange::new(nested.levels.last()?.laid_ratio, high).ok()?;
    Some(Fill::between(range))
}

/// Returns the least and the greatest density, and refuses those that do not print.
fn order(job: &Job, printer: &Printer, stock: &Stock) -> Result<DensityOrder, GradedError> {
    let no_infill = || GradedError::NoInfill {
        printer: printer.name.clone(),
    };
    let least = InfillDensity::of_ratio(stock.least_ratio).ok_or_else(no_infill)?;
    let is_match = job.goal.kind == GoalKind::Match;
    let is_sine = job.field.as_ref().is_some_and(FieldOrder::is_sine);
    let given = job.field.as_ref().and_then(FieldOrder::given);
    let may_have_cores = is_sine || matches!(given, Some(GivenField::Drawn(_)));
    let most = stock.most(is_match || may_have_cores);
    let usual = DensityOrder::new(least, most).map_err(|_| no_infill())?;
    let own = given::densities(job, printer, usual, stock.inside)?;
    let order = own.or(job.density).unwrap_or(usual);
    if is_sine && order.high() == InfillDensity::SOLID {
        return Err(GradedError::SolidSine { usual });
    }
    if is_match && order.high() == InfillDensity::SOLID {
        return Err(GradedError::SolidMatch { usual });
    }
    if order.low() < least {
        return Err(GradedError::TooSparse {
            printer: printer.name.clone(),
            density: order.low(),
            high: order.high(),
            least,
        });
    }
    fit::refuse_misfits(job, order)?;
    Ok(order)
}

/// Returns the infill that all is to be near to; `None` if the goal alone decides.
///
/// A match always has several levels: only they reach all that densities reach. They are about the
/// middle until it is placed, and its mean is known. So are those of a field.
fn wished(job: &Job, order: DensityOrder) -> Option<InfillDensity> {
    let middle = || InfillDensity::of_ratio(0.5 * (order.low().ratio() + order.high().ratio()));
    let has_levels = job.goal.kind == GoalKind::Match || job.field.is_some();
    job.infill.or_else(|| middle().filter(|_| has_levels))
}

impl Stock<'_> {
    /// Returns the region of a nominal density, as far as it is no solid print.
    fn level(&self, nominal_ratio: f64, extent: Extent) -> Option<Level> {
        let level = Level {
            nominal_ratio,
            laid_ratio: self.pattern.laid_ratio(nominal_ratio),
            extent,
        };
        (nominal_ratio < 1.0).then_some(level)
    }

    /// Returns the greatest density that is laid unless others are ordered.
    ///
    /// A match may need a dense core in sparse infill. Slicers lay solid print in a pattern of its
    /// own, and a region has only one. So a match ends at the greatest density that was measured.
    fn most(&self, is_match: bool) -> InfillDensity {
        let rows = self.pattern.core_ratio.value.iter();
        let below = rows
            .map(|[nominal, _]| *nominal)
            .filter(|nominal| *nominal < 1.0);
        let greatest = below.fold(0.0, f64::max);
        let greatest = InfillDensity::of_ratio(greatest).filter(|_| is_match);
        greatest.unwrap_or(InfillDensity::SOLID)
    }

    /// Returns the regions of these densities, the outermost first.
    fn nested(&self, levels: impl IntoIterator<Item = Option<Level>>) -> Nested {
        Nested {
            pattern: self.pattern.pattern.clone(),
            levels: levels.into_iter().flatten().collect(),
            near: None,
            field: None,
        }
    }
}

/// Returns the regions of two densities at their best.
fn two(stock: &Stock, order: DensityOrder) -> Nested {
    let high = stock.level(order.high().ratio(), Extent::Interior);
    stock.nested([high, stock.level(order.low().ratio(), Extent::Above(0.0))])
}

/// Returns the regions of several densities near a wished one.
fn near(
    job: &Job,
    stock: &Stock,
    order: DensityOrder,
    wished: InfillDensity,
) -> Result<Nested, GradedError> {
    let count = job.levels.unwrap_or(LevelCount::USUAL).count();
    let nominal = around(order, wished, count);
    let laid: Vec<f64> = nominal
        .iter()
        .map(|it| stock.pattern.laid_ratio(*it))
        .collect();
    let levels = PrintLevels::new(laid).map_err(|_| GradedError::Levels { count })?;
    let least_angle_rad = job.goal.promised_angle_deg().unwrap_or(0.0).to_radians();
    let near = NearWished {
        wished: stock.pattern.laid_ratio(wished.ratio()),
        levels,
        least_angle_rad: least_angle_rad + TILT_MARGIN_RAD,
        keep: job.keep.map(KeptShare::ratio),
    };
    let cuts = near.cuts();
    let (greatest, others) = nominal.split_last().ok_or(GradedError::Levels { count })?;
    let outermost = stock.level(*greatest, Extent::Interior);
    let inner = others.iter().zip(&cuts).rev();
    let inner = inner.map(|(nominal, cut)| stock.level(*nominal, Extent::Above(-cut)));
    let nested = stock.nested(std::iter::once(outermost).chain(inner));
    Ok(Nested {
        near: Some(near),
        ..nested
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::units::Length;
    use crate::goal::Request;
    use crate::job::{Interior, ModelChoice, PrinterChoice, Scaling};

    fn job(density: Option<&str>, infill: Option<&str>, levels: Option<&str>) -> Job {
        let model = ModelChoice {
            path: "a.stl".into(),
            sha256: None,
            scaling: Scaling::Size(Length::from_mm(60.0).unwrap()),
        };
        let printer = PrinterChoice {
            id: "prusa-mk4".into(),
            material: None,
        };
        Job {
            interior: Interior::Graded,
            density: density.map(|text| text.parse().unwrap()),
            infill: infill.map(|text| text.parse().unwrap()),
            levels: levels.map(|text| text.parse().unwrap()),
            ..Job::new(model, printer, Request::new(GoalKind::Stand))
        }
    }

    fn ordered(job: &Job) -> Result<Nested, GradedError> {
        nested(job, &Printer::find("prusa-mk4").unwrap())
    }

    fn percents(nested: &Nested) -> Vec<f64> {
        nested.levels.iter().map(Level::nominal_percent).collect()
    }

    #[test]
    fn without_an_order_one_region_of_the_least_infill_lies_in_solid_print() {
        let nested = ordered(&job(None, None, None)).unwrap();
        assert_eq!(percents(&nested), [15.0]);
        assert_eq!(nested.levels[0].extent, Extent::Above(0.0));
        assert_eq!(fill(&nested).unwrap().density_ratio(), 0.142);
    }

    #[test]
    fn broad_lines_need_more_infill_so_that_nothing_dense_hangs_far_between_them() {
        let mut printer = Printer::find("prusa-mk4").unwrap();
        assert_eq!(least_ratio(&printer), Some(0.15));
        printer.pixel_x_mm.value = 0.9;
        assert_eq!(least_ratio(&printer), Some(0.2));
        let sparse = nested(&job(Some("15%..60%"), None, None), &printer);
        assert!(sparse.unwrap_err().to_string().contains("no less than 20%"));
    }

    #[test]
    fn a_greatest_density_below_solid_fills_all_of_the_interior() {
        let nested = ordered(&job(Some("20%..60%"), None, None)).unwrap();
        assert_eq!(percents(&nested), [60.0, 20.0]);
        assert_eq!(nested.levels[0].extent, Extent::Interior);
        // Between the rows of 50 and 70 per cent of the profile's table.
        let laid = nested.levels[0].laid_ratio;
        assert!((laid - 0.5 * (0.4648 + 0.6421)).abs() < 2e-3, "{laid}");
    }

    #[test]
    fn levels_near_an_infill_are_cut_midway_between_their_densities() {
        let nested = ordered(&job(None, Some("40%"), Some("5"))).unwrap();
        assert_eq!(percents(&nested), [80.0, 60.0, 40.0, 15.0]);
        let near = nested.near.as_ref().unwrap();
        let middle = 0.5 * (1.0 + nested.levels[0].laid_ratio) - near.wished;
        assert_eq!(nested.levels[0].extent, Extent::Above(-middle));
        let sparse = ordered(&job(Some("15%..75%"), Some("40%"), Some("3"))).unwrap();
        assert_eq!(percents(&sparse), [75.0, 40.0, 15.0]);
        assert_eq!(sparse.levels[0].extent, Extent::Interior);
    }

    #[test]
    fn two_levels_are_the_usual_two_densities_and_a_share_needs_a_wished_infill() {
        let two = ordered(&job(None, None, Some("2"))).unwrap();
        assert_eq!(two, ordered(&job(None, None, None)).unwrap());
        let words = |job: &Job| ordered(job).unwrap_err().to_string();
        assert!(words(&job(None, Some("40%"), Some("2"))).contains("`levels = \"3\"`"));
        let keep = |job: Job| Job {
            keep: Some("90%".parse().unwrap()),
            ..job
        };
        assert!(words(&keep(job(None, None, None))).contains("`infill = \"40%\"`"));
        let near = ordered(&keep(job(None, Some("40%"), None))).unwrap().near;
        assert_eq!(near.unwrap().keep, Some(0.9));
        let mut rotor = keep(job(None, Some("40%"), None));
        rotor.goal.kind = GoalKind::Balance;
        assert!(words(&rotor).contains("`keep = \"90%\"`"));
    }

    #[test]
    fn a_match_has_levels_about_the_middle_though_none_are_ordered() {
        let matched = |levels| Job {
            goal: Request::new(GoalKind::Match),
            ..job(Some("20%..80%"), None, levels)
        };
        let usual = Job {
            density: None,
            ..matched(None)
        };
        let nested = ordered(&usual).unwrap();
        // A dense core may lie in sparse infill, so that none is solid print.
        assert_eq!(
            (percents(&nested)[0], nested.levels[0].extent),
            (90.0, Extent::Interior)
        );
        let solid = Job {
            density: Some("15%..100%".parse().unwrap()),
            ..usual
        };
        let said = ordered(&solid).unwrap_err().to_string();
        assert!(said.contains("`density = \"15%..90%\"`"), "{said}");
        let nested = ordered(&matched(None)).unwrap();
        assert!(percents(&nested).contains(&50.0), "{nested:?}");
        assert_eq!(nested.levels.len(), LevelCount::USUAL.count());
        assert!(nested.near.is_some());
        assert_eq!(ordered(&matched(Some("6"))).unwrap().levels.len(), 6);
    }

    #[test]
    fn what_does_not_print_or_means_nothing_is_refused_with_what_to_type() {
        for (job, said) in [
            (job(Some("5%..60%"), None, None), "`density = \"15%..60%\"`"),
            (
                job(Some("5%..10%"), None, None),
                "`density = \"15%..100%\"`",
            ),
            (job(Some("20%..60%"), Some("70%"), None), "not within"),
            (job(None, None, Some("4")), "`infill = \"40%\"`"),
            (
                job(Some("20%..20.2%"), Some("20.1%"), Some("12")),
                "farther apart",
            ),
        ] {
            let words = ordered(&job).unwrap_err().to_string();
            assert!(words.contains(said), "{words}");
        }
        let packed = Job {
            format: PartFormat::ThreeMf,
            ..job(Some("15%..60%"), None, None)
        };
        let words = ordered(&packed).unwrap_err().to_string();
        assert!(words.contains("`format = \"both\"`"), "{words}");
    }
}
