//! The report of a case: plain data, decided and formatted here, so that templates only loop and
//! print. [`render`] turns it into Markdown, HTML and JSON; figures are data too ([`figure`]).

mod chart;
pub mod choice;
pub mod console;
pub mod criteria;
pub mod document;
pub mod equations;
pub mod error;
pub mod escape;
pub mod figures;
pub mod html;
pub mod index;
pub mod live;
pub mod mathml;
pub mod modal;
pub mod optimize;
pub mod proposal;
pub mod render;
pub mod stored;
pub mod sweep;
pub mod template;
pub mod transient;

pub use vinesink_figure as figure;
