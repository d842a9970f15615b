//! A case of several modes and absorbers: `[[mode]]`, `[[absorber]]` and `[excitation]`, or `[[excitation]]` where several
//! may act, one at a time.

mod alike;
mod asked;
mod file;
mod listing;
mod load;
mod mode;
mod number;
mod of_one;
mod place;
mod read;
mod reduced;
mod starting;
mod sweep;
mod table;
mod universal;
mod warnings;

use std::ops::Range;
use std::sync::Arc;

use toml::de::DeTable;

use super::comment;
use super::criteria::Criterion;
use super::document;
use super::error::{CaseError, Problem};
use super::one::OneMode;
use super::optimize::Objective;
use super::reader::Reader;
use super::rewrite::{RewriteError, Rounding, in_unit_of};
use crate::contact::Impacts;
use crate::digest::text_sha256;
use crate::quantity::Kind;
use crate::quantity::catalogue as of;
use vinesink_core::names;

pub use listing::{ListedMode, ModesListing};
pub use number::is_of_absorber;
pub(super) use place::find_place;
pub(super) use read::ModalFile;
pub use starting::StartingModes;
pub use sweep::ModalSweep;
pub(super) use sweep::form as axis_form;
pub use table::ModesFile;

use crate::system::{InvalidModalSystem, ModalAbsorber, ModalParameters, ModalSystem, Mode};

/// A structure of several modes with absorbers, what drives it and what is asked of it, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalCase {
    /// What the case is, in a line.
    pub title: String,
    /// Where its numbers come from.
    pub source: String,
    /// SHA-256 of the file's text with line ends of one kind, in hexadecimal.
    pub text_hash: String,
    /// Whether it is dimensionless: lengths and masses in a unit of their own, frequencies over that of the first mode, and time
    /// `omega_1 t` in place of SI.
    pub reduced: bool,
    /// Names of the places that shapes are given at, in the order of the file.
    pub places: Vec<String>,
    /// The modes; the first is that which frequencies are over.
    pub modes: Vec<StructuralMode>,
    /// Whether the contact times are what a sensor sees of impacts, which take none.
    pub contact_is_sensors: bool,
    /// The absorbers.
    pub absorbers: Vec<PlacedAbsorber>,
    /// What may drive it, one at a time.
    pub loads: Vec<Load>,
    /// Whether they are written as a list, `[[excitation]]`.
    pub lists_loads: bool,
    /// Whether motions count in which absorbers rest.
    pub count_inactive: bool,
    /// Limits of what it does.
    pub criteria: Vec<Criterion>,
    /// Starts at each frequency of a range, that from rest among them.
    pub starts: u32,
    /// The same under a load of one frequency.
    pub starts_at_one: u32,
    /// Excitation periods that a motion which does not repeat is measured for at least.
    pub periods: u64,
    /// The file of its modes, where they are in one.
    pub modes_file: Option<ModesFile>,
    /// How many modes that is, and what was found in the file, as a sentence without its end.
    pub modes_from: Option<String>,
    /// Within which bounds better absorbers are looked for.
    pub bounds: Bounds,
    /// Units of its pages, from the table `[report]`.
    pub page_units: crate::case::PageUnits,
    /// The table `[alternatives]`; its defaults where there is none.
    pub alternatives: crate::case::AlternativesSettings,
    /// The table `[accuracy]`, if there is one.
    pub accuracy: Option<crate::case::AccuracySettings>,
    /// The table `[uncertainty]`; nothing is uncertain where there is none.
    pub uncertainty: crate::case::Uncertainty,
    /// What `vinesink sweep` varies.
    pub sweep: Option<ModalSweep>,
    /// What is almost surely a slip, in the order of the file's lines.
    pub warnings: Vec<Problem>,
    /// The file's text, after a byte order mark.
    pub(crate) text: Arc<str>,
    /// Where the values of each absorber stand in the text, as [`AbsorberKey::ALL`].
    pub(crate) values: Vec<[Option<Range<usize>>; AbsorberKey::ALL.len()]>,
}

