//! A browser for the tests, and what must hold of every page in it.

pub mod checks;
pub mod chromium;
