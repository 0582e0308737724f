//! Reading fields: what is made sure of covers what every analysis takes, on meshes of many kinds and sizes.

use morse_smooth::Watch;
use morse_smooth::field::{
    self, DeltaOptions, Features, Keep, LinkReading, Missing, PathStyle, ScalarField, Threshold,
};
use morse_smooth::mesh::TriMesh;
use morse_smooth::mesh::shapes::{self, Random};

use crate::check;

/// A fan of triangles around one edge for each of many edges: sheets that meet.
fn books(count: u32) -> TriMesh {
    let mut triangles = Vec::new();
    for k in 0..count {
        let spine = [k * 4, k * 4 + 1];
        for page in [k * 4 + 2, k * 4 + 3, (k * 4 + 4) % (4 * count)] {
            triangles.extend([spine[0], spine[1], page]);
        }
    }
    let mut random = Random::new(7);
    TriMesh::new((0..12 * count).map(|_| random.signed()).collect(), triangles).expect("a mesh")
}

fn meshes() -> Vec<(&'static str, TriMesh)> {
    vec![
        ("small torus", shapes::torus(60, 30, 0.2).expect("a mesh")),
        ("torus", shapes::torus(300, 150, 0.1).expect("a mesh")),
        ("grid", shapes::grid(200, 150).expect("a mesh")),
        ("books", books(8_000)),
    ]
}

fn fields(mesh: &TriMesh) -> Vec<(&'static str, Vec<f64>)> {
    let n = mesh.vertex_count();
    let mut random = Random::new(3);
    let noise: Vec<f64> = (0..n).map(|_| random.signed()).collect();
    let gaps = noise.iter().map(|&x| if x > 0.9 { f64::NAN } else { x }).collect();
    let smooth = mesh.positions().chunks_exact(3).map(|p| p[0] + 0.3 * p[1] * p[2]).collect();
    vec![("noise", noise), ("smooth", smooth), ("constant", vec![1.0; n]), ("gaps", gaps)]
}

/// Calls every analysis on every mesh and field.
fn all(mut call: impl FnMut(&str, &ScalarField<'_>)) {
    for (mesh_name, mesh) in meshes() {
        for (name, values) in fields(&mesh) {
            let field = ScalarField::with_missing(&mesh, &values, Missing::Omit).expect("a field");
            call(&format!("{name} on {mesh_name}"), &field);
        }
    }
}

#[test]
fn critical_points_and_their_hierarchy() {
    let watch = Watch::none();
    all(|name, field| {
        for (delta, link) in
            [(0.0, LinkReading::Consecutive), (0.01, LinkReading::Consecutive), (0.01, LinkReading::Skip)]
        {
            let options = DeltaOptions { delta, link, ..DeltaOptions::default() };
            check(&format!("critical points, {name}"), 2.0, || field::critical_points(field, &options, &watch))
                .unwrap();
            check(&format!("hierarchy, {name}"), 2.0, || field::delta_hierarchy(field, link, &watch)).unwrap();
        }
    });
}

#[test]
fn persistence_and_simplification() {
    let watch = Watch::none();
    all(|name, field| {
        check(&format!("persistence, {name}"), 2.0, || field::persistence(field, &watch)).unwrap();
        for threshold in [0.0, 0.1, 2.0] {
            let keep = Keep::Above(Threshold::Relative(threshold));
            check(&format!("simplify, {name}"), 2.0, || field::simplify(field, keep, &watch)).unwrap();
        }
    });
}

#[test]
fn the_morse_complex() {
    let watch = Watch::none();
    all(|name, field| {
        for threshold in [0.0, 0.2].map(Threshold::Relative) {
            for style in PathStyle::ALL {
                let call = || field::morse_complex(field, threshold, *style, &watch);
                check(&format!("complex, {name}"), 2.0, call).unwrap();
            }
            check(&format!("basins, {name}"), 2.0, || field::basins(field, threshold, &watch)).unwrap();
        }
        check(&format!("morse hierarchy, {name}"), 2.0, || field::morse_hierarchy(field, &watch)).unwrap();
    });
}

#[test]
fn level_sets_and_bands() {
    let watch = Watch::none();
    all(|name, field| {
        for count in [0, 1, 20] {
            let levels = field::evenly_spaced_levels(field, count).unwrap();
            check(&format!("level sets, {name}"), 2.0, || field::level_sets(field, &levels, &watch)).unwrap();
            check(&format!("bands, {name}"), 2.0, || field::bands(field, &levels, &watch)).unwrap();
        }
        // More than 10,000 levels are refused; until then memory is taken.
        let call = || field::saddle_levels(field, None, 0.01, &watch);
        let _ = check(&format!("saddle levels, {name}"), 2.0, call);
    });
}

#[test]
fn feature_points() {
    let watch = Watch::none();
    all(|name, field| {
        let fields = [field.clone(), field.clone()];
        for features in [
            Features::CriticalPoints(DeltaOptions::default()),
            Features::Persistence(Threshold::Relative(0.1)),
            Features::KMeans { clusters: 7, seed: 1 },
            Features::KMeans { clusters: 3_000, seed: 1 },
        ] {
            let call = || field::feature_points(&fields, &features, &watch);
            check(&format!("{features:?}, {name}"), 2.0, call).unwrap();
        }
    });
}
