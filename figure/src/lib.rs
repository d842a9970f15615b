//! Figures: plain data, and one renderer that turns them into SVG.
//!
//! The figures know nothing of physics. [`render`] is a function of its argument alone: the same
//! figure gives the same bytes. The way from one to the other:
//!
//! ```text
//! Figure ─> limits ─> layout ─> shapes ─> labels ─┬─> frame (grid, ticks, edges)
//!                       ^                   │     ├─> paint, image (data, tooltips)
//!                       └── names without ──┘     └─> text (all words)
//!                           a place go to a legend
//! ```
//!
//! For the program itself: this module may change at any time.
#![warn(missing_docs)]
#![forbid(unsafe_code)]

mod candidates;
mod colors;
mod data;
mod frame;
mod geometry;
mod image;
mod labels;
mod layers;
mod layout;
mod limits;
mod markers;
mod narrow;
mod paint;
mod palette;
mod raster;
mod render;
mod shapes;
mod text;
mod ticks;

pub use colors::{Ramp, Tint};
pub use data::{Axis, AxisScale, Figure, GridCell, Key, Layout, Panel, Tick};
pub use geometry::Rect;
pub use image::{Cells, Image, edges};
pub use layers::{Fill, Hatch, Label, Layer, MarkedPoint, Rule};
pub use limits::inliers;
pub use palette::{Color, Dash, Marker, Role, Shape, Style};
pub use render::{Drawing, FigureError, LIMIT, PlacedPanel, PlacedText, draw, render};
pub use text::{escape, is_control};
