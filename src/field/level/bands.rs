//! The mesh cut along level sets, band by band.

use super::level_set::{check_levels, room};
use super::saddle_levels::distinct;
use crate::error::{FieldError, OutOfMemory, Result};
use crate::field::arrays::collected;
use crate::field::scalar_field::{OnMesh, Part as MeshPart, ScalarField};
use crate::mesh::{LinkKind, TriMesh};
use crate::support::memory;
use crate::support::pieces::ranges;
use crate::support::watch::{Phase, Watch};

/// A mesh cut along level sets: every triangle lies in one band. Band k holds what is at least `levels[k − 1]` and less than
/// `levels[k]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bands {
    /// The levels, ascending, each once.
    pub levels: Vec<f64>,
    /// x, y, z of every point: first the vertices of the mesh that belong to a triangle, then the points of the level sets.
    pub points: Vec<f64>,
    /// Three points for each triangle, in the orientation of its parent.
    pub triangles: Vec<[u32; 3]>,
    /// The band of every triangle, 0 up to and including the number of levels.
    pub bands: Vec<u32>,
    /// The triangle of the mesh that each triangle is a part of.
    pub parents: Vec<u32>,
    /// For every point the two ends of its edge, smaller id first; twice the same for a vertex.
    pub edges: Vec<[u32; 2]>,
    /// For every point its place along that edge: 0 at the first end, 1 at the second.
    pub parameters: Vec<f64>,
}

impl OnMesh for Bands {
    fn tell_of_whole(&mut self, part: &MeshPart) -> Result<(), OutOfMemory> {
        part.vertices(self.edges.as_flattened_mut());
        part.triangles(&mut self.parents);
        Ok(())
    }
}

/// Cuts the mesh along the level sets {f = level} of the piecewise linear field.
///
/// # Definition
/// As for [`level_sets`](super::level_sets), a vertex is above a level where its value is at least the level. A level cuts an edge with one
/// end above and one below, in a point that all triangles at the edge share; where the level is the value of the upper end, that
/// point is the vertex. The parts of a triangle between neighbouring levels have up to five corners and are cut into triangles.
///
/// # Properties
/// The result is as watertight as the mesh and has its Euler characteristic; orientations are kept, and the areas add up to that of
/// the mesh. Without levels it is the mesh itself. Triangles come by parent, then by band. O(triangles · log levels + result).
///
/// # Units
/// Points in the units of the positions, levels in those of the values.
///
/// # Errors
/// `NonFiniteLevel`; `InvalidOption` for more than 10,000 levels;
/// `OutOfMemory` where the result does not fit.
///
/// # Example
/// ```
/// use morse_smooth::{Watch, field, mesh::shapes};
/// let square = shapes::grid(5, 5)?;
/// let x: Vec<f64> = square.positions().chunks_exact(3).map(|p| p[0]).collect();
/// let bands = field::bands(&field::ScalarField::new(&square, &x)?, &[0.3, 0.6], &Watch::none())?;
/// assert!(bands.bands.iter().all(|&band| band <= 2));
/// # Ok::<(), morse_smooth::Error>(())
/// ```
pub fn bands(field: &ScalarField<'_>, levels: &[f64], watch: &Watch<'_>) -> Result<Bands> {
    let (mesh, values) = (field.mesh(), field.values());
    check_levels(levels)?;
    let mut plan = watch.plan(&[(Phase::Field, 3.0), (Phase::Field, 4.0)]);
    plan.begin(NUMBER * (values.len() + mesh.triangle_count() + 2 * mesh.edge_count()) as u64)?;
    let mut cutter = Cutter::new(mesh, values, distinct(levels)?, watch)?;
    plan.begin(CUT * cutter.result.triangles.capacity() as u64)?;
    for t in 0..mesh.triangle_count() {
        cutter.cut(t, watch)?;
    }
    plan.finish()?;
    Ok(field.on_whole(cutter.result)?)
}

/// The work with one vertex, edge or triangle that is numbered, and with one triangle that is made.
const NUMBER: u64 = 20;
const CUT: u64 = 60;

