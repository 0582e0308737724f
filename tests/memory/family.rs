//! Families of all ε make sure of their memory before they take it, and are what they were where there is too little.

use morse_smooth::field::{Features, Missing};
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::smooth::{
    Constraints, EpsilonRule, Family, FamilyOptions, Functional, LeastSquaresOptions, Metric, Operator, Smoother,
    SmootherOptions, SweepOptions, TikhonovOptions,
};
use morse_smooth::{TriMesh, Watch};

use crate::{check, limited, usage};

fn noise(n: usize) -> Vec<f64> {
    let mut random = Random::new(2);
    (0..n).map(|_| random.signed()).collect()
}

/// Methods, operators and fields.
fn all_cases<'a>(mesh: &TriMesh, listed: &'a [u32]) -> Vec<(Functional<'a>, Operator, Vec<f64>)> {
    let n = mesh.vertex_count();
    let tikhonov = |metric, channels, missing| {
        Functional::Tikhonov(TikhonovOptions { metric, channels, missing, ..TikhonovOptions::default() })
    };
    let holed = |channels: usize| {
        let mut values = noise(n * channels);
        values[channels * (n / 2)..channels * (n / 2 + 40)].fill(f64::NAN);
        values
    };
    let constraints = Constraints { features: Features::Vertices(listed), ..Constraints::default() };
    let fit = LeastSquaresOptions { constraints, ..LeastSquaresOptions::default() };
    vec![
        (tikhonov(Metric::Mass, 1, Missing::Error), Operator::Paper, noise(n)),
        (tikhonov(Metric::Mass, 5, Missing::Error), Operator::Paper, noise(5 * n)),
        (tikhonov(Metric::Identity, 1, Missing::Error), Operator::Paper, noise(n)),
        (tikhonov(Metric::Mass, 1, Missing::Error), Operator::Fem, noise(n)),
        (tikhonov(Metric::Mass, 5, Missing::Omit), Operator::Paper, holed(5)),
        (tikhonov(Metric::Mass, 1, Missing::Fill), Operator::Paper, holed(1)),
        (Functional::LeastSquares(fit), Operator::Paper, noise(n)),
    ]
}

fn smoother(mesh: &TriMesh, operator: Operator) -> Smoother {
    Smoother::new(mesh, SmootherOptions { operator, ..SmootherOptions::default() }).unwrap()
}

fn family(smoother: &mut Smoother, values: &[f64], options: &FamilyOptions<'_>) -> Family {
    smoother.family(values, options, &Watch::none()).unwrap()
}

#[test]
fn what_families_are_asked() {
    let mesh = shapes::torus(90, 60, 0.2).unwrap();
    let listed: Vec<u32> = (0..mesh.vertex_count() as u32).step_by(7).collect();
    let watch = Watch::none();
    for (method, operator, values) in all_cases(&mesh, &listed) {
        let name = format!("{method:?} {operator:?}").chars().take(90).collect::<String>();
        let options = FamilyOptions { method, ..FamilyOptions::default() };
        let built = family(&mut smoother(&mesh, operator), &values, &options);
        check(&format!("values, {name}"), 2.5, || built.values(0.05).unwrap());
        check(&format!("at, {name}"), 4.0, || built.at(0.05, &watch).unwrap());
        check(&format!("sweep, {name}"), 4.0, || built.sweep(&SweepOptions::default(), &watch).unwrap());
        let counts = SweepOptions { counts: true, epsilons: Some(&[1e-3, 1.0]), channel: 0 };
        check(&format!("sweep with counts, {name}"), 4.0, || built.sweep(&counts, &watch).unwrap());
        check(&format!("lives, {name}"), 4.0, || built.lives(0, 2, &watch).unwrap());
        for rule in [
            EpsilonRule::Gcv,
            EpsilonRule::LCurve,
            EpsilonRule::Discrepancy { noise: None },
            EpsilonRule::AtMostCriticalPoints { count: 300 },
        ] {
            let what = format!("{rule:?}, {name}");
            check(&what, 4.0, || built.choose(rule, &watch).unwrap());
        }
    }
}

/// What a family answers, to the bit.
fn answers(family: &Family) -> Vec<u64> {
    let mut numbers = family.values(0.05).unwrap();
    numbers.extend(family.values(30.0).unwrap());
    numbers.extend([family.error_estimate(), family.degrees_of_freedom(1.0).unwrap()]);
    numbers.extend(family.shifts());
    numbers.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn shortages() {
    let mesh = shapes::torus(40, 30, 0.2).unwrap();
    let listed: Vec<u32> = (0..mesh.vertex_count() as u32).step_by(7).collect();
    let watch = Watch::none();
    let parts = 13;
    for (method, operator, values) in all_cases(&mesh, &listed) {
        let name = format!("{method:?} {operator:?}").chars().take(90).collect::<String>();
        let options = FamilyOptions { method, factorizations: Some(3), ..FamilyOptions::default() };
        let mut first = smoother(&mesh, operator);
        let (expected, all) = usage(|| family(&mut first, &values, &options));
        let mut short = smoother(&mesh, operator);
        let mut refused = 0;
        for part in 0..parts {
            match limited(all.peak * part / parts, || short.family(&values, &options, &watch)) {
                // Another route may have served that needs less memory.
                Ok(_) => short = smoother(&mesh, operator),
                Err(error) => {
                    assert_eq!(error.code(), "OutOfMemory", "{name}: {error}");
                    refused += 1;
                }
            }
        }
        assert!(refused > 0, "{name}");
        let mut found = family(&mut smoother(&mesh, operator), &values, &options);
        assert_eq!(answers(&found), answers(&expected), "{name}");

        // Growth that has too little memory leaves the family as it was.
        let mut growing = smoother(&mesh, operator);
        found = family(&mut growing, &values, &options);
        let mut other = smoother(&mesh, operator);
        let mut larger = family(&mut other, &values, &options);
        let (_, all) = usage(|| other.grow(&mut larger, &watch).unwrap());
        let before = answers(&found);
        let mut refused = 0;
        for part in 0..parts / 2 {
            match limited(all.peak * part / parts, || growing.grow(&mut found, &watch)) {
                Ok(_) => break,
                Err(error) => {
                    assert_eq!(error.code(), "OutOfMemory", "{name}: {error}");
                    assert_eq!(answers(&found), before, "{name}");
                    refused += 1;
                }
            }
        }
        assert!(refused > 0, "{name}");
        for bytes in [0, 30_000, 100_000] {
            for outcome in [
                limited(bytes, || found.values(0.05).map(|_| ())),
                limited(bytes, || found.at(0.05, &watch).map(|_| ())),
                limited(bytes, || {
                    found.sweep(&SweepOptions { counts: true, ..Default::default() }, &watch).map(|_| ())
                }),
                limited(bytes, || found.lives(0, 2, &watch).map(|_| ())),
                limited(bytes, || found.choose(EpsilonRule::Discrepancy { noise: None }, &watch).map(|_| ())),
                limited(bytes, || found.choose(EpsilonRule::AtMostCriticalPoints { count: 50 }, &watch).map(|_| ())),
            ] {
                let code = outcome.map_err(|error| error.code()).err();
                assert!(matches!(code, None | Some("OutOfMemory")), "{name}: {code:?}");
            }
        }
    }
}
