//! Pictures of shapes whose outline is known.

use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::render::{Camera, Colormap, Scene, SnapshotOptions};

use super::image::{Image, WHITE, bare, coordinate, draw, error, from, lit};
use super::planes::edges;
use super::surfaces::cube;
use crate::support;

/// A sphere of circles of latitude, with poles of that many triangles.
fn globe(rings: u32, sectors: u32) -> TriMesh {
    let mut positions = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let mut triangles = Vec::new();
    let at = |i: u32, j: u32| 2 + i * sectors + j % sectors;
    for i in 0..rings {
        let (sin, cos) = (std::f64::consts::PI * f64::from(i + 1) / f64::from(rings + 1)).sin_cos();
        for j in 0..sectors {
            let (y, x) = (std::f64::consts::TAU * f64::from(j) / f64::from(sectors)).sin_cos();
            positions.push([sin * x, sin * y, cos]);
            if i == 0 {
                triangles.extend([[0, at(0, j), at(0, j + 1)], [1, at(rings - 1, j + 1), at(rings - 1, j)]]);
            } else {
                let (a, b, c, d) = (at(i - 1, j), at(i, j), at(i, j + 1), at(i - 1, j + 1));
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    support::mesh(&positions, &triangles)
}

#[test]
fn a_sphere_is_a_disc_with_the_light_of_a_sphere() {
    let (even, polar) = (shapes::sphere(6).unwrap(), globe(120, 360));
    // The last one looks at a pole of valence 360.
    for (mesh, direction) in [(&even, [0.0, 0.0, 1.0]), (&even, [1.0, -2.0, 0.5]), (&polar, [0.1, 0.2, 1.0])] {
        let values = vec![0.0; mesh.vertex_count()];
        let options = from(direction, bare(220, 200));
        let image = draw(mesh, &values, &options);
        let light = Scene::new(mesh).draw_list(&values, &options.draw).unwrap().light;
        let [left, right, top, bottom] = edges(&image);
        assert!((right - left - (bottom - top)).abs() < 0.5);
        let (x, y, radius) = (0.5 * (left + right), 0.5 * (top + bottom), 0.25 * (right - left + bottom - top));
        // The silhouette of the unit sphere from distance d has the slope 1 / √(d² − 1).
        let focus = 100.0 / 15.0_f64.to_radians().tan();
        let d = (1.0 + (focus / radius).powi(2)).sqrt();
        let color = Colormap::Viridis.color(0.5);
        for row in 0..200 {
            for column in 0..220 {
                let (u, v) = (column as f64 + 0.5 - x, y - row as f64 - 0.5);
                let r = u.hypot(v);
                let found = image.at(column, row);
                if r > radius + 1.0 {
                    assert_eq!(found, WHITE, "at {column}, {row}");
                } else if r < radius - 2.0 {
                    // The nearer end of the ray: |(s·u/f, s·v/f, d − s)| = 1.
                    let slope = (u * u + v * v) / (focus * focus);
                    let s = (d - (1.0 - slope * (d * d - 1.0)).sqrt()) / (1.0 + slope);
                    let expected = lit(color, &light, [s * u / focus, s * v / focus, d - s]);
                    assert!(error(found, expected) <= 3.0, "at {column}, {row}: {found:?}, not {expected:?}");
                }
            }
        }
    }
}

#[test]
fn a_cube_shows_three_sides_of_one_brightness_each() {
    let mesh = cube();
    let options = SnapshotOptions {
        camera: Camera { direction: Some([1.0, 1.1, 1.2]), up: Some([0.0, 0.0, 1.0]) },
        ..bare(200, 200)
    };
    let image = draw(&mesh, &[0.0; 8], &options);
    let mut counts = std::collections::BTreeMap::new();
    for pixel in image.pixels.iter().filter(|&&pixel| pixel != WHITE) {
        *counts.entry(*pixel).or_insert(0) += 1;
    }
    let mut largest: Vec<usize> = counts.values().copied().collect();
    largest.sort_unstable_by(|a, b| b.cmp(a));
    let all: usize = largest.iter().sum();
    assert!(largest[..3].iter().sum::<usize>() > 9 * all / 10, "{largest:?} of {all}");
    assert!(largest[2] > all / 6);
}

#[test]
fn a_torus_has_its_hole() {
    let mesh = shapes::torus(90, 60, 0.0).unwrap();
    let image = draw(&mesh, &coordinate(&mesh, 0), &from([0.0, 0.0, 1.0], bare(300, 300)));
    let [left, right, ..] = edges(&image);
    let hole = (0..300).filter(|&x| image.at(x, 150) == WHITE && x as f64 > left && (x as f64) < right).count() as f64;
    // Radii 1.4 and 0.6 at nearly the same distance: the silhouettes are seen at heights within 0.4.
    assert!((hole / (right - left) - 0.6 / 1.4).abs() < 0.03, "{hole} of {}", right - left);
}

#[test]
fn two_components_are_two_things() {
    let mesh = support::islands();
    let image = draw(&mesh, &coordinate(&mesh, 0), &from([1.0, -1.0, 0.0], bare(200, 200)));
    // Pixels that hang together.
    let mut seen: Vec<bool> = image.pixels.iter().map(|&pixel| pixel == WHITE).collect();
    let mut parts = 0;
    for start in 0..seen.len() {
        let mut stack = vec![start];
        parts += usize::from(!seen[start]);
        while let Some(k) = stack.pop() {
            if std::mem::replace(&mut seen[k], true) {
                continue;
            }
            let (x, y) = (k % 200, k / 200);
            let beside = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
            stack.extend(beside.into_iter().filter(|&(x, y)| x < 200 && y < 200).map(|(x, y)| y * 200 + x));
        }
    }
    assert_eq!(parts, 2);
}

/// A mesh, seen from several sides with all there is to draw.
fn draws(name: &str, mesh: &TriMesh) {
    let values = support::noise(mesh.vertex_count(), 2);
    for direction in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.3, 0.2], [0.0, 1.0, 0.0]] {
        let options = from(direction, SnapshotOptions { draw: Default::default(), ..bare(120, 90) });
        let image = draw(mesh, &values, &options);
        assert!(image.extent().is_some(), "{name} from {direction:?}: nothing");
    }
}

#[test]
fn odd_meshes_are_drawn() {
    for (name, mesh) in support::every_kind() {
        draws(name, &mesh);
    }
    draws("pinched", &support::random_surface(3, &shapes::sphere(3).unwrap(), 0.5));
    draws(
        "in a line",
        &support::mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2], [0, 1, 3]]),
    );
}

#[test]
fn meshes_without_area_are_no_error() {
    for positions in [[[1.0; 3]; 3], [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]] {
        let mesh = support::mesh(&positions, &[[0, 1, 2]]);
        let options = SnapshotOptions { draw: Default::default(), ..bare(50, 40) };
        let image = draw(&mesh, &[0.0, 1.0, 2.0], &options);
        assert_eq!((image.width, image.height), (50, 40));
    }
}

#[test]
fn the_silhouette_is_the_same_from_both_ends_of_a_long_lens() {
    // From opposite directions the outline of a small thing is mirrored, and so about equally large.
    let mesh = shapes::trefoil_tube(60, 12, 0.0).unwrap();
    let values = coordinate(&mesh, 0);
    let count = |image: Image| image.places(|pixel| pixel != WHITE).len() as f64;
    let [a, b] = [1.0, -1.0].map(|z| count(draw(&mesh, &values, &from([0.2 * z, 0.1 * z, z], bare(200, 200)))));
    assert!((a / b - 1.0).abs() < 0.2, "{a} and {b} pixels");
}
