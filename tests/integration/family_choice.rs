//! How well ε is chosen: known fields with seeded noise, where the best ε is known, too.

use morse_smooth::Watch;
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::smooth::{
    Confidence, EpsilonRule, Family, FamilyOptions, Functional, LeastSquaresOptions, Smoother, SmootherOptions,
    SweepOptions,
};

use crate::data::say;
use crate::family::{built, epsilons};
use crate::support::noise;

/// Positions in the unit cube, by the longest side of the mesh.
fn unit_positions(mesh: &TriMesh) -> Vec<[f64; 3]> {
    let p = mesh.positions();
    let end = |i: usize, pick: fn(f64, f64) -> f64, first: f64| p.iter().skip(i).step_by(3).copied().fold(first, pick);
    let low = [0, 1, 2].map(|i| end(i, f64::min, f64::MAX));
    let side = (0..3).map(|i| end(i, f64::max, f64::MIN) - low[i]).fold(0.0, f64::max);
    p.chunks_exact(3).map(|p| [0, 1, 2].map(|i| (p[i] - low[i]) / side)).collect()
}

fn normalized(values: &[f64]) -> Vec<f64> {
    let (min, max) = values.iter().fold((f64::MAX, f64::MIN), |(a, b), &x| (a.min(x), b.max(x)));
    values.iter().map(|x| (x - min) / (max - min)).collect()
}

/// The ε that a reason names.
fn told(reason: &str) -> f64 {
    let number = reason.split("ε = ").nth(1).unwrap().split(|c: char| " ,:;".contains(c)).next().unwrap();
    number.trim_end_matches('.').parse().unwrap()
}

