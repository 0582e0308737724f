//! Where values are missing the surface is grey, and everything else is that of the field on the part that has values.

use morse_smooth::Watch;
use morse_smooth::field::{self, DeltaOptions, Missing, PathStyle, ScalarField, Threshold};
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::render::{
    Colormap, DrawList, DrawOptions, Levels, Role, Scene, Separatrices, SheetOptions, SnapshotOptions, sheet, snapshot,
};

use super::image::{Image, bare, code, coordinate, distance, draw, from, lit};
use super::planes::edges;
use crate::support;

/// The documented color of gaps.
const GREY: [u8; 3] = [0xaa; 3];

fn omitting<'a>(options: SnapshotOptions<'a>) -> SnapshotOptions<'a> {
    SnapshotOptions { draw: DrawOptions { missing: Missing::Omit, ..options.draw }, ..options }
}

/// Each vertex without a value with that chance, by a seed.
fn with_gaps(values: &[f64], part: f64, seed: u64) -> Vec<f64> {
    let chances = support::noise(values.len(), seed);
    values
        .iter()
        .zip(chances)
        .map(|(&value, chance)| if 0.5 * (chance + 1.0) < part { f64::NAN } else { value })
        .collect()
}

#[test]
fn a_triangle_without_a_value_at_a_corner_is_grey_and_no_other() {
    let mesh = shapes::grid(9, 7).unwrap();
    for (map, bands) in [(Colormap::Viridis, false), (Colormap::CoolWarm, true)] {
        let whole = coordinate(&mesh, 0);
        let mut values = whole.clone();
        // A vertex inside, one on the border, and a corner of the grid, for which no other triangle has to give way.
        for v in [3 * 7 + 3, 7 * 7, 0] {
            values[v] = f64::NAN;
        }
        let mut options = bare(420, 300);
        options.draw.colormap = map;
        options.draw.bands = bands;
        options.draw.range = Some([0.0, 1.0]);
        options.draw.levels = if bands { Levels::Count(5) } else { Levels::None };
        let full = draw(&mesh, &whole, &options);
        let image = draw(&mesh, &values, &omitting(options));
        let light = Scene::new(&mesh).draw_list(&whole, &options.draw).unwrap().light;
        let grey = lit(GREY, &light, [0.0, 0.0, 1.0]).map(|x| x.round() as u8);
        let [left, right, top, bottom] = edges(&full);
        let (mut in_gaps, mut beside) = (0, 0);
        for y in 0..300 {
            for x in 0..420 {
                let place = [(x as f64 + 0.5 - left) / (right - left), (bottom - y as f64 - 0.5) / (bottom - top)];
                // Pixels on an edge show both sides of it.
                let Some(triangle) = triangle_at(&mesh, place, 1.5 / (right - left)) else { continue };
                if triangle.iter().any(|&v| values[v as usize].is_nan()) {
                    assert!(distance(image.at(x, y), grey) <= 1, "at {x}, {y}: {:?}, not {grey:?}", image.at(x, y));
                    in_gaps += 1;
                } else if !bands {
                    assert_eq!(image.at(x, y), full.at(x, y), "at {x}, {y}");
                    beside += 1;
                }
            }
        }
        // The vertex inside has six triangles, the one on the border three, the corner one or two: of 96.
        let pixels = (right - left) * (bottom - top);
        assert!((0.07..0.12).contains(&(f64::from(in_gaps) / pixels)), "{in_gaps} of {pixels}");
        assert!(bands || f64::from(beside) > 0.6 * pixels);
    }
}

