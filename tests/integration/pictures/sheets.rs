//! Sheets are pictures side by side; bars and titles take their part of a picture and leave the rest as it is.

use morse_smooth::field::{CriticalKind, CriticalPoint, LevelSets, MorseComplex};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::render::{
    Colormap, DrawOptions, Glyphs, Levels, Separatrices, SheetOptions, SnapshotOptions, sheet, snapshot,
};

use super::image::{Image, Rgb, WHITE, bare, code, coordinate, distance, draw};

fn fields() -> (TriMesh, Vec<f64>, Vec<f64>) {
    let mesh = shapes::torus(30, 18, 0.2).unwrap();
    let before: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| p[0] + 0.3 * p[1] * p[2]).collect();
    let after = before.iter().zip(mesh.positions().chunks_exact(3)).map(|(f, p)| 0.5 * f + 0.8 * p[1]).collect();
    (mesh, before, after)
}

fn plain<'a>(width: u32, height: u32) -> SheetOptions<'a> {
    let picture = SnapshotOptions { draw: DrawOptions::default(), ..bare(width, height) };
    SheetOptions { picture, titles: [""; 3], ..SheetOptions::default() }
}

/// The columns of a picture from one to another.
fn columns(image: &Image, from: usize, to: usize) -> Image {
    let pixels = (0..image.height).flat_map(|y| (from..to).map(move |x| (x, y))).map(|(x, y)| image.at(x, y)).collect();
    Image { width: to - from, height: image.height, pixels }
}

/// The rows, likewise.
fn rows(image: &Image, from: usize, to: usize) -> Image {
    let pixels = image.pixels[from * image.width..to * image.width].to_vec();
    Image { height: to - from, pixels, ..*image }
}

/// Lines are drawn in single precision, so that their place in the sheet shows in the last step of a few pixels.
fn alike(a: &Image, b: &Image) {
    let (count, most) = a.difference(b);
    assert!(count < 40 && most <= 2, "{count} pixels differ, by up to {most}");
}

fn extremes(values: &[f64]) -> [f64; 2] {
    [values.iter().copied().fold(f64::MAX, f64::min), values.iter().copied().fold(f64::MIN, f64::max)]
}

#[test]
fn a_sheet_is_three_snapshots() {
    let (mesh, before, after) = fields();
    let difference: Vec<f64> = before.iter().zip(&after).map(|(f, g)| g - f).collect();
    let ([a, b], [c, d]) = (extremes(&before), extremes(&after));
    let largest = extremes(&difference).map(f64::abs).into_iter().fold(0.0, f64::max);
    for given in [None, Some(0.37)] {
        let options = SheetOptions { largest_difference: given, ..plain(120, 90) };
        let image = Image::decode(&sheet(&mesh, &before, &after, &options).unwrap());
        assert_eq!((image.width, image.height), (360, 90));
        let mut picture = options.picture;
        picture.draw.range = Some([a.min(c), b.max(d)]);
        alike(&columns(&image, 0, 120), &draw(&mesh, &before, &picture));
        alike(&columns(&image, 120, 240), &draw(&mesh, &after, &picture));
        let largest = given.unwrap_or(largest);
        let mut picture = bare(120, 90);
        picture.draw.colormap = Colormap::CoolWarm;
        picture.draw.range = Some([-largest, largest]);
        assert!(columns(&image, 240, 360) == draw(&mesh, &difference, &picture));
    }
}

#[test]
fn without_a_difference_all_of_it_is_in_the_middle() {
    let (mesh, before, _) = fields();
    let image = Image::decode(&sheet(&mesh, &before, &before, &plain(120, 90)).unwrap());
    alike(&columns(&image, 0, 120), &columns(&image, 120, 240));
    // Only the light varies: grey, as the middle of the map.
    let last = columns(&image, 240, 360);
    assert!(last.pixels.iter().all(|[r, g, b]| r.abs_diff(*g) <= 2 && g.abs_diff(*b) <= 2));
    assert!(last.extent().is_some());
    // Constant fields are no exception.
    let constant = vec![3.0; before.len()];
    assert_eq!(code(sheet(&mesh, &constant, &constant, &plain(60, 50))), "a picture");
}

