//! The check that a solid is one body, which every kit needs. Refusals name inner surfaces, loose
//! bodies and overlaps.

use std::fmt;

use super::order::InnerSurfaces;
use crate::base::setting::{Key, Setting};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Point;
use crate::mesh::edges::EdgeTable;
use crate::mesh::shells::{Shells, shell_box};
use crate::mesh::{Crossings, Solid, TriMesh};

/// The role of a shell among the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShellRole {
    /// Faces outward and lies in no other shell: a body.
    Body,
    /// Faces inward: the wall of a cavity.
    Cavity,
    /// Faces outward and lies in a cavity: a loose body.
    Island,
    /// Faces outward and lies in the material of another body, which would count twice.
    Doubled,
}

impl fmt::Display for ShellRole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Body => "a body",
            Self::Cavity => "a cavity",
            Self::Island => "a loose body (in a cavity)",
            Self::Doubled => "a body (inside the material of another)",
        })
    }
}

/// One connected surface of a solid that has several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShellFact {
    /// Its role.
    pub role: ShellRole,
    /// The volume it encloses, mm³.
    pub volume_mm3: f64,
    /// The middle of its bounding box, mm.
    pub center: Point,
}

impl fmt::Display for ShellFact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Point { coords: at } = self.center;
        let place = format!("({:.2}, {:.2}, {:.2}) mm", at.x, at.y, at.z);
        write!(
            f,
            "{} of {:.3} mm³ about {place}",
            self.role, self.volume_mm3
        )
    }
}

/// The reason that a solid is not one body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotOneBody {
    /// The surface passes through itself: the overlap would count twice.
    #[error(
        "its surface crosses or overlaps itself in {} places{}; remedy: let a new surface be drawn \
         (`{}`), or unite the overlapping bodies in a modelling program (boolean union) and export \
         again",
        .0.pairs, first_at(.0), Setting::new(Key::Repair, "remesh")
    )]
    Crosses(Crossings),
    /// There are several shells.
    #[error("{}", describe_shells(.0))]
    SeveralShells(Vec<ShellFact>),
}

impl NotOneBody {
    /// Largest number of shells listed. A scan with more fragments needs cleaning as a whole.
    pub const MAX_LISTED: usize = 12;
}

fn first_at(crossings: &Crossings) -> String {
    crossings.first.map_or(String::new(), |p| {
        format!(", first at ({:.2}, {:.2}, {:.2}) mm", p.x, p.y, p.z)
    })
}

/// Lists the shells and, once for each kind, the remedy.
fn describe_shells(shells: &[ShellFact]) -> String {
    let named = shells
        .iter()
        .take(NotOneBody::MAX_LISTED)
        .map(ToString::to_string);
    let more = shells.len().saturating_sub(NotOneBody::MAX_LISTED);
    let more = (more > 0).then(|| format!("{more} more"));
    let named: Vec<String> = named.chain(more).collect();
    format!(
        "it has {} surfaces: {}; remedy: {}",
        shells.len(),
        named.join(", "),
        remedies(shells).join(", and ")
    )
}

fn remedies(shells: &[ShellFact]) -> Vec<String> {
    let count = |role| shells.iter().filter(|shell| shell.role == role).count();
    let inner = shells.len() - count(ShellRole::Body);
    let within = (inner > 0).then(|| {
        format!(
            "fill the inner surfaces (`{}`), as equipoise makes the voids itself, or keep them as \
             cavities (`{}`)",
            Setting::new(Key::Repair, "fill"),
            Setting::new(Key::Repair, "cavities")
        )
    });
    let beside = (count(ShellRole::Body) > 1).then(|| {
        "join the separate bodies into one (boolean union, with a bridge where they do not touch), \
         or keep the one that is meant"
            .to_owned()
    });
    within.into_iter().chain(beside).collect()
}

/// Checks that a solid is one body: a single shell that does not pass through itself.
///
/// A kit's voids, cuts and moments depend on it. Costs as much as [`Crossings::of`], plus a pass
/// over the triangles for each pair of shells.
///
/// # Errors
/// The watch was stopped before the answer was found.
pub fn one_body(solid: &Solid, watch: &Watch) -> Result<Result<(), NotOneBody>, Cancelled> {
    one_body_with(solid, InnerSurfaces::Refuse, watch)
}

/// Checks like [`one_body`], but lets the body have cavities if that is the order.
///
/// # Errors
/// The watch was stopped before the answer was found.
pub fn one_body_with(
    solid: &Solid,
    inner: InnerSurfaces,
    watch: &Watch,
) -> Result<Result<(), NotOneBody>, Cancelled> {
    let mesh = solid.mesh();
    let crossings = Crossings::of_watched(mesh, watch)?;
    if crossings.pairs > 0 {
        return Ok(Err(NotOneBody::Crosses(crossings)));
    }
    let shells = Shells::of(mesh, &EdgeTable::of(mesh));
    if shells.count() == 1 {
        return Ok(Ok(()));
    }
    let facts = facts(mesh, &shells);
    let is_allowed =
        |fact: &ShellFact| fact.role == ShellRole::Cavity && inner == InnerSurfaces::Cavities;
    let others = facts.iter().filter(|fact| !is_allowed(fact));
    let is_one = others.map(|fact| fact.role).eq([ShellRole::Body]);
    Ok(if is_one {
        Ok(())
    } else {
        Err(NotOneBody::SeveralShells(facts))
    })
}

