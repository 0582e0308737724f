//! Smoothing: the same numbers as in Rust, and progress.

use js_sys::{Array, Object, Reflect, Uint32Array};
use morse_smooth::field::{DeltaOptions, Features, LinkReading, Threshold};
use morse_smooth::smooth::{
    BilateralOptions, Constraints, Energy, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Operator,
    Precision, Smoothed, Smoother, SmootherOptions, TikhonovOptions, Unconstrained, constrained_vertices,
    epsilon_for_wavelength,
};
use morse_smooth::wasm::{RawSmoother, smooth};
use wasm_bindgen::prelude::*;
use wasm_bindgen_test::wasm_bindgen_test;

use crate::support::{NONE, array, floats, get, js, noise, number, raw, thrown, torus};

#[wasm_bindgen_test]
fn smoothing_is_that_of_rust() {
    let mesh = torus();
    let f = noise(mesh.vertex_count());
    let mut native = Smoother::new(&mesh, SmootherOptions::default()).expect("cotangents");
    let expected =
        native.tikhonov(&f, &TikhonovOptions { epsilon: 0.3, ..TikhonovOptions::default() }).expect("a solution");
    let mut smoother = RawSmoother::new(&raw(&mesh), &NONE).ok().expect("cotangents");
    let long: JsValue =
        smoother.apply("tikhonov", &array(&f), &js("{ epsilon: 0.3 }")).ok().expect("a solution").into();
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
    let found: JsValue = smoother
        .apply("tikhonov", &array(&twice), &js("{ epsilon: 0.3, channels: 2 }"))
        .ok()
        .expect("a solution")
        .into();
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
        let long: JsValue = smoother.apply("tikhonov", &array(&f), &wavelength).ok().expect("a solution").into();
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
            let (found, message, detail) = thrown(smoother.apply("tikhonov", &array(&f), &js(text)));
            assert_eq!(
                (found.as_str(), get(&detail, "option").as_string().as_deref()),
                (code, Some(named)),
                "{message}"
            );
        }
        let again: JsValue = smoother.apply("tikhonov", &array(&f), &wavelength).ok().expect("a solution").into();
        assert_eq!(floats(&again, "values"), expected.values);
    }
    let mut papers = RawSmoother::new(&raw(&mesh), &NONE).ok().expect("cotangents");
    assert_eq!(thrown(papers.apply("tikhonov", &array(&f), &js("{ cutoffWavelength: 1 }"))).0, "InapplicableOption");
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
        let wanted = constrained_vertices(
            &mesh,
            &f,
            1,
            morse_smooth::field::Missing::Error,
            &constraints,
            &morse_smooth::Watch::none(),
        )
        .expect("vertices");
        let found = given.constrained_vertices(&array(&f), &js(text), &NONE).ok().expect("vertices");
        assert_eq!(found.unchecked_into::<Uint32Array>().to_vec(), wanted, "{text}");

        let options = InterpolateOptions {
            constraints,
            energy: Energy::Biharmonic,
            channels: 1,
            ..InterpolateOptions::default()
        };
        let wanted = native.interpolate(&f, &options).expect("a solution");
        let given_options = js(&format!("{{ constraints: {text}, energy: 'biharmonic' }}"));
        let found: JsValue = smoother.apply("interpolate", &array(&f), &given_options).ok().expect("a solution").into();
        check_constrained(&found, &wanted, text);

        let options = LeastSquaresOptions {
            constraints,
            epsilon: 0.5,
            weights: None,
            channels: 1,
            ..LeastSquaresOptions::default()
        };
        let wanted = native.least_squares(&f, &options).expect("a solution");
        let given_options = js(&format!("{{ constraints: {text}, epsilon: 0.5 }}"));
        let found: JsValue =
            smoother.apply("leastSquares", &array(&f), &given_options).ok().expect("a solution").into();
        check_constrained(&found, &wanted, text);
        Reflect::set(&given_options, &"bounds".into(), &JsValue::TRUE).expect("an object");
        let found: JsValue = smooth(&given, &array(&f), &given_options).ok().expect("a solution").into();
        check_constrained(&found, &wanted, text);
    }
    let options = |weights: &str| {
        js(&format!(
            "{{ constraints: new Uint32Array([5, 70]), epsilon: 0.5, weights: new Float64Array([{weights}]) }}"
        ))
    };
    assert!(smoother.apply("leastSquares", &array(&f), &options("1, 2")).is_ok());
    let (code, message, detail) = thrown(smoother.apply("leastSquares", &array(&f), &options("1, 0")));
    assert_eq!((code.as_str(), number(&detail, "vertex")), ("InvalidWeight", 70.0), "{message}");
    let nested = js("{ constraints: { from: 'criticalPoints', delta: -1 } }");
    let (code, message, detail) = thrown(smoother.apply("interpolate", &array(&f), &nested));
    assert_eq!((code.as_str(), get(&detail, "option")), ("InvalidOption", "constraints.delta".into()), "{message}");
}

