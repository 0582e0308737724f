//! Families that grow, are stopped, and are refused.

use core::ops::ControlFlow;

use morse_smooth::field::{Features, Missing};
use morse_smooth::mesh::shapes;
use morse_smooth::smooth::{
    Constraints, EpsilonRule, Family, FamilyOptions, Functional, LeastSquaresOptions, Metric, Smoother,
    SmootherOptions, SolverChoice, SweepOptions, TikhonovOptions,
};
use morse_smooth::{Error, Progress, Watch};

use crate::family::{built, epsilons, tikhonov};
use crate::support::noise;

/// All that a family answers, to the bit.
fn answers(family: &Family) -> (Vec<u64>, Vec<f64>, String) {
    let watch = Watch::none();
    let list = epsilons(family.range(), 7);
    let bits = list.iter().flat_map(|&epsilon| family.values(epsilon).unwrap()).map(f64::to_bits).collect();
    let mut numbers = vec![family.error_estimate(), family.dimension() as f64];
    numbers.extend(family.shifts());
    for &epsilon in &list {
        numbers.extend([family.error_at(epsilon).unwrap(), family.degrees_of_freedom(epsilon).unwrap()]);
    }
    let sweep = family.sweep(&SweepOptions { counts: true, ..SweepOptions::default() }, &watch).unwrap();
    let chosen = [EpsilonRule::Gcv, EpsilonRule::LCurve].map(|rule| family.choose(rule, &watch).unwrap());
    (bits, numbers, format!("{sweep:?} {chosen:?}"))
}

fn kinds(listed: &[u32]) -> Vec<(Functional<'_>, SmootherOptions)> {
    let plain = SmootherOptions::default();
    let of = |metric, missing| {
        Functional::Tikhonov(TikhonovOptions { metric, missing, channels: 5, ..TikhonovOptions::default() })
    };
    let constraints = Constraints { features: Features::Vertices(listed), ..Constraints::default() };
    let fit = LeastSquaresOptions { constraints, channels: 5, ..LeastSquaresOptions::default() };
    let iterative = SmootherOptions { solver: SolverChoice::ConjugateGradient, ..plain };
    vec![
        (of(Metric::Mass, Missing::Error), plain),
        (of(Metric::Identity, Missing::Error), plain),
        (of(Metric::Mass, Missing::Omit), plain),
        (of(Metric::Lumped, Missing::Fill), plain),
        (Functional::LeastSquares(fit), plain),
        (of(Metric::Mass, Missing::Error), iterative),
    ]
}

fn values_for(method: &Functional<'_>, n: usize) -> Vec<f64> {
    let mut values = noise(5 * n, 9);
    if let Functional::Tikhonov(TikhonovOptions { missing: Missing::Omit | Missing::Fill, .. }) = method {
        values[5 * 31..5 * 40].fill(f64::NAN);
    }
    values
}

#[test]
fn grown_families_are_those_built_at_once() {
    let mesh = shapes::torus(17, 13, 0.3).unwrap();
    let listed: Vec<u32> = (0..mesh.vertex_count() as u32).step_by(5).collect();
    for (method, options) in kinds(&listed) {
        let values = values_for(&method, mesh.vertex_count());
        let whole = FamilyOptions { method, ..FamilyOptions::default() };
        let expected = built(&mut Smoother::new(&mesh, options).unwrap(), &values, &whole);
        let mut smoother = Smoother::new(&mesh, options).unwrap();
        let mut family = built(&mut smoother, &values, &FamilyOptions { factorizations: Some(1), ..whole });
        let mut errors = vec![family.error_estimate()];
        assert_eq!((family.shifts(), family.is_complete()), (&[0.05][..], false));
        while !family.is_complete() {
            let before = family.shifts().len();
            // Other calls in between, which take the factors, change nothing.
            smoother.tikhonov(&noise(mesh.vertex_count(), 1), &TikhonovOptions::default()).unwrap();
            let is_complete = smoother.grow(&mut family, &Watch::none()).unwrap();
            assert_eq!((is_complete, family.shifts().len()), (family.is_complete(), before + 1));
            errors.push(family.error_estimate());
        }
        assert!(expected.is_complete() && family.error_estimate() <= 1e-6, "{method:?}: {errors:?}");
        assert!(answers(&family) == answers(&expected), "{method:?} {options:?}");
        // What is complete grows no more.
        assert!(smoother.grow(&mut family, &Watch::none()).unwrap());
        assert!(answers(&family) == answers(&expected), "{method:?} {options:?}");
    }
}

