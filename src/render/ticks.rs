//! Round numbers for axes, and how they are written.
//!
//! All in decimal and whole numbers: 3 · 0.1 is not 0.3 in doubles, and logarithms differ from platform to platform.

/// More ticks than any axis has room for; the bound keeps a slip from filling the memory.
const MOST: usize = 1000;
/// Powers of ten up to this one are doubles.
const EXACT: i32 = 22;
/// Decimal places from the first digit of a double to beyond its last one.
const PLACES: i32 = 16;
/// Numbers from a million on, and those below a thousandth, are written with an exponent where that is shorter.
const LARGE: i32 = 6;
const SMALL: i32 = -3;
/// How finely the notation has to tell values of a range apart: in so many parts.
const PARTS: f64 = 100.0;
/// Below the last place of every double.
const LEAST: i32 = -400;

/// Round numbers in a range: multiples of 1, 2 or 5 times a power of ten, as many as there may be but at most `most`.
///
/// # Properties
/// Ascending, and in \[low, high\], ends included. Each is the double nearest to its decimal, so that 0.3 is `0.3`; for
/// ticks below 1e-22 apart, or above 1e22, nearly so. A range of one
/// value has this one. None where a number is not finite or the larger one comes first, and never more than 1000.
///
/// # Example
/// ```
/// use morse_smooth::render::round_ticks;
/// assert_eq!(round_ticks(-0.31, 0.52, 6), [-0.2, 0.0, 0.2, 0.4]);
/// assert_eq!(round_ticks(-0.31, 0.52, 9), [-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5]);
/// ```
#[must_use]
pub fn round_ticks(low: f64, high: f64, most: usize) -> Vec<f64> {
    let most = most.min(MOST) as i64;
    if !(low <= high && low.is_finite() && high.is_finite()) || most == 0 {
        return Vec::new();
    }
    if low == high {
        // Not −0.
        return vec![low + 0.0];
    }
    let ends = [Decimal::of(low), Decimal::of(high)];
    let top = ends[0].place().max(ends[1].place());
    // The last step that is wide enough, with its first multiple and how many there are.
    let mut best = (Step { times: 1, place: 0 }, 0, 0);
    let mut step = Step { times: 1, place: top + 1 };
    // Not as far as there are decimals between neighbouring doubles.
    while step.place > top - PLACES {
        let first = -step.last_below(ends[0].negative());
        let count = step.last_below(ends[1]) - first + 1;
        if count > most {
            break;
        }
        if count > best.2 {
            best = (step, first, count);
        }
        step = step.next();
    }
    let (step, first, count) = best;
    let mut ticks: Vec<f64> = (first..first + count).map(|k| step.multiple(k).clamp(low, high)).collect();
    ticks.dedup();
    ticks
}

/// A value on an axis of that range, in as few digits as tell ticks apart that are so far from one another.
///
/// # Properties
/// Rounded to the decimal place of the step's first digit, or to a whole number in front of it; trailing zeros are left out. Minus
/// is U+2212. The notation is that of the whole range: plain, or like `1.5e−7` for large and small numbers where that is shorter.
/// Without a positive step, all digits of the value.
///
/// # Example
/// ```
/// use morse_smooth::render::tick_label;
/// assert_eq!(tick_label(-0.25, [-1.0, 1.0], 0.05), "−0.25");
/// assert_eq!(tick_label(1.5e-7, [0.0, 4e-7], 5e-8), "1.5e−7");
/// ```
#[must_use]
pub fn tick_label(value: f64, range: [f64; 2], step: f64) -> String {
    if value.is_nan() {
        return "NaN".to_owned();
    }
    let sign = if value < 0.0 { "−" } else { "" };
    if value.is_infinite() {
        return format!("{sign}∞");
    }
    let [low, high] = range.map(|end| if end.is_finite() { end.abs() } else { 0.0 });
    let top = Decimal::of(value.abs().max(low).max(high)).place();
    let fine = |step: f64| {
        let place = if step > 0.0 && step.is_finite() { Decimal::of(step).rounded_place() } else { i32::MIN };
        place.clamp(top - PLACES, top)
    };
    let part = range[1] / PARTS - range[0] / PARTS;
    let is_scientific = is_scientific(top, fine(if part > 0.0 { part } else { step }));
    let mut place = fine(step);
    if !is_scientific {
        place = place.min(0).max(top - PLACES);
    }
    let mut digits = Decimal::of(value.abs()).rounded(place);
    if digits == 0 {
        return "0".to_owned();
    }
    while digits % 10 == 0 {
        digits /= 10;
        place += 1;
    }
    let digits = digits.to_string();
    // Digits in front of the point.
    let whole = digits.len() as i32 + place;
    let zeros = |count: i32| "0".repeat(count.max(0) as usize);
    if is_scientific {
        let (first, rest) = digits.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        let (minus, exponent) = (if whole < 1 { "−" } else { "" }, (whole - 1).abs());
        format!("{sign}{first}{point}{rest}e{minus}{exponent}")
    } else if place >= 0 {
        format!("{sign}{digits}{}", zeros(place))
    } else if whole > 0 {
        let (whole, rest) = digits.split_at(whole as usize);
        format!("{sign}{whole}.{rest}")
    } else {
        format!("{sign}0.{}{digits}", zeros(-whole))
    }
}

