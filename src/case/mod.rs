//! The case file: what a person writes about a design, proven valid, and the dimensionless
//! system that follows from it.
//!
//! A case is TOML. It gives a design either in physical units (`[oscillator]`, `[absorber]`,
//! `[excitation]`) or dimensionless (`[reduced]`), and may carry settings in optional tables. To
//! add an optional table: a struct as in `settings.rs`, and a field in [`Case`] and in `CaseFile`. The struct
//! of a table is what it is read into and what its schema is derived from.
// Descriptions of keys go into the schema as they are: [reduced] is a table of the case file, not an item.
#![allow(rustdoc::broken_intra_doc_links)]

mod band;
mod comment;
mod criteria;
mod design;
mod dimensionless;
mod document;
mod error;
mod excitation;
mod inputs;
mod limits;
mod modal;
mod number;
mod number_table;
mod one;
mod optimize;
mod parameter;
mod peer;
mod physical;
mod quantity;
mod reader;
mod record;
mod record_faults;
mod record_file;
mod reduced;
mod restitution;
mod rewrite;
mod schema;
mod settings;
mod starting;
mod support;
mod sweep;
mod uncertainty;
mod value;
mod variant;
mod warnings;
mod written;

use std::sync::Arc;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};
use toml::de::DeTable;

pub use band::{BandOver, BandSettings};
pub(crate) use criteria::AREAS_ARE_IDEAL;
pub use criteria::{Criterion, Of, Relation};
pub use error::{CaseError, Problem};
pub use inputs::Input;
pub use modal::{
    ActsOn, Bounds, ListedMode, Load, ModalCase, ModalSweep, ModesFile, ModesListing,
    PlacedAbsorber, StartingModes, StructuralMode, is_modal, is_of_absorber, modes_file,
};
pub use optimize::{Objective, OptimizeSettings};
pub use physical::Physical;
pub use quantity::QuantityError;
pub use record::{ReadRecord, RecordSource, Recording};
pub use record_file::RecordFormat;
pub use reduced::Reduced;
pub use rewrite::{RewriteError, Rewritten, Rounding};
pub use schema::{FILE_NAME as SCHEMA_FILE_NAME, schema};
pub use settings::{
    AccuracySettings, AlternativesSettings, ExtraFigure, PageUnits, ReportSettings,
    SimulationSettings,
};
pub use starting::{StartingLine, excitation_kinds};
pub use support::{Orientation, Support, SupportKind};
pub use sweep::{Recorded, SweepAxis, SweepSettings};
pub use uncertainty::{Distribution, Uncertainty};
pub use value::nearest;

use crate::digest::text_sha256;
use crate::excitation::Scene;
use crate::motions::{BandEffort, Effort};
use crate::quantity::Units;
use crate::system::{Band, System};
use one::OneMode;
use reader::{Reader, Table};

/// A design case: what its file says, and the system that follows from it.
///
/// ```
/// use vinesink::case::Case;
///
/// let case = Case::parse("damper.toml", r#"
/// title = "Damper at 8 Hz"
/// source = "Li, Seguy, Berlioz 2016, Table 1"
///
/// [oscillator]
/// mass = "4.168 kg"
/// stiffness = "11.47 kN/m"
/// damping = "3.02 N s/m"
///
/// [absorber]
/// mass = "32 g"
/// clearance = "7.5 mm"
/// restitution = 0.6
///
/// [excitation]
/// kind = "base-displacement"
/// amplitude = "0.25 mm"
/// frequency = "8 Hz"
/// "#)?;
/// assert!((case.system().mass_ratio() - 0.032 / 4.168).abs() < 1e-15);
/// // Results are over the clearance; the case's units make metres of them.
/// assert!((case.units().length(0.475) - 3.5625e-3).abs() < 1e-12);
/// // What is wrong is said all at once, with the line.
/// assert!(Case::parse("damper.toml", "title = 7").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// What the case is, in a line.
    pub title: String,
    /// Where its numbers come from.
    pub source: String,
    /// SHA-256 of the file's text with line ends of one kind, in hexadecimal.
    pub text_hash: String,
    /// The design.
    pub design: Design,
    /// What drives it, where that is a record or noise.
    pub recording: Option<Recording>,
    /// The table `[simulation]`.
    pub simulation: SimulationSettings,
    /// The table `[report]`.
    pub report: ReportSettings,
    /// The table `[accuracy]`, if there is one.
    pub accuracy: Option<AccuracySettings>,
    /// The table `[alternatives]`; its defaults where there is none.
    pub alternatives: AlternativesSettings,
    /// The table `[band]`, if there is one.
    pub band: Option<BandSettings>,
    /// The table `[criteria]`, in the order of a report; empty where there is none.
    pub criteria: Vec<Criterion>,
    /// Whether the motion of an absorber that never wakes counts (`count_inactive` in `[criteria]`).
    pub count_inactive: bool,
    /// Share of its first amplitude at which a released structure counts as come to rest (`decay_level` in
    /// `[criteria]`).
    pub decay_level: f64,
    /// The table `[optimize]`; its defaults where there is none.
    pub optimize: OptimizeSettings,
    /// The table `[uncertainty]`; nothing is uncertain where there is none.
    pub uncertainty: Uncertainty,
    /// The table `[sweep]`, if there is one.
    pub sweep: Option<SweepSettings>,
    /// The file's text, in which warnings stand.
    text: Arc<str>,
    inputs: Vec<Input>,
    warnings: Vec<Problem>,
    system: System,
    /// Whether its contact time is what a sensor sees of impacts, which take none.
    contact_is_sensors: bool,
}