#[test]
fn growth_that_is_stopped_leaves_the_family_as_it_was() {
    let mesh = shapes::torus(40, 30, 0.2).unwrap();
    let listed: Vec<u32> = (0..mesh.vertex_count() as u32).step_by(5).collect();
    for (method, options) in kinds(&listed) {
        let values = values_for(&method, mesh.vertex_count());
        let mut smoother = Smoother::new(&mesh, options).unwrap();
        let limited = FamilyOptions { method, factorizations: Some(2), ..FamilyOptions::default() };
        let mut family = built(&mut smoother, &values, &limited);
        let before = answers(&family);
        let mut stopped = 0;
        for last in 0.. {
            let mut asked = 0;
            let mut stop = |_: Progress| {
                asked += 1;
                if asked > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            match smoother.grow(&mut family, &Watch::new(&mut stop)) {
                Ok(_) => {
                    assert!(asked <= last);
                    break;
                }
                Err(error) => assert_eq!((error.code(), asked), ("Cancelled", last + 1)),
            }
            stopped += 1;
            assert!(answers(&family) == before, "{method:?} {options:?}: stopped at question {last}");
        }
        assert!(stopped >= 2, "{method:?} {options:?}: {stopped} questions");
        let three = FamilyOptions { factorizations: Some(3), ..limited };
        let expected = built(&mut Smoother::new(&mesh, options).unwrap(), &values, &three);
        assert!(answers(&family) == answers(&expected), "{method:?} {options:?}");
    }
}

#[test]
fn building_and_asking_end_wherever_they_are_stopped() {
    let mesh = shapes::torus(40, 30, 0.2).unwrap();
    let listed: Vec<u32> = (0..mesh.vertex_count() as u32).step_by(5).collect();
    for (method, options) in kinds(&listed) {
        let values = values_for(&method, mesh.vertex_count());
        let limited = FamilyOptions { method, factorizations: Some(4), ..FamilyOptions::default() };
        let mut smoother = Smoother::new(&mesh, options).unwrap();
        let mut told = Vec::new();
        let mut tell = |progress: Progress| {
            told.push(progress.fraction);
            ControlFlow::Continue(())
        };
        let expected = smoother.family(&values, &limited, &Watch::new(&mut tell)).unwrap();
        assert!(told.windows(2).all(|pair| pair[0] <= pair[1]) && told.last() == Some(&1.0), "{told:?}");
        let sweep = SweepOptions { counts: true, ..SweepOptions::default() };
        type Call<'a> = Box<dyn FnMut(&Watch<'_>) -> Result<(), Error> + 'a>;
        let family = &expected;
        let calls: Vec<(&str, Call<'_>)> = vec![
            ("family", Box::new(|watch| smoother.family(&values, &limited, watch).map(|_| ()))),
            ("at", Box::new(|watch| family.at(0.05, watch).map(|_| ()))),
            ("sweep", Box::new(|watch| family.sweep(&sweep, watch).map(|_| ()))),
            ("lives", Box::new(|watch| family.lives(0, 4, watch).map(|_| ()))),
            (
                "choose",
                Box::new(|watch| family.choose(EpsilonRule::AtMostCriticalPoints { count: 30 }, watch).map(|_| ())),
            ),
        ];
        for (name, mut call) in calls {
            let mut questions = 0;
            let mut count = |_: Progress| {
                questions += 1;
                ControlFlow::Continue(())
            };
            call(&Watch::new(&mut count)).unwrap();
            assert!(questions >= 2, "{name}: {questions}");
            for last in (0..questions).step_by(1 + questions / 12) {
                let mut asked = 0;
                let mut stop = |_: Progress| {
                    asked += 1;
                    if asked > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                };
                let refused = call(&Watch::new(&mut stop)).map_err(|error| error.code()).err();
                assert!(refused == Some("Cancelled") || asked <= last, "{name}: {refused:?}");
                assert!(asked <= last + 1, "{name}: asked again after it was stopped");
            }
        }
        let again = built(&mut smoother, &values, &limited);
        assert!(answers(&again) == answers(&expected), "{method:?} {options:?}");
    }
}

#[test]
fn families_of_other_smoothers_are_refused() {
    let mesh = shapes::torus(17, 13, 0.3).unwrap();
    let mut smoothers = [0, 1].map(|_| Smoother::new(&mesh, SmootherOptions::default()).unwrap());
    for missing in [Missing::Error, Missing::Omit, Missing::Fill] {
        let mut values = noise(mesh.vertex_count(), 2);
        if missing != Missing::Error {
            values[20] = f64::NAN;
        }
        let options = tikhonov(TikhonovOptions { missing, ..TikhonovOptions::default() });
        let mut family = built(&mut smoothers[0], &values, &FamilyOptions { factorizations: Some(1), ..options });
        let before = answers(&family);
        let refused = smoothers[1].grow(&mut family, &Watch::none()).unwrap_err();
        assert_eq!(refused.code(), "InvalidOption");
        assert_eq!(refused.detail()[0], ("option", "family".into()));
        assert!(answers(&family) == before);
        // Its own smoother has seen another field with other gaps in between.
        values[40] = f64::NAN;
        let at = TikhonovOptions { missing: Missing::Omit, ..TikhonovOptions::default() };
        smoothers[0].tikhonov(&values, &at).unwrap();
        while !smoothers[0].grow(&mut family, &Watch::none()).unwrap() {}
        assert!(family.error_estimate() <= 1e-6, "{missing:?}");
    }
}

