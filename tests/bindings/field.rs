//! Meshes, what is read in a field, and operators.

use js_sys::{Array, Int8Array, Uint32Array};
use morse_smooth::field::{self, CriticalKind, DeltaOptions, Keep, LinkReading, PathStyle, ScalarField, Threshold};
use morse_smooth::mesh::shapes::{self};
use morse_smooth::wasm::{RawTriMesh, version};
use morse_smooth::{Watch, operators};
use wasm_bindgen::prelude::*;
use wasm_bindgen_test::wasm_bindgen_test;

use crate::support::{NONE, array, bytes, floats, get, ids, int8s, js, noise, number, raw, thrown, torus};

#[wasm_bindgen_test]
fn version_is_the_package() {
    assert_eq!(version(), env!("CARGO_PKG_VERSION"));
}

#[wasm_bindgen_test]
fn meshes_go_in_and_come_out_as_copies() {
    let mesh = torus();
    let positions = array(mesh.positions());
    let triangles = Uint32Array::from(mesh.connectivity().triangles().as_flattened());
    let raw = RawTriMesh::new(&positions, &triangles, &NONE).ok().expect("a mesh");
    positions.fill(7.0, 0, positions.length());
    triangles.fill(7, 0, triangles.length());
    assert_eq!(raw.positions().to_vec(), mesh.positions());
    assert_eq!(raw.triangles().to_vec(), mesh.connectivity().triangles().as_flattened());
    raw.positions().fill(7.0, 0, 3);
    assert_eq!(raw.positions().to_vec(), mesh.positions(), "what comes out is a copy too");
    assert_eq!((raw.vertex_count(), raw.edge_count(), raw.triangle_count()), (108, 324, 216));
    assert_eq!(raw.area(), mesh.area());
    let topology = raw.topology().ok().expect("enough memory");
    for (name, value) in [("eulerCharacteristic", 0.0), ("components", 1.0), ("boundaryLoops", 0.0), ("genus", 1.0)] {
        assert_eq!(number(&topology, name), value, "{name}");
    }
    assert_eq!(get(&topology, "closed"), JsValue::TRUE);
    let klein = crate::support::raw(&shapes::klein_bottle(7, 6).expect("a bottle"));
    assert!(get(&klein.topology().ok().expect("enough memory"), "genus").is_null(), "no genus is null, not undefined");
    assert_eq!(Array::from(&raw.warnings()).length(), 0);
}

#[wasm_bindgen_test]
fn warnings_and_welding() {
    let soup = array(&[0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., 9., 9., 9.]);
    let triangles = Uint32Array::from(&[0, 1, 2, 3, 4, 5, 6, 6, 0][..]);
    let apart = RawTriMesh::new(&soup, &triangles, &NONE).ok().expect("a mesh");
    let warnings = Array::from(&apart.warnings());
    let codes: Vec<String> = warnings.iter().map(|w| get(&w, "code").as_string().expect("a code")).collect();
    assert_eq!(codes, ["DegenerateTriangle", "IsolatedVertex"]);
    assert_eq!(number(&warnings.get(0), "count"), 1.0);
    assert_eq!(Array::from(&get(&warnings.get(1), "examples")).get(0), JsValue::from_f64(6.0));
    let welded = RawTriMesh::new(&soup, &triangles, &js("{ weld: true }")).ok().expect("a mesh");
    assert_eq!((apart.vertex_count(), welded.vertex_count()), (7, 5));
}

