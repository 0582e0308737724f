//! The check catches what it is for: a small crate without a fault, and sources that bring one in.

use super::check::{strangers, violations};
use super::graph::Crate;
use super::tables::Rules;

const SMALL: Rules = Rules {
    layers: &[
        ("error", &[]),
        ("io", &["error"]),
        ("mesh", &["error", "io"]),
        ("operators", &["error", "mesh"]),
        ("field", &["error", "mesh"]),
        ("solve", &["error"]),
        ("smooth", &["error", "mesh", "operators", "field", "solve"]),
        ("render", &["error", "mesh", "field"]),
    ],
    orders: &[
        ("solve", &[&["ordering"], &["matrix"], &["tree"], &["scalar"], &["cg"], &["mod"]]),
        ("field", &[&["order", "link"], &["critical"], &["persistence"], &["simplify"], &["level"], &["mod"]]),
        ("field/persistence", &[&["merging"], &["loops"], &["mod"]]),
        ("smooth", &[&["routes"], &["system"], &["report"], &["tikhonov"], &["mod"]]),
        ("render", &[&["style"], &["draw_list"], &["raster"], &["scene", "mod"]]),
    ],
    platform: &["mesh/shapes.rs"],
    state: &[],
};

/// Every file of the small crate.
const HOUSE: &[(&str, &str)] = &[
    (
        "lib.rs",
        "pub mod mesh;\npub mod smooth;\npub use mesh::TriMesh;\npub use smooth::Smoother;\npub use error::Error;",
    ),
    ("error.rs", "pub enum SolveError {}\npub enum Error {}\nmacro_rules! stage { () => { pub enum Hidden {} } }"),
    ("io/mod.rs", "mod ply;\npub enum MeshFormat { Ply }"),
    ("io/ply.rs", "use crate::error::Error;\npub fn read() {}"),
    (
        "mesh/mod.rs",
        "mod connectivity;\npub mod shapes;\npub use connectivity::Connectivity;\npub struct TriMesh(Connectivity);",
    ),
    ("mesh/connectivity.rs", "pub struct Connectivity;"),
    ("mesh/shapes.rs", "use super::TriMesh;\npub fn sphere() -> f64 { 1.0_f64.cos() }"),
    ("operators/mod.rs", "mod mass;\npub use mass::mass;"),
    ("operators/mass.rs", "use crate::mesh::TriMesh;\npub fn mass() {}"),
    (
        "solve/mod.rs",
        "mod cg;\nmod matrix;\npub use cg::conjugate_gradient;\npub use matrix::{norm as length, product};",
    ),
    ("solve/matrix.rs", "pub fn norm() {}\npub fn product() {}"),
    ("solve/ordering/mod.rs", "mod graph;\npub const NONE: u32 = 0;\npub use graph::Graph;"),
    ("solve/ordering/graph.rs", "use super::NONE;\npub struct Graph;"),
    ("solve/tree.rs", "pub fn tree() {}"),
    ("solve/scalar.rs", "pub trait Scalar {}"),
    ("solve/cg.rs", "use super::matrix::norm;\npub fn conjugate_gradient() {}"),
    (
        "field/mod.rs",
        "mod critical;\nmod order;\nmod persistence;\nmod simplify;\npub use critical::exact;\npub use order::*;\n\
         pub use persistence::persistence;\npub use simplify::{Keep, simplify};",
    ),
    ("field/order.rs", "use crate::mesh::TriMesh;\npub struct VertexOrder;"),
    ("field/link.rs", "pub fn link() {}"),
    ("field/critical.rs", "use super::order::VertexOrder;\npub fn exact() {}"),
    ("field/persistence/mod.rs", "mod loops;\nmod merging;\npub use merging::Merging;\npub fn persistence() {}"),
    ("field/persistence/loops.rs", "use super::Merging;\nuse crate::field::critical;\nfn f() { critical::exact() }"),
    ("field/persistence/merging.rs", "pub struct Merging;"),
    ("field/simplify.rs", "use super::persistence;\npub enum Keep { All }\npub fn simplify() {}"),
    ("field/level/mod.rs", "pub struct LevelSets;"),
    (
        "smooth/mod.rs",
        "mod report;\nmod routes;\nuse routes::real;\npub struct Smoother;\npub use tikhonov::TikhonovOptions;",
    ),
    ("smooth/report.rs", "use crate::{field::{self, VertexOrder}, solve};\nfn f() { field::exact(); solve::length() }"),
    ("smooth/routes/mod.rs", "pub mod real;"),
    ("smooth/routes/real.rs", "pub fn real() {}"),
    ("smooth/system.rs", "pub struct Solved;"),
    ("smooth/tikhonov.rs", "use super::report::Report;\npub struct TikhonovOptions;"),
    ("render/mod.rs", "mod draw_list;\nmod raster;\nmod scene;\npub use raster::paint;"),
    ("render/style.rs", "pub const GREY: u8 = 1;"),
    ("render/draw_list.rs", "use super::style;\nfn f() -> u8 { style::GREY }"),
    ("render/raster/mod.rs", "pub fn paint() {}"),
    ("render/scene.rs", "use super::paint;\npub struct Scene;"),
    ("wasm/mod.rs", "use wasm_bindgen::prelude::*;\nuse crate::smooth::Smoother;"),
];

