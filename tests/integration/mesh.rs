//! Connectivity and invariants against brute force over the list of triangles, and every complaint with its ids.

use std::collections::BTreeSet;

use morse_smooth::error::{Error, MeshError};
use morse_smooth::mesh::{Connectivity, LinkKind, TriMesh, WeldOptions, WeldedField, shapes, weld};
use proptest::prelude::*;

use crate::support::{
    annulus, book_of_three, bow_tie, complex, edge_map, every_kind, islands, link_components, links, mesh,
    random_complex, random_surface, two_tetrahedra_at_a_vertex, two_tetrahedra_at_an_edge, walk_link,
};

/// χ, components, boundary loops, closed, orientable, genus, non-manifold edges and vertices, isolated vertices.
type Facts = (i64, usize, usize, bool, bool, Option<u64>, usize, usize, usize);

fn facts(mesh: &TriMesh) -> Facts {
    let t = mesh.topology().unwrap();
    (
        t.euler_characteristic,
        t.components,
        t.boundary_loops,
        t.closed,
        t.orientable,
        t.genus,
        t.non_manifold_edges,
        t.non_manifold_vertices,
        t.isolated_vertices,
    )
}

#[test]
fn invariants_of_known_surfaces() {
    let punctured = {
        let torus = shapes::torus(8, 8, 0.0).unwrap();
        let triangles = &torus.connectivity().triangles()[1..];
        TriMesh::new(torus.positions().to_vec(), triangles.as_flattened().to_vec()).unwrap()
    };
    // The projective plane on six vertices, every pair of which is an edge.
    let projective_plane = complex(
        6,
        &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1], [1, 2, 4], [2, 3, 5], [3, 4, 1], [4, 5, 2], [5, 1, 3]],
    );
    let cases: [(&str, TriMesh, Facts); 16] = [
        ("tetrahedron", shapes::tetrahedron().unwrap(), (2, 1, 0, true, true, Some(0), 0, 0, 0)),
        ("octahedron", shapes::octahedron().unwrap(), (2, 1, 0, true, true, Some(0), 0, 0, 0)),
        ("sphere", shapes::sphere(3).unwrap(), (2, 1, 0, true, true, Some(0), 0, 0, 0)),
        ("torus", shapes::torus(12, 9, 0.3).unwrap(), (0, 1, 0, true, true, Some(1), 0, 0, 0)),
        ("punctured torus", punctured, (-1, 1, 1, false, true, Some(1), 0, 0, 0)),
        ("grid", shapes::grid(7, 5).unwrap(), (1, 1, 1, false, true, Some(0), 0, 0, 0)),
        ("trefoil tube", shapes::trefoil_tube(40, 7, 0.3).unwrap(), (0, 1, 0, true, true, Some(1), 0, 0, 0)),
        ("irregular sphere", shapes::irregular_sphere(9, 14, 1).unwrap(), (2, 1, 0, true, true, Some(0), 0, 0, 0)),
        ("terrain", shapes::terrain(9, 6, 1).unwrap(), (1, 1, 1, false, true, Some(0), 0, 0, 0)),
        ("annulus", annulus(), (0, 1, 2, false, true, Some(0), 0, 0, 0)),
        ("moebius strip", shapes::moebius(12, 3).unwrap(), (0, 1, 1, false, false, None, 0, 0, 0)),
        ("klein bottle", shapes::klein_bottle(9, 7).unwrap(), (0, 1, 0, true, false, None, 0, 0, 0)),
        ("projective plane", projective_plane, (1, 1, 0, true, false, None, 0, 0, 0)),
        ("two tetrahedra at an edge", two_tetrahedra_at_an_edge(), (3, 1, 0, true, true, None, 1, 2, 0)),
        ("two tetrahedra at a vertex", two_tetrahedra_at_a_vertex(), (3, 1, 0, true, true, None, 0, 1, 0)),
        ("islands", islands(), (6, 2, 0, true, true, Some(0), 0, 0, 2)),
    ];
    for (name, mesh, expected) in cases {
        assert_eq!(facts(&mesh), expected, "{name}");
    }
    // Two sheets that touch in a vertex have a boundary each.
    assert_eq!(facts(&bow_tie()), (1, 1, 2, false, true, None, 0, 1, 0));
    let book = book_of_three().topology().unwrap();
    assert_eq!((book.euler_characteristic, book.non_manifold_edges, book.non_manifold_vertices), (1, 1, 2));
    assert_eq!((book.closed, book.genus, book.components), (false, None, 1));
}

