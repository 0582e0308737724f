//! A plane seen straight on is a drawing to scale, and everything about it is known.

use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes;
use morse_smooth::render::{Colormap, DrawOptions, Glyphs, Levels, Scene, SnapshotOptions};

use super::image::{Image, Part, bare, coordinate, draw, error, from, lit, tile, united};
use super::tracer::{Eye, coverage};
use crate::support::mesh;

/// Left, right, upper and lower edge of an upright rectangle, from how much of the pixels on them it covers.
pub(crate) fn edges(image: &Image) -> [f64; 4] {
    let [left, right, top, bottom] = image.extent().expect("something");
    let (column, row) = ((left + right) / 2, (top + bottom) / 2);
    // How much of the outermost pixel is not background, by the pixel beside it.
    let part = |[x, y]: [usize; 2], [u, v]: [usize; 2]| {
        let dark = |[x, y]: [usize; 2]| image.at(x, y).iter().map(|&byte| 255.0 - f64::from(byte)).sum::<f64>();
        (dark([x, y]) / dark([u, v])).min(1.0)
    };
    [
        left as f64 + 1.0 - part([left, row], [left + 1, row]),
        right as f64 + part([right, row], [right - 1, row]),
        top as f64 + 1.0 - part([column, top], [column, top + 1]),
        bottom as f64 + part([column, bottom], [column, bottom - 1]),
    ]
}

#[test]
fn colors_are_those_of_the_values_in_the_light() {
    let mesh = shapes::grid(9, 7).unwrap();
    for (axis, map) in [(0, Colormap::Viridis), (1, Colormap::CoolWarm), (0, Colormap::Magma)] {
        let values = coordinate(&mesh, axis);
        let mut options = bare(400, 300);
        options.draw.colormap = map;
        let image = draw(&mesh, &values, &options);
        let light = Scene::new(&mesh).draw_list(&values, &options.draw).unwrap().light;
        let [left, right, top, bottom] = edges(&image);
        // A square, in the middle.
        assert!((right - left - (bottom - top)).abs() < 0.2, "{left} {right} {top} {bottom}");
        assert!((left + right - 400.0).abs() < 0.2 && (top + bottom - 300.0).abs() < 0.2);
        for y in (top as usize + 2)..(bottom as usize - 2) {
            for x in (left as usize + 2)..(right as usize - 2) {
                let along = [(x as f64 + 0.5 - left) / (right - left), (bottom - y as f64 - 0.5) / (bottom - top)];
                let expected = lit(map.color(along[axis]), &light, [0.0, 0.0, 1.0]);
                let found = error(image.at(x, y), expected);
                assert!(found <= 3.0, "{map:?} at {x}, {y}: {:?}, not {expected:?}", image.at(x, y));
            }
        }
    }
}

#[test]
fn a_range_bounds_the_colors() {
    let mesh = shapes::grid(3, 3).unwrap();
    let values: Vec<f64> = coordinate(&mesh, 0).iter().map(|x| 10.0 * x).collect();
    let mut options = bare(200, 200);
    options.draw.range = Some([4.0, 6.0]);
    let image = draw(&mesh, &values, &options);
    let light = Scene::new(&mesh).draw_list(&values, &options.draw).unwrap().light;
    let [left, right, ..] = edges(&image);
    for x in (left as usize + 2)..(right as usize - 2) {
        let value = 10.0 * (x as f64 + 0.5 - left) / (right - left);
        let expected = lit(Colormap::Viridis.color((value - 4.0) / 2.0), &light, [0.0, 0.0, 1.0]);
        assert!(error(image.at(x, 100), expected) <= 6.0, "at {value}: {:?}, not {expected:?}", image.at(x, 100));
    }
}

#[test]
fn bands_end_where_the_field_crosses_a_level() {
    let mesh = shapes::grid(8, 8).unwrap();
    let values = coordinate(&mesh, 0);
    for (levels, ends) in [
        (Levels::Count(4), vec![0.0, 0.2, 0.4, 0.6, 0.8, 1.0]),
        (Levels::At(&[0.83, 0.21, 0.5, 0.5]), vec![0.0, 0.21, 0.5, 0.83, 1.0]),
        (Levels::At(&[-3.0, 7.0]), vec![0.0, 1.0]),
    ] {
        let mut options = bare(420, 300);
        options.draw.bands = true;
        options.draw.levels = levels;
        let image = draw(&mesh, &values, &options);
        let light = Scene::new(&mesh).draw_list(&values, &options.draw).unwrap().light;
        let [left, right, top, bottom] = edges(&image);
        for part in ends.windows(2) {
            let expected = lit(Colormap::Viridis.color(0.5 * (part[0] + part[1])), &light, [0.0, 0.0, 1.0]);
            let [from, to] = [0, 1].map(|k| left + part[k] * (right - left));
            for y in [top as usize + 3, 140, bottom as usize - 3] {
                // The lines are less than a pixel wide.
                for x in (from + 1.5).ceil() as usize..(to - 2.0) as usize {
                    let found = image.at(x, y);
                    assert!(error(found, expected) <= 2.0, "{part:?} at {x}: {found:?}, not {expected:?}");
                }
            }
        }
    }
}

