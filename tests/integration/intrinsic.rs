//! The Laplacian of the intrinsic Delaunay triangulation against planar Delaunay triangulations found by trying all circles:
//! of flat pieces, of pieces that are folded, and of surfaces that unfold to periodic patterns of the plane.

use morse_smooth::mesh::shapes::Random;
use morse_smooth::mesh::{LinkKind, TriMesh};
use morse_smooth::operators::intrinsic_delaunay_laplacian;
use nalgebra::DMatrix;

use crate::support::{dense, mesh, shuffle};

type Point = [f64; 2];

/// Twice the signed area.
pub(crate) fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

pub(crate) fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// All triangles whose circles have no point inside, counter-clockwise: O(n⁴). Points must be in general position.
fn delaunay(points: &[Point]) -> Vec<[usize; 3]> {
    let mut found = Vec::new();
    for a in 0..points.len() {
        for b in a + 1..points.len() {
            for c in b + 1..points.len() {
                let (p, q, r) = (points[a], points[b], points[c]);
                let twice = turn(p, q, r);
                if twice.abs() < 1e-9 {
                    continue;
                }
                // The centre relative to p.
                let (u, v) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
                let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
                let centre =
                    [p[0] + (v[1] * uu - u[1] * vv) / (2.0 * twice), p[1] + (u[0] * vv - v[0] * uu) / (2.0 * twice)];
                let radius = distance(centre, p);
                let inside = |&x: &Point| distance(centre, x) < radius * (1.0 - 1e-13) - 1e-9;
                if !points.iter().any(inside) {
                    found.push(if twice > 0.0 { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    found
}

/// Flips random diagonals of a planar triangulation, Delaunay or not, as long as triangles keep some area.
fn spoil(points: &[Point], triangles: &mut [[usize; 3]], flips: usize, random: &mut Random) {
    let pick = |random: &mut Random, n: usize| (random.uniform() * n as f64) as usize;
    for _ in 0..flips {
        let (t, s) = (pick(random, triangles.len()), pick(random, 3));
        let [i, j, k] = [0, 1, 2].map(|c| triangles[t][(s + c) % 3]);
        let other = triangles.iter().position(|o| (0..3).any(|c| o[c] == j && o[(c + 1) % 3] == i));
        let Some(u) = other else { continue };
        let m = triangles[u].into_iter().find(|&v| v != i && v != j).unwrap();
        let fat = |[a, b, c]: [usize; 3]| {
            let sides = [(a, b), (b, c), (c, a)].map(|(x, y)| distance(points[x], points[y]));
            let longest = sides.into_iter().fold(0.0, f64::max);
            turn(points[a], points[b], points[c]) > 0.0 && sides.iter().sum::<f64>() - 2.0 * longest > 5e-5
        };
        if fat([k, i, m]) && fat([m, j, k]) {
            triangles[t] = [k, i, m];
            triangles[u] = [m, j, k];
        }
    }
}

/// The cotangent Laplacian of planar triangles by angles, with points standing for vertices.
fn planar_laplacian(points: &[Point], vertices: &[usize], triangles: &[[usize; 3]], n: usize) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(n, n);
    for t in triangles {
        for c in 0..3 {
            let [a, b, o] = [0, 1, 2].map(|x| t[(c + x) % 3]);
            let (p, q, r) = (points[a], points[b], points[o]);
            let scalar = (p[0] - r[0]) * (q[0] - r[0]) + (p[1] - r[1]) * (q[1] - r[1]);
            let half = 0.5 / turn(p, q, r).abs().atan2(scalar).tan();
            let (i, j) = (vertices[a], vertices[b]);
            if i != j {
                matrix[(i, j)] -= half;
                matrix[(j, i)] -= half;
                matrix[(i, i)] += half;
                matrix[(j, j)] += half;
            }
        }
    }
    matrix
}

pub(crate) fn assert_close(name: &str, found: &DMatrix<f64>, expected: &DMatrix<f64>, tolerance: f64) {
    let difference = (found - expected).abs().max();
    assert!(difference <= tolerance * expected.abs().max(), "{name}: {difference:e} of {:e}", expected.abs().max());
}

pub(crate) fn intrinsic(mesh: &TriMesh) -> DMatrix<f64> {
    dense(&intrinsic_delaunay_laplacian(mesh).unwrap())
}

pub(crate) fn to_mesh(positions: &[[f64; 3]], triangles: &[[usize; 3]]) -> TriMesh {
    let triangles: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(|v| v as u32)).collect();
    mesh(positions, &triangles)
}

/// The least that two sides of a triangle have more than the third, as a fraction of the mean length.
pub(crate) fn slack(mesh: &TriMesh) -> f64 {
    let length = |a: u32, b: u32| {
        let (p, q) = (mesh.position(a), mesh.position(b));
        (p[0] - q[0]).hypot(p[1] - q[1]).hypot(p[2] - q[2])
    };
    let edges = mesh.connectivity().edges();
    let mean = edges.iter().map(|&[a, b]| length(a, b)).sum::<f64>() / edges.len() as f64;
    let slacks = mesh.connectivity().triangles().iter().map(|&[a, b, c]| {
        let sides = [length(a, b), length(b, c), length(c, a)];
        sides.iter().sum::<f64>() - 2.0 * sides.into_iter().fold(0.0, f64::max)
    });
    slacks.fold(f64::INFINITY, f64::min) / mean
}

/// What is promised whatever the mesh.
pub(crate) fn assert_sound(name: &str, mesh: &TriMesh) {
    let sparse = intrinsic_delaunay_laplacian(mesh).unwrap();
    for &[a, b] in mesh.connectivity().edges() {
        for (i, j) in [(a, b), (b, a)] {
            assert!(sparse.get_entry(i as usize, j as usize).is_some(), "{name}: the edge {i}, {j} is not stored");
        }
    }
    for v in 0..mesh.vertex_count() {
        assert!(sparse.get_entry(v, v).is_some(), "{name}: no diagonal at {v}");
        let isolated = mesh.connectivity().link_kinds()[v] == LinkKind::Isolated;
        assert!(!isolated || sparse.col(v).nnz() == 1, "{name}: isolated {v}");
    }
    let matrix = dense(&sparse);
    assert!(matrix.iter().all(|x| x.is_finite()), "{name}: not finite");
    assert_eq!(matrix, matrix.transpose(), "{name}");
    let size = matrix.abs().max();
    assert!(matrix.column_sum().abs().max() <= 1e-14 * size, "{name}: rows do not sum to zero");
    let least = matrix.clone().symmetric_eigenvalues().min();
    assert!(least >= -1e-13 * size, "{name}: eigenvalue {least:e} of {size:e}");
    // An edge between other than two triangles of the mesh may have a negative weight, no other pair of vertices.
    let mut irregular = DMatrix::from_element(matrix.nrows(), matrix.ncols(), false);
    for (e, &[a, b]) in mesh.connectivity().edges().iter().enumerate() {
        if mesh.connectivity().triangles_of_edge(e as u32).len() != 2 {
            irregular[(a as usize, b as usize)] = true;
            irregular[(b as usize, a as usize)] = true;
        }
    }
    for i in 0..matrix.nrows() {
        for j in 0..i {
            assert!(matrix[(i, j)] <= 0.0 || irregular[(i, j)], "{name}: weight {:e} at {i}, {j}", -matrix[(i, j)]);
        }
    }
}

#[test]
fn in_the_plane_it_is_the_delaunay_triangulation() {
    for seed in 0..30 {
        let mut random = Random::new(seed);
        // Long cells make flips go far.
        let width = 1.0 + 4.0 * random.uniform();
        let mut points = vec![[0.0, 0.0], [width, 0.0], [width, 1.0], [0.0, 1.0]];
        for i in 0..5 {
            for j in 0..5 {
                let at = |k: i32, random: &mut Random| (f64::from(k) + 0.5 + 0.45 * random.signed()) / 5.0;
                points.push([width * at(i, &mut random), at(j, &mut random)]);
            }
        }
        let n = points.len();
        let vertices: Vec<usize> = (0..n).collect();
        let good = delaunay(&points);
        assert_eq!(good.len(), 2 * n - 2 - 4, "general position");
        let expected = planar_laplacian(&points, &vertices, &good, n);
        let mut triangles = good.clone();
        for flips in [0, 30, 1000] {
            spoil(&points, &mut triangles, flips, &mut random);
            // Not along the axes.
            let positions: Vec<[f64; 3]> = points.iter().map(|&[x, y]| [7.0 + 0.6 * x, y, 0.8 * x]).collect();
            let bad = to_mesh(&positions, &triangles);
            assert!(slack(&bad) > 1e-5, "seed {seed}: lengths must stay");
            assert_close(&format!("seed {seed}, {flips} flips"), &intrinsic(&bad), &expected, 1e-9);
            assert_sound("plane", &bad);
        }
    }
}

#[test]
fn folds_do_not_matter() {
    for seed in 0..20 {
        let mut random = Random::new(seed);
        // Vertices on vertical creases; strips between creases so narrow that Delaunay edges lead across several.
        let (columns, rows) = (9, 4);
        let mut points = Vec::new();
        for i in 0..columns {
            for j in 0..rows {
                let inside = if j == 0 || j + 1 == rows { 0.0 } else { 0.4 * random.signed() };
                // Not straight up, or the points on top and bottom would lie on circles.
                let x = 0.1 * f64::from(i);
                points.push([x, (f64::from(j) + inside) / 3.0]);
            }
        }
        points.iter_mut().for_each(|p| p[1] += 0.1 * p[0] * p[1]);
        let at = |i: i32, j: i32| (i * rows + j) as usize;
        let mut triangles = Vec::new();
        for i in 0..columns - 1 {
            for j in 0..rows - 1 {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                let halves = if random.uniform() < 0.5 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
                triangles.extend(halves);
            }
        }
        let vertices: Vec<usize> = (0..points.len()).collect();
        let expected = planar_laplacian(&points, &vertices, &delaunay(&points), points.len());
        // Folded by any angle at each crease.
        let (mut x, mut z, mut creases) = (0.0, 0.0, Vec::new());
        for _ in 0..columns {
            creases.push((x, z));
            let angle = 3.0 * random.uniform();
            x += 0.1 * angle.cos();
            z += 0.1 * angle.sin();
        }
        let positions: Vec<[f64; 3]> = points
            .iter()
            .enumerate()
            .map(|(v, p)| [creases[v / rows as usize].0, p[1], creases[v / rows as usize].1])
            .collect();
        let folded = to_mesh(&positions, &triangles);
        assert!(slack(&folded) > 1e-5, "seed {seed}: lengths must stay");
        assert_close(&format!("seed {seed}"), &intrinsic(&folded), &expected, 1e-11);
        assert_sound("folded", &folded);
    }
}

/// Points of the plane that stand for vertices of a surface which unfolds to the plane, periodically, and the triangles
/// whose centre lies in one period.
fn unfolded(points: &[(Point, usize)], within: impl Fn(Point) -> bool, n: usize) -> DMatrix<f64> {
    let (places, vertices): (Vec<Point>, Vec<usize>) = points.iter().copied().unzip();
    let mut triangles = delaunay(&places);
    triangles.retain(|t| within([0, 1].map(|x| t.iter().map(|&v| places[v][x]).sum::<f64>() / 3.0)));
    planar_laplacian(&places, &vertices, &triangles, n)
}

/// Both sides of a rectangle, as one closed surface: what it unfolds to is kept by half turns about the corners. With few
/// vertices, Delaunay edges go round it, from a vertex to itself and several from one vertex to another.
#[test]
fn a_rectangle_with_two_sides() {
    let mut loops = 0;
    for seed in 0..60 {
        let mut random = Random::new(seed);
        let (a, b) = (1.0, 0.15 + 0.3 * random.uniform());
        let corners = [[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]];
        let sizes = [1 + seed as usize % 3, 1 + (seed as usize / 3) % 3];
        let mut inside = || [a * (0.5 + 0.4 * random.signed()), b * (0.5 + 0.4 * random.signed())];
        let sides = sizes.map(|size| (0..size).map(|_| inside()).collect::<Vec<Point>>());
        let n = 4 + sizes[0] + sizes[1];

        let mut positions = corners.to_vec();
        let mut triangles = Vec::new();
        for side in &sides {
            let first = positions.len();
            let places: Vec<Point> = corners.iter().chain(side).copied().collect();
            positions.extend(side);
            let mut flat = delaunay(&places);
            spoil(&places, &mut flat, 20, &mut random);
            triangles.extend(flat.iter().map(|t| t.map(|v| if v < 4 { v } else { first + v - 4 })));
        }
        let positions: Vec<[f64; 3]> = positions.iter().map(|p| [p[0], p[1], 0.0]).collect();
        let pillow = to_mesh(&positions, &triangles);
        let topology = pillow.topology().unwrap();
        if topology.boundary_loops + topology.non_manifold_edges > 0 {
            // Two diagonals from corner to corner are one edge of the mesh.
            continue;
        }
        assert!(slack(&pillow) > 1e-5, "seed {seed}: lengths must stay");

        let mut points = Vec::new();
        for i in -2..=2_i32 {
            for j in -8..=8_i32 {
                let (x, y) = (2.0 * a * f64::from(i), 2.0 * b * f64::from(j));
                for (v, &[p, q]) in corners.iter().enumerate() {
                    // A half turn about a corner takes it to a translate of itself.
                    points.push(([p + x, q + y], v));
                }
                for (v, &[p, q]) in sides[0].iter().enumerate() {
                    points.extend([([x + p, y + q], 4 + v), ([x - p, y - q], 4 + v)]);
                }
                for (v, &[p, q]) in sides[1].iter().enumerate() {
                    let v = 4 + sizes[0] + v;
                    points.extend([([x + p, y - q], v), ([x - p, y + q], v)]);
                }
            }
        }
        points.retain(|&([x, y], _)| (x - 0.5 * a).abs() < 1.1 && y.abs() < b + 0.7);
        let expected = unfolded(&points, |[x, y]| (0.0..a).contains(&x) && (-b..b).contains(&y), n);
        loops += usize::from(has_loop(&points));
        assert_close(&format!("seed {seed}"), &intrinsic(&pillow), &expected, 1e-9);
        assert_sound("pillow", &pillow);
    }
    assert!(loops > 5, "{loops} of the triangulations have an edge from a vertex to itself");
}

fn has_loop(points: &[(Point, usize)]) -> bool {
    let places: Vec<Point> = points.iter().map(|p| p.0).collect();
    let middle = |t: &[usize; 3]| t.iter().all(|&v| (places[v][0] - 0.5).abs() < 0.6 && places[v][1].abs() < 0.6);
    delaunay(&places).iter().filter(|t| middle(t)).any(|t| (0..3).any(|c| points[t[c]].1 == points[t[(c + 1) % 3]].1))
}

/// Three equilateral triangles folded onto one: a Möbius strip of paper, which unfolds to an endless strip that a glide
/// reflection takes to itself.
#[test]
fn a_paper_moebius_strip() {
    let height = 0.75_f64.sqrt();
    let mut compared = 0;
    for seed in 0..20 {
        let mut random = Random::new(seed);
        // Each triangle in k² parts, so that no triangle of the mesh crosses a crease. (i, j) and (i + j + k, k − j) are the same.
        let k = 5_i32;
        let canonical = |mut i: i32, mut j: i32| {
            let mut turns = 0;
            while 2 * i + j < 0 {
                (i, j) = (i + j + k, k - j);
                turns += 1;
            }
            while 2 * i + j >= 3 * k {
                (i, j) = (i + j - 2 * k, k - j);
                turns -= 1;
            }
            (i, j, turns)
        };
        let mut names: Vec<(i32, i32)> = Vec::new();
        let mut places: Vec<Point> = Vec::new();
        for j in 0..=k {
            for i in -k..=2 * k {
                if (0..3 * k).contains(&(2 * i + j)) {
                    // Sides of the large triangles: j = 0 and j = k, i ≡ 0, i + j ≡ 0 modulo k. There, points move along.
                    let [dx, dy] = [0.35 * random.signed(), 0.35 * random.signed()];
                    let (level, left, right) = (j % k == 0, i % k == 0, (i + j) % k == 0);
                    let (di, dj) = match (level, left, right) {
                        (false, false, false) => (dx, dy),
                        (true, false, false) => (dx, 0.0),
                        (false, true, false) => (0.0, dx),
                        (false, false, true) => (-dx, dx),
                        _ => (0.0, 0.0),
                    };
                    let (x, y) = (f64::from(i) + di, f64::from(j) + dj);
                    names.push((i, j));
                    places.push([(x + 0.5 * y) / f64::from(k), height * y / f64::from(k)]);
                }
            }
        }
        let glide =
            |[x, y]: Point, times: i32| [x + 1.5 * f64::from(times), if times % 2 == 0 { y } else { height - y }];
        let vertex = |i: i32, j: i32| {
            let (i, j, turns) = canonical(i, j);
            (names.iter().position(|&name| name == (i, j)).unwrap(), turns)
        };
        let n = names.len();
        let mut triangles = Vec::new();
        for j in 0..k {
            for i in -k..2 * k {
                for t in [[(i, j), (i + 1, j), (i, j + 1)], [(i + 1, j), (i + 1, j + 1), (i, j + 1)]] {
                    // One copy of each: that whose corners sum up to within the period.
                    let sum: i32 = t.iter().map(|&(i, j)| 2 * i + j).sum();
                    if (0..9 * k).contains(&sum) {
                        let mut t = t.map(|(i, j)| vertex(i, j).0);
                        shuffle(&mut t, &mut random);
                        triangles.push(t);
                    }
                }
            }
        }
        // Folding: reflections in the sides of the first triangle until the point lies there.
        let positions: Vec<[f64; 3]> = places
            .iter()
            .map(|&[x, y]| {
                let slope = height / 0.5;
                let [mut x, mut y] = [x, y];
                for _ in 0..20 {
                    // Left y = 2hx, right y = 2h (1 − x), below y = 0.
                    for (a, b, c) in [(slope, -1.0, 0.0), (-slope, -1.0, slope), (0.0, 1.0, 0.0)] {
                        let side = (a * x + b * y + c) / (a * a + b * b);
                        if side < 0.0 {
                            (x, y) = (x - 2.0 * a * side, y - 2.0 * b * side);
                        }
                    }
                }
                [x, y, 0.0]
            })
            .collect();
        let strip = to_mesh(&positions, &triangles);
        let topology = strip.topology().unwrap();
        assert!(!topology.orientable && topology.boundary_loops == 1 && topology.euler_characteristic == 0);
        // A triangle turned over by its vertices' jitter would cover others.
        if strip.area() > 1.5 * height + 1e-9 {
            continue;
        }
        compared += 1;
        assert!(slack(&strip) > 1e-5, "seed {seed}: lengths must stay");
        let points: Vec<(Point, usize)> =
            (-2..=2).flat_map(|times| places.iter().enumerate().map(move |(v, &p)| (glide(p, times), v))).collect();
        let points: Vec<_> = points.into_iter().filter(|&([x, _], _)| (-0.7..2.2).contains(&x)).collect();
        let expected = unfolded(&points, |[x, _]| (0.0..1.5).contains(&x), n);
        assert_close(&format!("seed {seed}"), &intrinsic(&strip), &expected, 1e-11);
        assert_sound("paper strip", &strip);
    }
    assert!(compared > 10, "{compared}");
}

/// A frustum of 8 vertices and plane sides, with all 64 choices of their diagonals: all have the same metric.
#[test]
fn diagonals_of_plane_sides_do_not_matter() {
    for (length, shift) in [(0.5, 0.1), (1.0, 0.3), (6.0, 0.0), (6.0, 2.0), (0.02, 0.4)] {
        // Similar quadrilaterals in two parallel planes, so that the sides between them are plane.
        let base = [[0.0, 0.0], [1.0, 0.1], [1.2, 0.9], [-0.1, 1.3]];
        let mut positions: Vec<[f64; 3]> = base.iter().map(|p| [p[0], p[1], 0.0]).collect();
        positions.extend(base.iter().map(|p| [0.7 * p[0] + shift, 0.7 * p[1] + 0.2, length]));
        let sides = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
        let mut first = None;
        for choice in 0..64 {
            let mut triangles = Vec::new();
            for (bit, &[a, b, c, d]) in sides.iter().enumerate() {
                let halves = if choice >> bit & 1 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
                triangles.extend(halves);
            }
            let frustum = to_mesh(&positions, &triangles);
            assert!(slack(&frustum) > 1e-5);
            let found = intrinsic(&frustum);
            assert_sound("frustum", &frustum);
            assert_close("frustum", &found, first.get_or_insert_with(|| found.clone()), 1e-12);
        }
    }
}
