//! Generated meshes for examples, tests and benches.
//!
//! They use the platform's sine and cosine, so their last bits may differ between platforms; nothing else in the crate
//! does.

use core::f64::consts::TAU;

use super::{TriMesh, cross, norm};
use crate::error::MeshError;
pub use crate::support::random::Random;

/// The regular tetrahedron with corners at alternate corners of the cube [−1, 1]³; outward orientation.
///
/// # Errors
/// None in practice; the type is the one of all generators.
pub fn tetrahedron() -> Result<TriMesh, MeshError> {
    let positions = vec![1., 1., 1., 1., -1., -1., -1., 1., -1., -1., -1., 1.];
    TriMesh::new(positions, vec![0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2])
}

/// The octahedron with corners ±x, ±y, ±z at distance 1; outward orientation.
///
/// # Errors
/// None in practice; the type is the one of all generators.
pub fn octahedron() -> Result<TriMesh, MeshError> {
    let (positions, triangles) = octahedron_arrays();
    TriMesh::new(positions, triangles)
}

fn octahedron_arrays() -> (Vec<f64>, Vec<u32>) {
    (
        vec![1., 0., 0., -1., 0., 0., 0., 1., 0., 0., -1., 0., 0., 0., 1., 0., 0., -1.],
        vec![0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5],
    )
}

/// The unit sphere by `subdivisions` midpoint subdivisions of the octahedron: 4^(k+1) + 2 vertices.
///
/// # Errors
/// None for sizes that fit the memory.
pub fn sphere(subdivisions: u32) -> Result<TriMesh, MeshError> {
    let (mut positions, mut triangles) = octahedron_arrays();
    for _ in 0..subdivisions {
        let mesh = TriMesh::new(positions, triangles)?;
        let n = mesh.vertex_count() as u32;
        positions = mesh.positions().to_vec();
        for &[a, b] in mesh.connectivity().edges() {
            let (p, q) = (mesh.position(a), mesh.position(b));
            let sum = [p[0] + q[0], p[1] + q[1], p[2] + q[2]];
            let norm = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
            positions.extend(sum.map(|x| x / norm));
        }
        triangles = Vec::with_capacity(mesh.triangle_count() * 12);
        for (&[a, b, c], &[ab, bc, ca]) in
            mesh.connectivity().triangles().iter().zip(mesh.connectivity().triangle_edges())
        {
            let (ab, bc, ca) = (n + ab, n + bc, n + ca);
            triangles.extend([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca]);
        }
    }
    TriMesh::new(positions, triangles)
}

/// A torus of radii 1 and 0.4 with `around` × `across` vertices; `jitter` moves every vertex by up to that fraction of a
/// cell within the surface, reproducibly. Sides are split along the same diagonal everywhere.
///
/// # Errors
/// `EmptyMesh` where a count is below 3.
pub fn torus(around: u32, across: u32, jitter: f64) -> Result<TriMesh, MeshError> {
    let mut random = Random::new(u64::from(around) << 32 | u64::from(across));
    let mut positions = Vec::with_capacity(3 * around as usize * across as usize);
    for i in 0..around {
        for j in 0..across {
            let u = TAU * (f64::from(i) + jitter * random.signed()) / f64::from(around);
            let v = TAU * (f64::from(j) + jitter * random.signed()) / f64::from(across);
            let r = 1.0 + 0.4 * v.cos();
            positions.extend([r * u.cos(), r * u.sin(), 0.4 * v.sin()]);
        }
    }
    let at = |i: u32, j: u32| (i % around) * across + j % across;
    TriMesh::new(positions, cells(around, across, at, around >= 3 && across >= 3))
}

/// A square [0, 1]² in the plane z = 0 with `columns` × `rows` vertices: an open mesh with one boundary loop.
///
/// # Errors
/// `EmptyMesh` where a count is below 2.
pub fn grid(columns: u32, rows: u32) -> Result<TriMesh, MeshError> {
    let step = |i: u32, count: u32| f64::from(i) / f64::from(count.max(2) - 1);
    let mut positions = Vec::with_capacity(3 * columns as usize * rows as usize);
    for i in 0..columns {
        for j in 0..rows {
            positions.extend([step(i, columns), step(j, rows), 0.0]);
        }
    }
    let at = |i: u32, j: u32| i * rows + j;
    TriMesh::new(positions, cells(columns.saturating_sub(1), rows.saturating_sub(1), at, true))
}

