//! Files of other programs, damaged: an error with its code, or consistent data; never a panic.

use std::time::Instant;

use morse_smooth::io::{
    FieldFormat, FieldReadOptions, MeshData, MeshFormat, ReadOptions, read_field, read_mesh, read_table,
};

use crate::io_peers::folder;

/// A sequence of numbers without a pattern, the same every time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn below(&mut self, end: usize) -> usize {
        self.next() as usize % end
    }
}

fn assert_consistent(data: &MeshData) {
    let vertices = data.positions.len() / 3;
    let triangles = data.triangles.len() / 3;
    assert!(vertices > 0 && triangles > 0);
    assert!(data.triangles.iter().all(|&corner| (corner as usize) < vertices));
    assert!(data.fields.iter().all(|(_, values)| values.len() == vertices));
    assert!(data.triangle_fields.iter().all(|(_, values)| values.len() == triangles));
    if let Some(map) = &data.vertex_map {
        assert!(map.len() == vertices && map.windows(2).all(|pair| pair[0] < pair[1]));
    }
}

fn read_every_way(bytes: &[u8], own: Option<MeshFormat>) {
    let start = Instant::now();
    for format in [None, own] {
        if let Ok(data) = read_mesh(bytes, &ReadOptions { format, file_name: None }) {
            assert_consistent(&data);
        }
    }
    if let Ok(table) = read_table(bytes, None) {
        let rows = table.columns[0].1.len();
        assert!(rows > 0);
    }
    let _ = read_field(bytes, &FieldReadOptions::default());
    // These files have a few kilobytes; on a busy machine a step takes its time.
    assert!(start.elapsed().as_secs() < 5, "{:?}", start.elapsed());
}

fn samples() -> Vec<(String, Vec<u8>)> {
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder()).expect("the folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if name != "expected.json" {
            all.push((name, std::fs::read(&path).expect("a file")));
        }
    }
    all.sort();
    all
}

#[test]
fn files_that_end_too_early_are_refused_or_consistent() {
    for (_, bytes) in samples() {
        for part in 0..40 {
            read_every_way(&bytes[..bytes.len() * part / 40], None);
        }
    }
}

#[test]
fn files_with_wrong_bytes_are_refused_or_consistent() {
    let mut random = Random(7);
    for (name, bytes) in samples() {
        let own = read_mesh(&bytes, &ReadOptions::default()).ok().map(|data| data.format);
        for round in 0..60 {
            let mut damaged = bytes.clone();
            // Most of what decides stands at the beginning.
            let end = if round % 2 == 0 { bytes.len() } else { bytes.len().min(400) };
            for _ in 0..1 + round % 4 {
                let place = random.below(end);
                damaged[place] = match random.below(4) {
                    0 => random.next() as u8,
                    1 => b'0' + random.below(10) as u8,
                    2 => 0xff,
                    _ => damaged[place] ^ 1 << random.below(8),
                };
            }
            if round % 5 == 4 {
                let (place, length) = (random.below(end), random.below(40));
                damaged.drain(place..(place + length).min(bytes.len()));
            }
            read_every_way(&damaged, own);
        }
        assert!(!name.is_empty());
    }
}

#[test]
fn random_bytes_after_the_right_beginning_are_refused_or_consistent() {
    let mut random = Random(11);
    for (_, bytes) in samples() {
        let own = read_mesh(&bytes, &ReadOptions::default()).ok().map(|data| data.format);
        for round in 0..10 {
            let mut noise = bytes[..bytes.len().min(20 * round)].to_vec();
            noise.extend((0..random.below(2000)).map(|_| random.next() as u8));
            read_every_way(&noise, own);
        }
    }
    for format in [FieldFormat::Npy, FieldFormat::Gii, FieldFormat::Curv] {
        assert!(read_table(b"1\n2\n", Some(format)).is_err());
    }
}

#[test]
fn a_few_bytes_that_stand_for_many_are_refused() {
    // A gigabyte of zeros, packed: blocks of one repeated byte, made by hand from the bytes for 258 zeros each.
    let zeros = |count: usize| {
        // A block with fixed codes: a zero, then `count` times length 258 at distance 1, whose codes have 8 and 5 bits.
        let mut bits: Vec<bool> = vec![true, true, false];
        let mut put = |code: u32, length: u32| (0..length).rev().for_each(|bit| bits.push(code >> bit & 1 == 1));
        put(0x30, 8);
        for _ in 0..count {
            put(0xc5, 8);
            put(0, 5);
        }
        put(0, 7);
        let mut bytes = vec![0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 255];
        bytes.extend(bits.chunks(8).map(|byte| byte.iter().rev().fold(0, |sum, &bit| sum << 1 | u8::from(bit))));
        bytes.extend([0; 8]);
        bytes
    };
    assert_eq!(read_mesh(&zeros(4_000_000), &ReadOptions::default()).map_err(|error| error.code()), Err("TooLarge"));
    // A little is unpacked, and is no mesh.
    assert_eq!(read_mesh(&zeros(100), &ReadOptions::default()).map_err(|error| error.code()), Err("UnknownFormat"));
}
