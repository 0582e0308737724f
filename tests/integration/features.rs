//! Feature points against brute force: the rules written out, and k-means against its optimum.

use std::collections::BTreeSet;

use morse_smooth::Error;
use morse_smooth::field::{
    DeltaOptions, DeltaScale, ExtremumRule, Features, LinkReading, Threshold, critical_points, feature_points,
    persistence, with_stars,
};
use morse_smooth::mesh::{TriMesh, shapes};
use proptest::prelude::*;

use crate::support::{complex, every_kind, islands, noise, random_complex, random_surface, shuffle, tied};

fn k_means(mesh: &TriMesh, f: &[f64], clusters: usize, seed: u64) -> Vec<u32> {
    feature_points(mesh, f, &Features::KMeans { clusters, seed }).expect("clusters")
}

/// A strip of triangles, where only the number of vertices matters.
fn strip(vertices: u32) -> TriMesh {
    complex(vertices, &(2..vertices).map(|v| [v - 2, v - 1, v]).collect::<Vec<_>>())
}

/// Σ (f − mean)² of a cluster.
fn cost(cluster: &[f64]) -> f64 {
    let mean = mean(cluster);
    cluster.iter().map(|x| (x - mean) * (x - mean)).sum()
}

fn mean(cluster: &[f64]) -> f64 {
    cluster.iter().sum::<f64>() / cluster.len() as f64
}

/// The least sum of costs with `clusters` clusters, by dynamic programming over the sorted values.
fn optimum(sorted: &[f64], clusters: usize) -> f64 {
    let n = sorted.len();
    let mut best: Vec<f64> = (0..=n).map(|end| if end == 0 { 0.0 } else { cost(&sorted[..end]) }).collect();
    for _ in 1..clusters {
        best = (0..=n)
            .map(|end| {
                (0..end)
                    .map(|start| best[start] + cost(&sorted[start..end]))
                    .fold(best[end], |a, b| if b < a { b } else { a })
            })
            .collect();
    }
    best[n]
}

#[test]
fn ratios() {
    for trial in 0..400_u64 {
        let n = 5 + (trial % 40) as u32;
        let mesh = strip(n);
        let f = if trial % 3 == 0 { tied(n as usize, trial, 6.0) } else { noise(n as usize, trial) };
        let mut sorted = f.clone();
        sorted.sort_by(f64::total_cmp);
        for k in [2, 3, 5, 8, n as usize / 2, n as usize - 2] {
            let reps = k_means(&mesh, &f, k, trial);
            // The cost with the representatives' Voronoi cells
            let mut r: Vec<f64> = reps.iter().map(|&v| f[v as usize]).collect();
            r.sort_by(f64::total_cmp);
            let mut distinct = sorted.clone();
            distinct.dedup();
            let mut groups: Vec<Vec<f64>> = vec![Vec::new(); r.len()];
            for &x in &sorted {
                let j = (0..r.len()).min_by(|&a, &b| (r[a] - x).abs().total_cmp(&(r[b] - x).abs())).unwrap();
                groups[j].push(x);
            }
            let found: f64 = groups.iter().map(|g| if g.is_empty() { 0.0 } else { cost(g) }).sum();
            let best = optimum(&sorted, k);
            assert_eq!(reps.len(), k.min(distinct.len()));
            println!("RATIO {:.3} k={k} n={n} {found:e} {best:e}", if best > 1e-20 { found / best } else { 1.0 });
        }
    }
}
