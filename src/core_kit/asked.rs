//! The order of an object on a base, in the measures of the machines.

use super::error::CoreRunError;
use super::load::{Loaded, Shop};
use super::method::check_method;
use crate::base::watch::Watch;
use crate::cladding::{BoltKit, RodKit, ScrewKit};
use crate::cut::{GoalAxis, PlanRequest};
use crate::cutter::{CutterNumber, Fastener, FastenerShape, Grain};
use crate::cutting::{SheetError, whole_sheets};
use crate::geom::{Point, Vector};
use crate::goal::{Goal, GoalError, GoalKind, Request as GoalRequest, Up, find_upright, place};
use crate::job::GrainChoice;
use crate::job::base_choice::Dowel;
use crate::job::core_kit::{CoreGoal, CoreJob, CoreJoints};
use crate::panels::{BracketKind, JointStyle, PanelRequest, Stock};
use crate::polyhedra::{ConnectorRequest, Ground, Limits, Request};

/// The wall of parts if the job says nothing else, mm.
const USUAL_WALL_MM: f64 = 3.0;
/// The gap between panels and parts, mm: sheets are not flat.
const GAP_MM: f64 = 0.5;
/// Room beside what a screw needs below the wall, mm: places are tried on a grid.
const SPARE_MM: f64 = 0.1;
/// The least thread of screws, mm.
const THREAD_MM: f64 = 3.0;
/// The gap between panels that bear on each other, mm: sheets are not quite flat.
const BEARING_MM: f64 = 0.1;
/// The least radius of the disc in which they do so if the job says nothing else, mm. It is more if
/// two bolts need more.
const CONNECTOR_MM: f64 = 20.0;
/// The least thread of bolts between polyhedra, mm.
const BOLT_MM: f64 = 4.0;
/// The hole into which a screw cuts its own thread, over the thread.
const CORE_HOLE_RATIO: f64 = 2.5 / 3.0;
/// The thickness of a bracket's flange, mm, and the share of it that a screw must reach into.
const FLANGE_MM: f64 = 4.0;
const GRIP_RATIO: f64 = 0.75;

/// The order of an object, in mm.
#[derive(Clone)]
pub struct Asked<'a> {
    pub job: &'a CoreJob,
    pub shop: &'a Shop,
    pub ground: &'a Ground,
    /// The bytes of the model's file.
    pub model_bytes: &'a [u8],
    pub warnings: Vec<String>,
    pub wall_mm: f64,
    pub gap_mm: f64,
    /// The order for the base.
    pub base: Request,
    /// The order for the connections of its polyhedra.
    pub connector: ConnectorRequest,
    /// The bolts between polyhedra; `None` if no stock screw is long enough.
    pub bolt: Option<BoltKit>,
    /// The rods to choose from, the best first; empty if none may join polyhedra.
    pub rods: Vec<RodKit>,
    /// The order for its panels.
    pub panels: PanelRequest,
    /// The sheets at hand, as they lie on the bed.
    pub stock: Vec<Stock>,
    /// True if panels follow the grain of their sheet.
    pub keeps_grain: bool,
    /// The screws and inserts of parts.
    pub screws: ScrewKit,
    /// The pins between parts.
    pub pins: PlanRequest,
    /// The screw of brackets.
    pub bracket_screw: Fastener,
    /// The direction up.
    pub up: Vector,
    /// The goal; `None` if nothing is promised.
    pub goal: Option<Goal>,
}

