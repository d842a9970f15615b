//! Tests of cases, commands, reports and pages. One program, which is linked once: run a part by its name,
//! `cargo test --test program diff::`.

mod browser_support;
#[path = "../common/mod.rs"]
mod common;

mod band;
#[cfg(unix)]
mod book;
mod both_writings;
mod browser;
mod case;
mod case_properties;
mod case_schema;
mod cavity;
mod cavity_report;
mod check;
mod choice;
mod cli;
mod cli_case;
mod cli_slips;
mod contact;
mod decisions;
mod deviations;
mod diff;
mod extremes;
mod figure;
mod figures;
mod index;
mod layers;
mod live;
mod metadata;
mod modal;
mod modal_accuracy;
mod modal_alternatives;
mod modal_claims;
mod modal_criteria;
mod modal_files;
mod modal_optimum;
mod modal_orbits;
mod modal_ranges;
mod modal_reduced;
mod modal_sweep;
mod modal_theory;
mod motion_lists;
mod optimize;
mod over_time;
mod proposal;
mod readers;
mod record;
mod reduced;
mod release;
mod report;
#[cfg(unix)]
mod review;
mod run;
mod sine_sweep;
mod support;
mod sweep;
mod sweep_page;
#[cfg(unix)]
mod sweep_submit;
mod sweep_transient;
mod templates;
mod tradeoff;
#[cfg(unix)]
mod untrusted;
mod untrusted_input;
