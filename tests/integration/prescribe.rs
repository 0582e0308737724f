//! The smoothest field with prescribed extrema: extrema found by hand, options held to what they promise.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use morse_smooth::field::{Missing, PersistenceDiagram, ScalarField, Threshold};
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::mesh::{LinkKind, TriMesh};
use morse_smooth::operators::LaplacianWeights;
use morse_smooth::smooth::{
    Constraints, Extrema, ExtremumValues, Functional, LeastSquaresOptions, Method, Metric, Operator, PersistenceOf,
    PrescribeOptions, PrescribeRoute, PrescribedReport, ResultRange, Smoothed, Smoother, SmootherOptions,
    TikhonovOptions,
};
use morse_smooth::{Error, Progress, Watch};

use crate::support::{noise, random_complex, random_surface, shuffle};

/// The extrema by (value, id), from nothing but triangles.
pub(crate) fn extrema(mesh: &TriMesh, values: &[f64]) -> [Vec<u32>; 2] {
    let n = mesh.vertex_count();
    let (mut has, mut low, mut high) = (vec![false; n], vec![true; n], vec![true; n]);
    for t in mesh.connectivity().triangles() {
        for [a, b] in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
            let (a, b) = if (values[a as usize], a) < (values[b as usize], b) { (a, b) } else { (b, a) };
            (has[a as usize], has[b as usize]) = (true, true);
            high[a as usize] = false;
            low[b as usize] = false;
        }
    }
    let list = |is: &[bool]| (0..n as u32).filter(|&v| has[v as usize] && is[v as usize]).collect();
    [list(&low), list(&high)]
}

pub(crate) fn told(smoothed: &Smoothed) -> &PrescribedReport {
    smoothed.reports[0].prescribed.as_ref().expect("a report of prescribed extrema")
}

/// Checks that a result has the extrema that it tells of and no others, in single precision, too, and as many saddles as χ says.
pub(crate) fn check(mesh: &TriMesh, smoothed: &Smoothed) {
    let report = told(smoothed);
    let [minima, maxima] = extrema(mesh, &smoothed.values);
    assert_eq!((&minima, &maxima), (&report.minima, &report.maxima), "extrema");
    let after = &smoothed.reports[0].after;
    assert_eq!((after.minima as usize, after.maxima as usize), (minima.len(), maxima.len()));
    let kinds = mesh.connectivity().link_kinds();
    if kinds.iter().all(|kind| *kind == LinkKind::Cycle) {
        let euler = mesh.vertex_count() as i64 - mesh.connectivity().edges().len() as i64
            + mesh.connectivity().triangles().len() as i64;
        assert_eq!(i64::from(after.saddles), (minima.len() + maxima.len()) as i64 - euler, "saddles");
    }
    if report.route != PrescribeRoute::Preview {
        assert!(report.least_slack >= 0.9, "slack {}", report.least_slack);
        assert!(report.gap <= 1e-4, "gap {}", report.gap);
        let single: Vec<f64> = smoothed.values.iter().map(|&x| f64::from(x as f32)).collect();
        let largest = smoothed.values.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        if report.margin >= 1e-6 && (0.1..2.0).contains(&largest) {
            assert_eq!(extrema(mesh, &single), [minima, maxima], "extrema in single precision");
        }
    }
}

/// Vertices of triangles that are not neighbours of each other: some for minima, some for maxima; each component has both.
fn random_extrema(mesh: &TriMesh, random: &mut Random) -> [Vec<u32>; 2] {
    let mut vertices: Vec<u32> = (0..mesh.vertex_count() as u32)
        .filter(|&v| mesh.connectivity().link_kinds()[v as usize] != LinkKind::Isolated)
        .collect();
    shuffle(&mut vertices, random);
    let mut chosen = [BTreeSet::new(), BTreeSet::new()];
    let share = 0.3 * random.uniform();
    for v in vertices {
        let kind = usize::from(random.uniform() < 0.5);
        let is_free = mesh.connectivity().link(v).flatten().all(|w| !chosen[kind].contains(&w));
        if random.uniform() < share && is_free {
            chosen[kind].insert(v);
        }
    }
    chosen.map(|set| set.into_iter().collect())
}

fn noisy(mesh: &TriMesh, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    mesh.positions().chunks_exact(3).map(|p| 0.5 * p[2] + 0.2 * random.signed()).collect()
}