#[test]
fn what_families_refuse() {
    let mesh = shapes::torus(13, 10, 0.2).unwrap();
    let n = mesh.vertex_count();
    let f = noise(n, 2);
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let plain = FamilyOptions::default();
    let mut option = |options: FamilyOptions<'_>| {
        let refused = smoother.family(&f, &options, &Watch::none()).unwrap_err();
        assert_eq!(refused.code(), "InvalidOption", "{options:?}");
        refused.detail()[0].1.clone()
    };
    for range in [
        (0.0, 1.0),
        (-1.0, 1.0),
        (1.0, 1.0),
        (2.0, 1.0),
        (1.0, f64::INFINITY),
        (f64::NAN, 1.0),
        (1.0, f64::NAN),
        (1e-9, 1e8),
    ] {
        assert_eq!(option(FamilyOptions { range, ..plain }), "epsilonRange".into());
    }
    for tolerance in [0.0, -1.0, 1.0, 2.0, 1e-11, f64::NAN, f64::INFINITY] {
        assert_eq!(option(FamilyOptions { tolerance, ..plain }), "tolerance".into());
    }
    assert_eq!(option(FamilyOptions { factorizations: Some(0), ..plain }), "factorizations".into());
    for epsilon in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(option(tikhonov(TikhonovOptions { epsilon, ..TikhonovOptions::default() })), "epsilon".into());
    }
    assert_eq!(option(tikhonov(TikhonovOptions { channels: 0, ..TikhonovOptions::default() })), "channels".into());
    let mut code = |values: &[f64], options: &FamilyOptions<'_>| {
        smoother.family(values, options, &Watch::none()).map_err(|error| error.code()).err()
    };
    let unconstrained = Functional::LeastSquares(LeastSquaresOptions::default());
    assert_eq!(code(&f, &FamilyOptions { method: unconstrained, ..plain }), Some("Unconstrained"));
    assert_eq!(code(&f[1..], &plain), Some("LengthMismatch"));
    let mut holed = f.clone();
    holed[3] = f64::NAN;
    assert_eq!(code(&holed, &plain), Some("NonFiniteValue"));

    // A first ε beyond the range begins at its end.
    let family = built(&mut smoother, &f, &FamilyOptions { range: (1.0, 100.0), ..plain });
    assert_eq!(family.shifts()[0], 1.0);
    let watch = Watch::none();
    let named = |error: Error| (error.code(), error.detail()[0].1.clone());
    for epsilon in [0.999, 100.1, 0.0, -1.0, f64::NAN, f64::INFINITY] {
        let list = [2.0, epsilon];
        let refused = [
            family.values(epsilon).unwrap_err(),
            family.at(epsilon, &watch).unwrap_err(),
            family.error_at(epsilon).unwrap_err().into(),
            family.degrees_of_freedom(epsilon).unwrap_err().into(),
            family.sweep(&SweepOptions { epsilons: Some(&list), ..SweepOptions::default() }, &watch).unwrap_err(),
        ];
        for error in refused {
            assert_eq!(named(error), ("InvalidOption", "epsilon".into()), "{epsilon}");
        }
    }
    let beyond = SweepOptions { channel: 1, ..SweepOptions::default() };
    assert_eq!(named(family.sweep(&beyond, &watch).unwrap_err()), ("InvalidOption", "channel".into()));
    assert_eq!(named(family.lives(1, 4, &watch).unwrap_err()), ("InvalidOption", "channel".into()));
    for per_decade in [0, 101] {
        assert_eq!(named(family.lives(0, per_decade, &watch).unwrap_err()), ("InvalidOption", "perDecade".into()));
    }
    for noise in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        let refused = family.choose(EpsilonRule::Discrepancy { noise: Some(noise) }, &watch).unwrap_err();
        assert_eq!(named(refused), ("InvalidOption", "noise".into()));
    }
}

#[test]
fn powers_of_ten_are_exactly_so() {
    let mesh = shapes::torus(13, 10, 0.2).unwrap();
    let mut smoother = Smoother::new(&mesh, SmootherOptions::default()).unwrap();
    let family = built(&mut smoother, &noise(mesh.vertex_count(), 2), &FamilyOptions::default());
    let sweep = family.sweep(&SweepOptions::default(), &Watch::none()).unwrap();
    for exponent in -6..=4 {
        let power: f64 = format!("1e{exponent}").parse().unwrap();
        assert!(sweep.epsilons.contains(&power), "{power:e}: {:?}", sweep.epsilons);
    }
    let is_rounded = |shift: &f64| {
        let power: f64 = format!("1e{}", shift.log10().round()).parse().unwrap();
        *shift == power || (shift / power - 1.0).abs() > 1e-9
    };
    assert!(family.shifts().iter().all(is_rounded), "{:?}", family.shifts());
}
