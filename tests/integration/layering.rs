//! The invariants of the house that a compiler does not check: which module may know which.

use std::path::Path;

/// What a module of the crate may import from it. The bindings may import anything.
const MAY_IMPORT: [(&str, &[&str]); 10] = [
    ("support", &["error"]),
    ("error", &[]),
    ("io", &["error", "support"]),
    ("mesh", &["error", "support"]),
    ("load", &["error", "io", "mesh"]),
    ("operators", &["error", "support", "mesh"]),
    ("field", &["error", "support", "mesh"]),
    ("solve", &["error", "support"]),
    ("smooth", &["error", "support", "mesh", "operators", "field", "solve"]),
    ("render", &["error", "support", "mesh", "field"]),
];

/// Words that the numerical core does without, so that results depend on no platform, clock, hash order or global state.
/// A fused multiplication and addition rounds once where WebAssembly rounds twice.
const NOT_IN_THE_CORE: [&str; 21] = [
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

/// The files of the solver in groups: each file may use those of its own group and of the groups before.
const SOLVER: [&[&str]; 11] = [
    &["matrix"],
    &["ordering"],
    &["tree", "supernodes", "symbolic"],
    &["scalar", "unit", "lanes"],
    &["front"],
    &["multifrontal", "triangular"],
    &["cholesky"],
    &["rows", "preconditioner", "cg"],
    &["elimination", "aggregation"],
    &["multigrid", "squared"],
    &["mod"],
];

/// The files and folders of `field` in groups, likewise.
const FIELD: [&[&str]; 11] = [
    &["arrays"],
    &["order", "sorting", "link"],
    &["scalar_field", "sweep"],
    &["critical", "steepest"],
    &["delta_hierarchy", "saddles", "level"],
    &["merging"],
    &["persistence"],
    &["features"],
    &["simplify"],
    &["morse"],
    &["mod"],
];

/// The files and folders of `smooth`, likewise.
const SMOOTH: [&[&str]; 9] = [
    &["options", "channels"],
    &["routes"],
    &["system"],
    &["constraints", "maximum_principle", "bounds"],
    &["report"],
    &["regularized"],
    &["tikhonov"],
    &["least_squares", "interpolate", "filters"],
    &["mod"],
];

/// The files and folders of `render`, likewise.
const RENDER: [&[&str]; 9] = [
    &["colormap", "solids", "surface"],
    &["camera", "style"],
    &["options"],
    &["draw_list"],
    &["raster", "font", "ticks", "png"],
    &["text"],
    &["legend"],
    &["page"],
    &["scene", "mod"],
];

/// The bibliography.
const REFERENCES: &str = include_str!("../../src/references.md");

/// A source without comments and without its text literals' content, which name things freely.
fn code_of(source: &str) -> String {
    let mut code = String::new();
    for line in source.lines() {
        let mut quoted = false;
        let mut previous = ' ';
        for (place, c) in line.char_indices() {
            if !quoted && line[place..].starts_with("//") {
                break;
            }
            if c == '"' && previous != '\\' && previous != '\'' {
                quoted = !quoted;
            }
            if !quoted {
                code.push(c);
            }
            previous = if previous == '\\' { ' ' } else { c };
        }
        code.push('\n');
    }
    code
}

/// The modules of the crate that a piece of code names: `crate::a`, `crate::{a, b::c}`.
fn imports(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (place, _) in code.match_indices("crate::") {
        let rest = &code[place + "crate::".len()..];
        if place > 0 && code[..place].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':') {
            continue;
        }
        let word = |text: &str| -> String {
            text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
        };
        if let Some(group) = rest.strip_prefix('{') {
            let (mut depth, mut start) = (0, 0);
            for (i, c) in group.char_indices() {
                match c {
                    '{' => depth += 1,
                    '}' | ',' if depth == 0 => {
                        found.push(word(&group[start..i]));
                        start = i + 1;
                        if c == '}' {
                            break;
                        }
                    }
                    '}' => depth -= 1,
                    _ => {}
                }
            }
        } else {
            found.push(word(rest));
        }
    }
    // Names that `lib.rs` re-exports stand for the module they come from.
    found
        .into_iter()
        .filter(|name| !name.is_empty())
        .map(|name| match name.as_str() {
            "Error" | "Result" | "Diagnostic" => "error".to_owned(),
            "TriMesh" => "mesh".to_owned(),
            "Smoother" | "SmootherOptions" => "smooth".to_owned(),
            "Phase" | "Progress" | "Watch" => "support".to_owned(),
            _ => name,
        })
        .collect()
}

