//! The item seen at each pixel of a picture, so that the line from a name ends on what it names.

use super::svg::Spot;

/// Distance behind the seen surface at which a point still counts as seen, as a share of the
/// picture's depth. Its own surface is drawn at the pixels beside it.
const BEHIND_RATIO: f64 = 0.01;

/// The item and the depth at every pixel of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Visibility {
    /// Pixels in a row.
    pub width: usize,
    /// The index of the item seen; `None` for paper and for the cut face.
    pub items: Vec<Option<u32>>,
    /// The coordinate toward the viewer, mm; minus infinity for paper.
    pub nearness_mm: Vec<f64>,
}

impl Visibility {
    /// Returns the middle of the visible region of an item: its pixel farthest from all others.
    /// `None` if the item is hidden.
    pub fn middle_of(&self, item: usize) -> Option<Spot> {
        let depths = self.depths_of(item as u32);
        let deepest = (0..depths.len()).rev().max_by_key(|&at| depths[at])?;
        (depths[deepest] > 0)
            .then(|| [deepest % self.width, deepest / self.width].map(|pixel| pixel as f64 + 0.5))
    }

    /// Returns whether nothing is drawn in front of a point at this spot and depth.
    pub fn shows(&self, [x, y]: Spot, nearness_mm: f64) -> bool {
        let (low, high) = self
            .nearness_mm
            .iter()
            .filter(|near| near.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), near| {
                (low.min(*near), high.max(*near))
            });
        let at = y.max(0.0) as usize * self.width + (x.max(0.0) as usize).min(self.width - 1);
        self.nearness_mm
            .get(at)
            .is_none_or(|near| nearness_mm >= near - BEHIND_RATIO * (high - low))
    }

    /// Returns the distance of each pixel of an item from the pixels of other things, zero outside
    /// the item. A step goes along a row, a column or a diagonal. One pass down and one up
    /// (Rosenfeld and Pfaltz, "Sequential operations in digital picture processing", 1966).
    fn depths_of(&self, item: u32) -> Vec<u32> {
        let width = self.width;
        let mut depths: Vec<u32> = self
            .items
            .iter()
            .map(|seen| u32::from(*seen == Some(item)))
            .collect();
        let count = depths.len();
        let of = |depths: &[u32], at: Option<usize>| {
            at.and_then(|at| depths.get(at).copied()).unwrap_or(0)
        };
        for at in 0..count {
            let near = [
                at.checked_sub(1),
                at.checked_sub(width),
                at.checked_sub(width + 1),
                at.checked_sub(width - 1),
            ];
            depths[at] *= 1 + near
                .map(|next| of(&depths, next))
                .into_iter()
                .min()
                .unwrap_or(0);
        }
        for at in (0..count).rev() {
            let near = [at + 1, at + width, at + width + 1, at + width - 1];
            let more = 1 + near
                .map(|next| of(&depths, Some(next)))
                .into_iter()
                .min()
                .unwrap_or(0);
            depths[at] = depths[at].min(more);
        }
        depths
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a picture from letters: each letter is an item, dots are paper.
    fn picture_of(rows: &[&str]) -> Visibility {
        let items: Vec<Option<u32>> = rows
            .concat()
            .bytes()
            .map(|b| b.checked_sub(b'a').map(u32::from))
            .collect();
        let nearness_mm = items
            .iter()
            .map(|item| item.map_or(f64::NEG_INFINITY, f64::from))
            .collect();
        Visibility {
            width: rows[0].len(),
            items,
            nearness_mm,
        }
    }

    #[test]
    fn the_middle_of_an_item_is_where_most_of_it_is_seen() {
        let picture = picture_of(&[
            ".........",
            ".aaa.....",
            ".aaabbb..",
            ".aaabbb..",
            "...bbbb..",
            ".aa......",
            ".........",
        ]);
        assert_eq!(picture.middle_of(0), Some([2.5, 2.5]));
        let [x, y] = picture.middle_of(1).unwrap();
        assert_eq!(picture.items[y as usize * 9 + x as usize], Some(1));
        assert_eq!(picture.middle_of(2), None);
    }

    #[test]
    fn a_point_behind_another_item_is_hidden() {
        let picture = picture_of(&["...", ".b.", ".a."]);
        assert!(picture.shows([1.5, 1.5], 1.0) && !picture.shows([1.5, 1.5], 0.5));
        assert!(
            picture.shows([0.5, 0.5], -9.0),
            "nothing is in front of paper"
        );
    }
}
