//! Persistence against the reduction of the whole boundary matrix, and the identities that hold on every complex.

use core::ops::ControlFlow;
use std::collections::BTreeSet;

use morse_smooth::field::{self, CriticalKind, DeltaOptions, PersistenceDiagram, ScalarField};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::{Progress, Watch};
use proptest::prelude::*;

use crate::analyses::{critical_points, persistence};
use crate::support::{edge_map, every_kind, islands, mesh, noise, random_complex, random_surface, tied};

/// What the textbook says: every simplex in the order of its highest vertex, one column of the boundary matrix each, reduced
/// from the left.
struct Reduced {
    /// (creator's highest vertex, destroyer's highest vertex) of classes that last, by dimension.
    pairs: [Vec<(u32, u32)>; 2],
    /// Highest vertices of what creates classes that stay, by dimension.
    essential: [Vec<u32>; 3],
}

/// `rank` is the place of each vertex in the order of the filtration.
fn reduce(mesh: &TriMesh, rank: &[usize]) -> Reduced {
    let triangles = mesh.connectivity().triangles();
    let mut simplices: Vec<Vec<u32>> = triangles.iter().map(|t| t.to_vec()).collect();
    simplices.extend(edge_map(triangles).into_keys().map(|edge| edge.to_vec()));
    simplices.extend(triangles.iter().flatten().copied().collect::<BTreeSet<u32>>().into_iter().map(|v| vec![v]));
    let key = |simplex: &Vec<u32>| {
        let mut ranks: Vec<usize> = simplex.iter().map(|&v| rank[v as usize]).collect();
        ranks.sort_unstable_by(|a, b| b.cmp(a));
        // The highest vertex, then the dimension, so that faces come before what they bound.
        (ranks[0], simplex.len(), ranks)
    };
    simplices.sort_by_key(key);
    for simplex in &mut simplices {
        simplex.sort_unstable();
    }
    let place = |simplex: &[u32]| simplices.iter().position(|other| other == simplex).expect("a face");
    let top = |i: usize| *simplices[i].iter().max_by_key(|&&v| rank[v as usize]).expect("a vertex");
    let mut columns: Vec<BTreeSet<usize>> = Vec::new();
    let mut owner: Vec<Option<usize>> = vec![None; simplices.len()];
    for (i, simplex) in simplices.iter().enumerate() {
        let mut column = BTreeSet::new();
        if simplex.len() > 1 {
            for left_out in simplex {
                let face: Vec<u32> = simplex.iter().copied().filter(|v| v != left_out).collect();
                column.insert(place(&face));
            }
        }
        while let Some(&pivot) = column.last() {
            let Some(other) = owner[pivot] else { break };
            let sum: BTreeSet<usize> = column.symmetric_difference(&columns[other]).copied().collect();
            column = sum;
        }
        if let Some(&pivot) = column.last() {
            owner[pivot] = Some(i);
        }
        columns.push(column);
    }
    let mut found = Reduced { pairs: [Vec::new(), Vec::new()], essential: [Vec::new(), Vec::new(), Vec::new()] };
    for i in 0..simplices.len() {
        if !columns[i].is_empty() {
            continue;
        }
        match owner[i] {
            Some(j) if top(i) != top(j) => found.pairs[simplices[i].len() - 1].push((top(i), top(j))),
            Some(_) => {}
            None => found.essential[simplices[i].len() - 1].push(top(i)),
        }
    }
    found
}

fn ranks(values: &[f64], downwards: bool) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]).then(a.cmp(&b)));
    if downwards {
        order.reverse();
    }
    let mut ranks = vec![0; values.len()];
    for (rank, &v) in order.iter().enumerate() {
        ranks[v] = rank;
    }
    ranks
}

fn pairs_of(diagram: &PersistenceDiagram, kind: CriticalKind) -> Vec<(u32, u32)> {
    let pairs = diagram.pairs.iter().filter(|pair| pair.kind == kind);
    sorted(pairs.map(|pair| (pair.extremum, pair.saddle)).collect())
}

fn sorted<T: Ord>(mut list: Vec<T>) -> Vec<T> {
    list.sort_unstable();
    list
}

