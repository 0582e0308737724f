//! Vertices at which sheets hang together: one rule for what they are called, in every function.

use std::collections::{BTreeMap, BTreeSet};

use morse_smooth::Watch;
use morse_smooth::field::{self, CriticalKind, DeltaOptions, Keep, PathStyle, ScalarField, Threshold};
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use proptest::prelude::*;

use crate::analyses::{critical_points, morse_complex, morse_hierarchy, persistence};
use crate::support::{complex, link_components, links, noise, tied};

/// The surfaces of tetrahedra that have vertex 0 in common.
fn tetrahedra(count: u32) -> TriMesh {
    let mut triangles = Vec::new();
    for k in 0..count {
        let [a, b, c] = [1, 2, 3].map(|i| 3 * k + i);
        triangles.extend([[0, a, b], [0, b, c], [0, c, a], [a, c, b]]);
    }
    complex(3 * count + 1, &triangles)
}

/// A mesh with some vertices made one with others.
fn pinched(base: &TriMesh, pairs: &[[u32; 2]]) -> TriMesh {
    let mut names: Vec<u32> = (0..base.vertex_count() as u32).collect();
    for &[kept, gone] in pairs {
        names[gone as usize] = names[kept as usize];
    }
    let mut seen = BTreeSet::new();
    let mut triangles = Vec::new();
    for t in base.connectivity().triangles() {
        let t = t.map(|v| names[v as usize]);
        let mut sorted = t;
        sorted.sort_unstable();
        if sorted[0] != sorted[1] && sorted[1] != sorted[2] && seen.insert(sorted) {
            triangles.push(t);
        }
    }
    complex(base.vertex_count() as u32, &triangles)
}

/// The rule. A vertex with nothing below it is a minimum and with nothing above it a maximum, in however many pieces its link is;
/// any other one with several pieces on a side is a saddle. All with several pieces on a side, extrema too, join components.
fn check(name: &str, mesh: &TriMesh, values: &[f64]) {
    let links = links(mesh.vertex_count(), mesh.connectivity().triangles());
    let is_below = |a: u32, b: u32| (values[a as usize], a) < (values[b as usize], b);
    let (mut kinds, mut joins) = (BTreeMap::new(), BTreeMap::new());
    for (v, link) in links.iter().enumerate().filter(|(_, link)| !link.is_empty()) {
        let v = v as u32;
        let lower = link_components(link, |j| is_below(j, v)).len() as u32;
        let upper = link_components(link, |j| is_below(v, j)).len() as u32;
        let most = lower.max(upper);
        if lower == 0 {
            kinds.insert(v, (CriticalKind::Minimum, 1));
        } else if upper == 0 {
            kinds.insert(v, (CriticalKind::Maximum, 1));
        } else if most > 1 {
            kinds.insert(v, (CriticalKind::Saddle, most - 1));
        }
        if most > 1 {
            joins.insert(v, [lower, upper]);
        }
    }
    let found = critical_points(mesh, values, &DeltaOptions::default()).unwrap();
    let found: BTreeMap<_, _> = found.points.iter().map(|p| (p.vertex, (p.kind, p.multiplicity))).collect();
    assert_eq!(found, kinds, "{name}: critical points");

    let hierarchy = morse_hierarchy(mesh, values).unwrap();
    let mut saddles: BTreeMap<u32, u32> = BTreeMap::new();
    let mut extrema = BTreeSet::new();
    for node in &hierarchy.nodes {
        if node.kind == CriticalKind::Saddle {
            *saddles.entry(node.vertex).or_default() += 1;
        } else {
            assert!(extrema.insert(node.vertex), "{name}: {} twice", node.vertex);
            assert_eq!(kinds[&node.vertex].0, node.kind, "{name}");
        }
    }
    let expected: BTreeMap<u32, u32> = joins.iter().map(|(&v, &[l, u])| (v, l.max(u) - 1)).collect();
    assert_eq!(saddles, expected, "{name}: simple saddles");
    let of_kind = kinds.iter().filter(|(_, (kind, _))| *kind != CriticalKind::Saddle).map(|(&v, _)| v);
    assert_eq!(extrema, of_kind.collect(), "{name}: extrema of the hierarchy");
    let lines = morse_complex(mesh, values, Threshold::default(), PathStyle::Whole).unwrap();
    assert_eq!(
        lines.saddles.iter().copied().collect::<BTreeSet<_>>(),
        joins.keys().copied().collect(),
        "{name}: lines"
    );

    let mut pairs: BTreeMap<(u32, CriticalKind), u32> = BTreeMap::new();
    for pair in persistence(mesh, values).unwrap().pairs {
        assert_eq!(kinds[&pair.extremum].0, pair.kind, "{name}: paired");
        *pairs.entry((pair.saddle, pair.kind)).or_default() += 1;
    }
    for ((v, kind), count) in pairs {
        let side = usize::from(kind == CriticalKind::Maximum);
        assert!(joins.get(&v).is_some_and(|pieces| count < pieces[side]), "{name}: {count} end at {v}");
    }

    // What simplification leaves has kinds by the same rule: wanted extrema and unavoidable ones, no others.
    let everything = Keep::Above(Threshold::Absolute(1e6));
    let simple = field::simplify(&ScalarField::new(mesh, values).unwrap(), everything, &Watch::none()).unwrap();
    let diagram = persistence(mesh, values).unwrap();
    let mut kept: BTreeSet<u32> = diagram.essential_minima.iter().chain(&diagram.essential_maxima).copied().collect();
    kept.extend(&simple.unavoidable);
    let left = critical_points(mesh, &simple.values, &DeltaOptions::default()).unwrap();
    let left = left.points.iter().filter(|p| p.kind != CriticalKind::Saddle).map(|p| p.vertex);
    assert_eq!(left.collect::<BTreeSet<_>>(), kept, "{name}: simplified");
}

