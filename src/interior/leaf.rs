//! A cell of an octree, named by its place on a space-filling curve.

/// Largest number of bits of a coordinate, so that three of them interleaved fit 64.
pub(super) const MOST_LEVELS: u32 = 21;

/// An octree cell: its coordinates in finest cells, interleaved (Morton order), and its width. The
/// codes of its descendants lie between its own and that of the next cell of its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Leaf {
    /// Interleaved coordinates of the low corner.
    pub code: u64,
    /// Logarithm (base 2) of its width in finest cells.
    pub log_width: u32,
    finest_level: u32,
}

impl Leaf {
    /// Returns the cell that holds all others.
    pub fn root(finest_level: u32) -> Self {
        Self {
            code: 0,
            log_width: finest_level,
            finest_level,
        }
    }

    /// Returns the level: 0 at the root, one more with each halving.
    pub fn level(&self) -> u32 {
        self.finest_level - self.log_width
    }

    /// Returns the eight children in the order of their codes; a finest cell has none.
    pub fn children(&self) -> Vec<Self> {
        let Some(log_width) = self.log_width.checked_sub(1) else {
            return Vec::new();
        };
        (0..8)
            .map(|i| Self {
                code: self.code + (i << (3 * log_width)),
                log_width,
                ..*self
            })
            .collect()
    }

    /// Returns the cell of which this one is an eighth; `None` for the root.
    pub fn parent(&self) -> Option<Self> {
        let log_width = self.log_width + 1;
        let code = self.code >> (3 * log_width) << (3 * log_width);
        (log_width <= self.finest_level).then_some(Self {
            code,
            log_width,
            ..*self
        })
    }

    /// Returns whether the other's low corner lies in this cell.
    pub fn contains(&self, other: &Self) -> bool {
        (other.code ^ self.code) >> (3 * self.log_width) == 0
    }

    /// Returns the low corner in finest cells.
    pub fn corner(&self) -> [u32; 3] {
        [0, 1, 2].map(|axis| compact(self.code >> axis))
    }

    /// Returns the cell of the same width one step along an axis; `None` outside the root.
    pub fn beside(&self, axis: usize, forward: bool) -> Option<Self> {
        let mut corner = self.corner();
        let width = 1 << self.log_width;
        let moved = if forward {
            corner[axis].checked_add(width)
        } else {
            corner[axis].checked_sub(width)
        };
        corner[axis] = moved.filter(|&at| at < 1 << self.finest_level)?;
        Some(Self {
            code: interleave(corner),
            ..*self
        })
    }
}

/// Returns the code of a place in finest cells.
pub(super) fn interleave(corner: [u32; 3]) -> u64 {
    corner
        .iter()
        .enumerate()
        .map(|(axis, &at)| spread(at) << axis)
        .sum()
}

/// Returns the lowest 21 bits, each followed by two zeros.
fn spread(bits: u32) -> u64 {
    let steps = [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ];
    steps.iter().fold(u64::from(bits), |bits, &(shift, mask)| {
        (bits | bits << shift) & mask
    })
}

/// Returns every third bit.
fn compact(code: u64) -> u32 {
    let steps = [
        (2, 0x10c3_0c30_c30c_30c3),
        (4, 0x100f_00f0_0f00_f00f),
        (8, 0x001f_0000_ff00_00ff),
        (16, 0x001f_0000_0000_ffff),
        (32, 0x0000_0000_001f_ffff),
    ];
    let first = code & 0x1249_2492_4924_9249;
    steps
        .iter()
        .fold(first, |bits, &(shift, mask)| (bits ^ bits >> shift) & mask) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_comes_back_from_its_code() {
        for corner in [
            [0, 0, 0],
            [1, 2, 3],
            [511, 0, 256],
            [(1 << MOST_LEVELS) - 1, 12345, 1 << 20],
        ] {
            let leaf = Leaf {
                code: interleave(corner),
                log_width: 0,
                finest_level: MOST_LEVELS,
            };
            assert_eq!(leaf.corner(), corner);
        }
    }

    #[test]
    fn children_fill_their_parent_in_order() {
        let children = Leaf::root(5).children();
        assert!(children.windows(2).all(|pair| pair[0].code < pair[1].code));
        assert!(
            children
                .iter()
                .all(|child| child.parent() == Some(Leaf::root(5)) && child.level() == 1)
        );
        assert!(
            children[7].contains(&children[7].children()[3]) && !children[6].contains(&children[7])
        );
    }

    #[test]
    fn steps_along_an_axis_come_back_and_end_at_the_root() {
        let leaf = Leaf::root(4).children()[5];
        let back = leaf.beside(0, false).unwrap();
        assert_eq!(back.beside(0, true), Some(leaf));
        assert_eq!(leaf.beside(0, true), None);
        assert_eq!(leaf.beside(1, false), None);
    }
}
