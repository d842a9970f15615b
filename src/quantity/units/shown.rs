//! What a reader sees: the unit of a number on a page, and its text.

use super::super::catalogue::{Digits, Dimension, ErrorKind, Kind};
use super::super::numbers::{self, fixed, significant, with_minus};
use super::super::unit::{Unit, unit};
use super::Units;

/// Smallest and largest number that is shown in a page's own unit of length before another prefix is taken.
const PAGE_RANGE: [f64; 2] = [0.1, 1000.0];

/// The same of the unit of another number.
const TOLD_RANGE: [f64; 2] = [1e-3, 1e4];

/// Units that stay below 1, down to [`LEAST_PLAIN`]: of a tower people say 0.79 Hz, not 790 mHz.
const PLAIN: [&str; 2] = ["Hz", "N s/m"];
const LEAST_PLAIN: f64 = 0.1;

impl Units {
    /// The units of a dimension on a page, from the largest to the smallest.
    fn of_page(&self, dimension: Dimension) -> &'static [Unit] {
        let in_g = self.in_g && dimension == Dimension::Acceleration;
        if self.us || in_g { dimension.us_units() } else { dimension.units() }
    }

    /// The unit that lengths share.
    fn of_lengths(&self) -> Unit {
        if !self.physical {
            return unit("units", 0);
        }
        // 0.1 mm reads better than 100 µm, and 300 mm better than 0.3 m.
        let fits =
            |one: &&Unit| self.clearance >= one.size * if one.size == 1.0 { 1.0 } else { 0.1 };
        let all = self.of_page(Dimension::Length);
        let length = all.iter().find(fits).or(all.last()).copied();
        length.unwrap_or(unit("nm", -9))
    }

    /// The symbol of the unit that lengths share.
    pub fn length_symbol(&self) -> &'static str {
        self.of_lengths().symbol
    }

    /// A length in the unit that lengths share.
    pub fn length_number(&self, length: f64) -> f64 {
        length / self.of_lengths().size
    }

    /// The unit in which a number of a dimension is shown: lengths of a page share theirs, others have the
    /// prefix that keeps the number between 1 and 1000.
    pub fn unit(&self, dimension: Dimension, value: f64) -> Unit {
        if !self.physical
            && let Some(own) = dimension.own_unit()
        {
            return own;
        }
        let size = value.abs();
        let [least, most] = TOLD_RANGE;
        if let Some((of, unit)) = self.told_in
            && of == dimension
            && (size == 0.0 || (least..most).contains(&(size / unit.size)))
        {
            return unit;
        }
        let [least, most] = PAGE_RANGE;
        if dimension == Dimension::Length
            && (size == 0.0 || (least..most).contains(&self.length_number(size)))
        {
            return self.of_lengths();
        }
        let units = self.of_page(dimension);
        let plain = units.iter().find(|one| one.size == 1.0).or(units.first());
        let least = |one: &Unit| if PLAIN.contains(&one.symbol) { LEAST_PLAIN } else { one.size };
        let fitting = units.iter().find(|one| size >= least(one)).or(units.last());
        let found = if size == 0.0 || !size.is_finite() { plain } else { fitting };
        found.copied().unwrap_or(unit("", 0))
    }

    /// A number of some kind with its unit.
    pub fn text(&self, kind: &Kind, value: f64) -> String {
        self.with_digits(kind, value, kind.digits)
    }

    /// The same with other digits.
    pub fn with_digits(&self, kind: &Kind, value: f64, digits: Digits) -> String {
        if value.is_infinite() && value > 0.0 {
            return "without limit".into();
        }
        match kind.dimension {
            Dimension::Share => percent(value, digits),
            Dimension::Change => signed(&percent(value.abs(), digits), value),
            Dimension::Level => signed(&format!("{} dB", rounded(value.abs(), digits)), value),
            _ => {
                let unit = self.unit(kind.dimension, value);
                joined(&rounded(value / unit.size, digits), unit.symbol)
            }
        }
    }

    /// A number with as many digits as it takes to tell it from another one, at least four, in the unit of the
    /// larger.
    pub fn apart(&self, kind: &Kind, value: f64, other: f64) -> String {
        let unit = self.unit(kind.dimension, value.abs().max(other.abs()));
        let text = |value: f64, more: u8| match (kind.dimension, kind.digits) {
            (Dimension::Share | Dimension::Change, _) => {
                self.with_digits(kind, value, Digits::Decimals(1 + more))
            }
            (Dimension::Level, Digits::Decimals(own)) => {
                self.with_digits(kind, value, Digits::Decimals(own + more))
            }
            (_, Digits::Decimals(own)) => {
                joined(&fixed(value / unit.size, usize::from(own + more)), unit.symbol)
            }
            _ => joined(&significant(value / unit.size, usize::from(4 + more)), unit.symbol),
        };
        let differ = |more: &u8| text(value, *more) != text(other, *more);
        // 17 digits tell any two numbers apart.
        text(value, if value == other { 0 } else { (0..=13).find(differ).unwrap_or(0) })
    }

    /// A number with its error: `0.68 ± 0.10`, or `3.56 mm (+0.12 mm)` for a largest value, `5.0 dB (−0.2 dB)` for a
    /// least reduction. An error that does not change a digit is left out.
    pub fn with_error(&self, kind: &Kind, value: f64, error: f64, digits: Digits) -> String {
        let text = self.with_digits(kind, value, digits);
        if error <= 1e-3 * value.abs() || !error.is_finite() {
            return text;
        }
        if kind.dimension == Dimension::Level {
            let error = fixed(error, 1);
            let number = text.trim_end_matches(" dB");
            return match kind.error {
                _ if error == "0.0" => text,
                ErrorKind::Most => format!("{text} (+{error} dB)"),
                ErrorKind::Least => format!("{text} (\u{2212}{error} dB)"),
                ErrorKind::Interval => format!("{number} ± {error} dB"),
            };
        }
        match kind.error {
            ErrorKind::Most | ErrorKind::Least => {
                let unit = self.unit(kind.dimension, value);
                let off = joined(&significant(error / unit.size, 2), unit.symbol);
                let sign = if kind.error == ErrorKind::Most { '+' } else { '\u{2212}' };
                format!("{text} ({sign}{off})")
            }
            ErrorKind::Interval => {
                let unit = self.unit(kind.dimension, value);
                let number = numbers::with_error(value / unit.size, error / unit.size);
                joined(&number, unit.symbol)
            }
        }
    }
}