#[test]
fn areas_in_closed_form() {
    let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-14 * b, "{a} {b}");
    close(shapes::tetrahedron().unwrap().area(), 8.0 * 3.0_f64.sqrt());
    close(shapes::octahedron().unwrap().area(), 4.0 * 3.0_f64.sqrt());
    close(shapes::grid(9, 4).unwrap().area(), 1.0);
    // The area of an inscribed sphere tends to 4π as the square of the edge length.
    let errors: Vec<f64> = (3..6).map(|k| 4.0 * core::f64::consts::PI - shapes::sphere(k).unwrap().area()).collect();
    assert!(errors.iter().all(|&e| e > 0.0) && errors.windows(2).all(|e| (3.8..4.2).contains(&(e[0] / e[1]))));
    // Far from the origin a triangle keeps its area.
    close(mesh(&[[1e6, 1e6, 0.0], [1e6 + 1.0, 1e6, 0.0], [1e6, 1e6 + 1.0, 0.0]], &[[0, 1, 2]]).area(), 0.5);
}

/// The volume that a closed mesh encloses: positive where its triangles face outward.
fn volume(mesh: &TriMesh) -> f64 {
    let corners = mesh.connectivity().triangles().iter().map(|triangle| triangle.map(|v| mesh.position(v)));
    let product = |[a, b, c]: [[f64; 3]; 3]| {
        let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        (0..3).map(|k| a[k] * cross[k]).sum::<f64>()
    };
    corners.map(product).sum::<f64>() / 6.0
}

