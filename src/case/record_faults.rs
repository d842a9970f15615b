//! What a record can be read with and is almost surely a fault of it: an offset, a spike, steps too long for the structure.

use std::f64::consts::TAU;

use super::Case;
use super::error::Problem;
use super::record::{ReadRecord, RecordSource};
use super::record_file::median_step;
use crate::excitation::RecordQuantity;
use crate::quantity::numbers::rounded_to;

/// Digits by which a value is found again in its file.
const DIGITS: usize = 6;
/// Share of the largest value from which on a mean, or a value of rest, is an offset.
const OFFSET: f64 = 0.05;
/// Times the largest value over the crossings of its mean by which that of a record without offset may be off: one that
/// ends within a swing.
const OF_SWINGS: f64 = 3.0;
/// Share of the structure's period above which straight lines between samples are too coarse.
const COARSE: f64 = 0.2;
/// How far a value stands out that is a spike: over the next largest of what a value is beside the middle of its
/// neighbours; and over the largest value.
const STANDS_OUT: f64 = 4.0;
const HIGH: f64 = 0.3;
/// Spikes are fewer samples than that share.
const FEW: f64 = 0.01;
/// What loggers write where nothing was measured; ends of the range of their converters.
const SENTINELS: [f64; 12] = [
    999.0, 9999.0, 99_999.0, 999_999.0, 999.9, 9999.9, 99.99, 999.99, 9999.99, 999.25, 32_767.0,
    32_768.0,
];
/// How much larger one of them is than the largest other value.
const SENTINEL_IS_LARGER: f64 = 3.0;

/// Everything that the record of a case is warned of.
pub(super) fn of(case: &Case) -> Vec<Problem> {
    let Some(RecordSource::File { span, read: Some(read), .. }) =
        case.recording.as_ref().map(|recording| &recording.source)
    else {
        return Vec::new();
    };
    let faults = Faults { case, read };
    let all = [faults.spikes(), faults.offset(), faults.coarse()].into_iter().flatten();
    let warning = |(message, label, help): (String, &str, String)| {
        Problem::new(&case.text, span.clone(), message, label).help(help).into_warning()
    };
    all.map(warning).collect()
}

type Told = (String, &'static str, String);

struct Faults<'a> {
    case: &'a Case,
    read: &'a ReadRecord,
}

