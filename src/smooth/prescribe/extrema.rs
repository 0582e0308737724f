//! Which extrema a field shall have.

use crate::error::{FieldError, Result, SmoothError};
use crate::field::{
    CriticalKind, DeltaOptions, PersistenceDiagram, ScalarField, Threshold, VertexOrder, critical_points, persistence,
};
use crate::mesh::{LinkKind, TriMesh};
use crate::support::named::named;
use crate::support::union_find::UnionFind;
use crate::support::watch::Watch;

/// The extrema that a field shall have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extrema<'a> {
    /// These vertices, minima or maxima as they are in the input.
    OfInput(&'a [u32]),
    /// These vertices, whatever they are in the input.
    Named {
        /// The vertices that shall be minima.
        minima: &'a [u32],
        /// The vertices that shall be maxima.
        maxima: &'a [u32],
    },
    /// The extrema of persistence above a threshold, and the lowest and the highest vertex of every component.
    Above {
        /// The threshold; relative ones are those of the range of the input.
        threshold: Threshold,
        /// Whose extrema.
        of: PersistenceOf,
    },
    /// So many of the most persistent ones, an error where there are fewer. The lowest and the highest vertex of every component of the
    /// mesh come first.
    Most {
        /// How many minima.
        minima: usize,
        /// How many maxima.
        maxima: usize,
        /// Whose extrema.
        of: PersistenceOf,
    },
}

impl Default for Extrema<'_> {
    fn default() -> Self {
        Self::Above { threshold: Threshold::Relative(0.05), of: PersistenceOf::default() }
    }
}

/// The field whose persistence chooses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PersistenceOf {
    /// That which is smoothed without prescribed extrema: the choice costs hardly any smoothness. The default.
    #[default]
    Smoothed,
    /// The input, where noise makes vertices persistent that are beside the places meant.
    Input,
}

named! { PersistenceOf { Smoothed = "smoothed", Input = "input" } }

/// The chosen minima and maxima, each ascending.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Chosen {
    pub(super) minima: Vec<u32>,
    pub(super) maxima: Vec<u32>,
}

/// Chooses.
///
/// # Errors
/// `IndexOutOfBounds`, `NotAnExtremum`, `InvalidOption`, `TooFewExtrema`; those of [`Chosen::check`].
pub(super) fn chosen(
    extrema: &Extrema<'_>,
    complete: bool,
    input: &ScalarField<'_>,
    smoothed: &ScalarField<'_>,
    watch: &Watch<'_>,
) -> Result<Chosen> {
    let source = |of: PersistenceOf| if of == PersistenceOf::Smoothed { smoothed } else { input };
    let mut chosen = match *extrema {
        Extrema::OfInput(vertices) => of_input(input, vertices, watch)?,
        Extrema::Named { minima, maxima } => {
            for &index in minima.iter().chain(maxima) {
                let vertices = input.values().len();
                if index as usize >= vertices {
                    return Err(FieldError::IndexOutOfBounds { index, vertices }.into());
                }
            }
            Chosen { minima: minima.to_vec(), maxima: maxima.to_vec() }
        }
        Extrema::Above { threshold, of } => {
            let bound = threshold.absolute(input.range(), "extrema.threshold")?;
            let diagram = persistence(source(of), watch)?;
            let count = diagram.pairs.partition_point(|pair| pair.persistence > bound);
            most_persistent(&diagram, [count; 2], count)
        }
        Extrema::Most { minima, maxima, of } => {
            let diagram = persistence(source(of), watch)?;
            let wanted = [minima, maxima];
            let essential = [&diagram.essential_minima, &diagram.essential_maxima].map(Vec::len);
            // Where fewer are wanted than there are components, the check says which of them is without.
            let mut chosen = most_persistent(
                &diagram,
                [0, 1].map(|kind| wanted[kind].saturating_sub(essential[kind])),
                diagram.pairs.len(),
            );
            for (kind, wanted, found) in
                [("minima", minima, chosen.minima.len()), ("maxima", maxima, chosen.maxima.len())]
            {
                if found < wanted {
                    return Err(SmoothError::TooFewExtrema { kind, wanted, found }.into());
                }
            }
            chosen.minima.truncate(minima.max(if complete { essential[0] } else { 0 }));
            chosen.maxima.truncate(maxima.max(if complete { essential[1] } else { 0 }));
            chosen
        }
    };
    for list in [&mut chosen.minima, &mut chosen.maxima] {
        list.sort_unstable();
        list.dedup();
    }
    if complete {
        chosen.complete(smoothed.mesh(), smoothed.order());
    }
    chosen.check(smoothed.mesh())?;
    Ok(chosen)
}

/// Of the first `pairs` of a diagram so many minima and maxima, after the essential ones.
fn most_persistent(diagram: &PersistenceDiagram, most: [usize; 2], pairs: usize) -> Chosen {
    let mut chosen = Chosen { minima: diagram.essential_minima.clone(), maxima: diagram.essential_maxima.clone() };
    let of_kind = |kind: CriticalKind, most: usize| {
        let pairs = diagram.pairs[..pairs].iter().filter(move |pair| pair.kind == kind);
        pairs.map(|pair| pair.extremum).take(most)
    };
    chosen.minima.extend(of_kind(CriticalKind::Minimum, most[0]));
    chosen.maxima.extend(of_kind(CriticalKind::Maximum, most[1]));
    chosen
}