/// Within which bounds better absorbers are looked for: the table `[optimize]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bounds {
    /// What they are looked for by; what the first criterion asks where there is none.
    pub objective: Option<Objective>,
    /// Bounds of each clearance in m; a third to three times its own where there are none.
    pub clearance_m: Option<[f64; 2]>,
    /// Bounds of the restitution of all of them; each its own where there are none.
    pub restitution: Option<[f64; 2]>,
    /// Places at which they may be, ascending; each its own where there are none.
    pub places: Vec<usize>,
    /// Whether they may share their mass otherwise.
    pub split_mass: bool,
}

names! { name:
    /// What a case says of an absorber.
    pub enum AbsorberKey {
        /// Where it is.
        Place = "place",
        /// Its mass.
        Mass = "mass",
        /// Its clearance.
        Clearance = "clearance",
        /// Its restitution.
        Restitution = "restitution",
    }
}

/// A mode of a structure.
#[derive(Debug, Clone, PartialEq)]
pub struct StructuralMode {
    /// Natural frequency in Hz.
    pub frequency_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Modal mass in kg, by the scale of the shape.
    pub mass_kg: f64,
    /// Displacement at each place where the modal coordinate is 1.
    pub shape: Vec<f64>,
    /// Participation in the motion of the base.
    pub participation: f64,
    /// Part of a load that acts on all modes at once, over modal mass.
    pub forcing: f64,
}

/// An absorber at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedAbsorber {
    /// Which place.
    pub place: usize,
    /// Mass in kg.
    pub mass_kg: f64,
    /// Free distance to either wall in m.
    pub clearance_m: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// How long an impact takes in s, as a half-sine, where the acceleration is to have it.
    pub contact_time_s: Option<f64>,
}

impl PlacedAbsorber {
    /// What a case says of it, in SI units; the number of its place.
    fn value(&self, key: AbsorberKey) -> f64 {
        match key {
            AbsorberKey::Place => self.place as f64,
            AbsorberKey::Mass => self.mass_kg,
            AbsorberKey::Clearance => self.clearance_m,
            AbsorberKey::Restitution => self.restitution,
        }
    }
}

/// What a harmonic excitation acts on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActsOn {
    /// A force at a place.
    Place(usize),
    /// A force in one mode alone.
    Mode(usize),
    /// Forces in all modes, each over its modal mass.
    Modes,
    /// The base moves.
    Base,
}

/// A harmonic excitation over a range of frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// What it acts on.
    pub on: ActsOn,
    /// Amplitude in N, in m of the base, or of the largest force over modal mass.
    pub amplitude: f64,
    /// Frequencies in Hz, ascending; the same twice where there is one.
    pub range_hz: [f64; 2],
}

impl Load {
    /// What its amplitude is.
    pub fn amplitude_kind(&self) -> &'static Kind {
        match self.on {
            ActsOn::Base => &of::BASE_AMPLITUDE,
            ActsOn::Modes => &of::MODAL_FORCING,
            ActsOn::Place(_) | ActsOn::Mode(_) => &of::FORCE_AMPLITUDE,
        }
    }

    /// The natural frequencies of modes in its range, of that which it acts on if it acts on one, in Hz; the middle of the range
    /// where there is none. Of an undamped mode one beside its own.
    pub fn resonances(&self, case: &ModalCase) -> Vec<f64> {
        let [from, to] = self.range_hz;
        let modes = case.modes.iter().enumerate();
        let acts = |k: usize| !matches!(self.on, ActsOn::Mode(mode) if mode != k);
        let own = modes.filter(|(k, _)| acts(*k)).map(|(_, mode)| mode.frequency_hz);
        let within: Vec<f64> = own.filter(|own| (from..=to).contains(own)).collect();
        let all = if within.is_empty() { vec![0.5 * (from + to)] } else { within };
        all.into_iter().map(|at| case.steady(self, at)).collect()
    }

    /// The first of its [`resonances`](Self::resonances).
    pub fn centre(&self, case: &ModalCase) -> f64 {
        self.resonances(case)[0]
    }
}

/// Whether a text is of several modes or absorbers: what does not parse is not.
pub fn is_modal(text: &str) -> bool {
    let Ok(document) = document::parse(text.strip_prefix('\u{feff}').unwrap_or(text)) else {
        return false;
    };
    tells_several(&document).is_some() && OneMode::of(&document).is_none()
}

