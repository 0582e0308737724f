//! Where a mesh is, how large it is, how its triangles are turned and numbered: the picture is the same.

use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::render::{Camera, Levels, Scene, SnapshotOptions, snapshot};

use super::image::{Image, bare, coordinate, draw, from};
use crate::support::{self, shuffle};

fn everything<'a>(width: u32, height: u32) -> SnapshotOptions<'a> {
    SnapshotOptions { draw: Default::default(), ..bare(width, height) }
}

fn moved(mesh: &TriMesh, scale: f64, by: f64) -> TriMesh {
    let positions = mesh.positions().iter().map(|x| scale * x + by).collect();
    TriMesh::new(positions, mesh.connectivity().triangles().as_flattened().to_vec()).unwrap()
}

fn meshes() -> Vec<(&'static str, TriMesh)> {
    vec![
        ("torus", shapes::torus(30, 18, 0.2).unwrap()),
        ("terrain", shapes::terrain(20, 20, 5).unwrap()),
        ("Möbius strip", shapes::moebius(30, 6).unwrap()),
        ("book", support::book_of_three()),
        ("one triangle", support::complex(3, &[[0, 1, 2]])),
    ]
}

#[test]
fn repeated_calls_give_the_same_bytes() {
    let mesh = shapes::torus(30, 18, 0.2).unwrap();
    let values = support::noise(mesh.vertex_count(), 5);
    let options = SnapshotOptions { width: 200, height: 150, ..SnapshotOptions::default() };
    let first = snapshot(&mesh, &values, &options).unwrap();
    let scene = Scene::new(&mesh);
    for _ in 0..3 {
        assert!(scene.snapshot(&values, &options).unwrap() == first);
        scene.snapshot(&coordinate(&mesh, 1), &everything(64, 64)).unwrap();
    }
    assert!(snapshot(&mesh, &values, &options).unwrap() == first);
}

#[test]
fn sizes_do_not_count() {
    for (name, mesh) in meshes() {
        let values = support::noise(mesh.vertex_count(), 7);
        let expected = draw(&mesh, &values, &everything(160, 120));
        // Powers of two are exact, and the picture is the same to the last bit.
        for exponent in [-330, -40, 10, 200] {
            let other = moved(&mesh, 2.0_f64.powi(exponent), 0.0);
            assert!(draw(&other, &values, &everything(160, 120)).pixels == expected.pixels, "{name} by 2^{exponent}");
        }
        for scale in [1e-100, 1e60, 3.7] {
            let (count, _) = draw(&moved(&mesh, scale, 0.0), &values, &everything(160, 120)).difference(&expected);
            assert!(count < 40, "{name} by {scale}: {count} pixels differ");
        }
    }
}

#[test]
fn values_may_have_any_unit() {
    let mesh = shapes::torus(30, 18, 0.2).unwrap();
    let values = support::noise(mesh.vertex_count(), 7);
    let expected = draw(&mesh, &values, &everything(160, 120));
    for exponent in [-900, -40, 10, 900] {
        let other: Vec<f64> = values.iter().map(|x| x * 2.0_f64.powi(exponent)).collect();
        assert!(draw(&mesh, &other, &everything(160, 120)).pixels == expected.pixels, "values by 2^{exponent}");
    }
}

#[test]
fn places_do_not_count() {
    for (name, mesh) in meshes() {
        let values = coordinate(&mesh, 1);
        let expected = draw(&mesh, &values, &everything(160, 120));
        for by in [-3.0, 1e6, -1e8] {
            // Last bits decide which of two points of a line that are nearly one is left out.
            let image = draw(&moved(&mesh, 1.0, by), &values, &everything(160, 120));
            let (count, most) = image.difference_above(&expected, 12);
            assert!(count < 20, "{name} moved by {by}: {count} pixels differ, by up to {most}");
        }
    }
}

#[test]
fn the_turn_of_triangles_does_not_count() {
    for (name, mesh) in [
        ("torus", shapes::torus(30, 18, 0.2).unwrap()),
        ("sphere", shapes::sphere(3).unwrap()),
        ("islands", support::islands()),
        ("two tetrahedra at a vertex", support::two_tetrahedra_at_a_vertex()),
    ] {
        // Lines run the other way where triangles do, and are rounded from their other end: up to a part of a pixel.
        let values = support::noise(mesh.vertex_count(), 9);
        let mut options = everything(160, 120);
        options.draw.levels = Levels::None;
        let expected = draw(&mesh, &values, &options);
        for seed in 0..6 {
            let mut random = Random::new(seed);
            let mut triangles = mesh.connectivity().triangles().to_vec();
            for t in &mut triangles {
                if seed == 0 || random.uniform() < 0.5 {
                    t.swap(1, 2);
                }
            }
            let other = TriMesh::new(mesh.positions().to_vec(), triangles.as_flattened().to_vec()).unwrap();
            let image = draw(&other, &values, &options);
            assert!(image.pixels == expected.pixels, "{name}, seed {seed}: {:?}", image.difference(&expected));
            let height = coordinate(&mesh, 0);
            let [a, b] = [&mesh, &other].map(|mesh| draw(mesh, &height, &everything(160, 120)));
            let (count, most) = a.difference_above(&b, 32);
            assert!(count < 200 && most < 80, "{name}, seed {seed}: {count} pixels differ, by up to {most}");
        }
    }
}

