//! Level sets against the edges and triangles that a level cuts, and against curves in closed form.

use std::collections::{BTreeMap, BTreeSet};

use core::f64::consts::PI;

use morse_smooth::field::LevelSets;
use morse_smooth::mesh::{TriMesh, shapes};
use proptest::prelude::*;

use crate::analyses::{evenly_spaced_levels, level_sets};
use crate::support::{
    book_of_three, edge_map, every_kind, jittered, mesh, noise, random_complex, random_surface, tied,
};

/// Checks everything that must hold for any field and any levels.
fn check(mesh: &TriMesh, f: &[f64], levels: &[f64]) -> Result<LevelSets, TestCaseError> {
    let sets = level_sets(mesh, f, levels).unwrap();
    let triangles = mesh.connectivity().triangles();
    let edges = edge_map(triangles);
    let count = sets.parameters.len();
    prop_assert_eq!(sets.points.len(), 3 * count);
    prop_assert_eq!(sets.edges.len(), count);
    prop_assert_eq!(sets.offsets.len(), sets.levels.len() + 1);
    prop_assert_eq!(sets.closed.len(), sets.levels.len());
    prop_assert_eq!((sets.offsets[0], sets.offsets[sets.levels.len()] as usize), (0, count));
    let range = f.iter().fold((f64::MAX, f64::MIN), |r, &x| (r.0.min(x), r.1.max(x)));
    let size = 1.0 + mesh.positions().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (place, &[a, b]) in sets.edges.iter().enumerate() {
        let (t, p, q) = (sets.parameters[place], mesh.position(a), mesh.position(b));
        prop_assert!(a < b && edges.contains_key(&[a, b]) && (0.0..=1.0).contains(&t));
        for i in 0..3 {
            let expected = (1.0 - t) * p[i] + t * q[i];
            prop_assert!((sets.points[3 * place + i] - expected).abs() <= 1e-14 * size);
        }
    }
    // The triangles that lines pass must be those that their level cuts, each exactly once.
    let mut passed: BTreeMap<u64, BTreeMap<u32, usize>> = BTreeMap::new();
    let mut line_levels = Vec::new();
    for k in 0..sets.levels.len() {
        let (start, end) = (sets.offsets[k] as usize, sets.offsets[k + 1] as usize);
        let level = sets.levels[k];
        line_levels.push((level, sets.closed[k]));
        prop_assert!(end - start >= if sets.closed[k] { 3 } else { 2 }, "line {} has {} points", k, end - start);
        for place in start..end {
            let [a, b] = sets.edges[place];
            let t = sets.parameters[place];
            let value = (1.0 - t) * f[a as usize] + t * f[b as usize];
            prop_assert!((value - level).abs() <= 1e-14 * (range.1 - range.0), "{} for {}", value, level);
            prop_assert!((f[a as usize] >= level) != (f[b as usize] >= level));
        }
        let steps = if sets.closed[k] { end - start } else { end - start - 1 };
        for step in 0..steps {
            let (p, q) = (sets.edges[start + step], sets.edges[start + (step + 1) % (end - start)]);
            prop_assert!(p != q);
            let corners: BTreeSet<u32> = p.into_iter().chain(q).collect();
            prop_assert_eq!(corners.len(), 3, "consecutive points lie on two sides of a triangle");
            let t = triangles.iter().position(|t| t.iter().all(|v| corners.contains(v)));
            prop_assert!(t.is_some(), "no triangle holds {:?} and {:?}", p, q);
            *passed.entry(level.to_bits()).or_default().entry(t.unwrap_or(0) as u32).or_default() += 1;
        }
        // Inner points of a line, and all of a closed one, lie on edges with two triangles; ends on others.
        for place in start..end {
            let sides = edges[&sets.edges[place]].len();
            let is_end = !sets.closed[k] && (place == start || place + 1 == end);
            prop_assert_eq!(sides == 2, !is_end, "line {} of {}", k, sets.levels.len());
        }
    }
    let mut asked: BTreeMap<u64, usize> = BTreeMap::new();
    for &level in levels {
        *asked.entry(level.to_bits()).or_default() += 1;
    }
    for (&bits, &times) in &asked {
        let level = f64::from_bits(bits);
        let expected: BTreeMap<u32, usize> = triangles
            .iter()
            .enumerate()
            .filter(|(_, t)| {
                let above = t.iter().filter(|&&v| f[v as usize] >= level).count();
                above == 1 || above == 2
            })
            .map(|(t, _)| (t as u32, times))
            .collect();
        prop_assert_eq!(passed.remove(&bits).unwrap_or_default(), expected, "triangles cut by {}", level);
    }
    prop_assert!(passed.is_empty(), "lines of levels nobody asked for");
    // Lines come in the order of the levels given, open ones first.
    let mut order = line_levels.into_iter().peekable();
    for &level in levels {
        let mut seen_closed = false;
        while let Some(&(at, closed)) = order.peek() {
            if at.to_bits() != level.to_bits() || (seen_closed && !closed) {
                break;
            }
            seen_closed = closed;
            order.next();
        }
    }
    prop_assert!(order.next().is_none(), "lines out of order");
    Ok(sets)
}