fn check(name: &str, mesh: &TriMesh, values: &[f64]) {
    // The textbook's order knows no −0.
    let values: Vec<f64> = values.iter().map(|v| v + 0.0).collect();
    let diagram = persistence(mesh, &values).expect("a field");
    let (up, down) = (reduce(mesh, &ranks(&values, false)), reduce(mesh, &ranks(&values, true)));
    assert_eq!(pairs_of(&diagram, CriticalKind::Minimum), sorted(up.pairs[0].clone()), "{name}: minima");
    assert_eq!(pairs_of(&diagram, CriticalKind::Maximum), sorted(down.pairs[0].clone()), "{name}: maxima");
    assert_eq!(diagram.essential_minima, sorted(up.essential[0].clone()), "{name}: essential minima");
    assert_eq!(diagram.essential_maxima, sorted(down.essential[0].clone()), "{name}: essential maxima");
    let rank = ranks(&values, false);
    let mut loops = up.essential[1].clone();
    loops.sort_by_key(|&v| rank[v as usize]);
    assert_eq!(diagram.essential_saddles, loops, "{name}: essential saddles");
    let betti = up.essential.each_ref().map(|classes| classes.len() as i64);
    let isolated = mesh.topology().unwrap().isolated_vertices as i64;
    let euler = mesh.topology().unwrap().euler_characteristic;
    assert_eq!(betti[0] + isolated - betti[1] + betti[2], euler, "{name}: the oracle itself");
    for pair in &diagram.pairs {
        let (e, s) = (values[pair.extremum as usize], values[pair.saddle as usize]);
        assert_eq!((pair.birth, pair.death), (e.min(s), e.max(s)), "{name}");
        assert_eq!(pair.persistence, pair.death - pair.birth, "{name}");
    }
    assert!(diagram.pairs.is_sorted_by(|a, b| a.persistence >= b.persistence), "{name}: descending");
    if mesh.topology().unwrap().closed
        && mesh.topology().unwrap().non_manifold_vertices == 0
        && mesh.topology().unwrap().non_manifold_edges == 0
    {
        // On a closed surface the pairs of maxima are those of loops that come to bound.
        let mirrored = sorted(down.pairs[0].iter().map(|&(extremum, saddle)| (saddle, extremum)).collect());
        assert_eq!(mirrored, sorted(up.pairs[1].clone()), "{name}: duality");
        let counts = critical_points(mesh, &values, &DeltaOptions::default()).expect("a field").counts;
        let (pairs, loops) = (diagram.pairs.len() as i64, diagram.essential_saddles.len() as i64);
        assert_eq!(i64::from(counts.saddles), pairs + loops, "{name}: every saddle once");
        assert_eq!(i64::from(counts.minima) + i64::from(counts.maxima) - pairs - loops, euler - isolated, "{name}");
    }
}

#[test]
fn every_kind_of_mesh_agrees_with_the_boundary_matrix() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        if n > 120 {
            continue;
        }
        check(name, &mesh, &vec![2.5; n]);
        for seed in 0..6 {
            check(&format!("{name}, noise {seed}"), &mesh, &noise(n, seed));
            check(&format!("{name}, ties {seed}"), &mesh, &tied(n, seed, 3.0));
            check(&format!("{name}, two values {seed}"), &mesh, &tied(n, seed, 1.0));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_complexes_agree_with_the_boundary_matrix(seed: u64, n in 3_u32..10, triangles in 1_usize..40, steps in 1_u8..12) {
        let complex = random_complex(seed, n, triangles);
        check("random complex", &complex, &tied(n as usize, seed ^ 1, f64::from(steps)));
    }

    #[test]
    fn surfaces_with_holes_agree_with_the_boundary_matrix(seed: u64, removed in 0.0_f64..0.5, steps in 1_u8..40) {
        for base in [shapes::torus(6, 5, 0.3).unwrap(), shapes::grid(6, 5).unwrap()] {
            let surface = random_surface(seed, &base, removed);
            check("surface", &surface, &tied(surface.vertex_count(), seed ^ 2, f64::from(steps)));
        }
    }
}

#[test]
fn dense_complexes_agree_with_the_boundary_matrix() {
    for (seed, n, triangles) in [(1, 12, 60), (2, 12, 120), (3, 14, 90), (4, 16, 100), (5, 20, 150)] {
        let complex = random_complex(seed, n, triangles);
        for steps in [1.0, 4.0, 100.0] {
            let values = tied(n as usize, seed ^ 1, steps);
            check(&format!("{triangles} triangles on {n} vertices, {steps} steps"), &complex, &values);
        }
    }
}

