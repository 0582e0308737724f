//! Round numbers for axes, and how they are written.

use morse_smooth::render::{round_ticks, tick_label};
use proptest::prelude::*;

#[test]
fn ticks_are_the_numbers_one_would_choose() {
    let cases: [(f64, f64, usize, &[f64]); 16] = [
        (0.0, 1.0, 6, &[0.0, 0.2, 0.4, 0.6, 0.8, 1.0]),
        (0.0, 1.0, 5, &[0.0, 0.5, 1.0]),
        (0.0, 1.0, 11, &[0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]),
        (-1.0, 1.0, 5, &[-1.0, -0.5, 0.0, 0.5, 1.0]),
        (-1.0, 1.0, 1, &[0.0]),
        (0.09, 0.31, 3, &[0.1, 0.2, 0.3]),
        (-0.31, -0.09, 3, &[-0.3, -0.2, -0.1]),
        (3.2, 3.3, 4, &[3.2, 3.25, 3.3]),
        (999.0, 1001.0, 3, &[999.0, 1000.0, 1001.0]),
        (0.0, 1.7e308, 4, &[0.0, 5e307, 1e308, 1.5e308]),
        (-1.7e308, 1.7e308, 4, &[-1e308, 0.0, 1e308]),
        (0.0, 7e-324, 9, &[0.0, 5e-324]),
        (1e-300, 4e-300, 4, &[1e-300, 2e-300, 3e-300, 4e-300]),
        (1e-300, 1e300, 5, &[2e299, 4e299, 6e299, 8e299, 1e300]),
        (0.1, 0.1, 3, &[0.1]),
        (1.0, 1.0 + f64::EPSILON, 5, &[1.0]),
    ];
    for (low, high, most, expected) in cases {
        let ticks = round_ticks(low, high, most);
        assert!(are_near(&ticks, expected), "{low:e} to {high:e}, {most}: {ticks:?}");
    }
    // Zero has no sign, and nothing is made of nonsense.
    assert!(round_ticks(-0.0, -0.0, 3)[0].is_sign_positive());
    assert!(round_ticks(-2.0, 0.0, 3).iter().all(|tick| *tick != 0.0 || tick.is_sign_positive()));
    for (low, high) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY), (f64::NEG_INFINITY, 0.0)] {
        assert!(round_ticks(low, high, 5).is_empty());
    }
    assert!(round_ticks(0.0, 1.0, 0).is_empty());
    assert!(round_ticks(0.0, 1.0, usize::MAX).len() <= 1000);
}

#[test]
fn labels_are_what_one_would_write() {
    let cases: [(f64, [f64; 2], f64, &str); 31] = [
        (0.0, [0.0, 1.0], 0.2, "0"),
        (-0.0, [-1.0, 1.0], 0.2, "0"),
        (0.6, [0.0, 1.0], 0.2, "0.6"),
        (1.0, [0.0, 1.0], 0.2, "1"),
        (0.3, [0.0, 1.0], 0.30000000000000004 - 0.2, "0.3"),
        (0.25, [0.0, 1.0], 0.05, "0.25"),
        (-2.5, [-5.0, 5.0], 0.5, "−2.5"),
        (100.0, [0.0, 200.0], 50.0, "100"),
        (123.456, [0.0, 200.0], 50.0, "123"),
        (99999.0, [0.0, 99999.0], 20000.0, "99999"),
        (300000.0, [0.0, 600000.0], 100000.0, "300000"),
        (1234567.0, [0.0, 1234567.0], 12345.0, "1.23e6"),
        (500000.0, [0.0, 2e6], 500000.0, "5e5"),
        (1.5e6, [0.0, 2e6], 500000.0, "1.5e6"),
        (0.005, [0.0, 0.01], 0.005, "0.005"),
        (-0.0002, [-0.0005, 0.0005], 0.0001, "−2e−4"),
        (1.5e-7, [0.0, 4e-7], 5e-8, "1.5e−7"),
        (1e-300, [0.0, 4e-300], 1e-300, "1e−300"),
        (1e300, [-1e300, 1e300], 5e299, "1e300"),
        (5e-324, [0.0, 5e-324], 5e-324, "5e−324"),
        (f64::MAX, [f64::MIN, f64::MAX], f64::MAX, "2e308"),
        // Far from zero, what differs is what is written.
        (1000000002.0, [1e9, 1e9 + 5.0], 1.0, "1000000002"),
        (1.00002, [1.0, 1.0001], 2e-5, "1.00002"),
        (0.9999, [0.9, 1.1], 0.01, "1"),
        (0.0004, [0.0, 1.0], 0.1, "0"),
        (0.1 + 0.2, [0.3, 0.3], 0.0, "0.30000000000000004"),
        (0.1 + 0.2, [0.3, 0.3], 1e-6, "0.3"),
        (
            123456789012345680000.0,
            [123456789012345660000.0, 123456789012345680000.0],
            f64::NAN,
            "123456789012345680000",
        ),
        (f64::NAN, [0.0, 1.0], 0.1, "NaN"),
        (f64::NEG_INFINITY, [0.0, 1.0], 0.1, "−∞"),
        (1e-9, [f64::NAN, f64::INFINITY], f64::INFINITY, "1e−9"),
    ];
    for (value, range, step, expected) in cases {
        assert_eq!(tick_label(value, range, step), expected, "{value:e} of {range:?}, {step:e}");
    }
}

