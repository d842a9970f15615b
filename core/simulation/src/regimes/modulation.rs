//! How strongly a motion is modulated, and when it is captured in 1:1 resonance.

use serde::Serialize;

use crate::numerics::scatter::drifts;
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
    /// Mean length in periods; 0 without captures.
    pub mean: f64,
    /// Median length in periods; 0 without captures.
    pub median: f64,
}

/// First harmonics of one excitation period, equation (17).
///
/// To leading order `x = C sin(tau0 + theta)` and `w = x - y = C sin(tau0 + theta) + E sin(tau0 +
/// zeta)`: `E` belongs to `-y`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Amplitudes {
    /// `C`, amplitude of the oscillator's first harmonic, over the clearance.
    pub oscillator_amplitude: f64,
    /// `E`, amplitude of the absorber's first harmonic, over the clearance.
    pub absorber_amplitude: f64,
    /// Largest absolute displacement of the oscillator, over the clearance.
    pub peak: f64,
    /// Whether the period belongs to a capture.
    pub captured: bool,
}

/// What the amplitude `E` of equation (17) does in and between captures.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct AbsorberAmplitude {
    /// Mean over the periods in captures; `None` without captures.
    pub in_captures: Option<f64>,
    /// Mean over all other periods; `None` if there are none.
    pub between: Option<f64>,
    /// Smallest in any period.
    pub smallest: f64,
    /// Largest in any period.
    pub largest: f64,
    /// Correlation of `E` in a period with the change of `C` from the period before to the one
    /// after: below zero where a large `E` goes with a decreasing vibration, as section 4.2 has it.
    /// `None` if either is constant to rounding.
    pub correlation_with_growth: Option<f64>,
}

/// Spread, over the mean, below which a series is constant to rounding.
const CONSTANT: f64 = 1e-9;

/// `(max - min) / (max + min)` of the oscillator's peak per period.
pub fn depth(records: &[PeriodRecord]) -> f64 {
    let (low, high) = records.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), record| {
        (low.min(record.peak), high.max(record.peak))
    });
    if high > 0.0 { (high - low) / (high + low) } else { 0.0 }
}

/// Depth of modulation in the second half of the window over that in the first: below 1 while the
/// motion is still settling. 1 where there is no modulation at all.
pub fn growth(records: &[PeriodRecord]) -> f64 {
    let (first, second) = records.split_at(records.len() / 2);
    let (first, second) = (depth(first), depth(second));
    if first > 0.0 { second / first } else { 1.0 }
}

/// The captures in a series of periods, of each of which is given whether it belongs to one.
pub fn captures(captured: &[bool]) -> Captures {
    let runs = captured.chunk_by(|a, b| a == b).filter(|run| run[0]);
    let mut lengths: Vec<usize> = runs.map(<[bool]>::len).collect();
    lengths.sort_unstable();
    let (count, total) = (lengths.len(), lengths.iter().sum::<usize>());
    let middle = |k: usize| lengths.get(k).copied().unwrap_or(0) as f64;
    Captures {
        count,
        share: total as f64 / captured.len().max(1) as f64,
        longest: lengths.last().copied().unwrap_or(0),
        mean: total as f64 / count.max(1) as f64,
        median: 0.5 * (middle(count.saturating_sub(1) / 2) + middle(count / 2)),
    }
}

/// Whether each period belongs to a capture of at least `shortest` periods.
pub fn captured(records: &[PeriodRecord], shortest: usize) -> Vec<bool> {
    let alternates = |record: &PeriodRecord| record.impacts == [1, 1];
    let stretches = records.chunk_by(|a, b| alternates(a) == alternates(b));
    let held = |stretch: &[PeriodRecord]| {
        let long = alternates(&stretch[0]) && stretch.len() >= shortest;
        std::iter::repeat_n(long, stretch.len())
    };
    stretches.flat_map(held).collect()
}

/// `C` and `E` of every period, with the captures of at least `shortest` periods.
pub fn amplitudes(records: &[PeriodRecord], shortest: usize) -> Vec<Amplitudes> {
    let each = records.iter().zip(captured(records, shortest));
    each.map(|(record, captured)| Amplitudes {
        oscillator_amplitude: size(record.oscillator_harmonic),
        absorber_amplitude: size(record.absorber_harmonic),
        peak: record.peak,
        captured,
    })
    .collect()
}