fn of_input(input: &ScalarField<'_>, vertices: &[u32], watch: &Watch<'_>) -> Result<Chosen> {
    let points = critical_points(input, &DeltaOptions::default(), watch)?.points;
    let mut chosen = Chosen::default();
    for &vertex in vertices {
        let count = input.values().len();
        if vertex as usize >= count {
            return Err(FieldError::IndexOutOfBounds { index: vertex, vertices: count }.into());
        }
        let place = points.binary_search_by_key(&vertex, |point| point.vertex);
        match place.map(|place| points[place].kind) {
            Ok(CriticalKind::Minimum) => chosen.minima.push(vertex),
            Ok(CriticalKind::Maximum) => chosen.maxima.push(vertex),
            _ => return Err(FieldError::NotAnExtremum { vertex }.into()),
        }
    }
    Ok(chosen)
}

/// What a component of the mesh has, and its lowest and highest vertex among those that are not chosen as the opposite.
#[derive(Clone, Copy)]
struct Component {
    least: u32,
    has: [bool; 2],
    ends: [Option<u32>; 2],
}

impl Chosen {
    /// All of them.
    pub(super) fn all(&self) -> Vec<u32> {
        self.minima.iter().chain(&self.maxima).copied().collect()
    }

    fn is_minimum(&self, vertex: u32) -> bool {
        self.minima.binary_search(&vertex).is_ok()
    }

    fn is_maximum(&self, vertex: u32) -> bool {
        self.maxima.binary_search(&vertex).is_ok()
    }

    /// Adds the lowest and the highest vertex of components that have no chosen ones.
    fn complete(&mut self, mesh: &TriMesh, order: VertexOrder<'_>) {
        let components = self.components(mesh, Some(order));
        for component in components {
            let [lowest, highest] = component.ends;
            if let (false, Some(lowest)) = (component.has[0], lowest) {
                self.minima.push(lowest);
            }
            if let (false, Some(highest)) =
                (component.has[1], highest.filter(|v| component.has[0] || Some(*v) != lowest))
            {
                self.maxima.push(highest);
            }
        }
        self.minima.sort_unstable();
        self.maxima.sort_unstable();
    }

    /// The components of the mesh, by their least vertices.
    fn components(&self, mesh: &TriMesh, order: Option<VertexOrder<'_>>) -> Vec<Component> {
        let connectivity = mesh.connectivity();
        let n = connectivity.vertex_count() as u32;
        let mut sets = UnionFind::new((0..n).collect());
        for &[a, b] in connectivity.edges() {
            sets.unite(a, b);
        }
        let mut place = vec![u32::MAX; n as usize];
        let mut components: Vec<Component> = Vec::new();
        for v in (0..n).filter(|&v| connectivity.link_kinds()[v as usize] != LinkKind::Isolated) {
            let name = sets.find(v) as usize;
            if place[name] == u32::MAX {
                place[name] = components.len() as u32;
                components.push(Component { least: v, has: [false; 2], ends: [None; 2] });
            }
            let component = &mut components[place[name] as usize];
            let is = [self.is_minimum(v), self.is_maximum(v)];
            for end in 0..2 {
                component.has[end] |= is[end];
                let Some(order) = order.filter(|_| !is[1 - end]) else { continue };
                let beyond = |known: u32| order.is_below(v, known) == (end == 0);
                if component.ends[end].is_none_or(beyond) {
                    component.ends[end] = Some(v);
                }
            }
        }
        components
    }

    /// Whether some field can have these extrema.
    ///
    /// # Errors
    /// `ConflictingExtremum` for a vertex that is to be both, `AdjacentExtrema` for neighbours that are to be of one kind, `Unconstrained`
    /// for a component without a minimum or without a maximum, `NotAnExtremum` for a vertex of no triangle.
    fn check(&self, mesh: &TriMesh) -> Result<()> {
        let connectivity = mesh.connectivity();
        for &vertex in self.minima.iter().chain(&self.maxima) {
            if connectivity.link_kinds()[vertex as usize] == LinkKind::Isolated {
                return Err(FieldError::NotAnExtremum { vertex }.into());
            }
            if self.is_minimum(vertex) && self.is_maximum(vertex) {
                return Err(SmoothError::ConflictingExtremum { vertex }.into());
            }
        }
        for (list, kind) in [(&self.minima, "minima"), (&self.maxima, "maxima")] {
            for &first in list {
                let neighbours = connectivity.link(first).flatten();
                if let Some(second) = neighbours.filter(|w| list.binary_search(w).is_ok()).min() {
                    return Err(SmoothError::AdjacentExtrema { first, second, kind }.into());
                }
            }
        }
        let lacking = |component: &&(usize, Component)| component.1.has != [true; 2];
        let components: Vec<(usize, Component)> = self.components(mesh, None).into_iter().enumerate().collect();
        match components.iter().find(lacking) {
            Some(&(component, Component { least: vertex, .. })) => {
                Err(FieldError::Unconstrained { component, vertex }.into())
            }
            None => Ok(()),
        }
    }
}