#[test]
fn a_minimum_at_which_sheets_hang_together_is_a_minimum_and_joins_maxima() {
    let mesh = tetrahedra(2);
    let values = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let found = critical_points(&mesh, &values, &DeltaOptions::default()).unwrap();
    let kinds: Vec<(u32, CriticalKind)> = found.points.iter().map(|p| (p.vertex, p.kind)).collect();
    assert_eq!(kinds, [(0, CriticalKind::Minimum), (3, CriticalKind::Maximum), (6, CriticalKind::Maximum)]);
    assert_eq!((found.counts.saddles, found.counts.index_sum), (0, Some(3)));
    let diagram = persistence(&mesh, &values).unwrap();
    assert_eq!((diagram.essential_minima, diagram.essential_maxima), (vec![0], vec![6]));
    let [pair] = diagram.pairs[..] else { panic!("{:?}", diagram.pairs) };
    assert_eq!((pair.extremum, pair.saddle, pair.kind, pair.persistence), (3, 0, CriticalKind::Maximum, 3.0));
    let lines = morse_complex(&mesh, &values, Threshold::default(), PathStyle::Whole).unwrap();
    assert_eq!(lines.saddles, [0, 0]);
    assert_eq!(lines.extrema.iter().copied().collect::<BTreeSet<_>>(), BTreeSet::from([3, 6]));
    let nodes: Vec<(u32, CriticalKind)> =
        morse_hierarchy(&mesh, &values).unwrap().nodes.iter().map(|node| (node.vertex, node.kind)).collect();
    let saddle = (0, CriticalKind::Saddle);
    assert_eq!(nodes, [kinds[0], kinds[1], kinds[2], saddle]);
}

#[test]
fn pinches_of_every_kind_follow_one_rule() {
    for count in 2..5 {
        let mesh = tetrahedra(count);
        let n = mesh.vertex_count();
        for seed in 0..20 {
            let mut values = noise(n, seed);
            check(&format!("{count} tetrahedra, {seed}"), &mesh, &values);
            for extreme in [-9.0, 9.0, 0.0] {
                values[0] = extreme;
                check(&format!("{count} tetrahedra at {extreme}, {seed}"), &mesh, &values);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn pinched_surfaces_follow_one_rule(seed: u64, pinches in 1_usize..5, steps in 1_u8..40, level in -1_i8..2) {
        // Closed, with boundary, in two parts that the pinches join.
        let bases = [shapes::torus(9, 7, 0.3).unwrap(), shapes::grid(9, 8).unwrap(), shapes::sphere(2).unwrap()];
        for base in bases {
            let n = base.vertex_count() as u32;
            let mut random = Random::new(seed);
            let mut any = || ((random.uniform() * f64::from(n)) as u32).min(n - 1);
            let pairs: Vec<[u32; 2]> = (0..pinches).map(|_| [any(), any()]).filter(|[a, b]| a != b).collect();
            let surface = pinched(&base, &pairs);
            let mut values = tied(n as usize, seed ^ 3, f64::from(steps));
            for &[kept, _] in &pairs {
                // At the pinch a minimum, a maximum or whatever there is.
                if level != 0 {
                    values[kept as usize] = 1e3 * f64::from(level);
                }
            }
            check("pinched", &surface, &values);
        }
    }
}
