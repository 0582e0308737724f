//! ε-simplification: exactly the wanted extrema, and no value farther off than the threshold.

use std::collections::{BTreeMap, BTreeSet};

use morse_smooth::Watch;
use morse_smooth::field::{self, CriticalKind, DeltaOptions, Keep, ScalarField, Simplified, Threshold, value_range};
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use proptest::prelude::*;

use crate::analyses::{critical_points, persistence, simplify};
use crate::support::{
    bow_tie, complex, every_kind, islands, noise, random_complex, random_surface, shuffle, tied,
    two_tetrahedra_at_a_vertex,
};

fn extrema(mesh: &TriMesh, values: &[f64]) -> BTreeSet<(u32, CriticalKind)> {
    let points = critical_points(mesh, values, &DeltaOptions::default()).expect("a field").points;
    points.iter().filter(|p| p.kind != CriticalKind::Saddle).map(|p| (p.vertex, p.kind)).collect()
}

/// What the threshold is to leave, by the pairs.
fn above(mesh: &TriMesh, values: &[f64], threshold: f64) -> BTreeSet<(u32, CriticalKind)> {
    let diagram = persistence(mesh, values).expect("a field");
    let mut kept: BTreeSet<(u32, CriticalKind)> =
        diagram.pairs.iter().filter(|p| p.persistence > threshold).map(|p| (p.extremum, p.kind)).collect();
    kept.extend(diagram.essential_minima.iter().map(|&v| (v, CriticalKind::Minimum)));
    kept.extend(diagram.essential_maxima.iter().map(|&v| (v, CriticalKind::Maximum)));
    kept
}

fn largest_change(before: &[f64], after: &[f64]) -> f64 {
    before.iter().zip(after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn is_surface(mesh: &TriMesh) -> bool {
    mesh.topology().unwrap().non_manifold_vertices == 0 && mesh.topology().unwrap().non_manifold_edges == 0
}

fn check_threshold(name: &str, mesh: &TriMesh, values: &[f64], threshold: f64) {
    let keep = Keep::Above(Threshold::Absolute(threshold));
    let wanted = above(mesh, values, threshold);
    let field = ScalarField::new(mesh, values).unwrap();
    let Simplified { values: simple, unavoidable } = field::simplify(&field, keep, &Watch::none()).unwrap();
    assert!(unavoidable.is_empty() || !is_surface(mesh), "{name}: {unavoidable:?}");
    let mut found = extrema(mesh, &simple);
    found.retain(|(v, _)| !unavoidable.contains(v));
    assert_eq!(found, wanted, "{name}, threshold {threshold}");
    assert!(unavoidable.iter().all(|v| !wanted.iter().any(|(kept, _)| kept == v)));
    let change = largest_change(values, &simple);
    // What is as persistent as the threshold, or nearly so, leaves no room for the tilt: a step for each vertex at most.
    let step = values.iter().fold(0.0_f64, |size, v| size.max(v.abs())) * f64::EPSILON;
    let tilt = values.len() as f64 * step + f64::from_bits(values.len() as u64);
    let near = |p: f64| p <= threshold && p >= threshold - tilt;
    let exact = threshold <= tilt || persistence(mesh, values).unwrap().pairs.iter().any(|p| near(p.persistence));
    let tilt = if exact { tilt } else { 0.0 };
    assert!(change <= threshold + tilt, "{name}: {change} for {threshold}");
    if mesh.topology().unwrap().closed && is_surface(mesh) {
        let counts = critical_points(mesh, &simple, &DeltaOptions::default()).unwrap().counts;
        let isolated = mesh.topology().unwrap().isolated_vertices as i64;
        let sum = i64::from(counts.minima) + i64::from(counts.maxima) - i64::from(counts.saddles);
        assert_eq!(sum + isolated, mesh.topology().unwrap().euler_characteristic, "{name}");
    }
}

#[test]
fn a_threshold_leaves_exactly_the_more_persistent_extrema() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        for seed in 0..4 {
            let noise = noise(n, seed);
            for threshold in [0.0, 0.1, 0.5, 1.3, 5.0] {
                check_threshold(&format!("{name}, noise {seed}"), &mesh, &noise, threshold);
            }
            for steps in [1.0, 3.0, 20.0] {
                let tied = tied(n, seed, steps);
                let step = value_range(mesh.connectivity(), &tied).unwrap().length() / steps;
                for threshold in [0.0, 0.4 * step, 1.4 * step, 30.0] {
                    check_threshold(&format!("{name}, {steps} steps {seed}"), &mesh, &tied, threshold);
                }
            }
        }
        for seed in 0..2 {
            let values = tied(n, seed, 4.0);
            for pair in persistence(&mesh, &values).unwrap().pairs.iter().take(3) {
                for threshold in [pair.persistence, pair.persistence.next_up(), pair.persistence.next_down().max(0.0)] {
                    check_threshold(&format!("{name}, at a tie"), &mesh, &values, threshold);
                }
            }
            check_threshold(&format!("{name}, next to nothing"), &mesh, &values, 1e-300);
        }
        check_threshold(&format!("{name}, constant"), &mesh, &vec![-7.5; n], 0.0);
        check_threshold(&format!("{name}, constant"), &mesh, &vec![0.0; n], 1.0);
    }
}

