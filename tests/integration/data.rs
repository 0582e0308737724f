//! Every file and field of the data folder against what an independent reference found in them. The folder is not part of
//! the project: without it nothing is checked, and the test says so.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use morse_smooth::Error;
use morse_smooth::field::{
    CriticalCounts, CriticalKind, DeltaOptions, Features, Keep, LinkReading, ScalarField, Threshold, value_range,
};
use morse_smooth::io::{FieldReadOptions, read_field};
use morse_smooth::load::{LoadOptions, LoadedMesh, load};
use morse_smooth::mesh::TriMesh;
use morse_smooth::operators::MassScale;
use morse_smooth::smooth::{
    Constraints, Energy, InterpolateOptions, LeastSquaresOptions, Metric, Smoothed, Smoother, SmootherOptions,
    TikhonovOptions, Unconstrained, constrained_vertices, smoothness,
};
use serde_json::Value;

use crate::analyses::{critical_points, delta_hierarchy, largest_edge_difference, level_sets, persistence, simplify};

pub(crate) fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("MORSE_SMOOTH_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    folder.join("expected.json").is_file().then_some(folder)
}

/// Long plateaus of equal values: which of their vertices is critical after smoothing hangs on the last bits.
const PLATEAUS: [&str; 2] = ["jacksboro_dem.ply", "disk_flow_surface.vtk"];

/// Written past the test harness, which would swallow it where the test passes.
pub(crate) fn say(words: &str) {
    let _ = writeln!(std::io::stderr(), "{words}");
}

struct Checker {
    failures: Vec<String>,
}

impl Checker {
    fn equal<T: PartialEq + core::fmt::Debug>(&mut self, what: &str, found: &T, expected: &T) {
        if found != expected {
            self.failures.push(format!("{what}: {found:?}, expected {expected:?}"));
        }
    }

    fn close(&mut self, what: &str, found: f64, expected: f64, relative: f64) {
        let difference = (found - expected).abs();
        if difference.is_nan() || difference > relative * expected.abs() {
            self.failures.push(format!("{what}: {found}, expected {expected}"));
        }
    }

    /// As [`Checker::close`], for values of a field normalised to [0, 1], of which small ones may be wrong by rounding.
    fn near(&mut self, what: &str, found: f64, expected: f64, relative: f64) {
        let difference = (found - expected).abs();
        if difference.is_nan() || difference > relative * expected.abs() + 1e-15 {
            self.failures.push(format!("{what}: {found}, expected {expected}"));
        }
    }
}

fn counts(value: &Value) -> [u32; 3] {
    let at = |i: usize| value[i].as_u64().expect("a count") as u32;
    [at(0), at(1), at(2)]
}

