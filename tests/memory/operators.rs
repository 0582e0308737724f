//! Laplacians and mass matrices.

use morse_smooth::Watch;
use morse_smooth::mesh::TriMesh;
use morse_smooth::operators::{LaplacianWeights, MassKind, MassOptions, MassScale, laplacian, mass};

use crate::check;
use crate::mesh::{Arrays, every_kind};

#[test]
fn operators() {
    for Arrays { name, positions, triangles } in every_kind() {
        let mesh = TriMesh::new(positions, triangles).unwrap();
        for &weights in LaplacianWeights::ALL {
            check(&format!("the Laplacian {} of {name}", weights.name()), 1.3, || {
                laplacian(&mesh, weights, &Watch::none()).map(drop).ok()
            });
        }
        for &kind in MassKind::ALL {
            for &scale in MassScale::ALL {
                check(&format!("the mass matrix {} of {name}", kind.name()), 1.3, || {
                    mass(&mesh, &MassOptions { kind, scale }, &Watch::none()).unwrap()
                });
            }
        }
    }
}
