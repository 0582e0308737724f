//! Parts of a mesh as meshes of their own.

use super::TriMesh;
use crate::error::MeshError;
use crate::support::memory;
use crate::support::watch::Watch;

/// The work with a triangle that is looked at.
const LOOK: u64 = 10;

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
        self.submesh_watched(has, &Watch::none())
    }

    /// The same, watched.
    ///
    /// # Errors
    /// Those of [`TriMesh::submesh`]; `Cancelled`.
    pub(crate) fn submesh_watched(&self, has: &dyn Fn(u32) -> bool, watch: &Watch<'_>) -> Result<Submesh, MeshError> {
        const LEFT_OUT: u32 = u32::MAX;
        let all = self.connectivity().triangles();
        let is_kept = |corners: &[u32; 3]| corners.iter().all(|&v| has(v));
        memory::ensure(4 * self.vertex_count() as u64)?;
        let mut number = vec![LEFT_OUT; self.vertex_count()];
        let mut count = 0;
        watch.tick(LOOK * all.len() as u64)?;
        for corners in all.iter().filter(|corners| is_kept(corners)) {
            count += 1;
            corners.iter().for_each(|&v| number[v as usize] = 0);
        }
        let vertex_count = number.iter().filter(|&&number| number != LEFT_OUT).count();
        memory::ensure(16 * count as u64 + 28 * vertex_count as u64)?;
        let mut vertices = Vec::with_capacity(vertex_count);
        let mut positions = Vec::with_capacity(3 * vertex_count);
        for v in 0..self.vertex_count() as u32 {
            if number[v as usize] != LEFT_OUT {
                number[v as usize] = vertices.len() as u32;
                vertices.push(v);
                positions.extend_from_slice(&self.position(v));
            }
        }
        watch.tick(2 * LOOK * all.len() as u64)?;
        let mut triangles = Vec::with_capacity(count);
        let mut renumbered = Vec::with_capacity(3 * count);
        for (t, corners) in (0_u32..).zip(all).filter(|(_, corners)| is_kept(corners)) {
            triangles.push(t);
            renumbered.extend(corners.map(|v| number[v as usize]));
        }
        drop(number);
        Ok(Submesh { mesh: Self::watched(positions, renumbered, watch)?, vertices, triangles })
    }
}
