//! Where the nodes of a glTF scene are.

use super::super::json::Json;

/// Three rows of four numbers: what a point's coordinates and one are multiplied by.
pub(super) type Transform = [[f64; 4]; 3];

pub(super) const IDENTITY: Transform = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// The transform of a node, by a matrix or by translation, rotation and scale.
pub(super) fn of_node(node: &Json<'_>) -> Transform {
    if let Some(matrix) = numbers::<16>(node, "matrix") {
        // Column by column.
        return [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| matrix[4 * column + row]));
    }
    let translation = numbers::<3>(node, "translation").unwrap_or([0.0; 3]);
    let [x, y, z, w] = numbers::<4>(node, "rotation").unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = numbers::<3>(node, "scale").unwrap_or([1.0; 3]);
    let rotation = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ];
    [0, 1, 2].map(|row| {
        let [a, b, c] = [0, 1, 2].map(|column| rotation[row][column] * scale[column]);
        [a, b, c, translation[row]]
    })
}

fn numbers<const N: usize>(node: &Json<'_>, name: &str) -> Option<[f64; N]> {
    let list = node.list(name);
    let mut values = [0.0; N];
    for (value, entry) in values.iter_mut().zip(list) {
        *value = entry.number()?;
    }
    (list.len() == N).then_some(values)
}

/// First `second`, then `first`.
pub(super) fn product(first: &Transform, second: &Transform) -> Transform {
    [0, 1, 2].map(|row| {
        [0, 1, 2, 3].map(|column| {
            let sum: f64 = (0..3).map(|inner| first[row][inner] * second[inner][column]).sum();
            if column == 3 { sum + first[row][3] } else { sum }
        })
    })
}

pub(super) fn apply(transform: &Transform, point: [f64; 3]) -> [f64; 3] {
    transform.map(|[a, b, c, d]| a * point[0] + b * point[1] + c * point[2] + d)
}

/// Whether it turns surfaces inside out.
pub(super) fn is_mirror(t: &Transform) -> bool {
    let minor = |a: usize, b: usize| t[1][a] * t[2][b] - t[1][b] * t[2][a];
    t[0][0] * minor(1, 2) - t[0][1] * minor(0, 2) + t[0][2] * minor(0, 1) < 0.0
}