/// The triangle of a plane mesh in which a point is, so far from its edges.
fn triangle_at(mesh: &TriMesh, [x, y]: [f64; 2], margin: f64) -> Option<[u32; 3]> {
    let all = mesh.connectivity().triangles();
    let is_inside = |corners: &&[u32; 3]| {
        let points = corners.map(|v| mesh.position(v));
        let area =
            |[ax, ay]: [f64; 2], [bx, by]: [f64; 2], [cx, cy]: [f64; 2]| (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        let [a, b, c] = points.map(|p| [p[0], p[1]]);
        let turn = area(a, b, c).signum();
        [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| {
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            turn * area(from, to, [x, y]) > margin * length
        })
    };
    all.iter().find(is_inside).copied()
}

#[test]
fn what_is_drawn_is_that_of_the_part_with_values() {
    let mut drawn = 0;
    for (seed, (name, mesh)) in (0..).zip(support::every_kind()) {
        let values = with_gaps(&support::noise(mesh.vertex_count(), seed), 0.08, seed + 100);
        let has = |v: u32| !values[v as usize].is_nan();
        let Ok(part) = mesh.submesh(&has) else { continue };
        let part_values: Vec<f64> = part.vertices.iter().map(|&v| values[v as usize]).collect();
        let (scene, options) = (Scene::new(&mesh), all_there_is());
        let list = scene.draw_list(&values, &options).unwrap();
        let surface = scene.surface();

        let found = |role: Role| list.lines.iter().find(|lines| lines.role == role);
        let field = ScalarField::new(&part.mesh, &part_values).unwrap();
        let range = field.range();
        assert_eq!(list.range, [range.min, range.max], "{name}");
        assert_eq!(list.gap.is_some(), !surface.vertices.iter().all(|&v| has(v)), "{name}");
        for (corner, shade) in list.shades.iter().enumerate() {
            assert_eq!(shade.is_nan(), !has(surface.vertices[corner]), "{name}: corner {corner}");
        }

        // The lines of the part, put in their places.
        let sets = field::level_sets(&field, &list.levels, &Watch::none()).unwrap();
        let expected: Vec<f64> =
            sets.points.as_chunks::<3>().0.iter().flat_map(|&point| surface.place(point)).collect();
        let lines = found(Role::Levels).unwrap();
        assert_eq!((&lines.points, &lines.offsets), (&expected, &sets.offsets), "{name}");

        let complex =
            field::morse_complex(&field, Threshold::Relative(0.0), PathStyle::Merged, &Watch::none()).unwrap();
        let count = found(Role::Descending).map_or(0, |lines| lines.points.len())
            + found(Role::Ascending).map_or(0, |lines| lines.points.len());
        assert_eq!(count, 3 * complex.vertices.len(), "{name}");
        let mut expected: Vec<[f64; 3]> =
            complex.vertices.iter().map(|&v| surface.place(part.mesh.position(v))).collect();
        let lines = list.lines.iter().filter(|lines| lines.role != Role::Levels);
        let mut places: Vec<[f64; 3]> = lines.flat_map(|lines| lines.points.as_chunks::<3>().0.to_vec()).collect();
        expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
        places.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(places, expected, "{name}");

        let points = field::critical_points(&field, &DeltaOptions::default(), &Watch::none()).unwrap().points;
        let mut expected: Vec<u32> = points.iter().map(|point| part.vertices[point.vertex as usize]).collect();
        let mut vertices: Vec<u32> = list.solids.iter().flat_map(|solids| solids.vertices.clone()).collect();
        expected.sort_unstable();
        vertices.sort_unstable();
        assert_eq!(vertices, expected, "{name}");
        drawn += usize::from(list.gap.is_some());

        // And there is a picture of it.
        let picture = SnapshotOptions { draw: options, ..bare(60, 50) };
        assert!(draw(&mesh, &values, &picture).extent().is_some(), "{name}");
    }
    assert!(drawn > 5, "{drawn} meshes had gaps");
}

fn all_there_is() -> DrawOptions<'static> {
    DrawOptions {
        levels: Levels::Count(4),
        morse_complex: Separatrices::Above(Threshold::Relative(0.0)),
        missing: Missing::Omit,
        ..DrawOptions::default()
    }
}

#[test]
fn nothing_changes_where_nothing_is_missing() {
    let mesh = shapes::torus(20, 12, 0.2).unwrap();
    let values = support::noise(mesh.vertex_count(), 3);
    let options = SnapshotOptions { width: 200, height: 150, ..SnapshotOptions::default() };
    let list = |missing| -> DrawList {
        Scene::new(&mesh).draw_list(&values, &DrawOptions { missing, ..options.draw }).unwrap()
    };
    assert_eq!(list(Missing::Omit), list(Missing::Error));
    assert!(draw(&mesh, &values, &options) == draw(&mesh, &values, &omitting(options)));
}

#[test]
fn a_constant_with_gaps_is_drawn() {
    let mesh = shapes::grid(5, 5).unwrap();
    let mut values = vec![2.0; 25];
    values[12] = f64::NAN;
    let list = Scene::new(&mesh).draw_list(&values, &all_there_is()).unwrap();
    assert_eq!(list.range, [2.0, 2.0]);
    assert_eq!(list.shades.iter().filter(|shade| shade.is_nan()).count(), 1);
    assert!(list.shades.iter().all(|&shade| shade.is_nan() || shade == 0.5));
    assert_eq!((list.color(f64::NAN), list.gap), (GREY, Some(GREY)));
}

