//! The live page as a part of a report, which stays one file.

use serde_json::json;

use super::error::RenderError;
use super::template;
use crate::quantity::Units;

/// What a report takes over from the live page, by how it begins and ends.
const PARTS: [[&str; 2]; 3] = [
    ["<style id=\"live-style\">", "</style>"],
    ["<script type=\"application/octet-stream\" id=\"live-module\">", "</script>"],
    ["<script id=\"live-script\">", "</script>"],
];

/// Why a report cannot take over the live page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EmbedError {
    /// The page is another one.
    #[error("this is not the live page: it has no {0}")]
    Another(&'static str),
    /// Its frame cannot be written.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// A report's page with the live page of its case, whose file has this `text`, at the end.
///
/// # Errors
/// [`EmbedError`] if `live` is something else.
pub fn embed(report: &str, live: &str, text: &str) -> Result<String, EmbedError> {
    let part = |[begin, end]: [&'static str; 2]| {
        let at = live.find(begin).ok_or(EmbedError::Another(begin))?;
        let length = live[at..].find(end).ok_or(EmbedError::Another(begin))? + end.len();
        Ok::<_, EmbedError>(&live[at..at + length])
    };
    let hash = |part: &str, [begin, end]: [&str; 2]| {
        template::policy_hash(&part[begin.len()..part.len() - end.len()])
    };
    let [style, module, script] = PARTS.map(part);
    let (style, module, script) = (style?, module?, script?);
    let styles = format!("style-src '{}' ", hash(style, PARTS[0]));
    let scripts =
        format!("worker-src blob:; script-src '{}' 'wasm-unsafe-eval' ", hash(script, PARTS[2]));
    let panel = template::render("live.html", &Units::reduced(), &json!({ "text": text }))?;
    let entry = "<li><a href=\"#live\">Live</a></li>\n</ol>\n</nav>";
    let page = report
        .replacen("style-src ", &styles, 1)
        .replacen("script-src ", &scripts, 1)
        .replacen("</head>", &format!("{style}\n</head>"), 1)
        .replacen("</ol>\n</nav>", entry, 1)
        .replacen("</main>", &format!("{panel}</main>"), 1);
    Ok(page.replacen("</body>", &format!("{module}\n{script}\n</body>"), 1))
}