/// What JavaScript got beside what Rust gets.
fn check_constrained(found: &JsValue, wanted: &Smoothed, context: &str) {
    assert_eq!(floats(found, "values"), wanted.values, "{context}");
    let (report, wanted) = (get(found, "report"), &wanted.reports[0]);
    assert_eq!(get(&report, "method"), JsValue::from_str(wanted.method.name()));
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
    let native = Smoother::new(&mesh, SmootherOptions::default()).expect("cotangents");
    let mut smoother = RawSmoother::new(&raw(&mesh), &NONE).ok().expect("cotangents");
    let taubin = LowPassOptions { iterations: 7, lambda: 0.4, mu: -0.45, channels: 1, ..LowPassOptions::default() };
    let wanted = native.low_pass(&f, &taubin).expect("steps");
    let given = js("{ iterations: 7, lambda: 0.4, mu: -0.45 }");
    let found: JsValue = smoother.apply("lowPass", &array(&f), &given).ok().expect("steps").into();
    assert_eq!(floats(&found, "values"), wanted.values);
    let plain = LowPassOptions { iterations: 3, ..LowPassOptions::default() };
    let wanted = native.low_pass(&f, &plain).expect("steps");
    let found: JsValue = smoother.apply("lowPass", &array(&f), &js("{ iterations: 3 }")).ok().expect("steps").into();
    assert_eq!(floats(&found, "values"), wanted.values);
    let options = BilateralOptions {
        iterations: 2,
        radius: 0.6,
        sigma_distance: 0.3,
        sigma_value: 0.7,
        channels: 1,
        ..BilateralOptions::default()
    };
    let wanted = native.bilateral(&f, &options).expect("steps");
    let given = js("{ iterations: 2, radius: 0.6, sigmaDistance: 0.3, sigmaValue: 0.7 }");
    let found: JsValue = smoother.apply("bilateral", &array(&f), &given).ok().expect("steps").into();
    // To the last bit: the exponential function is not the platform's.
    assert_eq!(floats(&found, "values"), wanted.values);
    assert_eq!(number(&get(&get(&found, "report"), "solver"), "iterations"), 2.0);
    for text in ["undefined", "{}", "{ iterations: -1 }", "{ iterations: 1, lambda: 2, radius: 0 }"] {
        let codes = [
            thrown(smoother.apply("lowPass", &array(&f), &js(text))).0,
            thrown(smoother.apply("bilateral", &array(&f), &js(text))).0,
        ];
        assert!(codes.iter().all(|code| ["InvalidOption", "UnknownOption"].contains(&code.as_str())), "{text}");
    }
}

#[wasm_bindgen_test]
fn progress_is_told_and_cannot_harm() {
    let mesh = raw(&torus());
    let f = array(&noise(108));
    let options = js(
        "{ epsilon: 0.1, onProgress: (phase, fraction) => { (globalThis.told ??= []).push({ phase, fraction }); } }",
    );
    smooth(&mesh, &f, &options).ok().expect("a solution");
    let told = Array::from(&get(&js_sys::global(), "told"));
    let mut phases: Vec<String> = told.iter().map(|p| get(&p, "phase").as_string().expect("a phase")).collect();
    // Each phase is told of several times in a row.
    phases.dedup();
    assert_eq!(phases, ["analysis", "factorization", "solve", "report"]);
    let fractions: Vec<f64> = told.iter().map(|p| number(&p, "fraction")).collect();
    assert!(fractions.windows(2).all(|pair| pair[0] <= pair[1]) && fractions.last() == Some(&1.0));
    let throwing = js("{ epsilon: 0.1, onProgress: () => { throw new Error('mine'); } }");
    assert_eq!(thrown(smooth(&mesh, &f, &throwing)).0, "Cancelled");
    assert_eq!(thrown(smooth(&mesh, &f, &js("{ epsilon: 0.1, onProgress: 3 }"))).0, "InvalidOption");
}
