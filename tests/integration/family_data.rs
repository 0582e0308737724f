//! Families of the fields of the data folder against refined exact solutions. Without the folder nothing is checked, and the tests
//! say so.

use morse_smooth::Watch;
use morse_smooth::field::{DeltaOptions, Features, LinkReading};
use morse_smooth::smooth::{
    Constraints, FamilyOptions, Functional, LeastSquaresOptions, Metric, Operator, Smoothed, Smoother, SmootherOptions,
    TikhonovOptions, Unconstrained,
};

use crate::data::{as_array, folder, read, say, values};
use crate::family::{epsilons, relative};

/// The most factorisations.
const MOST: usize = 14;

/// A field of a file; whether it has long plateaus of equal values, where the last bits tell which of their vertices are critical.
struct Case {
    file: &'static str,
    field: &'static str,
    has_plateaus: bool,
}

const fn case(file: &'static str, field: &'static str, has_plateaus: bool) -> Case {
    Case { file, field, has_plateaus }
}

const SMALL: [Case; 4] = [
    case("disk_flow_surface.vtk", "Temp", true),
    case("spot.obj", "eig20", false),
    case("spot.obj", "eig20_noisy", false),
    case("torus_irregular.ply", "noisy", false),
];

const MEDIUM: [Case; 4] = [
    case("fsaverage5_lh_white.ply", "sulc", false),
    case("fsaverage5_lh_white.ply", "curv", true),
    case("genus22.ply", "clean", false),
    case("genus22.ply", "noisy", false),
];

const LARGE: [Case; 3] = [
    case("lysozyme_potential.ply", "potential", false),
    case("jacksboro_dem.ply", "elevation", true),
    case("egm96_geoid_1deg.ply", "geoid_m", false),
];

fn least_squares() -> LeastSquaresOptions<'static> {
    let rule = DeltaOptions { delta: 0.02, link: LinkReading::Skip, ..DeltaOptions::default() };
    let features = Features::CriticalPoints(rule);
    let constraints = Constraints { features, stars: true, unconstrained: Unconstrained::Error };
    LeastSquaresOptions { constraints, ..LeastSquaresOptions::default() }
}

fn exact(smoother: &mut Smoother, f: &[f64], method: Functional<'_>, epsilon: f64) -> Smoothed {
    match method {
        Functional::Tikhonov(options) => smoother.tikhonov(f, &TikhonovOptions { epsilon, ..options }),
        Functional::LeastSquares(options) => smoother.least_squares(f, &LeastSquaresOptions { epsilon, ..options }),
    }
    .expect("a solution")
}

/// Compares the families of some fields with exact solutions at so many ε.
fn check(cases: &[Case], count: usize) {
    let Some(folder) = folder() else {
        say("NOT RUN: the data sets are not there; MORSE_SMOOTH_DATA names their folder");
        return;
    };
    let mut failures = Vec::new();
    for Case { file, field, has_plateaus } in cases {
        let loaded = read(&folder, file);
        let f = values(&folder, file, &loaded, field);
        let all: Vec<usize> = (0..f.len()).collect();
        for (name, operator, method) in [
            ("identity", Operator::Paper, Functional::Tikhonov(with(Metric::Identity))),
            ("mass", Operator::Paper, Functional::Tikhonov(with(Metric::Mass))),
            ("fem", Operator::Fem, Functional::Tikhonov(with(Metric::Mass))),
            ("least squares", Operator::Paper, Functional::LeastSquares(least_squares())),
        ] {
            let context = format!("{file} {field} {name}");
            let options = SmootherOptions { operator, ..SmootherOptions::default() };
            let mut smoother = Smoother::new(&loaded.mesh, options).expect("cotangents");
            let options = FamilyOptions { method, ..FamilyOptions::default() };
            let family = match smoother.family(&f, &options, &Watch::none()) {
                // The rule finds no vertex in some files.
                Err(error) if error.code() == "Unconstrained" => continue,
                family => family.expect("a family"),
            };
            let (mut worst, mut different) = ((0.0, 0.0), 0);
            // What is largest hides between shifts: the estimate's own largest is looked at, too.
            let mut list = epsilons(family.range(), count);
            let estimate = |epsilon: &f64| family.error_at(*epsilon).expect("in the range");
            let fine = epsilons(family.range(), 241);
            list.extend(fine.into_iter().max_by(|a, b| estimate(a).total_cmp(&estimate(b))));
            for &epsilon in &list {
                let expected = exact(&mut smoother, &f, method, epsilon);
                let found = family.at(epsilon, &Watch::none()).expect("in the range");
                let wrong = relative(&f, &found.values, &expected.values, &all);
                worst = if wrong > worst.0 || wrong.is_nan() { (wrong, epsilon) } else { worst };
                let counts = [&found, &expected].map(|smoothed| as_array(&smoothed.reports[0].after));
                if counts[0] != counts[1] {
                    different += 1;
                    if !has_plateaus {
                        failures.push(format!("{context} ε = {epsilon:e}: {counts:?}"));
                    }
                }
            }
            let (wrong, at) = worst;
            let estimated = family.error_estimate();
            say(&format!(
                "{context}: {} shifts, dimension {}, error {wrong:.1e} at {at:.1e}, estimated {estimated:.1e} ({:.2} ×), counts differ at {different} of {}",
                family.shifts().len(),
                family.dimension(),
                estimated / wrong,
                list.len(),
            ));
            if wrong.is_nan() || wrong > 1e-6 {
                failures.push(format!("{context}: {wrong:e} at ε = {at:e}"));
            }
            if family.shifts().len() > MOST {
                failures.push(format!("{context}: {} factorisations", family.shifts().len()));
            }
            if !(wrong / 3.0..=10.0 * wrong).contains(&estimated) {
                failures.push(format!("{context}: {estimated:e} estimated where it is {wrong:e}"));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn with(metric: Metric) -> TikhonovOptions {
    TikhonovOptions { metric, ..TikhonovOptions::default() }
}

#[test]
fn small_files_agree_with_exact_solutions() {
    check(&SMALL, 11);
}

#[test]
fn files_of_ten_thousand_vertices_agree_with_exact_solutions() {
    check(&MEDIUM, 5);
}

#[test]
fn large_files_agree_with_exact_solutions() {
    check(&LARGE, 3);
}
