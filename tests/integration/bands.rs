//! Meshes cut into bands: areas, sides, orientation, and the topology that cutting must not change.

use std::collections::BTreeSet;

use core::f64::consts::PI;

use morse_smooth::field::Bands;
use morse_smooth::mesh::{TriMesh, shapes};
use proptest::prelude::*;

use crate::analyses::{bands, evenly_spaced_levels};
use crate::support::{
    book_of_three, edge_map, every_kind, jittered, mesh, noise, random_complex, random_surface, tied,
};

fn point(bands: &Bands, p: u32) -> [f64; 3] {
    core::array::from_fn(|i| bands.points[3 * p as usize + i])
}

/// Twice the area as a vector across the triangle.
fn normal([p, q, r]: [[f64; 3]; 3]) -> [f64; 3] {
    let (u, v): ([f64; 3], [f64; 3]) = (core::array::from_fn(|i| q[i] - p[i]), core::array::from_fn(|i| r[i] - p[i]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn area_of_bands(bands: &Bands) -> Vec<f64> {
    let mut areas = vec![0.0; bands.levels.len() + 1];
    for (t, &band) in bands.triangles.iter().zip(&bands.bands) {
        let n = normal(t.map(|p| point(bands, p)));
        areas[band as usize] += dot(n, n).sqrt() / 2.0;
    }
    areas
}

/// Vertices, less edges, plus triangles; vertices of no triangle left out.
fn euler(triangles: &[[u32; 3]]) -> i64 {
    let vertices: BTreeSet<u32> = triangles.iter().flatten().copied().collect();
    vertices.len() as i64 - edge_map(triangles).len() as i64 + triangles.len() as i64
}

/// Checks everything that must hold for any field and any levels.
fn check(mesh: &TriMesh, f: &[f64], levels: &[f64]) -> Result<Bands, TestCaseError> {
    let cut = bands(mesh, f, levels).unwrap();
    let source = mesh.connectivity().triangles();
    let edges = edge_map(source);
    prop_assert!(cut.levels.windows(2).all(|pair| pair[0] < pair[1]));
    prop_assert!(levels.iter().all(|level| cut.levels.contains(level)) && cut.levels.len() <= levels.len());
    let count = cut.parameters.len();
    prop_assert_eq!((cut.points.len(), cut.edges.len()), (3 * count, count));
    prop_assert_eq!((cut.bands.len(), cut.parents.len()), (cut.triangles.len(), cut.triangles.len()));
    let size = 1.0 + mesh.positions().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let range = f.iter().fold((f64::MAX, f64::MIN), |r, &x| (r.0.min(x), r.1.max(x)));
    // Points lie where they say they do, each once.
    let mut values = Vec::new();
    let mut seen = BTreeSet::new();
    for (place, &[a, b]) in cut.edges.iter().enumerate() {
        let (t, p, q) = (cut.parameters[place], mesh.position(a), mesh.position(b));
        let is_place = if a == b { t == 0.0 } else { edges.contains_key(&[a, b]) };
        prop_assert!(is_place && (0.0..=1.0).contains(&t));
        for i in 0..3 {
            prop_assert!((cut.points[3 * place + i] - ((1.0 - t) * p[i] + t * q[i])).abs() <= 1e-14 * size);
        }
        let value = (1.0 - t) * f[a as usize] + t * f[b as usize];
        if a == b {
            prop_assert!(seen.insert((a, b, 0)), "one point for each vertex");
        } else {
            let level = cut.levels.iter().position(|level| (value - level).abs() <= 1e-14 * (range.1 - range.0));
            prop_assert!(level.is_some(), "{} is no level", value);
        }
        values.push(value);
    }
    let used: BTreeSet<u32> = cut.triangles.iter().flatten().copied().collect();
    prop_assert_eq!(used.len(), count, "every point is used");
    // Triangles are of three points, in their band and in their parent, turned as it is.
    prop_assert!(cut.parents.windows(2).all(|pair| pair[0] <= pair[1]));
    let tolerance = 1e-14 * (range.1 - range.0);
    let mut areas = vec![0.0; source.len()];
    for (k, &t) in cut.triangles.iter().enumerate() {
        prop_assert!(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        let (band, parent) = (cut.bands[k] as usize, cut.parents[k] as usize);
        let lowest = if band == 0 { f64::NEG_INFINITY } else { cut.levels[band - 1] };
        let highest = cut.levels.get(band).copied().unwrap_or(f64::INFINITY);
        for p in t {
            prop_assert!(values[p as usize] >= lowest - tolerance && values[p as usize] <= highest + tolerance);
            prop_assert!(cut.edges[p as usize].iter().all(|v| source[parent].contains(v)));
        }
        // A vertex at the upper level is above it.
        let inner = t.iter().filter(|&&p| cut.edges[p as usize][0] == cut.edges[p as usize][1]);
        prop_assert!(inner.clone().all(|&p| values[p as usize] <= highest));
        let whole = normal(source[parent].map(|v| mesh.position(v)));
        let part = normal(t.map(|p| point(&cut, p)));
        let length = dot(whole, whole).sqrt();
        prop_assert!(dot(whole, part) >= -1e-13 * size * size * length, "orientation");
        areas[parent] += dot(part, part).sqrt();
    }
    for (t, &area) in areas.iter().enumerate() {
        let whole = normal(source[t].map(|v| mesh.position(v)));
        prop_assert!((area - dot(whole, whole).sqrt()).abs() <= 1e-12 * size * size, "area of triangle {}", t);
    }
    // As watertight as the mesh: inside of a parent and along an edge with two triangles two meet, elsewhere as many as there.
    prop_assert_eq!(euler(&cut.triangles), euler(source), "Euler characteristic");
    for (&[p, q], at) in &edge_map(&cut.triangles) {
        let ends: BTreeSet<u32> = [p, q].iter().flat_map(|&p| cut.edges[p as usize]).collect();
        let side = if ends.len() == 2 { ends.iter().copied().collect::<Vec<u32>>() } else { Vec::new() };
        let parents: BTreeSet<u32> = at.iter().map(|&t| cut.parents[t as usize]).collect();
        let expected = if side.len() == 2 { edges[&[side[0], side[1]]].len() } else { 2 };
        prop_assert_eq!(at.len(), expected, "triangles at a side");
        prop_assert_eq!(parents.len(), if side.len() == 2 { expected } else { 1 });
    }
    Ok(cut)
}

#[test]
fn every_kind_of_mesh_and_level() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        for f in [noise(n, 4), tied(n, 5, 2.0), mesh.positions().chunks_exact(3).map(|p| p[1]).collect(), vec![0.5; n]]
        {
            let (low, high) = f.iter().fold((f64::MAX, f64::MIN), |r, &x| (r.0.min(x), r.1.max(x)));
            let levels = [0.5, -0.25, f[0], high, low, f[n / 2], 0.0, -0.0, high + 1.0, low - 1.0, 0.1, 0.5, -1e300];
            check(&mesh, &f, &levels).unwrap_or_else(|e| panic!("{name}: {e}"));
            let many = evenly_spaced_levels(&mesh, &f, 40).unwrap();
            check(&mesh, &f, &many).unwrap_or_else(|e| panic!("{name}: {e}"));
            let all: Vec<f64> = f.clone();
            check(&mesh, &f, &all).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn random_complexes(seed: u64, n in 3_u32..10, m in 1_usize..40, steps in 0.5..4.0, level in -1.0..1.0) {
        let mesh = random_complex(seed, n, m);
        check(&mesh, &noise(n as usize, seed), &[level, 0.0])?;
        let f = tied(n as usize, seed, steps);
        check(&mesh, &f, &[level, f[0], f[1], f[0], f[2]])?;
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

fn coordinate(mesh: &TriMesh, axis: usize) -> Vec<f64> {
    mesh.positions().chunks_exact(3).map(|p| p[axis]).collect()
}

#[test]
fn strips_of_a_square() {
    // Levels beside the vertices, through them, and beyond the square.
    let grid = shapes::grid(9, 6).unwrap();
    let levels = [0.75, 0.1, 0.3, 0.5, 2.0];
    let cut = check(&grid, &coordinate(&grid, 0), &levels).unwrap();
    assert_eq!(cut.levels, [0.1, 0.3, 0.5, 0.75, 2.0]);
    for (found, expected) in area_of_bands(&cut).iter().zip([0.1, 0.2, 0.2, 0.25, 0.25, 0.0]) {
        assert!((found - expected).abs() < 1e-14, "{found}, expected {expected}");
    }
    // Along a diagonal.
    let f: Vec<f64> = grid.positions().chunks_exact(3).map(|p| p[0] + p[1]).collect();
    let cut = check(&grid, &f, &[0.4, 1.0]).unwrap();
    for (found, expected) in area_of_bands(&cut).iter().zip([0.08, 0.42, 0.5]) {
        assert!((found - expected).abs() < 1e-14, "{found}, expected {expected}");
    }
}

#[test]
fn zones_of_a_sphere_converge() {
    // Archimedes: the area between two parallel planes is 2π times their distance.
    let levels = [-0.5, 0.0, 0.8];
    let errors: Vec<f64> = (2..6)
        .map(|k| {
            let sphere = shapes::sphere(k).unwrap();
            let cut = check(&sphere, &coordinate(&sphere, 2), &levels).unwrap();
            let areas = area_of_bands(&cut);
            let exact = [0.5, 0.5, 0.8, 0.2].map(|height| 2.0 * PI * height);
            areas.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        })
        .collect();
    assert!(errors[3] < 0.01 && errors[0] / errors[3] > 20.0, "{errors:?}");
}

#[test]
fn nothing_to_cut() {
    for mesh in [shapes::sphere(2).unwrap(), book_of_three()] {
        let f = noise(mesh.vertex_count(), 3);
        for levels in [&[][..], &[5.0], &[-5.0]] {
            let cut = check(&mesh, &f, levels).unwrap();
            let corners = |t: &[u32; 3]| {
                let smallest = (0..3).min_by_key(|&i| t[i]).unwrap();
                [t[smallest], t[(smallest + 1) % 3], t[(smallest + 2) % 3]]
            };
            let found: Vec<[u32; 3]> = cut.triangles.iter().map(corners).collect();
            let expected: Vec<[u32; 3]> = mesh.connectivity().triangles().iter().map(corners).collect();
            assert_eq!((cut.points.as_slice(), found), (mesh.positions(), expected));
            assert!(cut.bands.iter().all(|&band| band == u32::from(levels == [-5.0])));
        }
    }
}

#[test]
fn levels_through_vertices_make_no_slivers() {
    // The equator of an octahedron: all cuts are vertices.
    let octahedron = shapes::octahedron().unwrap();
    let cut = check(&octahedron, &coordinate(&octahedron, 2), &[0.0, 1.0]).unwrap();
    assert_eq!((cut.parameters.len(), cut.triangles.len()), (6, 8));
    assert_eq!(cut.bands.iter().filter(|&&band| band == 1).count(), 4);
    // A vertex at the level in the middle of its triangle, whose long edge is cut: two parts.
    let triangle = mesh(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]]);
    let cut = check(&triangle, &[0.0, 1.0, 2.0], &[1.0]).unwrap();
    assert_eq!((cut.parameters.len(), cut.bands), (4, vec![0, 1]));
    // A plateau at the level belongs to the band above.
    let cut = check(&triangle, &[1.0; 3], &[1.0]).unwrap();
    assert_eq!(cut.bands, [1]);
}

#[test]
fn many_levels_and_refusals() {
    let triangle = mesh(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]]);
    let f = [0.0, 0.45, 1.0];
    let levels = evenly_spaced_levels(&triangle, &f, 10_000).unwrap();
    let cut = bands(&triangle, &f, &levels).unwrap();
    assert_eq!((cut.parameters.len(), cut.triangles.len()), (3 + 20_000, 1 + 20_000));
    assert!((area_of_bands(&cut).iter().sum::<f64>() - 0.5).abs() < 1e-12);
    let code = |levels: &[f64]| bands(&triangle, &f, levels).expect_err("refused").code();
    assert_eq!(code(&[0.0, f64::NAN]), "NonFiniteLevel");
    assert_eq!(code(&[f64::INFINITY]), "NonFiniteLevel");
    assert_eq!(code(&vec![0.0; 10_001]), "InvalidOption");
    assert_eq!(bands(&triangle, &f[1..], &[0.5]).expect_err("short").code(), "LengthMismatch");
    let rough = jittered(&shapes::torus(16, 12, 0.3).unwrap(), 0.05, 9);
    let f = noise(rough.vertex_count(), 6);
    let levels = evenly_spaced_levels(&rough, &f, 50).unwrap();
    check(&rough, &f, &levels).unwrap();
    // Values near the ends of double precision.
    for scale in [4e307, 1e-308] {
        let f: Vec<f64> = f.iter().map(|x| x * scale).collect();
        let levels = evenly_spaced_levels(&rough, &f, 5).unwrap();
        let cut = bands(&rough, &f, &levels).unwrap();
        assert!(cut.points.iter().all(|x| x.is_finite()));
        assert!((area_of_bands(&cut).iter().sum::<f64>() - rough.area()).abs() < 1e-9);
    }
}
