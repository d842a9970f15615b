//! The layers beside the simulation at the ends of their ranges: theory, free decay, exact orbits, their limits, and what
//! bands compare with. `peers/extremes/layers.py` computes the same numbers in 80 decimal digits from the equations of
//! motion and of the slow flow, and what each of them changes by where a parameter is rounded; its table stands beside this
//! file.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::list::Varied;
use super::{ExtremesError, RunVerdict};
use vinesink::analysis::{Analysis, FreeDecay};
use vinesink::band::Band;
use vinesink::band::theory::z3_share;
use vinesink::bifurcation::Bifurcation;
use vinesink::excitation::{Record, RecordQuantity, SineSweep, SweepRate};
use vinesink::flights::{Passage, follow};
use vinesink::linear::{TunedMassDamper, bare_along, driven, swept};
use vinesink::operation_count::counted;
use vinesink::orbits::{SymmetricFamily, symmetric_orbits};
use vinesink::simulation::{ImpactLog, Simulation};
use vinesink::system::{BandOver, Cavity, Excitation, Parameters, Scales, State, System};

const TABLE: &str = include_str!("layers.json");

/// How much further than rounding of the parameters a value may be off: each is a dozen operations and more.
pub const ROUNDINGS: f64 = 32.0;
/// Operations, as [`vinesink::operation_count`] counts them, that a row may take: a second of a machine that does 1e8 of them.
pub const MOST_OPERATIONS: u64 = 100_000_000;
/// What equations leave, relative to their terms, from which on a solution is not trusted.
pub const RESIDUAL: f64 = 1e-9;
/// Frequency ratios of the band over which largest amplitudes are compared, and the amplitude from which a decay begins.
const BAND: [f64; 2] = [0.7, 1.3];
const DECAY_FROM: f64 = 0.5;

/// A layer of the program that is no simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CheckedLayer {
    /// Fixed points of the slow flow with trace and determinant, boundaries, P1.
    Theory,
    /// Shares of a band of frequencies, and of one of amplitudes, in area Z3.
    Band,
    /// Time, share of the impacts and amplitude at the end of a free decay.
    Decay,
    /// Exact symmetric orbits with their largest multipliers.
    Orbits,
    /// Where they begin, end and change, and the stretches of those that attract.
    Limits,
    /// Largest amplitudes along a band without the absorber, and with a tuned mass damper.
    Damper,
    /// Times and speeds of the first impacts of a structure that is let go.
    Release,
    /// Largest displacement of the structure alone in a fast sweep, flown and by matrix exponentials.
    Sweep,
    /// The same under a force in straight lines.
    Record,
}

impl CheckedLayer {
    /// All of them, in the order of the page.
    pub const ALL: [Self; 9] = [
        Self::Theory,
        Self::Band,
        Self::Decay,
        Self::Orbits,
        Self::Limits,
        Self::Damper,
        Self::Release,
        Self::Sweep,
        Self::Record,
    ];
}

/// A row of the table.
#[derive(Debug, Clone, Deserialize)]
pub struct Row {
    /// The layer.
    pub layer: CheckedLayer,
    /// Numbers that are not those of Table 1.
    pub varied: Vec<(Varied, f64)>,
    /// `eps`, `lambda`, `r`, `Omega`, `gamma`.
    parameters: [f64; 5],
    /// Whether all values are there as well where a parameter is rounded.
    settled: bool,
    /// By how much the layer itself says that its values are off, relatively, beyond rounding.
    #[serde(default)]
    stated: f64,
    /// Each value, and what rounding of the parameters changes it by.
    values: BTreeMap<String, [f64; 2]>,
}

/// A row with what the program says.
#[derive(Debug, Clone, Serialize)]
pub struct LayerOutcome {
    /// The layer.
    pub layer: CheckedLayer,
    /// Numbers that are not those of Table 1.
    pub varied: Vec<(Varied, f64)>,
    /// Values compared.
    pub compared: usize,
    /// Largest relative error, and the value that has it.
    pub error: f64,
    /// See [`Self::error`].
    pub of: String,
    /// What rounding of the parameters changes that value by, relatively.
    pub rounding: f64,
    /// Operations that it took.
    pub operations: u64,
    /// Values that are wrong or missing, and those that should not be there.
    pub wrong: Vec<String>,
    /// What it means.
    pub verdict: RunVerdict,
}