/// Whether numbers with digits from one place to another are written with an exponent.
fn is_scientific(top: i32, fine: i32) -> bool {
    let count = top - fine + 1;
    let plain = top.max(0) + 1 + if fine < 0 { 1 - fine } else { 0 };
    let exponent = 1 + i32::from(top < 0) + i32::from(top.abs() > 9) + i32::from(top.abs() > 99);
    let scientific = count + i32::from(count > 1) + 1 + exponent;
    !(SMALL..LARGE).contains(&top) && scientific < plain
}

/// 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy)]
struct Step {
    times: i64,
    place: i32,
}

impl Step {
    fn next(self) -> Self {
        match self.times {
            1 => Self { times: 5, place: self.place - 1 },
            5 => Self { times: 2, ..self },
            _ => Self { times: 1, ..self },
        }
    }

    /// The number of the last multiple that is not above an end.
    fn last_below(self, end: Decimal) -> i64 {
        let shift = end.exponent - self.place;
        if shift >= 0 {
            (end.digits * power(shift)).div_euclid(self.times)
        } else {
            end.digits.div_euclid(power(-shift).saturating_mul(self.times))
        }
    }

    fn multiple(self, k: i64) -> f64 {
        let mut number = (k * self.times) as f64;
        let mut left = self.place;
        // One exact product or quotient, rounded once, within 22 places.
        while left != 0 && number != 0.0 {
            let places = left.abs().min(EXACT);
            let factor = (0..places).fold(1.0, |power, _| 10.0 * power);
            number = if left > 0 { number * factor } else { number / factor };
            left -= places * left.signum();
        }
        number
    }
}

/// digits · 10^exponent, with the fewest digits that read back as the same double: at most 17.
#[derive(Clone, Copy)]
struct Decimal {
    digits: i64,
    exponent: i32,
}

impl Decimal {
    fn of(number: f64) -> Self {
        let text = format!("{number:e}");
        let (digits, exponent) = text.split_once('e').unwrap_or_default();
        let places = digits.split_once('.').map_or(0, |(_, places)| places.len() as i32);
        let digits = digits.replace('.', "").parse().unwrap_or_default();
        Self { digits, exponent: exponent.parse::<i32>().unwrap_or_default() - places }
    }

    fn negative(self) -> Self {
        Self { digits: -self.digits, ..self }
    }

    /// The place of the first digit: 0 for units, −1 for tenths.
    fn place(self) -> i32 {
        if self.digits == 0 { LEAST } else { self.exponent + self.digits.unsigned_abs().ilog10() as i32 }
    }

    /// The same once it is rounded to that digit.
    fn rounded_place(self) -> i32 {
        let place = self.place();
        place + i32::from(self.rounded(place).abs() > 9)
    }

    /// In units of a place at most [`PLACES`] below the first digit; halves away from 0.
    fn rounded(self, place: i32) -> i64 {
        let shift = self.exponent - place;
        if shift >= 0 {
            return self.digits * power(shift);
        }
        let unit = power(-shift);
        (self.digits.abs() + unit / 2) / unit * self.digits.signum()
    }
}

/// A power of ten. Larger ones than 10^18 are asked for only to divide by them what is smaller than that.
fn power(exponent: i32) -> i64 {
    (0..exponent.min(18)).fold(1, |power, _| 10 * power)
}
