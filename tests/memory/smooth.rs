//! Smoothing with too little memory: every call gives a result or `OutOfMemory`, and what comes after is right to the last bit.

use morse_smooth::field::{Features, Missing, Threshold};
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::smooth::{
    BilateralOptions, Constraints, Energy, Functional, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Method,
    Metric, Precision, PrescribeOptions, Smoother, SmootherOptions, SolverChoice, TikhonovOptions, Unconstrained,
};
use morse_smooth::{TriMesh, Watch};

use crate::{check, limited, usage};

fn methods(channels: usize, missing: Missing) -> Vec<Method<'static>> {
    let rule = Features::Persistence(Threshold::Relative(0.2));
    let constraints = Constraints { features: rule, stars: true, unconstrained: Unconstrained::Error };
    let tikhonov = |metric| Method::Tikhonov(TikhonovOptions { metric, channels, missing, ..Default::default() });
    let interpolate = |energy| Method::Interpolate(InterpolateOptions { constraints, energy, channels, missing });
    let fit = LeastSquaresOptions { constraints, channels, missing, ..Default::default() };
    let mut all = vec![
        tikhonov(Metric::Mass),
        tikhonov(Metric::Identity),
        interpolate(Energy::Harmonic),
        interpolate(Energy::Biharmonic),
        Method::LeastSquares(fit),
    ];
    if missing != Missing::Fill {
        all.push(Method::LowPass(LowPassOptions { channels, missing, ..Default::default() }));
        let lengths = BilateralOptions { radius: 0.05, sigma_distance: 0.03, sigma_value: 0.5, ..Default::default() };
        all.push(Method::Bilateral(BilateralOptions { channels, missing, ..lengths }));
    }
    if channels == 1 && missing != Missing::Fill {
        let functional = Functional::Tikhonov(TikhonovOptions { missing, ..Default::default() });
        let prescribed = PrescribeOptions { functional, complete: true, prominence: Some(0.01), ..Default::default() };
        all.push(Method::Prescribe(prescribed));
        all.push(Method::Prescribe(PrescribeOptions { preview: true, prominence: None, ..prescribed }));
    }
    all
}

#[test]
fn making_a_smoother() {
    for mesh in [shapes::torus(60, 40, 0.2).unwrap(), shapes::torus(160, 120, 0.2).unwrap()] {
        check("a smoother", 2.0, || Smoother::new(&mesh, SmootherOptions::default()).unwrap());
    }
}

/// Tries so many amounts of memory.
fn shortages(mesh: &TriMesh, options: SmootherOptions, parts: i64) {
    let n = mesh.vertex_count();
    for (channels, missing) in [(1, Missing::Error), (5, Missing::Error), (1, Missing::Omit), (1, Missing::Fill)] {
        let mut random = Random::new(2);
        let mut values: Vec<f64> = (0..n * channels).map(|_| random.signed()).collect();
        if missing != Missing::Error {
            values[n / 2..n / 2 + 40].fill(f64::NAN);
        }
        for method in methods(channels, missing) {
            let what = format!("{}, {channels} channels, {missing:?}", method.name().name());
            let fresh = || Smoother::new(mesh, options).unwrap();
            let mut smoother = fresh();
            let (expected, all) = usage(|| smoother.apply(&values, &method, &Watch::none()).unwrap());
            let bits = |values: &[f64]| -> Vec<u64> { values.iter().map(|x| x.to_bits()).collect() };
            let mut smoother = fresh();
            let mut refused = 0;
            for part in 0..parts {
                match limited(all.peak * part / parts, || smoother.apply(&values, &method, &Watch::none())) {
                    // Another route may have served that needs less memory, so values are compared below.
                    Ok(_) => smoother = fresh(),
                    Err(error) => {
                        assert_eq!(error.code(), "OutOfMemory", "{what}: {error}");
                        refused += 1;
                    }
                }
            }
            assert!(refused > 0, "{what}");
            let found = smoother.apply(&values, &method, &Watch::none()).unwrap();
            assert_eq!(bits(&found.values), bits(&expected.values), "{what}");
            assert_eq!(found.reports, expected.reports, "{what}");
        }
    }
}

#[test]
fn shortages_with_the_best_routes() {
    shortages(&shapes::torus(100, 60, 0.2).unwrap(), SmootherOptions::default(), 17);
}

#[test]
fn shortages_in_single_precision_with_bounds() {
    // Bounds take many solutions, so the mesh is smaller.
    let options = SmootherOptions { precision: Precision::Single, bounds: true, ..Default::default() };
    shortages(&shapes::torus(40, 30, 0.2).unwrap(), options, 9);
}

#[test]
fn shortages_without_factors() {
    let options = SmootherOptions { solver: SolverChoice::ConjugateGradient, ..Default::default() };
    shortages(&shapes::torus(100, 60, 0.2).unwrap(), options, 17);
}
