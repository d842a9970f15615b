//! The figures of a sweep. Titles, captions and alternative texts are in `templates/captions/sweep-*.tera`.

mod contours;
mod lines;
mod maps;
mod overlay;

use super::Swept;
use crate::case::Recorded;
use crate::report::figure::{Figure, Ramp};

/// What has a map, or a diagram over one axis, of its own: the figure's name, the quantity, the colours; of one name the first
/// that is recorded.
const QUANTITIES: [(&str, Recorded, Ramp); 9] = [
    ("sweep-decay-time", Recorded::DecayTime, Ramp::Sequential),
    ("sweep-reduction", Recorded::ReductionDb, Ramp::Diverging),
    ("sweep-amplitude", Recorded::LargestPeak, Ramp::Sequential),
    ("sweep-amplitude", Recorded::Peak, Ramp::Sequential),
    ("sweep-reduction-tmd", Recorded::ReductionDbTmd, Ramp::Diverging),
    ("sweep-peak-frequency", Recorded::PeakFrequency, Ramp::Sequential),
    ("sweep-impacts", Recorded::Impacts, Ramp::Sequential),
    ("sweep-efficiency", Recorded::Efficiency, Ramp::Sequential),
    ("sweep-lyapunov", Recorded::Lyapunov, Ramp::Diverging),
];

/// All figures that the columns allow, the one for the first screen first.
pub(super) fn all(swept: &Swept) -> Vec<Figure> {
    match swept.axes.as_slice() {
        [axis] => lines::all(swept, axis),
        _ => maps::all(swept),
    }
}
