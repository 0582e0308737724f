//! Nested dissection: a permutation of whatever it is given, with little fill.

use morse_smooth::Watch;
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::operators::uniform_laplacian;
use morse_smooth::solve::{CholeskyAnalysis, Permutation, gram, minimum_degree, nested_dissection, submatrix};
use nalgebra_sparse::pattern::SparsityPattern;
use proptest::prelude::*;

/// The symmetric pattern of the pairs, without a diagonal.
fn pattern(n: usize, pairs: impl IntoIterator<Item = (usize, usize)>) -> SparsityPattern {
    let mut lanes: Vec<Vec<usize>> = vec![Vec::new(); n];
    for (i, j) in pairs {
        if i != j {
            lanes[i].push(j);
            lanes[j].push(i);
        }
    }
    let mut offsets = vec![0];
    let mut indices = Vec::new();
    for lane in &mut lanes {
        lane.sort_unstable();
        lane.dedup();
        indices.append(lane);
        offsets.push(indices.len());
    }
    SparsityPattern::try_from_offsets_and_indices(n, n, offsets, indices).unwrap()
}

/// Checks that an order leaves at most that many hundredths of the fill of minimum degree.
fn assert_fill(graph: &SparsityPattern, order: &[u32], hundredths: u64) {
    let (entries, other) = (fill(graph, order), fill(graph, &minimum_degree(graph, &Watch::none()).unwrap()));
    assert!(entries * 100 <= other * hundredths, "{entries} entries, {other} by minimum degree");
}

/// Entries of the factor; counts them by itself, because a large graph is not to be factorised.
fn fill(pattern: &SparsityPattern, order: &[u32]) -> u64 {
    let n = order.len();
    let permutation = Permutation::new(order.to_vec()).expect("a permutation");
    let (mut parent, mut mark) = (vec![usize::MAX; n], vec![usize::MAX; n]);
    let mut entries = n as u64;
    for (new, &old) in order.iter().enumerate() {
        mark[new] = new;
        for &other in pattern.lane(old as usize) {
            let mut v = permutation.old_to_new()[other] as usize;
            while v < new && mark[v] != new {
                if parent[v] == usize::MAX {
                    parent[v] = new;
                }
                mark[v] = new;
                entries += 1;
                v = parent[v];
            }
        }
    }
    entries
}

/// Orders a pattern, and checks that nothing is missing.
fn ordered(pattern: &SparsityPattern) -> Vec<u32> {
    let order = nested_dissection(pattern, &Watch::none()).unwrap();
    assert_eq!(order.len(), pattern.major_dim());
    assert!(Permutation::new(order.clone()).is_ok());
    order
}

/// The graph of the Laplacian and that of its square.
fn graphs(mesh: &TriMesh) -> [SparsityPattern; 2] {
    let laplacian = uniform_laplacian(mesh).unwrap();
    [laplacian.pattern().clone(), gram(&laplacian, &Watch::none()).unwrap().pattern().clone()]
}

#[test]
fn tiny_and_trivial_patterns() {
    assert!(ordered(&pattern(0, [])).is_empty());
    assert_eq!(ordered(&pattern(1, [])), [0]);
    assert_eq!(fill(&pattern(5, []), &ordered(&pattern(5, []))), 5);
    for n in [2, 3, 17, 119, 120, 121, 130, 500, 700] {
        let dense = pattern(n, (0..n).flat_map(|i| (0..i).map(move |j| (i, j))));
        assert_eq!(fill(&dense, &ordered(&dense)), (n * (n + 1) / 2) as u64);
    }
}

#[test]
fn many_components() {
    let n = 50_000;
    assert_eq!(fill(&pattern(n, []), &ordered(&pattern(n, []))), n as u64);
    // Thousands of triangles, and of them some in one larger piece.
    let triangles =
        pattern(3 * n, (0..n).flat_map(|i| [(3 * i, 3 * i + 1), (3 * i + 1, 3 * i + 2), (3 * i, 3 * i + 2)]));
    assert_eq!(fill(&triangles, &ordered(&triangles)), 6 * n as u64);
    let chained = pattern(n, (0..n / 2).filter(|i| i % 1000 != 0).map(|i| (i, i + 1)));
    assert!(fill(&chained, &ordered(&chained)) < 4 * n as u64);
}

#[test]
fn paths_and_stars_of_any_numbering() {
    let n = 200_000;
    let path = pattern(n, (1..n).map(|i| (i - 1, i)));
    // Without fill, a path's factor has 2n − 1 entries; separators of a dissection add one entry or two each.
    assert!(fill(&path, &ordered(&path)) < 3 * n as u64);
    let scattered = pattern(n, (1..n).map(|i| ((i - 1) * 77_773 % n, i * 77_773 % n)));
    assert!(fill(&scattered, &ordered(&scattered)) < 3 * n as u64);
    let star = pattern(n, (0..n).map(|i| (i, n / 2)));
    assert_eq!(fill(&star, &ordered(&star)), 2 * n as u64 - 1);
    // Hubs too small to count as dense rows.
    let hubs = pattern(n, (0..n).map(|i| (i, i / 1000 * 1000)).chain((1..200).map(|h| (1000 * h - 1000, 1000 * h))));
    assert!(fill(&hubs, &ordered(&hubs)) < 3 * n as u64);
    // A balanced binary tree.
    let tree = pattern(n, (1..n).map(|i| (i, (i - 1) / 2)));
    assert!(fill(&tree, &ordered(&tree)) < 3 * n as u64);
}

