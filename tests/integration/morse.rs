//! The Morse complex: its lines, and its hierarchy against the fields that simplification makes.

use std::collections::{BTreeMap, BTreeSet};

use morse_smooth::field::{CriticalKind, DeltaOptions, Keep, MorseComplex, PathStyle, Threshold, value_range};
use morse_smooth::mesh::{TriMesh, shapes};
use proptest::prelude::*;

use crate::analyses::{basins, critical_points, morse_complex, morse_hierarchy, persistence, simplify};
use crate::support::{
    complex as complex_of, every_kind, islands, link_components, links, noise, random_complex, random_surface, tied,
};

fn is_below(values: &[f64], a: u32, b: u32) -> bool {
    (values[a as usize], a) < (values[b as usize], b)
}

fn lines(complex: &MorseComplex) -> Vec<&[u32]> {
    complex.offsets.windows(2).map(|w| &complex.vertices[w[0] as usize..w[1] as usize]).collect()
}

fn edges_of(complex: &MorseComplex) -> BTreeSet<(CriticalKind, [u32; 2])> {
    let mut edges = BTreeSet::new();
    for (line, &kind) in lines(complex).iter().zip(&complex.kinds) {
        edges.extend(line.windows(2).map(|e| (kind, [e[0].min(e[1]), e[0].max(e[1])])));
    }
    edges
}

/// The next vertex of a steepest path, from the definition.
fn steepest(mesh: &TriMesh, values: &[f64], v: u32, among: &[u32], down: bool) -> Option<u32> {
    let slope = |j: u32| {
        let (p, q) = (mesh.position(v), mesh.position(j));
        let length = (0..3).map(|i| (p[i] - q[i]).powi(2)).sum::<f64>().sqrt();
        (values[v as usize] - values[j as usize]).abs() / length
    };
    let farther = |a: u32, b: u32| is_below(values, a, b) == down;
    among.iter().copied().filter(|&j| is_below(values, j, v) == down).reduce(|best, j| {
        let (x, y) = (slope(j), slope(best));
        if x > y || (x == y && farther(j, best)) { j } else { best }
    })
}

fn check_lines(name: &str, mesh: &TriMesh, values: &[f64]) {
    let complex = morse_complex(mesh, values, Threshold::Relative(0.0), PathStyle::Whole).expect("a field");
    let links = links(mesh.vertex_count(), mesh.connectivity().triangles());
    let around: Vec<Vec<u32>> = links.iter().map(|link| link.keys().copied().collect()).collect();
    let mut expected: BTreeMap<(u32, bool), usize> = BTreeMap::new();
    for v in 0..mesh.vertex_count() as u32 {
        let parts =
            [true, false].map(|down| link_components(&links[v as usize], |j| is_below(values, j, v) == down).len());
        if parts[0].max(parts[1]) > 1 {
            for (down, parts) in [true, false].into_iter().zip(parts) {
                if parts > 0 {
                    expected.insert((v, down), parts);
                }
            }
        }
    }
    let mut found: BTreeMap<(u32, bool), usize> = BTreeMap::new();
    for (k, line) in lines(&complex).into_iter().enumerate() {
        let down = complex.kinds[k] == CriticalKind::Minimum;
        *found.entry((line[0], down)).or_default() += 1;
        assert_eq!(complex.saddles[k], line[0], "{name}");
        let last = *line.last().expect("a line");
        assert_eq!(complex.extrema[k], last, "{name}");
        assert_eq!(steepest(mesh, values, last, &around[last as usize], down), None, "{name}: ends at an extremum");
        let link = &links[line[0] as usize];
        let part = link_components(link, |j| is_below(values, j, line[0]) == down)
            .into_iter()
            .find(|part| part.contains(&line[1]))
            .expect("a part of the link");
        assert_eq!(steepest(mesh, values, line[0], &part, down), Some(line[1]), "{name}: first step");
        for step in line.windows(2).skip(1) {
            assert_eq!(steepest(mesh, values, step[0], &around[step[0] as usize], down), Some(step[1]), "{name}");
        }
    }
    assert_eq!(found, expected, "{name}: one line for each part of a link");
    let merged = morse_complex(mesh, values, Threshold::Relative(0.0), PathStyle::Merged).expect("a field");
    assert_eq!(edges_of(&merged), edges_of(&complex), "{name}: merged");
    let drawn: usize = lines(&merged).iter().map(|line| line.len() - 1).sum();
    assert_eq!((&merged.saddles, &merged.extrema), (&complex.saddles, &complex.extrema), "{name}: merged");
    assert!(drawn <= edges_of(&merged).len() + merged.saddles.len(), "{name}: nothing twice");
}