#[test]
fn edges_are_smoothed_by_how_much_of_a_pixel_they_cover() {
    let triangle = mesh(&[[0.0, 0.0, 0.0], [4.0, 0.7, 0.0], [1.1, 3.0, 0.0]], &[[0, 1, 2]]);
    let values = [0.0; 3];
    let options = from([0.0, 0.0, 1.0], bare(180, 140));
    let image = draw(&triangle, &values, &options);
    let scene = Scene::new(&triangle);
    let eye = Eye::framing(scene.surface(), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 180.0, 140.0);
    let corners = [0, 1, 2].map(|k| eye.project(scene.surface().place(triangle.position(k))));
    let inside = image.at(eye.middle_of(&corners)[0] as usize, eye.middle_of(&corners)[1] as usize);
    let (mut sum, mut exact, mut differences, mut partial) = (0.0, 0.0, 0.0, 0);
    for y in 0..image.height {
        for x in 0..image.width {
            let covered = coverage(&corners, x as f64, y as f64);
            let mean = |pixel: [u8; 3]| 255.0 - pixel.iter().map(|&byte| f64::from(byte)).sum::<f64>() / 3.0;
            let found = mean(image.at(x, y)) / mean(inside);
            // Sixteen samples in four rows and columns: an edge may miss or take a whole row of them.
            assert!((found - covered).abs() < 0.14, "at {x}, {y}: {found}, not {covered}");
            if covered > 0.0 && covered < 1.0 {
                differences += (found - covered).abs();
                partial += 1;
            }
            sum += found;
            exact += covered;
        }
    }
    assert!(partial > 200);
    assert!(differences / f64::from(partial) < 0.04, "{} on average", differences / f64::from(partial));
    assert!((sum / exact - 1.0).abs() < 2e-3, "{sum} pixels, not {exact}");
}

#[test]
fn neighbours_leave_no_gap() {
    // All of one color: an edge inside would show.
    let values = vec![1.0; 400];
    let grid = shapes::grid(20, 20).unwrap();
    let mut random = shapes::Random::new(3);
    let mut positions = grid.positions().to_vec();
    for p in positions.chunks_exact_mut(3).filter(|p| p[..2].iter().all(|&x| x > 0.0 && x < 1.0)) {
        p[0] += 0.02 * random.signed();
        p[1] += 0.02 * random.signed();
    }
    let flat = TriMesh::new(positions, grid.connectivity().triangles().as_flattened().to_vec()).unwrap();
    let image = draw(&flat, &values, &from([0.0, 0.0, 1.0], bare(163, 121)));
    let [left, right, top, bottom] = image.extent().expect("a square");
    let expected = image.at(80, 60);
    for y in top + 1..bottom {
        for x in left + 1..right {
            assert_eq!(image.at(x, y), expected, "at {x}, {y}");
        }
    }
}

/// Small tiles that span a box, so that what is inside does not change what the camera sees.
fn corners_of_a_box() -> Vec<Part> {
    vec![tile(-2.0, -1.5, -1.0, 0.05), tile(2.0, 1.5, 1.0, 0.05)]
}

fn with(parts: &[Part]) -> TriMesh {
    let mut all = corners_of_a_box();
    all.extend_from_slice(parts);
    united(&all)
}

#[test]
fn what_is_hidden_leaves_no_trace() {
    let front = tile(0.0, 0.0, 0.5, 0.8);
    let behind = tile(0.05, 0.02, 0.4, 0.7);
    let values = |mesh: &TriMesh| coordinate(mesh, 2);
    for (width, height) in [(200, 150), (90, 160)] {
        let everything = SnapshotOptions { draw: DrawOptions::default(), ..bare(width, height) };
        for options in [bare(width, height), everything] {
            let options = from([0.0, 0.0, 1.0], options);
            let mut options = SnapshotOptions { ..options };
            options.draw.range = Some([-1.0, 1.0]);
            options.draw.critical_points = Glyphs::None;
            let (alone, both) = (with(std::slice::from_ref(&front)), with(&[front.clone(), behind.clone()]));
            let [a, b] = [&alone, &both].map(|mesh| draw(mesh, &values(mesh), &options));
            assert!(a.pixels == b.pixels, "{:?}", a.difference(&b));
            // Seen from the other side it is there.
            let [a, b] = [&alone, &both].map(|mesh| draw(mesh, &values(mesh), &from([0.0, 0.0, -1.0], options)));
            assert!(a.difference(&b).0 > 300);
        }
    }
}

#[test]
fn the_nearer_one_of_two_is_seen_however_near() {
    for gap in [0.5, 1e-2, 1e-4] {
        let mesh = with(&[tile(0.0, 0.0, 0.0, 0.9), tile(0.0, 0.0, gap, 0.5)]);
        // The tiles have the values 2 and 3.
        let values: Vec<f64> = (0..16).map(|v| f64::from(v / 4)).collect();
        let (near, far) = (1.0, 2.0 / 3.0);
        let image = draw(&mesh, &values, &from([0.0, 0.0, 1.0], bare(200, 150)));
        let light = Scene::new(&mesh).draw_list(&values, &bare(1, 1).draw).unwrap().light;
        for (place, value) in [([75, 85], near), ([100, 80], near), ([50, 80], far), ([90, 55], far)] {
            let expected = lit(Colormap::Viridis.color(value), &light, [0.0, 0.0, 1.0]);
            let found = image.at(place[0], place[1]);
            assert!(error(found, expected) <= 2.0, "gap {gap}, at {place:?}: {found:?}, not {expected:?}");
        }
    }
}

#[test]
fn a_constant_field_has_the_middle_color_and_no_lines() {
    let mesh = shapes::grid(4, 4).unwrap();
    for value in [0.0, -3.0, 1e300, 5e-324] {
        let values = vec![value; 16];
        let mut options = bare(100, 80);
        options.draw.levels = Levels::Count(15);
        let image = draw(&mesh, &values, &options);
        let light = Scene::new(&mesh).draw_list(&values, &options.draw).unwrap().light;
        let expected = lit(Colormap::Viridis.color(0.5), &light, [0.0, 0.0, 1.0]);
        for y in 20..60 {
            for x in 30..70 {
                assert!(error(image.at(x, y), expected) <= 2.0, "{value}: {:?}, not {expected:?}", image.at(x, y));
            }
        }
    }
}