#[wasm_bindgen_test]
fn critical_points_are_those_of_rust() {
    let mesh = torus();
    let f = noise(mesh.vertex_count());
    let field = ScalarField::new(&mesh, &f).expect("a field");
    for (text, options) in [
        ("undefined", DeltaOptions::default()),
        ("null", DeltaOptions::default()),
        ("{}", DeltaOptions::default()),
        (
            "{ delta: 0.1, link: 'skip' }",
            DeltaOptions { delta: 0.1, link: LinkReading::Skip, ..DeltaOptions::default() },
        ),
        (
            "{ delta: 0.3, deltaIs: 'absolute', link: 'consecutive', rule: 'literal' }",
            DeltaOptions {
                delta: 0.3,
                scale: field::DeltaScale::Absolute,
                link: LinkReading::Consecutive,
                rule: field::ExtremumRule::Literal,
            },
        ),
    ] {
        let found: JsValue = raw(&mesh).critical_points(&array(&f), &js(text)).ok().expect("a field").into();
        let expected = field::critical_points(&field, &options, &Watch::none()).expect("a field");
        let kinds = get(&found, "kinds").dyn_into::<Int8Array>().expect("an Int8Array").to_vec();
        let sign = |kind| match kind {
            CriticalKind::Minimum => -1,
            CriticalKind::Saddle => 0,
            CriticalKind::Maximum => 1,
        };
        assert_eq!(ids(&found, "vertices"), expected.points.iter().map(|p| p.vertex).collect::<Vec<_>>());
        assert_eq!(kinds, expected.points.iter().map(|p| sign(p.kind)).collect::<Vec<_>>());
        assert_eq!(ids(&found, "multiplicities"), expected.points.iter().map(|p| p.multiplicity).collect::<Vec<_>>());
        assert_eq!(bytes(&found, "onBoundary").len(), kinds.len());
        let counts = get(&found, "counts");
        let of = |name| number(&counts, name) as u32;
        assert_eq!((of("minima"), of("maxima"), of("saddles")), {
            let c = expected.counts;
            (c.minima, c.maxima, c.saddles)
        });
        assert_eq!(get(&counts, "indexSum").as_f64(), expected.counts.index_sum.map(|sum| sum as f64));
    }
}

#[wasm_bindgen_test]
fn level_sets_by_list_and_by_number() {
    let mesh = raw(&shapes::grid(5, 5).expect("a grid"));
    let f: Vec<f64> = mesh.positions().to_vec().chunks_exact(3).map(|p| p[0]).collect();
    let listed: JsValue = mesh.level_sets(&array(&f), &array(&[0.25, 0.5, 0.75]).into()).ok().expect("lines").into();
    let counted: JsValue = mesh.level_sets(&array(&f), &js("{ count: 3 }")).ok().expect("lines").into();
    for sets in [&listed, &counted] {
        assert_eq!(floats(sets, "levels"), [0.25, 0.5, 0.75]);
        assert_eq!(bytes(sets, "closed"), [0, 0, 0]);
        let points = *ids(sets, "offsets").last().expect("offsets") as usize;
        assert_eq!(floats(sets, "points").len(), 3 * points);
        assert_eq!((ids(sets, "edges").len(), floats(sets, "parameters").len()), (2 * points, points));
    }
    assert_eq!(floats(&listed, "points"), floats(&counted, "points"));
    for bad in [
        "undefined",
        "{}",
        "{ count: -1 }",
        "{ count: 1.5 }",
        "{ count: 'many' }",
        "{ counts: 3 }",
        "[0.5]",
        "3",
        "{ count: 1e9 }",
    ] {
        let (code, message, _) = thrown(mesh.level_sets(&array(&f), &js(bad)));
        assert!(["InvalidArgument", "InvalidOption", "UnknownOption"].contains(&code.as_str()), "{bad}: {code}");
        assert!(!message.contains("JsValue"), "{bad}: {message}");
    }
}

