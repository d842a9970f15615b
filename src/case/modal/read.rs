//! Reads the tables of a case of several modes and absorbers.

use std::ops::Range;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::asked::{ModalCriteriaTable, ModalOptimizeTable, read_bounds, read_contact_times};
use super::file::{ModesTable, modes_of_file};
use super::load::{LoadTable, read_load};
use super::mode::{ModeTable, read_mode, read_modes};
use super::of_one::{BandOfSeveral, THE_PLACE, band_of, read_oscillator, refuse_both};
use super::place::{check_names, find_place};
use super::reduced::{
    ModalReducedTable, ReducedAbsorberTable, ReducedModeTable, read_reduced_load, read_reduced_mode,
};
use super::sweep::{ModalSweepTable, read_sweep};
use super::table::ModesFile;
use super::warnings::Spans;
use super::{AbsorberKey, ActsOn, Load, ModalCase, PlacedAbsorber, StructuralMode};
use crate::case::criteria::UPTO;
use crate::case::error::CaseError;
use crate::case::limits::{Asked, read_limits};
use crate::case::physical::OscillatorTable;
use crate::case::reader::{Reader, Table, fields, kind};
use crate::case::settings::{
    AccuracySettings, AlternativesSettings, PageUnits, SimulationSettings,
};
use crate::case::uncertainty::{UncertaintyOfSeveral, read_of_several};
use crate::case::{Heading, refuse_units};
use crate::excitation::Scene;
use crate::system::MOST_MODES;

/// An absorber of the structure.
#[derive(Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(super) struct ModalAbsorberTable {
    /// Where it is: a place of the shapes. May be left out where they have one.
    #[schemars(example = &"tip")]
    place: Option<String>,
    /// m_j, its mass, above 0.
    #[schemars(extend("x-measurand" = "a mass", "exclusiveMinimum" = 0), example = "3 kg")]
    mass: f64,
    /// b_j, the free distance from the middle to either wall, above 0.
    #[schemars(extend("x-measurand" = "a length", "exclusiveMinimum" = 0), example = "2.7 mm")]
    clearance: f64,
    /// r_j, the coefficient of restitution, from 0 to 1.
    #[schemars(range(min = 0, max = 1), example = 0.3)]
    restitution: f64,
    /// How long an impact takes, as a half-sine: `acceleration` of the criteria then has it. Of all absorbers or of none.
    #[schemars(extend("x-measurand" = "a time", "exclusiveMinimum" = 0), example = "0.5 ms")]
    contact_time: Option<f64>,
}

/// A design of several modes or absorbers: the tables mode or modes, absorber and excitation.
#[derive(JsonSchema)]
#[expect(
    dead_code,
    reason = "each table is read by itself, so that one that is wrong hides no other"
)]
#[schemars(
    title = "vinesink case of several modes or absorbers",
    deny_unknown_fields,
    extend("oneOf" = forms())
)]
pub(in crate::case) struct ModalFile {
    #[schemars(flatten)]
    heading: Heading,
    #[schemars(flatten)]
    tables: ModalTables,
}

/// A table, or a list of such tables.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "tables are read one by one")]
enum OneOrMore<T> {
    One(T),
    More(Vec<T>),
}

/// What the report is in. The table may be left out.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[serde(default)]
struct ReportOfSeveral {
    /// Units of the case's pages, figures and text for a terminal: SI unless given. Files for programs, the index and
    /// `diff` are in SI; not beside `[reduced]`.
    units: PageUnits,
}

/// Tables of such a file.
#[derive(Deserialize, JsonSchema)]
#[expect(
    dead_code,
    reason = "each table is read by itself, so that one that is wrong hides no other"
)]
struct ModalTables {
    oscillator: Option<OscillatorTable>,
    mode: Option<OneOrMore<ModeTable>>,
    modes: Option<ModesTable>,
    reduced: Option<ModalReducedTable>,
    absorber: Option<OneOrMore<ModalAbsorberTable>>,
    excitation: Option<OneOrMore<LoadTable>>,
    band: Option<BandOfSeveral>,
    simulation: Option<SimulationSettings>,
    criteria: Option<ModalCriteriaTable>,
    optimize: Option<ModalOptimizeTable>,
    alternatives: Option<AlternativesSettings>,
    accuracy: Option<AccuracySettings>,
    report: Option<ReportOfSeveral>,
    uncertainty: Option<UncertaintyOfSeveral>,
    sweep: Option<ModalSweepTable>,
}

