//! Finds the part that each piece of printed material is: by its label, its shape, or its place.

use super::error::PrintedError;
use super::names::{name_some, named_ids};
use super::shape::{Fit, Shape, Thing, middle};
use super::source::{Piece, Source};
use crate::base::watch::Watch;
use crate::geom::{Aabb, Point};
use crate::io::gcode::Place;
use crate::verify::{PlateSpot, Promise, PromisedPlate};

/// A piece is a part by its shape alone if it misses it by at most this, mm: ten times the accuracy
/// of centres.
const SHAPE_MM: f64 = 1.5;
/// Places on a plate are this much larger than the parts, mm: half of the least gap between parts.
const ROOM_MM: f64 = 0.5;
/// A plate as a whole has the size of the toolpaths within this, mm.
const PLATE_MM: f64 = 1.5;
/// A plate lies where the kit says within this, mm.
const UNMOVED_MM: f64 = 1.0;
/// The edges of a part differ from each other by at most this share after scaling. Other parts
/// differ by more.
const DISTORTED_RATIO: f64 = 0.05;
/// Edges that differ by less, mm, say nothing: a layer and the rounding of a line.
const DISTORTED_MM: f64 = 0.8;
/// The least and most volume of a part's print over the part, at equal size.
const VOLUME_RATIOS: [f64; 2] = [0.05, 1.3];
/// Share of the material that may lie outside all places.
const STRAY_RATIO: f64 = 0.01;

/// The way by which a piece was found to be a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MatchedBy {
    /// The slicer's label names it.
    Label,
    /// Its shape fits no other part.
    Shape,
    /// It lies where the kit says.
    Place,
}

/// A piece that is a part or a jig.
#[derive(Debug, Clone)]
pub(super) struct Match {
    /// The index of the part or jig.
    pub(super) thing: usize,
    /// The index of the source.
    pub(super) source: usize,
    /// The material.
    pub(super) piece: Piece,
    /// The way in which it lies.
    pub(super) fit: Fit,
    /// The way by which it was found.
    pub(super) by: MatchedBy,
}

/// All pieces of all files.
#[derive(Debug, Default)]
pub(super) struct Matches {
    /// The pieces that are parts or jigs, each once.
    pub(super) found: Vec<Match>,
    /// Objects that are not of the kit.
    pub(super) strangers: Vec<String>,
    /// Further copies of parts.
    pub(super) copies: Vec<String>,
}

/// The kit as the matcher sees it.
pub(super) struct Catalogue<'a> {
    /// The promise.
    pub(super) promise: &'a Promise,
    /// The parts, then the jigs.
    pub(super) things: Vec<Thing<'a>>,
}