#[wasm_bindgen_test]
fn persistence_and_simplification_are_those_of_rust() {
    let mesh = torus();
    let (given, f) = (raw(&mesh), noise(mesh.vertex_count()));
    let field = ScalarField::new(&mesh, &f).expect("a field");
    let diagram = field::persistence(&field, &Watch::none()).expect("a field");
    let found: JsValue = given.persistence(&array(&f)).ok().expect("a field").into();
    let pairs = &diagram.pairs;
    assert!(pairs.len() > 10, "{}", pairs.len());
    assert_eq!(ids(&found, "extrema"), pairs.iter().map(|p| p.extremum).collect::<Vec<_>>());
    assert_eq!(ids(&found, "saddles"), pairs.iter().map(|p| p.saddle).collect::<Vec<_>>());
    let sign = |kind| if kind == CriticalKind::Minimum { -1 } else { 1 };
    assert_eq!(int8s(&found, "kinds"), pairs.iter().map(|p| sign(p.kind)).collect::<Vec<_>>());
    assert_eq!(floats(&found, "birth"), pairs.iter().map(|p| p.birth).collect::<Vec<_>>());
    assert_eq!(floats(&found, "death"), pairs.iter().map(|p| p.death).collect::<Vec<_>>());
    assert_eq!(floats(&found, "persistence"), pairs.iter().map(|p| p.persistence).collect::<Vec<_>>());
    assert_eq!(ids(&found, "essentialMinima"), diagram.essential_minima);
    assert_eq!(ids(&found, "essentialMaxima"), diagram.essential_maxima);
    assert_eq!(ids(&found, "essentialSaddles"), diagram.essential_saddles);
    let curve: JsValue = given.persistence_curve(&array(&f)).ok().expect("a field").into();
    let expected = diagram.curve();
    assert_eq!(floats(&curve, "threshold"), expected.threshold);
    assert_eq!((ids(&curve, "minima"), ids(&curve, "maxima")), (expected.minima, expected.maxima));

    let kept = [diagram.essential_minima[0], diagram.essential_maxima[0], pairs[0].extremum];
    for (text, keep) in [
        ("{ threshold: 0.2 }".to_owned(), Keep::Above(Threshold::Relative(0.2))),
        ("{ threshold: 0.2, thresholdIs: 'absolute', keep: null }".to_owned(), Keep::Above(Threshold::Absolute(0.2))),
        (format!("{{ keep: new Uint32Array({kept:?}) }}"), Keep::Extrema(&kept)),
    ] {
        let simple = given.simplify(&array(&f), &js(&text)).ok().expect("a field").to_vec();
        assert_eq!(simple, field::simplify(&field, keep, &Watch::none()).expect("a field").values, "{text}");
    }
    for (text, code, name) in [
        ("undefined", "InvalidOption", "threshold"),
        ("{ threshold: -1 }", "InvalidOption", "threshold"),
        ("{ threshold: NaN }", "InvalidOption", "threshold"),
        ("{ threshold: '1' }", "InvalidOption", "threshold"),
        ("{ threshold: 1, thresholdIs: 'other' }", "InvalidOption", "thresholdIs"),
        ("{ keep: 5 }", "InvalidOption", "keep"),
        ("{ keep: new Uint32Array(1), threshold: 1 }", "InapplicableOption", "threshold"),
        ("{ keep: new Uint32Array(1), thresholdIs: 'relative' }", "InapplicableOption", "thresholdIs"),
        ("{ delta: 1 }", "UnknownOption", "delta"),
    ] {
        let (found, message, detail) = thrown(given.simplify(&array(&f), &js(text)));
        assert_eq!((found.as_str(), get(&detail, "option").as_string().as_deref()), (code, Some(name)), "{message}");
    }
    for (text, code) in [
        (format!("{{ keep: new Uint32Array([{}]) }}", kept[0]), "Unconstrained"),
        (format!("{{ keep: new Uint32Array([{}]) }}", pairs[0].saddle), "NotAnExtremum"),
        ("{ keep: new Uint32Array([108]) }".to_owned(), "IndexOutOfBounds"),
    ] {
        assert_eq!(thrown(given.simplify(&array(&f), &js(&text))).0, code, "{text}");
    }
}