fn joined(number: &str, unit: &str) -> String {
    if unit.is_empty() { number.to_owned() } else { format!("{number} {unit}") }
}

fn rounded(value: f64, digits: Digits) -> String {
    match digits {
        Digits::Significant(digits) => significant(value, usize::from(digits)),
        Digits::Decimals(decimals) => fixed(value, usize::from(decimals)),
    }
}

/// A part in per cent: below 10 % with as many significant digits as asked for, at most two decimals.
fn percent(share: f64, digits: Digits) -> String {
    if share == 0.0 || share == 1.0 {
        return format!("{} %", 100.0 * share);
    }
    if share.abs() < 5e-5 {
        return "< 0.01 %".into();
    }
    let percent = 100.0 * share;
    let decimals = match digits {
        Digits::Decimals(decimals) => i32::from(decimals),
        Digits::Significant(digits) => {
            let magnitude = libm::floor(libm::log10(percent.abs() * (1.0 + 1e-9))) as i32;
            (i32::from(digits) - 1 - magnitude).clamp(0, 2)
        }
    };
    format!("{} %", fixed(percent, decimals as usize))
}

/// Text of an absolute value with the sign of the value.
fn signed(text: &str, value: f64) -> String {
    let zero = !text.contains(|c: char| ('1'..='9').contains(&c));
    match (zero, value < 0.0) {
        (true, _) => text.to_owned(),
        (false, true) => with_minus(&format!("-{text}")),
        (false, false) => format!("+{text}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::catalogue as of;

    /// A limit and a margin beside what was found, and one that is too far away for its unit.
    #[test]
    fn a_number_may_be_in_the_unit_of_another() {
        let units = Units::physical(7.5e-3);
        for (like, value, text) in [
            (0.211, 0.25, "250 mm"),
            (1.149e-4, 5.08e-6, "0.00508 mm"),
            (2.2e-5, 2.5e-4, "250 µm"),
            (1.5, 0.0034, "0.00340 m"),
            (1.5, 1.2e-5, "12.0 µm"),
        ] {
            assert_eq!(units.told_like(Dimension::Length, like).text(&of::PEAK, value), text);
        }
        let told = units.told_like(Dimension::Velocity, 0.0741);
        assert_eq!(told.text(&of::IMPACT_SPEED, 0.3), "300 mm/s");
        assert_eq!(told.text(&of::PEAK, 0.3), "300 mm");
    }

    #[test]
    fn a_prefix_keeps_the_number_between_1_and_1000() {
        let units = Units::physical(7.5e-3);
        for (kind, value, text) in [
            (&of::PEAK, 3.561_9e-3, "3.56 mm"),
            (&of::PEAK, 0.150_68, "151 mm"),
            (&of::PEAK, 1.5, "1.50 m"),
            (&of::PEAK, 3.1e-6, "3.10 µm"),
            (&of::PEAK, 0.0, "0 mm"),
            (&of::ABSORBER_MASS, 18.0, "18.00 kg"),
            (&of::ABSORBER_MASS, 0.032, "32.00 g"),
            (&of::WORK, 24.742, "24.7 J"),
            (&of::WORK, 9.76e-3, "9.76 mJ"),
            (&of::CHANGE_DB, -5.03, "−5.0 dB"),
            (&of::CHANGE_DB, 1.44, "+1.4 dB"),
            (&of::CHANGE_DB, 0.01, "0.0 dB"),
            (&of::THEORY_ERROR, -0.033, "−3.3 %"),
            (&of::MARGIN, 1.234, "+123 %"),
            (&of::Z3_SHARE, 0.728_21, "72.8 %"),
            (&of::START_SHARE, 0.256, "26 %"),
            (&of::START_SHARE, 1.0, "100 %"),
            (&of::MODULATION, 3e-16, "< 0.01 %"),
            (&of::BARE_PEAK, f64::INFINITY, "without limit"),
            (&of::ETA, 0.3271, "0.327 rad"),
            (&of::EXCITATION_FREQUENCY, 0.788_1, "0.7881 Hz"),
            (&of::EXCITATION_FREQUENCY, 0.05, "50.00 mHz"),
            (&of::EXCITATION_FREQUENCY, 1500.0, "1.500 kHz"),
        ] {
            assert_eq!(units.text(kind, value), text, "{}", kind.id);
        }
        assert_eq!(Units::reduced().text(&of::PEAK, 1.0342), "1.03 units");
    }

    /// By hand: 3.5619/25.4, 18/0.45359237, 9.15/9.80665, 0.5 N/4.44822, 11470*0.0254/4.44822, 0.00976/0.112984829.
    #[test]
    fn a_page_may_be_in_inches_and_pounds() {
        let units = Units::physical(7.5e-3).in_us();
        for (kind, value, text) in [
            (&of::PEAK, 3.561_9e-3, "0.140 in"),
            (&of::PEAK, 0.0, "0 in"),
            (&of::ABSORBER_MASS, 18.0, "39.68 lb"),
            (&of::ABSORBER_MASS, 0.032, "1.129 oz"),
            (&of::RMS_VELOCITY, 0.018, "0.709 in/s"),
            (&of::PEAK_ACCELERATION, 9.15, "0.933 g"),
            (&of::FORCE_AMPLITUDE, 0.5, "0.1124 lbf"),
            (&of::STIFFNESS, 11.47e3, "65.50 lbf/in"),
            (&of::WORK, 9.76e-3, "0.0864 in lbf"),
            (&of::EXCITATION_FREQUENCY, 8.0, "8.000 Hz"),
            (&of::Z3_SHARE, 0.728_21, "72.8 %"),
        ] {
            assert_eq!(units.text(kind, value), text, "{}", kind.id);
        }
        assert_eq!((units.length_symbol(), units.length_number(0.0254)), ("in", 1.0));
        let in_g = Units::physical(7.5e-3).in_g();
        assert_eq!(in_g.text(&of::PEAK_ACCELERATION, 9.15), "0.933 g");
        assert_eq!(in_g.text(&of::PEAK, 3.561_9e-3), "3.56 mm");
        // What is stored stays in SI, and a reduced design has units of its own.
        assert_eq!((units.name(), units.length_unit()), ("si", "m"));
        assert_eq!(Units::reduced().in_us().text(&of::PEAK, 1.0342), "1.03 units");
    }

    #[test]
    fn two_numbers_are_told_apart() {
        let units = Units::physical(7.5e-3);
        let apart = |kind, value, other| units.apart(kind, value, other);
        assert_eq!(apart(&of::PEAK, 3.900e-3, 4.1e-3), "3.900 mm");
        assert_eq!(apart(&of::PEAK, 3.900e-3, 3.9e-3), "3.900 mm");
        assert_eq!(apart(&of::PEAK, 3.900_01e-3, 3.9e-3), "3.90001 mm");
        assert_eq!(apart(&of::IMPACT_SPEED, 0.931_7, 1.068), "0.9317 m/s");
        assert_eq!(apart(&of::STABLE_SHARE, 0.749_99, 0.750_01), "74.999 %");
        assert_eq!(apart(&of::CHANGE_DB, -5.031, -5.032), "−5.031 dB");
    }

    #[test]
    fn a_largest_value_says_how_much_larger_it_may_be_and_an_average_both_ways() {
        let units = Units::physical(0.1);
        let digits = Digits::Significant(3);
        let found = units.with_error(&of::PEAK, 0.1223, 0.0049, digits);
        assert_eq!(found, "122 mm (+4.9 mm)");
        let found = units.with_error(&of::IMPACTS_PER_PERIOD, 0.6834, 0.1021, digits);
        assert_eq!(found, "0.68 ± 0.10");
        assert_eq!(units.with_error(&of::PEAK, 0.1223, 1e-6, digits), "122 mm");
        let level = |kind| {
            [0.002, 2.04].map(|error| units.with_error(kind, 1.98, error, Digits::Decimals(1)))
        };
        assert_eq!(level(&of::RMS_CHANGE_DB), ["+2.0 dB", "+2.0 ± 2.0 dB"]);
        // The largest that was seen may be exceeded.
        assert_eq!(level(&of::CHANGE_DB), ["+2.0 dB", "+2.0 dB (+2.0 dB)"]);
        let least = units.with_error(&of::REDUCTION_DB, 2.0, 0.8, Digits::Decimals(1));
        assert_eq!(least, "+2.0 dB (\u{2212}0.8 dB)");
    }
}
