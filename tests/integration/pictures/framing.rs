//! The whole mesh is in the picture and fills it, from wherever it is seen.

use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::render::{Camera, Scene, SnapshotOptions};

use super::image::{Image, bare, code, coordinate, draw, from};
use crate::support;

fn fits(name: &str, image: &Image, clear: [usize; 2]) {
    let [left, right, top, bottom] = image.extent().unwrap_or_else(|| panic!("{name}: nothing"));
    let sides = [left, image.width - 1 - right, top, image.height - 1 - bottom];
    assert!(sides.iter().all(|&side| side >= 1), "{name} leaves {sides:?} pixels around");
    // Along one axis the mesh touches both of its sides, but for the margin.
    let [across, along] = [sides[0].max(sides[1]), sides[2].max(sides[3])];
    assert!(across <= clear[0] || along <= clear[1], "{name} leaves {sides:?} pixels around");
}

#[test]
fn the_mesh_fills_the_picture() {
    let mut random = Random::new(11);
    for (name, mesh) in support::every_kind() {
        let values = coordinate(&mesh, 0);
        for size in [[160, 120], [90, 160], [300, 50], [120, 120]] {
            let direction = [random.signed(), random.signed(), random.signed()];
            let image = draw(&mesh, &values, &from(direction, bare(size[0], size[1])));
            let clear = size.map(|side| (0.15 * f64::from(side)).ceil() as usize + 2);
            fits(&format!("{name} from {direction:?} in {size:?}"), &image, clear);
        }
    }
}

#[test]
fn solids_and_lines_stay_in_the_picture_too() {
    let mut random = Random::new(12);
    for (name, mesh) in support::every_kind() {
        let values = support::noise(mesh.vertex_count(), 3);
        let scene = Scene::new(&mesh);
        for size in [[160, 120], [90, 160], [80, 80]] {
            for _ in 0..4 {
                let direction = [random.signed(), random.signed(), random.signed()];
                let options = SnapshotOptions { draw: Default::default(), ..bare(size[0], size[1]) };
                let image = Image::decode(&scene.snapshot(&values, &from(direction, options)).unwrap());
                let [left, right, top, bottom] = image.extent().expect("a picture");
                let is_clear = left > 0 && top > 0 && right + 1 < image.width && bottom + 1 < image.height;
                assert!(is_clear, "{name} from {direction:?} in {size:?}: {left} to {right}, {top} to {bottom}");
            }
        }
    }
}

/// A box with a corner marked, so that every view of it is another one.
fn marked() -> (TriMesh, Vec<f64>) {
    let mesh = shapes::torus(30, 20, 0.2).unwrap();
    let values = mesh.positions().chunks_exact(3).map(|p| p[0] + 0.5 * p[1] - 0.3 * p[2]).collect();
    (mesh, values)
}

#[test]
fn only_the_direction_counts() {
    let (mesh, values) = marked();
    let look = |direction: [f64; 3], up: [f64; 3]| {
        let camera = Camera { direction: Some(direction), up: Some(up) };
        draw(&mesh, &values, &SnapshotOptions { camera, ..bare(120, 90) })
    };
    let (direction, up) = ([0.5, -0.25, 1.0], [0.125, 1.0, 0.0]);
    let expected = look(direction, up);
    // Powers of two change nothing but the exponent.
    for scale in [2.0, 2.0_f64.powi(-400), 2.0_f64.powi(600), 2.0_f64.powi(1023), 2.0_f64.powi(-1000)] {
        assert!(look(direction.map(|x| x * scale), up).pixels == expected.pixels, "direction by {scale}");
        assert!(look(direction, up.map(|x| x * scale)).pixels == expected.pixels, "up by {scale}");
    }
    // Subnormal numbers have few digits, and yet a direction.
    let tiny = f64::from_bits(1);
    let image = look([tiny, 0.0, 0.0], [0.0, tiny, 0.0]);
    assert!(image.pixels == look([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).pixels);
    // What is along the direction in `up` does not count.
    let image = look([0.0, 0.0, 1.0], [0.0, 1.0, 5.0]);
    assert!(image.difference(&look([0.0, 0.0, 1.0], [0.0, 1.0, 0.0])).0 < 30);
}

#[test]
fn turning_the_camera_with_the_mesh_changes_nothing() {
    let (mesh, values) = marked();
    // A quarter turn about z, exactly.
    let turn = |[x, y, z]: [f64; 3]| [-y, x, z];
    let turned: Vec<f64> = mesh.positions().as_chunks::<3>().0.iter().flat_map(|&p| turn(p)).collect();
    let other = TriMesh::new(turned, mesh.connectivity().triangles().as_flattened().to_vec()).unwrap();
    for (direction, up) in [([1.0, 0.4, 0.3], [0.0, 0.0, 1.0]), ([-0.2, 0.4, -0.9], [0.3, 0.8, 0.0])] {
        let look = |mesh: &TriMesh, direction, up| {
            let camera = Camera { direction: Some(direction), up: Some(up) };
            draw(mesh, &values, &SnapshotOptions { camera, ..bare(160, 120) })
        };
        let (a, b) = (look(&mesh, direction, up), look(&other, turn(direction), turn(up)));
        let (count, most) = a.difference(&b);
        assert!(count < 100 && most < 40, "{count} pixels differ, by up to {most}");
    }
}

#[test]
fn a_camera_above_sees_from_above() {
    // The default up is along the direction: another axis has to do, whatever the sign.
    for mesh in [shapes::sphere(3).unwrap(), shapes::grid(9, 9).unwrap(), shapes::terrain(20, 20, 3).unwrap()] {
        let values = coordinate(&mesh, 0);
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                // What is plane is not seen from the side.
                if Scene::new(&mesh).surface().plane.is_some_and(|plane| plane != axis) {
                    continue;
                }
                let mut direction = [0.0; 3];
                direction[axis] = sign;
                let image = draw(&mesh, &values, &from(direction, bare(100, 80)));
                let near = draw(&mesh, &values, &from(direction.map(|x| x + 1e-12), bare(100, 80)));
                assert!(image.extent().is_some());
                assert!(image.difference(&near).0 < 200, "axis {axis}: a little aside looks otherwise");
            }
        }
    }
}

