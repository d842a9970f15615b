//! What a case can be read with, and is almost surely a slip: a unit or a per cent sign.
//!
//! A rule stands here only if a design that trips it on purpose is very rare: no shipped case does.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::error::Problem;
use super::physical::TABLES;
use super::reduced;
use super::{BandOver, BandSettings, Design, Physical};
use crate::system::System;
use std::f64::consts::TAU;

/// Ratio of the frequencies of drive and structure from which on they have nothing to do with one another.
const FAR_APART: f64 = 30.0;
/// Ratios that a wrong prefix, kHz for Hz, explains: a thousand, and a drive up to a decade off resonance.
const PREFIX: [f64; 2] = [100.0, 10_000.0];
/// Ratios that turns per minute, written as per second, explain.
const PER_MINUTE: [f64; 2] = [FAR_APART, 120.0];
/// Damping ratio above which a structure hardly has a resonance.
const HEAVY_DAMPING: f64 = 0.2;
/// Relative error that a damping ratio has after it became a damping and a ratio again: some roundings.
const ROUNDING: f64 = 1e-12;
/// Mass ratios between which an absorber is a small mass, and a mass at all.
const MASS_RATIOS: [f64; 2] = [1e-6, 0.5];

/// Everything that a valid case is warned of, in the order of the file's lines.
pub(super) fn of(
    text: &str,
    document: &DeTable,
    design: &Design,
    system: &System,
    band: Option<&BandSettings>,
) -> Vec<Problem> {
    let file = File { text, document };
    let mut found = file.frequencies(design, system, band);
    found.extend(file.damping(design, system));
    found.extend(file.mass_ratio(design, system));
    found.sort_by_key(|warning| warning.span.start);
    found
}

struct File<'t> {
    text: &'t str,
    document: &'t DeTable<'t>,
}

/// The value of a key of the file.
struct Value<'t> {
    key: &'static str,
    span: Range<usize>,
    /// Without quotes.
    written: &'t str,
}