impl Catalogue<'_> {
    /// Finds all parts in all files.
    ///
    /// # Errors
    /// A file holds no part, an object fits several, or two files print the same.
    pub(super) fn match_all(
        &self,
        sources: &[Source],
        watch: &Watch,
    ) -> Result<Matches, PrintedError> {
        let mut all = Matches::default();
        for (index, source) in sources.iter().enumerate() {
            watch.check()?;
            let mut here: Vec<Match> = Vec::new();
            for found in self.match_source(source, index, &mut all.strangers, watch)? {
                let same = |known: &&Match| known.thing == found.thing;
                if let Some(known) = all.found.iter().find(same) {
                    return Err(PrintedError::Twice {
                        part: self.things[found.thing].id.to_owned(),
                        first: sources[known.source].name.clone(),
                        second: source.name.clone(),
                    });
                }
                if here.iter().any(|known| known.thing == found.thing) {
                    let id = self.things[found.thing].id;
                    all.copies.push(format!("{id} in {}", source.name));
                } else {
                    here.push(found);
                }
            }
            all.found.extend(here);
        }
        Ok(all)
    }

    /// Finds the parts of one source.
    fn match_source(
        &self,
        source: &Source,
        index: usize,
        strangers: &mut Vec<String>,
        watch: &Watch,
    ) -> Result<Vec<Match>, PrintedError> {
        let (mut found, mut strange) = (Vec::new(), Vec::new());
        for piece in source.pieces() {
            match self.match_piece(source, index, &piece)? {
                Some(this) => found.push(this),
                None if piece.label.is_empty() => {
                    found.extend(self.match_places(source, index, &piece, watch)?);
                }
                None => strange.push(piece),
            }
        }
        found.sort_by_key(|this: &Match| (this.thing, this.piece.copy));
        if found.is_empty() {
            let labels: Vec<String> = strange
                .iter()
                .map(|piece| self.describe(source, piece))
                .collect();
            return Err(self.foreign(source, format!("it prints {}", name_some(&labels))));
        }
        let named = strange.iter();
        strangers.extend(named.map(|piece| format!("{} in {}", piece.label, source.name)));
        Ok(found)
    }

    /// Finds the part that a piece is, by its label or its shape; `None` if it is none.
    fn match_piece(
        &self,
        source: &Source,
        index: usize,
        piece: &Piece,
    ) -> Result<Option<Match>, PrintedError> {
        let shape = source.shape(piece, self.promise);
        let named = named_ids(&piece.label, self.things.iter().map(|thing| thing.id));
        let make = |thing: usize, by: MatchedBy| Match {
            thing,
            source: index,
            piece: piece.clone(),
            fit: self.things[thing].fit(&shape),
            by,
        };
        match named.as_slice() {
            [] => {}
            [thing] => {
                let this = make(*thing, MatchedBy::Label);
                return if is_plausible(&this.fit) {
                    Ok(Some(this))
                } else {
                    let thing = &self.things[*thing];
                    let reason = format!(
                        "its {} has another shape, {} where the kit's has {}",
                        thing.id,
                        sizes(&shape.aabb),
                        sizes(&thing.aabb)
                    );
                    Err(self.foreign(source, reason))
                };
            }
            several => return Err(self.ambiguous(source, &piece.label, several)),
        }
        let fits: Vec<Match> = (0..self.things.len())
            .map(|thing| make(thing, MatchedBy::Shape))
            .filter(|this| is_plausible(&this.fit) && this.fit.miss_mm <= SHAPE_MM)
            .collect();
        let in_place: Vec<&Match> = fits.iter().filter(|this| self.is_in_place(this)).collect();
        match (fits.as_slice(), in_place.as_slice()) {
            (_, [one]) => Ok(Some(Match {
                by: MatchedBy::Place,
                ..(*one).clone()
            })),
            ([], _) => Ok(None),
            ([one], _) => Ok(Some(one.clone())),
            (several, _) => {
                let several: Vec<usize> = several.iter().map(|this| this.thing).collect();
                let label = if piece.label.is_empty() {
                    "what is printed"
                } else {
                    &piece.label
                };
                Err(self.ambiguous(source, label, &several))
            }
        }
    }

    fn is_in_place(&self, this: &Match) -> bool {
        self.things[this.thing].spot.is_some() && !this.fit.is_moved
    }

    /// Finds the parts of a plate without labels by their places on a plate of the kit. The plate
    /// may be moved as a whole.
    fn match_places(
        &self,
        source: &Source,
        index: usize,
        whole: &Piece,
        watch: &Watch,
    ) -> Result<Vec<Match>, PrintedError> {
        let (plate, shift_mm) = self.find_plate(source, whole)?;
        let places = plate.holds.iter().map(|spot| place(spot, &shift_mm));
        let deposits = source.read_places(places.collect(), watch)?;
        let mut found = Vec::new();
        let mut left_mm3 = whole.deposits.part_moments().volume();
        let most_mm3 = STRAY_RATIO * left_mm3;
        for (spot, deposits) in plate.holds.iter().zip(deposits) {
            let volume_mm3 = deposits.part_moments().volume();
            let thing = self.things.iter().position(|thing| thing.id == spot.id);
            let Some(thing) = thing.filter(|_| volume_mm3 > 0.0) else {
                continue;
            };
            left_mm3 -= volume_mm3;
            let piece = Piece {
                deposits,
                ..whole.clone()
            };
            let fit = self.things[thing].fit(&source.shape(&piece, self.promise));
            if !is_plausible(&fit) {
                let reason = format!("what lies in the place of {} has another shape", spot.id);
                return Err(self.foreign(source, reason));
            }
            found.push(Match {
                thing,
                source: index,
                piece,
                fit,
                by: MatchedBy::Place,
            });
        }
        if left_mm3 > most_mm3 {
            let reason = format!("{left_mm3:.0} mm³ lie outside the places on {}", plate.file);
            return Err(self.foreign(source, reason));
        }
        Ok(found)
    }

    /// Returns the plate of the kit that a source without labels prints, and how far it was moved,
    /// mm.
    fn find_plate(
        &self,
        source: &Source,
        whole: &Piece,
    ) -> Result<(&PromisedPlate, [f64; 2]), PrintedError> {
        let shape = source.shape(whole, self.promise);
        let stated = source.plate.as_ref();
        let is_stated = |plate: &&PromisedPlate| stated.is_none_or(|file| *file == plate.file);
        let plates = self.promise.plates.iter().filter(is_stated);
        let fitting: Vec<(&PromisedPlate, [f64; 2])> = plates
            .filter_map(|plate| Some((plate, plate_shift_mm(plate, &shape)?)))
            .collect();
        let is_unmoved = |shift_mm: &[f64; 2]| shift_mm[0].hypot(shift_mm[1]) <= UNMOVED_MM;
        let unmoved: Vec<_> = fitting
            .iter()
            .filter(|(_, shift_mm)| is_unmoved(shift_mm))
            .collect();
        match (fitting.as_slice(), unmoved.as_slice()) {
            ([], _) => {
                let reason = format!(
                    "it has no labels, and its material of {} has the size of no part or plate",
                    sizes(&shape.aabb)
                );
                Err(self.foreign(source, reason))
            }
            ([one], _) => Ok(*one),
            (_, [one]) => Ok(**one),
            (several, _) => Err(PrintedError::Ambiguous {
                labels: labels(source),
                file: source.name.clone(),
                object: "what is printed".to_owned(),
                parts: several
                    .iter()
                    .map(|(plate, _)| plate.file.clone())
                    .collect(),
            }),
        }
    }

    fn describe(&self, source: &Source, piece: &Piece) -> String {
        let size = sizes(&source.shape(piece, self.promise).aabb);
        format!("{} of {size}", piece.label)
    }

    fn foreign(&self, source: &Source, reason: String) -> PrintedError {
        let plates = self.promise.plates.iter().map(|plate| plate.file.as_str());
        let plates: Vec<&str> = plates.collect();
        PrintedError::Foreign {
            file: source.name.clone(),
            reason,
            labels: labels(source),
            plates: if plates.is_empty() {
                "the parts".to_owned()
            } else {
                plates.join(" or ")
            },
        }
    }

    fn ambiguous(&self, source: &Source, object: &str, things: &[usize]) -> PrintedError {
        PrintedError::Ambiguous {
            labels: labels(source),
            file: source.name.clone(),
            object: object.to_owned(),
            parts: things
                .iter()
                .map(|thing| self.things[*thing].id.to_owned())
                .collect(),
        }
    }
}

