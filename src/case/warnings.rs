//! What a case can be read with, and is almost surely a slip: a unit or a per cent sign.
//!
//! A rule stands here only if a design that trips it on purpose is very rare: no shipped case does.

use super::error::Problem;
use super::inputs::Input;
use super::support::{Orientation, SOFT, is_stiff, metres, static_length};
use super::{BandOver, BandSettings, Case, Design, Rounding, record_faults};
use crate::excitation::Scene;
use crate::quantity::numbers::rounded_to;

/// Ratio of the frequencies of drive and structure from which on they have nothing to do with one another.
pub(super) const FAR_APART: f64 = 30.0;
/// Ratios that a wrong prefix, kHz for Hz, explains: a thousand, and a drive up to a decade off resonance.
const PREFIX: [f64; 2] = [100.0, 10_000.0];
/// Ratios that turns per minute, written as per second, explain.
const PER_MINUTE: [f64; 2] = [FAR_APART, 120.0];
/// Damping ratio above which a structure hardly has a resonance.
pub(super) const HEAVY_DAMPING: f64 = 0.2;
/// Relative error that a damping ratio has after it became a damping and a ratio again: some roundings.
const ROUNDING: f64 = 1e-12;
/// Mass ratios between which an absorber is a small mass, and a mass at all.
pub(super) const MASS_RATIOS: [f64; 2] = [1e-6, 0.5];
/// The most that a structure moves without absorbers, over the clearance, between which its unit is no slip.
const MOVES: [f64; 2] = [1.0 / 30.0, 1000.0];
/// Per cent that are told.
const LARGEST: f64 = 1e12;
/// Coefficient above which nothing slides.
const MOST_FRICTION: f64 = 1.0;
/// Share of the structure's acceleration up to which that of a support is left out in silence: by small steps at a fifth
/// of the excitation's frequency, peaks and averages of motions of all kinds then change by up to 6 %.
const MOST_LEFT_OUT: f64 = 0.2;

/// Everything that a case is warned of, in the order of the file's lines.
pub(super) fn of(case: &Case) -> Vec<Problem> {
    let read = Read { text: &case.text, case };
    let mut found = read.frequencies();
    found.extend(read.damping());
    found.extend(read.mass_ratio());
    found.extend(read.friction());
    found.extend(read.held());
    // Beside another slip sizes mean nothing.
    if found.is_empty() {
        found.extend(read.clearance());
        found.extend(read.support());
    }
    found.extend(record_faults::of(case));
    found.sort_by_key(|warning| warning.span.start);
    found
}

struct Read<'t> {
    text: &'t str,
    case: &'t Case,
}

