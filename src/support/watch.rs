//! Watching long work from outside, and stopping it.

use core::cell::RefCell;
use core::fmt;
use core::ops::{ControlFlow, Range};

use crate::error::{Cancelled, SolveError};
use crate::support::named::named;

/// A step of the work, for progress displays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Assembling a matrix, ordering it and analysing its pattern.
    Analysis,
    /// Computing a numeric factor.
    Factorization,
    /// Solving, refining and filtering.
    Solve,
    /// Counting critical points and norms.
    Report,
    /// Reading a field: critical points, persistence, simplification, Morse complex, level sets.
    Field,
}

named! { Phase {
    Analysis = "analysis", Factorization = "factorization", Solve = "solve", Report = "report", Field = "field",
} }

/// How far the work is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// What is being done.
    pub phase: Phase,
    /// The part of the whole work that is done, between 0 and 1; it never goes back.
    pub fraction: f64,
}

/// Who watches: told of every phase and every few milliseconds of work; `Break` stops the work.
type Watcher<'a> = &'a mut dyn FnMut(Progress) -> ControlFlow<()>;

/// Watches long work, hears its progress, and can stop it.
///
/// Work is counted in ticks of about a nanosecond in WebAssembly, never by a clock, so that what is computed depends on no timer.
/// Stopped work ends with the error `Cancelled`; nothing that was there before is changed by it.
///
/// # Example
/// ```
/// use core::ops::ControlFlow;
/// use morse_smooth::{Progress, Watch};
/// let mut print = |progress: Progress| {
///     println!("{} {:.0} %", progress.phase.name(), 100.0 * progress.fraction);
///     ControlFlow::Continue(())
/// };
/// let watch = Watch::new(&mut print);
/// # let _ = watch;
/// ```
pub struct Watch<'a> {
    state: RefCell<State<'a>>,
}

struct State<'a> {
    watcher: Option<Watcher<'a>>,
    stopped: bool,
    phase: Option<Phase>,
    /// What is told where work is not divided into steps yet.
    preparation: Phase,
    /// The part of the whole that the work at hand is.
    part: Range<f64>,
    /// The ticks that the work at hand is expected to take, and those done.
    expected: f64,
    done: f64,
    /// Ticks since the watcher was told last.
    untold: u64,
    /// All ticks but those, and how many there may be.
    spent: u64,
    limit: u64,
    /// The largest fraction told.
    told: f64,
}

/// The watcher is asked again after so many ticks: a few milliseconds.
const PATIENCE: u64 = 4_000_000;

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch").finish_non_exhaustive()
    }
}

impl Default for Watch<'_> {
    fn default() -> Self {
        Self::none()
    }
}

impl<'a> Watch<'a> {
    /// Nobody watches.
    #[must_use]
    pub fn none() -> Self {
        Self::with(None)
    }

    /// `watcher` hears the phase and the fraction done, and stops the work by `ControlFlow::Break(())`.
    #[must_use]
    pub fn new(watcher: &'a mut dyn FnMut(Progress) -> ControlFlow<()>) -> Self {
        Self::with(Some(watcher))
    }

    fn with(watcher: Option<Watcher<'a>>) -> Self {
        let state = State {
            watcher,
            stopped: false,
            phase: None,
            preparation: Phase::Field,
            part: 0.0..1.0,
            expected: 0.0,
            done: 0.0,
            untold: 0,
            spent: 0,
            limit: u64::MAX,
            told: 0.0,
        };
        Self { state: RefCell::new(state) }
    }

    /// Counts work that was done, or is about to be, in nanoseconds or so, and asks the watcher from time to time.
    ///
    /// # Errors
    /// `Cancelled` where the watcher stops the work.
    #[inline]
    pub(crate) fn tick(&self, ticks: u64) -> Result<(), Cancelled> {
        let mut state = self.state.borrow_mut();
        state.untold += ticks;
        if state.untold < PATIENCE {
            return Ok(());
        }
        state.tell()
    }

    /// Does work that may take so many ticks. Beyond them it is stopped, as by the watcher, and has failed to converge.
    ///
    /// # Errors
    /// Those of the work; `NotConverged` where it took longer.
    pub(crate) fn within<T>(&self, ticks: u64, work: impl FnOnce() -> Result<T, SolveError>) -> Result<T, SolveError> {
        let outer = {
            let mut state = self.state.borrow_mut();
            state.account();
            let limit = state.spent.saturating_add(ticks).min(state.limit);
            core::mem::replace(&mut state.limit, limit)
        };
        let outcome = work();
        let mut state = self.state.borrow_mut();
        let is_over = state.is_over();
        state.limit = outer;
        if !matches!(outcome, Err(SolveError::Cancelled {})) || state.stopped || !is_over {
            return outcome;
        }
        // What made the work stop at every tick.
        state.untold = 0;
        Err(SolveError::NotConverged { iterations: 0, residual: 1.0 })
    }

