//! What a layer costs, in operations: the same number on every machine.
//!
//! An **operation** is one addition, multiplication, division or square root of floating-point
//! numbers. An elementary function counts as [`ELEMENTARY`] of them. The operations of a function are counted in its source, where its call is noted;
//! comparisons, memory and allocation are not counted, nor is anything that happens once. The count
//! is good for comparing layers that differ tenfold or more, and says nothing of vector
//! instructions; `vinesink tradeoff` shows the time that an operation took beside it.
//!
//! Counts are kept for each thread and only ever grow: what is computed does not depend on them.
//!
//! For the program itself: this module may change at any time.

use std::cell::Cell;

/// Operations that a sine, cosine, exponential, logarithm or arctangent stands for: a polynomial of
/// some ten terms and the reduction of its argument.
pub const ELEMENTARY: u64 = 20;

thread_local! {
    static OPERATIONS: Cell<u64> = const { Cell::new(0) };
}

/// Notes that so many operations were carried out.
#[inline]
pub fn note(operations: u64) {
    OPERATIONS.with(|count| count.set(count.get().wrapping_add(operations)));
}

/// What `work` returns, and the operations that were noted meanwhile.
pub fn counted<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = OPERATIONS.with(Cell::get);
    let result = work();
    (result, OPERATIONS.with(Cell::get).wrapping_sub(before))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_nest_and_do_not_leak_into_one_another() {
        let (inner, outer) = counted(|| {
            note(3);
            let ((), inner) = counted(|| note(4));
            note(5);
            inner
        });
        assert_eq!((inner, outer), (4, 12));
        assert_eq!(counted(|| ()).1, 0);
    }
}