/// A design in the units its author chose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Design {
    /// From `[oscillator]`, `[absorber]` and `[excitation]`.
    Physical(Physical),
    /// From `[reduced]`.
    Reduced(Reduced),
}

/// A design of a vibro-impact nonlinear energy sink: either the tables oscillator, absorber and
/// excitation, or the table reduced.
#[derive(JsonSchema)]
#[expect(
    dead_code,
    reason = "each table is read by itself, so that one that is wrong hides no other"
)]
#[schemars(title = "vinesink case", deny_unknown_fields, extend("oneOf" = one_design()))]
struct CaseFile {
    #[schemars(flatten)]
    heading: Heading,
    #[schemars(flatten)]
    tables: Tables,
}

/// What stands before the first table.
#[derive(Deserialize, JsonSchema)]
struct Heading {
    /// What this case is, in a line.
    #[schemars(pattern(r"\S"), example = "what this case is, in a line")]
    title: String,
    /// Where the numbers come from: a publication, a measurement, a guess.
    #[schemars(pattern(r"\S"))]
    #[schemars(example = "where the numbers come from: a publication, a measurement, a guess")]
    source: String,
}

#[derive(Deserialize, JsonSchema)]
#[expect(
    dead_code,
    reason = "each table is read by itself, so that one that is wrong hides no other"
)]
struct Tables {
    oscillator: Option<physical::OscillatorTable>,
    absorber: Option<physical::AbsorberTable>,
    excitation: Option<excitation::ExcitationTable>,
    reduced: Option<reduced::ReducedTable>,
    simulation: Option<SimulationSettings>,
    report: Option<ReportSettings>,
    accuracy: Option<AccuracySettings>,
    alternatives: Option<AlternativesSettings>,
    band: Option<band::BandTable>,
    criteria: Option<criteria::CriteriaTable>,
    optimize: Option<OptimizeSettings>,
    uncertainty: Option<Uncertainty>,
    sweep: Option<sweep::SweepTable>,
}

fn one_design() -> Value {
    let any_physical = physical::TABLES.map(|table| json!({ "required": [table] }));
    json!([
        { "required": physical::TABLES, "not": { "required": [reduced::TABLE] } },
        { "required": [reduced::TABLE], "not": { "anyOf": any_physical } },
    ])
}

/// Tables that are about steady vibration alone.
const STEADY_TABLES: [&str; 2] = ["accuracy", "band"];
/// What `[report]` says of every scene.
const OF_ANY_SCENE: &str = "units";

impl Case {
    /// Reads a case from its text; `name`, usually the file's path, is for messages only.
    ///
    /// # Errors
    /// [`CaseError`] with everything that is wrong: TOML that does not parse, unknown or missing
    /// keys and tables, units that are missing or do not fit, values out of their range.
    pub fn parse(name: &str, text: &str) -> Result<Self, CaseError> {
        // A byte order mark is no part of the text that errors count columns in.
        let visible = text.strip_prefix('\u{feff}').unwrap_or(text);
        let refused = |problems, more| CaseError::new(name, visible, problems, more);
        let document = document::parse(visible).map_err(|problems| refused(problems, 0))?;
        let mut reader = Reader::of(visible);
        let lists = OneMode::of(&document);
        reader.shape = lists.as_ref().map_or(1.0, |one| one.shape);
        let document = lists.as_ref().map_or(&document, |one| &one.document);
        match read(&mut reader, document, text_sha256(text)) {
            Some(mut case) if reader.problems.is_empty() => {
                case.text = Arc::from(visible);
                case.warnings = warnings::of(&case);
                Ok(case)
            }
            _ => {
                let is_mode = lists.as_ref().is_some_and(|one| one.is_mode);
                let told = |problem| if is_mode { one::of_lists(problem) } else { problem };
                Err(refused(reader.problems.into_iter().map(told).collect(), reader.more))
            }
        }
    }

