//! Parts of a mesh as meshes of their own.

use super::TriMesh;
use crate::error::MeshError;

/// A part of a mesh, and what its vertices and triangles are in the whole.
#[derive(Debug, Clone)]
pub struct Submesh {
    /// The part.
    pub mesh: TriMesh,
    /// For every vertex of the part its id in the whole; ascending.
    pub vertices: Vec<u32>,
    /// For every triangle of the part its id in the whole; ascending.
    pub triangles: Vec<u32>,
}

impl TriMesh {
    /// The triangles whose three vertices `has` all takes, with the vertices of these triangles.
    ///
    /// # Errors
    /// `EmptyMesh` where no triangle is left; `OutOfMemory`.
    pub fn submesh(&self, has: &dyn Fn(u32) -> bool) -> Result<Submesh, MeshError> {
        const LEFT_OUT: u32 = u32::MAX;
        let all = self.connectivity().triangles();
        let mut triangles = Vec::new();
        let mut number = vec![LEFT_OUT; self.vertex_count()];
        for (t, corners) in (0_u32..).zip(all) {
            if corners.iter().all(|&v| has(v)) {
                triangles.push(t);
                corners.iter().for_each(|&v| number[v as usize] = 0);
            }
        }
        let mut vertices = Vec::new();
        let mut positions = Vec::new();
        for v in 0..self.vertex_count() as u32 {
            if number[v as usize] != LEFT_OUT {
                number[v as usize] = vertices.len() as u32;
                vertices.push(v);
                positions.extend_from_slice(&self.position(v));
            }
        }
        let corners = triangles.iter().flat_map(|&t| all[t as usize]).map(|v| number[v as usize]).collect();
        Ok(Submesh { mesh: Self::new(positions, corners)?, vertices, triangles })
    }
}
