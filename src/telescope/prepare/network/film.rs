//! The bodies of a network that move: for the page and other programs.

use super::super::error::TelescopeRunError;
use super::super::files::wanted_points;
use super::super::moving::{Moving, MovingBody, limb_bodies};
use super::draft::MadeNetwork;
use super::made::{Workshop, prefix};
use crate::geom::Point;
use crate::page::FilmPlace;
use crate::repair::weld;
use crate::telescope::prepare::motion_file::motion;

/// Returns the bodies of a network, with a limb's colours as in its pictures.
pub fn moving(workshop: &Workshop, made: &MadeNetwork) -> Result<Moving, TelescopeRunError> {
    let limbs = made.limbs.iter().enumerate();
    let shells = limbs.flat_map(|(limb, own)| limb_bodies(limb, own));
    let shells = shells.map(|body| MovingBody {
        color: body.color + 1,
        ..body
    });
    let junctures = made.junctures.iter().enumerate();
    let junctures = junctures.flat_map(|(index, own)| {
        let pieces = own.parts.iter();
        pieces.map(move |part| MovingBody {
            id: part.id.clone(),
            mesh: weld(&part.in_model()),
            color: 0,
            place: FilmPlace::Juncture(index),
            is_named: true,
        })
    });
    let designed = made.tree.limbs.iter().zip(&made.tree.network.limbs);
    let curves = designed.zip(&made.limbs).map(|((designed, limb), own)| {
        let asked = designed.order.asked(workshop.shop, &prefix(&limb.id))?;
        Ok(wanted_points(&asked, own))
    });
    let curves = curves.collect::<Result<Vec<Vec<Point>>, TelescopeRunError>>()?;
    Ok(Moving {
        network: made.tree.network.clone(),
        motions: made.limbs.iter().map(motion).collect(),
        bodies: shells.chain(junctures).collect(),
        curves,
        keys: made.keys(),
        poses: made.poses.clone(),
        up: workshop.loaded.up,
    })
}
