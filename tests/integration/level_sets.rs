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

/// Where a line of a level goes through: a vertex at the level, or an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Vertex(u32),
    Edge([u32; 2]),
}

/// Whether a line is closed, and its pieces, ascending.
type Line = (bool, Vec<[Place; 2]>);

fn place(f: &[f64], level: f64, [a, b]: [u32; 2]) -> Place {
    let upper = if f[a as usize] >= level { a } else { b };
    if f[upper as usize] == level { Place::Vertex(upper) } else { Place::Edge([a.min(b), a.max(b)]) }
}

fn line(closed: bool, mut pieces: Vec<[Place; 2]>) -> Line {
    pieces.iter_mut().for_each(|piece| piece.sort());
    pieces.sort();
    (closed, pieces)
}

/// The lines of a level as they must be: a piece in every triangle that it cuts, those in triangles next to each other in one line,
/// without pieces that begin and end in the same vertex.
fn chains(mesh: &TriMesh, f: &[f64], level: f64) -> Vec<Line> {
    let triangles = mesh.connectivity().triangles();
    let sides = edge_map(triangles);
    let mut names: Vec<usize> = (0..triangles.len()).collect();
    let is_cut = |[a, b]: [u32; 2]| (f[a as usize] >= level) != (f[b as usize] >= level);
    for (&edge, at) in &sides {
        if is_cut(edge) && at.len() == 2 {
            let (from, to) = (names[at[0] as usize], names[at[1] as usize]);
            names.iter_mut().filter(|name| **name == from).for_each(|name| *name = to);
        }
    }
    let mut lines: BTreeMap<usize, (bool, Vec<[Place; 2]>)> = BTreeMap::new();
    for (t, &[a, b, c]) in triangles.iter().enumerate() {
        let cut: Vec<[u32; 2]> = [[a, b], [b, c], [c, a]].into_iter().filter(|&edge| is_cut(edge)).collect();
        if let &[p, q] = &cut[..] {
            let line = lines.entry(names[t]).or_insert((true, Vec::new()));
            line.0 &= cut.iter().all(|&[a, b]| sides[&[a.min(b), a.max(b)]].len() == 2);
            let piece = [place(f, level, p), place(f, level, q)];
            line.1.extend((piece[0] != piece[1]).then_some(piece));
        }
    }
    lines.into_values().filter(|(_, pieces)| !pieces.is_empty()).map(|(closed, pieces)| line(closed, pieces)).collect()
}

