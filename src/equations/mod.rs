//! The paper's equations, stated once, and what the program derives from them.

mod boundaries;
mod fixed_points;
mod manifold;
mod slow_flow;
mod stated;

pub use boundaries::Boundaries;
pub use fixed_points::FixedPoints;
pub use manifold::Manifold;
pub use slow_flow::SlowFlow;
pub use stated::Stated;