#[test]
fn random_extrema_on_random_complexes_are_the_only_ones() {
    let (mut solved, mut refused) = (0, BTreeSet::new());
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let mesh = match seed % 4 {
            0 => random_complex(seed, 6 + (seed % 7) as u32, 3 + (seed % 23) as usize),
            1 => random_surface(seed, &shapes::sphere(2).expect("a sphere"), 0.3 * random.uniform()),
            2 => random_surface(seed, &shapes::torus(14, 9, 0.0).expect("a torus"), 0.2 * random.uniform()),
            _ => random_surface(seed, &shapes::grid(9, 8).expect("a grid"), 0.4 * random.uniform()),
        };
        let [minima, maxima] = random_extrema(&mesh, &mut random);
        let field: Vec<f64> = (0..mesh.vertex_count()).map(|_| random.uniform()).collect();
        let weights = if seed % 3 == 0 { LaplacianWeights::Uniform } else { LaplacianWeights::Cotangent };
        let epsilon = [1e-3, 0.05, 1.0, 30.0][(seed / 5 % 4) as usize];
        let metric = [Metric::Mass, Metric::Lumped, Metric::Identity][(seed / 7 % 3) as usize];
        let functional = Functional::Tikhonov(TikhonovOptions { epsilon, metric, ..TikhonovOptions::default() });
        let options = PrescribeOptions {
            functional,
            extrema: Extrema::Named { minima: &minima, maxima: &maxima },
            complete: true,
            ..PrescribeOptions::default()
        };
        let mut smoother =
            Smoother::new(&mesh, SmootherOptions { weights, ..SmootherOptions::default() }).expect("a smoother");
        match smoother.prescribe(&field, &options) {
            Ok(smoothed) => {
                check(&mesh, &smoothed);
                let report = told(&smoothed);
                assert!(minima.iter().all(|v| report.minima.contains(v)), "chosen minima");
                assert!(maxima.iter().all(|v| report.maxima.contains(v)), "chosen maxima");
                solved += 1;
            }
            // A component of three vertices, say, has no room for what was drawn.
            Err(error) => {
                refused.insert(format!("{seed}: {error:?}"));
            }
        }
    }
    assert!(solved >= 280, "{solved} solved, refused: {refused:#?}");
}

/// Persistence of a field's chosen extrema, and whether a component has another one of the kind.
fn diagram(mesh: &TriMesh, values: &[f64]) -> PersistenceDiagram {
    let field = ScalarField::new(mesh, values).expect("a field");
    morse_smooth::field::persistence(&field, &Watch::none()).expect("a diagram")
}

#[test]
fn options_hold_what_they_promise() {
    for seed in 0..12 {
        let base = if seed % 2 == 0 { shapes::sphere(4) } else { shapes::torus(40, 24, 0.0) }.expect("a surface");
        let mesh = random_surface(seed, &base, if seed % 3 == 0 { 0.02 } else { 0.0 });
        let field = noisy(&mesh, seed + 50);
        let [low, high] = [f64::min, f64::max].map(|of| field.iter().copied().fold(field[0], of));
        let range = high - low;
        let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
        let chosen = Extrema::Most { minima: 4, maxima: 5, of: PersistenceOf::Input };
        let plain = PrescribeOptions { extrema: chosen, complete: true, ..PrescribeOptions::default() };

        let free = smoother.prescribe(&field, &plain).expect("a field");
        check(&mesh, &free);

        let prominence = 0.15;
        let prominent = PrescribeOptions { prominence: Some(prominence), ..plain };
        let prominent = smoother.prescribe(&field, &prominent).expect("a prominent field");
        check(&mesh, &prominent);
        for pair in diagram(&mesh, &prominent.values).pairs {
            assert!(pair.persistence >= prominence * range * (1.0 - 1e-9), "seed {seed}: {pair:?}");
        }
        assert!(told(&prominent).energy >= told(&free).energy * (1.0 - 1e-5));

        let within = PrescribeOptions { range: ResultRange::Input, prominence: Some(0.3), ..plain };
        match smoother.prescribe(&field, &within) {
            Ok(within) => {
                check(&mesh, &within);
                assert!(within.values.iter().all(|v| (low..=high).contains(v)), "seed {seed}: beyond the range");
            }
            Err(Error::Smooth(error)) => assert_eq!(error.code(), "Infeasible"),
            Err(error) => panic!("{error}"),
        }

        let kept = PrescribeOptions { values: ExtremumValues::Keep, ..plain };
        match smoother.prescribe(&field, &kept) {
            Ok(kept) => {
                check(&mesh, &kept);
                let report = told(&kept);
                for &v in report.minima.iter().chain(&report.maxima).filter(|v| !report.unavoidable.contains(v)) {
                    assert_eq!(kept.values[v as usize].to_bits(), field[v as usize].to_bits(), "vertex {v}");
                }
            }
            Err(Error::Smooth(error)) => assert_eq!(error.code(), "Infeasible"),
            Err(error) => panic!("{error}"),
        }

        let preview = smoother.prescribe(&field, &PrescribeOptions { preview: true, ..plain }).expect("a preview");
        check(&mesh, &preview);
        assert_eq!(told(&preview).minima, told(&free).minima);
        assert_eq!(told(&preview).maxima, told(&free).maxima);

        for better in [PrescribeOptions { again: true, ..plain }, PrescribeOptions { representatives: 3, ..plain }] {
            let better = smoother.prescribe(&field, &better).expect("a better field");
            check(&mesh, &better);
            assert!(told(&better).energy <= told(&free).energy, "seed {seed}");
        }
    }
}

