//! What cannot be drawn is refused by name, and what is large or small is drawn.

use morse_smooth::field::{CriticalKind, CriticalPoint, LevelSets, MorseComplex, Threshold};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::render::{DrawOptions, Glyphs, Levels, Separatrices, SheetOptions, SnapshotOptions, sheet, snapshot};

use super::image::{Image, WHITE, bare, code, coordinate};
use crate::analyses::level_sets;
use crate::support;

fn torus() -> (TriMesh, Vec<f64>) {
    let mesh = shapes::torus(6, 5, 0.1).unwrap();
    let values = support::noise(mesh.vertex_count(), 1);
    (mesh, values)
}

fn refused(draw: DrawOptions<'_>) -> &'static str {
    let (mesh, values) = torus();
    code(snapshot(&mesh, &values, &SnapshotOptions { draw, ..bare(40, 30) }))
}

#[test]
fn fields_that_are_none() {
    let (mesh, values) = torus();
    let found = |values: &[f64]| code(snapshot(&mesh, values, &bare(40, 30)));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut field = values.clone();
        field[5] = bad;
        assert_eq!(found(&field), "NonFiniteValue");
        assert_eq!(code(sheet(&mesh, &values, &field, &SheetOptions::default())), "NonFiniteValue");
        assert_eq!(code(sheet(&mesh, &field, &values, &SheetOptions::default())), "NonFiniteValue");
    }
    assert_eq!(found(&values[1..]), "LengthMismatch");
    assert_eq!(found(&[]), "LengthMismatch");
    let mut long = values.clone();
    long.push(0.0);
    assert_eq!(found(&long), "LengthMismatch");
    let mut wide = values.clone();
    (wide[0], wide[1]) = (-1.5e308, 1.5e308);
    assert_eq!(found(&wide), "RangeOverflow");
}

#[test]
fn sizes() {
    let (mesh, values) = torus();
    let found = |width, height| code(snapshot(&mesh, &values, &bare(width, height)));
    for (width, height) in [(0, 10), (10, 0), (0, 0), (8193, 10), (10, 8193), (u32::MAX, u32::MAX)] {
        assert_eq!(found(width, height), "InvalidOption", "{width} × {height}");
    }
    for (width, height) in [(1, 1), (1, 900), (900, 1), (2, 3), (8192, 1), (1, 8192)] {
        for options in [bare(width, height), SnapshotOptions { width, height, title: "title", ..Default::default() }] {
            let image = Image::decode(&snapshot(&mesh, &values, &options).unwrap());
            assert_eq!((image.width, image.height), (width as usize, height as usize));
        }
    }
    // The one pixel is not empty.
    assert!(Image::decode(&snapshot(&mesh, &values, &bare(1, 1)).unwrap()).at(0, 0) != WHITE);
}

#[test]
fn the_largest_pictures_are_drawn() {
    let (mesh, values) = torus();
    for (width, height) in [(8192, 64), (64, 8192)] {
        let options = SnapshotOptions { width, height, ..Default::default() };
        let image = Image::decode(&snapshot(&mesh, &values, &options).unwrap());
        assert_eq!((image.width, image.height), (width as usize, height as usize));
        let [left, right, top, bottom] = image.extent().unwrap();
        assert!(right - left > 40 && bottom - top > 40);
    }
}

/// By hand: `cargo test --release --features render -- --ignored largest_of_all --nocapture` for time and memory.
#[test]
#[ignore = "a quarter of a gigabyte and seconds"]
fn the_largest_of_all_is_drawn() {
    let (mesh, values) = torus();
    let options = SnapshotOptions { width: 8192, height: 8192, ..Default::default() };
    let file = snapshot(&mesh, &values, &options).unwrap();
    let image = Image::decode(&file);
    let [left, right, ..] = image.extent().unwrap();
    assert!(image.width == 8192 && image.height == 8192 && right - left > 6000);
}

#[test]
fn ranges() {
    for range in [
        [1.0, 0.0],
        [1.0, 1.0],
        [f64::NAN, 1.0],
        [0.0, f64::NAN],
        [f64::NEG_INFINITY, 0.0],
        [0.0, f64::INFINITY],
        [-1.5e308, 1.5e308],
    ] {
        assert_eq!(refused(DrawOptions { range: Some(range), ..Default::default() }), "InvalidOption", "{range:?}");
    }
    for range in [[5.0, 6.0], [-1e300, 1e300], [0.0, 5e-324], [1e-310, 2e-310]] {
        assert_eq!(refused(DrawOptions { range: Some(range), ..Default::default() }), "a picture", "{range:?}");
    }
}

#[test]
fn levels() {
    let levels = |levels: Levels<'_>| refused(DrawOptions { levels, ..Default::default() });
    assert_eq!(levels(Levels::Count(10_001)), "InvalidOption");
    assert_eq!(levels(Levels::Count(u32::MAX)), "InvalidOption");
    assert_eq!(levels(Levels::Count(0)), "a picture");
    assert_eq!(levels(Levels::At(&[])), "a picture");
    assert_eq!(levels(Levels::At(&[0.1, f64::NAN])), "NonFiniteLevel");
    assert_eq!(levels(Levels::At(&[f64::INFINITY])), "NonFiniteLevel");
    assert_eq!(levels(Levels::At(&vec![0.0; 10_001])), "InvalidOption");
    assert_eq!(levels(Levels::At(&[1e300, -1e300, 0.0, 0.0, -0.0])), "a picture");
}