#[test]
fn arrows_and_dense_rows() {
    for (n, rows) in [(300, 2), (20_000, 3), (100_000, 1)] {
        let arrow = pattern(n, (0..rows).flat_map(|r| (0..n).map(move |i| (r * 7, i))));
        let bound = ((rows + 1) * n) as u64;
        assert!(fill(&arrow, &ordered(&arrow)) <= bound);
    }
    // Dense rows on top of a path.
    let n = 50_000;
    let bordered =
        pattern(n, (1..n).map(|i| (i - 1, i)).chain((0..4).flat_map(|r| (0..n).map(move |i| (1000 * r, i)))));
    assert!(fill(&bordered, &ordered(&bordered)) < 8 * n as u64);
}

#[test]
fn strips_and_poles() {
    for graph in graphs(&shapes::grid(3, 50_000).unwrap()) {
        assert_fill(&graph, &ordered(&graph), 200);
    }
    for graph in graphs(&shapes::irregular_sphere(12, 1440, 5).unwrap()) {
        assert_fill(&graph, &ordered(&graph), 110);
    }
}

#[test]
fn graphs_that_are_no_meshes() {
    let mut random = Random::new(11);
    let mut at = |n: usize| (random.uniform() * n as f64) as usize;
    // Sparse random graphs have no small separators.
    for (n, edges) in [(3000, 2000), (3000, 9000), (1000, 40_000)] {
        let pairs: Vec<_> = (0..edges).map(|_| (at(n), at(n))).collect();
        let graph = pattern(n, pairs);
        assert_fill(&graph, &ordered(&graph), 130);
    }
    // Points in a cube, each with some of its neighbours in a box of the grid.
    let n: usize = 18;
    let id = |x: usize, y: usize, z: usize| (x * n + y) * n + z;
    let mut pairs = Vec::new();
    for (x, y, z) in (0..n * n * n).map(|i| (i / n / n, i / n % n, i % n)) {
        for _ in 0..4 {
            let near = |c: usize, step: usize| (c + step).saturating_sub(1).min(n - 1);
            pairs.push((id(x, y, z), id(near(x, at(3)), near(y, at(3)), near(z, at(3)))));
        }
    }
    let graph = pattern(n * n * n, pairs);
    assert_fill(&graph, &ordered(&graph), 110);
}

#[test]
fn less_fill_than_minimum_degree_on_meshes() {
    let small = [
        shapes::torus(126, 79, 0.3).unwrap(),
        shapes::trefoil_tube(400, 25, 0.3).unwrap(),
        shapes::irregular_sphere(100, 100, 7).unwrap(),
        shapes::terrain(100, 100, 3).unwrap(),
        shapes::sphere(5).unwrap(),
        shapes::moebius(300, 30).unwrap(),
    ];
    for mesh in &small {
        for graph in graphs(mesh) {
            assert_fill(&graph, &ordered(&graph), 110);
        }
    }
    for mesh in [shapes::torus(250, 160, 0.3).unwrap(), shapes::irregular_sphere(200, 200, 7).unwrap()] {
        for graph in graphs(&mesh) {
            assert_fill(&graph, &ordered(&graph), 100);
        }
    }
}

#[test]
fn the_numbering_of_a_mesh_matters_little() {
    let mesh = shapes::torus(150, 100, 0.3).unwrap();
    let [graph, _] = graphs(&mesh);
    let n = graph.major_dim();
    let shuffled: Vec<usize> = (0..n).map(|i| i * 7919 % n).collect();
    let pairs = (0..n).flat_map(|v| graph.lane(v).iter().map(|&u| (shuffled[v], shuffled[u])).collect::<Vec<_>>());
    let renumbered = pattern(n, pairs);
    let (a, b) = (fill(&graph, &ordered(&graph)), fill(&renumbered, &ordered(&renumbered)));
    assert!(a * 10 < b * 11 && b * 10 < a * 11, "{a} {b}");
}

#[test]
fn holes_do_not_matter() {
    let mesh = shapes::torus(150, 100, 0.3).unwrap();
    let laplacian = uniform_laplacian(&mesh).unwrap();
    let kept: Vec<u32> = (0..15_000).filter(|v| v % 1013 > 40).collect();
    let part = submatrix(&laplacian, &kept);
    let order = ordered(part.pattern());
    assert_fill(part.pattern(), &order, 110);
    // The solver accepts it, and counts the same.
    let permutation = Permutation::new(order.clone()).unwrap();
    let analysis = CholeskyAnalysis::with_permutation(part.pattern().clone(), &permutation, &Watch::none()).unwrap();
    assert_eq!(analysis.size().nonzeros, fill(part.pattern(), &order));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn always_a_permutation(n in 1_usize..1500, density in 0_usize..6, band in 1_usize..1500, seed: u64) {
        let mut random = Random::new(seed);
        let pairs: Vec<_> = (0..n * density)
            .map(|_| {
                let i = (random.uniform() * n as f64) as usize;
                (i, (i + (random.uniform() * band as f64) as usize) % n)
            })
            .collect();
        let graph = pattern(n, pairs);
        let order = ordered(&graph);
        prop_assert_eq!(&order, &nested_dissection(&graph, &Watch::none()).unwrap());
    }
}
