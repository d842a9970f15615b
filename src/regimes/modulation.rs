//! How strongly a motion is modulated, and when it is captured in 1:1 resonance.

use serde::Serialize;

use crate::simulation::PeriodRecord;

/// Relative difference between two halves of a window above which the motion has not settled: a
/// chaotic response measured over some hundred periods varies by a few percent.
const UNSETTLED: f64 = 0.15;

/// Stretches in which every period has one impact on each wall.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Captures {
    /// How many stretches.
    pub count: usize,
    /// Share of all periods that lie in one.
    pub share: f64,
    /// The longest, in periods.
    pub longest: usize,
}

/// `(max - min) / (max + min)` of the oscillator's peak per period.
pub fn depth(records: &[PeriodRecord]) -> f64 {
    let (low, high) = records.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), record| {
        (low.min(record.peak), high.max(record.peak))
    });
    if high > 0.0 { (high - low) / (high + low) } else { 0.0 }
}

/// Captures of at least `shortest` periods.
pub fn captures(records: &[PeriodRecord], shortest: usize) -> Captures {
    let mut found = Captures::default();
    let mut captured = 0;
    for stretch in records.split(|record| record.impacts != [1, 1]) {
        if stretch.len() >= shortest {
            found.count += 1;
            found.longest = found.longest.max(stretch.len());
            captured += stretch.len();
        }
    }
    found.share = captured as f64 / records.len().max(1) as f64;
    found
}

/// Whether mean peak and number of impacts agree between the halves of the window.
pub fn settled(records: &[PeriodRecord]) -> bool {
    let half = records.len() / 2;
    let (first, second) = (&records[..half], &records[half..2 * half]);
    let peak = |part: &[PeriodRecord]| part.iter().map(|record| record.peak).sum::<f64>();
    let impacts = |part: &[PeriodRecord]| {
        part.iter().map(|record| f64::from(record.impacts.iter().sum::<u32>())).sum::<f64>()
    };
    close(peak(first), peak(second)) && close(impacts(first), impacts(second))
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= UNSETTLED * 0.5 * (a + b)
}