#[test]
fn every_kind_of_mesh_and_level() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        for f in [noise(n, 4), tied(n, 5, 2.0), mesh.positions().chunks_exact(3).map(|p| p[1]).collect(), vec![0.5; n]]
        {
            // Unsorted, repeated, at vertices, at both ends of the range and beyond them.
            let (low, high) = f.iter().fold((f64::MAX, f64::MIN), |r, &x| (r.0.min(x), r.1.max(x)));
            let levels = [0.5, -0.25, f[0], high, low, f[n / 2], 0.0, high + 1.0, low - 1.0, 0.1, 0.5, f[0], -1e300];
            check(&mesh, &f, &levels).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn random_complexes(seed: u64, n in 3_u32..10, m in 1_usize..40, steps in 0.5..4.0, level in -1.0..1.0) {
        let mesh = random_complex(seed, n, m);
        check(&mesh, &noise(n as usize, seed), &[level, 0.0])?;
        let f = tied(n as usize, seed, steps);
        check(&mesh, &f, &[level, f[0], f[1], f[0]])?;
    }

    #[test]
    fn surfaces_with_holes(seed: u64, removed in 0.0..0.5, steps in 0.5..4.0, level in -1.0..1.0) {
        for base in [shapes::torus(7, 5, 0.1).unwrap(), shapes::moebius(7, 4).unwrap()] {
            let mesh = random_surface(seed, &base, removed);
            let f = tied(mesh.vertex_count(), seed, steps);
            check(&mesh, &f, &[level, f[0], -level, f[1]])?;
        }
    }
}

/// Length of line `k`.
fn length(sets: &LevelSets, k: usize) -> f64 {
    let points: Vec<&[f64]> =
        sets.points[3 * sets.offsets[k] as usize..3 * sets.offsets[k + 1] as usize].chunks_exact(3).collect();
    let last = if sets.closed[k] { points.len() } else { points.len() - 1 };
    (0..last)
        .map(|i| {
            let (p, q) = (points[i], points[(i + 1) % points.len()]);
            (p[0] - q[0]).hypot(p[1] - q[1]).hypot(p[2] - q[2])
        })
        .sum()
}

fn coordinate(mesh: &TriMesh, axis: usize) -> Vec<f64> {
    mesh.positions().chunks_exact(3).map(|p| p[axis]).collect()
}

#[test]
fn circles_on_a_sphere_converge() {
    for level in [0.3_f64, -0.77] {
        let exact = 2.0 * PI * (1.0 - level * level).sqrt();
        let errors: Vec<f64> = (2..6)
            .map(|k| {
                let sphere = shapes::sphere(k).unwrap();
                let sets = check(&sphere, &coordinate(&sphere, 2), &[level]).unwrap();
                assert_eq!(sets.closed, [true]);
                (length(&sets, 0) - exact).abs() / exact
            })
            .collect();
        assert!(errors[3] < 2e-3 && errors[0] / errors[3] > 20.0, "{errors:?}");
    }
}

#[test]
fn plane_cuts_of_a_torus() {
    let torus = shapes::torus(192, 96, 0.0).unwrap();
    // Across the axis of revolution: two circles of radii 1 ± √(0.4² − z²).
    let z = 0.1_f64;
    let sets = check(&torus, &coordinate(&torus, 2), &[z]).unwrap();
    let mut lengths: Vec<f64> = (0..sets.levels.len()).map(|k| length(&sets, k) / (2.0 * PI)).collect();
    lengths.sort_by(f64::total_cmp);
    let r = (0.16 - z * z).sqrt();
    assert_eq!(sets.closed, [true, true]);
    assert!((lengths[0] - (1.0 - r)).abs() < 1e-3 && (lengths[1] - (1.0 + r)).abs() < 1e-3, "{lengths:?}");
    // Along it: two ovals where the plane meets the hole, one beyond; through the middle two circles of radius 0.4.
    let x = coordinate(&torus, 0);
    let loops = |level: f64| check(&torus, &x, &[level]).unwrap().levels.len();
    assert_eq!([-1.45, -1.3, -0.7, -0.5, 0.5, 0.7, 1.3, 1.45].map(loops), [0, 1, 1, 2, 2, 1, 1, 0]);
    let sets = check(&torus, &x, &[1e-9]).unwrap();
    for k in 0..2 {
        assert!((length(&sets, k) / (2.0 * PI * 0.4) - 1.0).abs() < 1e-3);
    }
}

