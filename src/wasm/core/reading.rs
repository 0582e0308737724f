//! What every analysis of a field has in common: the values, those that are missing, and who watches.

use js_sys::Float64Array;

use super::watching::Watching;
use crate::error::Result;
use crate::field::{Missing, ScalarField};
use crate::mesh::TriMesh;
use crate::support::watch::Watch;
use crate::wasm::shared::arrays::floats;
use crate::wasm::shared::record::Record;

/// The options that all analyses take.
pub(super) struct Reading {
    missing: Missing,
    watching: Watching,
}

impl Reading {
    pub(super) fn read(record: &Record) -> Self {
        Self { missing: record.choice("missing").unwrap_or_default(), watching: Watching::read(record) }
    }

    /// Reads the field of these values by `work`.
    pub(super) fn of<T>(
        &self,
        mesh: &TriMesh,
        values: &Float64Array,
        work: impl FnOnce(&ScalarField<'_>, &Watch<'_>) -> Result<T>,
    ) -> Result<T> {
        let values = floats(values)?;
        self.watching.run(|watch| {
            let field = ScalarField::watched(mesh, &values, self.missing, watch)?;
            work(&field, watch)
        })
    }
}