/// From slow to fast, with a kink.
fn known_fields(mesh: &TriMesh) -> Vec<(&'static str, Vec<f64>)> {
    let q = unit_positions(mesh);
    let centres: Vec<[f64; 3]> = q.iter().step_by(q.len() / 5).take(4).copied().collect();
    let bumps = |v: &[f64; 3]| {
        let square = |c: &[f64; 3]| (0..3).map(|i| (v[i] - c[i]).powi(2)).sum::<f64>();
        centres.iter().map(|c| (-square(c) / 0.02).exp()).sum()
    };
    type Formula<'a> = &'a dyn Fn(&[f64; 3]) -> f64;
    let formulas: [(&str, Formula<'_>); 5] = [
        ("height", &|v| v[1] + 0.3 * v[0]),
        ("waves", &|v| (9.0 * v[0]).sin() * (7.0 * v[1]).cos()),
        ("bumps", &bumps),
        ("crease", &|v| (v[0] - 0.4).abs() + (v[1] - 0.4).abs()),
        ("fine", &|v| (25.0 * v[0]).sin() + (21.0 * v[1]).cos()),
    ];
    formulas
        .into_iter()
        .map(|(name, formula)| (name, normalized(&q.iter().map(formula).collect::<Vec<f64>>())))
        .collect()
}

/// Nearly normal noise of standard deviation 1: twelve uniform numbers together.
fn normal_noise(n: usize, seed: u64) -> Vec<f64> {
    noise(12 * n, seed).chunks_exact(12).map(|numbers| 0.5 * numbers.iter().sum::<f64>()).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn rules_come_near_to_the_best_epsilon() {
    let meshes = [("closed", shapes::torus(70, 50, 0.25).unwrap()), ("open", shapes::terrain(62, 58, 3).unwrap())];
    let rules = [
        EpsilonRule::Gcv,
        EpsilonRule::LCurve,
        EpsilonRule::Discrepancy { noise: None },
        EpsilonRule::Discrepancy { noise: Some(1.0) },
    ];
    let watch = Watch::none();
    let mut good = [0; 4];
    let mut noise_errors = Vec::new();
    let mut table = "mesh   field   noise   GCV  L-curve  discrepancy: estimated, given;  noise estimated\n".to_owned();
    for (kind, mesh) in meshes {
        let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
        for (k, (name, truth)) in known_fields(&mesh).into_iter().enumerate() {
            for (j, sigma) in [0.01, 0.05, 0.2].into_iter().enumerate() {
                let random = normal_noise(truth.len(), 100 * k as u64 + j as u64 + 1);
                let f: Vec<f64> = truth.iter().zip(&random).map(|(x, e)| x + sigma * e).collect();
                let options = FamilyOptions { tolerance: 1e-4, ..FamilyOptions::default() };
                let family = built(&mut smoother, &f, &options);
                let error = |epsilon: f64| distance(&family.values(epsilon).unwrap(), &truth);
                let best = epsilons(family.range(), 101).into_iter().map(error).fold(f64::MAX, f64::min);
                table += &format!("{kind:6} {name:7} {sigma:5}");
                for (place, rule) in rules.into_iter().enumerate() {
                    let rule = match rule {
                        EpsilonRule::Discrepancy { noise: Some(_) } => EpsilonRule::Discrepancy { noise: Some(sigma) },
                        other => other,
                    };
                    let chosen = family.choose(rule, &watch).unwrap();
                    assert_eq!(chosen.rule, rule.name());
                    assert!((told(&chosen.reason) / chosen.epsilon - 1.0).abs() < 1e-3, "{}", chosen.reason);
                    let quotient = error(chosen.epsilon) / best;
                    good[place] += usize::from(quotient <= 1.3);
                    table += &format!(" {quotient:8.3}");
                    if let Some(level) = chosen.noise {
                        let wrong = level.standard_deviation / sigma - 1.0;
                        noise_errors.push((wrong.abs(), level.confidence));
                        table += &format!(
                            "  ({:.3} {:.3} {:?})",
                            level.standard_deviation / sigma,
                            level.by_differences / sigma,
                            level.confidence
                        );
                    }
                }
                table += &format!("  {} shifts\n", family.shifts().len());
            }
        }
    }
    noise_errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (median, worst) = (noise_errors[noise_errors.len() / 2].0, noise_errors[noise_errors.len() - 1]);
    say(&format!("{table}within 1.3 of the best: {good:?} of {}", noise_errors.len()));
    say(&format!("noise estimated within {median:.3} (median), {worst:?} (worst)"));
    assert_eq!(noise_errors.len(), 30);
    assert!(median <= 0.15, "{median}");
    // Where both ways of finding the noise agree, they are right.
    for (wrong, confidence) in &noise_errors {
        assert!(*confidence != Confidence::High || *wrong <= 0.15, "{wrong}\n{table}");
    }
    assert!(good[0] >= 24, "GCV: {} of 30\n{table}", good[0]);
    assert!(good[2] >= 22, "discrepancy with estimated noise: {} of 30\n{table}", good[2]);
    assert!(good[3] >= 22, "discrepancy with given noise: {} of 30\n{table}", good[3]);
    assert!(good[1] >= 18, "L-curve: {} of 30\n{table}", good[1]);
}

/// How many critical points there are at an ε, saddles with multiplicity.
fn counts(family: &Family, list: &[f64]) -> Vec<usize> {
    let options = SweepOptions { epsilons: Some(list), counts: true, channel: 0 };
    let sweep = family.sweep(&options, &Watch::none()).unwrap();
    (0..list.len()).map(|k| (sweep.minima[k] + sweep.maxima[k] + sweep.saddles[k]) as usize).collect()
}

#[test]
fn at_most_so_many_critical_points() {
    let mesh = shapes::torus(40, 30, 0.25).unwrap();
    let truth = normalized(&mesh.positions().chunks_exact(3).map(|p| p[1]).collect::<Vec<f64>>());
    let f: Vec<f64> = truth.iter().zip(normal_noise(truth.len(), 5)).map(|(x, noise)| x + 0.1 * noise).collect();
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let family = built(&mut smoother, &f, &FamilyOptions::default());
    let watch = Watch::none();
    for count in [4, 8, 20, 60, 150] {
        let rule = EpsilonRule::AtMostCriticalPoints { count };
        let chosen = family.choose(rule, &watch).unwrap();
        assert_eq!(chosen.rule, rule.name());
        let found = counts(&family, &[chosen.epsilon])[0];
        assert!(found <= count, "{found} of {count}");
        assert!(chosen.reason.contains(&format!("it has {found}")), "{}", chosen.reason);
        let report = &family.at(chosen.epsilon, &watch).unwrap().reports[0];
        assert_eq!((report.after.minima + report.after.maxima + report.after.saddles) as usize, found);
        // A twentieth of a decade further there are more, all the way up.
        let step = 10_f64.powf(0.05);
        let mut list = Vec::new();
        let mut epsilon = chosen.epsilon * step;
        while epsilon < family.range().1 {
            list.push(epsilon);
            epsilon *= step;
        }
        assert!(!list.is_empty(), "{count}");
        assert!(counts(&family, &list).into_iter().all(|found| found > count), "{count}");
    }
    // More than there ever are: the largest ε.
    let all = family.choose(EpsilonRule::AtMostCriticalPoints { count: 100_000 }, &watch).unwrap();
    assert_eq!(all.epsilon, family.range().1);
    // A torus has four at least.
    let refused = family.choose(EpsilonRule::AtMostCriticalPoints { count: 3 }, &watch).unwrap_err();
    assert_eq!(refused.code(), "TooManyCriticalPoints");
    let detail = refused.detail();
    assert_eq!(detail[0], ("wanted", 3_u64.into()));
    assert_eq!(detail[1], ("least", 4_u64.into()));
}

#[test]
fn rules_see_all_channels() {
    let mesh = shapes::torus(40, 30, 0.25).unwrap();
    let n = mesh.vertex_count();
    let smooth = normalized(&mesh.positions().chunks_exact(3).map(|p| p[1]).collect::<Vec<f64>>());
    let rough: Vec<f64> = smooth.iter().zip(normal_noise(n, 5)).map(|(x, e)| 100.0 * (x + 0.2 * e)).collect();
    let watch = Watch::none();
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let method = |channels| {
        let plain = morse_smooth::smooth::TikhonovOptions { channels, ..Default::default() };
        FamilyOptions { method: Functional::Tikhonov(plain), ..FamilyOptions::default() }
    };
    let alone = built(&mut smoother, &rough, &method(1));
    // Thrice the same field: every rule finds what it finds for one, noise in the units of the field.
    let thrice: Vec<f64> = rough.iter().flat_map(|&x| [x; 3]).collect();
    let together = built(&mut smoother, &thrice, &method(3));
    for rule in [
        EpsilonRule::Gcv,
        EpsilonRule::LCurve,
        EpsilonRule::Discrepancy { noise: None },
        EpsilonRule::Discrepancy { noise: Some(20.0) },
        EpsilonRule::AtMostCriticalPoints { count: 30 },
    ] {
        let (one, three) = (alone.choose(rule, &watch).unwrap(), together.choose(rule, &watch).unwrap());
        // Each has probes of its own.
        assert!((one.epsilon / three.epsilon).ln().abs() < 0.25, "{rule:?}: {} {}", one.epsilon, three.epsilon);
        if let (Some(one), Some(three)) = (one.noise, three.noise) {
            assert!((one.standard_deviation / 20.0 - 1.0).abs() < 0.15, "{one:?}");
            assert!((one.standard_deviation / three.standard_deviation - 1.0).abs() < 0.05, "{one:?} {three:?}");
        }
    }
}

#[test]
fn rules_work_for_least_squares() {
    let mesh = shapes::torus(40, 30, 0.25).unwrap();
    let truth = normalized(&mesh.positions().chunks_exact(3).map(|p| p[1]).collect::<Vec<f64>>());
    let f: Vec<f64> = truth.iter().zip(normal_noise(truth.len(), 6)).map(|(x, noise)| x + 0.05 * noise).collect();
    let listed: Vec<u32> = (0..f.len() as u32).step_by(3).collect();
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let constraints = morse_smooth::smooth::Constraints {
        features: morse_smooth::field::Features::Vertices(&listed),
        ..Default::default()
    };
    let method = Functional::LeastSquares(LeastSquaresOptions { constraints, ..LeastSquaresOptions::default() });
    let family = built(&mut smoother, &f, &FamilyOptions { method, ..FamilyOptions::default() });
    let error = |epsilon: f64| distance(&family.values(epsilon).unwrap(), &truth);
    let best = epsilons(family.range(), 101).into_iter().map(error).fold(f64::MAX, f64::min);
    for rule in [EpsilonRule::Gcv, EpsilonRule::Discrepancy { noise: None }] {
        let chosen = family.choose(rule, &Watch::none()).unwrap();
        let quotient = error(chosen.epsilon) / best;
        assert!(quotient <= 1.3, "{rule:?}: {quotient}");
    }
}