/// A Möbius strip with `around` × `across` vertices: one-sided, one boundary loop, χ = 0.
///
/// # Errors
/// `EmptyMesh` where a count is too small.
pub fn moebius(around: u32, across: u32) -> Result<TriMesh, MeshError> {
    let mut positions = Vec::with_capacity(3 * around as usize * across as usize);
    for i in 0..around {
        for j in 0..across {
            let u = TAU * f64::from(i) / f64::from(around);
            let w = 0.4 * (2.0 * f64::from(j) / f64::from(across.max(2) - 1) - 1.0);
            let r = 1.0 + w * (u / 2.0).cos();
            positions.extend([r * u.cos(), r * u.sin(), w * (u / 2.0).sin()]);
        }
    }
    // After one turn the strip meets itself upside down.
    let at = |i: u32, j: u32| if i < around { i * across + j } else { across - 1 - j };
    TriMesh::new(positions, cells(around, across.saturating_sub(1), at, around >= 3))
}

/// A Klein bottle with `around` × `across` vertices (the figure-8 immersion, \[Franzoni12\]): closed, one-sided, χ = 0.
///
/// # Errors
/// `EmptyMesh` where a count is too small.
pub fn klein_bottle(around: u32, across: u32) -> Result<TriMesh, MeshError> {
    let mut positions = Vec::with_capacity(3 * around as usize * across as usize);
    for i in 0..around {
        for j in 0..across {
            let u = TAU * f64::from(i) / f64::from(around);
            let v = TAU * f64::from(j) / f64::from(across);
            let r = 2.0 + (u / 2.0).cos() * v.sin() - (u / 2.0).sin() * (2.0 * v).sin();
            let z = (u / 2.0).sin() * v.sin() + (u / 2.0).cos() * (2.0 * v).sin();
            positions.extend([r * u.cos(), r * u.sin(), z]);
        }
    }
    // One turn reverses the figure-8.
    let at = |i: u32, j: u32| if i < around { i * across + j % across } else { (across - j % across) % across };
    TriMesh::new(positions, cells(around, across, at, around >= 3 && across >= 3))
}

/// A closed tube of radius 0.4 around the trefoil knot (sin t + 2 sin 2t, cos t − 2 cos 2t, −sin 3t) with `around` × `across`
/// vertices; `jitter` as for [`torus`]. No plane cuts it into few short pieces, which is what orderings are tested with.
///
/// # Errors
/// `EmptyMesh` where a count is below 3.
pub fn trefoil_tube(around: u32, across: u32, jitter: f64) -> Result<TriMesh, MeshError> {
    let mut random = Random::new(u64::from(around) << 32 | u64::from(across));
    let mut positions = Vec::with_capacity(3 * around as usize * across as usize);
    for i in 0..around {
        for j in 0..across {
            let t = TAU * (f64::from(i) + jitter * random.signed()) / f64::from(around);
            let v = TAU * (f64::from(j) + jitter * random.signed()) / f64::from(across);
            let (sin, cos) = ([t.sin(), (2.0 * t).sin(), (3.0 * t).sin()], [t.cos(), (2.0 * t).cos(), (3.0 * t).cos()]);
            let centre = [sin[0] + 2.0 * sin[1], cos[0] - 2.0 * cos[1], -sin[2]];
            let velocity = [cos[0] + 4.0 * cos[1], 4.0 * sin[1] - sin[0], -3.0 * cos[2]];
            let acceleration = [-sin[0] - 8.0 * sin[1], 8.0 * cos[1] - cos[0], 9.0 * sin[2]];
            // The curve is never straight, as the z of this product is 31 + 4 cos 3t: so its Frenet frame closes up.
            let binormal = unit(cross(velocity, acceleration));
            let normal = cross(binormal, unit(velocity));
            positions.extend((0..3).map(|k| centre[k] + 0.4 * (v.cos() * binormal[k] + v.sin() * normal[k])));
        }
    }
    let at = |i: u32, j: u32| (i % around) * across + j % across;
    TriMesh::new(positions, cells(around, across, at, around >= 3 && across >= 3))
}