/// Takes the measures of a job from the profiles of its machines.
pub fn measure<'a>(
    shop: &'a Shop,
    loaded: &'a Loaded,
    watch: &Watch,
) -> Result<Asked<'a>, CoreRunError> {
    let job = &loaded.job;
    check_method(job)?;
    if job.goal == CoreGoal::None && !job.ballast.is_none() {
        return Err(CoreRunError::BallastForNothing);
    }
    let size_mm = loaded.ground.solid().mesh().longest_side_mm();
    let least_mm = shop.printer.least_wall_mm(size_mm).value;
    let asked_mm = job
        .wall
        .map_or(USUAL_WALL_MM.max(least_mm), |wall| wall.mm());
    let wall_mm = shop.printer.quantise_wall(Some(asked_mm), size_mm)?.wall_mm;
    let sheet_mm = shop.sheet.thickness_mm.value;
    let no_screw = || CoreRunError::NoScrew { sheet_mm };
    let screws = ScrewKit::choose(&shop.fasteners, THREAD_MM, sheet_mm + GAP_MM);
    let screws = screws.ok_or_else(no_screw)?;
    let bracket_screw = bracket_screw(&shop.fasteners, sheet_mm).ok_or_else(no_screw)?;
    // A screw then has room wherever a part covers its panel.
    let fastener_mm = screws.depth_mm() + 0.5 * screws.bore_mm() + SPARE_MM;
    let distance_mm = wall_mm + GAP_MM + fastener_mm;
    let head_mm = screws.screw.shape.diameter_mm();
    let stock = stock(job, shop)?;
    let limits = Limits::for_sheet(sheet_mm, head_mm, room_mm(&stock, margin_mm(shop)));
    let base = Request {
        faces: job.faces,
        ..Request::new(distance_mm, limits)
    };
    base.check()?;
    let bolt = BoltKit::choose(&shop.fasteners, BOLT_MM, 2.0 * sheet_mm + BEARING_MM);
    let two_mm = bolt.as_ref().map_or(0.0, |bolt| bolt.disc_mm(sheet_mm));
    let disc_mm = CONNECTOR_MM.max(two_mm.ceil());
    let pins = pins(shop, size_mm);
    let rods = rods(job, shop, pins.pins.clearance_mm)?;
    let (up, goal) = stance(job, &loaded.ground, wall_mm, watch)?;
    Ok(Asked {
        job,
        shop,
        ground: &loaded.ground,
        model_bytes: &loaded.bytes,
        warnings: loaded.warnings.clone(),
        wall_mm,
        gap_mm: GAP_MM,
        base,
        connector: ConnectorRequest {
            radius_mm: job.connector.map_or(disc_mm, |radius| radius.mm()),
            gap_mm: BEARING_MM,
            // What the thinnest needs: which of them it is, panels and neck decide.
            rods: rods.last().map(|kit| kit.room(sheet_mm, wall_mm)),
        },
        bolt,
        rods,
        panels: panel_request(job, shop, &bracket_screw),
        stock,
        keeps_grain: keeps_grain(job, shop),
        screws,
        pins,
        bracket_screw,
        up,
        goal,
    })
}

impl Asked<'_> {
    /// Returns the same order with other rods to choose from, the best first.
    pub fn with_rods(&self, rods: Vec<RodKit>) -> Self {
        let thinnest = rods.last();
        let room = thinnest.map(|kit| kit.room(self.panels.sheet_mm, self.wall_mm));
        Self {
            connector: ConnectorRequest {
                rods: room,
                ..self.connector
            },
            rods,
            ..self.clone()
        }
    }

    /// Returns the printer's room, mm; `None` if it is not known.
    pub fn room_mm(&self) -> Option<[f64; 3]> {
        self.shop.printer.usable_volume_mm()
    }

    /// Returns the goal of standing with a direction of the model up.
    ///
    /// # Errors
    /// The model has no foot on that side.
    pub fn standing(&self, up: Up) -> Result<Goal, GoalError> {
        let request = standing_request(up, self.job.least_angle_deg);
        Ok(place(self.ground.solid(), self.wall_mm, &request)?.goal)
    }

    /// Returns the density of the printed material, g/mm³.
    pub fn print_g_mm3(&self) -> f64 {
        self.shop.material.density_g_mm3()
    }

    /// Returns the density of the sheet, g/mm³.
    pub fn sheet_g_mm3(&self) -> f64 {
        self.shop.sheet.mass_per_area_g_mm2() / self.shop.sheet.thickness_mm.value
    }
}

/// Returns true if panels follow the grain: as the job says, or else the sheet's profile.
fn keeps_grain(job: &CoreJob, shop: &Shop) -> bool {
    match job.cutting.grain {
        Some(choice) => choice == GrainChoice::Keep,
        None => shop.sheet.grain != Grain::None,
    }
}

/// Returns the rods that a job allows, the thickest first.
fn rods(job: &CoreJob, shop: &Shop, play_mm: f64) -> Result<Vec<RodKit>, CoreRunError> {
    let all = RodKit::all(&shop.fasteners, play_mm);
    let known = all.iter().map(|kit| kit.rod.id.clone()).collect();
    match &job.dowel {
        Dowel::Auto => Ok(all),
        Dowel::None => Ok(Vec::new()),
        Dowel::Id(id) => {
            let own = all.into_iter().filter(|kit| kit.rod.id == *id);
            let own: Vec<RodKit> = own.collect();
            if own.is_empty() {
                let id = id.clone();
                return Err(CoreRunError::NoDowel { id, known });
            }
            Ok(own)
        }
    }
}

/// Returns the sizes of the printer's pins for a model of a size, mm.
fn pins(shop: &Shop, size_mm: f64) -> PlanRequest {
    // Pins do not depend on the axis of a goal.
    let axis = GoalAxis {
        point: Point::origin(),
        direction: Vector::z(),
    };
    PlanRequest::for_printer(&shop.printer, size_mm, axis)
}

