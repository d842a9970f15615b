//! The report: plain data, and the figures that go with it.

pub mod figure;
pub mod figures;
pub mod numbers;
