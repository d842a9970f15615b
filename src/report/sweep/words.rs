//! A sweep in sentences.

use super::AxisShown;
use super::facts::{Extreme, Facts};
use super::grid::{Grid, SweepDirection};
use super::kinds::area_words;
use crate::analysis::Area;
use crate::regimes::Regime;
use crate::report::numbers::{MINUS, capitalised, percent_sharply, significant};

/// Hysteresis is told for so many stretches.
const MOST_TOLD: usize = 3;

/// What is said, sentence by sentence.
pub(super) struct Words<'a> {
    pub grid: &'a Grid<'a>,
    /// One for each pass.
    pub facts: &'a [Facts],
    /// Points at which up and down differ.
    pub hysteresis: Option<&'a [bool]>,
}

/// Points as a part of others.
fn share(points: usize, of: usize) -> String {
    percent_sharply(points as f64 / of.max(1) as f64)
}

/// A reduction in dB, without its sign.
fn decibels(reduction: f64) -> String {
    format!("{} dB", significant(reduction.abs(), 3))
}

impl Words<'_> {
    /// What the points make up.
    fn whole(&self) -> &'static str {
        match self.grid.swept.axes.len() {
            _ if self.grid.is_basin() => "the starts",
            1 => "the range",
            _ => "the map",
        }
    }

    pub(super) fn headline(&self) -> String {
        let main = self.facts.iter().find_map(|facts| Some((facts, facts.main()?)));
        let most = match main {
            Some((facts, main)) => {
                let way = match facts.pass {
                    SweepDirection::Single => String::new(),
                    pass => format!(" {}", pass.words()),
                };
                let words = capitalised(main.regime.words());
                let of = self.whole();
                format!("{words} over {} of {of}{way}.", percent_sharply(main.share))
            }
            None => self.largest_area(),
        };
        match self.facts.first().filter(|_| !self.grid.is_basin()).map(|facts| self.best(facts)) {
            Some(best) if !best.is_empty() => format!("{most} {best}").trim().to_owned(),
            _ => most,
        }
    }

    fn largest_area(&self) -> String {
        let Some(areas) = self.grid.text("area", SweepDirection::Single) else {
            return format!("{} points.", self.grid.points());
        };
        let count = |name: &str| areas.iter().filter(|area| **area == Some(name)).count();
        let all = super::kinds::AREAS.map(|(name, _)| (count(name), name));
        let Some((points, name)) = all.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a })
        else {
            return String::new();
        };
        let share = share(points, areas.iter().flatten().count());
        format!(
            "By theory {} is area {}.",
            format_args!("{share} of {}", self.whole()),
            area_words(name)
        )
    }

    /// What the absorber does at best.
    fn best(&self, facts: &Facts) -> String {
        let Some(best) = &facts.best else {
            return facts.smallest.as_ref().map_or_else(String::new, |least| {
                format!("The smallest peak is {}, at {}.", self.length(least), self.at(least))
            });
        };
        let (size, at) = (decibels(best.value), self.at(best));
        if best.value > 0.0 {
            format!("Vibration falls by up to {size}, at {at}.")
        } else {
            format!(
                "Nowhere does the absorber reduce the vibration: at best it grows by {size}, at {at}."
            )
        }
    }

    fn length(&self, extreme: &Extreme) -> String {
        self.grid.lengths.text(extreme.value)
    }

    fn at(&self, extreme: &Extreme) -> String {
        self.grid.place(extreme.point)
    }

    pub(super) fn sentences(&self) -> Vec<String> {
        let mut all = Vec::new();
        for facts in self.facts {
            all.extend(self.others(facts));
            all.extend(self.worst(facts));
        }
        all.extend(self.followed());
        for facts in self.facts {
            all.extend(self.several(facts));
            all.extend(self.theory(facts));
            all.extend(self.orbit(facts));
        }
        all
    }

    /// The end of a sentence about a pass.
    fn way(&self, facts: &Facts) -> String {
        match facts.pass {
            SweepDirection::Single => String::new(),
            pass => format!(" ({})", pass.words()),
        }
    }

    fn others(&self, facts: &Facts) -> Option<String> {
        let main = facts.main()?;
        // The headline has told the first pass's main one.
        let again = facts.pass == SweepDirection::Down;
        let mut rest: Vec<_> =
            facts.regimes.iter().filter(|one| again || one.regime != main.regime).collect();
        rest.sort_by_key(|one| std::cmp::Reverse(one.points));
        let told: Vec<String> = rest
            .iter()
            .map(|one| format!("{} {}", one.regime.words(), percent_sharply(one.share)))
            .collect();
        let told = told.join("; ");
        Some(match facts.pass {
            SweepDirection::Down => format!("On the way down: {told}."),
            _ if told.is_empty() => "No other motion was found.".to_owned(),
            _ => format!("Beside it: {told}."),
        })
    }

    fn worst(&self, facts: &Facts) -> Option<String> {
        let worst = facts.worst.as_ref().filter(|_| !self.grid.is_basin())?;
        let (size, at, way) = (decibels(worst.value), self.at(worst), self.way(facts));
        let reduction = self.grid.number("reduction_db", facts.pass)?;
        let better = reduction.iter().flatten().filter(|value| **value >= NO_REDUCTION).count();
        let known = reduction.iter().flatten().count();
        Some(match (worst.value <= -NO_REDUCTION, better) {
            (false, better) if better < known => format!(
                "The absorber reduces the peak at {} of the points, and increases it nowhere.",
                share(better, known)
            ),
            (true, 0) => format!("It grows most, by {size}, at {at}{way}."),
            (true, better) => format!(
                "The absorber reduces the peak at {} of the points; the peak grows most, by {size}, at {at}{way}.",
                share(better, known)
            ),
            (false, _) => {
                format!("The absorber reduces the peak everywhere, least by {size}, at {at}{way}.")
            }
        })
    }

    fn several(&self, facts: &Facts) -> Option<String> {
        let found = facts.coexistence.as_ref()?;
        if found.points == 0 {
            return Some("No two starts of a point led to different motions.".to_owned());
        }
        let along = |(axis, [from, to]): (&AxisShown, &[usize; 2])| match from == to {
            true => axis.text(*from),
            false => {
                format!("{} from {} to {}", axis.name, axis.number(*from), axis.number(*to))
            }
        };
        let narrower = |(axis, [from, to]): &(&AxisShown, &[usize; 2])| {
            *from > 0 || *to + 1 < axis.values.len()
        };
        let axes = self.grid.swept.axes.iter().zip(&found.from_to);
        let within: Vec<String> = axes.filter(narrower).map(along).collect();
        let within = match within.is_empty() {
            true => String::new(),
            false => format!(", within {}", within.join(", ")),
        };
        let most = match found.most {
            2 => "two".to_owned(),
            most => format!("up to {most}"),
        };
        Some(format!(
            "Several motions coexist at {} of the points ({most} at a point){within}.",
            percent_sharply(found.share)
        ))
    }

    /// Where closed form and simulation agree.
    fn theory(&self, facts: &Facts) -> Option<String> {
        let inside = facts.areas.iter().find(|group| group.name == Area::Z3.key());
        let outside: Vec<_> =
            facts.areas.iter().filter(|group| group.name != Area::Z3.key()).collect();
        let (points, symmetric) = outside.iter().fold((0, 0.0), |(points, symmetric), group| {
            let of = group.share(Regime::TwoSymmetric) * group.points as f64;
            (points + group.points, symmetric + of)
        });
        let beyond = |points: usize, symmetric: f64| {
            format!(
                "two symmetric impacts per period are the main motion at {} of the points",
                share(symmetric.round() as usize, points)
            )
        };
        let way = self.way(facts);
        match (inside, points) {
            (None, 0) => None,
            (None, points) => {
                Some(format!("The theory has no area Z3 here; {}{way}.", beyond(points, symmetric)))
            }
            (Some(group), points) => {
                let there = percent_sharply(group.share(Regime::TwoSymmetric));
                let outside = match points {
                    0 => String::new(),
                    points => {
                        format!(", outside of it at {}", share(symmetric.round() as usize, points))
                    }
                };
                Some(format!(
                    "In area Z3, where the theory has steady 1:1 resonance, two symmetric impacts per period are the main motion at \
                     {there} of the points{outside}{way}."
                ))
            }
        }
    }

    fn orbit(&self, facts: &Facts) -> Option<String> {
        let attracts = facts.orbits.iter().find(|group| group.name != "none attracts")?;
        let way = self.way(facts);
        let main = percent_sharply(attracts.share(Regime::TwoSymmetric));
        let missed = facts.orbit_missed.map_or_else(String::new, |missed| {
            format!("; at {} no start led to it", share(missed, attracts.points))
        });
        let of = facts.orbits.iter().map(|group| group.points).sum();
        Some(format!(
            "An exact 1:1 orbit attracts at {} of the points; two symmetric impacts per period are the main motion at {main} of these\
             {missed}{way}.",
            share(attracts.points, of)
        ))
    }

    /// Hysteresis.
    fn followed(&self) -> Option<String> {
        let differs = self.hysteresis?;
        let axis = self.grid.swept.axes.last()?;
        let count = differs.iter().filter(|one| **one).count();
        if count == 0 {
            return Some(format!(
                "Up and down the {} the motions are the same: no hysteresis in steps of this size.",
                axis.name
            ));
        }
        if self.grid.swept.axes.len() > 1 {
            return Some(format!(
                "Up and down the {} the motions differ at {} of the points (hysteresis).",
                axis.name,
                share(count, differs.len())
            ));
        }
        let stretches = stretches(differs);
        let told: Vec<String> = stretches
            .iter()
            .take(MOST_TOLD)
            .map(|[from, to]| self.hysteresis_at(axis, *from, *to))
            .collect();
        let more = match stretches.len().saturating_sub(MOST_TOLD) {
            0 => String::new(),
            1 => "; and in one more stretch".to_owned(),
            more => format!("; and in {more} more stretches"),
        };
        Some(format!("Hysteresis: {}{more}.", told.join("; ")))
    }

    fn hysteresis_at(&self, axis: &AxisShown, from: usize, to: usize) -> String {
        let place = match from == to {
            true => format!("at {}", axis.number(from)),
            false => format!("from {} to {}", axis.number(from), axis.number(to)),
        };
        let middle = usize::midpoint(from, to);
        let what = |pass: SweepDirection| {
            let regime = self.grid.regimes(pass).and_then(|all| all[middle]);
            let peak = self.grid.number("peak", pass).and_then(|all| all[middle]);
            let peak = peak.map(|peak| format!("peak {}", self.grid.lengths.text(peak)));
            match (regime.map(Regime::words), peak) {
                (Some(regime), Some(peak)) => format!("{regime} ({peak})"),
                (Some(regime), None) => regime.to_owned(),
                (None, peak) => peak.unwrap_or_else(|| "nothing measured".to_owned()),
            }
        };
        format!("{place} {} up, {} down", what(SweepDirection::Up), what(SweepDirection::Down))
    }

    pub(super) fn method(&self) -> Vec<String> {
        let swept = self.grid.swept;
        let axes: Vec<String> = swept.axes.iter().map(spread).collect();
        let counts: Vec<String> =
            swept.axes.iter().map(|axis| axis.values.len().to_string()).collect();
        let points = self.grid.points();
        let product = match counts.as_slice() {
            [_] => format!("{points} points"),
            counts => format!("{} = {points} points", counts.join(" × ")),
        };
        let mut all = vec![format!("{product}: {}.", axes.join("; "))];
        let simulated = self.facts.iter().any(|facts| facts.worked_out > 0);
        let periods = swept.periods;
        let measured = format!(
            "a motion that is not seen to repeat was measured over {periods} excitation periods"
        );
        if self.hysteresis.is_some()
            || self.facts.iter().any(|facts| facts.pass != SweepDirection::Single)
        {
            let name = swept.axes.last().map_or("axis", |axis| axis.name.as_str());
            all.push(format!(
                "Along the {name} a motion was followed from point to point, up and then down; {measured}."
            ));
        } else if self.grid.is_basin() {
            all.push(format!("Each point is one start of one system; {measured}."));
        } else if simulated {
            let starts = match swept.starts {
                1 => "one start, from rest".to_owned(),
                starts => format!("{starts} starts, that from rest among them"),
            };
            all.push(format!(
                "At each point the full system was simulated impact by impact from {starts}; the main motion is the one that most \
                 of them lead to, the first of several; {measured}."
            ));
            all.push(
                "A series of impacts on one wall that ends in lasting contact counts as one visit of the absorber; a regime \
                 has two, or fewer or more, of these, while impacts are all counted."
                    .to_owned(),
            );
        }
        if self.grid.text("area", SweepDirection::Single).is_some() {
            all.push(
                "Areas are those of the closed form, at leading order in the mass ratio."
                    .to_owned(),
            );
        }
        if self.grid.number("orbit_peak", SweepDirection::Single).is_some() {
            all.push(
                "Exact 1:1 orbits have two symmetric impacts per period, without expansion in the mass ratio and without simulation; \
                 they attract where all multipliers lie inside the unit circle."
                    .to_owned(),
            );
        }
        if self
            .grid
            .number("reduction_db", self.facts.first().map_or(SweepDirection::Single, |f| f.pass))
            .is_some()
        {
            all.push(
                "A reduction compares largest displacements: of the oscillator alone, and with the absorber.".to_owned(),
            );
        }
        for facts in self.facts.iter().filter(|_| simulated) {
            let left = points - facts.worked_out;
            if left > 0 {
                all.push(format!(
                    "{left} of {points} points have no motion{}: their numbers leave no valid system, or nothing could be measured.",
                    self.way(facts)
                ));
            }
        }
        all
    }
}