/// The path of the file that the modes of a text are in, relative to the case file; none of one that lists modes beside it, which
/// is refused.
pub fn modes_file(text: &str) -> Option<String> {
    let document = document::parse(text.strip_prefix('\u{feff}').unwrap_or(text)).ok()?;
    if document.contains_key("mode") {
        return None;
    }
    let table = document.get("modes")?.get_ref().as_table()?;
    Some(table.get("file")?.get_ref().as_str()?.to_owned())
}

/// Where a document says that it is of several modes or absorbers.
pub(super) fn tells_several(document: &DeTable) -> Option<Range<usize>> {
    let listed = |name: &str, list: bool| {
        let (key, value) = document.get_key_value(name)?;
        (value.get_ref().is_array() || !list).then(|| key.span())
    };
    let reduced = document.get("reduced").and_then(|table| table.get_ref().as_table());
    let reduced =
        reduced.filter(|table| ["mode", "absorber"].iter().any(|key| table.contains_key(*key)));
    if reduced.is_some() {
        return document.get_key_value("reduced").map(|(key, _)| key.span());
    }
    let listed_modes = listed("mode", false).or_else(|| listed("modes", false));
    listed_modes.or_else(|| listed("absorber", true))
}

impl ModalCase {
    /// Reads a case from its text; `name`, usually the file's path, is for messages only.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong; also where its modes are in a file.
    pub fn parse(name: &str, text: &str) -> Result<Self, CaseError> {
        Self::parse_with(name, text, None)
    }

    /// The same with the file of its modes that the text names, see [`modes_file`].
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong with either.
    pub fn parse_with(name: &str, text: &str, modes: Option<ModesFile>) -> Result<Self, CaseError> {
        let visible = text.strip_prefix('\u{feff}').unwrap_or(text);
        let refused = |problems, more| CaseError::new(name, visible, problems, more);
        let document = document::parse(visible).map_err(|problems| refused(problems, 0))?;
        let mut reader = Reader::of(visible);
        match read::read(&mut reader, &document, text_sha256(text), modes.as_ref())? {
            Some((case, spans)) if reader.problems.is_empty() => {
                if let Some(problem) = warnings::out_of_scale(&case, visible) {
                    return Err(refused(vec![problem], 0));
                }
                let warnings = warnings::of(&case, visible, &spans, reader.warnings);
                Ok(Self { modes_file: modes, warnings, text: Arc::from(visible), ..case })
            }
            _ => Err(refused(reader.problems, reader.more)),
        }
    }

    /// The smallest clearance, in m: the unit of what is told over a clearance.
    pub(crate) fn least_clearance_m(&self) -> f64 {
        self.absorbers.iter().map(|one| one.clearance_m).fold(f64::INFINITY, f64::min)
    }

    /// The text of this case, which `text` must be, with other absorbers, and the case that it is then: values that differ are rounded to four significant
    /// digits in the unit their author used, everything else as it is.
    ///
    /// # Errors
    /// [`RewriteError`] where `text` is not this case's, or they make no case.
    pub fn rewritten(
        &self,
        text: &str,
        absorbers: &[PlacedAbsorber],
    ) -> Result<(String, Self), RewriteError> {
        let mut text = text.strip_prefix('\u{feff}').unwrap_or(text).to_owned();
        // Places are those of this very text, line ends included.
        if *text != *self.text {
            return Err(RewriteError::OtherText);
        }
        let mut changes: Vec<(Range<usize>, String)> = Vec::new();
        for ((own, new), values) in self.absorbers.iter().zip(absorbers).zip(&self.values) {
            for (key, span) in AbsorberKey::ALL.into_iter().zip(values) {
                let (Some(span), true) = (span, own.value(key) != new.value(key)) else { continue };
                let value = match key {
                    AbsorberKey::Place => format!("{:?}", self.places[new.place]),
                    _ => in_unit_of(
                        text[span.clone()].trim_matches(['"', '\'']),
                        new.value(key),
                        Rounding::Nearest,
                    ),
                };
                changes.push((span.clone(), value));
            }
        }
        // From the end of the text, so that what is before stays in its place.
        changes.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
        for (span, value) in changes {
            let (end, own) = (span.start + value.len(), text[span.clone()].to_owned());
            text.replace_range(span, &value);
            // What a comment says of the number that was there need no longer hold.
            let stale = |range: &Range<usize>| !comment::fits(&text[range.clone()], &own);
            if let Some(range) = comment::behind(&text, end).filter(stale) {
                text.replace_range(range, "");
            }
        }
        let case = Self::parse_with("the changed case", &text, self.modes_file.clone());
        let case = case.map_err(Box::new)?;
        Ok((text, case))
    }

