//! What a family tells of all ε at once: norms, degrees of freedom, and the lives of extrema.

use morse_smooth::Watch;
use morse_smooth::field::{Features, Missing};
use morse_smooth::mesh::shapes;
use morse_smooth::operators::{LaplacianWeights, MassScale};
use morse_smooth::smooth::{
    Constraints, ExtremumLife, Family, FamilyOptions, Functional, LeastSquaresOptions, Metric, Operator, Smoother,
    SmootherOptions, SweepOptions, TikhonovOptions,
};
use nalgebra::DMatrix;

use crate::dense_reference::{Reference, together};
use crate::family::{built, epsilons, tikhonov};
use crate::operators::reference_mass;
use crate::support::{annulus, noise};

/// Families of different kinds on one mesh, each with a word for it; whether ‖Lx‖ is what smoothing makes small.
fn families() -> Vec<(String, Family, bool)> {
    let mesh = together(&[shapes::torus(16, 12, 0.3).unwrap(), annulus()]);
    let n = mesh.vertex_count();
    let mut values: Vec<f64> = noise(2 * n, 4).iter().map(|x| 30.0 * x - 4.0).collect();
    let listed: Vec<u32> = (0..n as u32).filter(|v| v % 6 != 5).collect();
    let weights: Vec<f64> = listed.iter().map(|v| 0.5 + f64::from(v % 3)).collect();
    let mut all = Vec::new();
    for (weights_of_l, operator) in [
        (LaplacianWeights::Cotangent, Operator::Paper),
        (LaplacianWeights::MeanValue, Operator::Paper),
        (LaplacianWeights::Cotangent, Operator::Fem),
    ] {
        let options = SmootherOptions { weights: weights_of_l, operator, ..SmootherOptions::default() };
        let mut smoother = Smoother::new(&mesh, options).unwrap();
        let is_exact = operator == Operator::Paper;
        let constraints = Constraints { features: Features::Vertices(&listed), ..Constraints::default() };
        let fit =
            LeastSquaresOptions { constraints, weights: Some(&weights), channels: 2, ..LeastSquaresOptions::default() };
        let options = FamilyOptions { method: Functional::LeastSquares(fit), ..FamilyOptions::default() };
        all.push((format!("{operator:?} least squares"), built(&mut smoother, &values, &options), is_exact));
        let metrics = if is_exact { &[Metric::Identity, Metric::Mass, Metric::Lumped][..] } else { &[Metric::Mass] };
        for &metric in metrics {
            let plain = TikhonovOptions { metric, channels: 2, ..TikhonovOptions::default() };
            let family = built(&mut smoother, &values, &tikhonov(plain));
            all.push((format!("{weights_of_l:?} {operator:?} {metric:?}"), family, is_exact));
        }
    }
    (0..n).filter(|v| v % 7 == 3).for_each(|v| values[2 * v] = f64::NAN);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    for missing in [Missing::Omit, Missing::Fill] {
        let at = TikhonovOptions { missing, channels: 2, ..TikhonovOptions::default() };
        all.push((format!("{missing:?}"), built(&mut smoother, &values, &tikhonov(at)), true));
    }
    all
}

