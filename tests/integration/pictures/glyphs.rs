//! Minima, saddles and maxima, told apart without color.

use morse_smooth::field::{CriticalKind, CriticalPoint};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::render::{Glyphs, Levels, Role, Scene, Shape, SnapshotOptions};

use super::image::{Image, bare, coordinate, draw, from};
use super::planes::edges;

fn point(vertex: u32, kind: CriticalKind) -> CriticalPoint {
    CriticalPoint { vertex, kind, multiplicity: 1, on_boundary: false }
}

const KINDS: [CriticalKind; 3] = [CriticalKind::Minimum, CriticalKind::Saddle, CriticalKind::Maximum];

/// A plane with one point in its middle; which pixels the point covers.
fn silhouette(kind: CriticalKind, direction: [f64; 3], side: u32) -> (Vec<[f64; 2]>, Image) {
    let mesh = shapes::grid(9, 9).unwrap();
    let values = vec![0.0; 81];
    let mut options = from(direction, bare(side, side));
    let without = draw(&mesh, &values, &options);
    let points = [point(40, kind)];
    options.draw.critical_points = Glyphs::Points(&points);
    let with = draw(&mesh, &values, &options);
    let places = (0..with.pixels.len()).filter(|&k| with.pixels[k] != without.pixels[k]);
    (places.map(|k| [(k % side as usize) as f64, (k / side as usize) as f64]).collect(), with)
}

fn area(polygon: &[[f64; 2]]) -> f64 {
    let twice: f64 = (0..polygon.len())
        .map(|k| {
            let (p, q) = (polygon[k], polygon[(k + 1) % polygon.len()]);
            p[0] * q[1] - p[1] * q[0]
        })
        .sum();
    0.5 * twice.abs()
}

/// The largest polygon with so many corners in the directions of a regular one, over all turns: a measure of the shape.
fn filled_by(points: &[[f64; 2]], corners: usize) -> f64 {
    let mut best = 0.0_f64;
    for turn in 0..60 {
        let polygon: Vec<[f64; 2]> = (0..corners)
            .map(|k| {
                let angle = std::f64::consts::TAU * (k as f64 + f64::from(turn) / 60.0) / corners as f64;
                let (sin, cos) = angle.sin_cos();
                let along = |p: &[f64; 2]| p[0] * cos + p[1] * sin;
                *points.iter().max_by(|p, q| along(p).total_cmp(&along(q))).unwrap()
            })
            .collect();
        best = best.max(area(&polygon));
    }
    best / points.len() as f64
}

#[test]
fn from_above_they_are_a_triangle_a_square_and_a_disc() {
    // How much of the silhouette the largest inscribed triangle and quadrangle fill: all of a triangle; half and all of a square;
    // 3√3/4π = 0.41 and 2/π = 0.64 of a disc.
    for direction in [[0.0, 0.0, 1.0], [0.1, 0.15, 1.0]] {
        for (kind, three, four) in [
            (CriticalKind::Minimum, 0.85..1.05, 0.85..1.1),
            (CriticalKind::Saddle, 0.4..0.6, 0.85..1.05),
            (CriticalKind::Maximum, 0.35..0.47, 0.55..0.7),
        ] {
            let (points, _) = silhouette(kind, direction, 900);
            assert!(points.len() > 300, "{kind:?}: {} pixels", points.len());
            let found = [filled_by(&points, 3), filled_by(&points, 4)];
            assert!(three.contains(&found[0]) && four.contains(&found[1]), "{kind:?} from {direction:?}: {found:?}");
        }
    }
}

#[test]
fn they_look_about_equally_large() {
    for direction in [[0.0, 0.0, 1.0], [0.4, 0.3, 1.0], [1.0, 0.2, 0.6]] {
        let sizes = KINDS.map(|kind| silhouette(kind, direction, 450).0.len() as f64);
        let (least, most) = (sizes[0].min(sizes[1]).min(sizes[2]), sizes[0].max(sizes[1]).max(sizes[2]));
        assert!(most < 1.9 * least, "from {direction:?}: {sizes:?} pixels");
    }
}

