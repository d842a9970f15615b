//! The page of `vinesink sweep`: what a grid of systems shows, in words, tables and figures.

mod axis;
mod facts;
mod figures;
mod grid;
mod kinds;
mod tables;
mod words;

use serde::Serialize;

use super::FigureRow;
use super::figure::Figure;
use crate::case::Case;
use crate::sweep::columns::Column;
use facts::Facts;
use grid::Grid;
use words::Words;

pub use axis::AxisShown;
pub use kinds::tint;
pub use tables::TitledTable;

/// A page shows at most so many points; of more, the table alone is the result.
pub const MOST_POINTS: usize = 1_000_000;

/// A sweep with its results.
#[derive(Debug, Clone)]
pub struct Swept<'a> {
    /// The case it belongs to.
    pub case: &'a Case,
    /// The axes; the last varies fastest.
    pub axes: Vec<AxisShown>,
    /// What is known, a value for each point in each column. Columns are found by their names, and any may be
    /// missing.
    pub columns: &'a [Column],
    /// Starts at each point.
    pub starts: u32,
    /// Excitation periods measured where a motion is not seen to repeat.
    pub periods: u64,
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
}

impl Swept<'_> {
    /// Proves that every column fits the axes.
    fn check(&self) -> Result<(), SweptError> {
        let counts = self.axes.iter().map(|axis| axis.values.len());
        let points = counts.fold(1_usize, usize::saturating_mul);
        if points == 0 || self.axes.is_empty() {
            return Err(SweptError::Empty);
        }
        if points > MOST_POINTS {
            return Err(SweptError::TooLarge { points });
        }
        for column in self.columns {
            let found = column.values.len();
            if found != points {
                let column = column.name.clone();
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
        Ok(figures::all(&Grid::of(self)))
    }
}

/// The page as data.
#[derive(Debug, Clone, Serialize)]
pub struct SweepPage {
    /// The case's title.
    pub title: String,
    /// The answer in a sentence or two.
    pub headline: String,
    /// What else there is to know at once, a sentence each.
    pub sentences: Vec<String>,
    /// Everything in numbers.
    pub tables: Vec<TitledTable>,
    /// The figures' words; the drawings are files of their own.
    pub figures: Vec<FigureRow>,
    /// How it was computed, a sentence each.
    pub method: Vec<String>,
    /// Folder name of the case's pages.
    pub name: String,
    /// Version of the program.
    pub version: &'static str,
    /// SHA-256 of the case file's text.
    pub case_sha256: String,
    /// SHA-256 of the results.
    pub results_sha256: String,
    /// The numbers behind the words.
    #[serde(skip)]
    pub document: SweepDocument,
}

/// `vinesink/sweep@1`: the numbers behind a page. Lengths in metres or the case's own unit, coordinates in the
/// axes' units.
#[derive(Debug, Clone, Serialize)]
pub struct SweepDocument {
    format: &'static str,
    title: String,
    points: usize,
    axes: Vec<AxisShown>,
    starts: u32,
    periods: u64,
    /// One for each pass: a single one, or up and down.
    motions: Vec<Facts>,
    /// Points at which up and down differ; none where nothing was followed.
    hysteresis_points: Option<usize>,
    version: &'static str,
    case_sha256: String,
    results_sha256: String,
}

impl SweepPage {
    /// Writes the page of a sweep; `figures` are those of [`Swept::figures`].
    ///
    /// # Errors
    /// [`SweptError`] where the columns do not fit the axes.
    pub fn new(name: &str, swept: &Swept, figures: &[Figure]) -> Result<Self, SweptError> {
        swept.check()?;
        let grid = Grid::of(swept);
        let facts: Vec<Facts> =
            grid.passes().into_iter().map(|pass| Facts::of(&grid, pass)).collect();
        let hysteresis = facts::hysteresis(&grid);
        let words = Words { grid: &grid, facts: &facts, hysteresis: hysteresis.as_deref() };
        let (headline, sentences, method) = (words.headline(), words.sentences(), words.method());
        let tables = tables::tables(&grid, &facts);
        let differing = |all: &Vec<bool>| all.iter().filter(|one| **one).count();
        Ok(Self {
            title: swept.case.title.clone(),
            headline,
            sentences,
            tables,
            figures: figures.iter().map(FigureRow::of).collect(),
            method,
            name: name.to_owned(),
            version: env!("CARGO_PKG_VERSION"),
            case_sha256: swept.case.text_hash.clone(),
            results_sha256: swept.results_sha256.clone(),
            document: SweepDocument {
                format: "vinesink/sweep@1",
                title: swept.case.title.clone(),
                points: grid.points(),
                axes: swept.axes.clone(),
                starts: swept.starts,
                periods: swept.periods,
                hysteresis_points: hysteresis.as_ref().map(differing),
                motions: facts,
                version: env!("CARGO_PKG_VERSION"),
                case_sha256: swept.case.text_hash.clone(),
                results_sha256: swept.results_sha256.clone(),
            },
        })
    }
}
