//! Building, welding and counting meshes, and taking parts of them.

use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::mesh::{TriMesh, WeldOptions, weld};

use crate::check;

/// Positions and triangles of a mesh with a name.
pub(crate) struct Arrays {
    pub name: String,
    pub positions: Vec<f64>,
    pub triangles: Vec<u32>,
}

/// Meshes of many kinds, of some thousand vertices and more.
pub(crate) fn every_kind() -> Vec<Arrays> {
    let mut all = Vec::new();
    let mut add = |name: &str, positions: Vec<f64>, triangles: Vec<u32>| {
        all.push(Arrays { name: format!("{name}, {} vertices", positions.len() / 3), positions, triangles });
    };
    let arrays = |mesh: &TriMesh| (mesh.positions().to_vec(), mesh.connectivity().triangles().as_flattened().to_vec());
    for size in [60, 200] {
        let (positions, triangles) = arrays(&shapes::torus(size, size, 0.3).unwrap());
        let soup: Vec<f64> = triangles.iter().flat_map(|&v| positions[3 * v as usize..][..3].to_vec()).collect();
        let ids = (0..soup.len() as u32 / 3).collect();
        let mut random = Random::new(u64::from(size));
        let holes: Vec<u32> = triangles.chunks_exact(3).filter(|_| random.uniform() < 0.7).flatten().copied().collect();
        let isolated = [positions.clone(), positions.clone(), positions.clone()].concat();
        let repeated = [triangles.clone(), triangles.clone(), vec![0; triangles.len()]].concat();
        add("a torus", positions.clone(), triangles.clone());
        add("holes", positions.clone(), holes);
        add("isolated vertices", isolated, triangles);
        add("repetitions", positions, repeated);
        add("a soup", soup, ids);
        let (positions, triangles) = arrays(&shapes::grid(size, size).unwrap());
        add("a grid", positions, triangles);
        let (positions, triangles) = arrays(&shapes::klein_bottle(size, size).unwrap());
        add("a Klein bottle", positions, triangles);
        // All triangles at one vertex, which comes first or last.
        let n = size * size;
        for hub in [0, n] {
            let rim = |i: u32| if hub == 0 { 1 + i % n } else { i % n };
            let positions: Vec<f64> = (0..=n)
                .flat_map(|v| if v == hub { [0.0, 0.0, 1.0] } else { [f64::from(v), f64::from(v * v % 101), 0.0] })
                .collect();
            add("a wheel", positions, (0..n).flat_map(|i| [hub, rim(i), rim(i + 1)]).collect());
        }
        // A book: every triangle shares one edge.
        let pages = (0..n).flat_map(|v| [0.0, f64::from(v), f64::from(v * v % 101)]).collect();
        add("a book", pages, (2..n).flat_map(|v| [0, 1, v]).collect());
        let islands = (0..n).flat_map(|v| [f64::from(v), f64::from(v % 3), f64::from(v % 5)]).collect();
        add(
            "islands",
            islands,
            (0..n / 4).flat_map(|i| [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2].map(|v| 4 * i + v)).collect(),
        );
    }
    all
}

#[test]
fn meshes() {
    for Arrays { name, positions, triangles } in every_kind() {
        let mesh = check(&format!("a mesh of {name}"), 1.6, || TriMesh::new(positions, triangles).unwrap());
        check(&format!("the topology of {name}"), 1.5, || mesh.topology().unwrap());
        for share in [2, 5] {
            // A part without triangles is an error, which takes memory as well.
            let _ = check(&format!("a part of {name}"), 2.0, || {
                mesh.submesh(&|v| v % 1000 < 200 * share).map(|part| part.vertices.len())
            });
        }
    }
    let soup = vec![0.5; 90_000];
    check("a soup of points at one place", 1.6, || TriMesh::from_soup(soup).unwrap());
}

#[test]
fn welding() {
    for Arrays { name, positions, triangles } in every_kind() {
        for tolerance in [0.0, 1e-9, 1e-2, 0.3] {
            let welded = check(&format!("welding {name} by {tolerance}"), 1.5, || {
                weld(&positions, Some(&triangles), &WeldOptions { tolerance }).unwrap()
            });
            let values: Vec<f64> = positions.chunks_exact(3).map(|p| p[0]).collect();
            check(&format!("a field on welded {name}"), 1.5, || welded.field(&values).unwrap());
        }
    }
}
