//! The place of an image on the plate.

use crate::geom::Point;

/// The place of an image's pixels on the plate, and the axes along which they run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImageFrame {
    /// The axis of the plate along which columns are counted: 0 for x, 1 for y.
    pub column_axis: usize,
    /// The senses of the columns and of the rows along their axes: 1 or −1.
    pub signs: [f64; 2],
    /// The places of the first edges of columns and rows along their axes, mm.
    pub origin_mm: [f64; 2],
    /// The edges of a pixel along columns and rows, mm.
    pub pitch_mm: [f64; 2],
    /// The number of columns and rows.
    pub count: [u32; 2],
}

/// The most columns and the most rows: four times those of a display of 16K.
const MOST_PIXELS: u32 = 1 << 16;
/// The most pixels of an image, twice those of a display of 16K. An image takes a byte for each.
const MOST_AREA: u64 = 1 << 28;

impl ImageFrame {
    /// Returns whether a display can have these pixels: some, and not so many that memory or the
    /// sums over them run over.
    pub(super) fn is_display(&self) -> bool {
        let is_some = |count: &u32| (1..=MOST_PIXELS).contains(count);
        self.count.iter().all(is_some) && self.area() <= MOST_AREA
    }

    /// Returns the axes of the plate along which columns and rows are counted.
    pub fn axes(&self) -> [usize; 2] {
        [self.column_axis, 1 - self.column_axis]
    }

    /// Returns the number of pixels.
    pub(super) fn area(&self) -> u64 {
        self.count.iter().map(|count| u64::from(*count)).product()
    }

    /// Returns a point of the plate with its distance along the columns as x and along the rows as
    /// y, mm from the first pixel.
    pub fn to_image(&self, point: &Point) -> Point {
        let along = |way: usize| self.signs[way] * (point[self.axes()[way]] - self.origin_mm[way]);
        Point::new(along(0), along(1), point.z)
    }

    /// Returns true if the image is a mirror image of the plate seen from above.
    pub fn mirrors(&self) -> bool {
        let turned = if self.column_axis == 0 { 1.0 } else { -1.0 };
        turned * self.signs[0] * self.signs[1] < 0.0
    }

    /// Returns the columns and rows that a rectangle of the plate reaches, first and end of each.
    pub(super) fn reach(&self, min_mm: [f64; 2], max_mm: [f64; 2]) -> [[usize; 2]; 2] {
        let corner = |at: [f64; 2]| self.to_image(&Point::new(at[0], at[1], 0.0));
        let (a, b) = (corner(min_mm), corner(max_mm));
        [0, 1].map(|way| {
            let most = f64::from(self.count[way]);
            let low = (a[way].min(b[way]) / self.pitch_mm[way])
                .round()
                .clamp(0.0, most);
            let high = (a[way].max(b[way]) / self.pitch_mm[way])
                .round()
                .clamp(0.0, most);
            [low as usize, high as usize]
        })
    }
}
