//! Fields on triangles as fields on vertices.

use super::names::Names;
use super::scan::{filled, push, reserve};
use crate::error::{Diagnostic, ParseError};

/// Adds to `fields` the mean of every field on triangles, weighted by the areas of the triangles around a vertex. Missing values do not
/// count; a vertex without triangles has none. Returns the warning that says so.
///
/// # Errors
/// [`ParseError::OutOfMemory`].
pub fn average_on_vertices(
    positions: &[f64],
    triangles: &[u32],
    triangle_fields: &[(String, Vec<f64>)],
    fields: &mut Vec<(String, Vec<f64>)>,
) -> Result<Diagnostic, ParseError> {
    let count = positions.len() / 3;
    let mut areas = Vec::new();
    reserve(&mut areas, triangles.len() / 3)?;
    areas.extend(triangles.chunks_exact(3).map(|corners| area(positions, corners)));
    // Triangles without area weigh alike where there are no others.
    let is_flat = areas.iter().all(|&area| area == 0.0);
    let mut names = Names::default();
    for (name, _) in fields.iter() {
        names.unique(name);
    }
    let mut added = String::new();
    for (name, values) in triangle_fields {
        let mut sums = filled(0.0, count)?;
        let mut weights = filled(0.0, count)?;
        for ((corners, &value), &area) in triangles.chunks_exact(3).zip(values).zip(&areas) {
            if value.is_nan() {
                continue;
            }
            let weight = if is_flat { 1.0 } else { area };
            for &corner in corners {
                sums[corner as usize] += weight * value;
                weights[corner as usize] += weight;
            }
        }
        for (sum, weight) in sums.iter_mut().zip(weights) {
            *sum = if weight > 0.0 { *sum / weight } else { f64::NAN };
        }
        let unique = names.unique(name);
        if added.len() < 200 {
            added.push_str(if added.is_empty() { "`" } else { ", `" });
            added.push_str(&unique);
            added.push('`');
        }
        push(fields, (unique, sums))?;
    }
    let message = format!("fields on triangles became means on vertices, weighted by area: {added}");
    Ok(Diagnostic { code: "AveragedField", message, count: triangle_fields.len(), examples: Vec::new() })
}

/// Twice the area of a triangle.
fn area(positions: &[f64], corners: &[u32]) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|place| {
        let start = 3 * corners[place] as usize;
        [positions[start], positions[start + 1], positions[start + 2]]
    });
    let (u, v) = ([0, 1, 2].map(|axis| b[axis] - a[axis]), [0, 1, 2].map(|axis| c[axis] - a[axis]));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let doubled = (cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]).sqrt();
    if doubled.is_finite() { doubled } else { 0.0 }
}
