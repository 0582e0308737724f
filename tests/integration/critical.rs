//! Critical points against a second classifier that walks links in order, and the invariants of every complex.

use std::collections::BTreeMap;

use morse_smooth::field::{CriticalKind, CriticalPoints, DeltaOptions, DeltaScale, ExtremumRule, LinkReading};
use morse_smooth::mesh::{TriMesh, shapes};
use proptest::prelude::*;

use crate::analyses::critical_points;
use crate::support::{
    Link, edge_map, every_kind, link_components, links, mesh, noise, random_complex, random_surface, tied, walk_link,
};

type Found = BTreeMap<u32, (CriticalKind, u32)>;

fn found(points: &CriticalPoints) -> Found {
    points.points.iter().map(|p| (p.vertex, (p.kind, p.multiplicity))).collect()
}

/// The kind of one vertex by the words of the notes: signs are −1, 0, 1 for link vertices below, within δ, above.
fn classify(
    link: &Link,
    sign: impl Fn(u32) -> i32,
    exact: bool,
    reading: LinkReading,
    rule: ExtremumRule,
) -> Option<(CriticalKind, u32)> {
    if link.is_empty() {
        return None;
    }
    let signs: Vec<i32> = link.keys().map(|&v| sign(v)).collect();
    let (below, above) = (signs.contains(&-1), signs.contains(&1));
    let neutral = signs.contains(&0);
    match rule {
        ExtremumRule::Strict if !neutral && !below => return Some((CriticalKind::Minimum, 1)),
        ExtremumRule::Strict if !neutral && !above => return Some((CriticalKind::Maximum, 1)),
        ExtremumRule::Literal if !below => return Some((CriticalKind::Minimum, 1)),
        ExtremumRule::Literal if !above => return Some((CriticalKind::Maximum, 1)),
        _ => {}
    }
    let multiplicity = match walk_link(link) {
        Some((cycle, true)) => {
            let around: Vec<i32> = match reading {
                LinkReading::Consecutive => cycle.iter().map(|&v| sign(v)).collect(),
                LinkReading::Skip => cycle.iter().map(|&v| sign(v)).filter(|&s| s != 0).collect(),
            };
            let changes = (0..around.len()).filter(|&i| around[i] * around[(i + 1) % around.len()] < 0).count();
            if changes >= 4 { changes / 2 - 1 } else { 0 }
        }
        Some((path, false)) => {
            let mut along: Vec<i32> = path.iter().map(|&v| sign(v)).filter(|&s| s != 0).collect();
            along.dedup();
            let runs = |side| along.iter().filter(|&&s| s == side).count();
            runs(-1).max(runs(1)).saturating_sub(1)
        }
        None => {
            // Components of what is not on the other side; one with nothing beyond δ does not count.
            let runs = |side: i32| {
                let parts = link_components(link, |v| sign(v) != -side);
                parts.iter().filter(|part| part.iter().any(|&v| sign(v) == side)).count()
            };
            runs(-1).max(runs(1)).saturating_sub(1)
        }
    };
    assert!(!exact || !neutral);
    (below && above && multiplicity > 0).then_some((CriticalKind::Saddle, multiplicity as u32))
}

fn largest_difference(mesh: &TriMesh, f: &[f64]) -> f64 {
    let edges = edge_map(mesh.connectivity().triangles());
    edges.keys().map(|&[a, b]| (f[a as usize] - f[b as usize]).abs()).fold(0.0, f64::max)
}

fn reference(mesh: &TriMesh, f: &[f64], options: &DeltaOptions) -> Found {
    let exact = options.delta == 0.0;
    let delta = match options.scale {
        DeltaScale::Relative => options.delta * largest_difference(mesh, f),
        DeltaScale::Absolute => options.delta,
    };
    let links = links(mesh.vertex_count(), mesh.connectivity().triangles());
    let side = |i: usize, j: u32| -> i32 {
        let (x, y) = (f[i], f[j as usize]);
        if exact {
            let below = y < x || (y == x && (j as usize) < i);
            if below { -1 } else { 1 }
        } else if y > x + delta && y - x > delta {
            1
        } else if y - x < -delta {
            -1
        } else {
            0
        }
    };
    links
        .iter()
        .enumerate()
        .filter_map(|(i, link)| {
            classify(link, |j| side(i, j), exact, options.link, options.rule).map(|kind| (i as u32, kind))
        })
        .collect()
}

