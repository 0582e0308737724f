//! Lines lie where the curves are, have the width that they should, and are seen where the surface under them is.

use morse_smooth::field::LevelSets;
use morse_smooth::mesh::{TriMesh, shapes};
use morse_smooth::render::{Levels, Scene, SnapshotOptions};

use super::image::{Image, bare, coordinate, draw, from, tile, united};
use super::planes::edges;

use crate::analyses::level_sets;

/// How much darker each pixel is with the lines than without them: 1 where a line covers it.
struct Ink {
    without: Image,
    with: Image,
    color: [u8; 3],
    opacity: f64,
}

impl Ink {
    fn of(mesh: &TriMesh, values: &[f64], options: &SnapshotOptions<'_>) -> Self {
        let mut plain = *options;
        plain.draw.levels = Levels::None;
        let list = Scene::new(mesh).draw_list(values, &options.draw).unwrap();
        let stroke = list.lines[0].stroke;
        Self {
            without: draw(mesh, values, &plain),
            with: draw(mesh, values, options),
            color: stroke.color,
            opacity: stroke.opacity,
        }
    }

    fn at(&self, x: usize, y: usize) -> f64 {
        let difference =
            |from: [u8; 3], to: [u8; 3]| (0..3).map(|c| f64::from(from[c]) - f64::from(to[c])).sum::<f64>();
        let (plain, drawn) = (self.without.at(x, y), self.with.at(x, y));
        difference(plain, drawn) / (self.opacity * difference(plain, self.color))
    }

    /// Between the middles of pixels.
    fn sample(&self, x: f64, y: f64) -> f64 {
        let (x, y) = (x - 0.5, y - 0.5);
        let (i, j) = (x.floor(), y.floor());
        let (u, v) = (x - i, y - j);
        let (i, j) = (i as usize, j as usize);
        (1.0 - v) * ((1.0 - u) * self.at(i, j) + u * self.at(i + 1, j))
            + v * ((1.0 - u) * self.at(i, j + 1) + u * self.at(i + 1, j + 1))
    }
}

#[test]
fn level_sets_of_the_distance_are_circles() {
    let mesh = shapes::grid(61, 61).unwrap();
    let values: Vec<f64> =
        mesh.positions().chunks_exact(3).map(|p| ((p[0] - 0.5).powi(2) + (p[1] - 0.5).powi(2)).sqrt()).collect();
    let levels = [0.1, 0.2, 0.3, 0.4];
    // Wide enough that lines have a pixel and a half.
    let mut options = bare(900, 900);
    options.draw.levels = Levels::At(&levels);
    options.draw.colormap = morse_smooth::render::Colormap::CoolWarm;
    let ink = Ink::of(&mesh, &values, &options);
    let [left, right, top, bottom] = edges(&ink.without);
    let (scale, middle) = (right - left, [0.5 * (left + right), 0.5 * (top + bottom)]);
    let width = Scene::new(&mesh).draw_list(&values, &options.draw).unwrap().lines[0].stroke.width;
    for radius in levels {
        let (mut worst, mut widths) = (0.0_f64, 0.0);
        for k in 0..360 {
            let (sin, cos) = f64::from(k).to_radians().sin_cos();
            let (mut sum, mut moment) = (0.0, 0.0);
            for step in -40..=40 {
                let away = 0.125 * f64::from(step);
                let r = radius * scale + away;
                let amount = ink.sample(middle[0] + r * cos, middle[1] - r * sin);
                sum += amount;
                moment += amount * away;
            }
            assert!(sum > 1.0, "radius {radius}, at {k}°: no line");
            worst = worst.max((moment / sum).abs());
            widths += 0.125 * sum / 360.0;
        }
        // On cells of 14 pixels the level sets are chords, up to 0.3 pixels from the circle.
        assert!(worst < 0.8, "radius {radius}: up to {worst} pixels beside");
        assert!((widths - width).abs() < 0.15 * width, "radius {radius}: {widths} pixels wide, not {width}");
    }
    // And nowhere else.
    let [left, right, top, bottom] = ink.without.extent().unwrap();
    for y in top..bottom {
        for x in left..right {
            let r = (x as f64 + 0.5 - middle[0]).hypot(y as f64 + 0.5 - middle[1]) / scale;
            if levels.iter().all(|level| (r - level).abs() * scale > 2.5) {
                assert_eq!(ink.with.at(x, y), ink.without.at(x, y), "at {x}, {y}");
            }
        }
    }
}

#[test]
fn corners_are_rounded_a_little() {
    // Level sets of |x − ½| + |y − ½| on these cells are squares that stand on a corner.
    let mesh = shapes::grid(3, 3).unwrap();
    let values: Vec<f64> = mesh.positions().chunks_exact(3).map(|p| (p[0] - 0.5).abs() + (p[1] - 0.5).abs()).collect();
    for size in [300, 900] {
        let mut options = bare(size, size);
        options.draw.levels = Levels::At(&[0.25]);
        let ink = Ink::of(&mesh, &values, &options);
        let [left, right, top, bottom] = edges(&ink.without);
        let (middle, reach) = ([0.5 * (left + right), 0.5 * (top + bottom)], 0.25 * (right - left));
        // Inside a corner two strokes meet, which moves the darkest place inwards by about as much again.
        let tip = |x: f64, y: f64| {
            (-8..=24)
                .map(|step| reach - 0.25 * f64::from(step))
                .max_by(|&r, &s| {
                    let at = |r: f64| ink.sample(middle[0] + r * x, middle[1] - r * y);
                    at(r).total_cmp(&at(s))
                })
                .unwrap()
        };
        for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let found = tip(x, y);
            assert!((found - reach).abs() <= 1.5, "{size}: a corner at {found}, not at {reach}");
        }
    }
}