fn size([sine, cosine]: [f64; 2]) -> f64 {
    libm::hypot(sine, cosine)
}

/// Summary of `E` over a series of periods.
pub fn absorber_amplitude(series: &[Amplitudes]) -> AbsorberAmplitude {
    let mean = |captured: bool| {
        let chosen = series.iter().filter(|one| one.captured == captured);
        let (sum, count) =
            chosen.fold((0.0, 0_u32), |(sum, n), one| (sum + one.absorber_amplitude, n + 1));
        (count > 0).then(|| sum / f64::from(count))
    };
    let all = || series.iter().map(|one| one.absorber_amplitude);
    AbsorberAmplitude {
        in_captures: mean(true),
        between: mean(false),
        smallest: all().reduce(f64::min).unwrap_or(0.0),
        largest: all().reduce(f64::max).unwrap_or(0.0),
        correlation_with_growth: correlation(
            series.windows(3).map(|w| {
                (w[1].absorber_amplitude, w[2].oscillator_amplitude - w[0].oscillator_amplitude)
            }),
            series.iter().map(|one| one.oscillator_amplitude).fold(0.0, f64::max),
        ),
    }
}

/// Correlation of pairs; `None` if the first varies by rounding relative to its mean, or the second
/// relative to `scale`.
fn correlation(pairs: impl Iterator<Item = (f64, f64)> + Clone, scale: f64) -> Option<f64> {
    let count = pairs.clone().count() as f64;
    let (a, b) = pairs.clone().fold((0.0, 0.0), |(a, b), pair| (a + pair.0, b + pair.1));
    let (a, b) = (a / count, b / count);
    let (aa, ab, bb) = pairs.fold((0.0, 0.0, 0.0), |(aa, ab, bb), pair| {
        let (p, q) = (pair.0 - a, pair.1 - b);
        (aa + p * p, ab + p * q, bb + q * q)
    });
    let varies = |sum: f64, scale: f64| (sum / count).sqrt() > CONSTANT * scale;
    (varies(aa, a) && varies(bb, scale)).then(|| ab / (aa * bb).sqrt())
}

/// Blocks among which a drift is looked for.
const BLOCKS: usize = 10;

/// Whether mean peak and number of visits to the walls agree between the halves of the window; rare
/// chattering sequences of dozens of impacts each would make numbers of impacts differ.
pub fn settled(records: &[PeriodRecord]) -> bool {
    let half = records.len() / 2;
    let (first, second) = (&records[..half], &records[half..2 * half]);
    let peak = |part: &[PeriodRecord]| part.iter().map(|record| record.peak).sum::<f64>();
    let visits = |part: &[PeriodRecord]| {
        part.iter().map(|record| f64::from(record.visits.iter().sum::<u32>())).sum::<f64>()
    };
    close(peak(first), peak(second)) && close(visits(first), visits(second))
}

