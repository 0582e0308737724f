//! Feature points against brute force: the rules written out, and k-means against its definition and its optimum.

use std::collections::BTreeSet;

use morse_smooth::field::{DeltaOptions, DeltaScale, ExtremumRule, Features, LinkReading, Threshold, with_stars};
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::mesh::{LinkKind, TriMesh};

use crate::analyses::{critical_points, feature_points, persistence};
use crate::support::{complex, every_kind, islands, noise, random_complex, random_surface, shuffle, tied};

fn points(mesh: &TriMesh, f: &[f64], features: &Features<'_>) -> Vec<u32> {
    feature_points(mesh, f, features).expect("features")
}

fn k_means(mesh: &TriMesh, f: &[f64], clusters: usize, seed: u64) -> Vec<u32> {
    points(mesh, f, &Features::KMeans { clusters, seed })
}

fn code(mesh: &TriMesh, f: &[f64], features: &Features<'_>) -> &'static str {
    feature_points(mesh, f, features).expect_err("a refusal").code()
}

/// A strip of triangles, where only the number of vertices matters.
fn strip(vertices: u32) -> TriMesh {
    complex(vertices, &(2..vertices).map(|v| [v - 2, v - 1, v]).collect::<Vec<_>>())
}

/// Meshes of every kind and random ones, each with a rough field and one with ties.
fn fields() -> Vec<(TriMesh, Vec<f64>)> {
    let mut meshes: Vec<TriMesh> = every_kind().into_iter().map(|(_, mesh)| mesh).collect();
    for seed in 0..12 {
        meshes.push(random_complex(seed, 12, 20 + 4 * seed as usize));
        meshes.push(random_surface(seed, &shapes::torus(8, 7, 0.2).unwrap(), 0.05 * seed as f64));
    }
    let with = |mesh: TriMesh| {
        let n = mesh.vertex_count();
        [(mesh.clone(), noise(n, 3)), (mesh, tied(n, 4, 3.0))]
    };
    meshes.into_iter().flat_map(with).collect()
}

#[test]
fn named_vertices() {
    let mesh = islands();
    let f = noise(mesh.vertex_count(), 1);
    // 4 and 5 are isolated.
    assert_eq!(points(&mesh, &f, &Features::Vertices(&[9, 4, 0, 9, 5, 4])), [0, 4, 5, 9]);
    assert_eq!(points(&mesh, &f, &Features::Vertices(&[])), [0_u32; 0]);
    let all: Vec<u32> = (0..12).rev().collect();
    assert_eq!(points(&mesh, &f, &Features::Vertices(&all)), (0..12).collect::<Vec<u32>>());
    let error = feature_points(&mesh, &f, &Features::Vertices(&[3, 12, 40])).unwrap_err();
    assert_eq!(error.code(), "IndexOutOfBounds");
    assert!(error.to_string().contains("no vertex 12") && error.to_string().contains("12 vertices"), "{error}");
}

#[test]
fn critical_points_of_every_reading_are_nested() {
    for (mesh, f) in fields() {
        for (link, rule) in [
            (LinkReading::Consecutive, ExtremumRule::Strict),
            (LinkReading::Skip, ExtremumRule::Strict),
            (LinkReading::Consecutive, ExtremumRule::Literal),
        ] {
            for scale in [DeltaScale::Relative, DeltaScale::Absolute] {
                let mut before: Option<BTreeSet<u32>> = None;
                for delta in [0.0, 0.02, 0.1, 0.3, 0.7, 3.0] {
                    let options = DeltaOptions { delta, scale, link, rule };
                    let found = points(&mesh, &f, &Features::CriticalPoints(options));
                    let expected = critical_points(&mesh, &f, &options).unwrap().points;
                    assert_eq!(found, expected.iter().map(|p| p.vertex).collect::<Vec<_>>());
                    let found = BTreeSet::from_iter(found);
                    if rule == ExtremumRule::Strict {
                        assert!(before.is_none_or(|before| found.is_subset(&before)), "nested");
                        assert!(delta < 2.5 || found.is_empty(), "nothing is left");
                    }
                    before = Some(found);
                }
            }
        }
    }
}

#[test]
fn both_ends_of_persistent_pairs() {
    for (mesh, f) in fields() {
        let diagram = persistence(&mesh, &f).unwrap();
        let used = mesh.connectivity().triangles().as_flattened();
        let low = used.iter().map(|&v| f[v as usize]).fold(f64::INFINITY, f64::min);
        let high = used.iter().map(|&v| f[v as usize]).fold(f64::NEG_INFINITY, f64::max);
        // Those of pairs too: what is as persistent as the threshold is left out.
        let mut bounds = vec![0.0, 0.05, 0.5, 1.0, 1e300];
        bounds.extend(diagram.pairs.iter().map(|pair| pair.persistence));
        for bound in bounds {
            for threshold in [Threshold::Absolute(bound), Threshold::Relative(bound)] {
                let absolute = match threshold {
                    Threshold::Absolute(bound) => bound,
                    Threshold::Relative(part) => part * (high - low),
                };
                let mut expected = BTreeSet::new();
                for pair in &diagram.pairs {
                    if (f[pair.extremum as usize] - f[pair.saddle as usize]).abs() > absolute {
                        expected.extend([pair.extremum, pair.saddle]);
                    }
                }
                expected.extend(diagram.essential_minima.iter().chain(&diagram.essential_maxima));
                expected.extend(&diagram.essential_saddles);
                let found = points(&mesh, &f, &Features::Persistence(threshold));
                assert_eq!(found, expected.into_iter().collect::<Vec<_>>(), "{threshold:?}");
            }
        }
    }
}

#[test]
fn stars() {
    for (mesh, f) in fields() {
        let n = mesh.vertex_count() as u32;
        let critical = points(&mesh, &f, &Features::CriticalPoints(DeltaOptions::default()));
        let everything: Vec<u32> = (0..n).rev().chain(0..n).collect();
        for chosen in [&[], &[n - 1, 0, n - 1][..], &critical, &everything] {
            let mut expected: BTreeSet<u32> = chosen.iter().copied().collect();
            for triangle in mesh.connectivity().triangles() {
                if triangle.iter().any(|v| chosen.contains(v)) {
                    expected.extend(triangle);
                }
            }
            assert_eq!(with_stars(mesh.connectivity(), chosen), expected.into_iter().collect::<Vec<_>>());
        }
    }
}

/// Σ (f − mean)² of a cluster.
fn cost(cluster: &[f64]) -> f64 {
    let mean = mean(cluster);
    cluster.iter().map(|x| (x - mean) * (x - mean)).sum()
}

fn mean(cluster: &[f64]) -> f64 {
    cluster.iter().sum::<f64>() / cluster.len() as f64
}

/// The least sum of costs with `clusters` clusters, by dynamic programming over the sorted values.
fn optimum(sorted: &[f64], clusters: usize) -> f64 {
    let n = sorted.len();
    let mut best: Vec<f64> = (0..=n).map(|end| if end == 0 { 0.0 } else { cost(&sorted[..end]) }).collect();
    for _ in 1..clusters {
        let with_one_more = |end: usize| {
            let costs = (0..end).map(|start| best[start] + cost(&sorted[start..end]));
            costs.fold(best[end], f64::min)
        };
        best = (0..=n).map(with_one_more).collect();
    }
    best[n]
}

/// The least and the greatest cost of all partitions into intervals with these values as representatives that a step of Lloyd's
/// leaves as they are; none where there is no such partition.
fn costs_of_fixed_points(sorted: &[f64], representatives: &[f64]) -> Option<(f64, f64)> {
    const ROUNDING: f64 = 1e-12;
    let n = sorted.len();
    let is_cut = |i: usize| i == 0 || i == n || sorted[i - 1] < sorted[i];
    // Clusters that may be the j-th one, with the costs of what leads to them.
    let mut last: Vec<(usize, usize, f64, f64)> = Vec::new();
    for (j, &representative) in representatives.iter().enumerate() {
        let mut here = Vec::new();
        for start in 0..n {
            for end in start + 1..=n {
                let cluster = &sorted[start..end];
                let is_whole = is_cut(start) && is_cut(end) && (j > 0 || start == 0);
                if !is_whole || !cluster.contains(&representative) {
                    continue;
                }
                let mean = mean(cluster);
                let nearest = cluster.iter().map(|x| (x - mean).abs()).fold(f64::INFINITY, f64::min);
                if (representative - mean).abs() > nearest + ROUNDING {
                    continue;
                }
                let own = cost(cluster);
                if j == 0 {
                    here.push((start, end, own, own));
                }
                let mut both: Option<(f64, f64)> = None;
                for &(before, _, least, greatest) in last.iter().filter(|&&(_, other, ..)| other == start) {
                    let middle = (self::mean(&sorted[before..start]) + mean) / 2.0;
                    if sorted[start - 1] <= middle + ROUNDING && sorted[start] >= middle - ROUNDING {
                        let (a, b) = both.unwrap_or((f64::INFINITY, 0.0));
                        both = Some((a.min(least), b.max(greatest)));
                    }
                }
                if let Some((least, greatest)) = both {
                    here.push((start, end, least + own, greatest + own));
                }
            }
        }
        last = here;
    }
    let whole = last.iter().filter(|&&(_, end, ..)| end == n);
    whole.map(|&(_, _, a, b)| (a, b)).reduce(|x, y| (x.0.min(y.0), x.1.max(y.1)))
}

fn check_clusters(f: &[f64], clusters: usize, seed: u64) {
    let context = format!("{clusters} clusters of {} values, seed {seed}", f.len());
    let found = k_means(&strip(f.len() as u32), f, clusters, seed);
    let mut sorted = f.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut different = sorted.clone();
    different.dedup();
    assert_eq!(found.len(), clusters.min(different.len()), "{context}");
    for &v in &found {
        assert_eq!(f.iter().position(|&x| x == f[v as usize]), Some(v as usize), "{context}: the smallest id");
    }
    let mut representatives: Vec<f64> = found.iter().map(|&v| f[v as usize]).collect();
    representatives.sort_by(f64::total_cmp);
    let (least, greatest) = costs_of_fixed_points(&sorted, &representatives).unwrap_or_else(|| panic!("{context}"));
    let best = optimum(&sorted, clusters);
    assert!(least >= best - 1e-12, "{context}: {least} where {best} is the optimum");
    assert!(greatest <= 10.0 * best + 1e-12, "{context}: {greatest} where {best} is the optimum");
}

#[test]
fn clusters_are_a_fixed_point_near_the_optimum() {
    for trial in 0..120_u64 {
        let n = 3 + (trial % 28) as usize;
        let mut f = match trial % 4 {
            0 => tied(n, trial, 6.0),
            1 => noise(n, trial),
            // Dense at one end, and in few heaps.
            2 => noise(n, trial).iter().map(|x| x * x * x * x).collect(),
            _ => tied(n, trial, 2.0).iter().zip(noise(n, trial + 1)).map(|(x, y)| x + 0.05 * y).collect(),
        };
        shuffle(&mut f, &mut Random::new(trial));
        for clusters in [1, 2, 3, 5, n / 2, n - 1, n] {
            check_clusters(&f, clusters.max(1), trial);
        }
    }
}

/// Whole numbers in `sizes.len()` heaps that are far from each other, in random order, and for each heap the smallest id of
/// those nearest to its mean.
fn heaps(sizes: &[u32], seed: u64) -> (Vec<f64>, Vec<u32>) {
    let mut random = Random::new(seed);
    let mut f: Vec<(usize, i64)> = Vec::new();
    for (heap, &size) in sizes.iter().enumerate() {
        f.extend((0..size).map(|_| (heap, 1000 * heap as i64 + (6.0 * random.uniform()) as i64)));
    }
    shuffle(&mut f, &mut random);
    let mut expected = Vec::new();
    for (heap, &size) in sizes.iter().enumerate() {
        let sum: i64 = f.iter().filter(|(other, _)| *other == heap).map(|&(_, x)| x).sum();
        let of_heap = (0..f.len()).filter(|&v| f[v].0 == heap);
        let nearest = of_heap.min_by_key(|&v| ((f[v].1 * i64::from(size) - sum).abs(), v));
        expected.push(nearest.unwrap() as u32);
    }
    expected.sort_unstable();
    (f.iter().map(|&(_, x)| x as f64).collect(), expected)
}

#[test]
fn heaps_far_apart_are_found_from_every_seed() {
    for sizes in [&[4, 4][..], &[30, 2, 9], &[1, 50, 1, 1, 20, 7, 3], &[5; 12]] {
        let (f, expected) = heaps(sizes, sizes.len() as u64);
        let mesh = strip(f.len() as u32);
        for seed in (0..100).chain([u64::MAX]) {
            assert_eq!(k_means(&mesh, &f, sizes.len(), seed), expected, "{sizes:?}, seed {seed}");
        }
    }
}

#[test]
fn clusters_do_not_depend_on_unit_and_offset() {
    let (f, expected) = heaps(&[30, 2, 9, 14, 1, 6], 5);
    let mesh = strip(f.len() as u32);
    let power = |exponent: i32| 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2);
    for clusters in 1..60 {
        let plain = k_means(&mesh, &f, clusters, 3);
        assert_eq!(plain, k_means(&mesh, &f, clusters, 3), "the same again");
        if clusters == 6 {
            assert_eq!(plain, expected);
        }
        for offset in [1e12, -1e12, 4e15, -2500.0] {
            let moved: Vec<f64> = f.iter().map(|x| x + offset).collect();
            assert_eq!(k_means(&mesh, &moved, clusters, 3), plain, "{clusters} clusters, offset {offset}");
        }
        // Down to the least of all numbers, and up to the range of doubles.
        for exponent in [-1074, -1060, -1022, -300, 300, 1000, 1010] {
            let scaled: Vec<f64> = f.iter().map(|x| x * power(exponent)).collect();
            assert_eq!(k_means(&mesh, &scaled, clusters, 3), plain, "{clusters} clusters, 2^{exponent}");
        }
    }
}