    /// For each place the value of each mode's shape.
    pub fn shapes(&self) -> Vec<Vec<f64>> {
        let places = 0..self.places.len();
        places.map(|p| self.modes.iter().map(|mode| mode.shape[p]).collect()).collect()
    }

    /// Starts at a frequency of a load.
    pub fn starts_of(&self, load: &Load) -> u32 {
        let [from, to] = load.range_hz;
        if from < to { self.starts } else { self.starts_at_one }
    }

    /// Dimensionless times in the case's own unit of time: the first mode's natural frequency in rad/s; of a reduced case over
    /// that of its unit, 1 unless its modes are others than those of the file.
    pub fn omega(&self) -> f64 {
        let first = self.modes[0].frequency_hz;
        if self.reduced { first } else { std::f64::consts::TAU * first }
    }

    /// The mass that pages are in, in the case's own unit: the first mode's of a reduced case.
    pub fn mass_unit(&self) -> f64 {
        if self.reduced { self.modes[0].mass_kg } else { 1.0 }
    }

    /// A frequency in Hz of a load, or one beside it: at its own an undamped mode has no steady motion.
    pub(crate) fn steady(&self, load: &Load, at: f64) -> f64 {
        /// How far beside, over it.
        const BESIDE: f64 = 1e-6;
        if self.system(load, at).is_ok() { at } else { at * (1.0 + BESIDE) }
    }

    /// The structure with its absorbers under a load at a frequency in Hz: lengths in m, masses in kg, time `omega_1 t`. Shapes
    /// are those at the absorbers.
    ///
    /// # Errors
    /// [`InvalidModalSystem`] where the load has no steady motion.
    pub fn system(
        &self,
        load: &Load,
        frequency_hz: f64,
    ) -> Result<ModalSystem, InvalidModalSystem> {
        let first = self.modes[0].frequency_hz;
        let omega = self.omega();
        let modes = self.modes.iter().enumerate().map(|(k, mode)| {
            let force = match load.on {
                ActsOn::Place(place) => mode.shape[place] * load.amplitude,
                ActsOn::Mode(driven) if driven == k => load.amplitude,
                ActsOn::Modes => mode.forcing * load.amplitude * mode.mass_kg,
                ActsOn::Mode(_) | ActsOn::Base => 0.0,
            };
            Mode {
                frequency: mode.frequency_hz / first,
                damping_ratio: mode.damping_ratio,
                mass: mode.mass_kg,
                forcing: force / (mode.mass_kg * omega * omega),
                participation: if load.on == ActsOn::Base { mode.participation } else { 0.0 },
                shape: self.absorbers.iter().map(|one| mode.shape[one.place]).collect(),
            }
        });
        let absorbers = self.absorbers.iter().map(|one| ModalAbsorber {
            mass: one.mass_kg,
            clearance: one.clearance_m,
            restitution: one.restitution,
        });
        let moves = if load.on == ActsOn::Base { load.amplitude } else { 0.0 };
        ModalSystem::new(ModalParameters {
            modes: modes.collect(),
            absorbers: absorbers.collect(),
            frequency_ratio: frequency_hz / first,
            base_amplitude: moves,
        })
    }
}

impl ModalCase {
    /// The same with the clearances and restitutions that act like its impacts, which take time; none where they take none, or there
    /// are none.
    pub(crate) fn acting_like(&self, impacts: &[Option<Impacts>]) -> Option<Self> {
        if self.contact_is_sensors {
            return None;
        }
        let mut case = self.clone();
        let omega = self.omega();
        let mut any = false;
        for (one, found) in case.absorbers.iter_mut().zip(impacts) {
            let (Some(time), Some(found)) = (one.contact_time_s, found) else { continue };
            let pair = found.act_like([one.clearance_m, one.restitution], time * omega);
            [one.clearance_m, one.restitution] = pair;
            any = true;
        }
        any.then_some(case)
    }
}