/// The small crate with one file added or replaced.
fn house_with(path: &str, source: &str) -> Vec<(String, String)> {
    let kept = HOUSE.iter().filter(|(known, _)| *known != path);
    kept.chain([&(path, source)]).map(|&(path, source)| (path.to_owned(), source.to_owned())).collect()
}

#[test]
fn the_check_catches_what_it_is_for() {
    let bad = [
        // Layers.
        ("solve/cg.rs", "use crate::mesh::TriMesh;"),
        ("solve/cg.rs", "use crate::{error::SolveError, mesh};"),
        ("solve/cg.rs", "fn f(m: &crate::TriMesh) {}"),
        ("solve/cg.rs", "use super::super::mesh::TriMesh;"),
        ("solve/cg.rs", "use super::{super::{error::Error, mesh::{TriMesh}}, matrix};"),
        ("solve/cg.rs", "fn f() { super::super::field::exact() }"),
        ("solve/cg.rs", "mod inner { use super::super::super::mesh::Connectivity; }"),
        ("solve/cg.rs", "macro_rules! m { () => { $crate::mesh::TriMesh } }"),
        ("solve/cg.rs", "use crate::*;"),
        ("solve/mod.rs", "pub use crate::field::exact;"),
        ("io/ply.rs", "use crate::mesh::TriMesh;"),
        ("io/ply.rs", "pub(crate) use crate::TriMesh as Mesh;"),
        ("mesh/mod.rs", "use crate::{\n    error::{A, B},\n    field::order,\n};"),
        ("field/link.rs", "use crate::operators;"),
        ("solve/ordering/graph.rs", "use crate::mesh::TriMesh;"),
        ("render/scene.rs", "use crate::smooth::Smoother;"),
        ("error.rs", "use crate::io::MeshFormat;"),
        ("error.rs", "use crate::wasm;"),
        ("clock/mod.rs", "fn f() {}"),
        // Order.
        ("solve/ordering/graph.rs", "use super::super::matrix::norm;"),
        ("solve/ordering/graph.rs", "use super::super::length;"),
        ("solve/tree.rs", "use super::scalar::Scalar;"),
        ("solve/tree.rs", "use super::{matrix::norm, scalar::Scalar};"),
        ("solve/tree.rs", "use super::{matrix, cg};"),
        ("solve/tree.rs", "use crate::solve::scalar::Scalar;"),
        ("solve/tree.rs", "use crate::{error::Error, solve::{matrix, scalar}};"),
        ("solve/tree.rs", "use super::conjugate_gradient;"),
        ("solve/tree.rs", "fn f(x: impl super::scalar::Scalar) {}"),
        ("solve/tree.rs", "use super::cg as c;\nfn f() { c::conjugate_gradient() }"),
        ("solve/tree.rs", "use super::*;"),
        ("solve/lu.rs", "fn f() {}"),
        ("solve/iterative/mod.rs", "fn f() {}"),
        ("field/order.rs", "use super::critical::exact;"),
        ("field/order.rs", "use super::{critical::{exact}};"),
        ("field/order.rs", "use super::exact;"),
        ("field/order.rs", "use crate::field::persistence;"),
        ("field/persistence/loops.rs", "use crate::field::simplify::Keep;"),
        ("field/persistence/loops.rs", "use super::super::simplify::Keep;"),
        ("field/persistence/loops.rs", "use super::super::{order::VertexOrder, simplify::{self, Keep}};"),
        ("field/persistence/loops.rs", "fn f(k: crate::field::Keep) {}"),
        ("field/persistence/loops.rs", "use crate::field;\nfn f(k: field::Keep) {}"),
        ("field/persistence/merging.rs", "use super::loops::f;"),
        ("field/persistence/merging.rs", "use self::super::loops::f;"),
        ("field/persistence/merging.rs", "use super::persistence;"),
        ("field/reeb.rs", "fn f() {}"),
        ("smooth/routes/real.rs", "use crate::smooth::system::Solved;"),
        ("smooth/routes/real.rs", "use crate::Smoother;"),
        ("smooth/report.rs", "use super::tikhonov::TikhonovOptions;"),
        ("smooth/report.rs", "use super::{Smoother, TikhonovOptions as T};"),
        ("render/draw_list.rs", "use super::raster::paint;"),
        ("render/draw_list.rs", "use super::paint;"),
        // Circles, in a folder without an order and beyond.
        ("mesh/connectivity.rs", "use super::shapes::sphere;"),
        ("mesh/connectivity.rs", "fn f() { crate::mesh::shapes::sphere() }"),
        ("io/mod.rs", "mod ply;\nuse ply::read;\npub enum MeshFormat { Ply }\n// and\nuse crate::mesh::TriMesh;"),
        // Words.
        ("io/ply.rs", "use std::path::Path;"),
        ("io/ply.rs", "let x = std::fs::read(p);"),
        ("mesh/connectivity.rs", "positions: Vec<f64>,"),
        ("operators/mass.rs", "let x = angle.cos();"),
        ("smooth/report.rs", "let x = base.powi(3) * y.exp();"),
        ("smooth/report.rs", "let x = '\"'; let y = z.exp(); let w = '\"';"),
        ("smooth/report.rs", "let x = \"\n\"; let y = z.exp(); let w = \"\n\";"),
        ("solve/scalar.rs", "let x = a.mul_add(b, c);"),
        ("field/order.rs", "use std::collections::HashMap;"),
        ("smooth/mod.rs", "let t = std::time::Instant::now();"),
        ("smooth/mod.rs", "use wasm_bindgen::prelude::*;"),
        ("field/level/mod.rs", "use tiny_skia::Pixmap;"),
        ("wasm/mod.rs", "static mut STATE: u32 = 0;"),
        ("mesh/mod.rs", "#[path = \"../io/ply.rs\"]\nmod ply;"),
    ];
    for (path, source) in bad {
        let found = violations(&house_with(path, source), &SMALL);
        assert!(!found.is_empty(), "{path}: {source}");
    }
    let good = [
        ("solve/cg.rs", "use crate::error::SolveError; // as crate::mesh does\nlet x = \"crate::mesh \\\" sin(\";"),
        (
            "solve/cg.rs",
            "/* crate::mesh /* nested */ crate::mesh */ let x = r#\"crate::mesh \" \"#; let y = b\"crate::mesh\";",
        ),
        ("solve/cg.rs", "fn f<'mesh>(x: &'mesh str) -> &'mesh str { 'a: loop { break 'a; } }\nuse super::matrix;"),
        ("solve/cg.rs", "use std::mem::swap;\nuse nalgebra::{Complex, Scalar};\nfn f() -> f64 { f64::from(1) }"),
        ("solve/cg.rs", "pub(in crate::mesh) fn f() {}\nfn g() { <f64 as Default>::default(); }"),
        ("solve/cg.rs", "#[cfg(doc)]\nuse crate::mesh::TriMesh;"),
        ("solve/cg.rs", "fn f() -> impl Iterator + use<> {}\nuse super::{length, product};"),
        ("solve/cg.rs", "use crate::error::{Hidden, SolveError as Failed};"),
        ("solve/cg.rs", "mod inner { use super::super::matrix::norm; pub fn f() {} }\nuse inner::f;"),
        ("smooth/mod.rs", "use crate::{error::Result, mesh::{TriMesh, shapes}, solve::norm};\npub(crate) fn f() {}"),
        ("mesh/shapes.rs", "let x = u.cos();"),
        ("field/order.rs", "/// See `crate::smooth`.\nlet cosine = dot(a, b);"),
        ("field/simplify.rs", "use super::{persistence::{self, Merging}, order};\nfn f() { super::exact() }"),
        ("wasm/mod.rs", "use wasm_bindgen::prelude::*;\nuse crate::smooth::Smoother;"),
    ];
    for (path, source) in good {
        assert_eq!(violations(&house_with(path, source), &SMALL), Vec::<String>::new(), "{source}");
    }
}