#[test]
fn open_lines_on_a_square_and_on_a_strip() {
    let grid = shapes::grid(17, 9).unwrap();
    let sets = check(&grid, &coordinate(&grid, 0), &[0.33, 0.5]).unwrap();
    assert_eq!(sets.closed, [false, false]);
    assert!((length(&sets, 0) - 1.0).abs() < 1e-14);
    assert!((length(&sets, 1) - 1.0).abs() < 1e-14);
    for k in 0..2 {
        let ends = [sets.offsets[k] as usize, sets.offsets[k + 1] as usize - 1].map(|i| sets.points[3 * i + 1]);
        assert!(ends == [0.0, 1.0] || ends == [1.0, 0.0], "{ends:?}");
    }
    // A Möbius strip cut across: the two ends of one line on its single boundary.
    let strip = shapes::moebius(24, 5).unwrap();
    let sets = check(&strip, &coordinate(&strip, 1), &[0.01]).unwrap();
    assert_eq!(sets.closed, [false, false]);
}

#[test]
fn lines_end_where_three_sheets_meet() {
    let book = book_of_three();
    let sets = check(&book, &[0.0, 1.0, 1.0, 1.0, 1.0], &[0.5]).unwrap();
    assert_eq!(sets.closed, [false; 3]);
    assert!((0..3).all(|k| sets.offsets[k + 1] - sets.offsets[k] == 2));
}

#[test]
fn levels_through_vertices_and_plateaus() {
    // All of the octahedron's equator at the level: a vertex at the level counts as above, so the line is the one below.
    let octahedron = shapes::octahedron().unwrap();
    let z = coordinate(&octahedron, 2);
    let sets = check(&octahedron, &z, &[0.0]).unwrap();
    assert_eq!((sets.closed, sets.edges.len()), (vec![true], 4));
    assert!(sets.edges.iter().all(|e| e.contains(&5)));
    assert!(sets.points.chunks_exact(3).all(|p| p[2] == 0.0));
    // At the maximum the line shrinks to the vertex, at the minimum it is empty.
    let sets = check(&octahedron, &z, &[1.0]).unwrap();
    assert!(sets.closed == [true] && sets.points.chunks_exact(3).all(|p| p == [0.0, 0.0, 1.0]));
    assert!(check(&octahedron, &z, &[-1.0]).unwrap().levels.is_empty());
    // A plateau in the middle of a square: one closed line around it, at its rim.
    let grid = shapes::grid(7, 7).unwrap();
    let plateau: Vec<f64> = grid
        .positions()
        .chunks_exact(3)
        .map(|p| if (p[0] - 0.5).abs() < 0.2 && (p[1] - 0.5).abs() < 0.2 { 1.0 } else { 0.0 })
        .collect();
    assert_eq!(check(&grid, &plateau, &[1.0, 0.5]).unwrap().closed, [true, true]);
}

#[test]
fn levels_by_number_and_refusals() {
    let grid = shapes::grid(5, 5).unwrap();
    let f: Vec<f64> = coordinate(&grid, 0).iter().map(|x| 4.0 * x - 2.0).collect();
    assert_eq!(evenly_spaced_levels(&grid, &f, 3).unwrap(), [-1.0, 0.0, 1.0]);
    assert!(evenly_spaced_levels(&grid, &f, 0).unwrap().is_empty());
    assert!(evenly_spaced_levels(&grid, &[7.0; 25], 3).unwrap().is_empty());
    // Isolated vertices take no part in the range.
    let lonely = mesh(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [5., 5., 5.]], &[[0, 1, 2]]);
    assert_eq!(evenly_spaced_levels(&lonely, &[0., 1., 4., 100.], 1).unwrap(), [2.0]);
    let code = |levels: &[f64]| level_sets(&grid, &f, levels).expect_err("refused").code();
    assert_eq!(code(&[0.0, f64::NAN]), "NonFiniteLevel");
    assert_eq!(code(&[f64::INFINITY]), "NonFiniteLevel");
    assert_eq!(code(&vec![0.0; 10_001]), "InvalidOption");
    assert_eq!(evenly_spaced_levels(&grid, &f, 1_000_000).expect_err("too many").code(), "InvalidOption");
    assert_eq!(level_sets(&grid, &f[1..], &[0.0]).expect_err("short").code(), "LengthMismatch");
    // Values near the ends of double precision interpolate without overflow.
    let huge: Vec<f64> = f.iter().map(|x| x * 4e307).collect();
    check(&grid, &huge, &[1e307, -7e307]).unwrap();
    let tiny: Vec<f64> = f.iter().map(|x| x * 1e-308).collect();
    let sets = level_sets(&grid, &tiny, &[1e-309]).unwrap();
    assert!(sets.points.iter().all(|x| x.is_finite()) && !sets.levels.is_empty());
}

#[test]
fn many_levels_on_a_rough_surface() {
    let torus = jittered(&shapes::torus(16, 12, 0.3).unwrap(), 0.05, 9);
    let f = noise(torus.vertex_count(), 6);
    let levels = evenly_spaced_levels(&torus, &f, 50).unwrap();
    let sets = check(&torus, &f, &levels).unwrap();
    assert!(sets.closed.iter().all(|&closed| closed), "a closed surface has closed level sets");
}