#[test]
fn what_is_no_gap_is_refused() {
    let mesh = shapes::torus(6, 5, 0.1).unwrap();
    let mut values = support::noise(mesh.vertex_count(), 1);
    values[7] = f64::NAN;
    let found = |values: &[f64], missing| {
        let draw = DrawOptions { missing, ..bare(40, 30).draw };
        code(snapshot(&mesh, values, &SnapshotOptions { draw, ..bare(40, 30) }))
    };
    assert_eq!(found(&values, Missing::Omit), "a picture");
    assert_eq!(found(&values, Missing::Error), "NonFiniteValue");
    assert_eq!(found(&values, Missing::Fill), "InapplicableOption");
    assert_eq!(found(&values[1..], Missing::Omit), "LengthMismatch");
    assert_eq!(found(&vec![f64::NAN; values.len()], Missing::Omit), "EmptyMesh");
    values[3] = f64::INFINITY;
    assert_eq!(found(&values, Missing::Omit), "NonFiniteValue");
}

#[test]
fn a_sheet_shows_the_gaps_of_each_field_and_of_both_in_the_difference() {
    let mesh = shapes::grid(9, 9).unwrap();
    let after = coordinate(&mesh, 0);
    let mut before = after.clone();
    before[4 * 9 + 4] = f64::NAN;
    let mut options = SheetOptions { titles: [""; 3], ..SheetOptions::default() };
    options.picture = omitting(SnapshotOptions { color_bar: false, ..bare(150, 150) });
    let image = Image::decode(&sheet(&mesh, &before, &after, &options).unwrap());
    // No color of either map is grey like this, up to what pixels on edges mix.
    let grey = image.at(75, 75);
    assert!(distance(grey, [grey[0]; 3]) <= 1, "{grey:?}");
    let counts = [0, 1, 2].map(|k| image.places(|pixel| pixel == grey).iter().filter(|[x, _]| x / 150 == k).count());
    assert!(counts[0] > 100 && counts[1] == 0 && counts[0].abs_diff(counts[2]) < 20, "{counts:?}");
    // The largest difference is that of the values that there are.
    let mut far = after.clone();
    far[0] += 3.0;
    far[4 * 9 + 4] = f64::NAN;
    assert_eq!(code(sheet(&mesh, &before, &far, &options)), "a picture");
    options.picture.draw.missing = Missing::Error;
    assert_eq!(code(sheet(&mesh, &before, &far, &options)), "NonFiniteValue");
}

#[test]
fn the_bar_says_what_grey_means() {
    let mesh = shapes::grid(9, 9).unwrap();
    let mut values = coordinate(&mesh, 0);
    let options = omitting(SnapshotOptions { color_bar: true, ..bare(600, 450) });
    let grey = |image: &Image| image.places(|pixel| pixel == GREY);
    assert_eq!(grey(&draw(&mesh, &values, &options)), Vec::<[usize; 2]>::new());
    values[40] = f64::NAN;
    let image = draw(&mesh, &values, &options);
    let patch = grey(&image);
    // Right of the surface and below the bar, whose last row is that of the lowest value.
    let low = options.draw.colormap.color(0.0);
    let bar = image.places(|pixel| distance(pixel, low) <= 2);
    let lowest = bar.iter().filter(|[x, _]| *x > 400).map(|place| place[1]).max().unwrap();
    assert!(patch.len() > 60, "{} pixels", patch.len());
    assert!(patch.iter().all(|&[x, y]| x > 400 && y > lowest), "{patch:?}");
    // Where there is no room for the words, the bar is there without them.
    let mut kinds = [0; 3];
    for width in (180..400).step_by(5) {
        let narrow = SnapshotOptions { width, height: 200, ..options };
        let right_of = |values: &[f64], is_meant: &dyn Fn([u8; 3]) -> bool| {
            let places = draw(&mesh, values, &narrow).places(is_meant);
            places.iter().any(|place| place[0] as f64 > 0.7 * f64::from(width))
        };
        let is_low = |pixel| distance(pixel, low) <= 8;
        let has_bar = right_of(&values, &is_low);
        assert_eq!(has_bar, right_of(&coordinate(&mesh, 0), &is_low), "{width} pixels");
        let has_words = right_of(&values, &|pixel| pixel == GREY);
        assert!(has_bar || !has_words, "{width} pixels");
        kinds[usize::from(has_bar) + usize::from(has_words)] += 1;
    }
    assert!(kinds.iter().all(|&count| count > 0), "{kinds:?}");
    // From any side.
    let turned = draw(&mesh, &values, &from([0.0, 0.0, -1.0], options));
    assert_eq!(grey(&turned), patch);
}