/// The forms of a structure, by the tables that each needs.
fn forms() -> Value {
    let physical = |modes: &str| json!({ "required": [modes, "absorber", "excitation"] });
    json!([physical("oscillator"), physical("mode"), physical("modes"), { "required": ["reduced"] }])
}

/// Starts at each frequency of a range unless given, and under a load of one frequency, as with one mode: no neighbour then finds what
/// one start in ten leads to.
const STARTS: u32 = 6;
const STARTS_AT_ONE: u32 = 32;

/// Reads the whole file; `None` when something was reported.
///
/// # Errors
/// What is wrong with the file of its modes.
pub(super) fn read(
    reader: &mut Reader,
    document: &DeTable,
    text_hash: String,
    file: Option<&ModesFile>,
) -> Result<Option<(ModalCase, Spans)>, CaseError> {
    let own = fields::<ModalTables>();
    let of_one: Vec<&str> = fields::<crate::case::Tables>()
        .iter()
        .copied()
        .filter(|name| !own.contains(name))
        .collect();
    let root = reader.root_of::<Heading>(document, &[own, &of_one].concat());
    refuse_both(reader, &root);
    for name in of_one.into_iter().filter(|name| root.has(name)) {
        let help = "remove the table: it is about a structure with one mode";
        let message = format!("[{name}] has no meaning beside [[mode]] or [[absorber]]");
        let expected = format!("expected the tables {}", own.join(", "));
        reader.report(root.span_of(name), message, expected, help);
    }
    // Bounds are written as the numbers of a force's case; a sweep decides for itself.
    reader.of_several = Some(false);
    let heading = reader.read::<Heading>(&root);
    let mut spans = Spans::default();
    let reduced = reader.table::<ModalReducedTable>(&root, "reduced");
    if reduced.is_some() {
        reader.plain = true;
        for name in ["mode", "modes", "absorber", "excitation"] {
            if root.has(name) {
                let message = format!("[{name}] has no meaning beside [reduced]");
                let help = match name {
                    "excitation" => {
                        "write `forcing` in each [[reduced.mode]], and `frequency_ratio` in [reduced]"
                    }
                    "absorber" => "write [[reduced.absorber]], or the whole case without [reduced]",
                    _ => "write [[reduced.mode]], or the whole case without [reduced]",
                };
                let expected = "expected one form of the structure";
                reader.report(root.span_of(name), message, expected, help);
                return Ok(None);
            }
        }
    }
    let mut modes_from = None;
    let (places, mut modes) = match (&reduced, root.has("modes")) {
        (Some(table), _) => {
            let tables = tables::<ReducedModeTable>(reader, table, "mode");
            read_modes(reader, tables, read_reduced_mode, &mut spans.damping)
        }
        (None, true) => {
            let (read, told) = modes_of_file(reader, &root, file)?;
            spans.damping =
                damping_of_file(&root).map_or(Vec::new(), |span| vec![span; read.1.len()]);
            modes_from = Some(told);
            read
        }
        (None, false) if root.has("oscillator") && !root.has("mode") => {
            let (table, mode) = read_oscillator(reader, &root).unzip();
            spans.damping.extend(table);
            let places = mode.iter().map(|_| THE_PLACE.to_owned()).collect();
            (places, mode.into_iter().collect())
        }
        (None, false) => {
            let tables = tables::<ModeTable>(reader, &root, "mode");
            read_modes(reader, tables, read_mode, &mut spans.damping)
        }
    };
    check_names(reader, &root, &places);
    let (mut absorbers, mut values) = (Vec::new(), Vec::new());
    let listed = match &reduced {
        Some(table) => tables::<ReducedAbsorberTable>(reader, table, "absorber"),
        None => tables::<ModalAbsorberTable>(reader, &root, "absorber"),
    };
    // Those that are wrong count: their own errors are told.
    let tables_of_absorbers = listed.len().max(1);
    for table in listed {
        let Some(read) = reader.read::<ModalAbsorberTable>(&table) else { continue };
        if read.place.is_none() && table.has("place") {
            // What is no name was told.
            continue;
        }
        let place =
            find_place(reader, table.span_of_value("place"), read.place.as_deref(), &places);
        if let Some(place) = place
            && modes.iter().all(|mode| mode.shape[place] == 0.0)
        {
            let message = "the absorber is at a node of every mode, where nothing moves it";
            let expected = "expected a place at which a mode has a shape other than 0";
            reader.report(table.span_of("place"), message, expected, "name another place");
        }
        values.push(
            AbsorberKey::ALL
                .map(|key| table.has(key.name()).then(|| table.span_of_value(key.name()))),
        );
        absorbers.extend(place.map(|place| PlacedAbsorber {
            place,
            mass_kg: read.mass,
            clearance_m: read.clearance,
            restitution: read.restitution,
            contact_time_s: read.contact_time,
        }));
    }
    // Those that are wrong count: their own errors are told.
    let tables_of_modes = match root.value("mode").map(Spanned::get_ref) {
        Some(DeValue::Array(all)) => all.len(),
        _ => modes.len(),
    };
    let count = tables_of_modes.max(modes.len());
    let mut loads = Vec::new();
    let listed = match &reduced {
        Some(table) => {
            loads.extend(read_reduced_load(reader, table, &mut modes));
            Vec::new()
        }
        None => tables::<LoadTable>(reader, &root, "excitation"),
    };
    for table in listed {
        let keys = ["frequency", "from", "to"].into_iter().filter(|key| table.has(key));
        let written = keys.map(|key| table.span_of_value(key)).collect();
        if let Some(load) = read_load(reader, &table, &places, &modes, count) {
            loads.push(load);
            spans.frequencies.push(written);
        }
    }
    if let Some((table, band)) = reader.optional::<BandOfSeveral>(&root, "band")
        && let Some(range_hz) = band_of(reader, &table, &band, &loads)
    {
        loads.iter_mut().for_each(|load| load.range_hz = range_hz);
        let written = ["from", "to"].map(|key| table.span_of_value(key)).to_vec();
        spans.frequencies.iter_mut().for_each(|one| one.clone_from(&written));
    }
    let lists_loads = root.value("excitation").is_some_and(|one| one.get_ref().is_array());
    let simulation = reader.settings::<SimulationSettings>(&root, "simulation");
    if simulation.as_ref().is_some_and(|one| one.discard.is_some()) {
        reader.report(
            root.span_of("simulation"),
            "`discard` has no meaning with several modes",
            "expected `starts` and `periods` alone",
            "leave it out: every start is flown until its slowest mode has died out",
        );
    }
    let of_structure = Asked {
        scene: Scene::Steady,
        has_areas: false,
        is_physical: reduced.is_none(),
        places: &places,
        absorbers: tables_of_absorbers,
    };
    let asked = reader.optional::<ModalCriteriaTable>(&root, "criteria");
    let (criteria, upto) = match &asked {
        Some((table, read)) => (
            read_limits(reader, table, &of_structure),
            read.acceleration_upto.map(|upto| (table.span_of(UPTO), upto)),
        ),
        None => (Vec::new(), None),
    };
    if let (Some((span, _)), true) = (&upto, reduced.is_some()) {
        let message = format!("`{UPTO}` has no meaning beside [reduced]");
        let help = "write the case with units, where a sensor reads up to so many hertz";
        reader.report(span.clone(), message, "expected limits alone", help);
    }
    let contact_is_sensors = upto.is_some();
    let count_inactive = asked.as_ref().and_then(|(_, read)| read.count_inactive).unwrap_or(true);
    read_contact_times(reader, &root, upto, &criteria, &modes, &mut absorbers);
    let bounds = read_bounds(reader, &root, &places);
    let alternatives = reader.settings::<AlternativesSettings>(&root, "alternatives");
    let accuracy = reader.optional::<AccuracySettings>(&root, "accuracy").map(|(table, read)| {
        if table.has("coexistence") {
            reader.report(
                table.span_of("coexistence"),
                "`coexistence` has no meaning with several modes",
                "expected `amplitude` and `impacts_per_period` alone",
                "leave it out: other motions are always looked for",
            );
        }
        read
    });
    let report = reader.optional::<ReportOfSeveral>(&root, "report").map(|(table, read)| {
        refuse_units(reader, &table, read.units, reduced.is_none());
        read.units
    });
    let moves_base: Vec<bool> = loads.iter().map(|load: &Load| load.on == ActsOn::Base).collect();
    let uncertainty = read_of_several(reader, &root, reduced.is_some(), &moves_base);
    if uncertainty.damping_ratio.is_some()
        && modes.first().is_some_and(|one| one.damping_ratio == 0.0)
    {
        reader.report(
            root.span_of("uncertainty"),
            "the damping ratio of an undamped first mode is uncertain",
            "expected a mode with a damping ratio above 0, to which those of the others are in proportion",
            "give the first mode a damping ratio, or remove the line `damping_ratio`",
        );
    }
    let Some(heading) = heading.filter(|_| reader.problems.is_empty()) else { return Ok(None) };
    let asked = simulation.as_ref();
    let given = asked.and_then(|one| u32::try_from(one.starts?).ok());
    let [starts, starts_at_one] = [STARTS, STARTS_AT_ONE].map(|usual| given.unwrap_or(usual));
    let periods = asked.and_then(|one| one.periods).unwrap_or(0);
    let mut case = ModalCase {
        title: heading.title,
        source: heading.source,
        text_hash,
        reduced: reduced.is_some(),
        places,
        modes,
        absorbers,
        loads,
        lists_loads,
        count_inactive,
        criteria,
        starts,
        starts_at_one,
        periods,
        modes_file: None,
        modes_from,
        contact_is_sensors,
        bounds,
        page_units: report.unwrap_or_default(),
        alternatives: alternatives.unwrap_or_default(),
        accuracy,
        uncertainty,
        sweep: None,
        warnings: Vec::new(),
        text: Arc::default(),
        values,
    };
    for load in &case.loads {
        for frequency in load.range_hz {
            if let Err(error) = case.system(load, frequency) {
                let own = |mode: &StructuralMode| {
                    mode.damping_ratio == 0.0 && mode.frequency_hz == frequency
                };
                let help = match case.modes.iter().position(own) {
                    Some(k) => format!(
                        "give mode {} a damping ratio, or the load another frequency: at that of an undamped mode nothing limits the structure",
                        k + 1
                    ),
                    None => "check the values and their units".to_owned(),
                };
                reader.report(
                    root.span_of("excitation"),
                    error.to_string(),
                    "expected values that fit one another",
                    &help,
                );
                return Ok(None);
            }
        }
    }
    case.sweep = read_sweep(reader, &root, &case);
    Ok(Some((case, spans)))
}