#[test]
fn generated_meshes_have_the_size_and_the_sides_they_promise() {
    use core::f64::consts::PI;
    let knot = shapes::trefoil_tube(400, 60, 0.0).unwrap();
    assert_eq!((knot.vertex_count(), knot.triangle_count()), (24_000, 48_000));
    // A tube has the volume of a straight one as long as its centre line (Pappus), whose length is a simple integral.
    let length: f64 = (0..4000)
        .map(|i| {
            let t = 2.0 * PI * f64::from(i) / 4000.0;
            let velocity = [t.cos() + 4.0 * (2.0 * t).cos(), 4.0 * (2.0 * t).sin() - t.sin(), -3.0 * (3.0 * t).cos()];
            velocity.iter().map(|v| v * v).sum::<f64>().sqrt() * 2.0 * PI / 4000.0
        })
        .sum();
    let exact = PI * 0.16 * length;
    assert!((volume(&knot) / exact - 1.0).abs() < 5e-3, "{} {exact}", volume(&knot));

    let sphere = shapes::irregular_sphere(99, 140, 3).unwrap();
    assert_eq!((sphere.vertex_count(), sphere.triangle_count()), (99 * 140 + 2, 2 * 99 * 140));
    assert!((volume(&sphere) / (4.0 / 3.0 * PI) - 1.0).abs() < 5e-3, "{}", volume(&sphere));
    let valence = |v: u32| sphere.connectivity().edges().iter().filter(|edge| edge.contains(&v)).count();
    assert_eq!((valence(0), valence(99 * 140 + 1)), (140, 140));
    assert_eq!(
        shapes::irregular_sphere(5, 8, 7).unwrap().positions(),
        shapes::irregular_sphere(5, 8, 7).unwrap().positions()
    );
    assert_ne!(
        shapes::irregular_sphere(5, 8, 7).unwrap().positions(),
        shapes::irregular_sphere(5, 8, 8).unwrap().positions()
    );

    // Upward, in square cells, and the same hills at twice the resolution.
    let (coarse, fine) = (shapes::terrain(31, 21, 5).unwrap(), shapes::terrain(61, 41, 5).unwrap());
    assert_eq!((coarse.vertex_count(), coarse.triangle_count()), (31 * 21, 2 * 30 * 20));
    for (i, j) in [(0, 0), (4, 17), (30, 20)] {
        let (p, q) = (coarse.position(i * 21 + j), fine.position(2 * i * 41 + 2 * j));
        assert!((0..3).all(|k| (p[k] - q[k]).abs() < 1e-12), "{p:?} {q:?}");
        assert!((p[0] - f64::from(i) / 30.0).abs() < 1e-12 && (p[1] - f64::from(j) / 30.0).abs() < 1e-12);
    }
    let heights: Vec<f64> = coarse.positions().chunks_exact(3).map(|p| p[2]).collect();
    let (low, high) = heights.iter().fold((f64::MAX, f64::MIN), |(low, high), &z| (low.min(z), high.max(z)));
    assert!(high - low > 0.1 && high < 0.4 && low > -0.4, "{low} {high}");
    for triangle in coarse.connectivity().triangles() {
        let [a, b, c] = triangle.map(|v| coarse.position(v));
        assert!((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0);
    }
}

#[test]
fn generators_refuse_counts_that_make_no_mesh() {
    let empty = |found: Result<TriMesh, MeshError>| matches!(found, Err(MeshError::EmptyMesh { .. }));
    assert!(empty(shapes::trefoil_tube(2, 9, 0.0)) && empty(shapes::trefoil_tube(9, 2, 0.0)));
    assert!(empty(shapes::irregular_sphere(0, 9, 0)) && empty(shapes::irregular_sphere(9, 2, 0)));
    assert!(empty(shapes::terrain(1, 9, 0)) && empty(shapes::terrain(9, 1, 0)));
    assert!(empty(shapes::terrain(0, 0, 0)) && empty(shapes::irregular_sphere(0, 0, 0)));
    // One circle and two poles.
    assert_eq!(shapes::irregular_sphere(1, 3, 0).unwrap().topology().unwrap().euler_characteristic, 2);
}

#[test]
fn refuses_arrays_that_make_no_mesh() {
    let square = vec![0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
    let with = |place: usize, value: f64| {
        let mut positions = square.clone();
        positions[place] = value;
        positions
    };
    let cases: Vec<(Vec<f64>, Vec<u32>, MeshError)> = vec![
        (vec![], vec![], MeshError::EmptyMesh { vertices: 0, triangles: 0 }),
        (square.clone(), vec![], MeshError::EmptyMesh { vertices: 4, triangles: 0 }),
        (square.clone(), vec![0, 1, 1, 2, 2, 2], MeshError::EmptyMesh { vertices: 4, triangles: 0 }),
        (square[..11].to_vec(), vec![0, 1, 2], MeshError::PositionsNotTriples { length: 11 }),
        (square.clone(), vec![0, 1, 2, 3], MeshError::TrianglesNotTriples { length: 4 }),
        (with(7, f64::NAN), vec![0, 1, 2], MeshError::NonFinitePosition { vertex: 2 }),
        (with(9, f64::NEG_INFINITY), vec![0, 1, 2], MeshError::NonFinitePosition { vertex: 3 }),
        (with(5, -1e80), vec![0, 1, 2], MeshError::PositionOverflow { vertex: 1 }),
        (square.clone(), vec![0, 1, 2, 0, 4, 3], MeshError::IndexOutOfBounds { triangle: 1, index: 4, vertices: 4 }),
        (
            square.clone(),
            vec![0, 1, 2, 0, 2, u32::MAX],
            MeshError::IndexOutOfBounds { triangle: 1, index: u32::MAX, vertices: 4 },
        ),
        (vec![], vec![0, 1, 2], MeshError::IndexOutOfBounds { triangle: 0, index: 0, vertices: 0 }),
    ];
    for (positions, triangles, expected) in cases {
        let found = TriMesh::new(positions, triangles).expect_err("no mesh");
        assert_eq!(found, expected);
        assert_eq!(Error::from(found).code(), expected.code());
    }
}

#[test]
fn puts_right_what_can_be_and_says_so() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [2., 0., 0.], [5., 5., 5.], [1., 1., 0.]];
    // 0 is good, 1 and 4 name a vertex twice, 2 and 5 repeat triangle 0 in another order, 3 lies on a line.
    let triangles = [[0, 1, 2], [1, 1, 2], [2, 0, 1], [0, 1, 3], [2, 5, 2], [1, 0, 2], [1, 5, 2]];
    let found = mesh(&positions, &triangles);
    assert_eq!(found.connectivity().triangles(), [[0, 1, 2], [0, 1, 3], [1, 5, 2]]);
    assert_eq!(found.triangle_areas(), [0.5, 0.0, 0.5]);
    assert!(found.is_zero_area(1) && !found.is_zero_area(2));
    let mut warnings: Vec<(&str, usize, Vec<u32>)> =
        found.warnings().iter().map(|w| (w.code, w.count, w.examples.clone())).collect();
    warnings.sort();
    assert_eq!(
        warnings,
        [
            ("DegenerateTriangle", 2, vec![1, 4]),
            ("DuplicateTriangle", 2, vec![2, 5]),
            ("IsolatedVertex", 1, vec![4]),
            ("ZeroAreaTriangle", 1, vec![1]),
        ]
    );
    let topology = found.topology().unwrap();
    assert_eq!((topology.degenerate_triangles, topology.isolated_vertices), (3, 1));
    assert!(shapes::torus(8, 8, 0.0).unwrap().warnings().is_empty());
}

