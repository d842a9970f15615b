//! What a registry and a library of citations read says what the manifest says. `SNAPSHOTS=overwrite` writes it.
//!
//! Who publishes the program changes `repository` in `Cargo.toml`, the one place, and carries it on by this test.

use std::fs;
use std::path::Path;

use regex::Regex;
use serde_json::json;

/// Texts of the manifest.
struct Manifest(toml::Table);

impl Manifest {
    fn read() -> Self {
        let text = fs::read_to_string(root().join("Cargo.toml")).expect("the manifest");
        Self(text.parse::<toml::Table>().expect("TOML"))
    }

    fn get(&self, key: &str) -> &str {
        let common = &self.0["workspace"]["package"];
        let text = self.0["package"][key].as_str().or_else(|| common.get(key)?.as_str());
        text.unwrap_or_else(|| panic!("{key}"))
    }

    fn keywords(&self) -> Vec<&str> {
        let keywords = self.0["package"]["keywords"].as_array().expect("a list");
        keywords.iter().map(|one| one.as_str().expect("a text")).collect()
    }
}

const AUTHORS: &str = "The vinesink authors";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn is_written(path: &str, wanted: &str) {
    let path = root().join(path);
    if std::env::var("SNAPSHOTS").is_ok_and(|action| action == "overwrite") {
        fs::write(&path, wanted).expect("written");
    }
    let there = fs::read_to_string(&path).unwrap_or_default();
    assert!(there == wanted, "{}: SNAPSHOTS=overwrite writes\n{wanted}", path.display());
}

/// <https://citation-file-format.github.io>, version 1.2.0.
#[test]
fn a_citation_has_the_manifests_version() {
    let manifest = Manifest::read();
    let keywords: String = manifest.keywords().iter().map(|one| format!("  - {one}\n")).collect();
    let [version, license, repository, description] =
        ["version", "license", "repository", "description"].map(|key| manifest.get(key));
    let text = format!(
        "cff-version: 1.2.0\n\
         message: Please cite this software with the version that computed your results.\n\
         type: software\n\
         title: vinesink\n\
         abstract: {description}\n\
         version: {version}\n\
         license: {license}\n\
         repository-code: {repository}\n\
         authors:\n  - name: {AUTHORS}\n\
         keywords:\n{keywords}\
         references:\n\
         \x20 - type: article\n\
         \x20   title: On the dynamics around targeted energy transfer for vibro-impact nonlinear energy sink\n\
         \x20   authors:\n\
         \x20     - family-names: Li\n\
         \x20     - family-names: Seguy\n\
         \x20     - family-names: Berlioz\n\
         \x20   journal: Nonlinear Dynamics\n\
         \x20   year: 2016\n"
    );
    is_written("CITATION.cff", &text);
}

/// <https://codemeta.github.io>, version 3.0.
#[test]
fn code_metadata_has_the_manifests_version() {
    let manifest = Manifest::read();
    let document = json!({
        "@context": "https://w3id.org/codemeta/3.0",
        "@type": "SoftwareSourceCode",
        "name": "vinesink",
        "description": manifest.get("description"),
        "version": manifest.get("version"),
        "license": format!("https://spdx.org/licenses/{}", manifest.get("license")),
        "codeRepository": manifest.get("repository"),
        "programmingLanguage": "Rust",
        "runtimePlatform": format!("Rust {} or later", manifest.get("rust-version")),
        "keywords": manifest.keywords(),
        "author": [{ "@type": "Organization", "name": AUTHORS }],
    });
    let text = serde_json::to_string_pretty(&document).expect("JSON");
    is_written("codemeta.json", &format!("{text}\n"));
}

#[test]
fn the_workflow_names_the_manifests_repository() {
    let manifest = Manifest::read();
    let repository = manifest.get("repository");
    let (_, name) = repository.split_once("github.com/").expect("a repository with an action");
    let path = "examples/github/review-reports.yml";
    let text = fs::read_to_string(root().join(path)).expect("the workflow");
    let used = Regex::new("uses: [^/ ]+/vinesink@").expect("a pattern");
    assert_eq!(used.find_iter(&text).count(), 1);
    is_written(path, &used.replace(&text, format!("uses: {name}@")));
}

/// The registry shows an image of this page, and follows its links, in the repository, under `raw/HEAD` and
/// `blob/HEAD`: they have to be named from its root. <https://doc.rust-lang.org/cargo/reference/manifest.html>
#[test]
fn what_the_first_page_refers_to_is_in_the_repository() {
    let text = fs::read_to_string(root().join("README.md")).expect("the page");
    let link = Regex::new(r"\]\(([^)#]+)").expect("a pattern");
    let links = link.captures_iter(&text).map(|found| found.get(1).expect("an address").as_str());
    let links: Vec<&str> = links.filter(|link| !link.starts_with("https://")).collect();
    assert!(links.contains(&"docs/report.png"), "{links:?}");
    for link in links {
        assert!(!link.starts_with(['.', '/']) && root().join(link).exists(), "{link}");
    }
}

/// What the registry refuses only when a version is published.
#[test]
fn keywords_are_those_that_the_registry_takes() {
    let manifest = Manifest::read();
    let keywords = manifest.keywords();
    assert!(keywords.len() <= 5, "{keywords:?}");
    for keyword in keywords {
        let fits =
            keyword.len() <= 20 && keyword.starts_with(|first: char| first.is_ascii_alphanumeric());
        let rest = |one: char| one.is_ascii_alphanumeric() || "_-+".contains(one);
        assert!(fits && keyword.chars().all(rest), "{keyword}");
    }
}
