//! The stages of the solver and of its peers as plain functions of numbers, so that JavaScript takes the times and no
//! bindings are generated. One session per instance: a mesh, a system on it, and what every solver has made of it so far.
//!
//! Called out of order, a function panics: the message goes to `report`, and the instance is done for.

#[path = "../../common/mod.rs"]
mod common;

use std::cell::RefCell;

use morse_smooth::TriMesh;
use nalgebra_sparse::pattern::SparsityPattern;

use common::accuracy::{Accuracy, METRICS, refined};
use common::csc::{Csc, permuted};
use common::faer::{Faer, Lower};
use common::meshes::{self, SHAPES};
use common::ours::{Analysis, Factor, Precision, order};
use common::systems::{COLUMNS, KINDS, System, Values};

#[derive(Default)]
struct Session {
    mesh: Option<TriMesh>,
    system: Option<System>,
    order: Vec<u32>,
    analysis: Option<Analysis>,
    factor: Option<Factor>,
    faer: Option<Faer>,
    csc: Option<Csc>,
    accuracy: Option<Accuracy>,
    results: Vec<f64>,
}

thread_local! {
    static SESSION: RefCell<Session> = RefCell::default();
}

fn session<T>(work: impl FnOnce(&mut Session) -> T) -> T {
    SESSION.with_borrow_mut(work)
}

impl Session {
    fn system(&self) -> &System {
        self.system.as_ref().expect("a system comes first")
    }

    /// The analysis takes the pattern over, as the system of a smoothing does: a copy would count as memory.
    fn pattern(&self) -> &SparsityPattern {
        self.analysis.as_ref().map_or(&self.system().pattern, Analysis::pattern)
    }

    /// The first `columns` right-hand sides.
    fn right_hand_sides(&self, columns: usize) -> Values {
        let all = &self.system().right_hand_sides;
        match all {
            Values::Real(values) => Values::Real(values[..values.len() / COLUMNS * columns].to_vec()),
            Values::Complex(values) => Values::Complex(values[..values.len() / COLUMNS * columns].to_vec()),
        }
    }
}

fn precision(bits: u32) -> Precision {
    if bits == 32 { Precision::Single } else { Precision::Double }
}

unsafe extern "C" {
    /// Takes the text of a panic.
    fn report(text: *const u8, length: usize);
}

/// Call before anything else.
#[unsafe(no_mangle)]
extern "C" fn start() {
    std::panic::set_hook(Box::new(|panic| {
        let text = panic.to_string();
        // SAFETY: the text lives until the call returns, and JavaScript copies it.
        unsafe { report(text.as_ptr(), text.len()) };
    }));
}

/// Builds a mesh of about that many vertices; returns how many they are.
#[unsafe(no_mangle)]
extern "C" fn build_mesh(shape: usize, size: u32) -> f64 {
    session(|session| {
        let mesh = meshes::build(SHAPES[shape].1, size);
        let vertices = mesh.vertex_count();
        session.mesh = Some(mesh);
        vertices as f64
    })
}

/// Assembles a system on the mesh; returns the number of unknowns. What solvers have made of a system of the same kind with
/// another ε stays.
#[unsafe(no_mangle)]
extern "C" fn build_system(kind: usize, epsilon: f64) -> f64 {
    session(|session| {
        let mesh = session.mesh.as_ref().expect("a mesh comes first");
        let system = System::new(mesh, KINDS[kind].1, epsilon);
        let unknowns = system.pattern.major_dim();
        session.system = Some(system);
        unknowns as f64
    })
}

#[unsafe(no_mangle)]
extern "C" fn ours_order() {
    session(|session| session.order = order(session.pattern()));
}

/// Returns the entries of the factor.
#[unsafe(no_mangle)]
extern "C" fn ours_analyze() -> f64 {
    session(|session| {
        let system = session.system.as_mut().expect("a system comes first");
        let pattern = match session.analysis.take() {
            Some(analysis) => analysis.pattern().clone(),
            None => core::mem::replace(&mut system.pattern, SparsityPattern::zeros(0, 0)),
        };
        let analysis = Analysis::new(pattern, &session.order);
        let nonzeros = analysis.nonzeros();
        session.analysis = Some(analysis);
        nonzeros
    })
}

/// Returns 0 where the matrix is not positive definite to that precision.
#[unsafe(no_mangle)]
extern "C" fn ours_factor(bits: u32) -> f64 {
    session(|session| {
        // As two would hardly fit at a million vertices.
        session.factor = None;
        let analysis = session.analysis.as_ref().expect("an analysis comes first");
        session.factor = analysis.factor(&session.system().values, precision(bits));
        f64::from(session.factor.is_some())
    })
}

#[unsafe(no_mangle)]
extern "C" fn ours_refactor() {
    session(|session| {
        let system = session.system.as_ref().expect("a system comes first");
        session.factor.as_mut().expect("a factor comes first").refactor(&system.values);
    });
}