#[test]
fn sweeps_say_what_reports_say() {
    let watch = Watch::none();
    for (name, family, _) in families() {
        let list = epsilons(family.range(), 13);
        let at: Vec<_> = list.iter().map(|&epsilon| family.at(epsilon, &watch).unwrap()).collect();
        for channel in 0..2 {
            let options = SweepOptions { epsilons: Some(&list), counts: true, channel };
            let sweep = family.sweep(&options, &watch).unwrap();
            assert_eq!(sweep.epsilons, list);
            for (k, smoothed) in at.iter().enumerate() {
                let context = format!("{name} channel {channel} ε = {:e}", list[k]);
                let report = &smoothed.reports[channel];
                assert_eq!((report.epsilon, report.solver.route.name()), (Some(list[k]), "family"), "{context}");
                for (what, found, expected) in [
                    ("l∞", sweep.l_infinity[k], report.l_infinity),
                    ("metric", sweep.metric_norm[k], report.metric_norm),
                    ("‖Lx‖", sweep.laplacian_norm[k], report.laplacian_norm),
                    ("S(x)", sweep.sobolev[k], report.sobolev_after),
                ] {
                    // Norms of what is nearly nothing are differences of what is not.
                    let wrong = (found - expected).abs();
                    assert!(wrong <= 1e-7 * expected.abs() + 2e-8, "{context} {what}: {found:e} {expected:e}");
                }
                let counts = [sweep.minima[k], sweep.maxima[k], sweep.saddles[k]];
                assert_eq!(counts, [report.after.minima, report.after.maxima, report.after.saddles], "{context}");
            }
        }
        for (smoothed, &epsilon) in at.iter().zip(&list) {
            let bits = |values: &[f64]| -> Vec<u64> { values.iter().map(|x| x.to_bits()).collect() };
            assert_eq!(bits(&smoothed.values), bits(&family.values(epsilon).unwrap()), "{name} ε = {epsilon:e}");
        }
    }
}

#[test]
fn curves_are_monotone() {
    for (name, family, is_exact) in families() {
        let list = epsilons(family.range(), 301);
        for channel in 0..2 {
            let options = SweepOptions { epsilons: Some(&list), counts: false, channel };
            let sweep = family.sweep(&options, &Watch::none()).unwrap();
            assert!(sweep.minima.is_empty() && sweep.maxima.is_empty() && sweep.saddles.is_empty());
            let falls = |curve: &[f64]| curve.windows(2).all(|pair| pair[1] <= pair[0]);
            assert!(falls(&sweep.metric_norm), "{name} ‖x − f‖_B");
            let rises = |curve: &[f64]| curve.windows(2).all(|pair| pair[0] <= pair[1]);
            assert!(!is_exact || rises(&sweep.laplacian_norm), "{name} ‖Lx‖");
        }
        let usual = family.sweep(&SweepOptions::default(), &Watch::none()).unwrap();
        assert_eq!((usual.epsilons.len(), usual.metric_norm.len()), (41, 41));
        assert_eq!((usual.epsilons[0], usual.epsilons[40]), family.range());
        assert!(usual.l_curve_corner < 41);
    }
}

/// The trace of (LᵀWL + εB)⁻¹εB by dense algebra.
fn exact_trace(reference: &Reference, b: &DMatrix<f64>, unknowns: &[usize], epsilon: f64) -> f64 {
    let a = reference.laplacian.select_rows(unknowns).select_columns(unknowns);
    let weights: Vec<f64> = unknowns.iter().map(|&v| reference.weights[v]).collect();
    let b = b.select_rows(unknowns).select_columns(unknowns) * epsilon;
    let matrix = crate::dense_reference::squared(&a, &weights) + &b;
    matrix.lu().solve(&b).unwrap().trace()
}