    /// Whether a criterion is of velocity or acceleration of the structure.
    pub fn asks_for_shaking(&self) -> bool {
        self.criteria.iter().any(|one| one.measure.is_of_shaking())
    }

    /// How thoroughly its motions are searched: the same for every command.
    pub fn effort(&self) -> Effort {
        let SimulationSettings { periods, discard, starts } = self.simulation;
        let usual = Effort::default();
        let tolerance = self.accuracy.and_then(|asked| asked.amplitude);
        let tolerance = tolerance.unwrap_or(usual.band.tolerance);
        Effort {
            starts: starts.and_then(|starts| u32::try_from(starts).ok()).unwrap_or(usual.starts),
            discard,
            periods: periods.unwrap_or(usual.periods),
            accuracy: self.accuracy.map(|asked| [asked.amplitude(), asked.impacts_per_period()]),
            band: BandEffort { tolerance, ..usual.band },
            shaking: self.asks_for_shaking(),
            ..usual
        }
    }

    /// The range that it is asked about: its band, or its own excitation alone.
    pub fn range(&self) -> Band {
        let system = self.system();
        self.band.as_ref().map_or_else(|| Band::point(&system), |band| band.around(&system))
    }

    /// What is valid and almost surely a slip, such as kHz for Hz: each where it stands in the text after
    /// a byte order mark, with what was probably meant as its help; in the order of lines.
    pub fn warnings(&self) -> &[Problem] {
        &self.warnings
    }

    /// The dimensionless system.
    pub fn system(&self) -> System {
        self.system
    }

    /// What turns the system's results back into the case's units.
    pub fn units(&self) -> Units {
        self.report.units.of_pages(self.design.units(), &self.criteria)
    }

    /// How long an impact takes in s, or a sensor sees it, where its pulse is asked for.
    pub fn contact_time(&self) -> Option<f64> {
        let Design::Physical(of) = &self.design else { return None };
        of.contact_time_s
    }

    /// How long an impact takes in s, where the absorber's own contact time says so and not what a sensor sees of it.
    pub fn impacts_take(&self) -> Option<f64> {
        self.contact_time().filter(|_| !self.contact_is_sensors)
    }

    /// Places of the absorber from which a case that is not driven steadily is flown; none for one that is.
    pub fn absorber_places(&self) -> Option<u64> {
        let records = self.recording.as_ref().map_or(1, Recording::count);
        let usual = self.design.transient()?.places(records);
        Some(self.simulation.starts.unwrap_or(usual.into()))
    }
}

fn read(reader: &mut Reader, document: &DeTable, text_hash: String) -> Option<Case> {
    if document.is_empty() {
        let help =
            "write a title, a source and a design; `vinesink new NAME` writes a case to start from";
        reader.report(
            0..0,
            "the file describes no case",
            "expected a title, a source and a design",
            help,
        );
        return None;
    }
    if let Some(key) = modal::tells_several(document) {
        let message =
            "the case is of several modes or absorbers, of which this command knows nothing";
        let expected = "expected [oscillator], [absorber] and [excitation], or [reduced]";
        let help = "`vinesink check`, `report`, `simulate`, `analyze`, `optimize` and `sweep` read it, and `Case.from_toml` in Python";
        reader.report(key, message, expected, help);
        return None;
    }
    let root = reader.root::<Heading, Tables>(document);
    let heading = reader.read::<Heading>(&root);
    let design = read_design(reader, &root);
    reader.design = design;
    let scene = design.map_or(Scene::Steady, |design| design.scene());
    refuse_steady(reader, &root, scene);
    let simulation = reader.settings::<SimulationSettings>(&root, "simulation");
    let report = reader.optional::<ReportSettings>(&root, "report").map(|(table, read)| {
        let is_physical = design.is_none_or(|design| design.is_physical());
        refuse_units(reader, &table, read.units, is_physical);
        read
    });
    let accuracy = reader.settings::<AccuracySettings>(&root, "accuracy");
    let alternatives = reader.settings::<AlternativesSettings>(&root, "alternatives");
    let band = band::read(reader, &root);
    let criteria = criteria::read(reader, &root);
    let optimize = optimize::read(reader, &root);
    let uncertainty = uncertainty::read(reader, &root);
    let starts = simulation.as_ref().and_then(|settings| settings.starts);
    let sweep = sweep::read(reader, &root, starts);
    let (heading, mut design) = (heading?, design?);
    let contact_is_sensors = criteria.contact_time.is_some();
    if let (Design::Physical(of), Some(time)) = (&mut design, criteria.contact_time) {
        of.contact_time_s = Some(time);
    }
    let system = system_of(reader, &root, &design)?;
    Some(Case {
        title: heading.title,
        source: heading.source,
        text_hash,
        design,
        recording: reader.recording.take(),
        simulation: simulation.unwrap_or_default(),
        report: report.unwrap_or_default(),
        accuracy,
        alternatives: alternatives.unwrap_or_default(),
        band,
        criteria: criteria.all,
        count_inactive: criteria.count_inactive,
        decay_level: criteria.decay_level,
        optimize,
        uncertainty,
        sweep,
        text: Arc::default(),
        inputs: std::mem::take(&mut reader.inputs),
        warnings: Vec::new(),
        system,
        contact_is_sensors,
    })
}