#[test]
fn welds_a_soup_to_the_mesh_it_came_from() {
    let sphere = shapes::sphere(2).unwrap();
    let soup: Vec<f64> =
        sphere.connectivity().triangles().as_flattened().iter().flat_map(|&v| sphere.position(v)).collect();
    let ids: Vec<u32> = (0..soup.len() as u32 / 3).collect();
    let weld = |positions: &[f64], triangles: &[u32]| weld(positions, Some(triangles), &WeldOptions::default());
    let welded = weld(&soup, &ids).unwrap();
    for (old, &new) in welded.map.iter().enumerate() {
        assert_eq!(soup[3 * old..3 * old + 3], welded.positions[3 * new as usize..3 * new as usize + 3]);
    }
    let joined = TriMesh::new(welded.positions.clone(), welded.triangles.clone()).unwrap();
    assert_eq!(facts(&joined), facts(&sphere));
    assert_eq!(joined.vertex_count(), sphere.vertex_count());
    // Values that differ are averaged, and the disagreement is told.
    let mut values = vec![0.0; ids.len()];
    values[5] = 1.0;
    let WeldedField { values: field, disagreeing } = welded.field(&values).unwrap();
    assert_eq!(field.len(), joined.vertex_count());
    assert_eq!(disagreeing, [welded.map[5]]);
    // Minus zero is zero; a hair's breadth apart is apart.
    let close = weld(&[0.0, 0.0, 0.0, -0.0, 0.0, -0.0, 5e-324, 0.0, 0.0], &[0, 1, 2]).unwrap();
    assert_eq!(close.map, [0, 0, 1]);
    let wrong = weld(&[0.0; 9], &[0, 1, 3]).expect_err("an id out of range");
    assert_eq!(wrong, Error::Mesh(MeshError::IndexOutOfBounds { triangle: 0, index: 3, vertices: 3 }));
    assert!(matches!(weld(&[0.0; 8], &[]), Err(Error::Mesh(MeshError::PositionsNotTriples { length: 8 }))));
    assert!(matches!(weld(&[f64::NAN; 9], &[0, 1, 2]), Err(Error::Mesh(MeshError::NonFinitePosition { vertex: 0 }))));
}

/// Whether some choice of turned triangles makes all edges with two triangles coherent: tried out.
fn orientable_by_trial(triangles: &[[u32; 3]]) -> bool {
    let runs = |t: [u32; 3], [a, b]: [u32; 2]| (0..3).any(|c| t[c] == a && t[(c + 1) % 3] == b);
    let pairs: Vec<(u32, u32, bool)> = edge_map(triangles)
        .iter()
        .filter(|(_, at)| at.len() == 2)
        .map(|(&edge, at)| {
            let same = runs(triangles[at[0] as usize], edge) == runs(triangles[at[1] as usize], edge);
            (at[0], at[1], same)
        })
        .collect();
    (0_u32..1 << triangles.len())
        .any(|turned| pairs.iter().all(|&(s, t, same)| ((turned >> s ^ turned >> t) & 1 == 1) == same))
}

