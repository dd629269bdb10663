//! Orders of a tetrahedron's corners that keep its hand.

/// For each corner, an even permutation of the corners that begins with it.
pub const CORNER_FIRST: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 0, 1, 3], [3, 0, 2, 1]];

/// For each pair of corners, an even permutation of the corners that begins with it.
pub const PAIR_FIRST: [[usize; 4]; 6] = [
    [0, 1, 2, 3],
    [0, 2, 3, 1],
    [0, 3, 1, 2],
    [1, 2, 0, 3],
    [1, 3, 2, 0],
    [2, 3, 0, 1],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_order_is_an_even_permutation() {
        for order in CORNER_FIRST.iter().chain(&PAIR_FIRST) {
            let pairs = (0..4).flat_map(|i| (0..i).map(move |j| (j, i)));
            let swaps = pairs.filter(|&(j, i)| order[j] > order[i]).count();
            assert!(swaps.is_multiple_of(2), "{order:?}");
            assert!((0..4).all(|corner| order.contains(&corner)), "{order:?}");
        }
        assert!((0..4).all(|corner| CORNER_FIRST[corner][0] == corner));
    }
}