/// The lines of a level as they are.
fn found_lines(sets: &LevelSets, f: &[f64], level: f64) -> Vec<Line> {
    let of_level = (0..sets.levels.len()).filter(|&k| sets.levels[k].to_bits() == level.to_bits());
    let found = of_level.map(|k| {
        let range = sets.offsets[k] as usize..sets.offsets[k + 1] as usize;
        let places: Vec<Place> = sets.edges[range].iter().map(|&edge| place(f, level, edge)).collect();
        let mut pieces: Vec<[Place; 2]> = places.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        pieces.extend(sets.closed[k].then(|| [places[places.len() - 1], places[0]]));
        line(sets.closed[k], pieces)
    });
    found.collect()
}

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
    // The triangles that lines pass must be those that their level cuts, each exactly once. Where a level goes through vertices,
    // points have become one, and the lines are compared with those that `chains` makes.
    let is_at_vertex = |level: f64| f.contains(&level);
    let mut passed: BTreeMap<u64, BTreeMap<u32, usize>> = BTreeMap::new();
    let mut line_levels = Vec::new();
    for k in 0..sets.levels.len() {
        let (start, end) = (sets.offsets[k] as usize, sets.offsets[k + 1] as usize);
        let level = sets.levels[k];
        line_levels.push((level, sets.closed[k]));
        let fewest = if sets.closed[k] && !is_at_vertex(level) { 3 } else { 2 };
        prop_assert!(end - start >= fewest, "line {} has {} points", k, end - start);
        for place in start..end {
            let [a, b] = sets.edges[place];
            let t = sets.parameters[place];
            let value = (1.0 - t) * f[a as usize] + t * f[b as usize];
            prop_assert!((value - level).abs() <= 1e-14 * (range.1 - range.0), "{} for {}", value, level);
            prop_assert!((f[a as usize] >= level) != (f[b as usize] >= level));
        }
        let steps = if sets.closed[k] { end - start } else { end - start - 1 };
        for step in 0..steps {
            let [p, q] = [start + step, start + (step + 1) % (end - start)].map(|p| &sets.points[3 * p..3 * p + 3]);
            prop_assert!(p != q, "a segment of length 0 on line {}", k);
        }
        if is_at_vertex(level) {
            continue;
        }
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
        let (mut found, expected) = (found_lines(&sets, f, level), chains(mesh, f, level));
        found.sort();
        let mut repeated: Vec<Line> = (0..times).flat_map(|_| expected.iter().cloned()).collect();
        repeated.sort();
        prop_assert_eq!(found, repeated, "lines of {}", level);
        if is_at_vertex(level) {
            continue;
        }
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
    // At the maximum the line shrinks to the vertex and is left out, at the minimum it is empty.
    assert!(check(&octahedron, &z, &[1.0]).unwrap().levels.is_empty());
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
    // Between neighbouring doubles there is no level, and between others each only once.
    for steps in [1, 2, 3, 7] {
        let top = f64::from_bits(1.5_f64.to_bits() + steps);
        let close: Vec<f64> = f.iter().map(|&x| if x > 0.0 { top } else { 1.5 }).collect();
        for count in [1, 2, 3, 50, 10_000] {
            let levels = evenly_spaced_levels(&grid, &close, count).unwrap();
            assert!(levels.is_sorted_by(|a, b| a < b), "{count} in {steps} steps: {levels:?}");
            assert!(levels.iter().all(|&level| 1.5 < level && level < top));
            assert!(levels.len() <= count && levels.len() < steps as usize);
            if count >= 50 {
                assert_eq!(levels.len(), steps as usize - 1, "{count} in {steps} steps");
            }
        }
    }
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

#[test]
fn integer_heights_and_levels() {
    // Integer heights and integer levels: most lines go through vertices.
    for (name, mesh) in every_kind() {
        for seed in 0..20 {
            let most = 1 + seed % 5;
            let f: Vec<f64> = noise(mesh.vertex_count(), seed)
                .iter()
                .map(|x| ((x + 1.0) * 0.5 * (most + 1) as f64).floor())
                .collect();
            let levels: Vec<f64> = (0..=most + 1).map(|k| k as f64).collect();
            check(&mesh, &f, &levels).unwrap_or_else(|e| panic!("{name}, seed {seed}: {e}"));
        }
    }
}

/// The sum of the lengths of the level's pieces in all triangles.
fn length_by_triangles(mesh: &TriMesh, f: &[f64], level: f64) -> f64 {
    let cut = |a: u32, b: u32| {
        let (x, y) = (f[a as usize], f[b as usize]);
        let (t, p, q) = ((level - x) / (y - x), mesh.position(a), mesh.position(b));
        ((x >= level) != (y >= level)).then(|| [0, 1, 2].map(|i| (1.0 - t) * p[i] + t * q[i]))
    };
    let piece = |&[a, b, c]: &[u32; 3]| {
        let ends: Vec<[f64; 3]> = [cut(a, b), cut(b, c), cut(c, a)].into_iter().flatten().collect();
        match ends[..] {
            [p, q] => (p[0] - q[0]).hypot(p[1] - q[1]).hypot(p[2] - q[2]),
            _ => 0.0,
        }
    };
    mesh.connectivity().triangles().iter().map(piece).sum()
}

#[test]
fn lengths_add_up_however_near_levels_come_to_vertices() {
    let torus = jittered(&shapes::torus(40, 24, 0.2).unwrap(), 1e-3, 5);
    let n = torus.vertex_count();
    for seed in 0..4 {
        let f: Vec<f64> = noise(n, seed).iter().map(|x| (3.0 * x).round()).collect();
        for near in [0.0, 1e-17, 1e-16, 3e-16, 1e-15, 1e-12, 1e-6] {
            let levels: Vec<f64> = (-3..=3).flat_map(|k| [f64::from(k) + near, f64::from(k) - near]).collect();
            let sets = level_sets(&torus, &f, &levels).unwrap();
            for &level in &levels {
                let lines = (0..sets.levels.len()).filter(|&k| sets.levels[k] == level);
                let found: f64 = lines.map(|k| length(&sets, k)).sum();
                let times = levels.iter().filter(|&&other| other == level).count() as f64;
                let expected = times * length_by_triangles(&torus, &f, level);
                assert!((found - expected).abs() <= 1e-12 * (1.0 + expected), "{found} for {expected} at {level}");
            }
            for k in 0..sets.levels.len() {
                let points = &sets.points[3 * sets.offsets[k] as usize..3 * sets.offsets[k + 1] as usize];
                let points: Vec<&[f64]> = points.chunks_exact(3).collect();
                let last = if sets.closed[k] { points.len() } else { points.len() - 1 };
                assert!((0..last).all(|i| points[i] != points[(i + 1) % points.len()]), "{near}: line {k}");
                assert!(points.len() >= 2);
            }
        }
    }
}

#[test]
fn the_rule_for_levels_at_extrema() {
    // A single vertex has no line, whether it is a maximum or a minimum.
    let grid = shapes::grid(7, 7).unwrap();
    let mut f = vec![0.0; 49];
    f[24] = 1.0;
    assert!(level_sets(&grid, &f, &[1.0]).unwrap().levels.is_empty());
    f[24] = -1.0;
    assert!(level_sets(&grid, &f, &[-1.0]).unwrap().levels.is_empty());
    // The plateau around the pit is parted from it.
    let sets = level_sets(&grid, &f, &[0.0]).unwrap();
    assert_eq!((sets.closed.clone(), sets.edges.len()), (vec![true], 6));
    // A plateau of the triangle 24, 25, 31 is outlined, by its three corners.
    let triangle = grid.connectivity().triangles().iter().find(|t| t.contains(&24) && t.contains(&25)).unwrap();
    let mut f = vec![0.0; 49];
    triangle.iter().for_each(|&v| f[v as usize] = 2.0);
    let sets = level_sets(&grid, &f, &[2.0]).unwrap();
    assert_eq!((sets.closed.clone(), sets.edges.len()), (vec![true], 3));
    let mut corners: Vec<[f64; 3]> = sets.points.as_chunks::<3>().0.to_vec();
    let mut expected: Vec<[f64; 3]> = triangle.iter().map(|&v| grid.position(v)).collect();
    corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
    expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(corners, expected);
    // A plateau of one edge: to and fro.
    let mut f = vec![0.0; 49];
    (f[24], f[25]) = (2.0, 2.0);
    let sets = level_sets(&grid, &f, &[2.0]).unwrap();
    assert_eq!((sets.closed.clone(), sets.edges.len()), (vec![true], 2));
    // A plateau without lower ground beside it has no line, as there is no band below it.
    let f: Vec<f64> = f.iter().map(|x| -x).collect();
    assert!(level_sets(&grid, &f, &[-2.0]).unwrap().levels.is_empty());
}