/// What the program says: values, and why they should not be trusted.
type LayerAnswer = (BTreeMap<String, f64>, Vec<String>);

/// All rows of the table.
///
/// # Errors
/// [`ExtremesError`] if the table itself were wrong.
pub fn rows() -> Result<Vec<Row>, ExtremesError> {
    serde_json::from_str(TABLE).map_err(ExtremesError::Table)
}

impl Row {
    /// The system, driven by its base.
    ///
    /// # Errors
    /// [`ExtremesError`] if the table itself were wrong.
    pub fn system(&self) -> Result<System, ExtremesError> {
        let [mass_ratio, damping, restitution, frequency_ratio, forcing_per_clearance] =
            self.parameters;
        let excitation = Excitation::BaseDisplacement;
        let cavity = Cavity::IDEAL;
        Ok(System::new(Parameters {
            mass_ratio,
            damping,
            restitution,
            frequency_ratio,
            forcing_per_clearance,
            excitation,
            cavity,
        })?)
    }

    /// Asks the program and compares.
    ///
    /// # Errors
    /// [`ExtremesError`] if the table itself were wrong.
    pub fn outcome(&self) -> Result<LayerOutcome, ExtremesError> {
        let system = self.system()?;
        let (answer, operations) = counted(|| self.layer.answer(&system));
        let mut outcome = LayerOutcome {
            layer: self.layer,
            varied: self.varied.clone(),
            compared: 0,
            error: 0.0,
            of: String::new(),
            rounding: 0.0,
            operations,
            wrong: Vec::new(),
            verdict: RunVerdict::Holds,
        };
        let (found, doubts) = match answer {
            Ok(answer) => answer,
            Err(refusal) => {
                outcome.verdict = RunVerdict::Refused(refusal);
                return Ok(outcome);
            }
        };
        // Roots and limits are counted; which of the others exist is a matter of convention.
        let counts =
            |name: &str| self.settled && name.ends_with(|last: char| last.is_ascii_digit());
        let extra = found.keys().filter(|name| counts(name) && !self.values.contains_key(*name));
        outcome.wrong.extend(extra.map(|name| format!("{name} does not exist")));
        for (name, [value, rounding]) in &self.values {
            let Some(own) = found.get(name) else {
                if self.settled {
                    outcome.wrong.push(format!("{name} is missing"));
                }
                continue;
            };
            outcome.compared += 1;
            let size = value.abs().max(f64::MIN_POSITIVE);
            let error = (own - value).abs() / size;
            let rounding = rounding / size + f64::EPSILON;
            if error.is_nan() || error > ROUNDINGS * rounding + self.stated {
                outcome.wrong.push(format!("{name} is {own:e}, not {value:e}"));
            }
            if outcome.of.is_empty() || error.is_nan() || error > outcome.error {
                (outcome.error, outcome.of, outcome.rounding) = (error, name.clone(), rounding);
            }
        }
        if operations > MOST_OPERATIONS {
            outcome.wrong.push(format!("it takes {operations} operations"));
        }
        outcome.verdict = match (doubts.is_empty(), outcome.wrong.is_empty()) {
            (false, _) => RunVerdict::Flagged(doubts),
            (true, true) => RunVerdict::Holds,
            (true, false) => RunVerdict::Wrong,
        };
        Ok(outcome)
    }
}

impl CheckedLayer {
    fn answer(self, system: &System) -> Result<LayerAnswer, String> {
        match self {
            Self::Theory => theory(system),
            Self::Band => Ok(band(system)),
            Self::Decay => Ok(decay(system)),
            Self::Orbits => orbits(system),
            Self::Limits => limits(system),
            Self::Damper => Ok(damper(system)),
            Self::Release => release(system),
            Self::Sweep => sweep(system),
            Self::Record => record(system),
        }
    }
}

/// A residual above [`RESIDUAL`] in words.
fn doubt(what: &str, residual: f64) -> Option<String> {
    let trusted = residual <= RESIDUAL;
    (!trusted)
        .then(|| format!("the equations of {what} are left with {residual:.1e} of their terms"))
}