#[test]
fn on_an_open_surface_they_stand_on_the_side_that_is_looked_at() {
    for kind in KINDS {
        for direction in [[0.0, 0.0, 1.0], [0.3, -0.2, 1.0]] {
            let [front, back] =
                [1.0, -1.0].map(|sign| silhouette(kind, direction.map(|x| sign * x), 450).0.len() as f64);
            assert!((front / back - 1.0).abs() < 0.1, "{kind:?}: {front} and {back} pixels");
        }
    }
}

#[test]
fn a_rim_keeps_them_apart_from_any_color() {
    for kind in KINDS {
        let (points, image) = silhouette(kind, [0.0, 0.0, 1.0], 600);
        let rows: Vec<f64> = points.iter().map(|p| p[1]).collect();
        let middle = rows.iter().sum::<f64>() / rows.len() as f64;
        let row: Vec<[u8; 3]> =
            points.iter().filter(|p| p[1] == middle.round()).map(|p| image.at(p[0] as usize, p[1] as usize)).collect();
        let light = |color: [u8; 3]| color.iter().map(|&byte| u32::from(byte)).sum::<u32>();
        // Dark, the color, dark.
        let (first, last) = (light(row[1]), light(row[row.len() - 2]));
        let brightest = row.iter().map(|&color| light(color)).max().unwrap();
        assert!(first < 130 && last < 130 && brightest > 260, "{kind:?}: {first} {brightest} {last}");
    }
}

#[test]
fn they_stand_at_their_vertices() {
    let mesh = shapes::grid(9, 9).unwrap();
    let values = coordinate(&mesh, 0);
    let scene = Scene::new(&mesh);
    let plain = draw(&mesh, &values, &bare(450, 450));
    let [left, right, top, bottom] = edges(&plain);
    for vertex in [20_u32, 33, 40, 59] {
        for kind in KINDS {
            let points = [point(vertex, kind)];
            let mut options = bare(450, 450);
            options.draw.critical_points = Glyphs::Points(&points);
            let image = Image::decode(&scene.snapshot(&values, &options).unwrap());
            let places: Vec<usize> = (0..450 * 450).filter(|&k| image.pixels[k] != plain.pixels[k]).collect();
            let mean = [|k: usize| k % 450, |k: usize| k / 450]
                .map(|part| places.iter().map(|&k| part(k) as f64 + 0.5).sum::<f64>() / places.len() as f64);
            let [x, y, _] = mesh.position(vertex);
            let expected = [left + x * (right - left), bottom - y * (bottom - top)];
            // They stand a little above the plane, which moves them away from the middle.
            for i in 0..2 {
                let away = (mean[i] - 225.0) - (expected[i] - 225.0);
                assert!(away.abs() < 1.0 + 0.03 * (expected[i] - 225.0).abs(), "{kind:?}: {mean:?}, not {expected:?}");
            }
        }
    }
}

#[test]
fn those_behind_are_hidden() {
    // A point in the middle of the side that is not seen.
    let mesh = shapes::sphere(3).unwrap();
    let values = coordinate(&mesh, 0);
    let lowest =
        (0..mesh.vertex_count() as u32).min_by(|&a, &b| mesh.position(a)[2].total_cmp(&mesh.position(b)[2])).unwrap();
    for kind in KINDS {
        let points = [point(lowest, kind)];
        let mut options = from([0.0, 0.0, 1.0], bare(150, 150));
        let without = draw(&mesh, &values, &options);
        options.draw.critical_points = Glyphs::Points(&points);
        assert!(draw(&mesh, &values, &options).pixels == without.pixels);
        let from_below = from([0.0, 0.0, -1.0], options);
        assert!(draw(&mesh, &values, &from_below).difference(&without).0 > 20);
    }
}

