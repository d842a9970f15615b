//! The page of `vinesink sweep`: what a grid of systems shows, as facts, figures, and the files of its folder.

mod axis;
mod facts;
mod figures;
mod grid;
mod kinds;

use serde_json::json;

use super::figure::Figure;
use super::modal;
use super::render::{Files, RenderError, page_files};
use super::template::worded;
use crate::case::{Case, ModalCase};
use crate::excitation::Scene;
use crate::quantity::Units;
use crate::sweep::columns::Column;
use crate::sweep::limits::StabilityLimit;

pub use super::figures::regimes::tint;
pub use axis::AxisShown;

/// A page shows at most so many points; of more, the table alone is the result.
pub const MOST_POINTS: usize = 1_000_000;

/// The case that a sweep belongs to.
#[derive(Debug, Clone, Copy)]
pub enum SweptCase<'a> {
    /// Of one mode and one absorber.
    One(&'a Case),
    /// Of several.
    Several(&'a ModalCase),
}

impl SweptCase<'_> {
    /// Its title, and the SHA-256 of its text.
    fn heading(&self) -> [&str; 2] {
        match self {
            Self::One(case) => [&case.title, &case.text_hash],
            Self::Several(case) => [&case.title, &case.text_hash],
        }
    }

    fn units(&self) -> Units {
        match self {
            Self::One(case) => case.units(),
            Self::Several(case) => modal::units(case),
        }
    }

    fn is_steady(&self) -> bool {
        match self {
            Self::One(case) => case.design.scene() == Scene::Steady,
            Self::Several(_) => true,
        }
    }
}

/// A sweep with its results.
#[derive(Debug, Clone)]
pub struct Swept<'a> {
    /// The case it belongs to.
    pub case: SweptCase<'a>,
    /// The axes; the last varies fastest.
    pub axes: Vec<AxisShown>,
    /// What is known, a value for each point in each column. Columns are found by their names, and any may be
    /// missing.
    pub columns: &'a [Column],
    /// Starts at each point.
    pub starts: u32,
    /// Excitation periods measured where a motion is not seen to repeat.
    pub periods: u64,
    /// Where the exact orbit begins and ceases to attract, over a frequency and the clearance.
    pub limits: Vec<StabilityLimit>,
    /// SHA-256 of the file of results, in hexadecimal.
    pub results_sha256: String,
}

/// Why there is no page of a sweep.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum SweptError {
    /// A column does not fit the axes.
    #[error("the column `{column}` has {found} values, and the axes make {expected} points")]
    #[diagnostic(help("merge the results of the whole sweep again"))]
    Length {
        /// The column.
        column: String,
        /// Its values.
        found: usize,
        /// Points of the axes.
        expected: usize,
    },
    /// There is no axis, or one without values.
    #[error("a sweep without points has nothing to show")]
    #[diagnostic(help("give each axis at least one value"))]
    Empty,
    /// There are more points than a page shows.
    #[error("{points} points are more than a page shows, which is {MOST_POINTS}")]
    #[diagnostic(help("read the table of results itself"))]
    TooLarge {
        /// Points of the axes.
        points: usize,
    },
    /// A template or a figure does not fit.
    #[error(transparent)]
    Render(#[from] RenderError),
}

impl Swept<'_> {
    /// Proves that every column fits the axes.
    fn check(&self) -> Result<(), SweptError> {
        let points = self.points();
        if points == 0 || self.axes.is_empty() {
            return Err(SweptError::Empty);
        }
        if points > MOST_POINTS {
            return Err(SweptError::TooLarge { points });
        }
        for Column { name, cells, .. } in self.columns {
            if cells.len() != points {
                let (column, found) = (name.clone(), cells.len());
                return Err(SweptError::Length { column, found, expected: points });
            }
        }
        Ok(())
    }

    /// The figures that the columns allow, the first for the first screen.
    ///
    /// # Errors
    /// [`SweptError`] where the columns do not fit the axes.
    pub fn figures(&self) -> Result<Vec<Figure>, SweptError> {
        self.check()?;
        Ok(worded(figures::all(self), &self.units())?)
    }

    /// The page as Markdown and HTML, with its numbers and figures, by their path in the sweep's folder.
    ///
    /// # Errors
    /// [`SweptError`] where the columns do not fit the axes, or a figure cannot be drawn.
    pub fn files(&self) -> Result<Files, SweptError> {
        let document = facts::document(self);
        let json = serde_json::to_string_pretty(&document).map_err(RenderError::from)? + "\n";
        let facts = json!({ "page": document, "steady": self.is_steady(), "several": self.is_of_several() });
        let mut files =
            page_files("sweep", "sweep.md", Some(""), &self.units(), facts, &self.figures()?)?;
        files.insert("sweep.json".into(), json.into_bytes());
        Ok(files)
    }
}
