//! The face that keeps each obstacle away.
//!
//! Two rules take turns. The first is good for faces that tilt, but it can stall. A face that could
//! move far takes obstacles beside it, and stays for their sake. The second rule leaves those to
//! faces that cannot move anyway.

/// For each plane, by how much it parts each obstacle, mm.
pub(super) type Parted = [Vec<f64>];

/// Deals every obstacle to the face that parts it best.
pub(super) fn deal_to_best(parted: &Parted) -> Vec<usize> {
    let count = parted.first().map_or(0, Vec::len);
    let mut best = vec![(f64::NEG_INFINITY, 0_usize); count];
    for (face, parted) in parted.iter().enumerate() {
        for (best, &parted) in best.iter_mut().zip(parted) {
            if parted > best.0 {
                *best = (parted, face);
            }
        }
    }
    best.into_iter().map(|(_, face)| face).collect()
}

/// Deals every obstacle to the face that it hinders least, of those that part it by the distance.
///
/// A face can move as far as the obstacles allow that it alone parts, but no farther than
/// `most_mm`. It is hindered by what it parts by less after that move.
pub(super) fn deal_to_idle(parted: &Parted, distance_mm: f64, most_mm: f64) -> Vec<usize> {
    let mut owners = deal_to_best(parted);
    let mut freedom_mm = vec![most_mm; parted.len()];
    for (obstacle, &owner) in owners.iter().enumerate() {
        let is_parted_by = |face: &usize| parted[*face][obstacle] >= distance_mm;
        let is_alone = (0..parted.len()).filter(is_parted_by).nth(1).is_none();
        if is_alone {
            let room_mm = parted[owner][obstacle] - distance_mm;
            freedom_mm[owner] = freedom_mm[owner].min(room_mm);
        }
    }
    for (obstacle, owner) in owners.iter_mut().enumerate() {
        let mut least = parted[*owner][obstacle] - freedom_mm[*owner];
        for (face, parted) in parted.iter().enumerate() {
            let left = parted[obstacle] - freedom_mm[face];
            if parted[obstacle] >= distance_mm && left > least {
                (least, *owner) = (left, face);
            }
        }
    }
    owners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_that_can_move_leaves_obstacles_to_one_that_cannot() {
        // The first face alone parts the first obstacle, and only just; the second alone parts the
        // last one, from afar. Both part the one between.
        let parted = [vec![5.0, 5.0, -9.0], vec![-9.0, 8.0, 30.0]];
        assert_eq!(deal_to_best(&parted), [0, 1, 1]);
        assert_eq!(deal_to_idle(&parted, 5.0, 50.0), [0, 0, 1]);
        // It keeps what the other does not part by the distance.
        let parted = [vec![5.0, 4.9, -9.0], vec![-9.0, 8.0, 30.0]];
        assert_eq!(deal_to_idle(&parted, 5.0, 50.0), [0, 1, 1]);
    }
}