fn files(sources: &[(&str, &str)]) -> Vec<(String, String)> {
    sources.iter().map(|&(path, source)| (path.to_owned(), source.to_owned())).collect()
}

/// A folder without an order; only circles are forbidden there.
const FREE: Rules = Rules { layers: &[("a", &[]), ("b", &["a"])], orders: &[], platform: &[], state: &[] };

#[test]
fn circles_are_found_without_a_table() {
    let circle = [
        ("a/mod.rs", "mod x;\nmod y;\nmod z;\npub use z::Z;"),
        ("a/x.rs", "use super::y::Y;\npub struct X;"),
        ("a/y.rs", "use super::Z;\npub struct Y;"),
        ("a/z.rs", "pub struct Z(super::x::X);"),
        ("b.rs", "use crate::a::Z;"),
    ];
    let found = violations(&files(&circle), &FREE);
    let expected = "a circle: a/x.rs:1 uses a/y.rs (`super::y::Y`); a/y.rs:1 uses a/z.rs (`super::Z`); \
                    a/z.rs:1 uses a/x.rs (`super::x::X`)";
    assert_eq!(found, [expected]);

    // What a `mod.rs` merely hands on is no use by it; what it uses itself is.
    let hands_on = [
        ("a/mod.rs", "mod x;\npub const NONE: u32 = 0;\npub use x::X;"),
        ("a/x.rs", "use super::NONE;\npub struct X;"),
    ];
    assert_eq!(violations(&files(&hands_on), &FREE), Vec::<String>::new());
    let uses = [
        ("a/mod.rs", "mod x;\npub const NONE: u32 = 0;\npub use x::X;\npub struct Pair(X, X);"),
        ("a/x.rs", "use super::NONE;\npub struct X;"),
    ];
    assert_eq!(violations(&files(&uses), &FREE).len(), 1);
    let names =
        [("a/mod.rs", "mod x;\npub const NONE: u32 = x::SOME;"), ("a/x.rs", "pub const SOME: u32 = super::NONE;")];
    assert_eq!(violations(&files(&names), &FREE).len(), 1);

    // Two circles that share no file are two.
    let two = [
        ("a/mod.rs", ""),
        ("a/x.rs", "use super::y::Y;"),
        ("a/y.rs", "use super::x::X;"),
        ("a/z.rs", "use super::w::W;"),
        ("a/w.rs", "use super::z::Z;"),
    ];
    assert_eq!(violations(&files(&two), &FREE).len(), 2);
}

