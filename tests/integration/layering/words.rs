//! Words that a part of the crate does without.

use super::source::code_of;
use super::tables::Rules;

/// Words that the numerical core does without, so that results depend on no platform, clock, hash order or global state.
/// A fused multiplication and addition rounds once where WebAssembly rounds twice.
pub(crate) const NOT_IN_THE_CORE: [&str; 21] = [
    "std::time",
    "Instant",
    "SystemTime",
    "HashMap",
    "HashSet",
    "thread_local",
    ".sin()",
    ".cos()",
    ".tan()",
    ".sin_cos()",
    ".asin()",
    ".acos()",
    ".atan()",
    ".atan2(",
    "f64::sin",
    "f64::cos",
    ".exp()",
    ".ln()",
    ".powf(",
    ".powi(",
    "mul_add",
];

/// The forbidden words in one file. `path` is relative to `src`, with slashes.
pub(crate) fn forbidden(path: &str, source: &str, rules: &Rules) -> Vec<String> {
    let code = code_of(source);
    let module = path.split('/').next().unwrap_or(path).trim_end_matches(".rs");
    let mut found = Vec::new();
    let mut forbid = |words: &[&str], why: &str| {
        for word in words.iter().filter(|word| code.contains(*word)) {
            found.push(format!("{path} names `{word}`: {why}"));
        }
    };
    if !rules.state.contains(&path) {
        forbid(&["static mut", "thread_local"], "no global state");
    }
    forbid(&["#[path", "include!", "extern crate"], "modules are found by their names");
    if module == "lib" || module == "wasm" {
        return found;
    }
    forbid(&["js_sys", "web_sys", "wasm_bindgen"], "only the bindings know JavaScript");
    if module != "render" {
        forbid(&["tiny_skia", "png::", "colorous"], "only `render` draws");
    }
    if !rules.platform.contains(&path) {
        forbid(&NOT_IN_THE_CORE, "results must not depend on the platform");
    }
    if module == "io" {
        forbid(&["std::path", "std::fs", "Path", "File::"], "files come as bytes");
    }
    if path == "mesh/connectivity.rs" {
        forbid(&["f64", "f32"], "the connectivity holds no positions");
    }
    found
}
