//! vinesink for a web page: a request in JSON goes in, an answer in JSON comes out; the running simulation's numbers
//! stay in memory for the page to read.
//!
//! The page writes a request of `length` bytes at `room(length)`, calls `ask(length)`, and reads `answer_length()`
//! bytes at `answer_at()`. Nothing else is shared.

mod answers;
mod controls;
mod one;
mod plain;
mod running;
mod several;
mod told;

use std::cell::RefCell;

thread_local! {
    static TEXT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static NUMBERS: RefCell<Vec<f64>> = const { RefCell::new(Vec::new()) };
}

/// Room for a request of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    TEXT.with_borrow_mut(|text| {
        text.clear();
        text.resize(length, 0);
        text.as_mut_ptr()
    })
}

/// Answers the request that lies in the room; the answer takes its place.
#[unsafe(no_mangle)]
pub extern "C" fn ask() {
    let request = TEXT.take();
    TEXT.set(answers::to(&request));
}

/// Where the answer is, until the next call of [`room`].
#[unsafe(no_mangle)]
pub extern "C" fn answer_at() -> *const u8 {
    TEXT.with_borrow(|text| text.as_ptr())
}

/// How many bytes it has.
#[unsafe(no_mangle)]
pub extern "C" fn answer_length() -> usize {
    TEXT.with_borrow(Vec::len)
}

/// Lets the running simulation go on for so many periods, with so many points a period; how many numbers
/// describe what happened: see `running::go_on`.
#[unsafe(no_mangle)]
pub extern "C" fn go_on(periods: u32, samples: f64) -> usize {
    NUMBERS.with_borrow_mut(|numbers| {
        numbers.clear();
        running::go_on(periods, samples, numbers);
        numbers.len()
    })
}

/// Where these numbers are, until the next call of [`go_on`].
#[unsafe(no_mangle)]
pub extern "C" fn numbers_at() -> *const f64 {
    NUMBERS.with_borrow(|numbers| numbers.as_ptr())
}
