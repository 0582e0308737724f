//! The rules of the comparison, on folders that are made for it.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

use super::compare::{Folders, GAP, check, encode};
use crate::pictures::image::{Image, WHITE};

static COUNT: AtomicU32 = AtomicU32::new(0);

/// Folders that go when they are dropped.
struct Temporary {
    root: PathBuf,
    folders: Folders,
}

impl Temporary {
    fn new() -> Self {
        let name = format!("morse-smooth-golden-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let root = std::env::temp_dir().join(name);
        let folders = Folders { golden: root.join("golden"), artifacts: root.join("artifacts").join("golden") };
        std::fs::create_dir_all(&folders.golden).expect("a folder");
        Self { root, folders }
    }

    fn golden(&self) -> Option<Vec<u8>> {
        std::fs::read(self.folders.golden.join("case.png")).ok()
    }

    fn strip(&self) -> Option<Image> {
        std::fs::read(self.folders.artifacts.join("case.png")).ok().map(|file| Image::decode(&file))
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.root);
    }
}

/// A picture whose pixels are all different.
fn picture(width: usize, height: usize) -> Image {
    let pixels = (0..width * height).map(|k| [k as u8, 100, 200]).collect();
    Image { width, height, pixels }
}

#[test]
fn the_same_bytes_pass() {
    let place = Temporary::new();
    let file = encode(&picture(5, 4));
    std::fs::write(place.folders.golden.join("case.png"), &file).unwrap();
    assert_eq!(check("case", &file, &place.folders, false), Ok(()));
    assert!(place.strip().is_none());
}

#[test]
fn a_missing_golden_fails_and_stays_missing() {
    let place = Temporary::new();
    let message = check("case", &encode(&picture(5, 4)), &place.folders, false).unwrap_err();
    assert!(message.contains("case.png is missing") && message.contains("UPDATE_GOLDEN=1"), "{message}");
    assert!(place.golden().is_none());
}

#[test]
fn an_update_writes_and_fails_all_the_same() {
    let place = Temporary::new();
    let (first, second) = (encode(&picture(5, 4)), encode(&picture(4, 5)));
    // Where there is none, where there is another one, and where there is nothing to do.
    for file in [&first, &second, &second] {
        let message = check("case", file, &place.folders, true).unwrap_err();
        assert!(message.contains("UPDATE_GOLDEN"), "{message}");
        assert_eq!(place.golden().as_ref(), Some(file));
    }
    assert_eq!(check("case", &second, &place.folders, false), Ok(()));
}

#[test]
fn a_difference_fails_and_is_shown() {
    let place = Temporary::new();
    let expected = picture(5, 4);
    std::fs::write(place.folders.golden.join("case.png"), encode(&expected)).unwrap();
    let mut actual = expected.clone();
    actual.pixels[7][1] += 1;
    actual.pixels[13][2] -= 60;
    let message = check("case", &encode(&actual), &place.folders, false).unwrap_err();
    let strip_path = place.folders.artifacts.join("case.png").display().to_string();
    assert!(message.contains("2 pixels differ, by up to 60 of 255") && message.contains(&strip_path), "{message}");
    // The golden picture is not touched.
    assert_eq!(place.golden(), Some(encode(&expected)));

    let strip = place.strip().unwrap();
    assert_eq!((strip.width, strip.height), (3 * 5 + 2 * GAP, 4));
    for y in 0..4 {
        for x in 0..5 {
            assert_eq!(strip.at(x, y), expected.at(x, y));
            assert_eq!(strip.at(2 * (5 + GAP) + x, y), actual.at(x, y));
            let shown = strip.at(5 + GAP + x, y);
            match y * 5 + x {
                // The smallest difference can be seen, a larger one more.
                7 => assert!(shown[0] >= 64 && shown[0] < 128, "{shown:?}"),
                13 => assert_eq!(shown, WHITE),
                _ => assert_eq!(shown, [0; 3]),
            }
        }
        assert!((5..5 + GAP).chain(10 + GAP..10 + 2 * GAP).all(|x| strip.at(x, y) == WHITE));
    }

    // A run that passes takes the strip away.
    assert_eq!(check("case", &encode(&expected), &place.folders, false), Ok(()));
    assert!(place.strip().is_none());
}

#[test]
fn another_size_is_a_difference() {
    let place = Temporary::new();
    std::fs::write(place.folders.golden.join("case.png"), encode(&picture(5, 4))).unwrap();
    let mut actual = picture(5, 6);
    actual.pixels.truncate(30);
    let message = check("case", &encode(&actual), &place.folders, false).unwrap_err();
    assert!(message.contains("10 pixels differ, by up to 255"), "{message}");
    assert_eq!(place.strip().unwrap().height, 6);
}

#[test]
fn other_bytes_of_the_same_pixels_fail() {
    let place = Temporary::new();
    let mut file = encode(&picture(5, 4));
    std::fs::write(place.folders.golden.join("case.png"), &file).unwrap();
    // What follows the last chunk is in no picture.
    file.push(0);
    let message = check("case", &file, &place.folders, false).unwrap_err();
    assert!(message.contains("same pixels"), "{message}");
}

#[test]
fn a_broken_golden_fails() {
    let place = Temporary::new();
    std::fs::write(place.folders.golden.join("case.png"), b"nothing").unwrap();
    let message = check("case", &encode(&picture(5, 4)), &place.folders, false).unwrap_err();
    assert!(message.contains("is no picture"), "{message}");
}
