//! The exported classes and functions, called with JavaScript values: `wasm-pack test --node -- --features wasm`.
#![cfg(all(target_arch = "wasm32", feature = "wasm"))]
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a test fails by panicking")]

use js_sys::{Array, Float64Array, Function, Int8Array, Object, Reflect, Uint8Array, Uint32Array};
use morse_smooth::field::{self, CriticalKind, DeltaOptions, Features, Keep, LinkReading, PathStyle, Threshold};
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators;
use morse_smooth::smooth::{
    BilateralOptions, Constraints, Energy, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Operator,
    Precision, Smoothed, Smoother, SmootherOptions, TikhonovOptions, Unconstrained, constrained_vertices,
    epsilon_for_wavelength,
};
use morse_smooth::wasm::{RawSmoother, RawTriMesh, Thrown, read_field, read_mesh, smooth, version, write_mesh};
use wasm_bindgen::prelude::*;
use wasm_bindgen_test::wasm_bindgen_test;

const NONE: JsValue = JsValue::UNDEFINED;

/// An object from a piece of JavaScript.
fn js(text: &str) -> JsValue {
    Function::new_no_args(&format!("return ({text})")).call0(&JsValue::NULL).expect("an expression")
}

fn get(object: &JsValue, name: &str) -> JsValue {
    let value = Reflect::get(object, &JsValue::from_str(name)).expect("an object");
    assert!(!value.is_undefined(), "`{name}` is missing");
    value
}

fn floats(object: &JsValue, name: &str) -> Vec<f64> {
    get(object, name).dyn_into::<Float64Array>().expect("a Float64Array").to_vec()
}

fn ids(object: &JsValue, name: &str) -> Vec<u32> {
    get(object, name).dyn_into::<Uint32Array>().expect("a Uint32Array").to_vec()
}

fn int8s(object: &JsValue, name: &str) -> Vec<i8> {
    get(object, name).dyn_into::<Int8Array>().expect("an Int8Array").to_vec()
}

fn bytes(object: &JsValue, name: &str) -> Vec<u8> {
    get(object, name).dyn_into::<Uint8Array>().expect("a Uint8Array").to_vec()
}

fn number(object: &JsValue, name: &str) -> f64 {
    get(object, name).as_f64().unwrap_or_else(|| panic!("`{name}` is no number"))
}

/// What was thrown: `{ code, message, detail }`.
fn thrown<T>(result: Result<T, Thrown>) -> (String, String, JsValue) {
    let error: JsValue = match result {
        Ok(_) => panic!("accepted"),
        Err(error) => error.into(),
    };
    let text = |name| get(&error, name).as_string().expect("a text");
    assert!(!text("message").is_empty());
    assert!(get(&error, "detail").is_object());
    (text("code"), text("message"), get(&error, "detail"))
}

fn torus() -> TriMesh {
    shapes::torus(12, 9, 0.3).expect("a torus")
}

fn raw(mesh: &TriMesh) -> RawTriMesh {
    let positions = Float64Array::from(mesh.positions());
    let triangles = Uint32Array::from(mesh.connectivity().triangles().as_flattened());
    RawTriMesh::new(&positions, &triangles, &NONE).ok().expect("a mesh")
}

fn noise(n: usize) -> Vec<f64> {
    let mut random = Random::new(5);
    (0..n).map(|_| random.signed()).collect()
}