#[test]
fn lines_are_as_wide_in_proportion_to_the_picture() {
    let mesh = shapes::grid(5, 5).unwrap();
    let values = coordinate(&mesh, 0);
    for (size, expected) in [(900, 1.0), (1350, 1.5), (600, 2.0 / 3.0)] {
        let mut options = bare(size, size);
        options.draw.levels = Levels::At(&[0.4]);
        let ink = Ink::of(&mesh, &values, &options);
        let width = Scene::new(&mesh).draw_list(&values, &options.draw).unwrap().lines[0].stroke.width;
        let [left, right, ..] = edges(&ink.without);
        let line = left + 0.4 * (right - left);
        let row = size as usize / 2;
        let columns = (line as usize - 5)..(line as usize + 6);
        let found: f64 = columns.clone().map(|x| ink.at(x, row)).sum();
        let place = columns.map(|x| ink.at(x, row) * (x as f64 + 0.5)).sum::<f64>() / found;
        assert!((found - expected * width).abs() < 0.06 * expected * width, "{size}: {found} wide");
        assert!((place - line).abs() < 0.25, "{size}: at {place}, not {line}");
    }
}

/// A front tile (vertices 8 to 11) and a larger one behind, with small ones that span the box.
fn sheets(front: f64, behind: f64) -> (TriMesh, Vec<f64>) {
    let mesh = united(&[
        tile(-1.5, -1.5, -1.0, 0.01),
        tile(1.5, 1.5, 1.0, 0.01),
        tile(0.0, 0.0, 0.3, front),
        tile(0.0, 0.0, -0.3, behind),
    ]);
    // In front the values are x from −1 to 1, behind they are y + 10.
    let values = (0..mesh.vertex_count() as u32)
        .map(|v| {
            let [x, y, _] = mesh.position(v);
            match v {
                8..12 => x / front,
                12.. => 10.0 + y / behind,
                _ => 0.0,
            }
        })
        .collect();
    (mesh, values)
}

#[test]
fn lines_behind_a_sheet_are_hidden_and_those_in_front_are_not() {
    let (mesh, values) = sheets(1.0, 0.7);
    let look = |z: f64, levels: &[f64]| {
        let mut options = from([0.0, 0.0, z], bare(300, 300));
        options.draw.range = Some([-1.0, 11.0]);
        options.draw.levels = Levels::At(levels);
        draw(&mesh, &values, &options)
    };
    let levels_behind: Vec<f64> = (-9..10).map(|k| 10.0 + f64::from(k) / 10.0).collect();
    let none = look(1.0, &[]);
    assert!(look(1.0, &levels_behind).pixels == none.pixels, "lines behind shine through");
    assert!(look(1.0, &[0.3]).difference(&none).0 > 150);
    // Seen from behind it is the other way round, but for what the smaller sheet leaves open.
    let none = look(-1.0, &[]);
    assert!(look(-1.0, &levels_behind).difference(&none).0 > 1000);
    let beside = look(-1.0, &[0.3]).difference(&none).0;
    assert!(beside > 20 && beside < 150, "{beside}");
}

#[test]
fn lines_on_the_other_side_of_a_thin_wall_are_hidden() {
    for gap in [0.02, 0.005, 0.001] {
        let mesh = united(&[tile(0.0, 0.0, 0.0, 1.0), tile(0.0, 0.0, -gap, 0.9)]);
        let values: Vec<f64> =
            (0..8).map(|v| if v < 4 { 0.0 } else { 10.0 + mesh.position(v)[1] + 0.3 * mesh.position(v)[0] }).collect();
        for direction in [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 2.0, 1.0]] {
            let mut options = from(direction, bare(300, 220));
            options.draw.range = Some([0.0, 12.0]);
            let without = draw(&mesh, &values, &options);
            options.draw.levels = Levels::At(&[9.2, 9.6, 10.0, 10.3, 10.6]);
            let (count, _) = draw(&mesh, &values, &options).difference(&without);
            assert_eq!(count, 0, "through a wall of {gap} from {direction:?}");
            let behind = from(direction.map(|x| -x), options);
            options.draw.levels = Levels::None;
            let without = draw(&mesh, &values, &from(direction.map(|x| -x), options));
            assert!(draw(&mesh, &values, &behind).difference(&without).0 > 200);
        }
    }
}

