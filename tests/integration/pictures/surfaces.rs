//! The surface that is drawn: where its sheets come apart, and that it faces outwards.

use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::render::{Axis, Scene, Surface};

use crate::support;

type Point = [f64; 3];

fn point(list: &[f64], corner: u32) -> Point {
    [0, 1, 2].map(|i| list[3 * corner as usize + i])
}

fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// Twice the area of a triangle of the surface, along its normal.
fn face(surface: &Surface, triangle: usize) -> Point {
    let [a, b, c] = surface.triangles[triangle].map(|corner| point(&surface.positions, corner));
    let (u, v) = (minus(b, a), minus(c, a));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// The cube [0, 1]³, its sides in two triangles each, turned at random.
pub(crate) fn cube() -> TriMesh {
    let positions: Vec<Point> = (0..8).map(|k| [k & 1, (k >> 1) & 1, k >> 2].map(f64::from)).collect();
    let sides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    support::mesh(&positions, &triangles)
}

/// What holds of every surface.
fn check(name: &str, mesh: &TriMesh) -> Surface {
    let surface = Scene::new(mesh).surface().clone();
    let corners = surface.vertices.len();
    assert_eq!((surface.positions.len(), surface.normals.len()), (3 * corners, 3 * corners), "{name}");
    assert!(surface.positions.iter().chain(&surface.normals).all(|x| x.is_finite()), "{name}");
    for corner in 0..corners as u32 {
        let normal = point(&surface.normals, corner);
        assert!((dot(normal, normal) - 1.0).abs() < 1e-12, "{name}: normal {normal:?}");
        let place = surface.place(mesh.position(surface.vertices[corner as usize]));
        let here = point(&surface.positions, corner);
        assert!(minus(place, here).iter().all(|x| x.abs() < 1e-14), "{name}: {here:?}, not {place:?}");
    }
    // In the unit ball, and touching it; its box is around the origin.
    let farthest =
        surface.positions.chunks_exact(3).map(|p| dot([p[0], p[1], p[2]], [p[0], p[1], p[2]])).fold(0.0, f64::max);
    assert!((farthest - 1.0).abs() < 1e-9, "{name}: {farthest}");
    for i in 0..3 {
        let along = || surface.positions.iter().skip(i).step_by(3);
        let (low, high) = (along().fold(f64::MAX, |m, &x| m.min(x)), along().fold(f64::MIN, |m, &x| m.max(x)));
        assert!((low + high).abs() < 1e-9, "{name}: from {low} to {high}");
    }
    // The triangles are the mesh's, each corner is that of its vertex, and no corner is without a triangle.
    assert_eq!(surface.triangles.len(), mesh.triangle_count());
    let mut used = vec![false; corners];
    for (t, triangle) in surface.triangles.iter().enumerate() {
        let mut here = triangle.map(|corner| surface.vertices[corner as usize]);
        let mut there = mesh.connectivity().triangles()[t];
        here.sort_unstable();
        there.sort_unstable();
        assert_eq!(here, there, "{name}: triangle {t}");
        triangle.iter().for_each(|&corner| used[corner as usize] = true);
    }
    assert!(used.iter().all(|&is_used| is_used), "{name}: a corner of no triangle");
    // Where neighbours share an edge of corners, they are turned alike.
    let mut edges = std::collections::BTreeMap::new();
    for triangle in &surface.triangles {
        for k in 0..3 {
            *edges.entry([triangle[k], triangle[(k + 1) % 3]]).or_insert(0) += 1;
        }
    }
    assert!(edges.values().all(|&count| count == 1), "{name}: neighbours are turned against each other");
    surface
}

#[test]
fn every_kind_of_mesh_has_a_surface() {
    for (name, mesh) in support::every_kind() {
        check(name, &mesh);
    }
    for seed in 0..60 {
        let mesh = support::random_complex(seed, 8, 3 + seed as usize % 30);
        check(&format!("random complex {seed}"), &mesh);
        let mesh = support::random_surface(seed, &shapes::torus(9, 7, 0.3).unwrap(), 0.2);
        check(&format!("random surface {seed}"), &mesh);
    }
}

#[test]
fn a_sphere_is_smooth_and_faces_outwards() {
    for mesh in [shapes::sphere(4).unwrap(), shapes::sphere(1).unwrap()] {
        let surface = check("sphere", &mesh);
        for corner in 0..surface.vertices.len() as u32 {
            let (place, normal) = (point(&surface.positions, corner), point(&surface.normals, corner));
            let length = dot(place, place).sqrt();
            assert!(dot(place, normal) > 0.97 * length, "at {place:?}: {normal:?}");
        }
        for t in 0..surface.triangles.len() {
            let middle = point(&surface.positions, surface.triangles[t][0]);
            assert!(dot(face(&surface, t), middle) >= 0.0);
        }
    }
}

#[test]
fn the_edges_of_a_cube_are_sharp() {
    let surface = check("cube", &cube());
    // Each of the eight vertices is there once for each of its three sides.
    assert_eq!(surface.vertices.len(), 24);
    for corner in 0..24 {
        let (place, normal) = (point(&surface.positions, corner), point(&surface.normals, corner));
        let axis = (0..3).max_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs())).unwrap();
        assert!((normal[axis].abs() - 1.0).abs() < 1e-12, "{normal:?} is along no axis");
        assert!(normal[axis] * place[axis] > 0.0, "{normal:?} points inwards at {place:?}");
    }
}