#[test]
fn lines_that_are_broken() {
    let (mesh, values) = torus();
    let good = level_sets(&mesh, &values, &[0.0, 0.1]).unwrap();
    let found = |change: &dyn Fn(&mut LevelSets)| {
        let mut sets = good.clone();
        change(&mut sets);
        let bands = refused(DrawOptions { levels: Levels::Traced(&sets), bands: true, ..Default::default() });
        let plain = refused(DrawOptions { levels: Levels::Traced(&sets), ..Default::default() });
        assert_eq!(bands, plain);
        plain
    };
    assert_eq!(found(&|_| ()), "a picture");
    assert_eq!(found(&|sets| sets.offsets.clear()), "InvalidOption");
    assert_eq!(found(&|sets| sets.offsets[1] = 100_000), "InvalidOption");
    assert_eq!(found(&|sets| sets.offsets[0] = 1), "InvalidOption");
    assert_eq!(found(&|sets| *sets.offsets.last_mut().unwrap() += 1), "InvalidOption");
    assert_eq!(found(&|sets| sets.offsets.truncate(2)), "InvalidOption");
    assert_eq!(found(&|sets| sets.closed.truncate(1)), "InvalidOption");
    assert_eq!(found(&|sets| sets.points.truncate(7)), "InvalidOption");
    assert_eq!(found(&|sets| sets.points[4] = f64::NAN), "InvalidOption");
    assert_eq!(found(&|sets| sets.points[4] = f64::INFINITY), "InvalidOption");
    assert_eq!(found(&|sets| sets.levels[0] = f64::NAN), "InvalidOption");
    assert_eq!(found(&|sets| sets.levels.clear()), "InvalidOption");
    // A line of one point is none, and one that is far away is not in the picture.
    let one = LevelSets {
        points: vec![0.0; 3],
        offsets: vec![0, 1],
        closed: vec![true],
        levels: vec![0.0],
        ..Default::default()
    };
    assert_eq!(refused(DrawOptions { levels: Levels::Traced(&one), ..Default::default() }), "a picture");
    for far in [1e9, 1e150, 1e308, -1e308] {
        let points = vec![0.0, 0.0, 0.0, far, 1.0, far, 0.5, far, -far];
        let line =
            LevelSets { points, offsets: vec![0, 3], closed: vec![true], levels: vec![0.0], ..Default::default() };
        let result = refused(DrawOptions { levels: Levels::Traced(&line), ..Default::default() });
        assert!(["a picture", "InvalidOption"].contains(&result), "{far}: {result}");
    }
}

#[test]
fn ids_out_of_bounds() {
    let (mesh, _) = torus();
    let n = mesh.vertex_count() as u32;
    for vertex in [n, u32::MAX] {
        let point = CriticalPoint { vertex, kind: CriticalKind::Saddle, multiplicity: 1, on_boundary: false };
        let draw = DrawOptions { critical_points: Glyphs::Points(&[point]), ..Default::default() };
        assert_eq!(refused(draw), "IndexOutOfBounds");
        let complex = MorseComplex {
            vertices: vec![0, vertex],
            offsets: vec![0, 2],
            saddles: vec![0],
            extrema: vec![vertex],
            kinds: vec![CriticalKind::Minimum],
        };
        let draw = DrawOptions { morse_complex: Separatrices::Traced(&complex), ..Default::default() };
        assert_eq!(refused(draw), "IndexOutOfBounds");
    }
}

#[test]
fn complexes_that_are_broken() {
    let complex = |offsets: &[u32], kinds: usize| {
        let complex = MorseComplex {
            vertices: vec![0, 1, 2],
            offsets: offsets.to_vec(),
            saddles: Vec::new(),
            extrema: Vec::new(),
            kinds: vec![CriticalKind::Maximum; kinds],
        };
        refused(DrawOptions { morse_complex: Separatrices::Traced(&complex), ..Default::default() })
    };
    assert_eq!(complex(&[0, 3], 1), "a picture");
    assert_eq!(complex(&[0, 1, 1, 3], 3), "a picture");
    for (offsets, kinds) in
        [(&[][..], 0), (&[0, 4], 1), (&[0, 2], 1), (&[0, 3], 2), (&[0, 3], 0), (&[1, 3], 1), (&[0, 9, 3], 2)]
    {
        assert_eq!(complex(offsets, kinds), "InvalidOption", "{offsets:?}");
    }
    for threshold in [-0.1, f64::NAN, f64::INFINITY] {
        for threshold in [Threshold::Relative(threshold), Threshold::Absolute(threshold)] {
            let draw = DrawOptions { morse_complex: Separatrices::Above(threshold), ..Default::default() };
            assert_eq!(refused(draw), "InvalidOption", "{threshold:?}");
        }
    }
}

#[test]
fn many_lines_of_noise_are_drawn() {
    let mesh = shapes::torus(60, 40, 0.2).unwrap();
    let values = support::noise(mesh.vertex_count(), 1);
    let mut options = bare(60, 40);
    options.draw.levels = Levels::Count(300);
    assert_eq!(code(snapshot(&mesh, &values, &options)), "a picture");
    let flat = coordinate(&shapes::grid(3, 3).unwrap(), 0);
    options.draw.levels = Levels::Count(10_000);
    options.draw.bands = true;
    assert_eq!(code(snapshot(&shapes::grid(3, 3).unwrap(), &flat, &options)), "a picture");
}