/// Numbers of every size, mostly with few digits.
fn number() -> impl Strategy<Value = f64> {
    let short = (-9999_i32..=9999, -12_i32..=12).prop_map(|(digits, place)| parse(&format!("{digits}e{place}")));
    let long = any::<f64>().prop_filter("not near the largest, beyond which it may be rounded", |x| x.abs() < 1e308);
    prop_oneof![3 => short, 1 => long, 1 => Just(0.0), 1 => -2.0..2.0]
}

/// Two of them, at times very close.
fn range() -> impl Strategy<Value = (f64, f64)> {
    let apart = (number(), number());
    let close = (number(), 1_u32..200).prop_map(|(low, ulps)| (low, (0..ulps).fold(low, |x, _| x.next_up())));
    prop_oneof![3 => apart, 1 => close]
        .prop_map(|(a, b)| (a.min(b), a.max(b)))
        .prop_filter("finite", |(low, high)| low.is_finite() && high.is_finite())
}

/// The same, to the last bit where numbers are of the sizes that powers of ten reach exactly.
fn are_near(ticks: &[f64], expected: &[f64]) -> bool {
    let largest = expected.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let tolerance = if (1e-12..1e15).contains(&largest) { 0.0 } else { 2e-15 * largest };
    ticks.len() == expected.len() && ticks.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance)
}

fn parse(decimal: &str) -> f64 {
    decimal.parse().expect("a number")
}

/// The multiples of a step in a range of whole numbers, counted.
fn multiples(low: i64, high: i64, step: i64) -> Vec<i64> {
    (low..=high).filter(|x| x % step == 0).collect()
}

proptest! {
    #[test]
    fn ticks_lie_inside_in_order_and_are_not_too_many((low, high) in range(), most in 0_usize..40) {
        let ticks = round_ticks(low, high, most);
        prop_assert!(ticks.len() <= most);
        prop_assert!(ticks.windows(2).all(|pair| pair[0] < pair[1]));
        prop_assert!(ticks.iter().all(|&tick| low <= tick && tick <= high));
        if most > 0 && low < 0.0 && high > 0.0 {
            prop_assert!(!ticks.is_empty());
        }
    }

    /// In whole numbers the best step is found by counting, whatever the power of ten that they are multiplied with.
    #[test]
    fn ticks_are_as_many_as_steps_allow(low in -3000_i64..3000, width in 1_i64..3000, most in 1_usize..30, place in -300_i32..290) {
        let high = low + width;
        // Two places further down than the numbers have, so that every step of interest is whole.
        let (low, high) = (100 * low, 100 * high);
        let steps = [1_000_000_i64, 100_000, 10_000, 1000, 100, 10, 1].into_iter().flat_map(|power| [5, 2, 1].map(|m| m * power));
        let best = steps.map(|step| multiples(low, high, step)).filter(|all| all.len() <= most).max_by(|a, b| {
            // The first one of the longest.
            a.len().cmp(&b.len()).then(core::cmp::Ordering::Greater)
        });
        let expected: Vec<f64> = best.unwrap_or_default().iter().map(|k| parse(&format!("{k}e{place}"))).collect();
        let ticks = round_ticks(parse(&format!("{low}e{place}")), parse(&format!("{high}e{place}")), most);
        prop_assert!(are_near(&ticks, &expected), "{ticks:?}, not {expected:?}");
    }

    #[test]
    fn labels_tell_ticks_apart_and_are_near_them((low, high) in range(), most in 2_usize..12) {
        let ticks = round_ticks(low, high, most);
        for pair in ticks.windows(2) {
            let step = pair[1] - pair[0];
            let labels = [0, 1].map(|k| tick_label(pair[k], [low, high], step));
            prop_assert!(labels[0] != labels[1], "{pair:?}: {labels:?}");
            for (label, &tick) in labels.iter().zip(pair) {
                let read = parse(&label.replace('−', "-"));
                prop_assert!((read - tick).abs() <= 1e-3 * step + 2e-15 * tick.abs(), "{tick:e}: {label}");
            }
        }
    }

    #[test]
    fn labels_are_rounded_to_the_step(value in number(), (low, high) in range(), step in number()) {
        let label = tick_label(value, [low, high], step.abs());
        prop_assert!(label.len() < 40, "{label}");
        prop_assert!(!label.contains('-'));
        let read = parse(&label.replace('−', "-"));
        let largest = value.abs().max(low.abs()).max(high.abs());
        prop_assert!((read - value).abs() <= 0.51 * step.abs().min(largest) + 1e-15 * largest + 5e-324, "{label}");
    }
}