#[test]
fn kept_values_that_contradict_each_other_are_named() {
    let mesh = shapes::sphere(3).expect("a sphere");
    let height: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2]).collect();
    let [top, bottom] = [f64::max, f64::min].map(|of| {
        let end = height.iter().copied().fold(0.0, of);
        height.iter().position(|&h| h == end).expect("an end") as u32
    });
    // Upside down: the lowest vertex is to be the maximum.
    let options = PrescribeOptions {
        extrema: Extrema::Named { minima: &[top], maxima: &[bottom] },
        values: ExtremumValues::Keep,
        ..PrescribeOptions::default()
    };
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
    let error = smoother.prescribe(&height, &options).expect_err("no such field");
    assert_eq!(error.code(), "Infeasible");
    assert!(format!("{:?}", error.detail()).contains(&top.to_string()), "{error}");
    let free = PrescribeOptions { values: ExtremumValues::Free, ..options };
    check(&mesh, &smoother.prescribe(&height, &free).expect("a field upside down"));
}

#[test]
fn bad_choices_are_told_by_code_and_vertex() {
    let mesh = shapes::sphere(2).expect("a sphere");
    let field: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[2]).collect();
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
    let neighbour = mesh.connectivity().link(7).flatten().next().expect("a neighbour");
    let far = (0..field.len() as u32)
        .find(|&v| v != 7 && mesh.connectivity().link(7).flatten().all(|w| w != v))
        .expect("a vertex");
    let count = field.len() as u32;
    let plain = PrescribeOptions::default();
    let named = |minima, maxima| PrescribeOptions { extrema: Extrema::Named { minima, maxima }, ..plain };
    let tikhonov = TikhonovOptions::default();
    let with = |options| PrescribeOptions { functional: Functional::Tikhonov(options), ..plain };
    let (both, far_alone, beyond) = ([7, neighbour], [far], [count]);
    let cases = [
        ("ConflictingExtremum", named(&[7], &[7])),
        ("AdjacentExtrema", named(&both, &far_alone)),
        ("AdjacentExtrema", named(&far_alone, &both)),
        ("Unconstrained", named(&[7], &[])),
        ("Unconstrained", named(&[], &[7])),
        ("Unconstrained", PrescribeOptions { extrema: Extrema::OfInput(&[]), ..plain }),
        ("NotAnExtremum", PrescribeOptions { extrema: Extrema::OfInput(&far_alone), ..plain }),
        ("IndexOutOfBounds", PrescribeOptions { extrema: Extrema::OfInput(&beyond), ..plain }),
        ("IndexOutOfBounds", named(&beyond, &[7])),
        (
            "Unconstrained",
            PrescribeOptions { extrema: Extrema::Most { minima: 0, maxima: 1, of: PersistenceOf::Input }, ..plain },
        ),
        (
            "TooFewExtrema",
            PrescribeOptions { extrema: Extrema::Most { minima: 1, maxima: 2, of: PersistenceOf::Input }, ..plain },
        ),
        ("InvalidOption", PrescribeOptions { margin: 0.0, ..plain }),
        ("InvalidOption", PrescribeOptions { margin: f64::NAN, ..plain }),
        ("InvalidOption", PrescribeOptions { margin: 0.5, ..plain }),
        ("InvalidOption", PrescribeOptions { prominence: Some(-1.0), ..plain }),
        ("InvalidOption", PrescribeOptions { representatives: 2, ..plain }),
        ("InvalidOption", with(TikhonovOptions { epsilon: 0.0, ..tikhonov })),
        (
            "InvalidOption",
            PrescribeOptions {
                extrema: Extrema::Above { threshold: Threshold::Relative(f64::NAN), of: PersistenceOf::Input },
                ..plain
            },
        ),
        ("InapplicableOption", with(TikhonovOptions { channels: 2, ..tikhonov })),
        ("InapplicableOption", with(TikhonovOptions { missing: Missing::Fill, ..tikhonov })),
    ];
    for (code, options) in cases {
        let error = smoother.prescribe(&field, &options).expect_err(code);
        assert_eq!(error.code(), code, "{error}");
    }
    assert_eq!(smoother.prescribe(&vec![3.0; field.len()], &plain).expect_err("constant").code(), "ConstantField");
    let mut broken = field.clone();
    broken[3] = f64::NAN;
    assert_eq!(smoother.prescribe(&broken, &plain).expect_err("NaN").code(), "NonFiniteValue");
    check(&mesh, &smoother.prescribe(&field, &plain).expect("the smoother goes on"));
}