#[wasm_bindgen_test]
fn the_morse_complex_is_that_of_rust() {
    let mesh = torus();
    let (given, f) = (raw(&mesh), noise(mesh.vertex_count()));
    let field = ScalarField::new(&mesh, &f).expect("a field");
    let sign = |kind| match kind {
        CriticalKind::Minimum => -1,
        CriticalKind::Saddle => 0,
        CriticalKind::Maximum => 1,
    };
    for (text, persistence, style) in
        [("undefined", 0.0, PathStyle::Whole), ("{ persistence: 0.2, paths: 'merged' }", 0.2, PathStyle::Merged)]
    {
        let expected =
            field::morse_complex(&field, Threshold::Relative(persistence), style, &Watch::none()).expect("a field");
        let found: JsValue = given.morse_complex(&array(&f), &js(text)).ok().expect("a field").into();
        let points: Vec<f64> = expected.vertices.iter().flat_map(|&v| mesh.position(v)).collect();
        assert_eq!(floats(&found, "points"), points);
        assert_eq!(int8s(&found, "kinds"), expected.kinds.iter().map(|&kind| sign(kind)).collect::<Vec<_>>());
        assert_eq!((ids(&found, "offsets"), ids(&found, "vertices")), (expected.offsets, expected.vertices));
        assert_eq!((ids(&found, "saddles"), ids(&found, "extrema")), (expected.saddles, expected.extrema));
    }
    let hierarchy = field::morse_hierarchy(&field, &Watch::none()).expect("a field");
    let found: JsValue = given.morse_hierarchy(&array(&f)).ok().expect("a field").into();
    let nodes = &hierarchy.nodes;
    assert_eq!(ids(&found, "vertices"), nodes.iter().map(|node| node.vertex).collect::<Vec<_>>());
    assert_eq!(int8s(&found, "kinds"), nodes.iter().map(|node| sign(node.kind)).collect::<Vec<_>>());
    assert_eq!(floats(&found, "cancelledAt"), nodes.iter().map(|node| node.cancelled_at).collect::<Vec<_>>());
    assert_eq!(ids(&found, "partners"), nodes.iter().map(|node| node.partner).collect::<Vec<_>>());
    assert_eq!(ids(&found, "into"), nodes.iter().map(|node| node.into).collect::<Vec<_>>());
    assert_eq!(ids(&found, "arcs"), hierarchy.arcs.as_flattened());
    for (text, persistence) in [("undefined", 0.0), ("{ persistence: 0.2 }", 0.2)] {
        let expected = field::basins(&field, Threshold::Relative(persistence), &Watch::none()).expect("a field");
        let found: JsValue = given.basins(&array(&f), &js(text)).ok().expect("a field").into();
        assert_eq!((ids(&found, "descending"), ids(&found, "ascending")), (expected.descending, expected.ascending));
    }
    for (text, code) in [
        ("{ persistence: -1 }", "InvalidOption"),
        ("{ persistence: 'much' }", "InvalidOption"),
        ("{ threshold: 1 }", "UnknownOption"),
        ("5", "InvalidArgument"),
    ] {
        assert_eq!(thrown(given.morse_complex(&array(&f), &js(text))).0, code, "{text}");
        assert_eq!(thrown(given.basins(&array(&f), &js(text))).0, code, "{text}");
    }
    assert_eq!(thrown(given.morse_complex(&array(&f), &js("{ paths: 'short' }"))).0, "InvalidOption");
}

#[wasm_bindgen_test]
fn matrices_come_as_compressed_columns() {
    let mesh = torus();
    let given = raw(&mesh);
    let expected = operators::galerkin_mass(&mesh, operators::MassScale::Raw).expect("an area");
    let found = given.mass(&js("{ kind: 'galerkin', massScale: 'raw' }")).ok().expect("an area");
    assert_eq!((number(&found, "rows"), number(&found, "columns")), (108.0, 108.0));
    assert_eq!(floats(&found, "values"), expected.values());
    let narrow = |values: &[usize]| values.iter().map(|&v| v as u32).collect::<Vec<u32>>();
    assert_eq!(ids(&found, "rowIndices"), narrow(expected.row_indices()));
    assert_eq!(ids(&found, "columnPointers"), narrow(expected.col_offsets()));
    let lumped = given.mass(&js("{ kind: 'lumped' }")).ok().expect("an area");
    assert!((floats(&lumped, "values").iter().sum::<f64>() - 108.0).abs() < 1e-10);
    let mean_value = given.laplacian(&js("{ weights: 'meanValue' }")).ok().expect("weights");
    assert_eq!(floats(&mean_value, "values"), operators::mean_value_laplacian(&mesh).expect("weights").values());
    let energies = given.smoothness(&array(mesh.positions()).slice(0, 108), &NONE).ok().expect("a field");
    assert!(number(&energies, "sobolev") > 0.0 && number(&energies, "laplacianNorm") > 0.0);
}
