//! Color maps, against the published ones and against what their names promise.

use morse_smooth::render::Colormap;

use super::image::{Rgb, distance};

const ALL: [Colormap; 8] = [
    Colormap::Viridis,
    Colormap::Cividis,
    Colormap::Magma,
    Colormap::Inferno,
    Colormap::Plasma,
    Colormap::CoolWarm,
    Colormap::BlueRed,
    Colormap::PurpleGreen,
];

/// CIE L*, 0 to 100: how light a color looks.
fn lightness(color: Rgb) -> f64 {
    let [r, g, b] = color.map(|byte| {
        let x = f64::from(byte) / 255.0;
        if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
    });
    let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    if y > 0.008856 { 116.0 * y.cbrt() - 16.0 } else { 903.3 * y }
}

#[test]
fn colors_are_those_that_are_published() {
    for (map, colors) in [
        (Colormap::Viridis, [[68, 1, 84], [33, 145, 140], [253, 231, 37]]),
        (Colormap::Magma, [[0, 0, 4], [183, 55, 121], [252, 253, 191]]),
        (Colormap::Inferno, [[0, 0, 4], [188, 55, 84], [252, 255, 164]]),
        (Colormap::Plasma, [[13, 8, 135], [204, 71, 120], [240, 249, 33]]),
        (Colormap::CoolWarm, [[59, 76, 192], [221, 221, 221], [180, 4, 38]]),
        // ColorBrewer's, whose splines pass near the colors.
        (Colormap::BlueRed, [[49, 54, 149], [255, 255, 191], [165, 0, 38]]),
        (Colormap::PurpleGreen, [[64, 0, 75], [247, 247, 247], [0, 68, 27]]),
    ] {
        for (place, color) in [0.0, 0.5, 1.0].into_iter().zip(colors) {
            let tolerance = if matches!(map, Colormap::BlueRed | Colormap::PurpleGreen) { 10 } else { 2 };
            let found = map.color(place);
            assert!(distance(found, color) <= tolerance, "{map:?} at {place}: {found:?}, {color:?} is published");
        }
    }
}

#[test]
fn uniform_maps_grow_lighter_evenly() {
    for map in &ALL[..5] {
        let steps: Vec<f64> = (0..=20).map(|k| lightness(map.color(f64::from(k) / 20.0))).collect();
        let mean = (steps[20] - steps[0]) / 20.0;
        assert!(mean > 2.0, "{map:?} spans {mean}");
        for pair in steps.windows(2) {
            let step = pair[1] - pair[0];
            assert!(step > 0.4 * mean && step < 1.6 * mean, "{map:?}: steps of {step} beside {mean}");
        }
    }
}

#[test]
fn diverging_maps_are_lightest_in_the_middle_and_alike_on_both_sides() {
    for map in &ALL[5..] {
        let at = |k: i32| lightness(map.color(0.5 + f64::from(k) / 20.0));
        for k in 0..10 {
            assert!(at(k) > at(k + 1) && at(-k) > at(-k - 1), "{map:?} at {k}");
            assert!((at(k) - at(-k)).abs() < 14.0, "{map:?} at {k}: {} and {}", at(k), at(-k));
        }
        let (low, high) = (map.color(0.0), map.color(1.0));
        assert!(distance(low, high) > 60, "{map:?} has {low:?} and {high:?} at its ends");
    }
}

#[test]
fn any_number_has_a_color() {
    for map in ALL {
        for low in [-1e300, -0.1, f64::NEG_INFINITY, -0.0] {
            assert_eq!(map.color(low), map.color(0.0));
        }
        for high in [1.1, 1e300, f64::INFINITY] {
            assert_eq!(map.color(high), map.color(1.0));
        }
        assert!(map.color(f64::NAN).len() == 3);
        assert_eq!(Colormap::named(map.name()), Ok(map));
    }
    assert!(Colormap::named("Viridis").is_err() && Colormap::named("").is_err());
}
