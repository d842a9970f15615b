//! What must hold of every page. Each check returns what is wrong with it, in words; none is good.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::chromium::{Page, View};

pub const PHONE: View = View { width: 390, height: 844, phone: true, dark: false };
pub const DESKTOP: View = View { width: 1280, height: 900, phone: false, dark: false };

/// Opens what is folded, and loads images that would wait until they come into view.
const UNFOLD: &str = "
    document.querySelectorAll('details').forEach((part) => { part.open = true; });
    document.querySelectorAll('h2 button[aria-expanded=false]').forEach((part) => part.click());
    Promise.all([...document.images].map((image) => {
        image.loading = 'eager';
        return image.complete ? 0 : new Promise((done) => { image.onload = image.onerror = done; });
    })).then(() => 0)";

/// Every equation and figure has a size, and lies in the window's width or in a box that scrolls;
/// the page itself does not scroll sideways.
const LAYOUT: &str = "(() => {
    const wrong = [];
    // A phone's browser widens its canvas for what does not fit; the screen does not grow.
    const width = Math.min(document.documentElement.clientWidth, screen.width);
    const name = (part) => `${part.tagName.toLowerCase()} ${
        (part.getAttribute('alt') || part.textContent || '').trim().slice(0, 50)}`;
    const scrolls = (part) => {
        for (let box = part.parentElement; box; box = box.parentElement) {
            if (!['auto', 'scroll'].includes(getComputedStyle(box).overflowX)) continue;
            const at = box.getBoundingClientRect();
            if (at.left >= -1 && at.right <= width + 1) return true;
        }
        return false;
    };
    for (const part of document.querySelectorAll('math, svg, img, table')) {
        // The first numbers are cards on a phone, and their table is no box.
        if (part.closest('[hidden]') || getComputedStyle(part).display === 'contents') continue;
        // Of two drawings one is for a phone.
        const twin = part.matches('.drawing svg') && (part.nextElementSibling ?? part.previousElementSibling);
        if (twin && getComputedStyle(part).display === 'none' && twin.checkVisibility()) continue;
        const at = part.getBoundingClientRect();
        if (at.width < 1 || at.height < 1) wrong.push(`no size: ${name(part)}`);
        else if ((at.left < -1 || at.right > width + 1) && !scrolls(part))
            wrong.push(`outside of the window, and nothing scrolls: ${name(part)}`);
        if (part.tagName === 'IMG' && part.naturalWidth === 0) wrong.push(`no image: ${part.src}`);
    }
    if (document.documentElement.scrollWidth > width + 1)
        wrong.push(`the page is ${document.documentElement.scrollWidth} px wide`);
    return wrong;
})()";

/// Shows all that is folded away.
pub fn unfold(page: &mut Page) {
    page.evaluate(UNFOLD);
}

/// What is out of place.
pub fn layout(page: &mut Page) -> Vec<String> {
    texts(&page.evaluate(LAYOUT))
}

/// Errors on the console, and whatever was asked of the network or of files outside of `folder`.
pub fn noise(page: &mut Page, folder: &Path) -> Vec<String> {
    let start = format!("file://{}/", folder.display()).replace(' ', "%20");
    let allowed = [start, "data:".to_owned(), "blob:".to_owned()];
    let found = page.events().into_iter().filter_map(|event| {
        let told = &event["params"];
        let level = |value: &Value| value == "error" || value == "warning" || value == "assert";
        match event["method"].as_str()? {
            "Runtime.exceptionThrown" => Some(format!("exception: {}", told["exceptionDetails"])),
            "Runtime.consoleAPICalled" if level(&told["type"]) => {
                Some(format!("console: {}", told["args"]))
            }
            "Log.entryAdded" if level(&told["entry"]["level"]) => {
                Some(format!("log: {}", told["entry"]["text"]))
            }
            "Network.requestWillBeSent" => {
                let url = told["request"]["url"].as_str()?;
                let inside = allowed.iter().any(|start| url.starts_with(start));
                (!inside).then(|| format!("request: {url}"))
            }
            _ => None,
        }
    });
    found.collect()
}

/// Where axe-core's script lies: in `AXE`, or where `.ci/deep` puts it.
pub fn axe() -> Option<PathBuf> {
    let usual = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/axe/package/axe.min.js");
    let given = std::env::var_os("AXE").map(PathBuf::from);
    Some(given.unwrap_or(usual)).filter(|file| file.is_file())
}

/// Violations of accessibility rules whose impact is serious or critical, by axe-core's `script`. The
/// lines of a figure are taken out first: to those who cannot see it, it is an image with a title, and
/// looking at thousands of lines takes half a minute.
pub fn accessibility(page: &mut Page, script: &str) -> Vec<String> {
    page.evaluate(&format!("{script}; 0"));
    page.evaluate(
        "document.querySelectorAll('svg[role=img] > :not(title, desc)')
            .forEach((part) => part.remove())",
    );
    texts(&page.evaluate(
        "axe.run({ resultTypes: ['violations'] }).then((found) =>
            found.violations
                .filter((rule) => ['serious', 'critical'].includes(rule.impact))
                .flatMap((rule) => rule.nodes.slice(0, 4).map((node) =>
                    `${rule.id} (${rule.impact}, ${rule.nodes.length} of them): ${node.target} ${
                        node.html.slice(0, 160)} ${node.failureSummary}`)))",
    ))
}

/// Marked points of figures without a tooltip that the pointer reaches, or how many there are.
pub fn tooltips(page: &mut Page) -> Result<u64, String> {
    let found = page.evaluate(
        "(() => {
            let reached = 0;
            for (const title of document.querySelectorAll('svg title')) {
                const mark = title.parentElement;
                if (mark.tagName === 'svg' || !title.textContent.trim()) continue;
                if (!mark.closest('svg').checkVisibility()) continue;
                mark.scrollIntoView({ block: 'center', inline: 'center', behavior: 'instant' });
                const at = mark.getBoundingClientRect();
                const there = document.elementFromPoint(
                    at.left + at.width / 2, at.top + at.height / 2);
                const told = there?.closest(':has(> title)');
                if (told && told.tagName !== 'svg' && told.closest('svg') === mark.closest('svg'))
                    reached += 1;
                else return `nothing to point at: ${title.textContent}`;
            }
            return reached;
        })()",
    );
    found.as_u64().ok_or_else(|| found.to_string())
}

/// How many pages a PDF has.
pub fn pages(pdf: &[u8]) -> usize {
    assert!(pdf.starts_with(b"%PDF-"), "not a PDF");
    let text = String::from_utf8_lossy(pdf);
    text.match_indices("/Type /Page").filter(|(at, _)| !text[*at + 11..].starts_with('s')).count()
}

fn texts(list: &Value) -> Vec<String> {
    let list = list.as_array().expect("a list");
    list.iter().map(|one| one.as_str().expect("a text").to_owned()).collect()
}