    /// Names what is done until work is divided into steps: nothing of these is done then.
    pub(crate) fn prepare(&self, phase: Phase) {
        self.state.borrow_mut().preparation = phase;
    }

    /// Divides the work at hand into steps with these shares of its time. A plan within a plan divides that one's current step.
    pub(crate) fn plan<'w>(&'w self, steps: &'w [(Phase, f64)]) -> Plan<'w, 'a> {
        let mut state = self.state.borrow_mut();
        state.account();
        let part = state.part.clone();
        let phase = state.phase;
        // What is done of the work at hand before it was divided stays done.
        let start = state.fraction();
        Plan { watch: self, steps, next: 0, part: start..part.end, phase, whole: part }
    }
}

impl State<'_> {
    fn account(&mut self) {
        self.done += self.untold as f64;
        self.spent = self.spent.saturating_add(self.untold);
        self.untold = 0;
    }

    fn is_over(&self) -> bool {
        self.spent > self.limit
    }

    fn fraction(&self) -> f64 {
        let done = if self.expected > 0.0 { (self.done / self.expected).min(1.0) } else { 0.0 };
        self.part.start + (self.part.end - self.part.start) * done
    }

    #[cold]
    #[inline(never)]
    fn tell(&mut self) -> Result<(), Cancelled> {
        if self.stopped {
            return Err(Cancelled);
        }
        self.account();
        self.told = self.told.max(self.fraction());
        let progress = Progress { phase: self.phase.unwrap_or(self.preparation), fraction: self.told };
        if let Some(watcher) = &mut self.watcher {
            self.stopped = watcher(progress).is_break();
        }
        if !self.stopped && !self.is_over() {
            return Ok(());
        }
        // Work that is stopped once stays so: whoever goes on, or tries another way than the one that failed, hears it at the next tick.
        self.untold = PATIENCE;
        Err(Cancelled)
    }
}

/// Work divided into steps. When it is dropped, the step of the plan around it counts as done.
pub(crate) struct Plan<'w, 'a> {
    watch: &'w Watch<'a>,
    steps: &'w [(Phase, f64)],
    next: usize,
    part: Range<f64>,
    /// The phase of the plan around this one, which stands for all its steps.
    phase: Option<Phase>,
    whole: Range<f64>,
}

impl Plan<'_, '_> {
    /// Begins the next step, and tells the watcher. `ticks` is what it is expected to take, where it counts its work itself and is not
    /// divided again.
    ///
    /// # Errors
    /// `Cancelled` where the watcher stops the work.
    pub(crate) fn begin(&mut self, ticks: u64) -> Result<(), Cancelled> {
        let total: f64 = self.steps.iter().map(|(_, share)| share).sum();
        let before: f64 = self.steps[..self.next.min(self.steps.len())].iter().map(|(_, share)| share).sum();
        let Some(&(phase, share)) = self.steps.get(self.next) else { return Ok(()) };
        self.next += 1;
        let length = self.part.end - self.part.start;
        let at = |share: f64| if total > 0.0 { self.part.start + length * share / total } else { self.part.start };
        let mut state = self.watch.state.borrow_mut();
        state.part = at(before)..at(before + share);
        state.phase = self.phase.or(Some(phase));
        state.account();
        state.expected = ticks as f64;
        state.done = 0.0;
        state.tell()
    }

    /// Tells the watcher that the work divided here is done.
    ///
    /// # Errors
    /// `Cancelled` where the watcher stops even now: what asked for the work is then told so.
    pub(crate) fn finish(self) -> Result<(), Cancelled> {
        let mut state = self.watch.state.borrow_mut();
        state.part = self.part.end..self.part.end;
        state.expected = 0.0;
        state.tell()
    }

    /// Passes over the steps before this one, which are not needed.
    pub(crate) fn skip_to(&mut self, step: usize) {
        self.next = step;
    }
}

impl Drop for Plan<'_, '_> {
    fn drop(&mut self) {
        let mut state = self.watch.state.borrow_mut();
        // Done as a whole: what comes next of the work at hand starts at its end. A new piece of work starts from nothing.
        let is_outermost = self.phase.is_none();
        state.part = if is_outermost { 0.0..1.0 } else { self.part.end..self.whole.end };
        state.told = if is_outermost { 0.0 } else { state.told };
        state.account();
        state.phase = self.phase;
        state.expected = 0.0;
        state.done = 0.0;
    }
}