#[test]
fn all_critical_points_are_drawn_with_their_kinds() {
    // The textbook's torus, upright: a minimum, two saddles, a maximum.
    let mesh = shapes::torus(40, 20, 0.0).unwrap();
    let values: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2] + 0.01 * p[1]).collect();
    let list = Scene::new(&mesh).draw_list(&values, &Default::default()).unwrap();
    let found: Vec<(Role, usize)> = list.solids.iter().map(|solids| (solids.role, solids.vertices.len())).collect();
    assert_eq!(found, [(Role::Minima, 1), (Role::Saddles, 2), (Role::Maxima, 1)]);
    let extremum = |sign: f64| {
        (0..values.len()).max_by(|&a, &b| (sign * values[a]).total_cmp(&(sign * values[b]))).unwrap() as u32
    };
    assert_eq!(list.solids[0].vertices, [extremum(-1.0)]);
    assert_eq!(list.solids[2].vertices, [extremum(1.0)]);
    for solids in &list.solids {
        for ((&v, place), axis) in solids.vertices.iter().zip(&solids.places).zip(&solids.axes) {
            let [x, y, z] = mesh.position(v);
            // From the center of the tube, outwards.
            let r = x.hypot(y);
            let outwards = [x - x / r, y - y / r, z].map(|x| x / 0.4);
            let along: f64 = (0..3).map(|i| outwards[i] * axis[i]).sum();
            assert!(along > 0.99, "vertex {v}: {axis:?}, not {outwards:?}");
            assert!((place[0].hypot(place[1]).hypot(place[2]) * 1.4 - x.hypot(y).hypot(z)).abs() < 0.02);
        }
    }
}

/// The volume of a closed shape, positive where its triangles face outwards.
fn volume(shape: &Shape) -> f64 {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|k| shape.positions[k as usize]);
        (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
            / 6.0
    };
    shape.triangles.iter().map(of).sum()
}

#[test]
fn solids_are_closed_and_face_outwards() {
    let mesh = shapes::torus(40, 20, 0.0).unwrap();
    let values: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[0] + 0.1 * p[2]).collect();
    let list = Scene::new(&mesh).draw_list(&values, &Default::default()).unwrap();
    // Of the tetrahedron 8√3/27 r³, of the octahedron 4/3 r³, of the ball 4π/3.
    for (solids, least, most) in
        [(&list.solids[0], 1.0, 2.2), (&list.solids[1], 1.3, 3.0), (&list.solids[2], 3.9, 4.19)]
    {
        let shape = &solids.shape;
        let found = volume(shape);
        assert!(found > least && found < most, "{:?}: {found}", solids.role);
        for t in &shape.triangles {
            let [a, b, c] = t.map(|k| shape.positions[k as usize]);
            let middle = [0, 1, 2].map(|i| (a[i] + b[i] + c[i]) / 3.0);
            for k in *t {
                let normal = shape.normals[k as usize];
                let length: f64 = normal.iter().map(|x| x * x).sum();
                assert!((length - 1.0).abs() < 1e-12);
                assert!((0..3).map(|i| normal[i] * middle[i]).sum::<f64>() > 0.0, "a normal points inwards");
            }
        }
        // Every edge is there once in each direction, by its places.
        let mut edges = Vec::new();
        for t in &shape.triangles {
            for k in 0..3 {
                edges.push([t[k], t[(k + 1) % 3]].map(|v| shape.positions[v as usize].map(f64::to_bits)));
            }
        }
        assert!(edges.iter().all(|[p, q]| edges.iter().filter(|edge| **edge == [*q, *p]).count() == 1));
    }
}

#[test]
fn many_are_small_and_few_are_not() {
    let mesh = shapes::torus(60, 40, 0.2).unwrap();
    let scene = Scene::new(&mesh);
    let size = |values: &[f64]| {
        let list = scene.draw_list(values, &Default::default()).unwrap();
        (list.solids.iter().map(|solids| solids.vertices.len()).sum::<usize>(), list.solids[0].radius)
    };
    let few = size(&coordinate(&mesh, 0));
    let many = size(&crate::support::noise(mesh.vertex_count(), 1));
    assert!(few.0 < 10 && many.0 > 500 && many.1 < few.1, "{few:?}, {many:?}");
    // They cover a small part of the surface only.
    let surface = scene.surface();
    assert!(many.0 as f64 * 3.2 * many.1 * many.1 < 0.3 * surface.area);
}

#[test]
fn points_of_no_triangle_are_left_out() {
    let mesh = TriMesh::new(vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 9.0, 9.0, 9.0], vec![0, 1, 2]).unwrap();
    let values = [1.0, 2.0, 3.0, -50.0];
    let points = [point(3, CriticalKind::Minimum)];
    let mut options = SnapshotOptions { draw: Default::default(), ..bare(80, 60) };
    options.draw.levels = Levels::None;
    options.draw.critical_points = Glyphs::Points(&points);
    let with = draw(&mesh, &values, &options);
    options.draw.critical_points = Glyphs::None;
    assert!(with.pixels == draw(&mesh, &values, &options).pixels);
}