#[test]
fn dense_complexes_take_little_more_work_than_they_have_triangles() {
    // One triple in twenty of all: every two vertices share several triangles, and loops at a vertex bound soon after.
    let complex = random_complex(5, 240, 113_764);
    let values = noise(240, 7);
    let mut asked = 0;
    let mut count = |_: Progress| {
        asked += 1;
        ControlFlow::Continue(())
    };
    let diagram = field::persistence(&ScalarField::new(&complex, &values).unwrap(), &Watch::new(&mut count)).unwrap();
    // With so many triangles every loop bounds.
    assert!(diagram.essential_saddles.is_empty());
    // The watcher is asked after every few milliseconds of work. Reducing coboundaries took thousands of these.
    assert!((1..400).contains(&asked), "{asked}");
}

#[test]
fn a_monkey_saddle_has_its_pairs_told_apart() {
    // A cone over a hexagon of alternating heights, with a floor: three hollows and three hills meet in the middle.
    let mut positions = vec![[0.0; 3], [0.0, 0.0, -1.0]];
    for i in 0..6 {
        let (x, y) = [(1.0, 0.0), (0.5, 0.9), (-0.5, 0.9), (-1.0, 0.0), (-0.5, -0.9), (0.5, -0.9)][i];
        positions.push([x, y, 0.0]);
    }
    let mut triangles = Vec::new();
    for i in 0..6_u32 {
        let (a, b) = (2 + i, 2 + (i + 1) % 6);
        triangles.push([0, a, b]);
        triangles.push([1, b, a]);
    }
    let sphere = mesh(&positions, &triangles);
    // Below the middle: 2, 4, 6. The floor is above all of it.
    let values = [0.0, 9.0, -1.0, 1.0, -2.0, 2.0, -3.0, 3.0];
    let diagram = persistence(&sphere, &values).unwrap();
    let found: Vec<(u32, u32, f64)> = diagram.pairs.iter().map(|p| (p.extremum, p.saddle, p.persistence)).collect();
    assert_eq!(found, [(4, 0, 2.0), (2, 0, 1.0)]);
    assert_eq!((diagram.essential_minima.as_slice(), diagram.essential_maxima.as_slice()), (&[6][..], &[1][..]));
    assert!(diagram.essential_saddles.is_empty());
}

#[test]
fn the_curve_counts_what_is_above_each_threshold() {
    let torus = shapes::torus(24, 16, 0.0).unwrap();
    for values in [noise(384, 3), tied(384, 4, 5.0), vec![1.0; 384]] {
        let diagram = persistence(&torus, &values).unwrap();
        let curve = diagram.curve();
        assert_eq!(curve.threshold[0], 0.0);
        assert!(curve.threshold.is_sorted_by(|a, b| a < b));
        for (k, &threshold) in curve.threshold.iter().enumerate() {
            let next = curve.threshold.get(k + 1).copied().unwrap_or(f64::INFINITY);
            for t in [threshold, next.next_down()] {
                let above =
                    |kind| diagram.pairs.iter().filter(|p| p.kind == kind && p.persistence > t).count() as u32 + 1;
                assert_eq!(curve.minima[k], above(CriticalKind::Minimum));
                assert_eq!(curve.maxima[k], above(CriticalKind::Maximum));
            }
        }
    }
}

#[test]
fn parts_have_their_own_essential_extrema_and_isolated_vertices_none() {
    let mesh = islands();
    let diagram = persistence(&mesh, &noise(mesh.vertex_count(), 5)).unwrap();
    assert_eq!((diagram.essential_minima.len(), diagram.essential_maxima.len()), (2, 2));
    for v in mesh.connectivity().isolated_vertices() {
        assert!(!diagram.essential_minima.contains(&v) && !diagram.essential_maxima.contains(&v));
    }
}

#[test]
fn bad_fields_are_refused() {
    let torus = shapes::torus(8, 6, 0.0).unwrap();
    let code = |values: &[f64]| persistence(&torus, values).unwrap_err().code();
    assert_eq!(code(&[0.0; 47]), "LengthMismatch");
    let mut values = vec![0.0; 48];
    values[7] = f64::NAN;
    assert_eq!(code(&values), "NonFiniteValue");
    (values[7], values[8]) = (f64::MAX, f64::MIN);
    assert_eq!(code(&values), "RangeOverflow");
}