#[unsafe(no_mangle)]
extern "C" fn ours_solve(columns: usize) -> f64 {
    session(|session| {
        session.factor.as_ref().expect("a factor comes first").solve(&session.right_hand_sides(columns)).sum()
    })
}

/// Solves a complex system with refinement; returns the number of steps.
#[unsafe(no_mangle)]
extern "C" fn ours_refined() -> f64 {
    session(|session| {
        let Values::Complex(values) = &session.system().values else { panic!("a complex system") };
        let Values::Complex(b) = session.right_hand_sides(1) else { panic!("a complex right-hand side") };
        let factor = session.factor.as_ref().expect("a factor comes first");
        refined(session.pattern(), values, &b, factor).1 as f64
    })
}

/// Copies the matrix as well; returns the numbers that the factor will hold.
#[unsafe(no_mangle)]
extern "C" fn faer_analyze(own_order: u32) -> f64 {
    session(|session| {
        session.faer = None;
        let lower = Lower::new(session.pattern(), session.system().values.real());
        let faer = Faer::new(lower, (own_order == 0).then_some(&session.order));
        let nonzeros = faer.nonzeros();
        session.faer = Some(faer);
        nonzeros
    })
}

#[unsafe(no_mangle)]
extern "C" fn faer_factor() {
    session(|session| session.faer.as_mut().expect("an analysis comes first").factor());
}

#[unsafe(no_mangle)]
extern "C" fn faer_solve(columns: usize) -> f64 {
    session(|session| {
        let b = session.right_hand_sides(columns);
        session.faer.as_ref().expect("a factor comes first").solve(b.real()).iter().sum()
    })
}

#[unsafe(no_mangle)]
extern "C" fn csc_analyze() {
    session(|session| {
        session.csc = None;
        let permuted = permuted(session.pattern(), session.system().values.real(), &session.order);
        session.csc = Some(Csc::new(permuted, &session.order));
    });
}

/// Returns the entries of the factor.
#[unsafe(no_mangle)]
extern "C" fn csc_factor() -> f64 {
    session(|session| {
        let csc = session.csc.as_mut().expect("an analysis comes first");
        csc.factor();
        csc.nonzeros()
    })
}

#[unsafe(no_mangle)]
extern "C" fn csc_solve(columns: usize) -> f64 {
    session(|session| {
        let b = session.right_hand_sides(columns);
        session.csc.as_ref().expect("a factor comes first").solve(b.real()).iter().sum()
    })
}

/// Frees what the peers hold.
#[unsafe(no_mangle)]
extern "C" fn forget_peers() {
    session(|session| (session.faer, session.csc) = (None, None));
}

/// Prepares the functions below for the mesh.
#[unsafe(no_mangle)]
extern "C" fn accuracy_start() {
    session(|session| session.accuracy = Some(Accuracy::new(session.mesh.clone().expect("a mesh comes first"))));
}

/// Puts errors into the results (array 6) and returns their number, 0 where the matrix is not positive
/// definite to the precision.
#[unsafe(no_mangle)]
extern "C" fn accuracy_real(metric: usize, epsilon: f64, bits: u32) -> usize {
    session(|session| {
        let accuracy = session.accuracy.as_ref().expect("accuracy_start comes first");
        session.results = accuracy.real(METRICS[metric].1, epsilon, precision(bits)).unwrap_or_default();
        session.results.len()
    })
}

/// As `accuracy_real`, for the complex system; then refinement's number of steps and its error.
#[unsafe(no_mangle)]
extern "C" fn accuracy_complex(epsilon: f64, bits: u32) -> usize {
    session(|session| {
        let accuracy = session.accuracy.as_ref().expect("accuracy_start comes first");
        session.results = accuracy.complex(epsilon, precision(bits)).unwrap_or_default();
        session.results.len()
    })
}

/// Calls `then` with address and length of an array: positions, triangles; offsets, rows and values of the matrix, right-hand
/// sides; results.
fn array<T>(which: u32, then: impl Fn(usize, usize) -> T) -> T {
    fn span<E, T>(slice: &[E], then: impl Fn(usize, usize) -> T) -> T {
        then(slice.as_ptr() as usize, slice.len())
    }
    session(|session| {
        let mesh = session.mesh.as_ref().expect("a mesh comes first");
        match which {
            0 => span(mesh.positions(), then),
            1 => span(mesh.connectivity().triangles().as_flattened(), then),
            2 => span(session.pattern().major_offsets(), then),
            3 => span(session.pattern().minor_indices(), then),
            4 => span(session.system().values.real(), then),
            5 => span(session.system().right_hand_sides.real(), then),
            _ => span(&session.results, then),
        }
    })
}

#[unsafe(no_mangle)]
extern "C" fn array_address(which: u32) -> usize {
    array(which, |address, _| address)
}

#[unsafe(no_mangle)]
extern "C" fn array_length(which: u32) -> usize {
    array(which, |_, length| length)
}