/// Where the table `[modes]` says the damping ratio of all modes, or else names their file.
fn damping_of_file(root: &Table) -> Option<Range<usize>> {
    let table = root.value("modes")?.get_ref().as_table()?;
    ["damping_ratio", "file"].into_iter().find_map(|key| Some(table.get(key)?.span()))
}

/// The tables of a name, once or as a list; reported where there is none, or more than a structure may have.
fn tables<'d, T: serde::de::DeserializeOwned + JsonSchema>(
    reader: &mut Reader,
    root: &Table<'d>,
    name: &'static str,
) -> Vec<Table<'d>> {
    let path = if root.path.is_empty() { name.to_owned() } else { format!("{}.{name}", root.path) };
    // Of a name that is misspelled that was told; beside [oscillator] it is missing no table of modes.
    let is_told = root.has(name) || name == "mode" && root.has("oscillator");
    let Some(value) = root.value(name) else {
        if is_told {
            return Vec::new();
        }
        let message = format!("[[{path}]] is missing");
        let expected = format!("expected at least one table [[{path}]]");
        let help = format!("write [[{path}]] on a line of its own and its keys below it");
        reader.report(0..reader.first_line(), message, expected, help);
        return Vec::new();
    };
    let found: Vec<(Range<usize>, &'d DeTable<'d>)> = match value.get_ref() {
        DeValue::Table(one) => vec![(root.span_of(name), one)],
        DeValue::Array(all) => all
            .iter()
            .filter_map(|one| match one.get_ref() {
                DeValue::Table(table) => Some((one.span(), table)),
                _ => None,
            })
            .collect(),
        _ => Vec::new(),
    };
    if found.is_empty() || found.len() > MOST_MODES {
        let message = match found.len() {
            0 => format!("`{name}` is {}, but it must be a table", kind(value.get_ref())),
            many => format!("there are {many} of [[{path}]]"),
        };
        let expected = format!("expected 1 to {MOST_MODES} tables [[{path}]]");
        let help = "keep those that matter most; more are not computed";
        reader.report(root.span_of(name), message, expected, help);
        return Vec::new();
    }
    found.into_iter().map(|(span, entries)| reader.listed::<T>(&path, span, entries)).collect()
}