#[test]
fn what_belongs_to_one_field_is_refused() {
    let (mesh, before, after) = fields();
    let refused = |change: &dyn Fn(&mut SheetOptions<'_>)| {
        let mut options = plain(60, 50);
        change(&mut options);
        code(sheet(&mesh, &before, &after, &options))
    };
    assert_eq!(refused(&|_| ()), "a picture");
    let point = CriticalPoint { vertex: 0, kind: CriticalKind::Saddle, multiplicity: 1, on_boundary: false };
    let (sets, complex) = (LevelSets { offsets: vec![0], ..Default::default() }, MorseComplex::default());
    {
        let inapplicable = |draw: DrawOptions<'_>| {
            let picture = SnapshotOptions { draw, ..bare(60, 50) };
            code(sheet(&mesh, &before, &after, &SheetOptions { picture, ..SheetOptions::default() }))
        };
        let defaults = DrawOptions::default();
        assert_eq!(inapplicable(DrawOptions { levels: Levels::Traced(&sets), ..defaults }), "InapplicableOption");
        assert_eq!(
            inapplicable(DrawOptions { critical_points: Glyphs::Points(&[point]), ..defaults }),
            "InapplicableOption"
        );
        assert_eq!(
            inapplicable(DrawOptions { morse_complex: Separatrices::Traced(&complex), ..defaults }),
            "InapplicableOption"
        );
    }
    for largest in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e308] {
        assert_eq!(refused(&|options| options.largest_difference = Some(largest)), "InvalidOption", "{largest}");
    }
    for range in [[1.0, 0.0], [1.0, 1.0], [f64::NAN, 0.0]] {
        assert_eq!(refused(&|options| options.picture.draw.range = Some(range)), "InvalidOption", "{range:?}");
    }
    assert_eq!(refused(&|options| options.picture.camera.direction = Some([0.0; 3])), "InvalidOption");
    assert_eq!(refused(&|options| options.picture.width = 0), "InvalidOption");
    // Three of them are wider than a sheet may be.
    assert_eq!(refused(&|options| options.picture.width = 2731), "InvalidOption");
    assert_eq!(refused(&|options| (options.picture.width, options.picture.height) = (2730, 2)), "a picture");
    assert_eq!(code(sheet(&mesh, &before[1..], &after, &plain(60, 50))), "LengthMismatch");
    assert_eq!(code(sheet(&mesh, &before, &after[1..], &plain(60, 50))), "LengthMismatch");
    // Each has a range, and the difference has none.
    let far: Vec<f64> = (0..before.len()).map(|v| if v == 0 { 1.5e308 } else { 1.4e308 }).collect();
    let opposite: Vec<f64> = far.iter().map(|x| -x).collect();
    assert_eq!(code(sheet(&mesh, &far, &opposite, &plain(60, 50))), "RangeOverflow");
}

#[test]
fn titles_take_rows_above_and_leave_the_pictures_alone() {
    // Higher than wide, so that sizes do not depend on the height that is left.
    let (mesh, before, after) = fields();
    let mut options = plain(120, 200);
    let without = Image::decode(&sheet(&mesh, &before, &after, &options).unwrap());
    options.titles = ["f", "", "a longer title than there is room for, by far"];
    options.picture.title = "two fields";
    let with = Image::decode(&sheet(&mesh, &before, &after, &options).unwrap());
    let above = with.height - without.height;
    assert!(with.width == without.width && above > 20);
    alike(&rows(&with, above, with.height), &without);
    // Text in all places where there is some, apart from the borders.
    let ink = |from, to, top, bottom| rows(&columns(&with, from, to), top, bottom).extent();
    let half = above / 2;
    let found = ink(0, 360, 0, half).expect("the title");
    assert!(found[0].abs_diff(359 - found[1]) <= 3, "{found:?} is not in the middle");
    assert!(ink(0, 120, half, above).is_some() && ink(240, 360, half, above).is_some());
    assert!(ink(120, 240, half, above).is_none());
    let long = ink(240, 360, half, above).unwrap();
    assert!(long[0] > 0 && long[1] < 119, "{long:?}: the title is cut off");
}

#[test]
fn a_title_is_above_the_picture() {
    let (mesh, before, _) = fields();
    let options = SnapshotOptions { draw: DrawOptions::default(), ..bare(120, 200) };
    let with = draw(&mesh, &before, &SnapshotOptions { title: "title", ..options });
    // The rows that the title takes: those that a picture of the rest of the height does not have.
    let above = (1..100)
        .find(|&above| {
            let rest = draw(&mesh, &before, &SnapshotOptions { height: 200 - above as u32, ..options });
            rows(&with, above, 200).difference_above(&rest, 2).0 == 0
        })
        .expect("a picture below the title");
    let title = rows(&with, 0, above).extent().expect("a title");
    assert!(title[2] > 0 && title[3] + 1 < above && title[0].abs_diff(119 - title[1]) <= 3, "{title:?} of {above}");
}