fn array(values: &[f64]) -> Float64Array {
    Float64Array::from(values)
}

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
    let topology = raw.topology();
    for (name, value) in [("eulerCharacteristic", 0.0), ("components", 1.0), ("boundaryLoops", 0.0), ("genus", 1.0)] {
        assert_eq!(number(&topology, name), value, "{name}");
    }
    assert_eq!(get(&topology, "closed"), JsValue::TRUE);
    let klein = crate::raw(&shapes::klein_bottle(7, 6).expect("a bottle"));
    assert!(get(&klein.topology(), "genus").is_null(), "no genus is null, not undefined");
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
    use morse_smooth::field::critical_points;
    let mesh = torus();
    let f = noise(mesh.vertex_count());
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
        let expected = critical_points(&mesh, &f, &options).expect("a field");
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
    let diagram = field::persistence(&mesh, &f).expect("a field");
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
        assert_eq!(simple, field::simplify(&mesh, &f, keep).expect("a field"), "{text}");
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
    let sign = |kind| match kind {
        CriticalKind::Minimum => -1,
        CriticalKind::Saddle => 0,
        CriticalKind::Maximum => 1,
    };
    for (text, persistence, style) in
        [("undefined", 0.0, PathStyle::Whole), ("{ persistence: 0.2, paths: 'merged' }", 0.2, PathStyle::Merged)]
    {
        let expected = field::morse_complex(&mesh, &f, Threshold::Relative(persistence), style).expect("a field");
        let found: JsValue = given.morse_complex(&array(&f), &js(text)).ok().expect("a field").into();
        let points: Vec<f64> = expected.vertices.iter().flat_map(|&v| mesh.position(v)).collect();
        assert_eq!(floats(&found, "points"), points);
        assert_eq!(int8s(&found, "kinds"), expected.kinds.iter().map(|&kind| sign(kind)).collect::<Vec<_>>());
        assert_eq!((ids(&found, "offsets"), ids(&found, "vertices")), (expected.offsets, expected.vertices));
        assert_eq!((ids(&found, "saddles"), ids(&found, "extrema")), (expected.saddles, expected.extrema));
    }
    let hierarchy = field::morse_hierarchy(&mesh, &f).expect("a field");
    let found: JsValue = given.morse_hierarchy(&array(&f)).ok().expect("a field").into();
    let nodes = &hierarchy.nodes;
    assert_eq!(ids(&found, "vertices"), nodes.iter().map(|node| node.vertex).collect::<Vec<_>>());
    assert_eq!(int8s(&found, "kinds"), nodes.iter().map(|node| sign(node.kind)).collect::<Vec<_>>());
    assert_eq!(floats(&found, "cancelledAt"), nodes.iter().map(|node| node.cancelled_at).collect::<Vec<_>>());
    assert_eq!(ids(&found, "partners"), nodes.iter().map(|node| node.partner).collect::<Vec<_>>());
    assert_eq!(ids(&found, "into"), nodes.iter().map(|node| node.into).collect::<Vec<_>>());
    assert_eq!(ids(&found, "arcs"), hierarchy.arcs.as_flattened());
    for (text, persistence) in [("undefined", 0.0), ("{ persistence: 0.2 }", 0.2)] {
        let expected = field::basins(&mesh, &f, Threshold::Relative(persistence)).expect("a field");
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

#[wasm_bindgen_test]
fn smoothing_is_that_of_rust() {
    let mesh = torus();
    let f = noise(mesh.vertex_count());
    let mut native = Smoother::new(&mesh, SmootherOptions::default()).expect("cotangents");
    let expected =
        native.tikhonov(&f, &TikhonovOptions { epsilon: 0.3, ..TikhonovOptions::default() }).expect("a solution");
    let mut smoother = RawSmoother::new(&raw(&mesh), &NONE).ok().expect("cotangents");
    let long: JsValue = smoother.tikhonov(&array(&f), &js("{ epsilon: 0.3 }")).ok().expect("a solution").into();
    let short: JsValue = smooth(&raw(&mesh), &array(&f), &js("{ epsilon: 0.3 }")).ok().expect("a solution").into();
    for found in [&long, &short] {
        assert_eq!(floats(found, "values"), expected.values);
        let (report, wanted) = (get(found, "report"), &expected.reports[0]);
        for (name, value) in [
            ("epsilon", 0.3),
            ("lInfinity", wanted.l_infinity),
            ("l2", wanted.l2),
            ("metricNorm", wanted.metric_norm),
            ("laplacianNorm", wanted.laplacian_norm),
            ("sobolevBefore", wanted.sobolev_before),
            ("sobolevAfter", wanted.sobolev_after),
        ] {
            assert_eq!(number(&report, name), value, "{name}");
        }
        assert_eq!(number(&get(&report, "after"), "indexSum"), 0.0);
        assert!(get(&report, "preserved").is_null());
        assert_eq!(get(&get(&report, "solver"), "route"), JsValue::from_str("cholesky"));
        assert_eq!(Array::from(&get(found, "reports")).length(), 1);
    }
    let twice: Vec<f64> = f.iter().flat_map(|&x| [x, -x]).collect();
    let found: JsValue =
        smoother.tikhonov(&array(&twice), &js("{ epsilon: 0.3, channels: 2 }")).ok().expect("a solution").into();
    assert_eq!(Array::from(&get(&found, "reports")).length(), 2);
    let first: Vec<f64> = floats(&found, "values").into_iter().step_by(2).collect();
    assert!(first.iter().zip(&expected.values).all(|(a, b)| (a - b).abs() < 1e-13));
}

#[wasm_bindgen_test]
fn finite_elements_and_single_precision_are_those_of_rust() {
    let mesh = torus();
    let f = noise(mesh.vertex_count());
    for (text, precision) in [("double", Precision::Double), ("single", Precision::Single)] {
        let options = SmootherOptions { operator: Operator::Fem, precision, ..SmootherOptions::default() };
        let epsilon = epsilon_for_wavelength(0.7).expect("a length");
        let mut native = Smoother::new(&mesh, options).expect("cotangents");
        let expected =
            native.tikhonov(&f, &TikhonovOptions { epsilon, ..TikhonovOptions::default() }).expect("a solution");
        let given = js(&format!("{{ operator: 'fem', precision: '{text}' }}"));
        let mut smoother = RawSmoother::new(&raw(&mesh), &given).ok().expect("cotangents");
        let wavelength = js("{ cutoffWavelength: 0.7 }");
        let long: JsValue = smoother.tikhonov(&array(&f), &wavelength).ok().expect("a solution").into();
        let all: JsValue = Object::<JsValue>::assign(given.unchecked_ref(), wavelength.unchecked_ref()).into();
        let short: JsValue = smooth(&raw(&mesh), &array(&f), &all).ok().expect("a solution").into();
        for found in [&long, &short] {
            assert_eq!(floats(found, "values"), expected.values);
            let report = get(found, "report");
            assert_eq!(number(&report, "epsilon"), epsilon);
            assert_eq!(get(&report, "equation"), JsValue::from_str("fem"));
            let solver = get(&report, "solver");
            assert_eq!(get(&solver, "route"), JsValue::from_str("complexCholesky"));
            assert_eq!(get(&solver, "precision"), JsValue::from_str(text));
            assert_eq!(number(&solver, "factorNonzeros"), expected.reports[0].solver.factor_nonzeros as f64);
        }
        for (text, code, named) in [
            ("{ cutoffWavelength: 0.7, epsilon: 1 }", "InapplicableOption", "epsilon"),
            ("{ cutoffWavelength: 0.7, metric: 'mass' }", "InapplicableOption", "metric"),
            ("{ epsilon: 1, massScale: 'raw' }", "InapplicableOption", "massScale"),
            ("{ cutoffWavelength: 0 }", "InvalidOption", "cutoffWavelength"),
            ("{ cutoffWavelength: '1' }", "InvalidOption", "cutoffWavelength"),
        ] {
            let (found, message, detail) = thrown(smoother.tikhonov(&array(&f), &js(text)));
            assert_eq!(
                (found.as_str(), get(&detail, "option").as_string().as_deref()),
                (code, Some(named)),
                "{message}"
            );
        }
        let again: JsValue = smoother.tikhonov(&array(&f), &wavelength).ok().expect("a solution").into();
        assert_eq!(floats(&again, "values"), expected.values);
    }
    let mut papers = RawSmoother::new(&raw(&mesh), &NONE).ok().expect("cotangents");
    assert_eq!(thrown(papers.tikhonov(&array(&f), &js("{ cutoffWavelength: 1 }"))).0, "InapplicableOption");
}

#[wasm_bindgen_test]
fn constraints_are_those_of_rust() {
    let mesh = torus();
    let (given, f) = (raw(&mesh), noise(mesh.vertex_count()));
    let mut native = Smoother::new(&mesh, SmootherOptions { bounds: true, ..SmootherOptions::default() }).expect("one");
    let mut smoother = RawSmoother::new(&given, &js("{ bounds: true }")).ok().expect("cotangents");
    let skip = DeltaOptions { delta: 0.2, link: LinkReading::Skip, ..DeltaOptions::default() };
    for (text, features, stars) in [
        ("new Uint32Array([5, 70, 5])", Features::Vertices(&[5, 70, 5]), false),
        ("{ from: 'vertices', vertices: new Uint32Array([5, 70]) }", Features::Vertices(&[5, 70]), true),
        ("{ from: 'criticalPoints', delta: 0.2, link: 'skip' }", Features::CriticalPoints(skip), true),
        ("{ from: 'persistence', threshold: 0.5 }", Features::Persistence(Threshold::Relative(0.5)), true),
        (
            "{ from: 'persistence', threshold: 0.5, thresholdIs: 'absolute', stars: false }",
            Features::Persistence(Threshold::Absolute(0.5)),
            false,
        ),
        ("{ from: 'kMeans', clusters: 7, seed: 3 }", Features::KMeans { clusters: 7, seed: 3 }, true),
    ] {
        let constraints = Constraints { features, stars, unconstrained: Unconstrained::Error };
        let wanted = constrained_vertices(&mesh, &f, 1, &constraints).expect("vertices");
        let found = given.constrained_vertices(&array(&f), &js(text), &NONE).ok().expect("vertices");
        assert_eq!(found.to_vec(), wanted, "{text}");

        let options = InterpolateOptions { constraints, energy: Energy::Biharmonic, channels: 1 };
        let wanted = native.interpolate(&f, &options).expect("a solution");
        let given_options = js(&format!("{{ constraints: {text}, energy: 'biharmonic' }}"));
        let found: JsValue = smoother.interpolate(&array(&f), &given_options).ok().expect("a solution").into();
        check_constrained(&found, &wanted, text);

        let options = LeastSquaresOptions { constraints, epsilon: 0.5, weights: None, channels: 1 };
        let wanted = native.least_squares(&f, &options).expect("a solution");
        let given_options = js(&format!("{{ constraints: {text}, epsilon: 0.5 }}"));
        let found: JsValue = smoother.least_squares(&array(&f), &given_options, None).ok().expect("a solution").into();
        check_constrained(&found, &wanted, text);
        Reflect::set(&given_options, &"bounds".into(), &JsValue::TRUE).expect("an object");
        let found: JsValue = smooth(&given, &array(&f), &given_options).ok().expect("a solution").into();
        check_constrained(&found, &wanted, text);
    }
    let weights = array(&[1.0, 2.0]);
    let options = js("{ constraints: new Uint32Array([5, 70]), epsilon: 0.5 }");
    assert!(smoother.least_squares(&array(&f), &options, Some(weights)).is_ok());
    let (code, message, detail) = thrown(smoother.least_squares(&array(&f), &options, Some(array(&[1.0, 0.0]))));
    assert_eq!((code.as_str(), number(&detail, "vertex")), ("InvalidWeight", 70.0), "{message}");
    let nested = js("{ constraints: { from: 'criticalPoints', delta: -1 } }");
    let (code, message, detail) = thrown(smoother.interpolate(&array(&f), &nested));
    assert_eq!((code.as_str(), get(&detail, "option")), ("InvalidOption", "constraints.delta".into()), "{message}");
}

/// What JavaScript got beside what Rust gets.
fn check_constrained(found: &JsValue, wanted: &Smoothed, context: &str) {
    assert_eq!(floats(found, "values"), wanted.values, "{context}");
    let (report, wanted) = (get(found, "report"), &wanted.reports[0]);
    assert_eq!(get(&report, "method"), JsValue::from_str(wanted.method));
    for (name, value) in [
        ("constraintCount", Some(wanted.constraint_count as f64)),
        ("constrainedCriticalPoints", wanted.constrained_critical_points.map(|count| count as f64)),
        ("preserved", wanted.preserved.map(|count| count as f64)),
        ("freeExtrema", wanted.free_extrema.map(|count| count as f64)),
        ("perturbationFactor", wanted.perturbation_factor),
        ("metricNorm", Some(wanted.metric_norm)),
    ] {
        assert_eq!(get(&report, name).as_f64(), value, "{context}: {name}");
        assert!(value.is_some(), "{context}: {name}");
    }
    assert!(get(&report, "maximumPrinciple").is_null());
}

#[wasm_bindgen_test]
fn filters_are_those_of_rust() {
    let mesh = torus();
    let f = noise(mesh.vertex_count());
    let mut native = Smoother::new(&mesh, SmootherOptions::default()).expect("cotangents");
    let mut smoother = RawSmoother::new(&raw(&mesh), &NONE).ok().expect("cotangents");
    let taubin = LowPassOptions { iterations: 7, lambda: 0.4, mu: -0.45, channels: 1 };
    let wanted = native.low_pass(&f, &taubin).expect("steps");
    let given = js("{ iterations: 7, lambda: 0.4, mu: -0.45 }");
    let found: JsValue = smoother.low_pass(&array(&f), &given).ok().expect("steps").into();
    assert_eq!(floats(&found, "values"), wanted.values);
    let plain = LowPassOptions { iterations: 3, ..LowPassOptions::default() };
    let wanted = native.low_pass(&f, &plain).expect("steps");
    let found: JsValue = smoother.low_pass(&array(&f), &js("{ iterations: 3 }")).ok().expect("steps").into();
    assert_eq!(floats(&found, "values"), wanted.values);
    let options = BilateralOptions { iterations: 2, radius: 0.6, sigma_distance: 0.3, sigma_value: 0.7, channels: 1 };
    let wanted = native.bilateral(&f, &options).expect("steps");
    let given = js("{ iterations: 2, radius: 0.6, sigmaDistance: 0.3, sigmaValue: 0.7 }");
    let found: JsValue = smoother.bilateral(&array(&f), &given).ok().expect("steps").into();
    // To the last bit: the exponential function is not the platform's.
    assert_eq!(floats(&found, "values"), wanted.values);
    assert_eq!(number(&get(&get(&found, "report"), "solver"), "iterations"), 2.0);
    for text in ["undefined", "{}", "{ iterations: -1 }", "{ iterations: 1, lambda: 2, radius: 0 }"] {
        let codes =
            [thrown(smoother.low_pass(&array(&f), &js(text))).0, thrown(smoother.bilateral(&array(&f), &js(text))).0];
        assert!(codes.iter().all(|code| ["InvalidOption", "UnknownOption"].contains(&code.as_str())), "{text}");
    }
}

#[wasm_bindgen_test]
fn progress_is_told_and_cannot_harm() {
    let mesh = raw(&torus());
    let f = array(&noise(108));
    let options = js("{ epsilon: 0.1, onProgress: (p) => { (globalThis.told ??= []).push(p); } }");
    smooth(&mesh, &f, &options).ok().expect("a solution");
    let told = Array::from(&get(&js_sys::global(), "told"));
    let phases: Vec<String> = told.iter().map(|p| get(&p, "phase").as_string().expect("a phase")).collect();
    assert_eq!(phases, ["analysis", "factorization", "solve", "report", "report"]);
    let fractions: Vec<f64> = told.iter().map(|p| number(&p, "fraction")).collect();
    assert!(fractions.windows(2).all(|pair| pair[0] <= pair[1]) && fractions.last() == Some(&1.0));
    let throwing = js("{ epsilon: 0.1, onProgress: () => { throw new Error('mine'); } }");
    smooth(&mesh, &f, &throwing).ok().expect("a solution");
    assert_eq!(thrown(smooth(&mesh, &f, &js("{ epsilon: 0.1, onProgress: 3 }"))).0, "InvalidOption");
}

#[wasm_bindgen_test]
fn wrong_options_are_refused_by_name() {
    let mesh = raw(&torus());
    let f = array(&noise(108));
    let mut smoother = RawSmoother::new(&mesh, &NONE).ok().expect("cotangents");
    let good: JsValue = smoother.tikhonov(&f, &js("{ epsilon: 1 }")).ok().expect("a solution").into();
    for (text, code, named) in [
        ("{ epsilonn: 1 }", "UnknownOption", "epsilonn"),
        ("{ epsilon: 1, metric: 'mas' }", "InvalidOption", "metric"),
        ("{ epsilon: 1, metric: 3 }", "InvalidOption", "metric"),
        ("{ epsilon: '1' }", "InvalidOption", "epsilon"),
        ("{ epsilon: 0 }", "InvalidOption", "epsilon"),
        ("{ epsilon: NaN }", "InvalidOption", "epsilon"),
        ("{ epsilon: -1 }", "InvalidOption", "epsilon"),
        ("{}", "InvalidOption", "epsilon"),
        ("undefined", "InvalidOption", "epsilon"),
        ("{ epsilon: 1, channels: 0 }", "InvalidOption", "channels"),
        ("{ epsilon: 1, channels: -1 }", "InvalidOption", "channels"),
        ("{ epsilon: 1, channels: 1.5 }", "InvalidOption", "channels"),
        ("{ epsilon: 1, metric: 'identity', massScale: 'raw' }", "InapplicableOption", "massScale"),
        ("5", "InvalidArgument", "options"),
        ("'epsilon'", "InvalidArgument", "options"),
        ("[1]", "InvalidArgument", "options"),
        ("() => 1", "InvalidArgument", "options"),
    ] {
        let (found, message, detail) = thrown(smoother.tikhonov(&f, &js(text)));
        assert_eq!(found, code, "{text}: {message}");
        let name = if code == "InvalidArgument" { "argument" } else { "option" };
        assert_eq!(get(&detail, name).as_string().as_deref(), Some(named), "{text}");
        assert!(message.contains(named), "{text}: {message}");
    }
    // The same instance goes on as before.
    let again: JsValue = smoother.tikhonov(&f, &js("{ epsilon: 1 }")).ok().expect("a solution").into();
    assert_eq!(floats(&again, "values"), floats(&good, "values"));
    for (text, code) in [
        ("{ weights: 'cotan' }", "InvalidOption"),
        ("{ operator: 'fem', weights: 'intrinsicDelaunay' }", "InapplicableOption"),
        ("{ operator: 'fem', weights: 'uniform' }", "InapplicableOption"),
        ("{ operator: 'finite' }", "InvalidOption"),
        ("{ precision: 'half' }", "InvalidOption"),
        ("{ solver: 'cg', colour: 1 }", "UnknownOption"),
        ("{ bounds: 'yes' }", "InvalidOption"),
    ] {
        assert_eq!(thrown(RawSmoother::new(&mesh, &js(text))).0, code, "{text}");
    }
    for (text, code) in [
        ("{ epsilon: 'auto' }", "UnsupportedOption"),
        ("{ epsilon: 'much' }", "InvalidOption"),
        ("{ epsilon: 1, method: 'interpolate' }", "InapplicableOption"),
        ("{ method: 'interpolate' }", "InvalidOption"),
        ("{ epsilon: 1, constraints: {} }", "InvalidOption"),
        ("{ epsilon: 1, constraints: [0] }", "InvalidOption"),
        ("{ epsilon: 1, constraints: { from: 'kMeans', clusters: 0 } }", "InvalidOption"),
        ("{ epsilon: 1, constraints: { from: 'persistence', delta: 0 } }", "UnknownOption"),
        ("{ epsilon: 1, constraints: new Uint32Array([108]) }", "IndexOutOfBounds"),
        ("{ epsilon: 1, constraints: new Uint32Array(0) }", "Unconstrained"),
        ("{ epsilon: 1, __proto__: null, surprise: 1 }", "UnknownOption"),
    ] {
        assert_eq!(thrown(smooth(&mesh, &f, &js(text))).0, code, "{text}");
    }
    assert_eq!(thrown(mesh.critical_points(&f, &js("{ delta: -1 }"))).0, "InvalidOption");
    assert_eq!(thrown(mesh.critical_points(&f, &js("{ delta: 0.1, link: 'Skip' }"))).0, "InvalidOption");
    assert_eq!(thrown(mesh.mass(&js("{ kind: 'full' }"))).0, "InvalidOption");
}

#[wasm_bindgen_test]
fn wrong_data_is_refused_with_its_ids() {
    let positions = array(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    let (code, _, detail) = thrown(RawTriMesh::new(&positions, &Uint32Array::from(&[0, 1, 9][..]), &NONE));
    assert_eq!(code, "IndexOutOfBounds");
    assert_eq!((number(&detail, "triangle"), number(&detail, "index"), number(&detail, "vertices")), (0.0, 9.0, 3.0));
    let empty = RawTriMesh::new(&Float64Array::new_with_length(0), &Uint32Array::new_with_length(0), &NONE);
    assert_eq!(thrown(empty).0, "EmptyMesh");
    let (code, _, detail) = thrown(RawTriMesh::new(&array(&[f64::NAN; 9]), &Uint32Array::from(&[0, 1, 2][..]), &NONE));
    assert_eq!((code.as_str(), number(&detail, "vertex")), ("NonFinitePosition", 0.0));
    let mesh = raw(&torus());
    let mut f = noise(108);
    f[33] = f64::INFINITY;
    let (code, _, detail) = thrown(mesh.critical_points(&array(&f), &NONE));
    assert_eq!((code.as_str(), number(&detail, "vertex")), ("NonFiniteValue", 33.0));
    let (code, _, detail) = thrown(smooth(&mesh, &array(&f[1..]), &js("{ epsilon: 1 }")));
    assert_eq!(
        (code.as_str(), number(&detail, "expected"), number(&detail, "actual")),
        ("LengthMismatch", 108.0, 107.0)
    );
}

#[wasm_bindgen_test]
fn files_go_round() {
    let mesh = torus();
    let f = noise(108);
    let fields = Object::new();
    Reflect::set(&fields, &JsValue::from_str("height"), &array(&f)).expect("an object");
    for format in ["'ply', binary: true", "'ply'", "'vtk', binary: true", "'vtk'"] {
        let options = js(&format!("{{ format: {format} }}"));
        Reflect::set(&options, &JsValue::from_str("fields"), &fields).expect("an object");
        let file = write_mesh(&raw(&mesh), &options).ok().expect("a file");
        let back: JsValue = read_mesh(&file, &NONE).ok().expect("a mesh").into();
        assert_eq!(floats(&get(&back, "fields"), "height"), f, "{format}");
        assert_eq!(Array::from(&get(&back, "warnings")).length(), 0, "{format}");
        assert!(get(&back, "mesh").is_object() && get(&back, "format").is_string());
    }
    let column = Uint8Array::from(&b"1.5\n-2\n3e1\n"[..]);
    assert_eq!(read_field(&column, &NONE).ok().expect("a column").to_vec(), [1.5, -2.0, 30.0]);
    assert_eq!(thrown(read_mesh(&Uint8Array::new_with_length(0), &NONE)).0, "EmptyFile");
    assert_eq!(thrown(read_mesh(&column, &js("{ format: 'doc' }"))).0, "InvalidOption");
    assert_eq!(thrown(read_mesh(&column, &js("{ filename: 'a.ply' }"))).0, "UnknownOption");
    assert_eq!(thrown(write_mesh(&raw(&mesh), &NONE)).0, "InvalidOption");
    assert_eq!(thrown(write_mesh(&raw(&mesh), &js("{ format: 'ply', fields: { a: [1, 2] } }"))).0, "InvalidOption");
    let short = js("{ format: 'ply', fields: { a: new Float64Array(3) } }");
    assert_eq!(thrown(write_mesh(&raw(&mesh), &short)).0, "LengthMismatch");
    assert_eq!(thrown(read_field(&column, &js("{ column: -1 }"))).0, "InvalidOption");
}