#[test]
fn a_line_is_seen_as_far_as_nothing_is_in_front() {
    let (mesh, values) = sheets(0.5, 1.0);
    let mut options = from([0.0, 0.0, 1.0], bare(450, 450));
    options.draw.range = Some([-1.0, 11.0]);
    // Across the middle of the sheet behind, at y = 0.2 on the side of the front one.
    options.draw.levels = Levels::At(&[10.2]);
    let ink = Ink::of(&mesh, &values, &options);
    let dark: Vec<[usize; 2]> = (0..450 * 450)
        .map(|k| [k % 450, k / 450])
        .filter(|&[x, y]| ink.without.at(x, y) != [255; 3] && ink.at(x, y) > 0.3)
        .collect();
    // The front tile's columns: those of a row through its middle that have its colors, x = ±0.5 at z = 0.3.
    let front = draw(&mesh, &values, &{
        let mut options = options;
        options.draw.levels = Levels::At(&[-0.999, 0.999]);
        options
    });
    let line = |from: usize, to: usize| {
        (from..to).max_by_key(|&x| {
            let (a, b) = (ink.without.at(x, 225), front.at(x, 225));
            (0..3).map(|c| u32::from(a[c].abs_diff(b[c]))).sum::<u32>()
        })
    };
    let (left, right) = (line(0, 225).unwrap(), line(225, 450).unwrap());
    assert!(!dark.is_empty());
    let (before, after): (Vec<[usize; 2]>, Vec<[usize; 2]>) = dark.iter().partition(|place| place[0] < 225);
    let ends = (before.iter().map(|p| p[0]).max().unwrap(), after.iter().map(|p| p[0]).min().unwrap());
    assert!(ends.0.abs_diff(left) <= 2 && ends.1.abs_diff(right) <= 2, "{ends:?}, the sheet is at {left}, {right}");
    // Without a gap up to there, and on one or two rows.
    let rows: std::collections::BTreeSet<usize> = dark.iter().map(|p| p[1]).collect();
    assert!(rows.len() <= 2, "{rows:?}");
    let columns: std::collections::BTreeSet<usize> = before.iter().map(|p| p[0]).collect();
    assert_eq!(columns.len(), ends.0 + 1 - columns.first().unwrap(), "a gap");
}

#[test]
fn lines_of_a_curved_surface_are_whole() {
    // Seen along its axis, a sphere's circles of latitude are circles; all of the upper half are seen, none of the lower.
    let mesh = shapes::sphere(5).unwrap();
    let values = coordinate(&mesh, 2);
    let mut options = from([0.0, 0.0, 1.0], bare(600, 600));
    options.draw.levels = Levels::At(&[0.9, 0.6, 0.3, -0.3, -0.6]);
    let ink = Ink::of(&mesh, &values, &options);
    let [left, right, ..] = edges(&ink.without);
    // From distance d the circle at height z has the radius √(1 − z²) / (d − z), and the silhouette 1 / √(d² − 1).
    let focus = 300.0 / 15.0_f64.to_radians().tan();
    let d = (1.0 + (2.0 * focus / (right - left)).powi(2)).sqrt();
    for z in [0.9_f64, 0.6, 0.3] {
        let radius = focus * (1.0 - z * z).sqrt() / (d - z);
        for k in 0..720 {
            let (sin, cos) = (0.5 * f64::from(k)).to_radians().sin_cos();
            let darkest = (-6..=6)
                .map(|step| radius + 0.25 * f64::from(step))
                .map(|r| ink.sample(300.0 + r * cos, 300.0 + r * sin))
                .fold(0.0, f64::max);
            assert!(darkest > 0.3, "height {z}, at {}°: {darkest}", 0.5 * f64::from(k));
        }
    }
    for z in [-0.3_f64, -0.6] {
        // Where they would be, were the sphere of glass.
        let radius = focus * (1.0 - z * z).sqrt() / (d - z);
        for k in 0..360 {
            let (sin, cos) = f64::from(k).to_radians().sin_cos();
            let amount = ink.sample(300.0 + radius * cos, 300.0 + radius * sin);
            assert!(amount.abs() < 0.05, "height {z}, at {k}°: {amount}");
        }
    }
}

#[test]
fn lines_that_are_given_are_drawn_as_they_are() {
    let mesh = shapes::grid(9, 9).unwrap();
    let values = coordinate(&mesh, 0);
    let levels = [0.2, 0.5, 0.7];
    let mut options = bare(200, 160);
    options.draw.levels = Levels::At(&levels);
    let expected = draw(&mesh, &values, &options);
    let sets = level_sets(&mesh, &values, &levels).unwrap();
    options.draw.levels = Levels::Traced(&sets);
    assert!(draw(&mesh, &values, &options).pixels == expected.pixels);
    // Lines of another field are as good.
    let sets = level_sets(&mesh, &coordinate(&mesh, 1), &levels).unwrap();
    options.draw.levels = Levels::Traced(&sets);
    assert!(draw(&mesh, &values, &options).difference(&expected).0 > 300);
    // None at all.
    let nothing = LevelSets { offsets: vec![0], ..LevelSets::default() };
    options.draw.levels = Levels::Traced(&nothing);
    let none = draw(&mesh, &values, &options);
    options.draw.levels = Levels::None;
    assert!(none.pixels == draw(&mesh, &values, &options).pixels);
}
