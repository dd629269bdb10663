//! The voids that drain, their holes, and the way out of each.

use std::collections::VecDeque;

use super::doors::Door;
use super::escapes::Escape;

/// The ways out of all voids.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Flow {
    /// The holes that are made.
    pub escapes: Vec<Escape>,
    /// The next void on the way out of each one, and the hole at its end; `None` for voids without
    /// a way. The next one of a void with a hole is itself.
    pub ways: Vec<Option<Way>>,
}

/// The way out of a void.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Way {
    /// The next void.
    pub next: usize,
    /// The hole at the end.
    pub escape: usize,
}

impl Flow {
    /// Chooses so many holes for each set of voids that doors connect, far apart from each other,
    /// and finds the shortest ways to them. Sets that cannot have so many have no way.
    pub fn of(possible: &[Vec<Escape>], doors: &[Door], holes: usize) -> Self {
        let mut flow = Self {
            escapes: Vec::new(),
            ways: vec![None; possible.len()],
        };
        let mut beside = vec![Vec::new(); possible.len()];
        for door in doors {
            let [one, other] = door.voids;
            beside[one].push(other);
            beside[other].push(one);
        }
        let mut seen = vec![false; possible.len()];
        for start in 0..possible.len() {
            if seen[start] {
                continue;
            }
            let connected = connected(start, &beside, &mut seen);
            let all = connected.iter().flat_map(|&void| &possible[void]);
            let chosen = far_apart(all.copied().collect(), holes);
            if chosen.len() == holes {
                flow.lead_to(&chosen, &beside);
                flow.escapes.extend(chosen);
            }
        }
        flow
    }

    /// Leads connected voids to holes that get the next numbers.
    fn lead_to(&mut self, holes: &[Escape], beside: &[Vec<usize>]) {
        let mut open = VecDeque::new();
        for (index, hole) in holes.iter().enumerate() {
            let escape = self.escapes.len() + index;
            let way = &mut self.ways[hole.void];
            if way.is_none() {
                *way = Some(Way {
                    next: hole.void,
                    escape,
                });
                open.push_back((hole.void, escape));
            }
        }
        while let Some((void, escape)) = open.pop_front() {
            for &other in &beside[void] {
                if self.ways[other].is_none() {
                    self.ways[other] = Some(Way { next: void, escape });
                    open.push_back((other, escape));
                }
            }
        }
    }

    /// Returns the voids on the way out, the void itself first; none if it has no way.
    pub fn path(&self, void: usize) -> Vec<usize> {
        let mut path = Vec::new();
        let mut at = void;
        while let Some(way) = self.ways[at] {
            path.push(at);
            if way.next == at {
                break;
            }
            at = way.next;
        }
        path
    }
}

/// Returns the voids that are connected with one, and marks them as seen.
fn connected(start: usize, beside: &[Vec<usize>], seen: &mut [bool]) -> Vec<usize> {
    seen[start] = true;
    let mut found = vec![start];
    let mut next = 0;
    while let Some(&void) = found.get(next) {
        next += 1;
        for &other in &beside[void] {
            if !seen[other] {
                seen[other] = true;
                found.push(other);
            }
        }
    }
    found
}

/// Returns so many holes: the shortest, then always the one farthest from those before it.
fn far_apart(mut all: Vec<Escape>, count: usize) -> Vec<Escape> {
    let length = |hole: &Escape| (hole.mouth - hole.from).norm();
    all.sort_by(|a, b| length(a).total_cmp(&length(b)));
    let mut chosen: Vec<Escape> = Vec::new();
    while chosen.len() < count {
        let far = |hole: &&Escape| {
            let distances = chosen.iter().map(|other| (hole.mouth - other.mouth).norm());
            distances.fold(f64::INFINITY, f64::min)
        };
        let is_new = |hole: &&Escape| !chosen.contains(hole);
        let next = match chosen.is_empty() {
            true => all.first(),
            false => {
                let others = all.iter().filter(is_new);
                others.max_by(|a, b| far(a).total_cmp(&far(b)))
            }
        };
        let Some(next) = next.copied() else {
            break;
        };
        chosen.push(next);
    }
    chosen
}
