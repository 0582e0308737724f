//! The active vertices: those that the operators act on, and what hangs together by them.

use nalgebra_sparse::CscMatrix;

use super::Operator;
use crate::error::{Cancelled, Result};
use crate::mesh::{LinkKind, TriMesh};
use crate::operators::{MassScale, lumped_mass_diagonal};
use crate::support::memory;
use crate::support::pieces::ranges;
use crate::support::watch::Watch;

/// The component of a vertex that is not active.
const NONE: u32 = u32::MAX;

/// The work with a vertex that is looked at, its share of the areas included, and with one whose neighbours are visited.
const VERTEX: u64 = 40;
const VISIT: u64 = 30;

/// The active vertices, by components of L: the kernel of L has one constant for each.
#[derive(Debug)]
pub(super) struct ActiveVertices {
    /// The active vertices, ascending.
    list: Vec<u32>,
    /// The component of every vertex.
    component: Vec<u32>,
    /// The least vertex of each component.
    first: Vec<u32>,
}

impl ActiveVertices {
    /// # Errors
    /// `Cancelled`, `OutOfMemory`.
    pub(super) fn new(
        mesh: &TriMesh,
        laplacian: &CscMatrix<f64>,
        operator: Operator,
        watch: &Watch<'_>,
    ) -> Result<Self> {
        // The list, the components, and the areas or a stack that has doubled.
        memory::ensure(16 * mesh.vertex_count() as u64)?;
        let areas = lumped_mass_diagonal(mesh, MassScale::Raw)?;
        let kinds = mesh.connectivity().link_kinds();
        let mut list = Vec::with_capacity(kinds.len());
        for range in ranges(kinds.len(), VERTEX, watch) {
            for v in range? {
                // Without area and without a weight in L nothing ties a vertex to the others: its row of the system is zero. The
                // finite-element operator divides by areas.
                let tied = areas[v] > 0.0 || laplacian.col(v).values().iter().any(|&x| x != 0.0);
                let divisible = operator == Operator::Paper || areas[v].recip().is_finite();
                if kinds[v] != LinkKind::Isolated && tied && divisible {
                    list.push(v as u32);
                }
            }
        }
        drop(areas);
        let mut vertices = Self { component: vec![NONE; kinds.len()], list, first: Vec::new() };
        vertices.number(laplacian, watch)?;
        Ok(vertices)
    }

    /// Numbers the components, by their least vertices.
    fn number(&mut self, laplacian: &CscMatrix<f64>, watch: &Watch<'_>) -> Result<(), Cancelled> {
        /// An active vertex without a number yet.
        const OPEN: u32 = NONE - 1;
        for &v in &self.list {
            self.component[v as usize] = OPEN;
        }
        let mut stack = Vec::new();
        for &start in &self.list {
            if self.component[start as usize] != OPEN {
                continue;
            }
            let number = self.first.len() as u32;
            self.first.push(start);
            self.component[start as usize] = number;
            stack.push(start);
            while let Some(v) = stack.pop() {
                let column = laplacian.col(v as usize);
                watch.tick(VISIT + column.nnz() as u64)?;
                for (&row, &value) in column.row_indices().iter().zip(column.values()) {
                    if value != 0.0 && self.component[row] == OPEN {
                        self.component[row] = number;
                        stack.push(row as u32);
                    }
                }
            }
        }
        Ok(())
    }

    /// The active vertices, ascending.
    pub(super) fn list(&self) -> &[u32] {
        &self.list
    }

    /// The component of a vertex; none where it is not active.
    pub(super) fn component(&self, vertex: u32) -> Option<usize> {
        let component = self.component[vertex as usize];
        (component != NONE).then_some(component as usize)
    }

    /// The least vertex of each component.
    pub(super) fn first_vertices(&self) -> &[u32] {
        &self.first
    }
}