#[test]
fn named_extrema_stay_and_no_others() {
    for (name, mesh) in every_kind().into_iter().filter(|(_, mesh)| is_surface(mesh)) {
        let n = mesh.vertex_count();
        for seed in 0..6_u64 {
            for values in [noise(n, seed), tied(n, seed, 4.0)] {
                let mut random = Random::new(seed);
                let diagram = persistence(&mesh, &values).unwrap();
                let mut wanted = above(&mesh, &values, f64::INFINITY);
                let mut others: Vec<(u32, CriticalKind)> = diagram.pairs.iter().map(|p| (p.extremum, p.kind)).collect();
                shuffle(&mut others, &mut random);
                others.truncate((random.uniform() * (others.len() + 1) as f64) as usize);
                // Lower maxima in place of higher ones, and the other way round, as long as every part has one.
                if mesh.topology().unwrap().components == 1 && seed % 2 == 1 {
                    for kind in [CriticalKind::Minimum, CriticalKind::Maximum] {
                        if others.iter().any(|&(_, other)| other == kind) {
                            wanted.retain(|&(_, other)| other != kind);
                        }
                    }
                }
                wanted.extend(others);
                let keep: Vec<u32> = wanted.iter().map(|&(v, _)| v).collect();
                let simple = simplify(&mesh, &values, Keep::Extrema(&keep)).unwrap_or_else(|e| panic!("{name}: {e}"));
                assert_eq!(extrema(&mesh, &simple), wanted, "{name}, seed {seed}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn surfaces_with_holes(seed: u64, removed in 0.0_f64..0.4, steps in 1_u8..40, threshold in 0.0_f64..2.0) {
        for base in [shapes::torus(9, 7, 0.3).unwrap(), shapes::grid(9, 8).unwrap()] {
            let surface = random_surface(seed, &base, removed);
            check_threshold("surface", &surface, &tied(surface.vertex_count(), seed ^ 2, f64::from(steps)), threshold);
        }
    }
}

#[test]
fn whole_numbers_are_cut_at_exactly_their_persistence() {
    // Heights in whole metres, and a threshold that is the persistence of many pairs to the last bit.
    let terrain = shapes::grid(40, 40).unwrap();
    for seed in 0..5 {
        let heights: Vec<f64> = tied(terrain.vertex_count(), seed, 12.0).iter().map(|h| (h * 6.0).round()).collect();
        for threshold in [1.0, 2.0, 5.0] {
            let keep = Keep::Above(Threshold::Absolute(threshold));
            let simple = simplify(&terrain, &heights, keep).unwrap();
            assert_eq!(extrema(&terrain, &simple), above(&terrain, &heights, threshold));
            let change = largest_change(&heights, &simple);
            assert!(change <= threshold * (1.0 + 1e-12), "{change} for {threshold}");
        }
    }
}

#[test]
fn the_tilt_keeps_to_the_threshold_where_heights_leave_room_for_it() {
    // A few heights, each 64 doubles above the one below, and pairs that are exactly as persistent as the threshold. What rises by
    // all of it has no room above for the tilt; it starts so much lower.
    let step = 64.0 * f64::EPSILON;
    let threshold = 2.0 * step;
    let mut exceeding = 0;
    for surface in [shapes::grid(12, 12).unwrap(), shapes::grid(7, 6).unwrap(), shapes::torus(9, 7, 0.3).unwrap()] {
        let mut cut = 0;
        for seed in 0..40 {
            let mut random = Random::new(seed);
            let heights: Vec<f64> =
                (0..surface.vertex_count()).map(|_| 1.0 + step * (4.0 * random.uniform()).floor()).collect();
            let pairs = persistence(&surface, &heights).unwrap().pairs;
            cut += usize::from(pairs.iter().any(|pair| pair.persistence == threshold));
            let simple = simplify(&surface, &heights, Keep::Above(Threshold::Absolute(threshold))).unwrap();
            assert_eq!(extrema(&surface, &simple), above(&surface, &heights, threshold), "seed {seed}");
            exceeding += usize::from(largest_change(&heights, &simple) > threshold);
        }
        assert!(cut > 10, "{cut} fields have such pairs");
    }
    // Where runs of equal height end beside each other, a double or so may be missing; without the lower start one in two exceeds.
    assert!(exceeding <= 6, "{exceeding} of 120 exceed the threshold");
}

#[test]
fn a_smooth_field_is_left_alone() {
    let torus = shapes::torus(60, 40, 0.0).unwrap();
    let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
    let keep = Keep::Above(Threshold::Relative(0.05));
    assert_eq!(simplify(&torus, &height, keep).unwrap(), height);
}

#[test]
fn ties_are_untied() {
    let grid = shapes::grid(30, 30).unwrap();
    let simple = simplify(&grid, &vec![1.0; 900], Keep::Above(Threshold::Relative(0.0))).unwrap();
    assert_eq!(extrema(&grid, &simple), BTreeSet::from([(0, CriticalKind::Minimum), (899, CriticalKind::Maximum)]));
    // A few steps in all.
    assert!(simple.iter().all(|&v| (v - 1.0).abs() < 900.0 * f64::EPSILON));
}

#[test]
fn large_plateaus_take_linear_time() {
    // With ids in any order the tilt needs very many steps: counted one by one for every vertex they would take hours.
    let grid = random_surface(5, &shapes::grid(400, 400).unwrap(), 0.0);
    for keep in [Keep::Above(Threshold::Relative(0.1)), Keep::Above(Threshold::Absolute(0.0))] {
        let simple = simplify(&grid, &vec![3.0; 160_000], keep).unwrap();
        assert_eq!(extrema(&grid, &simple).len(), 2);
    }
    let two: Vec<f64> = noise(160_000, 7).iter().map(|v| v.signum()).collect();
    let simple = simplify(&grid, &two, Keep::Above(Threshold::Absolute(2.0))).unwrap();
    assert_eq!(extrema(&grid, &simple).len(), 2);
}

#[test]
fn the_ends_of_double_precision() {
    let grid = shapes::grid(6, 6).unwrap();
    let values: Vec<f64> = noise(36, 2).iter().map(|v| if *v < 0.0 { 0.0 } else { f64::MAX }).collect();
    match simplify(&grid, &values, Keep::Above(Threshold::Relative(1.0))) {
        Ok(simple) => assert_eq!(extrema(&grid, &simple).len(), 2),
        Err(error) => assert_eq!(error.code(), "RangeOverflow"),
    }
    let tiny: Vec<f64> = noise(36, 3).iter().map(|v| if *v < 0.0 { -f64::from_bits(1) } else { -0.0 }).collect();
    let simple = simplify(&grid, &tiny, Keep::Above(Threshold::Relative(1.0))).unwrap();
    assert_eq!(extrema(&grid, &simple).len(), 2);
}

#[test]
fn sheets_that_hang_together_in_a_vertex_may_have_no_room() {
    // The second tetrahedron is as good as flat, but one of its vertices must be its highest or its lowest.
    let pinched = two_tetrahedra_at_a_vertex();
    let values = [0.0, -9.0, 9.0, 5.0, 0.1, 0.1, 0.2];
    let simplified = |mesh: &TriMesh, values: &[f64], keep| {
        let Simplified { values, unavoidable } =
            field::simplify(&ScalarField::new(mesh, values).unwrap(), keep, &Watch::none()).unwrap();
        let found: Vec<u32> = extrema(mesh, &values).into_iter().map(|(v, _)| v).collect();
        (unavoidable, found)
    };
    let keep = Keep::Above(Threshold::Absolute(1.0));
    assert_eq!(simplified(&pinched, &values, keep), (vec![6], vec![1, 2, 6]));
    let triangles = bow_tie();
    let (unavoidable, found) = simplified(&triangles, &[0.0, -9.0, 9.0, 0.1, 0.1], keep);
    assert_eq!((unavoidable.len(), found.len()), (1, 3));
    // The highest of the first triangle is to go, but the vertex that both share is the lowest of all.
    let keep = Keep::Above(Threshold::Relative(0.7));
    assert_eq!(simplified(&triangles, &[0.0, 2.0, 3.0, 5.0, 4.0], keep), (vec![2], vec![0, 2, 3]));
}

#[test]
fn bad_input_is_refused() {
    let torus = shapes::torus(12, 8, 0.0).unwrap();
    let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
    let above = |threshold| Keep::Above(Threshold::Relative(threshold));
    let code = |values: &[f64], keep: Keep<'_>| simplify(&torus, values, keep).unwrap_err().code();
    for threshold in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(code(&height, above(threshold)), "InvalidOption");
    }
    assert_eq!(code(&height[1..], above(0.1)), "LengthMismatch");
    let mut holes = height.clone();
    holes[5] = f64::INFINITY;
    assert_eq!(code(&holes, above(0.1)), "NonFiniteValue");
    assert_eq!(code(&height, Keep::Extrema(&[96])), "IndexOutOfBounds");
    let diagram = persistence(&torus, &height).unwrap();
    let (low, high) = (diagram.essential_minima[0], diagram.essential_maxima[0]);
    assert_eq!(code(&height, Keep::Extrema(&[low, diagram.essential_saddles[0]])), "NotAnExtremum");
    assert_eq!(code(&height, Keep::Extrema(&[low])), "Unconstrained");
    assert_eq!(code(&height, Keep::Extrema(&[high])), "Unconstrained");
    assert_eq!(code(&height, Keep::Extrema(&[])), "Unconstrained");
    let islands = islands();
    let values = noise(islands.vertex_count(), 1);
    let diagram = persistence(&islands, &values).unwrap();
    let first = [diagram.essential_minima[0], diagram.essential_maxima[0]];
    let error = simplify(&islands, &values, Keep::Extrema(&first)).unwrap_err();
    assert_eq!(error.code(), "Unconstrained");
    assert!(error.to_string().contains("component 1"), "{error}");
}

/// The least number of further extrema that any order of the vertices has in which the kept ones are extrema of their kind: all
/// orders are tried.
fn fewest_further_extrema(mesh: &TriMesh, kept: &BTreeMap<u32, CriticalKind>) -> usize {
    let connectivity = mesh.connectivity();
    let n = mesh.vertex_count();
    let neighbours: Vec<BTreeSet<usize>> =
        (0..n as u32).map(|v| connectivity.link(v).flatten().map(|w| w as usize).collect()).collect();
    let mut ranks: Vec<usize> = (0..n).collect();
    let mut least = usize::MAX;
    let mut try_one = |ranks: &[usize]| {
        let mut further = 0;
        for v in 0..n {
            if neighbours[v].is_empty() {
                continue;
            }
            let below = neighbours[v].iter().filter(|&&w| ranks[w] < ranks[v]).count();
            let kind = match below {
                0 => Some(CriticalKind::Minimum),
                all if all == neighbours[v].len() => Some(CriticalKind::Maximum),
                _ => None,
            };
            match (kept.get(&(v as u32)), kind) {
                (Some(&wanted), found) if found != Some(wanted) => return,
                (None, Some(_)) => further += 1,
                _ => {}
            }
        }
        least = least.min(further);
    };
    // Heap's algorithm.
    try_one(&ranks);
    let mut counters = vec![0; n];
    let mut i = 0;
    while i < n {
        if counters[i] < i {
            ranks.swap(if i.is_multiple_of(2) { 0 } else { counters[i] }, i);
            try_one(&ranks);
            counters[i] += 1;
            i = 0;
        } else {
            counters[i] = 0;
            i += 1;
        }
    }
    least
}

/// Small complexes in which much hangs together in single vertices.
fn small_complexes() -> Vec<TriMesh> {
    let mut meshes = vec![bow_tie()];
    for seed in 0..120 {
        meshes.push(random_complex(seed, 5 + seed as u32 % 3, 2 + seed as usize % 4));
    }
    // Triangles that share one vertex with what is there, or two.
    for seed in 0..120_u64 {
        let mut random = Random::new(seed);
        let mut triangles = vec![[0, 1, 2]];
        let mut count = 3;
        while count < 7 {
            let a = (random.uniform() * f64::from(count)) as u32;
            let b = (random.uniform() * f64::from(count)) as u32;
            if count < 6 && (a == b || random.uniform() < 0.6) {
                triangles.push([a, count, count + 1]);
                count += 2;
            } else if a != b {
                triangles.push([a, b, count]);
                count += 1;
            }
        }
        meshes.push(complex(count, &triangles));
    }
    meshes
}

#[test]
fn what_is_unavoidable_is_found_by_trying_all_orders() {
    let mut unavoidable_ones = 0;
    for (k, mesh) in small_complexes().iter().enumerate() {
        let n = mesh.vertex_count();
        for seed in 0..3 {
            let values = if seed == 2 { tied(n, k as u64, 2.0) } else { noise(n, k as u64 * 5 + seed) };
            let all: Vec<(u32, CriticalKind)> = extrema(mesh, &values).into_iter().collect();
            let diagram = persistence(mesh, &values).unwrap();
            let essential: Vec<u32> =
                diagram.essential_minima.iter().chain(&diagram.essential_maxima).copied().collect();
            let mut random = Random::new(k as u64 + seed);
            let mut keep = essential.clone();
            keep.extend(all.iter().map(|&(v, _)| v).filter(|_| random.uniform() < 0.3));
            // Others than the essential ones, where they are enough.
            let other: Vec<u32> = all.iter().map(|&(v, _)| v).filter(|_| random.uniform() < 0.5).collect();
            let field = ScalarField::new(mesh, &values).unwrap();
            for keep in [Keep::Extrema(&keep), Keep::Extrema(&other), Keep::Above(Threshold::Relative(0.4))] {
                let result = field::simplify(&field, keep, &Watch::none());
                let Simplified { values: simple, unavoidable } = match result {
                    Ok(simplified) => simplified,
                    Err(error) => {
                        assert_eq!(error.code(), "Unconstrained", "{k}: {error}");
                        continue;
                    }
                };
                let kept: BTreeMap<u32, CriticalKind> = match keep {
                    Keep::Extrema(vertices) => all.iter().copied().filter(|(v, _)| vertices.contains(v)).collect(),
                    _ => above(mesh, &values, 0.4 * field.range().length()).into_iter().collect(),
                };
                let mut expected: BTreeSet<u32> = kept.keys().copied().collect();
                expected.extend(&unavoidable);
                assert_eq!(expected.len(), kept.len() + unavoidable.len());
                let found: BTreeMap<u32, CriticalKind> = extrema(mesh, &simple).into_iter().collect();
                assert_eq!(found.keys().copied().collect::<BTreeSet<u32>>(), expected, "mesh {k}, seed {seed}");
                assert!(kept.iter().all(|(v, kind)| found[v] == *kind));
                assert_eq!(unavoidable.len(), fewest_further_extrema(mesh, &kept), "mesh {k}, seed {seed}, {keep:?}");
                unavoidable_ones += unavoidable.len();
            }
        }
    }
    assert!(unavoidable_ones > 100, "{unavoidable_ones}");
}