/// What an axis holds.
fn spread(axis: &AxisShown) -> String {
    let last = axis.values.len() - 1;
    if last == 0 {
        return axis.text(0);
    }
    let even = {
        let steps: Vec<f64> = axis.values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mean = (axis.values[last] - axis.values[0]) / last as f64;
        // Written values have some four digits.
        steps.iter().all(|step| (step - mean).abs() < 1e-3 * mean.abs())
    };
    let how = match (axis.logarithmic, even) {
        (true, _) => "logarithmic",
        (false, true) => "even",
        (false, false) => "as listed",
    };
    format!(
        "{} from {} to {} ({} values, {how})",
        axis.name,
        axis.number(0),
        axis.number(last),
        last + 1
    )
}

/// First and last index of every run.
pub(super) fn stretches(flags: &[bool]) -> Vec<[usize; 2]> {
    let mut found: Vec<[usize; 2]> = Vec::new();
    for (index, _) in flags.iter().enumerate().filter(|(_, flag)| **flag) {
        match found.last_mut() {
            Some([_, last]) if *last + 1 == index => *last = index,
            _ => found.push([index, index]),
        }
    }
    found
}

/// A range in words, shorter where both ends read alike.
pub(super) fn from_to(low: String, high: String, unit: &str) -> String {
    let numbers = if low == high { low } else { format!("{low} to {high}") };
    format!("{numbers} {unit}").trim_end().to_owned()
}

/// A reduction that is smaller, in dB, is what a transient has left: none.
const NO_REDUCTION: f64 = 0.005;

/// A signed reduction in dB with three digits.
pub(super) fn signed(value: f64) -> String {
    if value.abs() < NO_REDUCTION {
        return "0".to_owned();
    }
    let sign = if value < 0.0 { MINUS.to_string() } else { String::new() };
    format!("{sign}{}", significant(value.abs(), 3))
}

#[cfg(test)]
mod tests {
    use super::signed;

    #[test]
    fn what_a_transient_leaves_is_no_reduction() {
        assert_eq!(signed(-5.5e-5), "0");
        assert_eq!((signed(-2.314), signed(11.62)), ("−2.31".to_owned(), "11.6".to_owned()));
    }
}
