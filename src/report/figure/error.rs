//! What can be wrong with a figure.

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There is nothing to draw.
    #[error("figure {name} has no panels; add one with `with_panel`")]
    NoPanels {
        /// The figure's name.
        name: String,
    },
    /// The layout and the panels do not match.
    #[error("figure {name}: {reason}")]
    Layout {
        /// The figure's name.
        name: String,
        /// What does not fit.
        reason: String,
    },
    /// The figure is too small for its axes and words.
    #[error(
        "figure {name}: panel {panel} is left with {width:.0} x {height:.0} pixels; enlarge the figure"
    )]
    TooSmall {
        /// The figure's name.
        name: String,
        /// The panel's index, from 0.
        panel: usize,
        /// Width left for the data, pixels.
        width: f64,
        /// Height left for the data, pixels.
        height: f64,
    },
    /// A fixed range is empty, not finite, or not positive on a logarithmic axis.
    #[error("figure {name}: axis {axis:?} cannot run from {first} to {last}")]
    Range {
        /// The figure's name.
        name: String,
        /// The axis' label.
        axis: String,
        /// First value.
        first: f64,
        /// Last value.
        last: f64,
    },
    /// Even coarse, the file would be too large.
    #[error("figure {name} takes {bytes} bytes, {limit} are allowed; draw fewer points")]
    TooLarge {
        /// The figure's name.
        name: String,
        /// Its size, coarsest drawing.
        bytes: usize,
        /// The limit.
        limit: usize,
    },
    /// The drawing library refused.
    #[error("figure {name}: {reason}")]
    Backend {
        /// The figure's name.
        name: String,
        /// The library's words.
        reason: String,
    },
}
