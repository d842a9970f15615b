//! The probability that all criteria hold where numbers of a case are uncertain: designs drawn at random, each judged as
//! `check` judges it.

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};

use super::{Depth, Together, Varies};
use crate::case::Distribution;
use crate::executor::{Executor, map};
use crate::motions::wilson;
use crate::system::Parameter;

/// A number that is uncertain: of a case, or of one of its parts, as [`Varies`] has them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncertain {
    /// What it is.
    pub parameter: Parameter,
    /// Of which absorber, or of an amplitude which load, where a case has a list of them.
    pub of: Option<usize>,
    /// How its error is distributed.
    pub errors: Distribution,
}

/// Designs drawn where the case does not say how many: their probability is known to 7 % at worst.
const SAMPLES: u32 = 200;
/// Designs that fail for which a cause is looked for, the first ones.
const EXAMINED: usize = 20;
const SEED: u64 = 1;

/// How many of the designs that were drawn meet all criteria.
#[derive(Debug, Clone, PartialEq)]
pub struct Reliability {
    /// Designs that were drawn.
    pub samples: u32,
    /// Those of which all criteria hold with their errors.
    pub hold: u32,
    /// Those of which none fails, and an error could turn one.
    pub undecided: u32,
    /// Designs that fail for which a cause was looked for.
    pub examined: u32,
    /// For how many of these a number alone, back at its value, would have met all criteria, by a look with fewer starts; the
    /// most frequent first, and none that never would.
    pub causes: Vec<(Uncertain, u32)>,
}

impl Reliability {
    /// Of a case whose numbers are uncertain; none where nothing is, or it has no criteria.
    ///
    /// # Errors
    /// Where a motion cannot be followed.
    pub fn of<C: Varies>(
        case: &C,
        effort: &C::Effort,
        on: &dyn Executor,
    ) -> Result<Option<Self>, C::Error> {
        let uncertain = case.uncertain();
        let count = Self::samples(case);
        if count == 0 {
            return Ok(None);
        }
        let drawn = drawn(&uncertain, count);
        let come_to = |errors: &[(Uncertain, f64)], how: Depth| {
            // What leaves no system meets nothing.
            let Some(case) = case.deviating(errors) else { return Ok(Together::Fail) };
            if case.fails_unflown()? {
                return Ok(Together::Fail);
            }
            case.judge(effort, how).map(|judged| Together::of(&judged))
        };
        let found = map(on, "designs", drawn.len(), |k| come_to(&drawn[k], Depth::AsCheck));
        let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
        let failed: Vec<&Vec<(Uncertain, f64)>> = drawn
            .iter()
            .zip(&found)
            .filter_map(|(errors, found)| (*found == Together::Fail).then_some(errors))
            .take(EXAMINED)
            .collect();
        let count = uncertain.len();
        let saved = map(on, "causes", failed.len() * count, |k| {
            let mut errors = failed[k / count].clone();
            errors.remove(k % count);
            come_to(&errors, Depth::OnTheWay).map(|found| found == Together::Hold)
        });
        let saved = saved.into_iter().collect::<Result<Vec<_>, _>>()?;
        let times = |k: usize| saved.iter().skip(k).step_by(count).filter(|saved| **saved).count();
        let causes = uncertain.iter().enumerate().map(|(k, one)| (*one, times(k) as u32));
        let mut causes: Vec<_> = causes.filter(|(_, times)| *times > 0).collect();
        causes.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
        let number = |of: Together| found.iter().filter(|found| **found == of).count() as u32;
        Ok(Some(Self {
            samples: drawn.len() as u32,
            hold: number(Together::Hold),
            undecided: number(Together::Undecided),
            examined: failed.len() as u32,
            causes,
        }))
    }

    /// Designs that are drawn for a case; 0 where nothing is uncertain.
    pub fn samples(case: &impl Varies) -> u32 {
        let is_drawn = !case.criteria().is_empty() && case.uncertainty().is_any();
        if is_drawn { case.uncertainty().samples.unwrap_or(SAMPLES) } else { 0 }
    }

    /// The share of the designs drawn that hold, and between which probabilities that of the criteria lies: from none of those
    /// that are not decided to all of them, each with the 95 % interval of so many independent draws, which errs on the wide
    /// side.
    pub fn probability(&self) -> (f64, [f64; 2]) {
        let stand = self.hold + self.undecided;
        let share = f64::from(self.hold) / f64::from(self.samples);
        (share, [wilson(self.hold, self.samples)[0], wilson(stand, self.samples)[1]])
    }
}

/// Errors of some designs, by a Latin hypercube (McKay, Beckman and Conover 1979): each number is drawn once from each of
/// as many equally probable strata, in an order of its own.
pub(crate) fn drawn(uncertain: &[Uncertain], count: u32) -> Vec<Vec<(Uncertain, f64)>> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(SEED);
    let mut uniform = || ((random.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
    let mut designs = vec![Vec::new(); count as usize];
    for one in uncertain {
        let mut strata: Vec<u32> = (0..count).collect();
        // Each from those that are left (Fisher and Yates).
        for last in (1..strata.len()).rev() {
            strata.swap(last, (uniform() * (last + 1) as f64) as usize);
        }
        for (design, stratum) in designs.iter_mut().zip(strata) {
            let probability = (f64::from(stratum) + uniform()) / f64::from(count);
            let error = match one.errors {
                Distribution::Normal(deviation) => deviation * normal_quantile(probability),
                Distribution::Uniform(largest) => largest * (2.0 * probability - 1.0),
            };
            design.push((*one, error));
        }
    }
    designs
}

/// Where the standard normal distribution has a probability below it.
fn normal_quantile(probability: f64) -> f64 {
    // Beyond 9 there is less than the smallest probability that is drawn; 60 halvings leave rounding.
    let [mut low, mut high] = [-9.0, 9.0];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let below = 0.5 * libm::erfc(-middle * std::f64::consts::FRAC_1_SQRT_2);
        if below < probability { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means 0; variances s² of a normal error and a²/3 of one up to a; no correlation but by chance, within four standard
    /// errors; the moments of each are far closer, as every stratum is drawn from once.
    #[test]
    fn errors_are_distributed_as_they_are_written() {
        let of = |parameter, errors| Uncertain { parameter, of: None, errors };
        let uncertain = [
            of(Parameter::Clearance, Distribution::Normal(0.1)),
            of(Parameter::Amplitude, Distribution::Uniform(0.3)),
        ];
        let count = 10_000;
        let drawn = drawn(&uncertain, count);
        let mean = |of: &dyn Fn(f64, f64) -> f64| {
            drawn.iter().map(|one| of(one[0].1, one[1].1)).sum::<f64>() / f64::from(count)
        };
        assert!(mean(&|a, _| a).abs() < 1e-5 && mean(&|_, b| b).abs() < 1e-5);
        assert!((mean(&|a, _| a * a) / 0.01 - 1.0).abs() < 1e-3);
        assert!((mean(&|_, b| b * b) / 0.03 - 1.0).abs() < 1e-3);
        assert!(mean(&|a, b| a * b).abs() < 7e-4);
        assert!(drawn.iter().all(|one| one[1].1.abs() <= 0.3));
    }

    /// Tables of the normal distribution.
    #[test]
    fn quantiles_are_those_of_tables() {
        for (probability, quantile) in
            [(0.5, 0.0), (0.975, 1.959_963_985), (0.158_655_254, -1.0), (1e-9, -5.997_807_015)]
        {
            assert!((normal_quantile(probability) - quantile).abs() < 1e-8, "{probability}");
        }
    }
}