pub(crate) fn as_array(counts: &CriticalCounts) -> [u32; 3] {
    [counts.minima, counts.maxima, counts.saddles]
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn check_mesh(check: &mut Checker, file: &str, mesh: &TriMesh, expected: &Value) {
    let topology = mesh.topology().unwrap();
    let found = [
        ("vertices", mesh.vertex_count() as i64),
        ("triangles", mesh.triangle_count() as i64),
        ("edges", mesh.edge_count() as i64),
        ("eulerCharacteristic", topology.euler_characteristic),
        ("components", topology.components as i64),
        ("boundaryLoops", topology.boundary_loops as i64),
        ("nonManifoldEdges", topology.non_manifold_edges as i64),
        ("nonManifoldVertices", topology.non_manifold_vertices as i64),
    ];
    for (name, value) in found {
        check.equal(&format!("{file} {name}"), &Some(value), &expected[name].as_i64());
    }
    let genus = topology.genus.map(|genus| genus as f64);
    check.equal(&format!("{file} genus"), &genus, &expected["genus"].as_f64());
    check.close(&format!("{file} area"), mesh.area(), number(&expected["area"]), 1e-9);
}

fn check_field(check: &mut Checker, context: &str, smoother: &Smoother, values: &[f64], expected: &Value) {
    let mesh = smoother.mesh();
    let exact = critical_points(mesh, values, &DeltaOptions::default()).expect("a field");
    check.equal(&format!("{context} critical points"), &as_array(&exact.counts), &counts(&expected["criticalPoints"]));
    check.equal(&format!("{context} index sum"), &exact.counts.index_sum, &expected["indexSum"].as_i64());
    if let Some(split) = expected["boundary"].as_object() {
        use morse_smooth::field::CriticalKind::{Maximum, Minimum, Saddle};
        for (name, kind, on_boundary) in [
            ("m_int", Minimum, false),
            ("m_bnd", Minimum, true),
            ("M_int", Maximum, false),
            ("M_bnd", Maximum, true),
            ("s_int", Saddle, false),
            ("s_bnd", Saddle, true),
        ] {
            let number: u32 = exact
                .points
                .iter()
                .filter(|p| p.kind == kind && p.on_boundary == on_boundary)
                .map(|p| p.multiplicity)
                .sum();
            check.equal(&format!("{context} {name}"), &Some(u64::from(number)), &split[name].as_u64());
        }
    }
    let largest = largest_edge_difference(mesh, values);
    check.close(&format!("{context} max edge variation"), largest, number(&expected["maxEdgeVariation"]), 1e-15);
    let range = value_range(mesh.connectivity(), values).expect("a field");
    check.equal(&format!("{context} minimum"), &range.min, &number(&expected["range"][0]));
    check.equal(&format!("{context} maximum"), &range.max, &number(&expected["range"][1]));
    let hierarchies =
        [LinkReading::Consecutive, LinkReading::Skip].map(|link| delta_hierarchy(mesh, values, link).expect("a field"));
    if let Err(error) = crate::hierarchy::check(mesh, values, 8) {
        check.failures.push(format!("{context}: {error}"));
    }
    for (delta, readings) in expected["delta"].as_object().expect("a table of δ") {
        let number: f64 = delta.parse().expect("a number");
        for (k, name, link) in [(0, "consecutive", LinkReading::Consecutive), (1, "skip", LinkReading::Skip)] {
            let options = DeltaOptions { delta: number, link, ..DeltaOptions::default() };
            let found = critical_points(mesh, values, &options).expect("a field").counts;
            check.equal(&format!("{context} δ = {delta} {name}"), &as_array(&found), &counts(&readings[name]));
            let found = hierarchies[k].counts_at(number);
            check.equal(
                &format!("{context} δ = {delta} {name}, hierarchy"),
                &as_array(&found),
                &counts(&readings[name]),
            );
        }
    }
    let diagram = persistence(mesh, values).expect("a field");
    for (threshold, pairs) in expected["persistentPairsAbove"].as_object().expect("a table of thresholds") {
        let threshold = threshold.parse::<f64>().expect("a number") * (range.max - range.min);
        let above = |kind| diagram.pairs.iter().filter(|p| p.kind == kind && p.persistence > threshold).count() as u64;
        let found = [
            above(CriticalKind::Minimum) + diagram.essential_minima.len() as u64,
            above(CriticalKind::Maximum) + diagram.essential_maxima.len() as u64,
        ];
        let expected = [0, 1].map(|side| pairs[side].as_u64().expect("a count"));
        check.equal(&format!("{context} pairs above {threshold}"), &found, &expected);
        let keep = Keep::Above(Threshold::Absolute(threshold));
        let simple = simplify(mesh, values, keep).expect("a surface");
        let counts = critical_points(mesh, &simple, &DeltaOptions::default()).expect("a field").counts;
        let found = [u64::from(counts.minima), u64::from(counts.maxima)];
        check.equal(&format!("{context} simplified by {threshold}"), &found, &expected);
        let change = values.iter().zip(&simple).map(|(f, g)| (f - g).abs()).fold(0.0, f64::max);
        check.equal(&format!("{context} changes by {change}, up to {threshold}"), &(change <= threshold), &true);
        if mesh.topology().unwrap().closed {
            let sum = i64::from(counts.minima) + i64::from(counts.maxima) - i64::from(counts.saddles);
            check.equal(&format!("{context} m − s + M"), &sum, &mesh.topology().unwrap().euler_characteristic);
        }
    }
    let normalized: Vec<f64> = values.iter().map(|v| (v - range.min) / (range.max - range.min)).collect();
    let energies =
        smoothness(smoother.laplacian(), &ScalarField::new(mesh, &normalized).expect("a field")).expect("a field");
    check.close(&format!("{context} Sobolev"), energies.sobolev, number(&expected["sobolev"]), 1e-9);
    check.close(&format!("{context} ‖Lf‖"), energies.laplacian_norm, number(&expected["laplacianNorm"]), 1e-9);
}

/// One of the smoothings that the reference has.
struct Case {
    name: &'static str,
    method: Method,
}

enum Method {
    Tikhonov(Metric),
    /// `None`: least squares.
    Constrained(Option<Energy>, DeltaOptions),
}

/// Those with the same factor follow each other, so that it serves all fields.
fn cases() -> Vec<Case> {
    let all = DeltaOptions::default();
    let some = DeltaOptions { delta: 0.02, link: LinkReading::Skip, ..all };
    let case = |name, method| Case { name, method };
    vec![
        case("tikhonov identity epsilon=0.05", Method::Tikhonov(Metric::Identity)),
        case("tikhonov mass epsilon=0.05", Method::Tikhonov(Metric::Mass)),
        case("leastSquares epsilon=0.05 all critical points + stars", Method::Constrained(None, all)),
        case("leastSquares epsilon=0.05 delta=0.02 skip + stars", Method::Constrained(None, some)),
        case("interpolate harmonic delta=0.02 skip + stars", Method::Constrained(Some(Energy::Harmonic), some)),
        case("interpolate biharmonic delta=0.02 skip + stars", Method::Constrained(Some(Energy::Biharmonic), some)),
    ]
}

fn constraints(options: DeltaOptions) -> Constraints<'static> {
    let features = Features::CriticalPoints(options);
    Constraints { features, stars: true, unconstrained: Unconstrained::Error }
}

