//! Welding against the documented rule, tried out on all pairs of vertices.

use core::f64::consts::{PI, TAU};

use morse_smooth::error::{Error, FieldError, MeshError};
use morse_smooth::load::{LoadOptions, load};
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::mesh::{TriMesh, WeldOptions, Welded, weld};
use proptest::prelude::*;

/// Every vertex becomes the first one kept within the tolerance: the new ids, and the old ids of the vertices kept.
fn by_hand(points: &[[f64; 3]], tolerance: f64) -> (Vec<u32>, Vec<usize>) {
    // Powers of two scale without rounding, and leave no square that is infinite or zero.
    let largest = points.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let scale = if largest > 1.0 { 2.0_f64.powi(-(largest.log2() as i32)) } else { 1.0 };
    let scale = if largest < 1e-100 { 2.0_f64.powi(500) } else { scale };
    let points: Vec<[f64; 3]> = points.iter().map(|p| p.map(|x| x * scale)).collect();
    let side = |axis: usize| {
        let all = || points.iter().map(|p| p[axis]);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    let length = |d: [f64; 3]| (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    let radius = tolerance * length([side(0), side(1), side(2)]);
    let (mut map, mut kept) = (Vec::new(), Vec::<usize>::new());
    for (v, p) in points.iter().enumerate() {
        let near = |&other: &usize| {
            let q = points[other];
            length([p[0] - q[0], p[1] - q[1], p[2] - q[2]]) <= radius
        };
        let new = kept.iter().position(near).unwrap_or_else(|| {
            kept.push(v);
            kept.len() - 1
        });
        map.push(new as u32);
    }
    (map, kept)
}

fn welded(points: &[[f64; 3]], tolerance: f64) -> Welded {
    weld(points.as_flattened(), Some(&[]), &WeldOptions { tolerance }).expect("valid points")
}

fn check(points: &[[f64; 3]], tolerance: f64) -> Result<(), TestCaseError> {
    let (map, kept) = by_hand(points, tolerance);
    let found = welded(points, tolerance);
    prop_assert_eq!(&found.map, &map, "tolerance {:e}", tolerance);
    let positions: Vec<f64> = kept.iter().flat_map(|&v| points[v]).collect();
    prop_assert_eq!(&found.positions, &positions);
    prop_assert_eq!(found.joins_any(), kept.len() < points.len());
    Ok(())
}

/// Points of a kind, about 1 in size.
fn points(kind: u32, count: usize, random: &mut Random) -> Vec<[f64; 3]> {
    let mut centre = [0.0; 3];
    (0..count)
        .map(|i| {
            let any = [random.signed(), random.signed(), random.signed()];
            match kind {
                // In a cube.
                0 => any,
                // In clusters.
                1 => {
                    if i % 7 == 0 {
                        centre = any;
                    }
                    [0, 1, 2].map(|axis| centre[axis] + 1e-3 * any[axis])
                }
                // A chain of near points.
                2 => [i as f64 / count as f64, 1e-4 * any[1], 0.0],
                // On a grid, many of them at the same place.
                3 => any.map(|x| (x * 4.0).round()),
                // A cluster that is tiny beside its distance to one point.
                4 if i == 5 => [1e9, -1e9, 1e9],
                4 => any,
                // Far from the origin.
                _ => any.map(|x| 1e6 + x),
            }
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn vertices_join_the_first_one_within_the_tolerance(
        seed: u64,
        kind in 0_u32..6,
        count in 1_usize..150,
        exponent in -18.0..-0.1_f64,
        size in prop::sample::select(vec![0, 240, -520]),
    ) {
        let mut points = points(kind, count, &mut Random::new(seed));
        points.iter_mut().flatten().for_each(|x| *x *= 2.0_f64.powi(size - if kind < 4 { 0 } else { 30 }));
        let tolerance = 10.0_f64.powf(exponent);
        check(&points, tolerance)?;
        check(&points, 0.0)?;
    }
}

#[test]
fn steps_of_the_last_bits_are_told_apart() {
    // Neighbouring numbers near 1, with tolerances around their distance; and numbers beyond whole multiples of the tolerance.
    for base in [1.0_f64, 2.0, 1e15, 1e75 / 2.0] {
        let mut points = vec![[0.0, 0.0, 0.0], [base, 0.0, 0.0]];
        for step in -6_i64..7 {
            points.push([f64::from_bits((base.to_bits() as i64 + step) as u64), base, 0.0]);
        }
        for tolerance in [1e-17, 0.7e-16, 1.3e-16, 1.9e-16, 2.7e-16, 1e-15, 1e-200, 1e-320] {
            check(&points, tolerance).unwrap();
        }
    }
    let zeros = [[0.0, 0.0, 0.0], [-0.0, 0.0, -0.0], [5e-324, 0.0, 0.0], [1.0, 1.0, 1.0]];
    assert_eq!(welded(&zeros, 0.0).map, [0, 0, 1, 2]);
    assert_eq!(welded(&zeros, 1e-300).map, [0, 0, 0, 1]);
    assert!(welded(&zeros, 0.0).positions[0].is_sign_positive());
    // All at one place: there is no diagonal.
    assert_eq!(welded(&[[3.0; 3]; 4], 0.5).map, [0; 4]);
}

/// A sphere of `width` × `height` quads as three.js's `SphereGeometry` makes it: the seam is there twice, each pole
/// `width` + 1 times, all rounded to single precision.
fn sphere(width: u32, height: u32) -> (Vec<f64>, Vec<u32>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for iy in 0..=height {
        for ix in 0..=width {
            let phi = f64::from(ix) / f64::from(width) * TAU;
            let theta = f64::from(iy) / f64::from(height) * PI;
            let point = [-phi.cos() * theta.sin(), theta.cos(), phi.sin() * theta.sin()];
            positions.extend(point.map(|x| f64::from(x as f32)));
        }
    }
    for iy in 0..height {
        for ix in 0..width {
            let at = |iy: u32, ix: u32| iy * (width + 1) + ix;
            let [a, b, c, d] = [at(iy, ix + 1), at(iy, ix), at(iy + 1, ix), at(iy + 1, ix + 1)];
            if iy != 0 {
                triangles.extend([a, b, d]);
            }
            if iy != height - 1 {
                triangles.extend([b, c, d]);
            }
        }
    }
    (positions, triangles)
}

#[test]
fn a_sphere_with_seam_and_poles_closes() {
    for (width, height) in [(32, 16), (8, 6), (128, 64)] {
        let (positions, triangles) = sphere(width, height);
        let exact = weld(&positions, Some(&triangles), &WeldOptions::default()).unwrap();
        let open = TriMesh::new(exact.positions, exact.triangles).unwrap();
        assert!(!open.topology().unwrap().closed, "sin 2π is not zero, so that equal positions are not enough");

        let welded = weld(&positions, Some(&triangles), &WeldOptions { tolerance: 1e-6 }).unwrap();
        let mesh = TriMesh::new(welded.positions.clone(), welded.triangles.clone()).unwrap();
        assert_eq!(mesh.vertex_count() as u32, width * (height - 1) + 2);
        assert_eq!(mesh.triangle_count() as u32, 2 * width * (height - 1));
        assert!(mesh.warnings().is_empty(), "{:?}", mesh.warnings());
        let topology = mesh.topology().unwrap();
        assert_eq!((topology.closed, topology.orientable, topology.genus), (true, true, Some(0)));

        // A field that is continuous on the sphere differs by rounding at the seam.
        let height_of =
            |positions: &[f64]| -> Vec<f64> { positions.chunks_exact(3).map(|p| p[0] + 2.0 * p[2]).collect() };
        let carried = welded.field(&height_of(&positions)).unwrap();
        assert!(carried.disagreeing.is_empty());
        for (found, expected) in carried.values.iter().zip(height_of(mesh.positions())) {
            assert!((found - expected).abs() < 1e-6);
        }
        // The first texture coordinate does not: it is 0 at one end of the seam and 1 at the other.
        let u: Vec<f64> =
            (0..positions.len() / 3).map(|v| f64::from(v as u32 % (width + 1)) / f64::from(width)).collect();
        let carried = welded.field(&u).unwrap();
        // Vertices of the seam come first in their rows; the poles have all values there are.
        let seam: Vec<u32> = (0..=height).map(|iy| welded.map[(iy * (width + 1)) as usize]).collect();
        assert_eq!(carried.disagreeing, seam);
        assert!(seam.iter().all(|&v| (carried.values[v as usize] - 0.5).abs() < 1e-12));
    }
}

#[test]
fn soups_need_no_ids() {
    let torus = shapes::torus(20, 12, 0.3).unwrap();
    let soup: Vec<f64> =
        torus.connectivity().triangles().as_flattened().iter().flat_map(|&v| torus.position(v)).collect();
    let loose = TriMesh::from_soup(soup.clone()).unwrap();
    assert_eq!((loose.vertex_count(), loose.triangle_count()), (3 * torus.triangle_count(), torus.triangle_count()));
    assert_eq!(loose.topology().unwrap().components, torus.triangle_count());
    let joined = weld(&soup, None, &WeldOptions { tolerance: 1e-9 }).unwrap();
    assert_eq!(joined.triangles, joined.map);
    let joined = TriMesh::new(joined.positions, joined.triangles).unwrap();
    assert_eq!(joined.topology(), torus.topology());
    assert_eq!(joined.vertex_count(), torus.vertex_count());
    for wrong in [TriMesh::from_soup(vec![0.0; 12]).map(|_| ()).map_err(Error::from), {
        weld(&[0.0; 12], None, &WeldOptions::default()).map(|_| ())
    }] {
        assert_eq!(wrong, Err(Error::Mesh(MeshError::TrianglesNotTriples { length: 4 })));
    }
}

#[test]
fn triangles_smaller_than_the_tolerance_are_left_out() {
    let positions = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 1e-9, 0., 1e-9, 1., 0.];
    let triangles = [0, 1, 2, 0, 3, 1, 2, 4, 1, 3, 1, 4];
    let welded = weld(&positions, Some(&triangles), &WeldOptions { tolerance: 1e-6 }).unwrap();
    assert_eq!(welded.map, [0, 1, 2, 0, 2]);
    assert_eq!(welded.triangles, [0, 1, 2, 0, 0, 1, 2, 2, 1, 0, 1, 2]);
    let mesh = TriMesh::new(welded.positions, welded.triangles).unwrap();
    let found: Vec<_> = mesh.warnings().iter().map(|w| (w.code, w.count, w.examples.clone())).collect();
    assert_eq!(found, [("DegenerateTriangle", 2, vec![1, 2]), ("DuplicateTriangle", 1, vec![3])]);
}

#[test]
fn tolerances_out_of_range_are_refused() {
    for tolerance in [-1e-9, 1.0, 1.5, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = weld(&[0.0; 9], None, &WeldOptions { tolerance }).expect_err("no tolerance");
        assert_eq!(error.code(), "InvalidOption", "{tolerance}");
    }
    let nan = weld(&[0.0, 0.0, 0.0, 0.0, f64::NAN, 0.0], Some(&[]), &WeldOptions { tolerance: 0.1 });
    assert_eq!(nan, Err(Error::Mesh(MeshError::NonFinitePosition { vertex: 1 })));
}

#[test]
fn fields_are_carried_along() {
    // Three vertices that become one, two that do, and one alone.
    let welded = welded(&[[0.0; 3], [1.0; 3], [0.0; 3], [2.0; 3], [0.0; 3], [1.0; 3]], 0.0);
    assert_eq!(welded.map, [0, 1, 0, 2, 0, 1]);
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    let third = 1.0 / 3.0;
    let cases: [([f64; 6], [f64; 3], &[u32]); 9] = [
        // Equal values stay to the last bit; a mean of three would not.
        ([0.1, third, 0.1, 7.0, 0.1, third], [0.1, third, 7.0], &[]),
        ([0.0, 1.0, 3.0, 7.0, 6.0, 2.0], [3.0, 1.5, 7.0], &[0, 1]),
        // What differs by less than single precision can hold is no disagreement.
        ([1.0, 5.0, 1.0 + 3e-7, 7.0, 1.0, 5.0 + 1e-6], [1.0 + 1e-7, 5.0 + 5e-7, 7.0], &[]),
        // Missing values: of all copies, and of some.
        ([nan, nan, nan, nan, nan, 3.0], [nan, 3.0, nan], &[1]),
        ([1.0, 3.0, 2.0, 0.0, nan, nan], [1.5, 3.0, 0.0], &[0, 1]),
        ([1.0, inf, inf, 0.0, 2.0, inf], [inf, inf, 0.0], &[0]),
        ([1.0, -inf, -inf, 0.0, 2.0, 1.0], [-inf, -inf, 0.0], &[0, 1]),
        ([1e308, 1e308, 1e308, 1e308, 1.6e308, -1e308], [1.2e308, 0.0, 1e308], &[0, 1]),
        ([0.0, -0.0, -0.0, 0.0, 0.0, 0.0], [0.0, -0.0, 0.0], &[]),
    ];
    for (values, expected, disagreeing) in cases {
        let found = welded.field(&values).unwrap();
        assert_eq!(found.disagreeing, disagreeing, "{values:?}");
        for (found, expected) in found.values.iter().zip(expected) {
            let near = (found - expected).abs() <= 1e-15 * expected.abs();
            assert!(near || found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan(), "{values:?}");
        }
    }
    assert_eq!(welded.field(&[0.1, third, 0.1, 7.0, 0.1, third]).unwrap().values, [0.1, third, 7.0]);
    assert_eq!(welded.field(&[1.0; 3]), Err(FieldError::LengthMismatch { expected: 6, actual: 3, hint: "" }));
}

#[test]
fn files_are_welded_with_their_fields() {
    let file = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
        property float a\nproperty float b\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 1 1\n1 0 0 2 2\n0 1 0 3 3\n0.0000001 1 0 3 5\n1 0.0000001 0 2 2\n1 1 0 4 4\n3 0 1 2\n3 3 4 5\n";
    let plain = load(file.as_bytes(), &LoadOptions::default()).unwrap();
    assert_eq!((plain.mesh.vertex_count(), plain.vertex_map), (6, None));
    let weld = |tolerance| {
        let options = LoadOptions { weld: Some(WeldOptions { tolerance }), ..Default::default() };
        load(file.as_bytes(), &options).unwrap()
    };
    assert_eq!((weld(0.0).mesh.vertex_count(), weld(0.0).vertex_map), (6, None));
    let welded = weld(1e-5);
    assert_eq!(welded.vertex_map, Some(vec![0, 1, 2, 2, 1, 3]));
    assert_eq!((welded.mesh.vertex_count(), welded.mesh.edge_count()), (4, 5));
    let fields = [("a".to_owned(), vec![1.0, 2.0, 3.0, 4.0]), ("b".to_owned(), vec![1.0, 2.0, 4.0, 4.0])];
    assert_eq!(welded.fields, fields);
    let found: Vec<_> = welded.warnings.iter().map(|w| (w.code, w.count, w.examples.clone())).collect();
    assert_eq!(found, [("WeldedValues", 1, vec![2])]);
    assert!(welded.warnings[0].message.contains("`b`"));
}
