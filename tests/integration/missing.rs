//! Missing values that are omitted: every analysis is to the bit that of the mesh without the triangles that have one.

use morse_smooth::field::{
    self, Basins, DeltaOptions, Features, Keep, LinkReading, Missing, PathStyle, ScalarField, Simplified, Threshold,
};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::{Result, Watch};

use crate::support::{every_kind, noise, tied};

/// A mesh without the triangles of vertices that have no value, built by hand, and what its vertices and triangles are in the whole.
struct Part {
    mesh: TriMesh,
    values: Vec<f64>,
    vertices: Vec<u32>,
    triangles: Vec<u32>,
}

impl Part {
    fn new(mesh: &TriMesh, values: &[f64]) -> Option<Self> {
        let all = mesh.connectivity().triangles();
        let is_whole = |t: &u32| all[*t as usize].iter().all(|&v| !values[v as usize].is_nan());
        let triangles: Vec<u32> = (0..all.len() as u32).filter(is_whole).collect();
        let mut vertices: Vec<u32> = triangles.iter().flat_map(|&t| all[t as usize]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: u32| vertices.iter().position(|&w| w == v).unwrap() as u32;
        let corners: Vec<u32> = triangles.iter().flat_map(|&t| all[t as usize].map(number)).collect();
        let positions = vertices.iter().flat_map(|&v| mesh.position(v)).collect();
        let part = TriMesh::new(positions, corners).ok()?;
        let values = vertices.iter().map(|&v| values[v as usize]).collect();
        Some(Self { mesh: part, values, vertices, triangles })
    }

    fn whole(&self, v: u32) -> u32 {
        self.vertices[v as usize]
    }

    fn spread<T: Copy>(&self, count: usize, elements: &[T], elsewhere: T) -> Vec<T> {
        let mut all = vec![elsewhere; count];
        self.vertices.iter().zip(elements).for_each(|(&v, &element)| all[v as usize] = element);
        all
    }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

fn is_refused<T>(result: &Result<T>) -> Option<&'static str> {
    result.as_ref().err().map(morse_smooth::Error::code)
}

/// Compares all analyses of a field with gaps with those of the part without them.
fn check(name: &str, mesh: &TriMesh, values: &[f64]) {
    let watch = Watch::none();
    let n = mesh.vertex_count();
    if values.iter().all(|value| !value.is_nan()) {
        return;
    }
    let Some(part) = Part::new(mesh, values) else {
        let error = ScalarField::with_missing(mesh, values, Missing::Omit).unwrap_err();
        assert_eq!(error.code(), "EmptyMesh", "{name}");
        return;
    };
    let given = ScalarField::with_missing(mesh, values, Missing::Omit).unwrap();
    let plain = ScalarField::new(&part.mesh, &part.values).unwrap();
    assert_eq!(given.range(), plain.range());
    assert_eq!(field::largest_edge_difference(&given), field::largest_edge_difference(&plain));
    let whole = |v: &mut u32| *v = part.whole(*v);

    for (delta, link) in [(0.0, LinkReading::Consecutive), (0.1, LinkReading::Skip), (0.2, LinkReading::Consecutive)] {
        let options = DeltaOptions { delta, link, ..DeltaOptions::default() };
        let mut expected = field::critical_points(&plain, &options, &watch).unwrap();
        expected.points.iter_mut().for_each(|point| whole(&mut point.vertex));
        assert_eq!(field::critical_points(&given, &options, &watch).unwrap(), expected, "{name}");
        let mut expected = field::delta_hierarchy(&plain, link, &watch).unwrap();
        expected.points.iter_mut().for_each(|point| whole(&mut point.vertex));
        assert_eq!(field::delta_hierarchy(&given, link, &watch).unwrap(), expected, "{name}");
    }

    let mut diagram = field::persistence(&plain, &watch).unwrap();
    let extrema: Vec<u32> = diagram.essential_minima.iter().chain(&diagram.essential_maxima).copied().collect();
    let saddle = diagram.pairs.first().map(|pair| pair.saddle);
    for pair in &mut diagram.pairs {
        whole(&mut pair.extremum);
        whole(&mut pair.saddle);
    }
    for essential in [&mut diagram.essential_minima, &mut diagram.essential_maxima, &mut diagram.essential_saddles] {
        essential.iter_mut().for_each(whole);
    }
    assert_eq!(field::persistence(&given, &watch).unwrap(), diagram, "{name}");

    let named: Vec<u32> = extrema.iter().map(|&v| part.whole(v)).collect();
    for (keep, translated) in [
        (Keep::Above(Threshold::Relative(0.3)), Keep::Above(Threshold::Relative(0.3))),
        (Keep::Extrema(&extrema), Keep::Extrema(&named)),
    ] {
        let Simplified { values: simple, mut unavoidable } = field::simplify(&plain, keep, &watch).unwrap();
        unavoidable.iter_mut().for_each(whole);
        let found = field::simplify(&given, translated, &watch).unwrap();
        assert_eq!(bits(&found.values), bits(&part.spread(n, &simple, f64::NAN)), "{name}");
        assert_eq!(found.unavoidable, unavoidable, "{name}");
    }
    // Errors name vertices of the whole mesh, too.
    if let Some(saddle) = saddle {
        let error = field::simplify(&given, Keep::Extrema(&[part.whole(saddle)]), &watch).unwrap_err();
        if error.code() == "NotAnExtremum" {
            assert_eq!(error.detail()[0].1, morse_smooth::error::Detail::from(part.whole(saddle)));
        }
    }
    let error = field::simplify(&given, Keep::Extrema(&named[..1]), &watch).unwrap_err();
    let expected = field::simplify(&plain, Keep::Extrema(&extrema[..1]), &watch).unwrap_err();
    assert_eq!(error.code(), expected.code());
    let vertex = |error: &morse_smooth::Error| {
        error.detail().into_iter().find_map(|(name, detail)| match detail {
            morse_smooth::error::Detail::Integer(id) if name == "vertex" => Some(id as u32),
            _ => None,
        })
    };
    assert_eq!(vertex(&error), vertex(&expected).map(|v| part.whole(v)), "{name}");

    for threshold in [0.0, 0.3].map(Threshold::Relative) {
        for &style in PathStyle::ALL {
            let mut expected = field::morse_complex(&plain, threshold, style, &watch).unwrap();
            for ids in [&mut expected.vertices, &mut expected.saddles, &mut expected.extrema] {
                ids.iter_mut().for_each(whole);
            }
            assert_eq!(field::morse_complex(&given, threshold, style, &watch).unwrap(), expected, "{name}");
        }
        let Basins { descending, ascending } = field::basins(&plain, threshold, &watch).unwrap();
        let labels = |labels: &[u32]| {
            let labels: Vec<u32> = labels.iter().map(|&v| part.whole(v)).collect();
            part.spread(n, &labels, u32::MAX)
        };
        let expected = Basins { descending: labels(&descending), ascending: labels(&ascending) };
        assert_eq!(field::basins(&given, threshold, &watch).unwrap(), expected, "{name}");
    }
    let mut hierarchy = field::morse_hierarchy(&plain, &watch).unwrap();
    hierarchy.nodes.iter_mut().for_each(|node| whole(&mut node.vertex));
    assert_eq!(field::morse_hierarchy(&given, &watch).unwrap(), hierarchy, "{name}");

    let mut levels = field::evenly_spaced_levels(&plain, 5).unwrap();
    assert_eq!(field::evenly_spaced_levels(&given, 5).unwrap(), levels);
    levels.push(part.values[0]);
    let mut sets = field::level_sets(&plain, &levels, &watch).unwrap();
    sets.edges.as_flattened_mut().iter_mut().for_each(whole);
    assert_eq!(field::level_sets(&given, &levels, &watch).unwrap(), sets, "{name}");
    let mut bands = field::bands(&plain, &levels, &watch).unwrap();
    bands.edges.as_flattened_mut().iter_mut().for_each(whole);
    bands.parents.iter_mut().for_each(|t| *t = part.triangles[*t as usize]);
    assert_eq!(field::bands(&given, &levels, &watch).unwrap(), bands, "{name}");
    let expected = field::saddle_levels(&plain, None, 0.01, &watch).unwrap();
    assert_eq!(field::saddle_levels(&given, None, 0.01, &watch).unwrap(), expected, "{name}");
    let expected = field::saddle_levels(&plain, Some(&extrema), 0.01, &watch).unwrap();
    assert_eq!(field::saddle_levels(&given, Some(&named), 0.01, &watch).unwrap(), expected, "{name}");

    for (features, translated) in [
        (Features::Vertices(&extrema), Features::Vertices(&named)),
        (Features::CriticalPoints(DeltaOptions::default()), Features::CriticalPoints(DeltaOptions::default())),
        (Features::Persistence(Threshold::Relative(0.2)), Features::Persistence(Threshold::Relative(0.2))),
        (Features::KMeans { clusters: 3, seed: 1 }, Features::KMeans { clusters: 3, seed: 1 }),
    ] {
        let mut expected = field::feature_points(core::slice::from_ref(&plain), &features, &watch).unwrap();
        expected.iter_mut().for_each(whole);
        let found = field::feature_points(core::slice::from_ref(&given), &translated, &watch).unwrap();
        assert_eq!(found, expected, "{name}");
    }

    // Vertices without a value, and those with values missing all around, are refused by name.
    let known: Vec<bool> = (0..n as u32).map(|v| part.vertices.binary_search(&v).is_ok()).collect();
    if let Some(v) = known.iter().position(|known| !known) {
        let v = [v as u32];
        let refused = [
            is_refused(&field::saddle_levels(&given, Some(&v), 0.0, &watch)),
            is_refused(&field::simplify(&given, Keep::Extrema(&v), &watch)),
            is_refused(&field::feature_points(core::slice::from_ref(&given), &Features::Vertices(&v), &watch)),
        ];
        assert_eq!(refused, [Some("MissingValue"); 3], "{name}");
    }
    let beyond = [n as u32];
    assert_eq!(is_refused(&field::simplify(&given, Keep::Extrema(&beyond), &watch)), Some("IndexOutOfBounds"));
}

/// The neighbourhoods of a few vertices.
fn clustered(mesh: &TriMesh, seed: u64, values: &mut [f64]) {
    let n = mesh.vertex_count();
    for k in 0..2 {
        let centre = ((seed as usize) * 7 + k * (n / 2)) % n;
        let mut gap = vec![centre as u32];
        for _ in 0..2 {
            gap = gap.iter().flat_map(|&v| mesh.connectivity().link(v).flatten().chain([v])).collect();
        }
        gap.iter().for_each(|&v| values[v as usize] = f64::NAN);
    }
}

#[test]
fn omitting_is_building_the_mesh_without_the_gaps() {
    let mut meshes = every_kind();
    meshes.push(("larger torus", shapes::torus(24, 16, 0.3).unwrap()));
    meshes.push(("larger grid", shapes::grid(18, 13).unwrap()));
    for (name, mesh) in meshes {
        let n = mesh.vertex_count();
        for seed in 0..4 {
            for base in [noise(n, seed), tied(n, seed, 3.0)] {
                let gaps = noise(n, seed + 100);
                for share in [0.1, 0.4] {
                    let with_gaps = |(x, gap): (&f64, &f64)| if *gap < 2.0 * share - 1.0 { f64::NAN } else { *x };
                    let values: Vec<f64> = base.iter().zip(&gaps).map(with_gaps).collect();
                    check(&format!("{name}, {share} missing, seed {seed}"), &mesh, &values);
                }
                let mut values = base.clone();
                clustered(&mesh, seed, &mut values);
                check(&format!("{name}, clusters missing, seed {seed}"), &mesh, &values);
            }
        }
    }
}

#[test]
fn what_is_missing_is_said() {
    let mesh = shapes::octahedron().unwrap();
    let code = |values: &[f64], missing| {
        ScalarField::with_missing(&mesh, values, missing).map(|field| field.is_partial()).map_err(|e| e.code())
    };
    let gap = [f64::NAN, 1.0, 2.0, 3.0, 4.0, 5.0];
    assert_eq!(code(&gap, Missing::Error), Err("NonFiniteValue"));
    assert_eq!(code(&gap, Missing::Omit), Ok(true));
    assert_eq!(code(&gap, Missing::Fill), Err("InapplicableOption"));
    assert_eq!(code(&gap[1..], Missing::Omit), Err("LengthMismatch"));
    assert_eq!(code(&[0.0; 6], Missing::Omit), Ok(false));
    assert_eq!(code(&[f64::NAN; 6], Missing::Omit), Err("EmptyMesh"));
    assert_eq!(code(&[f64::NAN, f64::INFINITY, 2.0, 3.0, 4.0, 5.0], Missing::Omit), Err("NonFiniteValue"));
    assert_eq!(Missing::ALL.iter().map(|missing| missing.name()).collect::<Vec<_>>(), ["error", "omit", "fill"]);
    assert_eq!(Missing::from_name("omit"), Some(Missing::Omit));
}

#[test]
fn one_value_for_each_triangle_is_recognised() {
    let mesh = shapes::octahedron().unwrap();
    let error = ScalarField::new(&mesh, &[0.0; 8]).unwrap_err();
    assert_eq!(error.code(), "LengthMismatch");
    let message = error.to_string();
    assert!(message.contains("triangle") && message.contains("average"), "{message}");
    assert_eq!(
        error.detail(),
        [("expected", morse_smooth::error::Detail::Integer(6)), ("actual", morse_smooth::error::Detail::Integer(8))]
    );
    let other = ScalarField::new(&mesh, &[0.0; 7]).unwrap_err().to_string();
    assert!(!other.contains("triangle"), "{other}");
}
