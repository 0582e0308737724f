//! Stopping the analyses of a field: at whatever question, with the error `Cancelled`, and without a trace.

use core::cell::Cell;
use core::ops::ControlFlow;

use morse_smooth::field::{
    self, DeltaOptions, Features, Keep, LinkReading, Missing, PathStyle, ScalarField, Threshold,
};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::{Phase, Progress, Result, Watch};

use crate::support::noise;

type Call<'a> = (&'static str, Box<dyn Fn(&Watch<'_>) -> Result<String> + 'a>);

fn told<T: core::fmt::Debug>(result: Result<T>) -> Result<String> {
    result.map(|result| format!("{result:?}"))
}

fn calls<'a>(field: &'a ScalarField<'a>) -> Vec<Call<'a>> {
    let whole = DeltaOptions { delta: 0.05, link: LinkReading::Skip, ..DeltaOptions::default() };
    let levels: Vec<f64> = field::evenly_spaced_levels(field, 9).unwrap();
    let (more, some) = (levels.clone(), Threshold::Relative(0.1));
    vec![
        ("criticalPoints", Box::new(move |w| told(field::critical_points(field, &DeltaOptions::default(), w)))),
        ("criticalPoints, delta", Box::new(move |w| told(field::critical_points(field, &whole, w)))),
        ("deltaHierarchy", Box::new(move |w| told(field::delta_hierarchy(field, LinkReading::Consecutive, w)))),
        ("persistence", Box::new(move |w| told(field::persistence(field, w)))),
        ("simplify", Box::new(move |w| told(field::simplify(field, Keep::Above(some), w)))),
        ("morseComplex", Box::new(move |w| told(field::morse_complex(field, some, PathStyle::Merged, w)))),
        ("morseComplex, whole", Box::new(move |w| told(field::morse_complex(field, some, PathStyle::Whole, w)))),
        ("morseHierarchy", Box::new(move |w| told(field::morse_hierarchy(field, w)))),
        ("basins", Box::new(move |w| told(field::basins(field, some, w)))),
        ("basins, all", Box::new(move |w| told(field::basins(field, Threshold::default(), w)))),
        ("levelSets", Box::new(move |w| told(field::level_sets(field, &levels, w)))),
        ("bands", Box::new(move |w| told(field::bands(field, &more, w)))),
        ("saddleLevels", Box::new(move |w| told(field::saddle_levels(field, None, 0.0, w).map_err(as_refused)))),
        (
            "k-means",
            Box::new(move |w| {
                let clusters = Features::KMeans { clusters: 500, seed: 1 };
                told(field::feature_points(core::slice::from_ref(field), &clusters, w))
            }),
        ),
        (
            "featurePoints",
            Box::new(move |w| {
                told(field::feature_points(core::slice::from_ref(field), &Features::Persistence(some), w))
            }),
        ),
    ]
}

/// More saddles than levels are an error of their own, which comes at the end.
fn as_refused(error: morse_smooth::Error) -> morse_smooth::Error {
    assert!(["Cancelled", "InvalidOption"].contains(&error.code()), "{error}");
    error
}

/// What the watcher heard.
fn fractions(call: &Call<'_>) -> (Result<String>, Vec<f64>) {
    let mut heard = Vec::new();
    let mut listen = |Progress { phase, fraction }: Progress| {
        assert_eq!(phase, Phase::Field);
        heard.push(fraction);
        ControlFlow::Continue(())
    };
    let result = call.1(&Watch::new(&mut listen));
    (result, heard)
}

fn check(name: &str, mesh: &TriMesh, values: &[f64], every: usize) {
    let field = ScalarField::with_missing(mesh, values, Missing::Omit).unwrap();
    for call in calls(&field) {
        let name = format!("{} on {name}", call.0);
        let expected = call.1(&Watch::none());
        let (result, heard) = fractions(&call);
        assert_eq!(result, expected, "{name}");
        assert!(heard.len() > 1, "{name}");
        assert!(heard.is_sorted() && heard.iter().all(|x| (0.0..=1.0).contains(x)), "{name}: {heard:?}");
        if expected.is_ok() {
            assert_eq!(heard.last(), Some(&1.0), "{name}");
        }
        for stop in (0..heard.len()).step_by(every) {
            let asked = Cell::new(0);
            let mut listen = |_: Progress| {
                asked.set(asked.get() + 1);
                if asked.get() > stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            let error = call.1(&Watch::new(&mut listen)).unwrap_err();
            assert_eq!(error.code(), "Cancelled", "{name}, question {stop}");
            assert_eq!(asked.get(), stop + 1, "{name}: nothing is asked any more");
        }
        assert_eq!(call.1(&Watch::none()), expected, "{name}");
    }
}

#[test]
fn analyses_stop_at_every_question() {
    let torus = shapes::torus(120, 60, 0.2).unwrap();
    check("a torus", &torus, &noise(torus.vertex_count(), 1), 1);
    let grid = shapes::grid(60, 50).unwrap();
    let values: Vec<f64> =
        noise(grid.vertex_count(), 2).into_iter().map(|x| if x > 0.8 { f64::NAN } else { x }).collect();
    check("a grid with gaps", &grid, &values, 1);
    // Three sheets at an edge.
    let book = crate::support::random_complex(3, 60, 2_000);
    check("a soup", &book, &noise(60, 3), 3);
}

#[test]
fn large_meshes_are_asked_about_often() {
    let torus = shapes::torus(1_000, 200, 0.1).unwrap();
    let values = noise(torus.vertex_count(), 4);
    let field = ScalarField::new(&torus, &values).unwrap();
    for call in calls(&field) {
        let (_, heard) = fractions(&call);
        assert!(heard.len() >= 3, "{}: {} questions", call.0, heard.len());
        // The steps of a schedule are no larger than its largest share.
        let largest = heard.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        assert!(largest <= 0.7, "{}: {heard:?}", call.0);
    }
}