fn is_surface(mesh: &TriMesh) -> bool {
    mesh.topology().unwrap().non_manifold_vertices == 0 && mesh.topology().unwrap().non_manifold_edges == 0
}

fn kinds(nodes: impl Iterator<Item = (CriticalKind, u32)>) -> BTreeMap<CriticalKind, Vec<u32>> {
    let mut kinds: BTreeMap<CriticalKind, Vec<u32>> = BTreeMap::new();
    for (kind, vertex) in nodes {
        kinds.entry(kind).or_default().push(vertex);
    }
    kinds
}

/// The hierarchy at thresholds: nodes by the pairs and by simplification, arcs by the lines.
fn check_hierarchy(name: &str, mesh: &TriMesh, values: &[f64]) {
    let hierarchy = morse_hierarchy(mesh, values).expect("a field");
    let range = value_range(mesh.connectivity(), values).unwrap().length();
    for (i, node) in hierarchy.nodes.iter().enumerate() {
        let partner = &hierarchy.nodes[node.partner as usize];
        if node.cancelled_at.is_finite() && is_surface(mesh) && mesh.topology().unwrap().closed {
            assert_eq!(partner.partner as usize, i, "{name}: a pair");
            assert_eq!(partner.cancelled_at, node.cancelled_at, "{name}");
        }
        if node.kind != CriticalKind::Saddle && node.cancelled_at.is_finite() {
            let into = &hierarchy.nodes[node.into as usize];
            assert_eq!(into.kind, node.kind, "{name}");
            assert!(into.cancelled_at >= node.cancelled_at, "{name}: taken over by one that stays longer");
        } else {
            assert_eq!(node.into as usize, i, "{name}");
        }
    }
    let diagram = persistence(mesh, values).unwrap();
    for relative in [0.0, 1e-9, 0.05, 0.2, 0.6, 1.0] {
        let threshold = relative * range;
        let alive = (0..hierarchy.nodes.len() as u32).filter(|&i| hierarchy.is_alive(i, threshold));
        let alive = kinds(alive.map(|i| hierarchy.nodes[i as usize]).map(|node| (node.kind, node.vertex)));
        let count = |kind| alive.get(&kind).map_or(0, Vec::len);
        let extrema = |kind| {
            let essential = match kind {
                CriticalKind::Minimum => &diagram.essential_minima,
                _ => &diagram.essential_maxima,
            };
            let kept =
                diagram.pairs.iter().filter(|p| p.kind == kind && (threshold <= 0.0 || p.persistence > threshold));
            let mut kept: Vec<u32> = kept.map(|p| p.extremum).chain(essential.iter().copied()).collect();
            kept.sort_unstable();
            kept
        };
        for kind in [CriticalKind::Minimum, CriticalKind::Maximum] {
            assert_eq!(alive.get(&kind), Some(&extrema(kind)), "{name} at {relative}");
        }
        if mesh.topology().unwrap().closed && is_surface(mesh) {
            let counts = if threshold > 0.0 {
                let keep = Keep::Above(Threshold::Absolute(threshold));
                let simple = simplify(mesh, values, keep).expect("a surface");
                critical_points(mesh, &simple, &DeltaOptions::default()).unwrap().counts
            } else {
                critical_points(mesh, values, &DeltaOptions::default()).unwrap().counts
            };
            assert_eq!(count(CriticalKind::Saddle) as u32, counts.saddles, "{name} at {relative}: saddles");
        }
        check_arcs(&format!("{name} at {relative}"), mesh, values, relative);
    }
}

