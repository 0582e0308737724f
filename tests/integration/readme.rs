//! The README shows the example that is there, and it is as short as the README says.

const README: &str = include_str!("../../README.md");
const EXAMPLE: &str = include_str!("../../examples/smooth.rs");

/// The code blocks of a language.
fn blocks<'a>(text: &'a str, language: &str) -> Vec<&'a str> {
    let start = format!("\n```{language}\n");
    text.split(&start).skip(1).map(|rest| &rest[..rest.find("```").expect("an end")]).collect()
}

// That it runs is seen by `cargo test --doc`, which runs the README's block.
#[test]
fn readme_shows_the_example() {
    assert_eq!(blocks(README, "rust"), [EXAMPLE]);
    assert_eq!(EXAMPLE.lines().count(), 10);
}