fn panel_request(job: &CoreJob, shop: &Shop, screw: &Fastener) -> PanelRequest {
    let hole_mm = match screw.shape {
        FastenerShape::Screw { hole_mm, .. } => hole_mm,
        _ => screw.shape.thread_mm(),
    };
    PanelRequest {
        sheet_mm: shop.sheet.thickness_mm.value,
        joints: match job.joints {
            CoreJoints::Auto => JointStyle::Auto,
            CoreJoints::Fingers => JointStyle::Fingers,
            CoreJoints::Brackets => JointStyle::Brackets,
        },
        press_mm: 0.0,
        cut_mm: shop.cutter.offset_mm(shop.kerf.kerf_mm),
        brackets: BracketKind {
            hole_mm,
            head_mm: screw.shape.diameter_mm(),
            thread_mm: CORE_HOLE_RATIO * screw.shape.thread_mm(),
            flange_mm: FLANGE_MM,
        },
    }
}

/// Returns the shortest stock screw that reaches through a sheet and into a flange.
fn bracket_screw(stock: &[Fastener], sheet_mm: f64) -> Option<Fastener> {
    let least_mm = sheet_mm + GRIP_RATIO * FLANGE_MM;
    let long_enough = stock.iter().filter_map(|fastener| match fastener.shape {
        FastenerShape::Screw {
            thread_mm,
            length_mm,
            ..
        } if length_mm >= least_mm && thread_mm >= THREAD_MM => {
            Some((fastener, [thread_mm, length_mm]))
        }
        _ => None,
    });
    let best = long_enough.reduce(|a, b| if b.1 < a.1 { b } else { a });
    best.map(|(fastener, _)| fastener.clone())
}

/// Returns the sheets at hand as they lie on the bed: those of the job, or else those of the
/// sheet's profile.
fn stock(job: &CoreJob, shop: &Shop) -> Result<Vec<Stock>, CoreRunError> {
    let (cutter, sheet) = (&shop.cutter, &shop.sheet);
    let named = job.cutting.stock.0.iter().map(|item| {
        let [length, width] = item.size_mm;
        let on_bed = cutter.on_bed(item.size_mm);
        if on_bed.size_mm != [length, width] && on_bed.size_mm != [width, length] {
            return Err(CoreRunError::StockTooLarge {
                item: *item,
                bed_mm: cutter.bed_mm.value,
            });
        }
        Ok(Stock {
            size_mm: on_bed.size_mm,
            count: item.count,
            is_turned: on_bed.is_turned,
        })
    });
    let named: Vec<Stock> = named.collect::<Result<_, CoreRunError>>()?;
    let stock = if named.is_empty() {
        whole_sheets(cutter, sheet)
    } else {
        named
    };
    match stock.is_empty() {
        true => Err(SheetError::NoSize(sheet.id.clone()).into()),
        false => Ok(stock),
    }
}

/// Returns the width that stays free along the edges of a sheet, mm.
pub fn margin_mm(shop: &Shop) -> f64 {
    let spacing_mm = shop.cutter.spacing_mm(shop.kerf.kerf_mm);
    let margin = shop.cutter.numbers.get(&CutterNumber::MarginMm);
    margin.map_or(spacing_mm, |margin| margin.value.max(spacing_mm))
}

/// Returns the largest rectangle that a panel may fill on a sheet, mm.
fn room_mm(stock: &[Stock], margin_mm: f64) -> [f64; 2] {
    let rooms = stock.iter().map(|stock| stock.size_mm);
    let rooms = rooms.map(|size| size.map(|side| (side - 2.0 * margin_mm).max(0.0)));
    let largest = rooms.reduce(|a, b| if b[0] * b[1] > a[0] * a[1] { b } else { a });
    largest.unwrap_or([0.0; 2])
}

/// Returns the request for standing with a direction up, until leaned by so many degrees.
fn standing_request(up: Up, least_angle_deg: f64) -> GoalRequest {
    GoalRequest {
        up,
        least_angle_deg,
        ..GoalRequest::new(GoalKind::Stand)
    }
}

/// Returns the direction up, and the goal if one is promised.
fn stance(
    job: &CoreJob,
    ground: &Ground,
    wall_mm: f64,
    watch: &Watch,
) -> Result<(Vector, Option<Goal>), CoreRunError> {
    let solid = ground.solid();
    let up = if job.up == Up::Natural {
        let poses = find_upright(solid, watch)?;
        poses.first().map_or(Up::Z, |pose| Up::of(&pose.up))
    } else {
        job.up
    };
    let request = standing_request(up, job.least_angle_deg);
    match (place(solid, wall_mm, &request), job.goal) {
        (Ok(placed), CoreGoal::Stand) => Ok((placed.goal.frame.axis(), Some(placed.goal))),
        (Ok(placed), CoreGoal::None) => Ok((placed.goal.frame.axis(), None)),
        (Err(GoalError::NoSupport { up, .. }), CoreGoal::None) => {
            Ok((up.direction().unwrap_or(Vector::z()), None))
        }
        (Err(error), _) => Err(error.into()),
    }
}