struct Cutter<'a> {
    mesh: &'a TriMesh,
    values: &'a [f64],
    /// The band of every vertex: the number of levels that it is above.
    ranks: Vec<u32>,
    /// The point of every vertex.
    vertices: Vec<u32>,
    /// The first of the points that lie on each edge; they follow by ascending level.
    edges: Vec<u32>,
    result: Bands,
}

impl<'a> Cutter<'a> {
    /// Numbers the points, and counts before anything large is allocated.
    fn new(mesh: &'a TriMesh, values: &'a [f64], levels: Vec<f64>, watch: &Watch<'_>) -> Result<Self, FieldError> {
        let connectivity = mesh.connectivity();
        watch.tick(NUMBER * values.len() as u64)?;
        let rank = |&value: &f64| levels.partition_point(|&level| level <= value) as u32;
        let ranks = collected(values.len(), values.iter().map(rank))?;
        let result = Bands { levels, ..Bands::default() };
        let mut this = Self { mesh, values, ranks, vertices: Vec::new(), edges: Vec::new(), result };
        let mut points = connectivity.referenced_vertex_count() as u64;
        let mut triangles = 0;
        watch.tick(NUMBER * mesh.triangle_count() as u64)?;
        for corners in connectivity.triangles() {
            let [lowest, _, highest] = this.ascending(corners).map(|v| u64::from(this.ranks[v as usize]));
            triangles += 1 + 2 * (highest - lowest);
        }
        watch.tick(NUMBER * mesh.edge_count() as u64)?;
        for &[a, b] in connectivity.edges() {
            points += u64::from(this.points_on(a, b));
        }
        let bytes = 40 * points + 20 * triangles;
        if points > u64::from(u32::MAX) {
            return Err(FieldError::OutOfMemory { bytes });
        }
        memory::ensure(bytes + 4 * (values.len() + mesh.edge_count()) as u64)?;
        this.result.points = room(3 * points, bytes)?;
        this.result.edges = room(points, bytes)?;
        this.result.parameters = room(points, bytes)?;
        this.result.triangles = room(triangles, bytes)?;
        this.result.bands = room(triangles, bytes)?;
        this.result.parents = room(triangles, bytes)?;
        this.vertices = room(values.len() as u64, bytes)?;
        this.edges = room(mesh.edge_count() as u64, bytes)?;
        for (v, &kind) in connectivity.link_kinds().iter().enumerate() {
            this.vertices.push(this.result.parameters.len() as u32);
            if kind != LinkKind::Isolated {
                this.point([v as u32; 2], 0.0);
            }
        }
        for range in ranges(mesh.edge_count(), NUMBER, watch) {
            for &[a, b] in &connectivity.edges()[range?] {
                this.edges.push(this.result.parameters.len() as u32);
                let first = this.ranks[a as usize].min(this.ranks[b as usize]);
                let (f, g) = (values[a as usize], values[b as usize]);
                for rank in first..first + this.points_on(a, b) {
                    let level = this.result.levels[rank as usize];
                    this.point([a, b], ((level - f) / (g - f)).clamp(0.0, 1.0));
                }
            }
        }
        Ok(this)
    }

    fn point(&mut self, edge: [u32; 2], parameter: f64) {
        let [p, q] = edge.map(|v| self.mesh.position(v));
        self.result.points.extend((0..3).map(|i| p[i] + parameter * (q[i] - p[i])));
        self.result.edges.push(edge);
        self.result.parameters.push(parameter);
    }

    /// Corners by ascending value, so that their bands ascend, too.
    fn ascending(&self, corners: &[u32; 3]) -> [u32; 3] {
        let [mut a, mut b, mut c] = *corners;
        let above = |v: u32, w: u32| self.values[v as usize] > self.values[w as usize];
        if above(a, b) {
            (a, b) = (b, a);
        }
        if above(b, c) {
            (b, c) = (c, b);
        }
        if above(a, b) {
            (a, b) = (b, a);
        }
        [a, b, c]
    }

