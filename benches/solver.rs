//! Times of the sparse solver beside faer's and nalgebra-sparse's, natively: `cargo bench -- --size 100k --mesh torus`.
//!
//! `benches/solver.mjs` measures the same in WebAssembly, where the solver is at home, and more.
#![allow(clippy::expect_used, clippy::print_stdout, reason = "a bench fails by panicking and prints what it measured")]

mod common;

use std::time::Instant;

use common::csc::{Csc, permuted};
use common::faer::{Faer, Lower};
use common::meshes::{self, SHAPES};
use common::ours::{Analysis, Precision, order};
use common::systems::{COLUMNS, KINDS, System, Values};

/// nalgebra-sparse takes half a minute for A at this size.
const LARGEST_FOR_CSC: u32 = 100_000;
/// Rounds that a median is taken of.
const ROUNDS: usize = 3;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let given = |name: &str, otherwise: &str| {
        let place = arguments.iter().position(|argument| argument == name);
        place.and_then(|place| arguments.get(place + 1)).map_or(otherwise, |value| value).to_owned()
    };
    let (sizes, shapes) = (given("--size", "10k,100k"), given("--mesh", "torus,knot,sphere,terrain"));
    let known = |name: &str| SHAPES.iter().any(|(known, _)| *known == name);
    assert!(shapes.split(',').all(known), "--mesh {shapes}: of {SHAPES:?}");
    for size in sizes.split(',') {
        for (name, shape) in SHAPES.iter().filter(|(name, _)| shapes.split(',').any(|wanted| wanted == *name)) {
            let mesh = meshes::build(*shape, count(size));
            println!("\n{name}, {} vertices, ε = 1; medians of {ROUNDS}, in seconds", mesh.vertex_count());
            let head = ["order", "analyse", "numeric", "again", "solve 1", "solve 8", "entries, M"];
            println!("{:36}{}", "", head.map(|title| format!("{title:>11}")).concat());
            for (name, kind) in &KINDS[..3] {
                let system = System::new(&mesh, *kind, 1.0);
                println!("{name}: {} unknowns", system.pattern.major_dim());
                measure(&system, count(size) <= LARGEST_FOR_CSC);
            }
        }
    }
}

fn count(text: &str) -> u32 {
    let (digits, unit) = match text.strip_suffix('k') {
        Some(digits) => (digits, 1_000),
        None => text.strip_suffix('M').map_or((text, 1), |digits| (digits, 1_000_000)),
    };
    digits.parse::<u32>().expect("--size: numbers such as 100k") * unit
}

/// Times of the stages of one solver in all rounds.
#[derive(Default)]
struct Times([Vec<f64>; 6]);

impl Times {
    fn time<T>(&mut self, stage: usize, work: impl FnOnce() -> T) -> T {
        let since = Instant::now();
        let result = work();
        self.0[stage].push(since.elapsed().as_secs_f64());
        result
    }

    fn print(mut self, name: &str, nonzeros: f64) {
        let medians = self.0.each_mut().map(|times| {
            times.sort_by(f64::total_cmp);
            times.get(times.len() / 2).map_or(format!("{:>11}", "–"), |time| format!("{time:>11.4}"))
        });
        println!("  {name:34}{}{:>11.2}", medians.concat(), nonzeros / 1e6);
    }
}

/// The solvers take turns.
fn measure(system: &System, with_csc: bool) {
    let (pattern, values, all) = (&system.pattern, &system.values, &system.right_hand_sides);
    let one = match all {
        Values::Real(b) => Values::Real(b[..b.len() / COLUMNS].to_vec()),
        Values::Complex(b) => Values::Complex(b[..b.len() / COLUMNS].to_vec()),
    };
    let [mut ours, mut single, mut peer, mut csc] = [(); 4].map(|()| Times::default());
    let (mut entries, mut stored, mut sum) = (0.0, 0.0, 0.0);
    for round in 0..ROUNDS {
        let permutation = ours.time(0, || order(pattern));
        let analysis = ours.time(1, || Analysis::new(pattern.clone(), &permutation));
        entries = analysis.nonzeros();
        for (times, precision) in [(&mut ours, Precision::Double), (&mut single, Precision::Single)] {
            let mut factor = times.time(2, || analysis.factor(values, precision)).expect("positive definite");
            times.time(3, || factor.refactor(values));
            sum += times.time(4, || factor.solve(&one)).sum();
            sum += times.time(5, || factor.solve(all)).sum();
        }
        let Values::Real(numbers) = values else { continue };
        let lower = Lower::new(pattern, numbers);
        let mut faer = peer.time(1, || Faer::new(lower, Some(&permutation)));
        stored = faer.nonzeros();
        peer.time(2, || faer.factor());
        peer.time(3, || faer.factor());
        sum += peer.time(4, || faer.solve(one.real())).iter().sum::<f64>();
        sum += peer.time(5, || faer.solve(all.real())).iter().sum::<f64>();
        if round == 0 && with_csc {
            let matrix = permuted(pattern, numbers, &permutation);
            let mut slow = csc.time(1, || Csc::new(matrix, &permutation));
            csc.time(2, || slow.factor());
            sum += csc.time(4, || slow.solve(one.real())).iter().sum::<f64>();
            sum += csc.time(5, || slow.solve(all.real())).iter().sum::<f64>();
        }
    }
    assert!(sum.is_finite(), "solutions are finite");
    ours.print("morse-smooth", entries);
    single.print("morse-smooth, single precision", entries);
    if matches!(values, Values::Real(_)) {
        peer.print("faer, same order", stored);
        if with_csc {
            csc.print("nalgebra-sparse, same order", entries);
        }
    }
}
