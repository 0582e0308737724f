//! Smoothing: what is made sure of covers making a smoother and every method, with its systems and without.

use morse_smooth::Watch;
use morse_smooth::field::{Features, Missing, Threshold};
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::smooth::{
    BilateralOptions, Constraints, Energy, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Method, Metric,
    Precision, Smoother, SmootherOptions, SolverChoice, TikhonovOptions, Unconstrained,
};

use crate::check;

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
    all
}

#[test]
fn smoothing() {
    let settings = [
        SmootherOptions::default(),
        SmootherOptions { precision: Precision::Single, bounds: true, ..Default::default() },
        SmootherOptions { solver: SolverChoice::ConjugateGradient, ..Default::default() },
    ];
    let mut wrong = Vec::new();
    for (name, mesh) in [
        ("a small torus", shapes::torus(60, 40, 0.2).unwrap()),
        ("a torus", shapes::torus(160, 120, 0.2).unwrap()),
        ("a grid", shapes::grid(150, 100).unwrap()),
    ] {
        let n = mesh.vertex_count();
        for options in settings {
            let mut smoother = check(&format!("a smoother on {name}"), 2.0, || Smoother::new(&mesh, options).unwrap());
            for (channels, missing) in
                [(1, Missing::Error), (5, Missing::Error), (1, Missing::Omit), (1, Missing::Fill)]
            {
                let mut random = Random::new(2);
                let mut values: Vec<f64> = (0..n * channels).map(|_| random.signed()).collect();
                if missing != Missing::Error {
                    values[n / 2..n / 2 + 40].fill(f64::NAN);
                }
                for method in methods(channels, missing) {
                    // Once with everything to be made, once with what is kept.
                    for again in ["", " again"] {
                        let what =
                            format!("{}{again}, {channels} channels, {missing:?}, on {name}", method.name().name());
                        let (outcome, usage) = crate::usage(|| smoother.apply(&values, &method, &Watch::none()));
                        outcome.unwrap();
                        if usage.excess > crate::SMALL
                            || usage.ensured as f64 > 2.5 * usage.peak as f64 + crate::SMALL as f64
                        {
                            wrong.push(format!(
                                "{what} ({options:?}): {} beyond {} made sure of, peak {}",
                                usage.excess, usage.ensured, usage.peak
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