/// What a file of the solver does against their order.
fn disorder(name: &str, code: &str) -> Vec<String> {
    if name.starts_with("ordering/") {
        let leaves = code.contains("super::super");
        return leaves.then(|| "knows more than patterns".to_owned()).into_iter().collect();
    }
    out_of_order(name, code, &SOLVER, &["super::"])
}

/// What a file or folder uses of the groups after its own. `paths` lead to its siblings.
fn out_of_order(name: &str, code: &str, groups: &[&[&str]], paths: &[&str]) -> Vec<String> {
    let Some(group) = groups.iter().position(|group| group.contains(&name)) else {
        return vec!["has no place among the files of its module yet".to_owned()];
    };
    let later = groups[group + 1..].iter().copied().flatten();
    let used = later.filter(|later| paths.iter().any(|path| code.contains(&format!("{path}{later}::"))));
    used.map(|later| format!("uses `{later}`, which comes after it")).collect()
}

/// Everything that one file does against the rules. `path` is relative to `src`, with slashes.
fn violations(path: &str, source: &str) -> Vec<String> {
    let code = code_of(source);
    let module = path.split('/').next().unwrap_or(path).trim_end_matches(".rs");
    let mut found = Vec::new();
    let mut forbid = |words: &[&str], why: &str| {
        for word in words.iter().filter(|word| code.contains(*word)) {
            found.push(format!("{path} names `{word}`: {why}"));
        }
    };
    forbid(&["static mut", "thread_local"], "no global state");
    if module == "lib" || module == "wasm" {
        return found;
    }
    forbid(&["js_sys", "web_sys", "wasm_bindgen"], "only the bindings know JavaScript");
    if module != "render" {
        forbid(&["tiny_skia", "png::", "colorous"], "only `render` draws");
    }
    if path != "mesh/shapes.rs" {
        forbid(&NOT_IN_THE_CORE, "results must not depend on the platform");
    }
    if module == "io" {
        forbid(&["std::path", "std::fs", "Path", "File::"], "files come as bytes");
    }
    if path == "mesh/connectivity.rs" {
        forbid(&["f64", "f32"], "the connectivity holds no positions");
    }
    if let Some(name) = path.strip_prefix("solve/").and_then(|name| name.strip_suffix(".rs")) {
        found.extend(disorder(name, &code).into_iter().map(|what| format!("{path} {what}")));
    }
    for (module, groups) in [("field", &FIELD[..]), ("smooth", &SMOOTH[..]), ("render", &RENDER[..])] {
        let Some(name) = path.strip_prefix(module).and_then(|name| name.strip_prefix('/')) else { continue };
        let from_crate = format!("{module}::");
        let (name, paths) = match name.split_once('/') {
            Some((folder, _)) => (folder, [from_crate.as_str(), "super::super::"]),
            None => (name.trim_end_matches(".rs"), [from_crate.as_str(), "super::"]),
        };
        found.extend(out_of_order(name, &code, groups, &paths).into_iter().map(|what| format!("{path} {what}")));
    }
    match MAY_IMPORT.iter().find(|(name, _)| *name == module) {
        None => found.push(format!("{path}: the module `{module}` has no place in the layers yet")),
        Some((_, allowed)) => {
            for import in imports(&code) {
                if import != module && !allowed.contains(&import.as_str()) {
                    found.push(format!("{path} imports `{import}`, but `{module}` may only import {allowed:?}"));
                }
            }
        }
    }
    found
}

