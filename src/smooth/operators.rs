//! The operators of a smoother: made once, then never changed.

use nalgebra_sparse::CscMatrix;

use super::active::ActiveVertices;
use super::{Operator, SmootherOptions};
use crate::error::{OptionError, Result};
use crate::mesh::TriMesh;
use crate::operators::{self, LaplacianWeights};
use crate::support::watch::Watch;

/// A mesh with its Laplacian and the vertices that this acts on.
#[derive(Debug)]
pub(super) struct Operators {
    pub(super) mesh: TriMesh,
    pub(super) options: SmootherOptions,
    pub(super) laplacian: CscMatrix<f64>,
    pub(super) active: ActiveVertices,
}

impl Operators {
    /// Assembles the Laplacian. The mesh is shared, not copied.
    ///
    /// # Errors
    /// `ZeroWeightSum`; `InapplicableOption` for the finite-element operator with weights other than cotangent; `Cancelled`.
    pub(super) fn new(mesh: &TriMesh, options: SmootherOptions, watch: &Watch<'_>) -> Result<Self> {
        if options.operator == Operator::Fem && options.weights != LaplacianWeights::Cotangent {
            let reason = "the finite-element operator has cotangent weights".to_owned();
            return Err(OptionError::InapplicableOption { option: "weights".to_owned(), reason }.into());
        }
        let laplacian = operators::laplacian(mesh, options.weights, watch)?;
        let active = ActiveVertices::new(mesh, &laplacian, options.operator, watch)?;
        Ok(Self { mesh: mesh.clone(), options, laplacian, active })
    }

    /// Whether L is symmetric.
    pub(super) fn is_symmetric(&self) -> bool {
        self.options.weights.is_symmetric()
    }
}