impl<'t> File<'t> {
    /// The first of `keys` that stands in `table`.
    fn value(&self, table: &str, keys: &[&'static str]) -> Option<Value<'t>> {
        let DeValue::Table(entries) = self.document.get(table)?.get_ref() else { return None };
        let (key, value) = keys.iter().find_map(|key| Some((key, entries.get(*key)?)))?;
        let span = value.span();
        let written = self.text[span.clone()].trim_matches(['"', '\'']);
        Some(Value { key, span, written })
    }

    fn warning(&self, at: &Value, message: String, label: &str, meant: String) -> Problem {
        Problem::new(self.text, at.span.clone(), message, label).help(meant).into_warning()
    }

    /// Frequencies of the drive, its own and the band's, that are far from the structure's.
    fn frequencies(
        &self,
        design: &Design,
        system: &System,
        band: Option<&BandSettings>,
    ) -> Vec<Problem> {
        let own = match design {
            Design::Physical(_) => self.value(TABLES[2], &["frequency"]),
            Design::Reduced(_) => self.value(reduced::TABLE, &["frequency_ratio", "detuning"]),
        };
        let mut drives = vec![(own, system.frequency_ratio())];
        if let Some(BandSettings { over: BandOver::Frequency, range: [from, to], .. }) = band {
            drives.push((self.value("band", &["from"]), *from));
            drives.push((self.value("band", &["to"]), *to));
        }
        let far = |ratio: f64| ratio.max(1.0 / ratio) > FAR_APART;
        let distant = drives.iter().filter(|(_, ratio)| far(*ratio)).count();
        // Where every frequency of the drive is off and there are several, the structure's is the odd one.
        let structure = match design {
            Design::Physical(physical) if distant == drives.len() && distant > 1 => {
                self.structure(physical, system.frequency_ratio())
            }
            _ => None,
        };
        structure.map_or_else(
            || {
                let distant = drives.into_iter().filter(|(_, ratio)| far(*ratio));
                distant.filter_map(|(at, ratio)| Some(self.drive(&at?, ratio, design))).collect()
            },
            |warning| vec![warning],
        )
    }

    /// That the structure's frequency is far from all of the drive's.
    fn structure(&self, physical: &Physical, ratio: f64) -> Option<Problem> {
        let at = self.value(TABLES[0], &["frequency", "stiffness"])?;
        let natural = physical.natural_frequency_rad_per_s() / TAU;
        let message = format!(
            "the structure's natural frequency, {}, is {}",
            hertz(natural),
            times(1.0 / ratio, &format!("that of the drive, {}", hertz(physical.frequency_hz)))
        );
        let meant = match at.key {
            "frequency" => meant(at.written, natural, 1.0 / ratio, false),
            _ => "check the units of `stiffness` and `mass`: a factor of a thousand in one of them is 32 in \
                  the frequency"
                .to_owned(),
        };
        Some(self.warning(&at, message, "far from the drive", meant))
    }

    /// That a frequency of the drive is far from the structure's.
    fn drive(&self, at: &Value, ratio: f64, design: &Design) -> Problem {
        let than = "the structure's natural frequency";
        let (than, meant) = match design {
            Design::Physical(physical) => {
                let natural = physical.natural_frequency_rad_per_s() / TAU;
                let meant = meant(at.written, ratio * natural, ratio, true);
                (format!("{than}, {}", hertz(natural)), meant)
            }
            Design::Reduced(_) => {
                let meant = "frequencies of [reduced] are over the natural one, and 1 is resonance";
                (than.to_owned(), meant.to_owned())
            }
        };
        let message = format!("`{}` = {} is {}", at.key, at.written, times(ratio, &than));
        self.warning(at, message, "far from the structure's", meant)
    }

    fn damping(&self, design: &Design, system: &System) -> Option<Problem> {
        let ratio = 0.5 * system.mass_ratio() * system.damping();
        if ratio <= HEAVY_DAMPING * (1.0 + ROUNDING) {
            return None;
        }
        let at = match design {
            Design::Physical(_) => self.value(TABLES[0], &["damping_ratio", "damping"])?,
            Design::Reduced(_) => self.value(reduced::TABLE, &["damping"])?,
        };
        let means = match at.key {
            "damping_ratio" => "means",
            _ => "is a damping ratio of",
        };
        let message = format!("`{}` = {} {means} {}", at.key, at.written, percent(ratio));
        let as_percent = |part: f64| format!("{} ({})", percent(part), short(part));
        let meant = match design {
            Design::Reduced(_) => format!(
                "it is c1/(m2 omega0), and half of mass_ratio * damping is the damping ratio: 1 % is \
                 damping = {}",
                short(0.02 / system.mass_ratio())
            ),
            Design::Physical(physical) if at.key == "damping" => format!(
                "critical damping is {} N s/m; check the units of damping, mass and stiffness",
                short(physical.critical_damping_n_s_per_m())
            ),
            // A ratio of 0.4 was meant as 0.4 %, one of 40 as 40 % or as 0.40 %.
            _ if ratio > 20.0 && !at.written.contains('%') => {
                format!("was {} or {} meant?", as_percent(ratio / 1e4), percent(ratio / 100.0))
            }
            _ => format!("was {} meant?", as_percent(ratio / 100.0)),
        };
        Some(self.warning(&at, message, "most structures have less than 5 %", meant))
    }

    fn mass_ratio(&self, design: &Design, system: &System) -> Option<Problem> {
        let ratio = system.mass_ratio();
        let [least, most] = MASS_RATIOS;
        let (at, too_small) = match design {
            Design::Physical(_) => (self.value(TABLES[1], &["mass_ratio", "mass"])?, ratio < least),
            // Without units a small one is no slip of one.
            Design::Reduced(_) => (self.value(reduced::TABLE, &["mass_ratio"])?, false),
        };
        if !too_small && ratio <= most {
            return None;
        }
        let message = format!(
            "`{}` = {}: the absorber has {} times the structure's mass",
            at.key,
            at.written,
            short(ratio)
        );
        let meant = match at.key {
            "mass_ratio" if ratio > most && !at.written.contains('%') => {
                format!("was {} ({}) meant?", percent(ratio / 100.0), short(ratio / 100.0))
            }
            "mass_ratio" => "an absorber usually has about 1 % of the structure's mass".to_owned(),
            _ => "check the units of both masses: an absorber usually has about 1 % of the structure's"
                .to_owned(),
        };
        Some(self.warning(&at, message, "no small mass beside a structure", meant))
    }
}

/// What a frequency was meant to be, that is `ratio` times the one it should be near.
fn meant(written: &str, frequency_hz: f64, ratio: f64, of_drive: bool) -> String {
    let apart = ratio.max(1.0 / ratio);
    let within = |[from, to]: [f64; 2]| (from..=to).contains(&apart);
    let factor = if ratio > 1.0 { 1e-3 } else { 1e3 };
    if within(PREFIX) {
        format!("{written} for {}?", hertz(frequency_hz * factor))
    } else if of_drive && ratio > 1.0 && within(PER_MINUTE) {
        format!("{written} for as many turns per minute ({})?", hertz(frequency_hz / 60.0))
    } else {
        "check the units of both frequencies".to_owned()
    }
}

/// How large something is beside something else, "1000 times" or "1/1000 of".
fn times(ratio: f64, than: &str) -> String {
    match ratio > 1.0 {
        true => format!("{} times {than}", short(ratio)),
        false => format!("1/{} of {than}", short(1.0 / ratio)),
    }
}

fn hertz(frequency: f64) -> String {
    match frequency {
        high if high >= 1000.0 => format!("{} kHz", short(high / 1000.0)),
        low if low < 0.1 => format!("{} mHz", short(low * 1000.0)),
        usual => format!("{} Hz", short(usual)),
    }
}

fn percent(share: f64) -> String {
    format!("{} %", short(100.0 * share))
}

/// Three digits.
fn short(value: f64) -> String {
    let rounded = format!("{value:.2e}").parse().unwrap_or(value);
    match rounded {
        plain if (1e-4..1e7).contains(&plain) => plain.to_string(),
        far => format!("{far:e}"),
    }
}