/// Whether the mean square displacement goes up or down beyond its scatter, as it does while a weakly
/// damped vibration fades.
pub fn drifting(records: &[PeriodRecord]) -> bool {
    let blocks = records.chunks_exact((records.len() / BLOCKS).max(1));
    let mean_square =
        |block: &[PeriodRecord]| block.iter().map(|record| record.mean_square).sum::<f64>();
    drifts(&blocks.map(mean_square).collect::<Vec<_>>())
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= UNSETTLED * 0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::State;

    fn record(impacts: [u32; 2], oscillator: f64, absorber: f64) -> PeriodRecord {
        PeriodRecord {
            impacts,
            visits: impacts,
            mean_square: 0.0,
            impact_speed: 1.0,
            lost: [0.0; 3],
            peak: oscillator,
            end: State::AT_REST,
            absorber_harmonic: [0.6 * absorber, -0.8 * absorber],
            oscillator_harmonic: [0.0, oscillator],
        }
    }

    fn series(pattern: &str) -> Vec<PeriodRecord> {
        pattern.chars().map(|c| record(if c == 'c' { [1, 1] } else { [2, 0] }, 1.0, 0.5)).collect()
    }

    #[test]
    fn captures_are_counted_and_measured() {
        // Lengths 3, 5, 1 (too short), 4: mean 4, median 4, 12 of 17 periods.
        let found = captures(&captured(&series("ccc.ccccc.c..cccc"), 3));
        assert_eq!((found.count, found.longest, found.mean, found.median), (3, 5, 4.0, 4.0));
        assert!((found.share - 12.0 / 17.0).abs() < 1e-15);
        let even = captures(&captured(&series("ccc.cccccccc"), 3));
        assert_eq!((even.mean, even.median), (5.5, 5.5));
        let uneven = captures(&captured(&series("ccc.ccc.cccccccccc.cccc"), 3));
        assert_eq!((uneven.mean, uneven.median), (5.0, 3.5));
        assert_eq!(captures(&captured(&series("cc.cc"), 3)), Captures::default());
    }

    #[test]
    fn periods_know_whether_they_are_captured() {
        let pattern = "ccc.ccccc.c..cccc";
        let flags: Vec<bool> = amplitudes(&series(pattern), 3).iter().map(|a| a.captured).collect();
        let expected: Vec<bool> = "ccc.ccccc....cccc".chars().map(|c| c == 'c').collect();
        assert_eq!(flags, expected);
    }

    #[test]
    fn the_absorbers_amplitude_is_summed_up_in_and_between_captures() {
        let records: Vec<PeriodRecord> = (0..12)
            .map(|k| record(if k % 4 == 3 { [0, 0] } else { [1, 1] }, 2.0, f64::from(k)))
            .collect();
        let found = absorber_amplitude(&amplitudes(&records, 3));
        let near = |a: Option<f64>, b: f64| (a.expect("some") - b).abs() < 1e-12;
        assert!(
            near(found.in_captures, 45.0 / 9.0) && near(found.between, 21.0 / 3.0),
            "{found:?}"
        );
        assert!(found.smallest == 0.0 && (found.largest - 11.0).abs() < 1e-12);
        assert_eq!(found.correlation_with_growth, None, "C is constant");
        assert_eq!(absorber_amplitude(&[]), AbsorberAmplitude::default());
    }

    /// C(k+1) - C(k-1) = -2 E(k) by construction.
    #[test]
    fn a_vibration_that_falls_with_e_is_fully_anticorrelated() {
        let e = |k: u32| 1.0 + f64::from(k * k % 7);
        let mut c = vec![100.0, 100.0];
        (1..30).for_each(|k| c.push(c[k as usize - 1] - 2.0 * e(k)));
        let records: Vec<_> = (0..31).map(|k| record([1, 1], c[k as usize], e(k))).collect();
        let found = absorber_amplitude(&amplitudes(&records, 3)).correlation_with_growth;
        assert!((found.expect("both vary") + 1.0).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn modulation_that_dies_out_has_a_growth_below_one() {
        let fading: Vec<_> = (0..8)
            .map(|k| {
                let swing = if k < 4 { 0.4 } else { 0.1 };
                record([1, 1], if k % 2 == 0 { 1.0 + swing } else { 1.0 - swing }, 1.0)
            })
            .collect();
        assert!((growth(&fading) - 0.25).abs() < 1e-12);
        assert_eq!(growth(&series("cccc")), 1.0);
    }

    #[test]
    fn a_rare_chattering_sequence_is_no_drift_and_more_visits_are() {
        let quiet = record([1, 0], 1.0, 0.5);
        let chatter = PeriodRecord { impacts: [40, 0], ..quiet };
        let mut records = vec![quiet; 20];
        records[15] = chatter;
        assert!(settled(&records));
        records[10..].fill(record([1, 1], 1.0, 0.5));
        assert!(!settled(&records), "twice as many visits");
        records.fill(quiet);
        records[10..].fill(record([1, 0], 1.3, 0.5));
        assert!(!settled(&records), "a larger peak");
        records.fill(quiet);
        assert!(!drifting(&records));
        for (k, record) in (0..).zip(&mut records) {
            record.mean_square = libm::exp(-0.002 * f64::from(k));
        }
        assert!(drifting(&records) && settled(&records), "a vibration that fades by 4 %");
    }
}
