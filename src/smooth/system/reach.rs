//! Which vertices an operator reaches, and what hangs together by it.

use nalgebra_sparse::CscMatrix;

use crate::error::Result;
use crate::mesh::{LinkKind, TriMesh};
use crate::operators::{MassScale, lumped_mass_diagonal};
use crate::smooth::Operator;

/// The component of a vertex that is not reached.
const NONE: u32 = u32::MAX;

/// The vertices that the operators reach, by components of L: the kernel of L has one constant for each.
#[derive(Debug)]
pub(in crate::smooth) struct Reach {
    /// The vertices reached, ascending.
    active: Vec<u32>,
    /// The component of every vertex.
    component: Vec<u32>,
    /// The least vertex of each component.
    first: Vec<u32>,
}

impl Reach {
    pub(in crate::smooth) fn new(mesh: &TriMesh, laplacian: &CscMatrix<f64>, operator: Operator) -> Result<Self> {
        let areas = lumped_mass_diagonal(mesh, MassScale::Raw)?;
        let kinds = mesh.connectivity().link_kinds();
        let mut active = Vec::with_capacity(kinds.len());
        for (v, column) in laplacian.col_iter().enumerate() {
            // Without area and without a weight in L nothing ties a vertex to the others: its row of the system is zero. The
            // finite-element operator divides by areas.
            let tied = areas[v] > 0.0 || column.values().iter().any(|&x| x != 0.0);
            let divisible = operator == Operator::Paper || areas[v].recip().is_finite();
            if kinds[v] != LinkKind::Isolated && tied && divisible {
                active.push(v as u32);
            }
        }
        let mut reach = Self { component: vec![NONE; kinds.len()], active, first: Vec::new() };
        reach.number(laplacian);
        Ok(reach)
    }

    /// Numbers the components, by their least vertices.
    fn number(&mut self, laplacian: &CscMatrix<f64>) {
        /// A vertex that is reached and not yet numbered.
        const OPEN: u32 = NONE - 1;
        for &v in &self.active {
            self.component[v as usize] = OPEN;
        }
        let mut stack = Vec::new();
        for &start in &self.active {
            if self.component[start as usize] != OPEN {
                continue;
            }
            let number = self.first.len() as u32;
            self.first.push(start);
            self.component[start as usize] = number;
            stack.push(start);
            while let Some(v) = stack.pop() {
                let column = laplacian.col(v as usize);
                for (&row, &value) in column.row_indices().iter().zip(column.values()) {
                    if value != 0.0 && self.component[row] == OPEN {
                        self.component[row] = number;
                        stack.push(row as u32);
                    }
                }
            }
        }
    }

    /// The vertices reached, ascending.
    pub(in crate::smooth) fn active(&self) -> &[u32] {
        &self.active
    }

    /// The component of a vertex; none where it is not reached.
    pub(in crate::smooth) fn component(&self, vertex: u32) -> Option<usize> {
        let component = self.component[vertex as usize];
        (component != NONE).then_some(component as usize)
    }

    /// The least vertex of each component.
    pub(in crate::smooth) fn first_vertices(&self) -> &[u32] {
        &self.first
    }
}