fn check_connectivity(mesh: &TriMesh) -> Result<(), TestCaseError> {
    let connectivity: &Connectivity = mesh.connectivity();
    let triangles = connectivity.triangles();
    let n = mesh.vertex_count();
    let edges = edge_map(triangles);
    prop_assert_eq!(connectivity.edges().to_vec(), edges.keys().copied().collect::<Vec<_>>());
    for (id, (_, expected)) in edges.iter().enumerate() {
        let mut found = connectivity.triangles_of_edge(id as u32).to_vec();
        found.sort_unstable();
        prop_assert_eq!(&found, expected);
        for &t in expected {
            let other = expected.iter().copied().find(|&s| s != t).filter(|_| expected.len() == 2);
            prop_assert_eq!(connectivity.across(t, id as u32), other);
        }
    }
    for (t, corners) in triangles.iter().enumerate() {
        for c in 0..3 {
            let (a, b) = (corners[c], corners[(c + 1) % 3]);
            prop_assert_eq!(connectivity.edges()[connectivity.triangle_edges()[t][c] as usize], [a.min(b), a.max(b)]);
        }
    }
    let links = links(n, triangles);
    let mut kinds = Vec::new();
    for (v, link) in links.iter().enumerate() {
        let star: Vec<u32> =
            (0..triangles.len() as u32).filter(|&t| triangles[t as usize].contains(&(v as u32))).collect();
        prop_assert_eq!(connectivity.star(v as u32), &star);
        let kind = match walk_link(link) {
            _ if link.is_empty() => LinkKind::Isolated,
            Some((_, true)) => LinkKind::Cycle,
            Some((_, false)) => LinkKind::Path,
            None => LinkKind::NonManifold,
        };
        kinds.push(kind);
        prop_assert_eq!(connectivity.link_kinds()[v], kind, "link of {}", v);
        let ends: BTreeSet<u32> = connectivity.link(v as u32).flatten().collect();
        prop_assert_eq!(ends, link.keys().copied().collect::<BTreeSet<u32>>());
    }
    let topology = mesh.topology().unwrap();
    let count = |kind| kinds.iter().filter(|&&k| k == kind).count();
    prop_assert_eq!(topology.isolated_vertices, count(LinkKind::Isolated));
    prop_assert_eq!(topology.non_manifold_vertices, count(LinkKind::NonManifold));
    prop_assert_eq!(topology.non_manifold_edges, edges.values().filter(|at| at.len() > 2).count());
    prop_assert_eq!(topology.closed, edges.values().all(|at| at.len() > 1));
    prop_assert_eq!(topology.euler_characteristic, n as i64 - edges.len() as i64 + triangles.len() as i64);
    let mut neighbours = crate::support::Link::new();
    for &[a, b] in edges.keys() {
        neighbours.entry(a).or_default().insert(b);
        neighbours.entry(b).or_default().insert(a);
    }
    prop_assert_eq!(topology.components, link_components(&neighbours, |_| true).len());
    if triangles.len() <= 12 {
        prop_assert_eq!(topology.orientable, orientable_by_trial(triangles));
    }
    if count(LinkKind::NonManifold) == 0 {
        // On a manifold the boundary is a graph of disjoint cycles.
        let mut boundary = crate::support::Link::new();
        for (&[a, b], _) in edges.iter().filter(|(_, at)| at.len() == 1) {
            boundary.entry(a).or_default().insert(b);
            boundary.entry(b).or_default().insert(a);
        }
        prop_assert_eq!(topology.boundary_loops, link_components(&boundary, |_| true).len());
    }
    Ok(())
}

#[test]
fn connectivity_of_every_kind_of_mesh() {
    for (name, mesh) in every_kind() {
        check_connectivity(&mesh).unwrap_or_else(|problem| panic!("{name}: {problem}"));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn connectivity_of_random_complexes(seed: u64, n in 3_u32..10, m in 1_usize..40) {
        check_connectivity(&random_complex(seed, n, m))?;
    }

    #[test]
    fn connectivity_of_surfaces_with_holes(seed: u64, removed in 0.0..0.9) {
        check_connectivity(&random_surface(seed, &shapes::torus(6, 5, 0.0).unwrap(), removed))?;
        check_connectivity(&random_surface(seed, &shapes::klein_bottle(5, 4).unwrap(), removed))?;
    }
}