#[test]
fn as_many_clusters_as_values() {
    let mesh = strip(9);
    let f = [2.0, -0.0, 2.0, 0.0, 5.0, 5.0, -1.0, 0.0, 2.0];
    for clusters in [4, 5, 9, 10, u32::MAX as usize, usize::MAX] {
        assert_eq!(k_means(&mesh, &f, clusters, 8), [0, 1, 4, 6]);
    }
    // 0 and −1 are nearest to each other, and there are three of the former.
    assert_eq!(k_means(&mesh, &f, 3, 8), [0, 1, 4]);
    // Values that the sums do not tell apart are values all the same.
    let near = [0.0, 1e-300, 2e-300, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    assert_eq!(k_means(&mesh, &near, 4, 8), [0, 1, 2, 3]);
    assert_eq!(k_means(&mesh, &near, 3, 8), [0, 3]);
    for seed in 0..20 {
        let constant = [7.5; 9];
        let two = [1.0, 1e-9, 1.0, 1.0, 1e-9, 1.0, 1.0, 1.0, 1.0];
        for clusters in [1, 2, 3, 100] {
            assert_eq!(k_means(&mesh, &constant, clusters, seed), [0]);
        }
        assert_eq!(k_means(&mesh, &two, 1, seed), [0]);
        assert_eq!(k_means(&mesh, &two, 2, seed), [0, 1]);
        assert_eq!(k_means(&mesh, &two, 3, seed), [0, 1]);
    }
}

#[test]
fn isolated_vertices_are_in_no_cluster() {
    let mesh = islands();
    let mut f = noise(mesh.vertex_count(), 6);
    for clusters in 1..14 {
        (f[4], f[5]) = (0.0, 0.0);
        let plain = k_means(&mesh, &f, clusters, 1);
        (f[4], f[5]) = (1e300, -1e300);
        assert_eq!(k_means(&mesh, &f, clusters, 1), plain);
        assert_eq!(plain.len(), clusters.min(10));
        let kinds = mesh.connectivity().link_kinds();
        assert!(plain.iter().all(|&v| kinds[v as usize] != LinkKind::Isolated));
    }
    for (mesh, f) in fields() {
        let used: BTreeSet<u32> = mesh.connectivity().triangles().as_flattened().iter().copied().collect();
        let different: BTreeSet<i64> = used.iter().map(|&v| (f[v as usize] * 1e15) as i64).collect();
        for clusters in [1, 2, 5, 20, 1000] {
            let found = k_means(&mesh, &f, clusters, 9);
            assert!(found.is_sorted_by(|a, b| a < b) && found.iter().all(|v| used.contains(v)));
            assert_eq!(found.len(), clusters.min(different.len()));
        }
    }
}

/// Evenly spread values have evenly spread clusters: for w values in each, w even, Σ (f − that of the representative)² is
/// (w³ + 2w)/12 and no less.
#[test]
fn thousands_of_clusters() {
    let mesh = strip(60_000);
    let mut f: Vec<f64> = (0..60_000).map(|i| 1e6 + f64::from(i)).collect();
    shuffle(&mut f, &mut Random::new(2));
    let total = |clusters: usize| {
        let found = k_means(&mesh, &f, clusters, 4);
        assert_eq!(found.len(), clusters);
        let mut places: Vec<f64> = found.iter().map(|&v| f[v as usize]).collect();
        places.sort_by(f64::total_cmp);
        let nearest = |x: f64| {
            let after = places.partition_point(|&place| place < x);
            let beside = [after.saturating_sub(1), after.min(clusters - 1)];
            beside.map(|i| (places[i] - x).abs()).into_iter().fold(f64::INFINITY, f64::min)
        };
        f.iter().map(|&x| nearest(x) * nearest(x)).sum::<f64>()
    };
    for clusters in [10, 300, 3000, 30_000] {
        let width = 60_000.0 / clusters as f64;
        let ratio = total(clusters) / (clusters as f64 * (width * width * width + 2.0 * width) / 12.0);
        assert!((0.999_999..1.15).contains(&ratio), "{clusters} clusters: {ratio} of the least");
    }
    assert_eq!(total(59_999), 1.0);
}

#[test]
fn refusals() {
    let mesh = shapes::octahedron().unwrap();
    let f = noise(6, 1);
    let clusters = |clusters| Features::KMeans { clusters, seed: 0 };
    let delta = |delta| Features::CriticalPoints(DeltaOptions { delta, ..DeltaOptions::default() });
    for features in [
        Features::Vertices(&[1]),
        delta(0.1),
        Features::Persistence(Threshold::Relative(0.1)),
        clusters(2),
        // What is wrong with the values is said first.
        clusters(0),
    ] {
        assert_eq!(code(&mesh, &f[1..], &features), "LengthMismatch");
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut broken = f.clone();
            broken[3] = wrong;
            assert_eq!(code(&mesh, &broken, &features), "NonFiniteValue");
        }
        let mut far = f.clone();
        (far[0], far[1]) = (f64::MAX, -f64::MAX);
        assert_eq!(code(&mesh, &far, &features), "RangeOverflow");
    }
    for wrong in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(code(&mesh, &f, &delta(wrong)), "InvalidOption");
        assert_eq!(code(&mesh, &f, &Features::Persistence(Threshold::Relative(wrong))), "InvalidOption");
        assert_eq!(code(&mesh, &f, &Features::Persistence(Threshold::Absolute(wrong))), "InvalidOption");
    }
    let error = feature_points(&mesh, &f, &clusters(0)).unwrap_err();
    assert_eq!(error.code(), "InvalidOption");
    assert!(error.to_string().contains("`clusters`"), "{error}");
    assert_eq!(code(&mesh, &f, &Features::Vertices(&[6])), "IndexOutOfBounds");
}