fn check(mesh: &TriMesh, f: &[f64], options: &DeltaOptions) -> Result<(), TestCaseError> {
    let got = critical_points(mesh, f, options).unwrap();
    let expected = reference(mesh, f, options);
    prop_assert_eq!(found(&got), expected.clone(), "{:?}", options);
    prop_assert!(got.points.windows(2).all(|pair| pair[0].vertex < pair[1].vertex));
    let total = |kind| expected.values().filter(|k| k.0 == kind).map(|k| k.1).sum::<u32>();
    prop_assert_eq!(got.counts.minima, total(CriticalKind::Minimum));
    prop_assert_eq!(got.counts.maxima, total(CriticalKind::Maximum));
    prop_assert_eq!(got.counts.saddles, total(CriticalKind::Saddle));
    let edges = edge_map(mesh.connectivity().triangles());
    for point in &got.points {
        let on_boundary = edges.iter().any(|(edge, at)| at.len() == 1 && edge.contains(&point.vertex));
        prop_assert_eq!(point.on_boundary, on_boundary, "boundary flag of {}", point.vertex);
    }
    if options.delta == 0.0 {
        let chi = mesh.vertex_count() as i64 - edges.len() as i64 + mesh.triangle_count() as i64;
        prop_assert_eq!(got.counts.index_sum, Some(chi));
    } else {
        prop_assert_eq!(got.counts.index_sum, None);
    }
    Ok(())
}

fn check_all_readings(mesh: &TriMesh, f: &[f64], deltas: &[f64]) -> Result<(), TestCaseError> {
    for &delta in deltas {
        for scale in [DeltaScale::Relative, DeltaScale::Absolute] {
            for link in [LinkReading::Consecutive, LinkReading::Skip] {
                for rule in [ExtremumRule::Strict, ExtremumRule::Literal] {
                    check(mesh, f, &DeltaOptions { delta, scale, link, rule })?;
                }
            }
        }
    }
    Ok(())
}

/// C_δ for growing δ: every vertex keeps its kind until it drops out, and its multiplicity does not grow.
fn check_nested(mesh: &TriMesh, f: &[f64], link: LinkReading) -> Result<(), TestCaseError> {
    let mut previous: Option<Found> = None;
    for step in 0..=40 {
        let options = DeltaOptions { delta: f64::from(step) / 40.0, link, ..DeltaOptions::default() };
        let now = found(&critical_points(mesh, f, &options).unwrap());
        if let Some(previous) = previous {
            for (vertex, (kind, multiplicity)) in &now {
                let before = previous.get(vertex);
                prop_assert!(
                    before.is_some_and(|(k, m)| k == kind && m >= multiplicity),
                    "vertex {} at step {}: {:?} after {:?}",
                    vertex,
                    step,
                    (kind, multiplicity),
                    before
                );
            }
        }
        previous = Some(now);
    }
    Ok(())
}

#[test]
fn every_kind_of_mesh_agrees_with_the_reference() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        let height: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[0] + 0.3 * p[1]).collect();
        for f in [height, noise(n, 1), tied(n, 2, 2.0), tied(n, 3, 0.4), vec![1.5; n]] {
            check_all_readings(&mesh, &f, &[0.0, 0.1, 0.25, 0.5, 1.0]).unwrap_or_else(|e| panic!("{name}: {e}"));
            for link in [LinkReading::Consecutive, LinkReading::Skip] {
                check_nested(&mesh, &f, link).unwrap_or_else(|e| panic!("{name}: {e}"));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn random_complexes_agree_with_the_reference(
        seed: u64, n in 3_u32..10, m in 1_usize..40, steps in 0.5..4.0, delta in 0.0..0.6,
    ) {
        let mesh = random_complex(seed, n, m);
        for f in [noise(n as usize, seed ^ 1), tied(n as usize, seed ^ 2, steps)] {
            check_all_readings(&mesh, &f, &[0.0, delta])?;
            check_nested(&mesh, &f, LinkReading::Consecutive)?;
            check_nested(&mesh, &f, LinkReading::Skip)?;
        }
    }

    #[test]
    fn surfaces_with_holes_agree_with_the_reference(
        seed: u64, removed in 0.0..0.6, steps in 0.5..4.0, delta in 0.0..0.4,
    ) {
        for base in [shapes::torus(6, 5, 0.0).unwrap(), shapes::moebius(7, 4).unwrap(), shapes::klein_bottle(5, 4).unwrap()] {
            let mesh = random_surface(seed, &base, removed);
            let n = mesh.vertex_count();
            for f in [noise(n, seed ^ 1), tied(n, seed ^ 2, steps)] {
                check_all_readings(&mesh, &f, &[0.0, delta])?;
                check_nested(&mesh, &f, LinkReading::Consecutive)?;
                check_nested(&mesh, &f, LinkReading::Skip)?;
            }
        }
    }

    #[test]
    fn the_euler_formula_and_the_mirror(seed: u64, torus: bool) {
        let (mesh, chi) = if torus {
            (shapes::torus(12, 9, 0.2).unwrap(), 0)
        } else {
            (shapes::sphere(2).unwrap(), 2)
        };
        let f = noise(mesh.vertex_count(), seed);
        let options = DeltaOptions::default();
        let counts = critical_points(&mesh, &f, &options).unwrap().counts;
        prop_assert_eq!(i64::from(counts.minima) - i64::from(counts.saddles) + i64::from(counts.maxima), chi);
        let up_side_down: Vec<f64> = f.iter().map(|x| -x).collect();
        let mirrored = found(&critical_points(&mesh, &up_side_down, &options).unwrap());
        let expected: Found = found(&critical_points(&mesh, &f, &options).unwrap())
            .into_iter()
            .map(|(v, (kind, multiplicity))| {
                let kind = match kind {
                    CriticalKind::Minimum => CriticalKind::Maximum,
                    CriticalKind::Saddle => CriticalKind::Saddle,
                    CriticalKind::Maximum => CriticalKind::Minimum,
                };
                (v, (kind, multiplicity))
            })
            .collect();
        prop_assert_eq!(mirrored, expected);
    }
}

fn counts(mesh: &TriMesh, f: impl Fn([f64; 3]) -> f64) -> (u32, u32, u32) {
    let values: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| f([p[0], p[1], p[2]])).collect();
    let counts = critical_points(mesh, &values, &DeltaOptions::default()).unwrap().counts;
    (counts.minima, counts.maxima, counts.saddles)
}

