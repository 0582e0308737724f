//! The functional as a quadratic ½xᵀHx − cᵀx over the vertices of triangles, with its matrix on the pattern that all steps of the
//! interior-point method share.

use nalgebra_sparse::pattern::SparsityPattern;

use crate::error::{Result, SolveError};
use crate::mesh::{Connectivity, LinkKind};
use crate::smooth::channels::Channel;
use crate::smooth::routes::{Problem, RightHandSide};
use crate::smooth::system::{Matrices, Square};
use crate::solve::{CholeskyAnalysis, CholeskyFactor};
use crate::support::memory;
use crate::support::watch::Watch;

/// The functional, divided by the scale of the system (see [`Problem`]).
pub(super) struct Quadratic<'a> {
    matrices: &'a Matrices,
    epsilon: f64,
    /// The vertices of triangles, ascending: the variables.
    pub(super) vertices: Vec<u32>,
    /// The places among them of the system's unknowns; nothing where these are all.
    reached: Option<Vec<u32>>,
    /// The data at the system's unknowns.
    side: RightHandSide,
    /// Where the system does not reach, values are held near these.
    others: Vec<(u32, f64)>,
    analysis: CholeskyAnalysis,
    /// H on the pattern, with unit rows and columns for variables that are fixed.
    values: Vec<f64>,
    factor: Option<CholeskyFactor<f64>>,
    /// Whether the factor is that of H, with nothing added.
    is_alone: bool,
    /// Whether its pattern has more than that of the system.
    is_extended: bool,
    pub(super) is_fixed: Vec<bool>,
    /// c.
    pub(super) load: Vec<f64>,
}

impl<'a> Quadratic<'a> {
    /// `start`: normalised values of the smoothed field on the whole mesh, for vertices that the system does not reach. `square`: AᵀWA and
    /// its analysis, on the system's unknowns.
    pub(super) fn new(
        connectivity: &Connectivity,
        matrices: &'a Matrices,
        epsilon: f64,
        channel: &Channel,
        start: &[f64],
        square: Square,
        watch: &Watch<'_>,
    ) -> Result<Self> {
        let n = connectivity.vertex_count();
        memory::ensure(48 * n as u64)?;
        let vertices: Vec<u32> =
            (0..n as u32).filter(|&v| connectivity.link_kinds()[v as usize] != LinkKind::Isolated).collect();
        let unknowns = matrices.unknowns();
        let has_all = unknowns.len() == vertices.len();
        let mut others = Vec::new();
        let reached = (!has_all).then(|| {
            let mut next = unknowns.iter().peekable();
            let mut reached = Vec::with_capacity(unknowns.len());
            for (place, v) in (0..).zip(&vertices) {
                if next.next_if_eq(&v).is_some() {
                    reached.push(place);
                } else {
                    others.push((place, start[*v as usize]));
                }
            }
            reached
        });
        let Square { mut analysis, mut values, mut factor, is_current } = square;
        let mut is_extended = false;
        if let Some((pattern, all)) = extended(connectivity, &vertices, reached.as_deref(), &analysis, &values)? {
            factor = None;
            is_extended = true;
            values = all;
            analysis = CholeskyAnalysis::new(pattern, watch)?;
        }
        let side = RightHandSide { field: matrices.restrict(&channel.normalized), offset: Vec::new() };
        let is_alone = is_current && factor.is_some();
        let is_fixed = vec![false; vertices.len()];
        let mut quadratic = Self {
            matrices,
            epsilon,
            vertices,
            reached,
            side,
            others,
            analysis,
            values,
            factor,
            is_alone,
            is_extended,
            is_fixed,
            load: Vec::new(),
        };
        let weight = quadratic.outer_weight();
        for k in 0..quadratic.others.len() {
            let place = quadratic.others[k].0 as usize;
            let diagonal = quadratic.place(place, place)?;
            quadratic.values[diagonal] += weight;
            quadratic.is_alone = false;
        }
        quadratic.load = quadratic.minus_gradient(&vec![0.0; quadratic.vertices.len()]);
        Ok(quadratic)
    }

