//! What readers of tables find.

/// A column as it stands in a file.
pub(super) struct Raw {
    pub(super) name: String,
    pub(super) values: Vec<f64>,
    /// The first cell that is no number, with its row from 1.
    pub(super) bad: Option<(u64, String)>,
    /// Whether it holds numbers, or else text or nothing.
    pub(super) is_numeric: bool,
}