#[test]
fn smooth_functions_with_known_critical_points() {
    let sphere = shapes::sphere(5).unwrap();
    let height = |p: [f64; 3]| p[0] + 0.21 * p[1] + 0.13 * p[2];
    assert_eq!(counts(&sphere, height), (1, 1, 0));
    // A quadratic form with three different eigenvalues: a pair of each at the ends of its axes.
    let turned = |p: [f64; 3]| {
        let (x, y, z) = (p[0] + 0.3 * p[1], p[1] - 0.3 * p[0], p[2]);
        x * x + 2.0 * y * y + 3.3 * z * z
    };
    assert_eq!(counts(&sphere, turned), (2, 2, 2));
    // The cubic harmonic xyz in a turned frame: an extremum in each octant, a saddle at each end of the three axes.
    let frame = |p: [f64; 3]| {
        let (x, y, z) =
            (0.36 * p[0] + 0.48 * p[1] - 0.8 * p[2], -0.8 * p[0] + 0.6 * p[1], 0.48 * p[0] + 0.64 * p[1] + 0.6 * p[2]);
        x * y * z
    };
    assert_eq!(counts(&sphere, frame), (4, 4, 6));
    let torus = shapes::torus(48, 24, 0.0).unwrap();
    assert_eq!(counts(&torus, height), (1, 1, 2));
    // k waves around the tube's large circle: k minima, k maxima and 2k saddles.
    let waves = |p: [f64; 3]| {
        let (r, i) = (p[0].hypot(p[1]), (p[0] / p[0].hypot(p[1]), p[1] / p[0].hypot(p[1])));
        (i.0 * i.0 * i.0 - 3.0 * i.0 * i.1 * i.1) + 0.05 * r + 0.01 * p[2]
    };
    assert_eq!(counts(&torus, waves), (3, 3, 6));
}

/// A fan around vertex 0; closed all around, or a half turn with vertex 0 on the boundary.
fn fan(ring: usize, closed: bool) -> TriMesh {
    let mut positions = vec![[0.0; 3]];
    positions.extend((0..ring).map(|k| {
        let turn =
            if closed { core::f64::consts::TAU / ring as f64 } else { core::f64::consts::PI / (ring - 1) as f64 };
        [(turn * k as f64).cos(), (turn * k as f64).sin(), 0.0]
    }));
    let last = if closed { ring } else { ring - 1 };
    let triangles: Vec<[u32; 3]> = (0..last).map(|k| [0, 1 + k as u32, 1 + ((k + 1) % ring) as u32]).collect();
    mesh(&positions, &triangles)
}

fn at_centre(mesh: &TriMesh, values: &[f64], options: &DeltaOptions) -> Option<(CriticalKind, u32, bool)> {
    let points = critical_points(mesh, values, options).unwrap().points;
    points.iter().find(|p| p.vertex == 0).map(|p| (p.kind, p.multiplicity, p.on_boundary))
}