impl Faults<'_> {
    fn samples(&self) -> &[[f64; 2]] {
        &self.read.record.samples
    }

    fn time(&self, time: f64) -> String {
        let unit = if self.case.units().physical { " s" } else { "" };
        format!("{}{unit}", rounded_to(time, DIGITS))
    }

    /// A value as the file has it.
    fn value(&self, value: f64) -> String {
        let unit = self.read.unit;
        let told = rounded_to(value / unit.size, DIGITS);
        if unit.symbol.is_empty() { told.to_string() } else { format!("{told} {}", unit.symbol) }
    }

    /// Samples that stand alone, or are what a logger writes where it has no value.
    fn spikes(&self) -> Option<Told> {
        let samples = self.samples();
        let found = if let Some(found) = self.sentinels() { found } else { alone(samples) };
        let (first, last) = (*found.first()?, *found.last()?);
        let [time, value] = samples[first];
        let more = match found.len() {
            1 => String::new(),
            count => format!(", and {} more up to {}", count - 1, self.time(samples[last][0])),
        };
        Some((
            format!(
                "a value of the record stands alone: {} at {}{more}",
                self.value(value),
                self.time(time)
            ),
            "a spike",
            "look at it: where the recorder failed, correct the file, for the structure is driven by it".to_owned(),
        ))
    }

    fn sentinels(&self) -> Option<Vec<usize>> {
        let samples = self.samples();
        let written = |value: f64| (value / self.read.unit.size).abs();
        let is_one =
            |value: f64| SENTINELS.iter().any(|one| (written(value) / one - 1.0).abs() < 1e-9);
        let found: Vec<usize> = (0..samples.len()).filter(|k| is_one(samples[*k][1])).collect();
        let others = samples.iter().map(|sample| sample[1]).filter(|value| !is_one(*value));
        let largest = others.map(f64::abs).fold(0.0, f64::max);
        let least = found.iter().map(|k| samples[*k][1].abs()).fold(f64::INFINITY, f64::min);
        (!found.is_empty() && least > SENTINEL_IS_LARGER * largest).then_some(found)
    }

    /// A mean that is none of a record that begins and ends at rest.
    fn offset(&self) -> Option<Told> {
        let (samples, record) = (self.samples(), &self.read.record);
        if record.quantity == RecordQuantity::BaseDisplacement {
            // Its motion alone counts.
            return None;
        }
        let count = samples.len() as f64;
        let mean = samples.iter().map(|sample| sample[1]).sum::<f64>() / count;
        let peak = record.peak();
        let above = |sample: &[f64; 2]| sample[1] > mean;
        let crossings = samples.windows(2).filter(|two| above(&two[0]) != above(&two[1])).count();
        let by_mean = mean.abs() > peak * OFFSET.max(OF_SWINGS / crossings as f64);
        let mut sorted: Vec<f64> = samples.iter().map(|sample| sample[1]).collect();
        sorted.sort_by(f64::total_cmp);
        let median = sorted[sorted.len() / 2];
        if sorted[0] == sorted[sorted.len() - 1] {
            // A load that is put on at once.
            return None;
        }
        let near =
            |at: Option<&[f64; 2]>| at.is_some_and(|at| (at[1] - median).abs() < OFFSET * peak);
        let rests = median.abs() > OFFSET * peak && near(samples.first()) && near(samples.last());
        // A force may be a load on one side; one that begins with it does so suddenly.
        let begins = samples[0][1] / mean > 0.5;
        let counts =
            rests || by_mean && (record.quantity == RecordQuantity::BaseAcceleration || begins);
        let (value, word) =
            if rests { (median, "most of its values are about") } else { (mean, "its mean is") };
        counts.then(|| {
            (
                format!(
                    "the record has an offset: {word} {} from {} to {}, where its first value is {} and its largest {}",
                    self.value(value),
                    self.time(samples[0][0]),
                    self.time(samples[samples.len() - 1][0]),
                    self.value(samples[0][1]),
                    self.value(peak),
                ),
                "an offset",
                "take it off in the file, unless it really acts: it acts suddenly, on a structure at rest".to_owned(),
            )
        })
    }

    /// Steps between which the structure swings.
    fn coarse(&self) -> Option<Told> {
        let samples = self.samples();
        let period = self.case.units().time(TAU);
        // Where nothing changes a straight line is what was meant.
        let changes = samples.windows(2).filter(|two| two[0][1] != two[1][1]);
        let longest = changes.max_by(|a, b| (a[1][0] - a[0][0]).total_cmp(&(b[1][0] - b[0][0])))?;
        let step = longest[1][0] - longest[0][0];
        // A gap that the case accepts is one of its own.
        let told = if step > 3.0 * median_step(samples) { median_step(samples) } else { step };
        (told > COARSE * period).then(|| {
            (
                format!(
                    "steps of the record are up to {}, at {} (value {}): more than a fifth of the structure's period, {}",
                    self.time(told),
                    self.time(longest[0][0]),
                    self.value(longest[0][1]),
                    self.time(period)
                ),
                "sampled too coarsely for this structure",
                "take a record with more samples: between them straight lines are drawn".to_owned(),
            )
        })
    }
}

/// Samples that are peaks of their own, much further from the middle of their neighbours than any other.
fn alone(samples: &[[f64; 2]]) -> Vec<usize> {
    let value = |k: usize| samples[k][1];
    let peak = samples.iter().map(|sample| sample[1].abs()).fold(0.0, f64::max);
    let bend = |k: usize| (value(k) - 0.5 * (value(k - 1) + value(k + 1))).abs();
    let is_peak = |k: &usize| {
        let [before, after] = [value(*k) - value(*k - 1), value(*k) - value(*k + 1)];
        let least = before.abs().min(after.abs());
        before * after > 0.0 && value(*k).abs() > HIGH * peak && 2.0 * least > value(*k).abs()
    };
    let mut found: Vec<usize> = (1..samples.len().saturating_sub(1)).filter(is_peak).collect();
    found.sort_by(|a, b| bend(*b).total_cmp(&bend(*a)));
    let most = (FEW * samples.len() as f64).max(1.0) as usize;
    // Beside a spike its neighbours are bent as well.
    let beside = |k: usize, some: &[usize]| some.iter().any(|spike| spike.abs_diff(k) <= 1);
    let rest = |some: &[usize]| {
        let others = (1..samples.len().saturating_sub(1)).filter(|k| !beside(*k, some));
        others.map(bend).fold(0.0, f64::max)
    };
    for count in (1..=found.len().min(most)).rev() {
        // From all that may be spikes down to the largest: the first that are far from the rest.
        if bend(found[count - 1]) > STANDS_OUT * rest(&found[..count]) {
            let mut spikes = found[..count].to_vec();
            spikes.sort_unstable();
            return spikes;
        }
    }
    Vec::new()
}
