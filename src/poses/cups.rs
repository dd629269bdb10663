//! The resin that a part, the platform and the film enclose while the part is printed.

use super::columns::Columns;
use crate::mesh::union_find::UnionFind;

/// Returns the volume in which resin is enclosed at some layer, mm³.
///
/// At each layer, the film closes what is open toward it. The air below is enclosed if no way
/// through printed layers leads outside. So a gap is enclosed from its lower end up to the height
/// at which it meets the outside. Of all ways there, that is the one with the lowest summit.
/// Merging neighbours in the order in which they meet finds it (Kruskal 1956).
///
/// A passage narrower than the grid counts as closed. A wall thinner than the grid may count as
/// open.
pub fn cup_volume_mm3(columns: &Columns) -> f64 {
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
    let mut enclosed_mm = 0.0;
    for line in 0..columns.lines() {
        for (gap, index) in columns.gaps(line).iter().zip(columns.range(line)) {
            enclosed_mm +=
                (met_mm[index].min(gap.to_mm).min(columns.height_mm) - gap.from_mm).max(0.0);
        }
    }
    enclosed_mm * columns.pitch_mm * columns.pitch_mm
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