#[test]
fn degrees_of_freedom_agree_with_dense_traces() {
    let two = together(&[shapes::torus(14, 9, 0.2).unwrap(), shapes::grid(11, 10).unwrap()]);
    let mut worst = (0.0, String::new());
    for (name, mesh) in [
        ("sphere", shapes::sphere(3).unwrap()),
        ("grid", shapes::grid(16, 18).unwrap()),
        ("torus", shapes::torus(20, 15, 0.3).unwrap()),
        ("two components", two),
    ] {
        let n = mesh.vertex_count();
        let f = noise(n, 2);
        for (metric, operator, range) in [
            (Metric::Identity, Operator::Paper, (1e-6, 1e4)),
            (Metric::Mass, Operator::Paper, (1e-6, 1e4)),
            (Metric::Mass, Operator::Fem, (1.0, 1e9)),
        ] {
            let mut smoother =
                Smoother::new(&mesh, SmootherOptions { operator, ..SmootherOptions::default() }).unwrap();
            let options = FamilyOptions {
                range,
                ..tikhonov(TikhonovOptions { metric, epsilon: range.0.max(0.05), ..TikhonovOptions::default() })
            };
            let family = built(&mut smoother, &f, &options);
            let reference = Reference::new(&smoother);
            let unknowns: Vec<usize> = (0..n).filter(|&v| reference.component[v].is_some()).collect();
            let b = match (operator, metric) {
                (Operator::Fem, _) => DMatrix::from_diagonal(&reference_mass(&mesh, MassScale::Raw).column_sum()),
                (_, Metric::Identity) => DMatrix::identity(n, n),
                _ => reference_mass(&mesh, MassScale::MeanOne),
            };
            let context = format!("{name} {metric:?} {operator:?}");
            let mut last = 0.0;
            for epsilon in epsilons(range, 41) {
                let found = family.degrees_of_freedom(epsilon).unwrap();
                assert!(found >= last, "{context}: fewer at ε = {epsilon:e}");
                last = found;
                let exact = exact_trace(&reference, &b, &unknowns, epsilon);
                // A few vectors with random signs tell as much of so small a matrix as √(2 tr/6).
                let wrong = (found - exact).abs() / (2.0 * exact / 6.0).sqrt();
                if wrong > worst.0 {
                    worst = (wrong, format!("{context} ε = {epsilon:e}: {found} where it is {exact}"));
                }
            }
            if operator == Operator::Paper {
                let components = if name == "two components" { 2.0 } else { 1.0 };
                let (low, high) = (family.degrees_of_freedom(1e-6).unwrap(), family.degrees_of_freedom(1e4).unwrap());
                assert!((low - components).abs() < 0.3, "{context}: {low} of {components}");
                assert!((high - unknowns.len() as f64).abs() < 0.03 * n as f64, "{context}: {high} of {n}");
            }
        }
    }
    // Four times the standard deviation.
    assert!(worst.0 < 4.0, "{worst:?}");
}

#[test]
fn degrees_of_freedom_go_to_the_number_of_known_values() {
    let mesh = shapes::torus(20, 15, 0.3).unwrap();
    let n = mesh.vertex_count();
    let mut values = noise(n, 2);
    (0..n).filter(|v| v % 4 == 1).for_each(|v| values[v] = f64::NAN);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    for metric in [Metric::Identity, Metric::Mass] {
        let at = TikhonovOptions { metric, missing: Missing::Fill, ..TikhonovOptions::default() };
        let family = built(&mut smoother, &values, &FamilyOptions { range: (1e-8, 1e6), ..tikhonov(at) });
        let ends = [1e-8, 1e6].map(|epsilon| family.degrees_of_freedom(epsilon).unwrap());
        assert!((ends[0] - 1.0).abs() < 0.1 && (ends[1] - 0.75 * n as f64).abs() < 1.0, "{metric:?}: {ends:?}");
    }
    let listed: Vec<u32> = (0..n as u32).step_by(10).collect();
    let constraints = Constraints { features: Features::Vertices(&listed), ..Constraints::default() };
    let method = Functional::LeastSquares(LeastSquaresOptions { constraints, ..LeastSquaresOptions::default() });
    let options = FamilyOptions { method, range: (1e-8, 1e6), ..FamilyOptions::default() };
    let family = built(&mut smoother, &noise(n, 2), &options);
    let ends = [1e-8, 1e6].map(|epsilon| family.degrees_of_freedom(epsilon).unwrap());
    assert!((ends[0] - 1.0).abs() < 0.1 && (ends[1] - 30.0).abs() < 0.1, "{ends:?}");
}

/// How many extrema live at an ε.
fn alive(lives: &[ExtremumLife], epsilon: f64, is_maximum: bool) -> u32 {
    lives
        .iter()
        .filter(|life| life.is_maximum == is_maximum && life.least <= epsilon && epsilon <= life.largest)
        .count() as u32
}