impl Read<'_> {
    /// The number that stands under one of some keys, in the one of `[oscillator]`, `[absorber]` and
    /// `[excitation]` of that index, or in `[reduced]`.
    fn input(&self, table: usize, keys: &[&str]) -> Option<&Input> {
        let tables = self.case.design.writing().tables;
        let table = tables.get(table).or(tables.last())?;
        self.case.inputs.iter().find(|input| input.table == *table && keys.contains(&input.name))
    }

    fn warning(&self, at: &Input, message: String, label: &str, meant: String) -> Problem {
        Problem::new(self.text, at.span.clone(), message, label).help(meant).into_warning()
    }

    /// Frequencies of the drive, its own and the band's, that are far from the structure's.
    fn frequencies(&self) -> Vec<Problem> {
        let own = self.input(2, &["frequency", "frequency_ratio", "detuning", "from"]);
        let mut drives = vec![(own, self.case.system.frequency_ratio())];
        if let Some(BandSettings { over: BandOver::Frequency, range, .. }) = &self.case.band {
            let ends = ["from", "to"].map(|key| {
                self.case.inputs.iter().find(|input| input.table == "band" && input.name == key)
            });
            drives.extend(ends.into_iter().zip(*range));
        }
        let all = drives.len();
        drives.retain(|(_, ratio)| ratio.max(1.0 / ratio) > FAR_APART);
        // Where every frequency of the drive is off and there are several, the structure's is the odd one.
        let structure = if all > 1 && drives.len() == all { self.structure() } else { None };
        let of_drive = || drives.iter().filter_map(|(at, ratio)| Some(self.drive((*at)?, *ratio)));
        structure.map_or_else(|| of_drive().collect(), |warning| vec![warning])
    }

    /// That the structure's frequency is far from all of the drive's.
    fn structure(&self) -> Option<Problem> {
        let Design::Physical(physical) = &self.case.design else { return None };
        let at = self.input(0, &["frequency", "stiffness"])?;
        let (natural, ratio) =
            (self.case.units().frequency(1.0), 1.0 / self.case.system.frequency_ratio());
        let message = format!(
            "the structure's natural frequency, {}, is {}",
            hertz(natural),
            times(ratio, &format!("that of the drive, {}", hertz(physical.frequency_hz)))
        );
        let meant = match at.name {
            "frequency" => meant(&at.as_written, natural, ratio, false),
            _ => "check the units of `stiffness` and `mass`: a factor of a thousand in one of them is 32 in \
                  the frequency"
                .to_owned(),
        };
        Some(self.warning(at, message, "far from the drive", meant))
    }

    /// That a frequency of the drive is far from the structure's.
    fn drive(&self, at: &Input, ratio: f64) -> Problem {
        let natural = self.case.units().frequency(1.0);
        let than = "the structure's natural frequency";
        let (than, meant) = match self.case.design.is_physical() {
            true => (
                format!("{than}, {}", hertz(natural)),
                meant(&at.as_written, ratio * natural, ratio, true),
            ),
            false => (
                than.to_owned(),
                "frequencies of [reduced] are over the natural one, and 1 is resonance".to_owned(),
            ),
        };
        let message = format!("`{}` = {} is {}", at.name, at.as_written, times(ratio, &than));
        self.warning(at, message, "far from the structure's", meant)
    }

    fn damping(&self) -> Option<Problem> {
        let ratio = 0.5 * self.case.system.mass_ratio() * self.case.system.damping();
        if ratio <= HEAVY_DAMPING * (1.0 + ROUNDING) {
            return None;
        }
        let at = self.input(0, &["damping_ratio", "damping"])?;
        let is_ratio = at.name == "damping_ratio";
        let means = if is_ratio { "means" } else { "is a damping ratio of" };
        let message = format!("`{}` = {} {means} {}", at.name, at.as_written, percent(ratio));
        let as_percent = |part: f64| format!("{} ({})", percent(part), short(part));
        let meant = match &self.case.design {
            Design::Reduced(_) => format!(
                "it is c1/(m2 omega0), and half of mass_ratio * damping is the damping ratio: 1 % is \
                 damping = {}",
                short(0.02 / self.case.system.mass_ratio())
            ),
            Design::Physical(physical) if !is_ratio => format!(
                "critical damping is {} N s/m; check the units of damping, mass and stiffness",
                short(physical.critical_damping_n_s_per_m())
            ),
            // A ratio of 0.4 was meant as 0.4 %, one of 40 as 40 % or as 0.40 %.
            _ if ratio > 20.0 && !at.as_written.contains('%') => {
                format!("was {} or {} meant?", as_percent(ratio / 1e4), percent(ratio / 100.0))
            }
            _ => format!("was {} meant?", as_percent(ratio / 100.0)),
        };
        Some(self.warning(at, message, "most structures have less than 5 %", meant))
    }

    fn mass_ratio(&self) -> Option<Problem> {
        let ratio = self.case.system.mass_ratio();
        let [least, most] = MASS_RATIOS;
        // Without units a small one is no slip of one.
        let too_small = ratio < least && self.case.design.is_physical();
        if !too_small && ratio <= most {
            return None;
        }
        let at = self.input(1, &["mass_ratio", "mass"])?;
        let message = format!(
            "`{}` = {}: the absorber has {} times the structure's mass",
            at.name,
            at.as_written,
            short(ratio)
        );
        let meant = match at.name {
            "mass_ratio" if ratio > most && !at.as_written.contains('%') => {
                format!("was {} ({}) meant?", percent(ratio / 100.0), short(ratio / 100.0))
            }
            "mass_ratio" => "an absorber usually has about 1 % of the structure's mass".to_owned(),
            _ => "check the units of both masses: an absorber usually has about 1 % of the structure's"
                .to_owned(),
        };
        Some(self.warning(at, message, "no small mass beside a structure", meant))
    }

    /// That the structure, driven at one amplitude, moves far less or far more than to a wall.
    fn clearance(&self) -> Option<Problem> {
        let system = &self.case.system;
        let of_amplitude =
            self.case.band.as_ref().is_some_and(|one| one.over == BandOver::Amplitude);
        // What has no unit has none that is wrong.
        let is_asked = self.case.design.is_physical() && !of_amplitude;
        if !is_asked || self.case.design.scene() != Scene::Steady {
            return None;
        }
        let zeta = 0.5 * system.mass_ratio() * system.damping();
        let moved = system.mass_ratio() * system.forcing_per_clearance();
        let (message, label, meant) = far_from_walls(resonant(moved, zeta))?;
        let at = self.input(1, &["clearance"])?;
        let message = format!("`clearance` = {}: {message}", at.as_written);
        Some(self.warning(at, message, label, meant.to_owned()))
    }

    fn friction(&self) -> Option<Problem> {
        let at = self.input(1, &["friction"]).filter(|at| at.value > MOST_FRICTION)?;
        let message = format!("`friction` = {} means {}", at.as_written, percent(at.value));
        let part = at.value / 100.0;
        let meant = match part <= MOST_FRICTION {
            true => format!("was {} ({}) meant?", percent(part), short(part)),
            false => "it is the friction force over the normal force: steel on steel has 0.1 to 0.6, rolling 0.001 to 0.01".to_owned(),
        };
        Some(self.warning(at, message, "what slides has less than 1", meant))
    }

    /// That gravity holds the absorber at its lower wall, or friction wherever it is: the structure with that mass does
    /// not accelerate as much.
    fn held(&self) -> Option<Problem> {
        let cavity = self.case.system.cavity();
        let (gravity, friction) = (cavity.gravity_along.abs(), cavity.friction_acceleration);
        if gravity.max(friction) == 0.0 {
            return None;
        }
        let acceleration = self.case.acceleration_carried().filter(|largest| *largest > 0.0)?;
        let (keys, what, holds, label): (&[&str], _, _, _) = if gravity > acceleration {
            let label = "an absorber at its lower wall stays there";
            (
                &["orientation", "inclination", "gravity_along"],
                "gravity along the cavity",
                gravity,
                label,
            )
        } else if friction > acceleration + gravity {
            (
                &["friction", "friction_acceleration"],
                "friction",
                friction,
                "it holds the absorber wherever it is",
            )
        } else {
            return None;
        };
        let at =
            self.input(1, keys).filter(|at| at.name != "friction" || at.value <= MOST_FRICTION)?;
        let message = format!(
            "`{}` = {}: {what} is {}",
            at.name,
            at.as_written,
            times(holds / acceleration, "the structure's acceleration with the absorber at rest")
        );
        Some(self.warning(at, message, label, self.carrying(at)))
    }

    /// What holds an absorber in a cavity without friction and gravity along it.
    fn carrying(&self, at: &Input) -> String {
        let Design::Physical(physical) = &self.case.design else {
            return match at.name {
                "gravity_along" => {
                    "it is over the clearance times omega0^2: 0 is a level cavity".to_owned()
                }
                _ => "it is over the clearance times omega0^2: 0 is a cavity that does not rub"
                    .to_owned(),
            };
        };
        let softest = Rounding::Down.of(SOFT * self.case.lowest_hz());
        let length = metres(static_length(softest));
        let (level, support, is) = match physical.orientation() {
            Some(Orientation::Vertical) => ("", "spring", "the absorber's weight stretches it by"),
            Some(Orientation::Horizontal) => ("", "pendulum", "it does not rub, and its length is"),
            None => (
                "0 deg is a level cavity; ",
                "pendulum",
                "in such it does not rub, and its length is",
            ),
        };
        format!(
            "{level}write support = \"{support}\" and support_frequency = \"{softest} Hz\": {is} {length}, \
             0.25 m/(f/Hz)^2"
        )
    }

    /// That the force of the support is not small, which the model leaves out.
    fn support(&self) -> Option<Problem> {
        let (ratio, left_out) = (self.case.support_ratio()?, self.case.support_left_out()?);
        let at = self.input(1, &["support_frequency"])?;
        if !is_stiff(ratio) && left_out <= MOST_LEFT_OUT {
            let drifted = self.case.support_ratio_in_drift().filter(|ratio| is_stiff(*ratio))?;
            let message = format!(
                "`{}` = {} is {} of the lowest natural frequency that [uncertainty] or [sweep] gives the structure",
                at.name,
                at.as_written,
                percent(drifted)
            );
            let meant = format!(
                "there the model leaves out a force that counts: it is small up to {}",
                percent(SOFT)
            );
            return Some(self.warning(at, message, "no soft support there", meant));
        }
        let message = format!(
            "`{}` = {}: the support's restoring acceleration, which the model leaves out, is {} of the structure's",
            at.name,
            at.as_written,
            percent(left_out)
        );
        let softest =
            SOFT.min(ratio * libm::sqrt(MOST_LEFT_OUT / left_out)) * self.case.lowest_hz();
        let length = metres(static_length(softest));
        let meant =
            format!("it is small up to {}; its length or stretch is then {length}", hertz(softest));
        Some(self.warning(at, message, "no soft support", meant))
    }
}

