//! The report: plain data, and the figures that go with it.

pub mod documents;
pub mod figure;
pub mod numbers;
pub mod summary;