/// Returns the facts of each shell, the largest first.
fn facts(mesh: &TriMesh, shells: &Shells) -> Vec<ShellFact> {
    let (volumes, enclosing) = (shells.volumes_mm3(mesh), shells.enclosing(mesh));
    let mut facts: Vec<ShellFact> = (0..shells.count())
        .map(|shell| ShellFact {
            role: role(&volumes, &enclosing[shell], shell),
            volume_mm3: volumes[shell].abs(),
            center: shell_box(mesh, &shells.members()[shell]).center(),
        })
        .collect();
    facts.sort_by(|a, b| b.volume_mm3.total_cmp(&a.volume_mm3));
    facts
}

fn role(volumes: &[f64], around: &[usize], shell: usize) -> ShellRole {
    let winding: f64 = around.iter().map(|&outer| volumes[outer].signum()).sum();
    if volumes[shell] < 0.0 {
        ShellRole::Cavity
    } else if around.is_empty() {
        ShellRole::Body
    } else if winding > 0.0 {
        ShellRole::Doubled
    } else {
        ShellRole::Island
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    fn cube(half: f64) -> TriMesh {
        cuboid(
            &Point::new(-half, -half, -half),
            &Point::new(half, half, half),
        )
    }

    fn judge(mesh: TriMesh) -> Result<(), NotOneBody> {
        one_body(&Solid::new(mesh).unwrap(), &Watch::silent()).unwrap()
    }

    fn refusal(mesh: TriMesh) -> NotOneBody {
        judge(mesh).unwrap_err()
    }

    fn roles(mesh: TriMesh) -> Vec<ShellRole> {
        match refusal(mesh) {
            NotOneBody::SeveralShells(shells) => shells.iter().map(|shell| shell.role).collect(),
            crosses => panic!("{crosses}"),
        }
    }

    #[test]
    fn a_single_closed_surface_is_one_body() {
        for mesh in [cube(2.0), ball(&Point::origin(), 1.0, 2)] {
            assert_eq!(judge(mesh), Ok(()));
        }
    }

    #[test]
    fn each_shell_gets_its_role_from_the_shells_around_it() {
        use ShellRole::*;
        let onion = cube(4.0).joined(&cube(3.0).reversed()).joined(&cube(2.0));
        assert_eq!(roles(onion), [Body, Cavity, Island]);
        assert_eq!(roles(cube(4.0).joined(&cube(3.0))), [Body, Doubled]);
        let apart = cuboid(&Point::new(9.0, 0.0, 0.0), &Point::new(10.0, 1.0, 1.0));
        assert_eq!(roles(cube(4.0).joined(&apart)), [Body, Body]);
    }

    #[test]
    fn cavities_are_allowed_if_they_are_ordered_and_loose_bodies_never() {
        let allows = |mesh: TriMesh| {
            let solid = Solid::new(mesh).unwrap();
            let judged = one_body_with(&solid, InnerSurfaces::Cavities, &Watch::silent());
            judged.unwrap().is_ok()
        };
        let hollow = cube(4.0).joined(&cube(3.0).reversed());
        assert!(allows(hollow.clone()));
        assert!(judge(hollow.clone()).is_err());
        assert!(!allows(hollow.joined(&cube(2.0))));
    }

    #[test]
    fn the_message_names_place_volume_and_remedy_of_each_shell() {
        let hole = cuboid(&Point::new(1.0, 1.0, 1.0), &Point::new(3.0, 3.0, 3.0)).reversed();
        let message = refusal(cube(4.0).joined(&hole)).to_string();
        assert!(
            message.contains("a cavity of 8.000 mm³ about (2.00, 2.00, 2.00) mm"),
            "{message}"
        );
        assert!(
            message.contains("fill the inner surfaces") && !message.contains("separate"),
            "{message}"
        );
    }

    #[test]
    fn a_hundred_fragments_are_counted_not_listed() {
        let fragment =
            |i: i32| cube(0.1).map_vertices(|p| p + crate::geom::Vector::x() * f64::from(i));
        let message = refusal(
            (0..100)
                .map(fragment)
                .reduce(|all, next| all.joined(&next))
                .unwrap(),
        )
        .to_string();
        assert!(
            message.contains("it has 100 surfaces") && message.contains("88 more"),
            "{message}"
        );
    }

    #[test]
    fn bodies_that_overlap_are_to_be_united() {
        let other = cuboid(&Point::new(1.0, 1.0, 1.0), &Point::new(9.0, 9.0, 9.0));
        let message = refusal(cube(4.0).joined(&other)).to_string();
        assert!(
            message.contains("crosses or overlaps itself") && message.contains("boolean union"),
            "{message}"
        );
    }
}