fn check_lives(family: &Family, per_decade: usize, context: &str) -> Vec<ExtremumLife> {
    let watch = Watch::none();
    let lives = family.lives(0, per_decade, &watch).unwrap();
    let mut grid: Vec<f64> = lives.iter().flat_map(|life| [life.least, life.largest]).collect();
    grid.sort_by(f64::total_cmp);
    grid.dedup();
    let sweep = family.sweep(&SweepOptions { epsilons: Some(&grid), counts: true, channel: 0 }, &watch).unwrap();
    for (k, &epsilon) in grid.iter().enumerate() {
        let found = [alive(&lives, epsilon, false), alive(&lives, epsilon, true)];
        assert_eq!(found, [sweep.minima[k], sweep.maxima[k]], "{context} ε = {epsilon:e}");
    }
    let length = |life: &ExtremumLife| life.largest / life.least;
    assert!(lives.windows(2).all(|pair| length(&pair[0]) >= length(&pair[1])), "{context}: the longest come first");
    // Everything that is there at the largest ε is born there, once.
    let largest = family.range().1;
    let born: Vec<&ExtremumLife> = lives.iter().filter(|life| life.largest == largest).collect();
    let extrema = family.sweep(&SweepOptions { epsilons: Some(&[largest]), counts: true, channel: 0 }, &watch).unwrap();
    assert_eq!(born.len() as u32, extrema.minima[0] + extrema.maxima[0], "{context}");
    let mut first: Vec<(u32, bool)> = born.iter().map(|life| (life.first_vertex, life.is_maximum)).collect();
    first.sort_unstable();
    first.dedup();
    assert_eq!(first.len(), born.len(), "{context}");
    lives
}

#[test]
fn lives_agree_with_counts() {
    for (name, family, _) in families() {
        check_lives(&family, 5, &name);
    }
}

#[test]
fn the_wide_bump_lives_longest() {
    let mesh = shapes::sphere(4).unwrap();
    let distance =
        |p: &[f64], centre: [f64; 3]| -> f64 { p.iter().zip(centre).map(|(x, c)| (x - c).powi(2)).sum::<f64>().sqrt() };
    let bump = |p: &[f64], centre: [f64; 3], width: f64| (-0.5 * (distance(p, centre) / width).powi(2)).exp();
    let (wide, narrow) = ([0.6, 0.8, 0.0], [-0.36, -0.48, 0.8]);
    let f: Vec<f64> = mesh
        .positions()
        .chunks_exact(3)
        .zip(noise(mesh.vertex_count(), 8))
        .map(|(p, noise)| bump(p, wide, 0.5) + bump(p, narrow, 0.12) + 0.1 * noise)
        .collect();
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let options = FamilyOptions { range: (1e-8, 1e3), tolerance: 1e-4, ..FamilyOptions::default() };
    let family = built(&mut smoother, &f, &options);
    let lives = check_lives(&family, 10, "two bumps");
    let maxima: Vec<&ExtremumLife> = lives.iter().filter(|life| life.is_maximum).collect();
    let at = |vertex: u32| mesh.position(vertex);
    // For the least ε a single maximum is left, the wide bump's; the narrow one comes soon after, before nearly all that is noise.
    assert!(maxima.len() > 100, "noise has maxima: {}", maxima.len());
    assert!(distance(&at(maxima[0].last_vertex), wide) < 0.7, "{:?}", maxima[0]);
    assert_eq!((maxima[0].least, maxima[0].largest), family.range());
    let place = maxima.iter().position(|life| distance(&at(life.last_vertex), narrow) < 0.3).unwrap();
    assert!((1..=3).contains(&place), "{place}: {:?}", &maxima[..6]);
    assert!(maxima[place].least > maxima[0].least, "{:?}", &maxima[..6]);
}
