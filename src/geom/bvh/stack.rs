//! The boxes that a query has yet to look at.

/// Postponed boxes that a query keeps without allocating. Trees are a few times log₂ n deep; for a
/// deeper one the rest is allocated, which is only slower.
const STACK_CAPACITY: usize = 64;

/// The postponed boxes of a query, last in, first out.
pub(super) struct Stack<T> {
    first: [T; STACK_CAPACITY],
    len: usize,
    /// The boxes beyond the capacity.
    rest: Vec<T>,
}

impl<T: Copy + Default> Default for Stack<T> {
    fn default() -> Self {
        Self {
            first: [T::default(); STACK_CAPACITY],
            len: 0,
            rest: Vec::new(),
        }
    }
}

impl<T: Copy> Stack<T> {
    /// Adds a box to look at before all others.
    #[inline]
    pub(super) fn push(&mut self, item: T) {
        match self.first.get_mut(self.len) {
            Some(place) => {
                *place = item;
                self.len += 1;
            }
            None => self.rest.push(item),
        }
    }

    /// Takes the box that was added last.
    #[inline]
    pub(super) fn pop(&mut self) -> Option<T> {
        if let Some(item) = self.rest.pop() {
            return Some(item);
        }
        self.len = self.len.checked_sub(1)?;
        Some(self.first[self.len])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_added_last_comes_first_beyond_the_capacity_too() {
        let mut stack = Stack::default();
        let count = 3 * STACK_CAPACITY;
        (0..count).for_each(|item| stack.push(item));
        for item in (count / 2..count).rev() {
            assert_eq!(stack.pop(), Some(item));
        }
        stack.push(7);
        assert_eq!(stack.pop(), Some(7));
        for item in (0..count / 2).rev() {
            assert_eq!(stack.pop(), Some(item));
        }
        assert_eq!(stack.pop(), None);
    }
}
