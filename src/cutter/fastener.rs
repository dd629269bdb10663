//! The fasteners of a shop: screws, nuts, inserts, washers and dowel rods, each number with its
//! source.

use std::path::Path;

use serde::{Deserialize, Serialize};
use toml::Spanned;

use super::error::{Problem, ProfileError, suggest};
use super::fastener_shape::FastenerShape;
use super::library::{FASTENERS, Profile, by_id, ids, is_path, read_text};
use super::reader::{Key, Reader};
use crate::base::sourced::Sure;
use crate::base::units::MM3_PER_CM3;

/// Plausible sizes of fasteners, mm.
const SIZE_MM: std::ops::RangeInclusive<f64> = 0.1..=200.0;
/// Plausible sizes of rods, which are sold by the metre, mm.
const ROD_MM: std::ops::RangeInclusive<f64> = 0.1..=3000.0;
/// Plausible masses of fasteners, g.
const MASS_G: std::ops::RangeInclusive<f64> = 0.005..=500.0;

/// The source of a fastener's sizes, or of its mass.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// The source, in words.
    pub source: String,
    /// The confidence in it.
    pub sure: Sure,
}

/// A fastener on stock.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fastener {
    /// The id by which it is ordered, such as `screw-m3x10`.
    pub id: String,
    /// Its name in a shop.
    pub name: String,
    /// Its sizes.
    pub shape: FastenerShape,
    /// Its mass, g.
    pub mass_g: f64,
    /// The spread of the mass between good ones, as a share of it.
    pub mass_spread_ratio: f64,
    /// The source of the sizes.
    pub size: Provenance,
    /// The source of the mass.
    pub mass: Provenance,
}

/// A file of fasteners of one kind, as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FamilyText {
    id: Spanned<String>,
    inherits: Option<Spanned<String>>,
    size: Spanned<Provenance>,
    mass: Spanned<MassText>,
    #[serde(default)]
    part: Vec<Spanned<PartText>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MassText {
    source: String,
    sure: Sure,
    spread_ratio: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PartText {
    id: Spanned<String>,
    name: Spanned<String>,
    shape: FastenerShape,
    mass_g: f64,
}

impl Fastener {
    /// Returns all built-in fasteners: dowel rods, inserts, nuts, screws, then washers, each as its
    /// file lists them.
    pub fn all() -> Result<Vec<Self>, ProfileError> {
        let families = FASTENERS.iter().map(|family| read_family(*family));
        let families: Vec<Vec<Self>> = families.collect::<Result<_, _>>()?;
        Ok(families.concat())
    }

    /// Returns the built-in fastener of this id.
    pub fn find(id: &str) -> Result<Self, ProfileError> {
        let all = Self::all()?;
        if let Some(found) = all.iter().find(|fastener| fastener.id == id) {
            return Ok(found.clone());
        }
        let known: Vec<&str> = all.iter().map(|fastener| fastener.id.as_str()).collect();
        Err(ProfileError::Unknown {
            kind: "fastener",
            id: id.to_owned(),
            remedy: suggest(id, &known),
        })
    }

    /// Reads the fasteners of a shop's own file, and those of the built-in family that it inherits
    /// from. Its own ones come first. They replace those of the same id.
    pub fn read(path: &Path) -> Result<Vec<Self>, ProfileError> {
        let (text, file) = (read_text(path)?, path.to_string_lossy());
        read_family(Profile {
            id: &file,
            file: &file,
            text: &text,
        })
    }
}

fn read_family(profile: Profile) -> Result<Vec<Fastener>, ProfileError> {
    let mut reader = Reader::new(profile.file, profile.text);
    let text: FamilyText = reader.parse()?;
    reader.id(&text.id);
    check_sources(&mut reader, &text);
    let mut fasteners = read_parts(&mut reader, &text);
    if let Some(parent) = &text.inherits {
        let inherited = read_parent(&mut reader, profile.id, parent)?;
        let own: Vec<String> = fasteners.iter().map(|own| own.id.clone()).collect();
        let others = inherited.into_iter().filter(|one| !own.contains(&one.id));
        fasteners.extend(others);
    }
    reader.refuse_faults()?;
    Ok(fasteners)
}

/// Reads the built-in family that a file inherits from; notes one that does not exist.
fn read_parent(
    reader: &mut Reader,
    child: &str,
    parent: &Spanned<String>,
) -> Result<Vec<Fastener>, ProfileError> {
    let word = parent.get_ref();
    match by_id(FASTENERS, word).filter(|family| family.id != child && !is_path(word)) {
        Some(family) => read_family(*family),
        None => {
            let problem = Problem::UnknownParent {
                parent: word.clone(),
                remedy: suggest(word, &ids(FASTENERS)),
            };
            reader.note(parent.span().start, problem);
            Ok(Vec::new())
        }
    }
}

fn check_sources(reader: &mut Reader, text: &FamilyText) {
    let sources = [
        ("size", text.size.span().start, &text.size.get_ref().source),
        ("mass", text.mass.span().start, &text.mass.get_ref().source),
    ];
    for (key, at, source) in sources {
        if source.trim().is_empty() {
            reader.note(at, Problem::NoSource(key.to_owned()));
        }
    }
    let key = Key::new("spread_ratio", 1e-4..=0.5);
    let at = text.mass.span().start;
    reader.check_number(at, &key, text.mass.get_ref().spread_ratio);
}

fn read_parts(reader: &mut Reader, text: &FamilyText) -> Vec<Fastener> {
    let mut fasteners: Vec<Fastener> = Vec::new();
    let mass = text.mass.get_ref();
    for part in &text.part {
        let (at, part) = (part.span().start, part.get_ref());
        let fastener = Fastener {
            id: reader.id(&part.id),
            name: reader.words("name", &part.name),
            shape: part.shape,
            mass_g: part.mass_g,
            mass_spread_ratio: mass.spread_ratio,
            size: text.size.get_ref().clone(),
            mass: Provenance {
                source: mass.source.clone(),
                sure: mass.sure,
            },
        };
        check_part(reader, at, &fastener);
        if fasteners.iter().any(|known| known.id == fastener.id) {
            reader.note(at, Problem::Twice(format!("`{}`", fastener.id)));
        }
        fasteners.push(fastener);
    }
    fasteners
}

/// Notes implausible sizes and masses.
fn check_part(reader: &mut Reader, at: usize, fastener: &Fastener) {
    let sizes_mm = match fastener.shape {
        FastenerShape::Dowel { .. } => ROD_MM,
        _ => SIZE_MM,
    };
    for (key, value) in fastener.shape.sizes_mm() {
        reader.check_number(at, &Key::new(key, sizes_mm.clone()), value);
    }
    reader.check_number(at, &Key::new("mass_g", MASS_G), fastener.mass_g);
    let [(key, value), (larger, most)] = fastener.shape.order();
    if value >= most {
        let problem = Problem::Contradiction {
            key: key.to_owned(),
            value,
            against: format!("`{larger}` of `{}` is {most}", fastener.id),
        };
        reader.note(at, problem);
        return;
    }
    let density = fastener.mass_g / fastener.shape.volume_mm3() * MM3_PER_CM3;
    if !fastener.shape.density_g_cm3().contains(&density) {
        let id = fastener.id.clone();
        reader.note(at, Problem::Density { id, density });
    }
}