/// Returns false if a piece cannot be the part, whatever was set wrong.
fn is_plausible(fit: &Fit) -> bool {
    let scale_ratio = fit.scale_ratio();
    let is_like = |axis: usize| {
        let aside = (fit.size_ratio[axis] - scale_ratio).abs();
        aside <= DISTORTED_RATIO * scale_ratio || aside * fit.edges_mm[axis] <= DISTORTED_MM
    };
    let volume_ratio = fit.volume_ratio / scale_ratio.powi(3);
    let is_heavy = (VOLUME_RATIOS[0]..=VOLUME_RATIOS[1]).contains(&volume_ratio);
    (0..3).all(is_like) && is_heavy
}

/// Returns how far a plate was moved, mm, if the toolpaths have its size; `None` if they have not.
fn plate_shift_mm(plate: &PromisedPlate, shape: &Shape) -> Option<[f64; 2]> {
    let corners = plate.holds.iter().flat_map(|spot| {
        let [x, y] = spot.low_mm;
        let [width, depth] = spot.size_mm;
        [Point::new(x, y, 0.0), Point::new(x + width, y + depth, 0.0)]
    });
    let corners: Vec<Point> = corners.collect();
    let wanted = Aabb::of_points(&corners);
    let longer_mm = shape.aabb.size() - wanted.size();
    let has_size = longer_mm.x.abs() <= PLATE_MM && longer_mm.y.abs() <= PLATE_MM;
    let shift = middle(&shape.aabb) - middle(&wanted);
    (has_size && !corners.is_empty()).then_some([shift.x, shift.y])
}

/// Returns the rectangle of a spot on a plate that was moved.
fn place(spot: &PlateSpot, shift_mm: &[f64; 2]) -> Place {
    let low_mm = [0, 1].map(|axis| spot.low_mm[axis] + shift_mm[axis]);
    Place {
        min_mm: low_mm.map(|low_mm| low_mm - ROOM_MM),
        max_mm: [0, 1].map(|axis| low_mm[axis] + spot.size_mm[axis] + ROOM_MM),
    }
}

/// Returns the words on labels in a remedy: images have none.
fn labels(source: &Source) -> &'static str {
    if source.is_images {
        ""
    } else {
        ", with labels on its objects"
    }
}

/// Returns the sizes of a box.
fn sizes(aabb: &Aabb) -> String {
    let size = aabb.size();
    format!("{:.1} × {:.1} × {:.1} mm", size.x, size.y, size.z)
}