fn smoothed(smoother: &mut Smoother, f: &[f64], method: &Method) -> Result<Smoothed, Error> {
    match *method {
        Method::Tikhonov(metric) => smoother.tikhonov(
            f,
            &TikhonovOptions {
                epsilon: 0.05,
                metric,
                mass_scale: MassScale::MeanOne,
                channels: 1,
                ..TikhonovOptions::default()
            },
        ),
        Method::Constrained(Some(energy), options) => smoother.interpolate(
            f,
            &InterpolateOptions {
                constraints: constraints(options),
                energy,
                channels: 1,
                ..InterpolateOptions::default()
            },
        ),
        Method::Constrained(None, options) => {
            let constraints = constraints(options);
            smoother.least_squares(
                f,
                &LeastSquaresOptions {
                    constraints,
                    epsilon: 0.05,
                    weights: None,
                    channels: 1,
                    ..LeastSquaresOptions::default()
                },
            )
        }
    }
}

fn check_smoothing(
    check: &mut Checker,
    context: &str,
    file: &str,
    smoother: &mut Smoother,
    f: &[f64],
    field: &Value,
    case: &Case,
) {
    let context = format!("{context} {}", case.name);
    let expected = &field["smoothed"][case.name];
    let start = Instant::now();
    let found = smoothed(smoother, f, &case.method);
    if expected.is_null() {
        // The reference leaves out what has no constraint at all.
        let code = found.map_err(|error| error.code());
        check.equal(&context, &code.err(), &Some("Unconstrained"));
        return;
    }
    let found = found.expect("a solution");
    let report = &found.reports[0];
    let after = as_array(&report.after);
    say(&format!("{context}: {after:?}, {} entries, {:.1?}", report.solver.factor_nonzeros, start.elapsed()));
    let reference = counts(&expected["counts"]);
    if PLATEAUS.contains(&file) {
        for (found, expected) in after.iter().zip(reference) {
            // At most one in a hundred.
            if u64::from(found.abs_diff(expected)) * 100 > u64::from(expected).max(100) {
                check.failures.push(format!("{context}: {after:?}, expected about {reference:?}"));
            }
        }
        if after != reference {
            say(&format!("{context}: {after:?} where the reference has {reference:?} (plateaus)"));
        }
    } else {
        check.equal(&format!("{context} counts"), &after, &reference);
    }
    for (name, found) in [
        ("lInfinity", report.l_infinity),
        ("l2", report.l2),
        ("sobolev", report.sobolev_after),
        ("laplacianNorm", report.laplacian_norm),
    ] {
        check.close(&format!("{context} {name}"), found, number(&expected[name]), 1e-7);
    }
    let (min, max) = (number(&field["range"][0]), number(&field["range"][1]));
    let vertices = field["sampleVertices"].as_array().expect("vertices");
    for (vertex, sample) in vertices.iter().zip(expected["samples"].as_array().expect("samples")) {
        let vertex = vertex.as_u64().expect("a vertex") as usize;
        let value = (found.values[vertex] - min) / (max - min);
        // A vertex at the very bottom is 0.
        check.near(&format!("{context} at {vertex}"), value, number(sample), 1e-7);
    }
    if let Method::Constrained(energy, options) = case.method {
        let key = if options.delta == 0.0 { "all critical points" } else { "delta=0.02 skip" };
        let sizes = &field["constraints"][key];
        check.equal(&format!("{context} constraints"), &Some(report.constraint_count as u64), &sizes[1].as_u64());
        let all = constrained_vertices(
            smoother.mesh(),
            f,
            1,
            morse_smooth::field::Missing::Error,
            &Constraints { stars: false, ..constraints(options) },
            &morse_smooth::Watch::none(),
        );
        let all = all.expect("a field").len() as u64;
        check.equal(&format!("{context} feature points"), &Some(all), &sizes[0].as_u64());
        if energy.is_some() {
            // Critical points at δ are critical points.
            check.equal(&format!("{context} kept"), &report.preserved, &Some(all as usize));
        }
    }
}