fn check_arcs(name: &str, mesh: &TriMesh, values: &[f64], relative: f64) {
    let hierarchy = morse_hierarchy(mesh, values).unwrap();
    let threshold = relative * value_range(mesh.connectivity(), values).unwrap().length();
    let complex = morse_complex(mesh, values, Threshold::Relative(relative), PathStyle::Whole).unwrap();
    let name_of = |i: u32| hierarchy.nodes[i as usize].vertex;
    let arcs: BTreeSet<(u32, u32, CriticalKind)> =
        hierarchy.arcs_at(threshold).map(|[s, e]| (name_of(s), name_of(e), hierarchy.nodes[e as usize].kind)).collect();
    let of_lines = (0..complex.saddles.len()).map(|k| (complex.saddles[k], complex.extrema[k], complex.kinds[k]));
    assert_eq!(of_lines.collect::<BTreeSet<_>>(), arcs, "{name}: arcs");
    let labels = basins(mesh, values, Threshold::Relative(relative)).unwrap();
    let passes: BTreeSet<u32> =
        hierarchy.nodes.iter().filter(|node| node.kind == CriticalKind::Saddle).map(|node| node.vertex).collect();
    let connected: BTreeSet<[u32; 2]> = mesh.connectivity().edges().iter().copied().collect();
    for (k, line) in lines(&complex).into_iter().enumerate() {
        let label = if complex.kinds[k] == CriticalKind::Minimum { &labels.descending } else { &labels.ascending };
        // Over a cancelled saddle a line takes its own way, whatever basin the vertex is in.
        if !passes.contains(&line[1]) {
            assert_eq!(label[line[1] as usize], complex.extrema[k], "{name}: basin");
        }
        assert_eq!(line.last(), Some(&complex.extrema[k]), "{name}");
        for step in line.windows(2) {
            assert!(connected.contains(&[step[0].min(step[1]), step[0].max(step[1])]), "{name}: along edges");
        }
    }
    let mut distinct: BTreeMap<u32, BTreeSet<&[u32]>> = BTreeMap::new();
    for line in lines(&complex) {
        assert!(line.len() > 1, "{name}: {line:?}");
        assert!(line.windows(2).all(|step| step[0] != step[1]), "{name}: stands still in {line:?}");
        assert!(line.windows(3).all(|turn| turn[0] != turn[2]), "{name}: turns back in {line:?}");
        assert!(distinct.entry(line[0]).or_default().insert(line), "{name}: {line:?} twice");
    }
    if mesh.topology().unwrap().closed && is_surface(mesh) {
        let mut simple: BTreeMap<u32, usize> = BTreeMap::new();
        for (i, node) in hierarchy.nodes.iter().enumerate() {
            if node.kind == CriticalKind::Saddle && hierarchy.is_alive(i as u32, threshold) {
                *simple.entry(node.vertex).or_default() += 1;
            }
        }
        let lines: BTreeMap<u32, usize> = distinct.iter().map(|(&v, lines)| (v, lines.len())).collect();
        for (&v, &k) in &simple {
            let most = 4 * k;
            assert!((2 * (k + 1)..=most).contains(&lines[&v]), "{name}: {} lines at {v} for {k}", lines[&v]);
        }
        assert_eq!(lines.len(), simple.len(), "{name}");
    }
    let merged = morse_complex(mesh, values, Threshold::Relative(relative), PathStyle::Merged).unwrap();
    assert!(lines(&merged).iter().all(|line| line.len() > 1), "{name}: merged");
    assert_eq!((&merged.saddles, &merged.extrema), (&complex.saddles, &complex.extrema), "{name}: merged");
    assert_eq!(edges_of(&merged), edges_of(&complex), "{name}: merged draws the same");
    for (side, labels) in [(CriticalKind::Minimum, &labels.descending), (CriticalKind::Maximum, &labels.ascending)] {
        let found: BTreeSet<u32> = labels.iter().copied().filter(|&v| v != u32::MAX).collect();
        let alive = (0..hierarchy.nodes.len() as u32).filter(|&i| hierarchy.is_alive(i, threshold));
        let alive = alive.filter(|&i| hierarchy.nodes[i as usize].kind == side).map(name_of).collect();
        assert_eq!(found, alive, "{name}: as many basins as extrema");
    }
}

