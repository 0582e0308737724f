//! The bibliography has what is cited, and nothing else.

use std::path::Path;

use super::source::sources;

const REFERENCES: &str = include_str!("../../../src/references.md");

/// The keys in a text, such as `Patane09`: square brackets, a name, two digits.
fn keys(text: &str) -> impl Iterator<Item = &str> {
    text.split('[').skip(1).filter_map(|rest| {
        let digits = rest.trim_start_matches(char::is_alphabetic);
        let key = &rest[..rest.len() - digits.len() + digits.chars().take_while(char::is_ascii_digit).count()];
        let year = key.trim_start_matches(char::is_alphabetic);
        (key.starts_with(char::is_uppercase) && year.len() == 2 && key.len() > 4).then_some(key)
    })
}

#[test]
fn references_are_those_that_are_cited() {
    let base = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in ["src", "tests", "benches"] {
        sources(&base.join(folder), base, &mut files);
    }
    let (_, list) = REFERENCES.split_once("\n- ").expect("a list");
    let listed: Vec<&str> = keys(list).collect();
    let cited: Vec<&str> = files.iter().flat_map(|(_, source)| keys(source)).collect();
    for (path, source) in &files {
        keys(source)
            .for_each(|key| assert!(listed.contains(&key), "{path} cites {key}, which is not in references.md"));
    }
    listed.iter().for_each(|key| assert!(cited.contains(key), "nothing cites {key} of references.md"));
}