    fn problem(&self) -> Problem<'_> {
        self.matrices.problem(self.epsilon)
    }

    /// What holds values near where the system does not reach: as a data term of weight 1.
    fn outer_weight(&self) -> f64 {
        self.problem().data().map_or(1.0, |data| data.scaled_epsilon())
    }

    /// The system's unknowns of all variables.
    fn inner(&self, x: &[f64]) -> Vec<f64> {
        match &self.reached {
            None => x.to_vec(),
            Some(reached) => reached.iter().map(|&place| x[place as usize]).collect(),
        }
    }

    /// c − Hx, with the matrix in factored form.
    pub(super) fn minus_gradient(&self, x: &[f64]) -> Vec<f64> {
        let inner = match &self.reached {
            None => return self.problem().residual(&self.side, x),
            Some(_) => self.problem().residual(&self.side, &self.inner(x)),
        };
        let mut all = vec![0.0; x.len()];
        for (&place, r) in self.reached.iter().flatten().zip(inner) {
            all[place as usize] = r;
        }
        let weight = self.outer_weight();
        for &(place, value) in &self.others {
            all[place as usize] = weight * (value - x[place as usize]);
        }
        all
    }

    /// ‖Lx‖² + ε‖x − f‖² over what the system reaches, divided by the scale of the system.
    pub(super) fn energy(&self, x: &[f64]) -> f64 {
        self.problem().energy(&self.side, &self.inner(x))
    }

    /// What energies of the functional are these times.
    pub(super) fn scale(&self) -> f64 {
        self.problem().data().map_or(1.0, |data| data.scale())
    }

    /// The mean of the diagonal of H.
    pub(super) fn mean_diagonal(&self) -> f64 {
        let diagonal = self.problem().diagonal();
        diagonal.iter().sum::<f64>() / diagonal.len().max(1) as f64
    }

    /// The place of an entry in the pattern.
    pub(super) fn place(&self, row: usize, column: usize) -> Result<usize, SolveError> {
        let pattern = self.analysis.pattern();
        let place = pattern.lane(column).binary_search(&row).map_err(|_| SolveError::PatternMismatch {})?;
        Ok(pattern.major_offsets()[column] + place)
    }

    /// Sets what belongs to fixed variables to zero.
    pub(super) fn clear_fixed(&self, vector: &mut [f64]) {
        for (value, &is_fixed) in vector.iter_mut().zip(&self.is_fixed) {
            *value = if is_fixed { 0.0 } else { *value };
        }
    }

    /// Fixes variables: their rows and columns become those of the identity.
    pub(super) fn fix(&mut self, is_fixed: Vec<bool>) {
        let pattern = self.analysis.pattern();
        for column in 0..pattern.major_dim() {
            let start = pattern.major_offsets()[column];
            for (place, &row) in pattern.lane(column).iter().enumerate() {
                if is_fixed[row] || is_fixed[column] {
                    self.values[start + place] = f64::from(u8::from(row == column));
                }
            }
        }
        self.is_fixed = is_fixed;
        self.is_alone = false;
    }

    /// Factors H with what is added at some places.
    ///
    /// # Errors
    /// Those of factoring.
    pub(super) fn factor(&mut self, added: &dyn Fn(&mut [f64]), watch: &Watch<'_>) -> Result<(), SolveError> {
        memory::ensure(size_of_val(&*self.values) as u64)?;
        let mut values = self.values.clone();
        added(&mut values);
        self.is_alone = false;
        match &mut self.factor {
            Some(factor) => factor.refactor(&values, watch),
            none => {
                *none = Some(self.analysis.factor(&values, watch)?);
                Ok(())
            }
        }
    }

    /// Factors H alone, unless that is the last factor.
    ///
    /// # Errors
    /// Those of factoring.
    pub(super) fn factor_alone(&mut self, watch: &Watch<'_>) -> Result<(), SolveError> {
        if !self.is_alone {
            self.factor(&|_| {}, watch)?;
            self.is_alone = true;
        }
        Ok(())
    }

    /// The factor, if it is that of the system and of nothing else.
    pub(super) fn into_system_factor(self) -> Option<CholeskyFactor<f64>> {
        let is_system = self.is_alone && !self.is_extended && !self.is_fixed.contains(&true);
        self.factor.filter(|_| is_system)
    }

    /// Solves with the last factor.
    ///
    /// # Errors
    /// Those of solving.
    pub(super) fn solve(&self, b: &[f64], watch: &Watch<'_>) -> Result<Vec<f64>, SolveError> {
        match &self.factor {
            Some(factor) => factor.solve(b, watch),
            None => Err(SolveError::PatternMismatch {}),
        }
    }

    /// How many entries the factor has.
    pub(super) fn factor_nonzeros(&self) -> u64 {
        self.analysis.size().nonzeros
    }
}

/// The pattern with all variables and an entry for every edge, with the values of the square on it; nothing where the square has them all.
fn extended(
    connectivity: &Connectivity,
    vertices: &[u32],
    reached: Option<&[u32]>,
    analysis: &CholeskyAnalysis,
    values: &[f64],
) -> Result<Option<(SparsityPattern, Vec<f64>)>> {
    let pattern = analysis.pattern();
    let mut place_of = vec![u32::MAX; connectivity.vertex_count()];
    for (place, &v) in (0..).zip(vertices) {
        place_of[v as usize] = place;
    }
    let has = |&[a, b]: &[u32; 2]| {
        let [a, b] = [a, b].map(|v| place_of[v as usize] as usize);
        pattern.lane(a).binary_search(&b).is_ok()
    };
    if reached.is_none() && connectivity.edges().iter().all(has) {
        return Ok(None);
    }
    let n = vertices.len();
    memory::ensure(16 * (n + 2 * connectivity.edges().len()) as u64 + 32 * values.len() as u64)?;
    let mut columns: Vec<Vec<(u32, f64)>> = (0..n as u32).map(|place| vec![(place, 0.0)]).collect();
    for &[a, b] in connectivity.edges() {
        let [a, b] = [a, b].map(|v| place_of[v as usize]);
        columns[a as usize].push((b, 0.0));
        columns[b as usize].push((a, 0.0));
    }
    let outer = |inner: usize| reached.map_or(inner as u32, |reached| reached[inner]);
    for j in 0..pattern.major_dim() {
        let start = pattern.major_offsets()[j];
        for (&row, &value) in pattern.lane(j).iter().zip(&values[start..]) {
            columns[outer(j) as usize].push((outer(row), value));
        }
    }
    let (mut offsets, mut rows, mut all) = (vec![0], Vec::new(), Vec::new());
    for mut column in columns {
        column.sort_by_key(|&(row, _)| row);
        for (row, value) in column {
            if rows.len() > offsets[offsets.len() - 1] && rows.last() == Some(&(row as usize)) {
                if let Some(sum) = all.last_mut() {
                    *sum += value;
                }
            } else {
                rows.push(row as usize);
                all.push(value);
            }
        }
        offsets.push(rows.len());
    }
    let pattern = SparsityPattern::try_from_offsets_and_indices(n, n, offsets, rows)
        .map_err(|_| SolveError::PatternMismatch {})?;
    Ok(Some((pattern, all)))
}