#[test]
fn saddles_by_hand() {
    use CriticalKind::{Maximum, Minimum, Saddle};
    let exact = DeltaOptions::default();
    let monkey = fan(6, true);
    assert_eq!(at_centre(&monkey, &[0., 1., -1., 1., -1., 1., -1.], &exact), Some((Saddle, 2, false)));
    assert_eq!(at_centre(&monkey, &[0., 1., 1., -1., -1., 1., -1.], &exact), Some((Saddle, 1, false)));
    assert_eq!(at_centre(&monkey, &[0., 1., 1., -1., -1., -1., 1.], &exact), None);
    // Equal values: the vertex with the smaller id is the lower one.
    assert_eq!(at_centre(&monkey, &[0.; 7], &exact), Some((Minimum, 1, false)));
    let edge = fan(3, false);
    assert_eq!(at_centre(&edge, &[0., -1., 1., -1.], &exact), Some((Saddle, 1, true)));
    assert_eq!(at_centre(&edge, &[0., 1., -1., 1.], &exact), Some((Saddle, 1, true)));
    assert_eq!(at_centre(&edge, &[0., -1., -1., 1.], &exact), None);
    assert_eq!(at_centre(&edge, &[0., -1., -1., -1.], &exact), Some((Maximum, 1, true)));

    // The two readings differ where a vertex within δ stands between opposite ones: + 0 − + − and + 0 − 0 + −.
    let absolute = |delta, link, rule| DeltaOptions { delta, scale: DeltaScale::Absolute, link, rule };
    let (five, six) = (fan(5, true), fan(6, true));
    let (printed, skip) = (LinkReading::Consecutive, LinkReading::Skip);
    let strict = ExtremumRule::Strict;
    let values = [0., 9., 0., -9., 9., -9.];
    assert_eq!(at_centre(&five, &values, &absolute(1.0, printed, strict)), None);
    assert_eq!(at_centre(&five, &values, &absolute(1.0, skip, strict)), Some((Saddle, 1, false)));
    let values = [0., 9., 0., -9., 0., 9., -9.];
    assert_eq!(at_centre(&six, &values, &absolute(1.0, printed, strict)), None);
    assert_eq!(at_centre(&six, &values, &absolute(1.0, skip, strict)), Some((Saddle, 1, false)));
    // Five changes, possible with one vertex within δ: ⌊5/2⌋ − 1.
    let values = [0., 9., 0., -9., 9., -9., 9., -9.];
    assert_eq!(at_centre(&fan(7, true), &values, &absolute(1.0, printed, strict)), Some((Saddle, 1, false)));
    assert_eq!(at_centre(&fan(7, true), &values, &absolute(1.0, skip, strict)), Some((Saddle, 2, false)));
    // Two sheets that meet in a vertex above both: once a neighbour is within δ it is no maximum, and no saddle either.
    let sheets = crate::support::bow_tie();
    let values = [0., -9., -0.5, -9., -9.];
    assert_eq!(at_centre(&sheets, &values, &exact), Some((Maximum, 1, true)));
    assert_eq!(at_centre(&sheets, &values, &absolute(1.0, printed, strict)), None);
    assert_eq!(at_centre(&sheets, &[0., -9., -9., 9., 9.], &absolute(1.0, printed, strict)), None);
    assert_eq!(at_centre(&sheets, &[0., -9., 9., 9., -9.], &absolute(1.0, skip, strict)), Some((Saddle, 1, true)));
    // A flat neighbour forbids a strict extremum, not a literal one; a difference of exactly δ is within δ.
    let values = [0., 9., 9., 9., 9., 9., 1.0];
    assert_eq!(at_centre(&six, &values, &absolute(1.0, printed, strict)), None);
    assert_eq!(at_centre(&six, &values, &absolute(0.999, printed, strict)), Some((Minimum, 1, false)));
    assert_eq!(at_centre(&six, &values, &absolute(1.0, printed, ExtremumRule::Literal)), Some((Minimum, 1, false)));
}

#[test]
fn constants_and_refusals() {
    let torus = shapes::torus(9, 7, 0.0).unwrap();
    let n = torus.vertex_count();
    for delta in [1e-300, 0.02, 1.0, 1e300] {
        for link in [LinkReading::Consecutive, LinkReading::Skip] {
            let options = DeltaOptions { delta, link, ..DeltaOptions::default() };
            assert!(critical_points(&torus, &vec![4.25; n], &options).unwrap().points.is_empty());
        }
    }
    let with = |delta| DeltaOptions { delta, ..DeltaOptions::default() };
    for delta in [-1e-9, f64::NAN, f64::INFINITY] {
        let error = critical_points(&torus, &vec![0.0; n], &with(delta)).expect_err("no tolerance");
        assert_eq!(error.code(), "InvalidOption");
        assert!(error.to_string().contains("delta"), "{error}");
    }
    let mut bad = vec![0.0; n];
    assert_eq!(critical_points(&torus, &bad[1..], &with(0.0)).expect_err("short").code(), "LengthMismatch");
    bad[17] = f64::NAN;
    let error = critical_points(&torus, &bad, &with(0.0)).expect_err("NaN");
    assert_eq!((error.code(), error.to_string().contains("17")), ("NonFiniteValue", true));
    bad[17] = f64::MAX;
    bad[3] = -f64::MAX;
    assert_eq!(critical_points(&torus, &bad, &with(0.0)).expect_err("overflow").code(), "RangeOverflow");
}
