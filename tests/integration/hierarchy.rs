//! The hierarchy over δ against `critical_points` at every δ where anything changes, just below it, and in between.

use morse_smooth::field::{CriticalKind, DeltaHierarchy, DeltaOptions, DeltaScale, LinkReading};
use morse_smooth::mesh::{TriMesh, shapes};
use proptest::prelude::*;

use crate::analyses::{critical_points, delta_hierarchy, largest_edge_difference};
use crate::support::{every_kind, mesh, noise, random_complex, random_surface, tied};

const READINGS: [LinkReading; 2] = [LinkReading::Consecutive, LinkReading::Skip];

/// What both sides have at one δ must be the same.
fn agree_at(
    mesh: &TriMesh,
    f: &[f64],
    link: LinkReading,
    hierarchy: &DeltaHierarchy,
    delta: f64,
) -> Result<(), TestCaseError> {
    let relative = critical_points(mesh, f, &DeltaOptions { delta, link, ..DeltaOptions::default() }).unwrap();
    prop_assert_eq!(hierarchy.counts_at(delta), relative.counts, "{:?}, relative δ = {:e}", link, delta);
    let expected: Vec<(u32, CriticalKind)> = relative.points.iter().map(|p| (p.vertex, p.kind)).collect();
    let found: Vec<(u32, CriticalKind)> = hierarchy.points_at(delta).map(|p| (p.vertex, p.kind)).collect();
    prop_assert_eq!(found, expected, "{:?}, relative δ = {:e}", link, delta);
    Ok(())
}

fn agree_at_absolute(
    mesh: &TriMesh,
    f: &[f64],
    link: LinkReading,
    hierarchy: &DeltaHierarchy,
    delta: f64,
) -> Result<(), TestCaseError> {
    let options = DeltaOptions { delta, link, scale: DeltaScale::Absolute, ..DeltaOptions::default() };
    let expected: Vec<u32> = critical_points(mesh, f, &options).unwrap().points.iter().map(|p| p.vertex).collect();
    let there = hierarchy.points.iter().filter(|p| delta == 0.0 || p.vanishes_at_absolute > delta);
    prop_assert_eq!(there.map(|p| p.vertex).collect::<Vec<_>>(), expected, "{:?}, δ = {:e}", link, delta);
    Ok(())
}

/// At most so many of the items, spread over all.
fn some<T: Copy>(items: &[T], most: usize) -> Vec<T> {
    items.iter().copied().step_by(items.len().div_ceil(most).max(1)).collect()
}

/// Checks a field for both readings, at no more than `most` places of the curve.
pub(crate) fn check(mesh: &TriMesh, f: &[f64], most: usize) -> Result<(), TestCaseError> {
    for link in READINGS {
        let hierarchy = delta_hierarchy(mesh, f, link).unwrap();
        let curve = &hierarchy.curve;
        let rows = curve.delta.len();
        prop_assert_eq!(curve.delta[0], 0.0);
        prop_assert!(curve.delta.windows(2).all(|pair| pair[0] < pair[1]));
        prop_assert!([&curve.minima, &curve.maxima, &curve.saddles].iter().all(|counts| counts.len() == rows));
        for counts in [&curve.minima, &curve.maxima, &curve.saddles] {
            prop_assert!(counts.windows(2).all(|pair| pair[0] >= pair[1]), "nested");
            prop_assert_eq!(counts[rows - 1], 0);
        }
        for point in &hierarchy.points {
            prop_assert!((0.0..=1.0).contains(&point.vanishes_at));
            prop_assert_eq!(point.vanishes_at == 0.0, point.vanishes_at_absolute == 0.0);
        }
        for place in some(&(0..rows).collect::<Vec<_>>(), most) {
            let delta = curve.delta[place];
            agree_at(mesh, f, link, &hierarchy, delta)?;
            if place > 0 {
                agree_at(mesh, f, link, &hierarchy, delta.next_down())?;
                agree_at(mesh, f, link, &hierarchy, curve.delta[place - 1].midpoint(delta))?;
            }
        }
        for delta in [f64::from_bits(1), 1e-300, 0.02, 0.1, 0.5, 1.0, 2.0] {
            agree_at(mesh, f, link, &hierarchy, delta)?;
        }
        for point in some(&hierarchy.points, most) {
            let delta = point.vanishes_at_absolute;
            for delta in [delta, delta.next_down().max(0.0), delta / 2.0, delta.next_up()] {
                agree_at_absolute(mesh, f, link, &hierarchy, delta)?;
            }
        }
        agree_at_absolute(mesh, f, link, &hierarchy, 0.0)?;
    }
    Ok(())
}

