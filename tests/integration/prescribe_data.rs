//! Prescribed extrema on the fields of the data folder. Without the folder nothing is checked, and the tests say so.

use morse_smooth::field::Threshold;
use morse_smooth::smooth::{
    Extrema, Functional, PersistenceOf, PrescribeOptions, Smoother, SmootherOptions, TikhonovOptions,
};

use crate::data::{folder, read, say, values};
use crate::prescribe::{check, told};

/// Fields, with how many of the thresholds and ε below are tried: large meshes take seconds each.
const FIELDS: [(&str, &str, usize); 11] = [
    ("disk_flow_surface.vtk", "Temp", 4),
    ("spot.obj", "eig20", 4),
    ("spot.obj", "eig20_noisy", 4),
    ("torus_irregular.ply", "noisy", 4),
    ("fsaverage5_lh_white.ply", "sulc", 2),
    ("fsaverage5_lh_white.ply", "curv", 2),
    ("genus22.ply", "clean", 2),
    ("genus22.ply", "noisy", 2),
    ("lysozyme_potential.ply", "potential", 1),
    ("jacksboro_dem.ply", "elevation", 1),
    ("egm96_geoid_1deg.ply", "geoid_m", 1),
];
const THRESHOLDS: [f64; 4] = [0.1, 0.05, 0.2, 0.02];
const EPSILONS: [f64; 3] = [0.05, 1.0, 1e-3];

#[test]
fn extrema_are_the_chosen_ones_on_all_data() {
    let Some(folder) = folder() else { return say("prescribed extrema: no data folder, nothing checked") };
    for (file, field, most) in FIELDS {
        let loaded = read(&folder, file);
        let (mesh, f) = (&loaded.mesh, values(&folder, file, &loaded, field));
        let mut smoother = Smoother::new(mesh, SmootherOptions::default()).expect("a smoother");
        for &threshold in &THRESHOLDS[..most] {
            for &epsilon in &EPSILONS[..most.min(3)] {
                for of in [PersistenceOf::Smoothed, PersistenceOf::Input] {
                    let functional = Functional::Tikhonov(TikhonovOptions { epsilon, ..TikhonovOptions::default() });
                    let extrema = Extrema::Above { threshold: Threshold::Relative(threshold), of };
                    let options = PrescribeOptions { functional, extrema, ..PrescribeOptions::default() };
                    let smoothed = smoother.prescribe(&f, &options);
                    let smoothed =
                        smoothed.unwrap_or_else(|e| panic!("{file} {field} {threshold} {epsilon} {of:?}: {e}"));
                    check(mesh, &smoothed);
                }
            }
        }
    }
}

/// How much more energy than the smoothed field has the one with so many of the input's most persistent extrema, and with those of the
/// smoothed field, at ε = 0.05: no more than this share, found with another implementation.
#[test]
fn hardly_any_smoothness_is_lost() {
    let Some(folder) = folder() else { return say("energies of prescribed extrema: no data folder, nothing checked") };
    for (file, field, minima, maxima, most) in [
        ("genus22.ply", "noisy", 3, 3, 0.015),
        ("fsaverage5_lh_white.ply", "curv", 28, 35, 0.020),
        ("lysozyme_potential.ply", "potential", 46, 17, 0.022),
        ("jacksboro_dem.ply", "elevation", 11, 50, 0.018),
    ] {
        let loaded = read(&folder, file);
        let (mesh, f) = (&loaded.mesh, values(&folder, file, &loaded, field));
        let mut smoother = Smoother::new(mesh, SmootherOptions::default()).expect("a smoother");
        for (of, most) in [(PersistenceOf::Input, most), (PersistenceOf::Smoothed, 0.01)] {
            let extrema = Extrema::Most { minima, maxima, of };
            let smoothed = smoother.prescribe(&f, &PrescribeOptions { extrema, ..PrescribeOptions::default() });
            let smoothed = smoothed.unwrap_or_else(|error| panic!("{file} {field} {of:?}: {error}"));
            check(mesh, &smoothed);
            let report = told(&smoothed);
            assert_eq!((report.minima.len(), report.maxima.len()), (minima, maxima));
            let more = report.energy / report.unconstrained_energy - 1.0;
            assert!(more <= most, "{file} {field} {of:?}: {more}");
        }
    }
}
