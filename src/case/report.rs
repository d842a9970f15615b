//! The optional table `[report]`: figures that a report holds beside the usual ones.

use schemars::JsonSchema;
use toml::Spanned;
use toml::de::{DeArray, DeValue};

use super::reader::Reader;
use super::suggest::nearest;
use super::table::{Table, kind};

/// What the case says about its report.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReportSettings {
    /// Further figures, each once, in the order of the file.
    pub figures: Vec<ExtraFigure>,
}

/// A figure that a report holds only where its case asks for it: the ones that take a family of
/// parameters, or a long look at one motion. Figures in brackets are those of Li, Seguy, Berlioz
/// 2016 that it repeats.
#[derive(Debug, Clone, Copy, PartialEq, Eq, JsonSchema)]
#[schemars(rename_all = "kebab-case")]
pub enum ExtraFigure {
    /// The areas along the manifold, and how the fixed points move as the clearance grows (Fig. 5).
    Areas,
    /// What the saddle-node and the Hopf boundary are, and where they lie (Figs. 6a and 6b).
    Bifurcations,
    /// Frequency responses for four forcings per clearance across the areas (Fig. 7).
    ForcingResponses,
    /// A long stretch of the motion on the manifold, enlarged in two places (Fig. 8).
    Modulation,
    /// The manifold, and what it takes from the oscillator, for five restitutions (Fig. 9).
    Restitutions,
    /// What simulation finds at many clearances, on the manifold and by its peak (Figs. 11g and 4).
    Clearances,
    /// The amplitudes C and E of (17) in every period, in captures and between them (section 4.2).
    Captures,
    /// Which starts lead to which long-term motion, on a plane of the oscillator's starting states.
    Basins,
    /// How the largest Lyapunov exponent of each motion converges.
    Exponents,
    /// Displacement, acceleration and every impact's strength over some seconds (Fig. 12).
    Transfer,
    /// Three short stretches of the same: decrease, weak impacts, few impacts (Figs. 12d to 12f).
    TransferStretches,
    /// The clearance swept up and down by simulation, with the exact orbits over it.
    DiagramClearance,
    /// The same for the excitation frequency.
    DiagramFrequency,
    /// The same for the excitation amplitude.
    DiagramForcing,
}

impl ExtraFigure {
    /// Every further figure.
    pub const ALL: [Self; 14] = [
        Self::Areas,
        Self::Bifurcations,
        Self::ForcingResponses,
        Self::Modulation,
        Self::Restitutions,
        Self::Clearances,
        Self::Captures,
        Self::Exponents,
        Self::Basins,
        Self::Transfer,
        Self::TransferStretches,
        Self::DiagramClearance,
        Self::DiagramFrequency,
        Self::DiagramForcing,
    ];

    /// The name in a case file, which is also the stem of the figure's file.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Areas => "areas",
            Self::Bifurcations => "bifurcations",
            Self::ForcingResponses => "forcing-responses",
            Self::Modulation => "modulation",
            Self::Restitutions => "restitutions",
            Self::Clearances => "clearances",
            Self::Captures => "captures",
            Self::Exponents => "exponents",
            Self::Basins => "basins",
            Self::Transfer => "transfer",
            Self::TransferStretches => "transfer-stretches",
            Self::DiagramClearance => "diagram-clearance",
            Self::DiagramFrequency => "diagram-frequency",
            Self::DiagramForcing => "diagram-forcing",
        }
    }

    fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|figure| figure.name() == name)
    }
}

pub(super) const TABLE: &str = "report";
pub(super) const KEYS: &[&str] = &["figures"];

const EXAMPLE: &str = "figures = [\"areas\", \"transfer\"]";

/// Reads the table, which may be missing.
pub(super) fn read(reader: &mut Reader, root: &Table) -> ReportSettings {
    let Some(table) = reader.table(root, TABLE) else { return ReportSettings::default() };
    let Some((_, value)) = table.entry("figures") else { return ReportSettings::default() };
    let DeValue::Array(list) = value.get_ref() else {
        let message = format!("`figures` is {}, but it is a list of names", kind(value.get_ref()));
        let expected = "expected names of figures in quotes, between brackets";
        reader.report(value.span(), message, expected, format!("write for example {EXAMPLE}"));
        return ReportSettings::default();
    };
    ReportSettings { figures: figures(reader, list) }
}

fn figures(reader: &mut Reader, list: &DeArray) -> Vec<ExtraFigure> {
    let mut figures = Vec::new();
    for item in list {
        let Some(figure) = figure(reader, item) else { continue };
        if figures.contains(&figure) {
            let message = format!("`figures` names \"{}\" twice", figure.name());
            reader.report(item.span(), message, "expected each figure once", "remove one of them");
        } else {
            figures.push(figure);
        }
    }
    figures
}

fn figure(reader: &mut Reader, item: &Spanned<DeValue>) -> Option<ExtraFigure> {
    let known = ExtraFigure::ALL.map(ExtraFigure::name);
    let expected = format!("expected one of {}", known.join(", "));
    let DeValue::String(name) = item.get_ref() else {
        let message =
            format!("`figures` holds {}, but it is a list of names", kind(item.get_ref()));
        reader.report(item.span(), message, expected, format!("write for example {EXAMPLE}"));
        return None;
    };
    let figure = ExtraFigure::of(name);
    if figure.is_none() {
        let help = match nearest(name, &known) {
            Some(guess) => format!("did you mean \"{guess}\"?"),
            None => {
                format!(
                    "remove \"{name}\"; the usual figures are in every report without being named"
                )
            }
        };
        reader.report(item.span(), format!("unknown figure \"{name}\""), expected, help);
    }
    figure
}

/// What the report holds beside the usual. The table may be left out.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
#[expect(dead_code, reason = "describes the table to editors; read() is what reads it")]
pub(super) struct ReportTable {
    /// Further figures, each once; the usual ones are in every report.
    #[schemars(extend("uniqueItems" = true), example = ["areas"])]
    figures: Option<Vec<ExtraFigure>>,
}