/// The unit sphere with `rings` × `sectors` + 2 vertices on irregularly spaced circles of latitude, irregularly spaced on each;
/// the first and the last vertex are poles of valence `sectors`. The same seed gives the same mesh.
///
/// # Errors
/// `EmptyMesh` where `rings` is 0 or `sectors` below 3.
pub fn irregular_sphere(rings: u32, sectors: u32, seed: u64) -> Result<TriMesh, MeshError> {
    let mut random = Random::new(seed);
    let latitudes = irregular_steps(rings + 1, &mut random);
    let mut positions = vec![0., 0., 1.];
    for latitude in &latitudes[1..] {
        let polar = 0.5 * TAU * latitude;
        // Steps differ by up to 1 : 7 from one to the next, and every circle has its own.
        for longitude in irregular_steps(sectors, &mut random) {
            let azimuth = TAU * longitude;
            positions.extend([polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), polar.cos()]);
        }
    }
    positions.extend([0., 0., -1.]);
    let (at, last) = (|i: u32, j: u32| 1 + i * sectors + j % sectors, (positions.len() / 3) as u32 - 1);
    let valid = rings >= 1 && sectors >= 3;
    let mut triangles = cells(rings.saturating_sub(1), sectors, at, valid);
    for j in (0..sectors).filter(|_| valid) {
        triangles.extend([0, at(0, j), at(0, j + 1), last, at(rings - 1, j + 1), at(rings - 1, j)]);
    }
    TriMesh::new(positions, triangles)
}

/// Where `count` irregular steps that together make 1 begin.
fn irregular_steps(count: u32, random: &mut Random) -> Vec<f64> {
    let steps: Vec<f64> = (0..count).map(|_| 1.0 + 0.75 * random.signed()).collect();
    let total: f64 = steps.iter().sum();
    steps
        .iter()
        .scan(0.0, |sum, step| {
            let start = *sum / total;
            *sum += step;
            Some(start)
        })
        .collect()
}

/// Hills over a rectangle with `columns` × `rows` vertices in square cells, whose longer side is 1: an open mesh with one
/// boundary loop. Heights are six octaves of smooth noise; the same seed gives the same hills at every resolution.
///
/// # Errors
/// `EmptyMesh` where a count is below 2.
pub fn terrain(columns: u32, rows: u32, seed: u64) -> Result<TriMesh, MeshError> {
    let step = 1.0 / f64::from(columns.max(rows).max(2) - 1);
    let mut positions = Vec::with_capacity(3 * columns as usize * rows as usize);
    for i in 0..columns {
        for j in 0..rows {
            let (x, y) = (step * f64::from(i), step * f64::from(j));
            let height = |octave: i32| 0.2 * 0.5_f64.powi(octave) * noise(x, y, octave, seed);
            positions.extend([x, y, (0..6).map(height).sum()]);
        }
    }
    let at = |i: u32, j: u32| i * rows + j;
    TriMesh::new(positions, cells(columns.saturating_sub(1), rows.saturating_sub(1), at, true))
}

/// Random values in [−1, 1) at the points of a lattice with step 2^−(octave + 1), between them interpolated with slopes of zero
/// at the points.
fn noise(x: f64, y: f64, octave: i32, seed: u64) -> f64 {
    let scale = 2.0_f64.powi(octave + 1);
    let (x, y) = (scale * x, scale * y);
    let value = |i: f64, j: f64| {
        let place = (octave as u64) << 48 | (i as u64) << 24 | j as u64;
        Random::new(seed ^ place.wrapping_mul(0xD134_2543_DE82_EF95)).signed()
    };
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let blend = |t: f64, from: f64, to: f64| from + ease(t) * (to - from);
    let (i, j) = (x.floor(), y.floor());
    let along = |j: f64| blend(x - i, value(i, j), value(i + 1.0, j));
    blend(y - j, along(j), along(j + 1.0))
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    a.map(|x| x / norm(a))
}

/// Two triangles for each cell of an `m` × `n` grid of cells whose corners `at` names; none unless `valid`.
fn cells(m: u32, n: u32, at: impl Fn(u32, u32) -> u32, valid: bool) -> Vec<u32> {
    let mut triangles = Vec::new();
    if valid {
        triangles.reserve(6 * m as usize * n as usize);
        for i in 0..m {
            for j in 0..n {
                let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                triangles.extend([a, b, c, a, c, d]);
            }
        }
    }
    triangles
}
