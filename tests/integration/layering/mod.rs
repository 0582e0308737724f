//! The invariants of the house that a compiler does not check: which part may know which. [`tables`] has the drawing.

mod catches;
mod check;
mod graph;
mod references;
mod scopes;
mod source;
mod tables;
mod words;

use std::path::Path;

use check::{strangers, violations};
use tables::RULES;

#[test]
fn every_source_keeps_to_its_layer() {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    source::sources(&base, &base, &mut files);
    assert!(files.len() > 20, "the sources were found");
    let edges = graph::Crate::new(&files).edges();
    assert!(edges.len() > 100, "names were found in other files");
    let found = violations(&files, &RULES);
    assert!(found.is_empty(), "{}", found.join("\n"));
    let strangers = strangers(&files, &RULES);
    assert!(strangers.is_empty(), "the tables name what is not there: {}", strangers.join(", "));
}