/// Of a picture with a bar: the first column of the bar's part.
fn bar_from(mesh: &TriMesh, values: &[f64], options: &SnapshotOptions<'_>) -> (Image, usize) {
    let with = draw(mesh, values, &SnapshotOptions { color_bar: true, ..*options });
    let from = (1..with.width)
        .rev()
        .find(|&width| {
            let rest = draw(mesh, values, &SnapshotOptions { width: width as u32, color_bar: false, ..*options });
            columns(&with, 0, width) == rest
        })
        .expect("a picture beside the bar");
    (with, from)
}

#[test]
fn a_bar_shows_all_colors_in_their_order() {
    // Wider than high, so that sizes do not depend on the width that is left.
    let mesh = shapes::grid(5, 5).unwrap();
    let values = coordinate(&mesh, 0);
    for map in [Colormap::Viridis, Colormap::CoolWarm] {
        let mut options = bare(600, 300);
        options.draw.colormap = map;
        let (image, from) = bar_from(&mesh, &values, &options);
        assert!(from > 400, "{from}");
        // The column inside the bar with the most colors.
        let colored =
            |x: usize| (0..300).filter(|&y| image.at(x, y) != WHITE && image.at(x, y).iter().max() > Some(&60)).count();
        let column = (from..600).max_by_key(|&x| colored(x)).unwrap();
        let bar: Vec<Rgb> = (0..300).map(|y| image.at(column, y)).filter(|&color| color != WHITE).collect();
        assert!(bar.len() > 150, "{}", bar.len());
        let inside = &bar[3..bar.len() - 3];
        for (k, &color) in inside.iter().enumerate() {
            let place = 1.0 - (k as f64 + 3.5) / bar.len() as f64;
            let expected = map.color(place);
            assert!(distance(color, expected) <= 6, "{map:?} at {place}: {color:?}, not {expected:?}");
        }
    }
}

#[test]
fn bands_have_bars_of_as_many_colors() {
    let mesh = shapes::grid(5, 5).unwrap();
    let values = coordinate(&mesh, 0);
    let mut options = bare(600, 300);
    options.draw.bands = true;
    options.draw.levels = Levels::At(&[0.25, 0.5, 0.75]);
    let (image, from) = bar_from(&mesh, &values, &options);
    let mut counts = std::collections::BTreeMap::new();
    for y in 0..300 {
        for x in from..600 {
            *counts.entry(image.at(x, y)).or_insert(0) += 1;
        }
    }
    for place in [0.125, 0.375, 0.625, 0.875] {
        let expected = Colormap::Viridis.color(place);
        let near: usize = counts.iter().filter(|(color, _)| distance(**color, expected) <= 3).map(|(_, n)| n).sum();
        assert!(near > 300, "{near} pixels of the color at {place}");
    }
}

#[test]
fn small_pictures_have_no_bar() {
    let mesh = shapes::grid(5, 5).unwrap();
    let values = coordinate(&mesh, 0);
    for (width, height) in [(40, 40), (100, 300), (300, 40), (1, 1), (1, 500), (500, 1)] {
        let [with, without] = [true, false]
            .map(|color_bar| snapshot(&mesh, &values, &SnapshotOptions { color_bar, ..bare(width, height) }).unwrap());
        assert!(with == without, "{width} × {height}");
    }
}

#[test]
fn any_range_has_a_bar_that_fits() {
    let mesh = shapes::grid(5, 5).unwrap();
    let values = coordinate(&mesh, 0);
    for range in [
        [0.0, 1.0],
        [-1e300, 1e300],
        [1e-300, 2e-300],
        [0.0, 5e-324],
        [1e15, 1e15 + 1.0],
        [-123_456.789, 0.000_1],
        [999.5, 1000.5],
        [-1e-9, 1e9],
    ] {
        let mut options = SnapshotOptions { color_bar: true, ..bare(700, 300) };
        options.draw.range = Some(range);
        let image = draw(&mesh, &values, &options);
        // Nothing touches the border: no label is cut off.
        let [left, right, top, bottom] = image.extent().unwrap();
        assert!(left > 0 && top > 0 && right < 699 && bottom < 299, "{range:?}: {left} to {right}, {top} to {bottom}");
    }
}