#[test]
fn a_camera_without_direction_is_refused() {
    let (mesh, values) = marked();
    let refused = |camera: Camera| {
        let options = SnapshotOptions { camera, ..bare(60, 50) };
        code(morse_smooth::render::snapshot(&mesh, &values, &options))
    };
    let ok = [0.0, 0.0, 1.0];
    for bad in [
        [0.0; 3],
        [-0.0; 3],
        [f64::NAN, 0.0, 1.0],
        [f64::INFINITY, 0.0, 0.0],
        [1.0, f64::NEG_INFINITY, 0.0],
        [f64::NAN; 3],
    ] {
        assert_eq!(refused(Camera { direction: Some(bad), up: None }), "InvalidOption", "{bad:?}");
        assert_eq!(refused(Camera { direction: Some(ok), up: Some(bad) }), "InvalidOption", "{bad:?}");
        assert_eq!(refused(Camera { direction: None, up: Some(bad) }), "InvalidOption", "{bad:?}");
    }
    for up in [ok, [0.0, 0.0, -7.0], [1e-9, 0.0, 1.0], [0.0, 0.0, 1e300]] {
        assert_eq!(refused(Camera { direction: Some(ok), up: Some(up) }), "InvalidOption", "{up:?} is along");
    }
    assert_eq!(refused(Camera { direction: Some(ok), up: Some([1e-3, 0.0, 1.0]) }), "a picture");
}

#[test]
fn up_is_up_and_right_is_right() {
    // A mesh with a small tile on the right and a smaller one above.
    let mesh = super::image::united(&[
        super::image::tile(0.0, 0.0, 0.0, 0.2),
        super::image::tile(1.0, 0.0, 0.0, 0.1),
        super::image::tile(0.0, 0.8, 0.0, 0.05),
    ]);
    let values: Vec<f64> = (0..12).map(|v| f64::from(v / 4)).collect();
    // The colors of the three tiles.
    let mean = |image: &Image, tile: usize| {
        let list = morse_smooth::render::Colormap::Viridis.color(tile as f64 / 2.0);
        let near = image.places(|pixel| (0..3).all(|c| pixel[c].abs_diff(list[c]) < 45));
        assert!(near.len() > 20, "{}", near.len());
        [0, 1].map(|i| near.iter().map(|place| place[i] as f64).sum::<f64>() / near.len() as f64)
    };
    for (direction, up, right) in [
        ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0]),
        ([0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [-1.0, 0.0]),
        ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0]),
        ([0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [-1.0, 0.0]),
        ([0.3, 0.2, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0]),
    ] {
        let camera = Camera { direction: Some(direction), up: Some(up) };
        let image = draw(&mesh, &values, &SnapshotOptions { camera, ..bare(240, 200) });
        let (middle, to_right) = (mean(&image, 0), mean(&image, 1));
        let found = [to_right[0] - middle[0], to_right[1] - middle[1]];
        let length = found[0].hypot(found[1]);
        let along = (found[0] * right[0] + found[1] * right[1]) / length;
        assert!(along > 0.95, "from {direction:?}, {up:?} up, x goes along {found:?}");
        // y likewise, by the cross product of what goes right and up in the picture.
        let above = mean(&image, 2);
        let found_up = [above[0] - middle[0], above[1] - middle[1]];
        let turn = found[0] * -found_up[1] + found[1] * found_up[0];
        assert!(turn * direction[2] > 0.0, "from {direction:?}, {up:?} up: mirrored");
    }
}