fn sources(folder: &Path, base: &Path, into: &mut Vec<(String, String)>) {
    let mut entries: Vec<_> =
        std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            sources(&path, base, into);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let name = path.strip_prefix(base).expect("below src").to_string_lossy().replace('\\', "/");
            into.push((name, std::fs::read_to_string(&path).expect("a source")));
        }
    }
}

#[test]
fn every_source_keeps_to_its_layer() {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&base, &base, &mut files);
    assert!(files.len() > 20, "the sources were found");
    for (module, _) in MAY_IMPORT {
        let prefix = format!("{module}/");
        assert!(files.iter().any(|(path, _)| path.starts_with(&prefix) || *path == format!("{module}.rs")), "{module}");
    }
    let found: Vec<String> = files.iter().flat_map(|(path, source)| violations(path, source)).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

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

#[test]
fn the_check_catches_what_it_is_for() {
    let bad = [
        ("solve/cg.rs", "use crate::mesh::TriMesh;"),
        ("solve/cg.rs", "use crate::{error::SolveError, mesh};"),
        ("solve/cg.rs", "fn f(m: &crate::TriMesh) {}"),
        ("io/ply.rs", "use crate::mesh::TriMesh;"),
        ("mesh/weld.rs", "use crate::io::MeshData;"),
        ("io/ply.rs", "use std::path::Path;"),
        ("io/ply.rs", "let x = std::fs::read(p);"),
        ("mesh/mod.rs", "use crate::{\n    error::{A, B},\n    field::order,\n};"),
        ("mesh/connectivity.rs", "positions: Vec<f64>,"),
        ("field/link.rs", "use crate::operators;"),
        ("operators/mass.rs", "let x = angle.cos();"),
        ("smooth/bounds.rs", "let x = base.powi(3) * y.exp();"),
        ("solve/scalar.rs", "let x = a.mul_add(b, c);"),
        ("solve/ordering/graph.rs", "use crate::mesh::TriMesh;"),
        ("solve/ordering/graph.rs", "use super::super::matrix::norm;"),
        ("solve/tree.rs", "use super::scalar::Scalar;"),
        ("solve/lu.rs", "fn f() {}"),
        ("field/order.rs", "use std::collections::HashMap;"),
        ("field/order.rs", "use super::critical::exact;"),
        ("field/persistence/loops.rs", "use crate::field::simplify::Keep;"),
        ("field/reeb.rs", "fn f() {}"),
        ("smooth/routes/real.rs", "use crate::smooth::system::Solved;"),
        ("smooth/report.rs", "use super::tikhonov::TikhonovOptions;"),
        ("smooth/mod.rs", "let t = std::time::Instant::now();"),
        ("smooth/mod.rs", "use wasm_bindgen::prelude::*;"),
        ("field/level/bands.rs", "use tiny_skia::Pixmap;"),
        ("render/draw_list.rs", "use super::raster::paint;"),
        ("render/scene.rs", "use crate::smooth::Smoother;"),
        ("error.rs", "use crate::io::MeshFormat;"),
        ("wasm/mod.rs", "static mut STATE: u32 = 0;"),
        ("clock/mod.rs", "fn f() {}"),
    ];
    for (path, source) in bad {
        assert!(!violations(path, source).is_empty(), "{path}: {source}");
    }
    let good = [
        ("solve/cg.rs", "use crate::error::SolveError; // as crate::mesh does\nlet x = \"crate::mesh \\\" sin(\";"),
        ("smooth/mod.rs", "use crate::{error::Result, mesh::{TriMesh, shapes}, solve::norm};\npub(crate) fn f() {}"),
        ("mesh/shapes.rs", "let x = u.cos();"),
        ("field/order.rs", "/// See `crate::smooth`.\nlet cosine = dot(a, b);"),
        ("wasm/mod.rs", "use wasm_bindgen::prelude::*;\nuse crate::smooth::Smoother;"),
    ];
    for (path, source) in good {
        assert_eq!(violations(path, source), Vec::<String>::new(), "{source}");
    }
}