#[test]
fn an_open_sheet_is_drawn_as_most_of_it_is_turned() {
    // Solids stand on that side; the surface itself looks alike from both.
    let mesh = shapes::terrain(20, 20, 5).unwrap();
    let values = coordinate(&mesh, 0);
    let mut triangles = mesh.connectivity().triangles().to_vec();
    for t in triangles.iter_mut().step_by(3) {
        t.swap(0, 1);
    }
    let other = TriMesh::new(mesh.positions().to_vec(), triangles.as_flattened().to_vec()).unwrap();
    let [a, b] = [&mesh, &other].map(|mesh| draw(mesh, &values, &everything(160, 120)));
    assert!(a.pixels == b.pixels, "{:?}", a.difference(&b));
    for t in &mut triangles {
        t.swap(0, 1);
    }
    let other = TriMesh::new(mesh.positions().to_vec(), triangles.as_flattened().to_vec()).unwrap();
    let [a, b] = [&mesh, &other].map(|mesh| draw(mesh, &values, &bare(160, 120)));
    assert!(a.pixels == b.pixels, "{:?}", a.difference(&b));
}

#[test]
fn the_order_of_triangles_and_corners_does_not_count() {
    for (name, mesh) in [("torus", shapes::torus(30, 18, 0.2).unwrap()), ("cube", super::surfaces::cube())] {
        let values = coordinate(&mesh, 0);
        let expected = draw(&mesh, &values, &everything(160, 120));
        let mut random = Random::new(4);
        let mut triangles = mesh.connectivity().triangles().to_vec();
        shuffle(&mut triangles, &mut random);
        for t in &mut triangles {
            t.rotate_left((3.0 * random.uniform()) as usize);
        }
        let other = TriMesh::new(mesh.positions().to_vec(), triangles.as_flattened().to_vec()).unwrap();
        // Sums round otherwise, on an edge the first triangle wins, and lines begin elsewhere.
        let (count, most) = draw(&other, &values, &everything(160, 120)).difference_above(&expected, 32);
        assert!(count < 200 && most < 80, "{name}: {count} pixels differ, by up to {most}");
        let [a, b] = [&mesh, &other].map(|mesh| draw(mesh, &values, &bare(160, 120)));
        let (count, most) = a.difference(&b);
        assert!(count < 60 && most < 40, "{name}: {count} pixels differ, by up to {most}");
    }
}

#[test]
fn from_the_back_an_open_surface_is_its_mirror_image() {
    // The same light falls on it: what was on the left is on the right.
    let mesh = shapes::grid(9, 9).unwrap();
    let values = coordinate(&mesh, 0);
    let look = |z: f64| {
        let camera = Camera { direction: Some([0.0, 0.0, z]), up: Some([0.0, 1.0, 0.0]) };
        draw(&mesh, &values, &SnapshotOptions { camera, ..bare(160, 120) })
    };
    let (front, back) = (look(1.0), look(-1.0));
    let pixels = (0..front.pixels.len()).map(|k| back.at(159 - k % 160, k / 160)).collect();
    let mirrored = Image { pixels, ..front };
    let (count, most) = front.difference(&mirrored);
    assert!(most <= 2, "{count} pixels differ by up to {most}");
}

#[test]
fn vertices_of_no_triangle_do_not_count() {
    let mesh = shapes::torus(20, 12, 0.2).unwrap();
    let values = coordinate(&mesh, 0);
    let mut positions = mesh.positions().to_vec();
    positions.extend([1e9, -1e9, 3.0, 0.0, 0.0, 0.0]);
    let other = TriMesh::new(positions, mesh.connectivity().triangles().as_flattened().to_vec()).unwrap();
    let mut more = values.clone();
    more.extend([1e9, -1e9]);
    for options in [everything(160, 120), from([1.0, 2.0, 3.0], everything(90, 120))] {
        let [a, b] = [(&mesh, &values), (&other, &more)].map(|(mesh, values)| draw(mesh, values, &options));
        assert!(a.pixels == b.pixels, "{:?}", a.difference(&b));
    }
}

#[test]
fn triangles_without_area_do_not_count() {
    let mesh = shapes::torus(20, 12, 0.2).unwrap();
    let values = coordinate(&mesh, 0);
    let options = from([1.0, 2.0, 3.0], bare(160, 120));
    let expected = draw(&mesh, &values, &options);
    // On three corners that lie on a line, apart from the surface's edges: a triangle of its own with a copy of two vertices.
    let mut positions = mesh.positions().to_vec();
    let (p, q) = (mesh.position(0), mesh.position(40));
    positions.extend(p);
    positions.extend(p);
    positions.extend(q);
    let n = mesh.vertex_count() as u32;
    let mut triangles = mesh.connectivity().triangles().as_flattened().to_vec();
    triangles.extend([n, n + 1, n + 2]);
    let other = TriMesh::new(positions, triangles).unwrap();
    let mut more = values.clone();
    more.extend([values[0], values[0], values[40]]);
    let image = draw(&other, &more, &options);
    assert!(image.pixels == expected.pixels, "{:?}", image.difference(&expected));
}