fn fields(n: usize, seed: u64, steps: f64) -> [Vec<f64>; 3] {
    [noise(n, seed), tied(n, seed ^ 1, steps), tied(n, seed ^ 2, 0.5)]
}

#[test]
fn every_kind_of_mesh() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        let height: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[0] + 0.3 * p[1]).collect();
        let two: Vec<f64> = noise(n, 3).iter().map(|&x| f64::from(u8::from(x > 0.0))).collect();
        for f in fields(n, 7, 2.0).into_iter().chain([height, two, vec![1.5; n]]) {
            check(&mesh, &f, usize::MAX).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}

/// A vertex in the middle of a ring, with more changes of sign around it the more vertices the ring has, and the same on half a ring.
#[test]
fn saddles_of_high_multiplicity() {
    for ring in [6_u32, 7, 12, 33, 40, 81] {
        for closed in [true, false] {
            let positions: Vec<[f64; 3]> = (0..=ring)
                .map(|k| {
                    let angle = 6.0 * f64::from(k) / f64::from(ring);
                    if k == 0 { [0.0; 3] } else { [angle.cos(), angle.sin(), 0.0] }
                })
                .collect();
            let last = if closed { ring } else { ring - 1 };
            let triangles: Vec<[u32; 3]> = (0..last).map(|k| [0, 1 + k, 1 + (k + 1) % ring]).collect();
            let mesh = mesh(&positions, &triangles);
            for seed in 0..20 {
                for mut f in fields(ring as usize + 1, seed, 3.0) {
                    for (k, value) in f.iter_mut().enumerate() {
                        // Alternating, but for a few.
                        *value = if k == 0 { 0.0 } else { value.abs() * if k % 2 == 0 { 1.0 } else { -1.0 } };
                    }
                    f[1 + seed as usize % ring as usize] *= -1.0;
                    check(&mesh, &f, usize::MAX).unwrap_or_else(|e| panic!("ring of {ring}, closed: {closed}: {e}"));
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn random_complexes(seed: u64, n in 3_u32..10, m in 1_usize..40, steps in 0.5..6.0) {
        let mesh = random_complex(seed, n, m);
        for f in fields(n as usize, seed, steps) {
            check(&mesh, &f, usize::MAX)?;
        }
    }

    /// The absolute and the relative δ where neither has the usual digits.
    #[test]
    fn the_ends_of_double_precision(seed: u64, n in 3_u32..8, exponent in -1074_i32..1024, outlier in -1074_i32..1024) {
        let mesh = random_complex(seed, n, 20);
        let scale = |exponent: i32| 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2);
        let mut f: Vec<f64> = noise(n as usize, seed).iter().map(|x| x / 4.0 * scale(exponent)).collect();
        check(&mesh, &f, usize::MAX)?;
        f[0] = scale(outlier) / 4.0;
        check(&mesh, &f, usize::MAX)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn surfaces_with_holes(seed: u64, removed in 0.0..0.6, steps in 0.5..6.0) {
        for base in [shapes::torus(6, 5, 0.0).unwrap(), shapes::moebius(7, 4).unwrap(), shapes::klein_bottle(5, 4).unwrap()] {
            let mesh = random_surface(seed, &base, removed);
            for f in fields(mesh.vertex_count(), seed, steps) {
                check(&mesh, &f, 40)?;
            }
        }
    }
}

#[test]
fn by_hand() {
    // Four vertices that all see each other: the lowest vanishes at 1, the highest at 8.
    let tetrahedron = shapes::tetrahedron().unwrap();
    let hierarchy = delta_hierarchy(&tetrahedron, &[0.0, 1.0, 2.0, 10.0], LinkReading::Consecutive).unwrap();
    let points: Vec<_> =
        hierarchy.points.iter().map(|p| (p.vertex, p.kind, p.vanishes_at, p.vanishes_at_absolute)).collect();
    assert_eq!(points, [(0, CriticalKind::Minimum, 0.1, 1.0), (3, CriticalKind::Maximum, 0.8, 8.0)]);
    assert_eq!(hierarchy.curve.delta, [0.0, 0.1, 0.8]);
    assert_eq!((hierarchy.curve.minima, hierarchy.curve.maxima), (vec![1, 0, 0], vec![1, 1, 0]));
    assert_eq!(hierarchy.index_sum, 2);
    // Ties: all that is critical by ids alone is gone at the least positive number.
    let constant = delta_hierarchy(&tetrahedron, &[7.0; 4], LinkReading::Skip).unwrap();
    assert_eq!(constant.curve.delta, [0.0, f64::from_bits(1)]);
    assert!(constant.points.iter().all(|p| p.vanishes_at == 0.0) && constant.points.len() == 2);
    // A monkey saddle loses one part at 2 and the other at 3, as the third and the fourth change go; the outer ones stay to 4.
    let ring: Vec<[f64; 3]> = (0..7).map(|k| [f64::from(k % 3), f64::from(k * k % 7), f64::from(k % 2)]).collect();
    let monkey = mesh(&ring, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 6], [0, 6, 1]]);
    let f = [0.0, 4.0, -3.0, 9.0, -9.0, 9.0, -2.0];
    let hierarchy = delta_hierarchy(&monkey, &f, LinkReading::Consecutive).unwrap();
    let saddle = hierarchy.points.iter().find(|p| p.vertex == 0).unwrap();
    assert_eq!((saddle.kind, saddle.vanishes_at_absolute), (CriticalKind::Saddle, 3.0));
    assert_eq!(hierarchy.counts_at(1.9 / 18.0).saddles - hierarchy.counts_at(2.0 / 18.0).saddles, 1);
}

#[test]
fn a_hub_of_twenty_thousand() {
    let ring = 20_000_u32;
    let wave = |k: u32| (f64::from(k) / f64::from(ring) * core::f64::consts::TAU).sin_cos();
    let positions: Vec<[f64; 3]> = (0..=ring)
        .map(|k| {
            let (y, x) = wave(k);
            if k == 0 { [0.0; 3] } else { [x, y, 0.0] }
        })
        .collect();
    let cycle: Vec<[u32; 3]> = (0..ring).map(|k| [0, 1 + k, 1 + (k + 1) % ring]).collect();
    let f = noise(ring as usize + 1, 5);
    for triangles in [&cycle[..], &cycle[1..]] {
        let mesh = mesh(&positions, triangles);
        check(&mesh, &f, 6).unwrap();
    }
}

#[test]
fn refusals() {
    let grid = shapes::grid(4, 4).unwrap();
    let code = |f: &[f64]| delta_hierarchy(&grid, f, LinkReading::Skip).expect_err("refused").code();
    assert_eq!(code(&[1.0; 15]), "LengthMismatch");
    let mut f = vec![1.0; 16];
    f[3] = f64::NAN;
    assert_eq!(code(&f), "NonFiniteValue");
    (f[3], f[4]) = (1e308, -1e308);
    assert_eq!(code(&f), "RangeOverflow");
    assert!(largest_edge_difference(&grid, &[0.0; 16]) == 0.0);
}
