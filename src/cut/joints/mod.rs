//! Pins, dowels, bosses and labels of the joints between parts.

pub(crate) mod bench;
mod body_points;
pub(crate) mod boss;
pub(crate) mod boss_maker;
pub(crate) mod boss_places;
pub(crate) mod boss_sets;
pub(crate) mod boss_view;
pub(crate) mod bosses;
pub(crate) mod contact;
pub(crate) mod cradle;
pub(crate) mod face;
pub(crate) mod free_joint;
pub(crate) mod hold;
pub(crate) mod jig;
pub(crate) mod label;
pub(crate) mod pattern;
pub(crate) mod pin_shape;
pub(crate) mod pin_size;
pub(crate) mod pins;
pub(crate) mod placement;
pub(crate) mod rod;
pub(crate) mod shelf;
pub(crate) mod sketch;
pub(crate) mod socket_wall;
mod stand;
mod stops;

#[cfg(test)]
mod tests;