pub(crate) fn read(folder: &Path, file: &str) -> LoadedMesh {
    let bytes = std::fs::read(folder.join(file)).expect("a file of the data folder");
    load(&bytes, &LoadOptions::default()).expect("a mesh")
}

/// A field of the mesh file, or the text file beside it.
pub(crate) fn values(folder: &Path, file: &str, loaded: &LoadedMesh, name: &str) -> Vec<f64> {
    if let Some((_, values)) = loaded.fields.iter().find(|(field, _)| field == name) {
        return values.clone();
    }
    let stem = file.split('.').next().unwrap_or(file);
    let path = folder.join(format!("{stem}_{name}.txt"));
    let bytes = std::fs::read(&path).unwrap_or_else(|_| panic!("{file} has no field {name}"));
    read_field(&bytes, &FieldReadOptions::default()).expect("a field")
}

fn check_file(folder: &Path, file: &str, expected: &Value) -> Vec<String> {
    let mut check = Checker { failures: Vec::new() };
    let loaded = read(folder, file);
    check_mesh(&mut check, file, &loaded.mesh, &expected["mesh"]);
    let mut smoother = Smoother::new(&loaded.mesh, SmootherOptions::default()).expect("cotangents");
    let fields = expected["fields"].as_object().expect("fields");
    for (name, field) in fields {
        let f = values(folder, file, &loaded, name);
        check_field(&mut check, &format!("{file} {name}"), &smoother, &f, field);
    }
    for case in cases() {
        for (name, field) in fields {
            let f = values(folder, file, &loaded, name);
            check_smoothing(&mut check, &format!("{file} {name}"), file, &mut smoother, &f, field, &case);
        }
    }
    check.failures
}

#[test]
fn every_file_agrees_with_the_reference() {
    let Some(folder) = folder() else {
        say("NOT RUN: the data sets are not there; MORSE_SMOOTH_DATA names their folder");
        return;
    };
    let text = std::fs::read_to_string(folder.join("expected.json")).expect("expected.json");
    let expected: Value = serde_json::from_str(&text).expect("JSON");
    let files = expected.as_object().expect("files by name");
    assert!(!files.is_empty());
    let failures: Vec<String> = files.iter().flat_map(|(file, expected)| check_file(&folder, file, expected)).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn level_sets_of_a_terrain_have_no_segments_of_length_0() {
    let Some(folder) = folder() else {
        say("NOT RUN: the data sets are not there; MORSE_SMOOTH_DATA names their folder");
        return;
    };
    // Heights in whole metres, and a level every 20 m.
    let bytes = std::fs::read(folder.join("jacksboro_dem.ply")).expect("a terrain");
    let file = load(&bytes, &LoadOptions::default()).expect("a terrain");
    let (_, heights) = file.fields.first().expect("heights");
    let range = value_range(file.mesh.connectivity(), heights).expect("a field");
    let first = (range.min / 20.0).ceil() as i64;
    let levels: Vec<f64> = (first..=(range.max / 20.0) as i64).map(|k| 20.0 * k as f64).collect();
    let sets = level_sets(&file.mesh, heights, &levels).expect("a field");
    assert!(sets.levels.len() > 1_000, "{}", sets.levels.len());
    for k in 0..sets.levels.len() {
        let line = 3 * sets.offsets[k] as usize..3 * sets.offsets[k + 1] as usize;
        let points: Vec<&[f64]> = sets.points[line].chunks_exact(3).collect();
        let last = if sets.closed[k] { points.len() } else { points.len() - 1 };
        assert!(points.len() >= 2 && (0..last).all(|i| points[i] != points[(i + 1) % points.len()]), "line {k}");
    }
}