#[test]
fn gaps_are_left_out_and_vertices_named_as_in_the_whole() {
    let mesh = shapes::torus(30, 20, 0.0).expect("a torus");
    let mut field = noisy(&mesh, 4);
    for v in [0, 5, 6, 7, 100, 101, 333] {
        field[v] = f64::NAN;
    }
    let functional = Functional::Tikhonov(TikhonovOptions { missing: Missing::Omit, ..TikhonovOptions::default() });
    let options = PrescribeOptions {
        functional,
        extrema: Extrema::Most { minima: 3, maxima: 3, of: PersistenceOf::Smoothed },
        ..PrescribeOptions::default()
    };
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
    let whole = smoother.prescribe(&field, &options).expect("a field");
    let part = mesh.submesh(&|v| !field[v as usize].is_nan()).expect("a part");
    let of_part: Vec<f64> = part.vertices.iter().map(|&v| whole.values[v as usize]).collect();
    let names = |list: Vec<u32>| list.into_iter().map(|v| part.vertices[v as usize]).collect::<Vec<u32>>();
    let [minima, maxima] = extrema(&part.mesh, &of_part).map(names);
    assert_eq!((&told(&whole).minima, &told(&whole).maxima), (&minima, &maxima));
    assert!(whole.values[5].is_nan());
    let named = PrescribeOptions { extrema: Extrema::Named { minima: &minima, maxima: &maxima }, ..options };
    let again = smoother.prescribe(&field, &named).expect("the same field");
    assert_eq!(told(&again).minima, minima);
    let gap = PrescribeOptions { extrema: Extrema::Named { minima: &[5], maxima: &maxima }, ..options };
    assert_eq!(smoother.prescribe(&field, &gap).expect_err("a gap").code(), "MissingValue");
}

#[test]
fn least_squares_and_finite_elements_have_prescribed_extrema_too() {
    let mesh = shapes::sphere(4).expect("a sphere");
    let field = noisy(&mesh, 9);
    let constrained: Vec<u32> = (0..field.len() as u32).step_by(7).collect();
    let extrema = Extrema::Most { minima: 2, maxima: 3, of: PersistenceOf::Input };
    let constraints =
        Constraints { features: morse_smooth::field::Features::Vertices(&constrained), ..Constraints::default() };
    let functional = Functional::LeastSquares(LeastSquaresOptions { constraints, ..LeastSquaresOptions::default() });
    let options = PrescribeOptions { functional, extrema, ..PrescribeOptions::default() };
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
    let smoothed = smoother.prescribe(&field, &options).expect("a field");
    check(&mesh, &smoothed);
    assert_eq!((told(&smoothed).minima.len(), told(&smoothed).maxima.len()), (2, 3));
    for (operator, weights, epsilon) in [
        (Operator::Fem, LaplacianWeights::Cotangent, 400.0),
        (Operator::Paper, LaplacianWeights::IntrinsicDelaunay, 0.05),
        (Operator::Paper, LaplacianWeights::NormalizedCotangent, 0.05),
    ] {
        let mut smoother = Smoother::new(&mesh, SmootherOptions { operator, weights, ..SmootherOptions::default() })
            .expect("a smoother");
        let functional = Functional::Tikhonov(TikhonovOptions { epsilon, ..TikhonovOptions::default() });
        let options = PrescribeOptions { functional, extrema, ..PrescribeOptions::default() };
        check(&mesh, &smoother.prescribe(&field, &options).expect("a field"));
    }
}