fn theory(system: &System) -> Result<LayerAnswer, String> {
    let analysis = Analysis::of(system).map_err(|error| error.to_string())?;
    let (mut found, mut doubts) = (BTreeMap::new(), Vec::new());
    for (k, point) in (1..).zip(&analysis.fixed_points) {
        let values = [
            ("B", point.absorber_amplitude),
            ("C", point.oscillator_amplitude),
            ("trace", point.trace),
            ("det", point.determinant),
        ];
        found.extend(values.map(|(name, value)| (format!("{name}{k}"), value)));
        doubts.extend(doubt(&format!("fixed point {k}"), point.residual));
    }
    let limits = &analysis.boundaries;
    let values = [
        ("hopf", limits.hopf),
        ("breaking", limits.symmetry_breaking),
        ("P1-sigma", limits.codimension_two.detuning),
        ("P1-gamma", limits.codimension_two.forcing_over_clearance),
    ];
    found.extend(values.map(|(name, value)| (name.to_owned(), value)));
    if let Some(node) = limits.saddle_node {
        found.insert("node".to_owned(), node.forcing_over_clearance);
        found.insert("node-B".to_owned(), node.absorber_amplitude);
    }
    Ok((found, doubts))
}

/// Detunings to both sides of resonance, the lowest frequency ratio, and factors of the forcing.
const DETUNING: f64 = 3.0;
const LOWEST: f64 = 1e-3;
const AMPLITUDES: [f64; 2] = [0.2, 3.0];

fn band(system: &System) -> LayerAnswer {
    let width = DETUNING * system.mass_ratio();
    let frequencies = [-width, width].map(|by| (1.0 + by).max(LOWEST));
    let of = |over, range| z3_share(&Band { base: *system, over, range, spectrum: Vec::new() });
    let values = [
        ("z3-frequency", of(BandOver::Frequency, frequencies)),
        ("z3-amplitude", of(BandOver::Amplitude, AMPLITUDES)),
    ];
    (values.map(|(name, value)| (name.to_owned(), value)).into(), Vec::new())
}

fn decay(system: &System) -> LayerAnswer {
    let decay = FreeDecay::of(system);
    let end = decay.residual_amplitude();
    let mut found = BTreeMap::from([("residual".to_owned(), end)]);
    found.extend(decay.time(DECAY_FROM, end).map(|time| ("time".to_owned(), time)));
    let shares = decay.shares(DECAY_FROM, end);
    found.extend(shares.map(|shares| ("impacts-share".to_owned(), shares.impacts)));
    (found, Vec::new())
}

fn orbits(system: &System) -> Result<LayerAnswer, String> {
    let orbits = symmetric_orbits(system).map_err(|error| error.to_string())?;
    let (mut found, mut doubts) = (BTreeMap::new(), Vec::new());
    for (k, one) in (1..).zip(&orbits) {
        let values = [
            ("beta", one.absorber_amplitude),
            ("speed", one.impact_speed),
            ("radius", one.orbit.multipliers.spectral_radius()),
        ];
        found.extend(values.map(|(name, value)| (format!("{name}{k}"), value)));
        doubts.extend(doubt(&format!("orbit {k}"), one.orbit.convergence.residual));
    }
    Ok((found, doubts))
}

fn limits(system: &System) -> Result<LayerAnswer, String> {
    let family = SymmetricFamily::of(system).map_err(|error| error.to_string())?;
    let mut found = BTreeMap::new();
    let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
    for limit in &family.limits {
        let name = match limit.kind {
            Bifurcation::SaddleNode => "node",
            Bifurcation::SymmetryBreaking => "breaking",
            Bifurcation::NeimarkSacker => "torus",
            Bifurcation::Grazing => "grazing",
            Bifurcation::Sticking => "sticking",
            _ => "other",
        };
        let count = counts.entry(name).or_default();
        *count += 1;
        found.insert(format!("{name}{count}"), limit.forcing_over_clearance);
    }
    for (k, stretch) in family.stable.iter().enumerate() {
        // Clearances are over the system's own: the larger one has the smaller forcing over it.
        let mut ends = stretch.clearance.map(|factor| system.forcing_per_clearance() / factor);
        ends.sort_by(f64::total_cmp);
        let number = |end: usize| format!("end{}", 2 * k + end + 1);
        found.extend([0, 1].map(|end| (number(end), ends[end])));
    }
    Ok((found, Vec::new()))
}

