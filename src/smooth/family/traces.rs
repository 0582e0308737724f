//! How many degrees of freedom a smoothed field has: the trace of the matrix (S + εB)⁻¹εB that smooths.

/// The traces for all ε, between those known at some.
///
/// They go from the number of components, ε → 0, to the number of known values. On the logit of their way between these ends,
/// against ln ε, they lie near to a line, on which a monotone cubic joins those that are known.
#[derive(Debug)]
pub(super) struct Traces {
    least: f64,
    most: f64,
    /// ln ε, the logit, and its slope, ascending.
    knots: Vec<[f64; 3]>,
}

/// Shares of the way that are as good as its ends.
const END: f64 = 1e-9;

impl Traces {
    pub(super) fn new(shifts: &[f64], traces: &[f64], least: f64, most: f64) -> Self {
        let share = |trace: f64| ((trace - least) / (most - least)).clamp(END, 1.0 - END);
        let logit = |trace: f64| libm::log(share(trace) / (1.0 - share(trace)));
        let mut knots: Vec<[f64; 3]> = Vec::with_capacity(shifts.len());
        for (shift, &trace) in shifts.iter().zip(traces).filter(|_| most > least) {
            let at = libm::log(*shift);
            knots.insert(knots.partition_point(|knot| knot[0] < at), [at, logit(trace), 0.0]);
        }
        // Probes have a little noise: traces never fall with ε.
        for k in 1..knots.len() {
            knots[k][1] = knots[k][1].max(knots[k - 1][1]);
        }
        let secants: Vec<f64> =
            knots.windows(2).map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).collect();
        for k in 0..knots.len() {
            let before = k.checked_sub(1).and_then(|k| secants.get(k));
            // The harmonic mean keeps the cubics monotone [Fritsch84].
            knots[k][2] = match (before, secants.get(k)) {
                (Some(a), Some(b)) if a * b > 0.0 => 2.0 * a * b / (a + b),
                (Some(_), Some(_)) => 0.0,
                (Some(only), None) | (None, Some(only)) => *only,
                (None, None) => 0.5,
            };
        }
        Self { least, most, knots }
    }

    pub(super) fn at(&self, epsilon: f64) -> f64 {
        let t = libm::log(epsilon);
        let place = self.knots.partition_point(|knot| knot[0] <= t);
        let logit = match (place.checked_sub(1).and_then(|k| self.knots.get(k)), self.knots.get(place)) {
            (Some(a), Some(b)) => {
                let h = b[0] - a[0];
                let s = (t - a[0]) / h;
                let (rise, bend) = (s * s * (3.0 - 2.0 * s), s * (1.0 - s));
                a[1] + (b[1] - a[1]) * rise + h * bend * ((1.0 - s) * a[2] - s * b[2])
            }
            (Some(only), None) | (None, Some(only)) => only[1] + (t - only[0]) * only[2],
            (None, None) => return self.most,
        };
        self.least + (self.most - self.least) / (1.0 + libm::exp(-logit))
    }
}