#[test]
fn names_are_followed_to_the_file_that_declares_them() {
    let sources = [
        ("a/mod.rs", "mod x;\nmod y;\npub use x::{deep::Deep as Renamed, x};\npub use y::*;"),
        ("a/x/mod.rs", "pub mod deep;\npub fn x() {}"),
        ("a/x/deep.rs", "pub struct Deep;"),
        ("a/y.rs", "pub struct Y;\nmod inner { pub struct Z; }\npub use inner::Z;"),
        (
            "b.rs",
            "use crate::a::{self, Renamed, x};\nfn f() { a::x(); a::Renamed::new(); a::Y; a::Z; super::a::missing(); }",
        ),
    ];
    let edges = Crate::new(&files(&sources)).edges();
    let mut found: Vec<(&str, &str, bool)> = edges
        .iter()
        .filter(|edge| edge.from == "b.rs")
        .map(|e| (e.path.as_str(), e.to.as_str(), e.is_folder))
        .collect();
    found.sort_unstable();
    let expected = [
        ("a::Renamed::new", "a/x/deep.rs", false),
        ("a::Y", "a/y.rs", false),
        ("a::Z", "a/y.rs", false),
        ("a::x", "a/x/mod.rs", false),
        ("crate::a", "a/mod.rs", true),
        ("crate::a::Renamed", "a/x/deep.rs", false),
        ("crate::a::x", "a/x/mod.rs", false),
        ("super::a::missing", "a/mod.rs", false),
    ];
    assert_eq!(found, expected);
}

#[test]
fn tables_name_what_is_there() {
    assert_eq!(strangers(&house_with("error.rs", ""), &SMALL), Vec::<String>::new());
    let files: Vec<_> =
        house_with("lib.rs", "").into_iter().filter(|(path, _)| !path.starts_with("solve/tr")).collect();
    assert_eq!(strangers(&files, &SMALL), ["solve/tree"]);
}