/// The most that a static displacement becomes at any frequency, and with that of a base added.
pub(super) fn resonant(moved: f64, damping_ratio: f64) -> f64 {
    moved * (1.0 + 0.5 / damping_ratio)
}

/// What is wrong with a clearance where a structure without absorbers moves at most so many times as far: message, label and what to
/// do.
pub(super) fn far_from_walls(most: f64) -> Option<(String, &'static str, &'static str)> {
    let [least, largest] = MOVES;
    let label = match most {
        short if short > 0.0 && short < least => "no wall is ever reached",
        long if long > largest && long.is_finite() => "walls that are hardly apart beside that",
        _ => return None,
    };
    let message = format!("the structure without absorbers moves at most {}", times(most, "that"));
    let meant = "check its unit: an absorber acts where the structure moves by about a quarter of its clearance to some times that";
    Some((message, label, meant))
}

/// What a frequency was meant to be, that is `ratio` times the one it should be near.
pub(super) fn meant(written: &str, frequency_hz: f64, ratio: f64, of_drive: bool) -> String {
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
pub(super) fn times(ratio: f64, than: &str) -> String {
    match ratio > 1.0 {
        true => format!("{} times {than}", short(ratio)),
        false => format!("1/{} of {than}", short(1.0 / ratio)),
    }
}

pub(super) fn hertz(frequency: f64) -> String {
    match frequency {
        high if high >= 1000.0 => format!("{} kHz", short(high / 1000.0)),
        low if low < 0.1 => format!("{} mHz", short(low * 1000.0)),
        usual => format!("{} Hz", short(usual)),
    }
}

pub(super) fn percent(share: f64) -> String {
    match 100.0 * share {
        told if told < LARGEST => format!("{} %", short(told)),
        _ => format!("more than {} %", short(LARGEST)),
    }
}

/// Three digits.
pub(super) fn short(value: f64) -> String {
    match rounded_to(value, 3) {
        plain if (1e-4..1e7).contains(&plain) => plain.to_string(),
        far => format!("{far:e}"),
    }
}