#[test]
fn extreme_meshes_and_scales() {
    let triangle = crate::support::mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]);
    let mut smoother = Smoother::new(&triangle, SmootherOptions::default()).expect("a smoother");
    let options =
        PrescribeOptions { extrema: Extrema::Named { minima: &[2], maxima: &[1] }, ..PrescribeOptions::default() };
    let smoothed = smoother.prescribe(&[0.0, 1.0, 0.5], &options).expect("a field");
    check(&triangle, &smoothed);
    assert_eq!((&told(&smoothed).minima[..], &told(&smoothed).maxima[..]), (&[2][..], &[1][..]));
    // Everything kept.
    let kept = PrescribeOptions {
        extrema: Extrema::Named { minima: &[0], maxima: &[1] },
        values: ExtremumValues::Keep,
        ..PrescribeOptions::default()
    };
    check(&triangle, &smoother.prescribe(&[0.0, 1.0, 0.5], &kept).expect("a field"));

    for valence in [360_u32, 1440] {
        let mut positions = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
        for k in 0..valence {
            let angle = f64::from(k) / f64::from(valence) * core::f64::consts::TAU;
            positions.push([angle.cos(), angle.sin(), 0.0]);
        }
        let triangles: Vec<[u32; 3]> = (0..valence)
            .flat_map(|k| {
                let (a, b) = (2 + k, 2 + (k + 1) % valence);
                [[0, a, b], [1, b, a]]
            })
            .collect();
        let mesh = crate::support::mesh(&positions, &triangles);
        let field = noisy(&mesh, u64::from(valence));
        for (minima, maxima) in [(vec![0], vec![1]), (vec![5, 100], vec![0])] {
            let options = PrescribeOptions {
                extrema: Extrema::Named { minima: &minima, maxima: &maxima },
                ..PrescribeOptions::default()
            };
            let smoothed =
                Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother").prescribe(&field, &options);
            check(&mesh, &smoothed.expect("a field"));
        }
    }

    let mesh = shapes::sphere(3).expect("a sphere");
    let field = noisy(&mesh, 3);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
    let options = PrescribeOptions {
        extrema: Extrema::Most { minima: 2, maxima: 2, of: PersistenceOf::Input },
        ..PrescribeOptions::default()
    };
    let reference = told(&smoother.prescribe(&field, &options).expect("a field")).clone();
    for (scale, offset) in [(1e-200, 0.0), (1e200, 0.0), (1.0, 1e9), (-1.0, 0.0), (1e-3, 1e6)] {
        let other: Vec<f64> = field.iter().map(|v| scale * v + offset).collect();
        let smoothed = smoother.prescribe(&other, &options).expect("a scaled field");
        check(&mesh, &smoothed);
        let report = told(&smoothed);
        let kinds =
            if scale > 0.0 { [&reference.minima, &reference.maxima] } else { [&reference.maxima, &reference.minima] };
        assert_eq!([&report.minima, &report.maxima], kinds, "scale {scale}, offset {offset}");
    }
}

