//! Levels just below and just above saddles: how the lines change there.

use morse_smooth::field::{CriticalKind, DeltaOptions};
use morse_smooth::mesh::{TriMesh, shapes};

use crate::analyses::{critical_points, level_sets, saddle_levels};
use crate::support::{every_kind, mesh, noise, tied};

fn lines(mesh: &TriMesh, f: &[f64], level: f64) -> usize {
    level_sets(mesh, f, &[level]).unwrap().levels.len()
}

#[test]
fn circles_of_an_upright_torus() {
    let torus = shapes::torus(48, 24, 0.0).unwrap();
    let f: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[1] + 0.07 * p[2]).collect();
    let count = |offset: f64| -> Vec<usize> {
        let levels = saddle_levels(&torus, &f, None, offset).unwrap();
        levels.iter().map(|&level| lines(&torus, &f, level)).collect()
    };
    assert_eq!(count(0.0), [1, 2, 2, 1]);
    assert_eq!(count(1e-3), [1, 2, 2, 1]);
    // The levels are the value itself and the next number.
    let points = critical_points(&torus, &f, &DeltaOptions::default()).unwrap().points;
    let mut expected: Vec<f64> = points
        .iter()
        .filter(|p| p.kind == CriticalKind::Saddle)
        .flat_map(|p| [f[p.vertex as usize], f[p.vertex as usize].next_up()])
        .collect();
    expected.sort_by(f64::total_cmp);
    assert_eq!(saddle_levels(&torus, &f, None, 0.0).unwrap(), expected);
}

#[test]
fn lines_through_a_saddle_of_any_multiplicity() {
    // Around the middle vertex k + 1 sectors below and as many above; outside of the ring the fan ends.
    for k in 1..5_u32 {
        let ring = 2 * (k + 1);
        let positions: Vec<[f64; 3]> = (0..=ring)
            .map(|v| {
                let angle = f64::from(v) / f64::from(ring) * core::f64::consts::TAU;
                if v == 0 { [0.0; 3] } else { [angle.cos(), angle.sin(), 0.0] }
            })
            .collect();
        let triangles: Vec<[u32; 3]> = (0..ring).map(|v| [0, 1 + v, 1 + (v + 1) % ring]).collect();
        let fan = mesh(&positions, &triangles);
        let f: Vec<f64> = (0..=ring).map(|v| if v == 0 { 0.25 } else { f64::from(v % 2) }).collect();
        let levels = saddle_levels(&fan, &f, Some(&[0]), 0.0).unwrap();
        assert_eq!(levels, [0.25, 0.25_f64.next_up()]);
        // Below, each of the k + 1 low sectors is cut off by a line of its own: two triangles. Above, each of the high ones.
        for &level in &levels {
            let sets = level_sets(&fan, &f, &[level]).unwrap();
            assert_eq!(sets.levels.len() as u32, k + 1);
            let above = level > 0.25;
            for pair in sets.offsets.windows(2) {
                // The middle point of a line is on the edge from the saddle into its sector.
                let middle = sets.edges[pair[0] as usize + 1];
                assert_eq!((pair[1] - pair[0], middle[0]), (3, 0));
                assert_eq!(f[middle[1] as usize] > 0.25, above);
            }
        }
        assert_eq!(saddle_levels(&fan, &f, None, 0.0).unwrap(), levels);
    }
}

#[test]
fn every_saddle_has_its_levels() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        for f in [noise(n, 4), tied(n, 5, 2.0), vec![0.5; n]] {
            let points = critical_points(&mesh, &f, &DeltaOptions::default()).unwrap().points;
            let saddles: Vec<u32> =
                points.iter().filter(|p| p.kind == CriticalKind::Saddle).map(|p| p.vertex).collect();
            let all = saddle_levels(&mesh, &f, None, 0.0).unwrap();
            assert_eq!(all, saddle_levels(&mesh, &f, Some(&saddles), 0.0).unwrap(), "{name}");
            assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{name}");
            for &v in &saddles {
                let value = f[v as usize];
                assert!(all.contains(&value) && all.contains(&value.next_up()), "{name}");
            }
            assert!(all.len() <= 2 * saddles.len(), "{name}");
            level_sets(&mesh, &f, &all).unwrap();
        }
    }
}

#[test]
fn values_at_the_edges_and_refusals() {
    let triangle = mesh(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], &[[0, 1, 2]]);
    let f = [0.0, 1.0, 3.0];
    let levels = |vertices: &[u32], offset: f64| saddle_levels(&triangle, &f, Some(vertices), offset);
    // Vertices need not be saddles; repeated values and levels come once.
    assert_eq!(levels(&[1, 1], 0.1).unwrap(), [1.0 - 0.1 * 3.0, 1.0 + 0.1 * 3.0]);
    assert_eq!(levels(&[0, 1], 0.5).unwrap(), [-1.5, -0.5, 1.5, 2.5]);
    assert_eq!(levels(&[0], 0.0).unwrap(), [0.0, f64::from_bits(1)]);
    assert!(levels(&[], 0.0).unwrap().is_empty());
    // An offset lost in rounding, and levels beyond the finite numbers.
    assert_eq!(levels(&[1], 1e-30).unwrap(), [1.0, 1.0_f64.next_up()]);
    let huge = saddle_levels(&triangle, &[0.0, 1.0, f64::MAX], Some(&[2]), 0.0).unwrap();
    assert_eq!(huge, [f64::MAX]);
    assert_eq!(saddle_levels(&triangle, &[0.0, 1.0, 1e308], Some(&[2]), 1e300).unwrap().len(), 1);
    let code = |vertices: &[u32], offset: f64| levels(vertices, offset).expect_err("refused").code();
    assert_eq!(code(&[0, 3], 0.0), "IndexOutOfBounds");
    assert_eq!([-0.1, f64::NAN, f64::INFINITY].map(|offset| code(&[0], offset)), ["InvalidOption"; 3]);
    assert_eq!(saddle_levels(&triangle, &f[1..], None, 0.0).expect_err("short").code(), "LengthMismatch");
    // The range is that of vertices in triangles.
    let lonely = mesh(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [5., 5., 5.]], &[[0, 1, 2]]);
    assert_eq!(saddle_levels(&lonely, &[0., 1., 4., 100.], Some(&[1]), 0.25).unwrap(), [0.0, 2.0]);
    // Too many.
    let torus = shapes::torus(300, 200, 0.0).unwrap();
    let error = saddle_levels(&torus, &noise(60_000, 1), None, 0.0).expect_err("refused");
    assert_eq!(error.code(), "InvalidOption");
    assert!(error.to_string().contains("5000 different values"), "{error}");
}
