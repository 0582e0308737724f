//! Whatever is asked for: a picture of that size, or an error with a name; never a panic.

use morse_smooth::field::{CriticalKind, CriticalPoint, Missing, Threshold};
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};
use morse_smooth::render::{
    Camera, Colormap, DrawOptions, Glyphs, Levels, Scene, Separatrices, SheetOptions, SnapshotOptions,
};
use proptest::prelude::*;

use super::image::Image;
use crate::support;

fn any_mesh(seed: u64) -> TriMesh {
    let mut random = Random::new(seed);
    let mut mesh = match seed % 5 {
        0 => support::random_complex(seed, 8, 1 + (40.0 * random.uniform()) as usize),
        1 => support::random_surface(seed, &shapes::sphere(2).unwrap(), 0.8 * random.uniform()),
        2 => support::random_surface(seed, &shapes::torus(9, 7, 0.3).unwrap(), 0.3 * random.uniform()),
        3 => support::jittered(&shapes::grid(5, 6).unwrap(), 0.2 * random.uniform(), seed),
        _ => {
            let mut all = support::every_kind();
            all.swap_remove((random.uniform() * all.len() as f64) as usize).1
        }
    };
    if random.uniform() < 0.4 {
        // Squeezed to a plane, a line or a point along some axes; far away or tiny.
        let scales = [0, 1, 2].map(|_| [1.0, 1.0, 0.0, 1e-9, 1e-160, 1e60][(6.0 * random.uniform()) as usize]);
        let by = [0.0, 1e7, -1e-3][(3.0 * random.uniform()) as usize];
        let positions = mesh.positions().iter().enumerate().map(|(k, x)| scales[k % 3] * x + by).collect();
        mesh = TriMesh::new(positions, mesh.connectivity().triangles().as_flattened().to_vec()).unwrap();
    }
    mesh
}

fn any_field(mesh: &TriMesh, seed: u64) -> Vec<f64> {
    let n = mesh.vertex_count();
    match seed % 4 {
        0 => support::noise(n, seed),
        1 => support::tied(n, seed, 2.0),
        2 => vec![seed as f64; n],
        _ => support::noise(n, seed).iter().map(|x| x * 1e300).collect(),
    }
}

fn number(random: &mut Random) -> f64 {
    let odd = [0.0, -0.0, f64::NAN, f64::INFINITY, 5e-324, 1e308, -1e308, 1e-30, -1.0, 0.5];
    if random.uniform() < 0.15 { odd[(odd.len() as f64 * random.uniform()) as usize] } else { random.signed() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_options_give_a_picture_or_an_error(seed in any::<u64>()) {
        let mut random = Random::new(seed);
        let mesh = any_mesh(seed / 7);
        let mut values = any_field(&mesh, seed);
        if seed % 3 == 0 {
            values.iter_mut().step_by(5).for_each(|value| *value = f64::NAN);
        }
        let n = mesh.vertex_count() as f64;
        let few: Vec<f64> = (0..3).map(|_| number(&mut random)).collect();
        let points: Vec<CriticalPoint> = (0..4)
            .map(|k| CriticalPoint {
                vertex: (1.02 * n * random.uniform()) as u32,
                kind: [CriticalKind::Minimum, CriticalKind::Saddle, CriticalKind::Maximum][k % 3],
                multiplicity: 1,
                on_boundary: false,
            })
            .collect();
        let chance = |random: &mut Random, part: f64| random.uniform() < part;
        let vector = |random: &mut Random| [number(random), number(random), number(random)];
        let draw = DrawOptions {
            colormap: [Colormap::Viridis, Colormap::CoolWarm, Colormap::BlueRed][(3.0 * random.uniform()) as usize],
            range: chance(&mut random, 0.3).then(|| [number(&mut random), number(&mut random)]),
            levels: match (5.0 * random.uniform()) as u32 {
                0 => Levels::None,
                1 => Levels::At(&few),
                2 => Levels::Count((30.0 * random.uniform()) as u32),
                _ => Levels::Count(5),
            },
            bands: chance(&mut random, 0.4),
            critical_points: match (3.0 * random.uniform()) as u32 {
                0 => Glyphs::None,
                1 => Glyphs::Points(&points),
                _ => Glyphs::Found,
            },
            morse_complex: if chance(&mut random, 0.4) {
                Separatrices::Above(Threshold::Relative(number(&mut random).abs()))
            } else {
                Separatrices::None
            },
            missing: [Missing::Error, Missing::Omit, Missing::Fill][(2.2 * random.uniform()) as usize],
        };
        let camera = Camera {
            direction: chance(&mut random, 0.6).then(|| vector(&mut random)),
            up: chance(&mut random, 0.3).then(|| vector(&mut random)),
        };
        let width = (140.0 * random.uniform().powi(2)) as u32 + u32::from(chance(&mut random, 0.97));
        let height = (140.0 * random.uniform().powi(2)) as u32 + u32::from(chance(&mut random, 0.97));
        let title = ["", "a title", "Ünïcödé\n\u{0}🎉"][(3.0 * random.uniform()) as usize];
        let picture = SnapshotOptions { draw, width, height, color_bar: chance(&mut random, 0.5), title, camera };
        let scene = Scene::new(&mesh);
        match scene.snapshot(&values, &picture) {
            Ok(file) => {
                let image = Image::decode(&file);
                prop_assert_eq!((image.width as u32, image.height as u32), (width, height));
                prop_assert!(scene.snapshot(&values, &picture).unwrap() == file);
            }
            Err(error) => prop_assert!(!error.code().is_empty() && !error.to_string().is_empty()),
        }
        if chance(&mut random, 0.3) {
            let options = SheetOptions {
                picture,
                largest_difference: chance(&mut random, 0.5).then(|| number(&mut random)),
                ..SheetOptions::default()
            };
            let after = any_field(&mesh, seed / 3);
            if let Ok(file) = scene.sheet(&values, &after, &options) {
                let image = Image::decode(&file);
                prop_assert!(image.width as u32 >= width && image.height as u32 >= height);
            }
        }
    }
}