#[test]
fn stopped_work_leaves_no_trace() {
    let mesh = shapes::torus(40, 30, 0.2).expect("a torus");
    let field = noisy(&mesh, 8);
    let options =
        PrescribeOptions { representatives: 3, again: true, prominence: Some(0.05), ..PrescribeOptions::default() };
    let method = Method::Prescribe(options);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
    let mut fractions = Vec::new();
    let mut tell = |progress: Progress| {
        fractions.push(progress.fraction);
        ControlFlow::Continue(())
    };
    let expected = smoother.apply(&field, &method, &Watch::new(&mut tell)).expect("a field");
    assert!(fractions.is_sorted() && fractions.len() > 20, "{fractions:?}");
    assert_eq!(fractions.last(), Some(&1.0));
    for last in (0..fractions.len()).step_by(5) {
        let mut asked = 0;
        let mut stop = |_: Progress| {
            asked += 1;
            if asked > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let stopped = smoother.apply(&field, &method, &Watch::new(&mut stop));
        // What was analysed once is not analysed again.
        if asked > last {
            assert_eq!(stopped.map_err(|error| error.code()).err(), Some("Cancelled"));
            assert_eq!(asked, last + 1);
        }
    }
    let found = smoother.apply(&field, &method, &Watch::none()).expect("a field");
    assert!(found.values.iter().zip(&expected.values).all(|(a, b)| a.to_bits() == b.to_bits()));
    assert_eq!(found.reports, expected.reports);
}

/// Vertices that no operator acts on, as all their triangles have no area, take part as all others do. Needles a hundred
/// thousand times as long as high are refused by cotangents, as Tikhonov smoothing refuses some of them.
#[test]
fn triangles_without_area_have_prescribed_extrema() {
    let base = shapes::grid(12, 10).expect("a grid");
    let mut refused = 0;
    for seed in 0..6 {
        let mut random = Random::new(seed);
        let mut positions: Vec<[f64; 3]> = base.positions().chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect();
        let triangles: Vec<[u32; 3]> = base.connectivity().triangles().to_vec();
        if seed % 2 == 0 {
            // All vertices around some are where these are.
            for center in [17_u32, 66, 100] {
                for w in base.connectivity().link(center).flatten() {
                    positions[w as usize] = positions[center as usize];
                }
            }
        } else {
            positions.iter_mut().for_each(|p| p[1] *= [1e-7, 1e-3, 1e-5][seed as usize / 2]);
        }
        let mesh = crate::support::mesh(&positions, &triangles);
        let field: Vec<f64> = (0..mesh.vertex_count()).map(|_| random.uniform()).collect();
        for (minima, maxima) in [(vec![17, 90], vec![5, 66]), (vec![100], vec![17])] {
            let options = PrescribeOptions {
                extrema: Extrema::Named { minima: &minima, maxima: &maxima },
                ..PrescribeOptions::default()
            };
            for weights in [LaplacianWeights::Cotangent, LaplacianWeights::Uniform, LaplacianWeights::IntrinsicDelaunay]
            {
                let mut smoother = Smoother::new(&mesh, SmootherOptions { weights, ..SmootherOptions::default() })
                    .expect("a smoother");
                match smoother.prescribe(&field, &options) {
                    Ok(smoothed) => {
                        check(&mesh, &smoothed);
                        assert_eq!((&told(&smoothed).minima, &told(&smoothed).maxima), (&minima, &maxima));
                    }
                    // Cotangents of such triangles are so large that rounding leaves nothing of the others beside them.
                    Err(error) => {
                        assert!(
                            ["NotConverged", "NotPositiveDefinite"].contains(&error.code()),
                            "seed {seed}: {error}"
                        );
                        assert_ne!(weights, LaplacianWeights::Uniform, "seed {seed}");
                        refused += 1;
                    }
                }
            }
        }
    }
    assert!(refused <= 13, "{refused} of 36 refused");
}

/// The dual method leaves the factor of the functional to the smoother: what comes next is the same as without that, to the bit.
#[test]
fn calls_after_the_dual_method_are_as_without_it() {
    let mesh = shapes::sphere(4).expect("a sphere");
    let random = noise(mesh.vertex_count(), 6);
    let field: Vec<f64> = mesh.positions().chunks_exact(3).zip(random).map(|(p, e)| p[0] * p[2] + 0.2 * e).collect();
    let tikhonov = TikhonovOptions { epsilon: 0.002, ..TikhonovOptions::default() };
    let options = |minima: usize| PrescribeOptions {
        functional: Functional::Tikhonov(tikhonov),
        extrema: Extrema::Most { minima, maxima: 2, of: PersistenceOf::Smoothed },
        ..PrescribeOptions::default()
    };
    let smoother = || Smoother::new(&mesh, SmootherOptions::default()).expect("a smoother");
    let bits = |values: &[f64]| -> Vec<u64> { values.iter().map(|value| value.to_bits()).collect() };
    let mut used = smoother();
    let first = used.prescribe(&field, &options(2)).expect("a field");
    assert_eq!(told(&first).route, PrescribeRoute::Dual);
    let again = used.prescribe(&field, &options(1)).expect("a field");
    let fresh = smoother().prescribe(&field, &options(1)).expect("a field");
    assert_eq!(bits(&again.values), bits(&fresh.values));
    let after = used.tikhonov(&field, &tikhonov).expect("a field");
    let alone = smoother().tikhonov(&field, &tikhonov).expect("a field");
    assert_eq!(bits(&after.values), bits(&alone.values));
    let other = TikhonovOptions { epsilon: 0.5, ..tikhonov };
    let after = used.tikhonov(&field, &other).expect("a field");
    assert_eq!(bits(&after.values), bits(&smoother().tikhonov(&field, &other).expect("a field").values));
}
