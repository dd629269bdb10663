//! The resin that a part, the platform and the film enclose while the part is printed.

use super::columns::Columns;
use crate::mesh::TriMesh;
use crate::mesh::union_find::UnionFind;

/// Volume of all cups of a part from which it breaks a rule, mm³. Smaller ones, such as a socket or
/// a letter, drain and cause no suction. The judge allows twice as much, for another grid.
pub const LEAST_CUP_MM3: f64 = 75.0;

/// A place of a part that encloses resin at some layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Cup {
    /// Its volume, mm³.
    pub volume_mm3: f64,
    /// The triangle under its lowest place; `None` on the platform.
    pub floor: Option<u32>,
    /// The place as closed boxes side by side, in the part's frame.
    pub body: TriMesh,
}

/// Returns the volume in which resin is enclosed at some layer, mm³.
///
/// A passage narrower than the grid counts as closed. A wall thinner than the grid may count as
/// open.
pub fn cup_volume_mm3(columns: &Columns) -> f64 {
    let enclosed = enclosed_stretches(columns);
    let mut enclosed_mm = 0.0;
    for line in 0..columns.lines() {
        for index in columns.range(line) {
            enclosed_mm += enclosed[index].map_or(0.0, |[from_mm, to_mm]| to_mm - from_mm);
        }
    }
    enclosed_mm * columns.pitch_mm * columns.pitch_mm
}

/// Returns the places in which resin is enclosed at some layer, the largest first. Their volumes
/// add up to [`cup_volume_mm3`].
pub fn find_cups(columns: &Columns) -> Vec<Cup> {
    let enclosed = enclosed_stretches(columns);
    let mut sets = UnionFind::new(enclosed.len());
    let stretches = |line: usize| {
        let indices = columns.range(line);
        indices.filter_map(|index| Some((index, enclosed[index]?)))
    };
    for line in 0..columns.lines() {
        for next in columns.next_lines(line) {
            for (i, [from_mm, to_mm]) in stretches(line) {
                for (j, other) in stretches(next) {
                    if from_mm.max(other[0]) < to_mm.min(other[1]) {
                        sets.merge(i as u32, j as u32);
                    }
                }
            }
        }
    }
    let (labels, count) = sets.labels();
    let mut places: Vec<Vec<Stretch>> = vec![Vec::new(); count];
    for line in 0..columns.lines() {
        for (gap, index) in columns.gaps(line).iter().zip(columns.range(line)) {
            if let Some(span_mm) = enclosed[index] {
                places[labels[index] as usize].push(Stretch {
                    line,
                    span_mm,
                    floor: gap.below,
                });
            }
        }
    }
    places.retain(|place| !place.is_empty());
    let mut cups: Vec<Cup> = places.iter().map(|place| to_cup(columns, place)).collect();
    cups.sort_by(|a, b| b.volume_mm3.total_cmp(&a.volume_mm3));
    cups
}

/// A stretch of a line that is enclosed.
#[derive(Clone, Copy)]
struct Stretch {
    line: usize,
    span_mm: [f64; 2],
    floor: Option<u32>,
}

fn to_cup(columns: &Columns, place: &[Stretch]) -> Cup {
    let lowest = place
        .iter()
        .min_by(|a, b| a.span_mm[0].total_cmp(&b.span_mm[0]));
    let cell_mm2 = columns.pitch_mm * columns.pitch_mm;
    let cell = |stretch: &Stretch| columns.cell(stretch.line, stretch.span_mm);
    Cup {
        volume_mm3: place
            .iter()
            .map(|stretch| cell_mm2 * (stretch.span_mm[1] - stretch.span_mm[0]))
            .sum(),
        floor: lowest.and_then(|stretch| stretch.floor),
        body: place.iter().fold(TriMesh::default(), |all, stretch| {
            all.joined(&cell(stretch))
        }),
    }
}

/// Returns for each gap the heights between which it is enclosed, mm; `None` if it never is.
///
/// At each layer, the film closes what is open toward it. The air below is enclosed if no way
/// through printed layers leads outside. So a gap is enclosed from its lower end up to the height
/// at which it meets the outside. Of all ways there, that is the one with the lowest summit.
/// Merging neighbours in the order in which they meet finds it (Kruskal 1956).
fn enclosed_stretches(columns: &Columns) -> Vec<Option<[f64; 2]>> {
    let gaps = columns.count();
    let outside = gaps as u32;
    let mut sets = UnionFind::new(gaps + 1);
    // The gaps of each set that have not met the outside.
    let mut members: Vec<Vec<u32>> = (0..=outside).map(|gap| vec![gap]).collect();
    let mut met_mm = vec![f64::INFINITY; gaps];
    for meeting in meetings(columns) {
        let [a, b] = meeting.gaps.map(|gap| sets.root(gap));
        if a == b {
            continue;
        }
        let of_outside = sets.root(outside);
        sets.merge(a, b);
        let (kept, lost) = (a.min(b), a.max(b));
        let moved = std::mem::take(&mut members[lost as usize]);
        let stays = std::mem::take(&mut members[kept as usize]);
        if of_outside == a || of_outside == b {
            for gap in moved.into_iter().chain(stays).filter(|gap| *gap != outside) {
                met_mm[gap as usize] = met_mm[gap as usize].min(meeting.height_mm);
            }
        } else {
            let (mut long, short) = if stays.len() >= moved.len() {
                (stays, moved)
            } else {
                (moved, stays)
            };
            long.extend(short);
            members[kept as usize] = long;
        }
    }
    let mut enclosed = vec![None; gaps];
    for line in 0..columns.lines() {
        for (gap, index) in columns.gaps(line).iter().zip(columns.range(line)) {
            let end_mm = met_mm[index].min(gap.to_mm).min(columns.height_mm);
            enclosed[index] = (end_mm > gap.from_mm).then_some([gap.from_mm, end_mm]);
        }
    }
    enclosed
}

/// Two neighbouring gaps that meet, or a gap and the outside.
struct Meeting {
    height_mm: f64,
    gaps: [u32; 2],
}

/// Returns where neighbouring gaps meet, the lowest first. Gaps on the rim of the grid meet the
/// outside, whose number is that of all gaps.
fn meetings(columns: &Columns) -> Vec<Meeting> {
    let outside = columns.count() as u32;
    let mut meetings = Vec::new();
    for line in 0..columns.lines() {
        let here = || columns.gaps(line).iter().zip(columns.range(line));
        if columns.is_on_rim(line) {
            meetings.extend(here().map(|(gap, index)| Meeting {
                height_mm: gap.from_mm,
                gaps: [index as u32, outside],
            }));
        }
        for next in columns.next_lines(line) {
            for (a, i) in here() {
                for (b, j) in columns.gaps(next).iter().zip(columns.range(next)) {
                    let height_mm = a.from_mm.max(b.from_mm);
                    if height_mm < a.to_mm.min(b.to_mm) {
                        let gaps = [i as u32, j as u32];
                        meetings.push(Meeting { height_mm, gaps });
                    }
                }
            }
        }
    }
    meetings.sort_unstable_by(|a, b| {
        a.height_mm
            .total_cmp(&b.height_mm)
            .then(a.gaps.cmp(&b.gaps))
    });
    meetings
}