fn damper(system: &System) -> LayerAnswer {
    let band = Band { base: *system, over: BandOver::Frequency, range: BAND, spectrum: Vec::new() };
    let damper = TunedMassDamper::den_hartog(system.mass_ratio());
    let values = [("bare", bare_along(&band).1), ("damped", damper.along(&band).amplitude)];
    (values.map(|(name, value)| (name.to_owned(), value)).into(), Vec::new())
}

/// The state in which a structure is let go, its impacts that are compared, of which an almost plastic one is the last that
/// a reference without sustained contact knows, and the fast time in which they happen: rounding adds up beyond.
const LET_GO: State = State { x: 1.5, x_velocity: 0.0, y: 1.25, y_velocity: 0.0 };
const IMPACTS: usize = 4;
const PLASTIC: f64 = 0.01;
const WITHIN: f64 = 600.0;

fn release(system: &System) -> Result<LayerAnswer, String> {
    let most = if system.restitution() < PLASTIC { 1 } else { IMPACTS };
    let unforced = System::new(Parameters {
        forcing_per_clearance: 0.0,
        frequency_ratio: 1.0,
        ..system.parameters()
    });
    let unforced = unforced.map_err(|error| error.to_string())?;
    let mut simulation =
        Simulation::new(&unforced, LET_GO, 0.0).map_err(|error| error.to_string())?;
    let mut log = ImpactLog::default();
    let periods = libm::ceil(WITHIN / TAU) as u64;
    while log.impacts.len() < most && simulation.periods() < periods {
        simulation.run(periods, 1, &mut log);
    }
    let within = log.impacts.iter().take_while(|impact| impact.tau <= WITHIN);
    let values = (1..).zip(within).take(most).flat_map(|(k, impact)| {
        let speed = (impact.x_velocity_before - impact.y_velocity_before).abs();
        [(format!("time{k}"), impact.tau), (format!("speed{k}"), speed)]
    });
    Ok((values.collect(), Vec::new()))
}

/// From 0.7 to 1.3, at the beginning by 4.9 % a period.
const SWEEP: SineSweep =
    SineSweep { from: 0.7, to: 1.3, rate: SweepRate::Linear(0.0038), turn: TAU };

fn sweep(system: &System) -> Result<LayerAnswer, String> {
    // A cavity that nobody reaches the end of.
    let wide = 10.0 * swept(system, None, &Scales::REDUCED, &SWEEP, false).peak()[1].max(1.0);
    let in_wide = system.with_clearance_scaled(wide).map_err(|error| error.to_string())?;
    let flown = Passage::follow(&in_wide, &Scales::REDUCED, &SWEEP, State::AT_REST);
    let flown = flown.map_err(|error| error.to_string())?;
    let alone = swept(system, None, &Scales::REDUCED, &SWEEP, false).peak()[1];
    let values = [("alone", alone), ("flown", wide * flown.peak()[1])];
    Ok((values.map(|(name, value)| (name.to_owned(), value)).into(), Vec::new()))
}

/// A force over time, so small that the absorber in the middle of its cavity is not reached.
const LINES: [[f64; 2]; 6] =
    [[0.0, 0.0], [1.0, 0.2], [3.0, -0.3], [4.0, 0.1], [9.0, 0.1], [12.0, 0.0]];

fn record(system: &System) -> Result<LayerAnswer, String> {
    let record =
        Record { quantity: RecordQuantity::Force, samples: LINES.into(), base_velocity: 0.0 };
    let pieces = record.pieces(&Scales::REDUCED, Record::LONGEST);
    let flown = follow(system, &pieces, 0.0).map_err(|error| error.to_string())?;
    let values = [("alone", driven(system, None, &pieces, false).peak), ("flown", flown.peak)];
    Ok((values.map(|(name, value)| (name.to_owned(), value)).into(), Vec::new()))
}