/// Reports what a case says of steady vibration where its structure is not driven steadily.
fn refuse_steady(reader: &mut Reader, root: &Table, scene: Scene) {
    if scene == Scene::Steady {
        return;
    }
    for name in STEADY_TABLES.iter().filter(|name| root.has(name)) {
        let message = format!("[{name}] has no meaning for a structure that is {}", scene.words());
        let expected = "expected tables that are about what it does then";
        let help = "remove the table: it is about steady vibration";
        reader.report(root.span_of(name), message, expected, help);
    }
    for (name, kept) in [("report", OF_ANY_SCENE), ("simulation", "starts")] {
        let table = root.value(name).and_then(|table| table.get_ref().as_table());
        let others = table.into_iter().flatten().filter(|(key, _)| key.get_ref() != kept);
        for (key, value) in others {
            let key = key.get_ref();
            let message =
                format!("`{key}` has no meaning for a structure that is {}", scene.words());
            let expected = format!("expected `{kept}` alone");
            let help = "remove the line: it is about steady vibration";
            reader.report(value.span(), message, expected, help);
        }
    }
}

/// Reports units of pages beside `[reduced]`, where there is nothing to choose.
fn refuse_units(reader: &mut Reader, report: &Table, units: PageUnits, is_physical: bool) {
    if units == PageUnits::Us && !is_physical {
        let message = "`units` has no meaning beside [reduced], whose pages are in its own units";
        let help = "remove the line, or write the design in physical units";
        reader.report(report.span_of("units"), message, "expected no units of pages", help);
    }
}

fn read_design(reader: &mut Reader, root: &Table) -> Option<Design> {
    let physical = physical::TABLES.into_iter().find(|table| root.has(table));
    match (physical, root.has(reduced::TABLE)) {
        (Some(_), false) => physical::read(reader, root).map(Design::Physical),
        (None, true) => reduced::read(reader, root).map(Design::Reduced),
        (Some(table), true) => {
            let message = format!("[reduced] and [{table}] both describe the design");
            let expected = "expected a design in one way only";
            let help = "keep [reduced], or keep [oscillator], [absorber] and [excitation]";
            reader.report(root.span_of(reduced::TABLE), message, expected, help);
            None
        }
        (None, false) => {
            let expected = "expected [oscillator], [absorber] and [excitation], or [reduced]";
            let help = "add the tables; `vinesink new NAME` writes a commented case to start from";
            reader.report(0..reader.first_line(), "the file describes no design", expected, help);
            None
        }
    }
}

/// The system of values each valid by itself, whose combination may still overflow.
fn system_of(reader: &mut Reader, root: &Table, design: &Design) -> Option<System> {
    let moves = |system: &System| system.linear_response().map_or(0.0, |one| one.amplitude());
    let (what, expected) = match design.system() {
        Ok(system) if moves(&system).is_finite() => return Some(system),
        Ok(_) => ("response that is not finite".to_owned(), "values that fit one another"),
        Err(error) => (format!("{} of {}", error.name, error.value), error.expected),
    };
    let message = format!("the values together give a {what}");
    let help = "check the units: one value is many orders of magnitude away from the others";
    reader.report(
        root.span_of(design.writing().tables[0]),
        message,
        format!("expected {expected}"),
        help,
    );
    None
}
