//! Times of a picture, natively, for `benches/snapshot.mjs`, which writes the meshes and draws the same in WebAssembly:
//! `cargo bench --features render --bench snapshot -- folder name …` reads `folder/name.{positions,triangles,values}` and writes
//! `folder/name.png`.
#![allow(clippy::expect_used, clippy::print_stdout, reason = "a bench fails by panicking and prints what it measured")]

use std::path::Path;
use std::time::Instant;

use morse_smooth::TriMesh;
use morse_smooth::render::{SnapshotOptions, snapshot};

/// Rounds that a median is taken of.
const ROUNDS: usize = 5;

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    let Some(folder) = arguments.next() else {
        println!("benches/snapshot.mjs runs this: npm run bench -- snapshot");
        return;
    };
    for name in arguments {
        let read = |what: &str| std::fs::read(Path::new(&folder).join(format!("{name}.{what}"))).expect("a file");
        let floats = |bytes: Vec<u8>| -> Vec<f64> {
            bytes.as_chunks::<8>().0.iter().map(|&number| f64::from_le_bytes(number)).collect()
        };
        let triangles = read("triangles").as_chunks::<4>().0.iter().map(|&id| u32::from_le_bytes(id)).collect();
        let (positions, values) = (floats(read("positions")), floats(read("values")));
        let mut times = Vec::new();
        let mut png = Vec::new();
        let triangles: Vec<u32> = triangles;
        for _ in 0..ROUNDS {
            let since = Instant::now();
            // As in JavaScript, from arrays to the file.
            let mesh = TriMesh::new(positions.clone(), triangles.clone()).expect("a mesh");
            png = snapshot(&mesh, &values, &SnapshotOptions::default()).expect("a picture");
            times.push(since.elapsed().as_secs_f64() * 1e3);
        }
        std::fs::write(Path::new(&folder).join(format!("{name}.png")), png).expect("room on the disk");
        println!("{name} {}", times.iter().map(|time| format!("{time:.1}")).collect::<Vec<_>>().join(" "));
    }
}