#[test]
fn a_thin_plate_faces_outwards() {
    let mesh = cube();
    let flat = mesh.positions().iter().enumerate().map(|(k, x)| if k % 3 == 2 { 0.01 * x } else { *x }).collect();
    for inside_out in [false, true] {
        let mut triangles = mesh.connectivity().triangles().to_vec();
        triangles.iter_mut().filter(|_| inside_out).for_each(|t| t.swap(0, 1));
        let plate = TriMesh::new(Vec::clone(&flat), triangles.as_flattened().to_vec()).unwrap();
        let surface = check("plate", &plate);
        for corner in 0..surface.vertices.len() as u32 {
            let (place, normal) = (point(&surface.positions, corner), point(&surface.normals, corner));
            assert!(dot(place, normal) > 0.0, "{normal:?} at {place:?}");
        }
    }
}

#[test]
fn pages_of_a_book_are_sheets_of_their_own() {
    let book = support::book_of_three();
    let surface = check("book", &book);
    // The two vertices of the spine three times, the others once.
    assert_eq!(surface.vertices.len(), 9);
    for t in 0..3 {
        let normal = face(&surface, t);
        let length = dot(normal, normal).sqrt();
        for corner in surface.triangles[t] {
            assert!((dot(point(&surface.normals, corner), normal) / length - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn a_strip_with_one_side_comes_back_turned_over() {
    let (around, across) = (40, 5);
    let mesh = shapes::moebius(around, across).unwrap();
    let surface = check("Möbius strip", &mesh);
    // One seam across, where the vertices are there twice.
    assert_eq!(surface.vertices.len() as u32, (around + 1) * across);
    let klein = shapes::klein_bottle(20, 12).unwrap();
    assert!(check("Klein bottle", &klein).vertices.len() > klein.vertex_count());
}

#[test]
fn vertices_of_many_triangles_are_one_corner() {
    // A cone of 360 triangles, and a bipyramid whose rim is not sharp.
    let rim = |k: u32| [f64::from(k).to_radians().cos(), f64::from(k).to_radians().sin(), 0.0];
    let mut positions: Vec<Point> = (0..360).map(rim).collect();
    positions.extend([[0.0, 0.0, 1.5], [0.0, 0.0, -1.4]]);
    let upper: Vec<[u32; 3]> = (0..360).map(|k| [k, (k + 1) % 360, 360]).collect();
    let cone = support::mesh(&positions[..361], &upper);
    let surface = check("cone", &cone);
    assert_eq!(surface.vertices.len(), 361);
    let top = surface.vertices.iter().position(|&v| v == 360).unwrap() as u32;
    assert!(point(&surface.normals, top)[2].abs() > 0.999_999);
    let lower = (0..360).map(|k| [k, (k + 1) % 360, 361]);
    let mut all = upper.clone();
    all.extend(lower);
    let surface = check("bipyramid", &support::mesh(&positions, &all));
    assert_eq!(surface.vertices.len(), 362);
}

#[test]
fn up_is_z_for_what_lies_flat() {
    let scaled = |by: Point| {
        let mesh = shapes::sphere(2).unwrap();
        let positions = mesh.positions().iter().enumerate().map(|(k, x)| by[k % 3] * x).collect();
        TriMesh::new(positions, mesh.connectivity().triangles().as_flattened().to_vec()).unwrap()
    };
    for (by, up, plane) in [
        ([1.0, 1.0, 1.0], Axis::Y, None),
        ([1.0, 1.0, 0.5], Axis::Z, None),
        ([1.0, 0.5, 1.0], Axis::Y, None),
        ([0.3, 1.0, 0.4], Axis::Y, None),
        ([1.0, 1.0, 0.0], Axis::Z, Some(2)),
        ([1.0, 0.0, 1.0], Axis::Y, Some(1)),
        ([0.0, 1.0, 1.0], Axis::Y, Some(0)),
    ] {
        let surface = Scene::new(&scaled(by)).surface().clone();
        assert_eq!((surface.up, surface.plane), (up, plane), "{by:?}");
    }
}

#[test]
fn meshes_without_extent_have_one() {
    for (positions, triangles) in [
        (vec![[2.0, 2.0, 2.0]; 3], vec![[0, 1, 2]]),
        (vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], vec![[0, 1, 2]]),
        (vec![[0.0; 3], [f64::MIN_POSITIVE, 0.0, 0.0], [0.0, 5e-324, 0.0]], vec![[0, 1, 2]]),
        (vec![[-1e70; 3], [1e70, 1e70, -1e70], [0.0, 1e70, 0.0]], vec![[0, 1, 2]]),
    ] {
        let mesh = support::mesh(&positions, &triangles);
        let surface = Scene::new(&mesh).surface().clone();
        let all = surface.positions.iter().chain(&surface.normals).chain(&surface.center);
        assert!(all.chain([&surface.size, &surface.area]).all(|x| x.is_finite()), "{positions:?}: {surface:?}");
        assert!(surface.size > 0.0);
    }
}
