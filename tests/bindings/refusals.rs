//! Wrong options and data.

use js_sys::{Float64Array, Uint32Array};
use morse_smooth::wasm::{RawSmoother, RawTriMesh, smooth};
use wasm_bindgen::prelude::*;
use wasm_bindgen_test::wasm_bindgen_test;

use crate::support::{NONE, array, floats, get, js, noise, number, raw, thrown, torus};

#[wasm_bindgen_test]
fn wrong_options_are_refused_by_name() {
    let mesh = raw(&torus());
    let f = array(&noise(108));
    let mut smoother = RawSmoother::new(&mesh, &NONE).ok().expect("cotangents");
    let good: JsValue = smoother.apply("tikhonov", &f, &js("{ epsilon: 1 }")).ok().expect("a solution").into();
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
        let (found, message, detail) = thrown(smoother.apply("tikhonov", &f, &js(text)));
        assert_eq!(found, code, "{text}: {message}");
        let name = if code == "InvalidArgument" { "argument" } else { "option" };
        assert_eq!(get(&detail, name).as_string().as_deref(), Some(named), "{text}");
        assert!(message.contains(named), "{text}: {message}");
    }
    // The same instance goes on as before.
    let again: JsValue = smoother.apply("tikhonov", &f, &js("{ epsilon: 1 }")).ok().expect("a solution").into();
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
        ("{ epsilon: 'Auto' }", "InvalidOption"),
        ("{ epsilon: { rule: 'best' } }", "InvalidOption"),
        ("{ epsilon: { rule: 'gcv', noise: 1 } }", "UnknownOption"),
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
    let (code, _, detail) = thrown(RawTriMesh::new(&positions, Some(Uint32Array::from(&[0, 1, 9][..])), &NONE));
    assert_eq!(code, "IndexOutOfBounds");
    assert_eq!((number(&detail, "triangle"), number(&detail, "index"), number(&detail, "vertices")), (0.0, 9.0, 3.0));
    let empty = RawTriMesh::new(&Float64Array::new_with_length(0), Some(Uint32Array::new_with_length(0)), &NONE);
    assert_eq!(thrown(empty).0, "EmptyMesh");
    let (code, _, detail) =
        thrown(RawTriMesh::new(&array(&[f64::NAN; 9]), Some(Uint32Array::from(&[0, 1, 2][..])), &NONE));
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