    /// Whether the highest level that `vertex` is above goes through it.
    fn is_touched(&self, vertex: u32) -> bool {
        let rank = self.ranks[vertex as usize] as usize;
        rank > 0 && self.result.levels[rank - 1] >= self.values[vertex as usize]
    }

    /// Number of points on an edge, without those that are its upper end.
    fn points_on(&self, a: u32, b: u32) -> u32 {
        let (lower, upper) = if self.ranks[a as usize] < self.ranks[b as usize] { (a, b) } else { (b, a) };
        let cuts = self.ranks[upper as usize] - self.ranks[lower as usize];
        cuts - u32::from(cuts > 0 && self.is_touched(upper))
    }

    /// The point in which the level of that rank cuts the edge.
    fn point_on(&self, edge: u32, lower: u32, upper: u32, rank: u32) -> u32 {
        if rank + 1 == self.ranks[upper as usize] && self.is_touched(upper) {
            self.vertices[upper as usize]
        } else {
            self.edges[edge as usize] + rank - self.ranks[lower as usize]
        }
    }

    fn cut(&mut self, t: usize, watch: &Watch<'_>) -> Result<(), FieldError> {
        let connectivity = self.mesh.connectivity();
        let corners = connectivity.triangles()[t];
        let ascending = self.ascending(&corners);
        let [low, middle, high] = ascending;
        let place = |v: u32| if corners[0] == v { 0 } else { 1 + usize::from(corners[1] != v) };
        let turned = (place(low) + 1) % 3 != place(middle);
        // The edge opposite to a corner is the one that starts at the next.
        let edges = ascending.map(|v| connectivity.triangle_edges()[t][(place(v) + 1) % 3]);
        let (first, last) = (self.ranks[low as usize], self.ranks[high as usize]);
        watch.tick(CUT * u64::from(1 + 2 * (last - first)))?;
        for band in first..=last {
            let part = self.part(ascending, edges, band);
            for triangle in part.triangles(turned) {
                self.result.triangles.push(triangle);
                self.result.bands.push(band);
                self.result.parents.push(t as u32);
            }
        }
        Ok(())
    }

    /// The part of a triangle that lies in a band. Corners by ascending value, edges opposite to them: from the lowest corner
    /// upwards, the second edge is on one side, the third and the first are on the other.
    fn part(&self, [low, middle, high]: [u32; 3], edges: [u32; 3], band: u32) -> Part {
        let [bottom, bend, top] = [low, middle, high].map(|v| self.ranks[v as usize]);
        let along = |rank| self.point_on(edges[1], low, high, rank);
        let beside = |rank| {
            if rank < bend {
                self.point_on(edges[2], low, middle, rank)
            } else {
                self.point_on(edges[0], middle, high, rank)
            }
        };
        let mut part = Part::default();
        if band == bottom {
            part.push(self.vertices[low as usize]);
        } else {
            part.push(along(band - 1));
            part.push(beside(band - 1));
        }
        if band == bend {
            part.push(self.vertices[middle as usize]);
        }
        if band == top {
            part.push(self.vertices[high as usize]);
        } else {
            part.push(beside(band));
            part.push(along(band));
        }
        part
    }
}

/// A convex part of a triangle.
#[derive(Default)]
struct Part {
    points: [u32; 5],
    length: usize,
}

impl Part {
    /// Adds a corner, unless it is the one before it or the first one: neighbouring cuts meet in vertices.
    fn push(&mut self, point: u32) {
        let is_there = self.length > 0 && (self.points[0] == point || self.points[self.length - 1] == point);
        if !is_there {
            self.points[self.length] = point;
            self.length += 1;
        }
    }

    /// The triangles that its first corner makes with its sides.
    fn triangles(&self, turned: bool) -> impl Iterator<Item = [u32; 3]> {
        let points = self.points;
        (2..self.length).map(move |k| {
            let (a, b) = if turned { (points[k], points[k - 1]) } else { (points[k - 1], points[k]) };
            [points[0], a, b]
        })
    }
}