#[test]
fn every_kind_of_mesh() {
    for (name, mesh) in every_kind() {
        let n = mesh.vertex_count();
        for seed in 0..4 {
            for (what, values) in
                [("noise", noise(n, seed)), ("ties", tied(n, seed, 3.0)), ("two values", tied(n, seed, 1.0))]
            {
                check_lines(&format!("{name}, {what} {seed}"), &mesh, &values);
                check_hierarchy(&format!("{name}, {what} {seed}"), &mesh, &values);
            }
        }
        check_lines(&format!("{name}, constant"), &mesh, &vec![1.0; n]);
        check_hierarchy(&format!("{name}, constant"), &mesh, &vec![1.0; n]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 80, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_complexes(seed: u64, n in 3_u32..10, triangles in 1_usize..40, steps in 1_u8..12) {
        let complex = random_complex(seed, n, triangles);
        let values = tied(n as usize, seed ^ 1, f64::from(steps));
        check_lines("random complex", &complex, &values);
        check_hierarchy("random complex", &complex, &values);
    }

    #[test]
    fn surfaces_with_holes(seed: u64, removed in 0.0_f64..0.4, steps in 1_u8..40) {
        for base in [shapes::torus(9, 7, 0.3).unwrap(), shapes::grid(9, 8).unwrap()] {
            let surface = random_surface(seed, &base, removed);
            let values = tied(surface.vertex_count(), seed ^ 2, f64::from(steps));
            check_lines("surface", &surface, &values);
            check_hierarchy("surface", &surface, &values);
        }
    }
}

#[test]
fn a_torus_has_the_arcs_of_the_textbook() {
    let torus = shapes::torus(60, 40, 0.0).unwrap();
    // Upright, a little tilted: minimum, two saddles, maximum.
    let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
    let hierarchy = morse_hierarchy(&torus, &height).unwrap();
    assert_eq!(hierarchy.nodes.len(), 4);
    assert_eq!(hierarchy.arcs, [[2, 0], [2, 0], [2, 1], [2, 1], [3, 0], [3, 0], [3, 1], [3, 1]]);
    assert!(hierarchy.nodes.iter().all(|node| node.cancelled_at == f64::INFINITY));
    let basins = basins(&torus, &height, Threshold::Relative(0.0)).unwrap();
    assert_eq!(basins.descending, vec![hierarchy.nodes[0].vertex; 2400]);
}

#[test]
fn vertices_in_one_place_do_no_harm() {
    let grid = shapes::grid(12, 9).unwrap();
    let values = noise(108, 8);
    for scale in [0.0, 1e-200, 1e70] {
        let positions = grid.positions().iter().map(|x| x * scale).collect();
        let mesh = TriMesh::new(positions, grid.connectivity().triangles().as_flattened().to_vec()).unwrap();
        let complex = morse_complex(&mesh, &values, Threshold::Relative(0.3), PathStyle::Whole).unwrap();
        assert!(!complex.saddles.is_empty());
        check_hierarchy("collapsed", &mesh, &values);
    }
}

#[test]
fn isolated_vertices_belong_to_no_basin() {
    let mesh = islands();
    let labels = basins(&mesh, &noise(mesh.vertex_count(), 3), Threshold::Relative(0.1)).unwrap();
    for v in mesh.connectivity().isolated_vertices() {
        assert_eq!((labels.descending[v as usize], labels.ascending[v as usize]), (u32::MAX, u32::MAX));
    }
}

#[test]
fn long_ways_that_turn_again_and_again_and_hubs_take_linear_time() {
    // An oscillation that grows outwards, to the left and to the right by turns: every extremum that is cancelled lies at the
    // far end of all that were cancelled before. With one path turned round after the other, this would take minutes.
    let columns = 300_000_u32;
    let strip = shapes::grid(columns, 2).unwrap();
    let chirp: Vec<f64> = (0..strip.vertex_count())
        .map(|v| {
            let x = (strip.position(v as u32)[0] * f64::from(columns - 1)).round() as i64 - i64::from(columns / 2);
            let height = x.abs() as f64 + if x < 0 { 0.5 } else { 0.0 };
            if x % 2 == 0 { -height } else { height }
        })
        .collect();
    let complex = morse_complex(&strip, &chirp, Threshold::Relative(0.9), PathStyle::Merged).unwrap();
    assert!(complex.vertices.len() < 4 * strip.vertex_count());
    // A vertex with very many neighbours, low and high by turns.
    let rim = 100_000_u32;
    let triangles: Vec<[u32; 3]> =
        (0..rim).flat_map(|i| [[0, 2 + i, 2 + (i + 1) % rim], [1, 2 + (i + 1) % rim, 2 + i]]).collect();
    let values: Vec<f64> = (0..rim + 2)
        .map(|v| match v {
            0 => 0.0,
            1 => 9.0 * f64::from(rim),
            _ if v % 2 == 0 => -f64::from(v),
            _ => f64::from(v),
        })
        .collect();
    let hub = complex_of(rim + 2, &triangles);
    let lines = morse_complex(&hub, &values, Threshold::default(), PathStyle::Whole).unwrap();
    assert_eq!(lines.saddles.len(), rim as usize);
}

#[test]
fn bad_input_is_refused() {
    let torus = shapes::torus(8, 6, 0.0).unwrap();
    let height: Vec<f64> = torus.positions().chunks_exact(3).map(|p| p[0]).collect();
    for persistence in [-0.1, f64::NAN, f64::INFINITY] {
        let error = morse_complex(&torus, &height, Threshold::Relative(persistence), PathStyle::Whole).unwrap_err();
        assert_eq!(error.code(), "InvalidOption");
        assert_eq!(basins(&torus, &height, Threshold::Relative(persistence)).unwrap_err().code(), "InvalidOption");
    }
    assert_eq!(
        morse_complex(&torus, &height[1..], Threshold::Relative(0.0), PathStyle::Whole).unwrap_err().code(),
        "LengthMismatch"
    );
    assert_eq!(morse_hierarchy(&torus, &height[1..]).unwrap_err().code(), "LengthMismatch");
    let mut holes = height;
    holes[5] = f64::NAN;
    assert_eq!(morse_hierarchy(&torus, &holes).unwrap_err().code(), "NonFiniteValue");
    assert_eq!(basins(&torus, &holes, Threshold::Relative(0.0)).unwrap_err().code(), "NonFiniteValue");
}
