//! The answer to a request of the page, both in JSON.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use vinesink::case::is_modal;

use crate::told::words;
use crate::{one, several};

/// The case of a request; without one the page asks for those to begin with.
#[derive(Deserialize)]
struct About {
    text: Option<String>,
}

/// Cases by the question that they answer, then those of several modes or absorbers, then the paper's five regimes (Fig. 4).
const PRESETS: [(&str, &str); 12] = [
    ("a footbridge at 2 Hz", include_str!("../../docs/src/cases/bridge.toml")),
    ("a machine foot at 12 Hz", include_str!("../../docs/src/cases/foot.toml")),
    ("a mast in the wind", include_str!("../../cases/mast-mode-2.toml")),
    ("when it makes things worse", include_str!("../../cases/li2016-8hz-b4mm.toml")),
    ("several modes: one ball on a mast", include_str!("../../cases/several/mast.toml")),
    ("several modes: balls at two places", include_str!("../../cases/several/floor.toml")),
    ("graded balls on one mode", include_str!("../../cases/several/graded.toml")),
    (
        "the paper: more than two impacts per period",
        include_str!("../../cases/li2016-8p5hz-fig4a.toml"),
    ),
    ("the paper: two asymmetric impacts", include_str!("../../cases/li2016-8p5hz-fig4b.toml")),
    ("the paper: two symmetric impacts", include_str!("../../cases/li2016-8p5hz-fig4c.toml")),
    ("the paper: strongly modulated response", include_str!("../../cases/li2016-8p5hz-fig4d.toml")),
    ("the paper: few impacts", include_str!("../../cases/li2016-8p5hz-fig4e.toml")),
];

/// The answer to a request; `{"problems": [...]}` where there is none.
pub fn to(request: &[u8]) -> Vec<u8> {
    let answer = read::<About>(request).and_then(|about| match about.text {
        None => Ok(PRESETS.iter().map(|(name, text)| json!([name, text])).collect()),
        Some(text) if is_modal(&text) => read(request).and_then(several::answer),
        Some(_) => read(request).and_then(one::answer),
    });
    let answer = answer.unwrap_or_else(|problems| json!({ "problems": problems }));
    answer.to_string().into_bytes()
}

fn read<R: DeserializeOwned>(request: &[u8]) -> Result<R, Value> {
    serde_json::from_slice(request).map_err(words)
}
