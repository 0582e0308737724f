//! The methods of smoothing with their options, as one choice.

use std::sync::Arc;

use super::channels::Channels;
use super::input::Input;
use super::methods::{
    BilateralOptions, Functional, InterpolateOptions, LeastSquaresOptions, LowPassOptions, Regularization,
    TikhonovOptions, bilateral, interpolate, least_squares, low_pass, tikhonov,
};
use super::missing::{Gaps, Part, missing_vertices, to_whole};
use super::names::MethodName;
use super::operators::Operators;
use super::prescribe::{self, Extrema, PrescribeOptions};
use super::report::Smoothed;
use super::schedule::Stages;
use super::systems::Systems;
use super::{Constraints, SmootherOptions};
use crate::error::{MeshError, OptionError, Result};
use crate::field::{Features, Missing};
use crate::mesh::TriMesh;
use crate::support::memory;
use crate::support::watch::{Phase, Watch};

/// A method of smoothing with its options, for [`Smoother::apply`](super::Smoother::apply).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method<'a> {
    /// [`Smoother::tikhonov`](super::Smoother::tikhonov).
    Tikhonov(TikhonovOptions),
    /// [`Smoother::interpolate`](super::Smoother::interpolate).
    Interpolate(InterpolateOptions<'a>),
    /// [`Smoother::least_squares`](super::Smoother::least_squares).
    LeastSquares(LeastSquaresOptions<'a>),
    /// [`Smoother::low_pass`](super::Smoother::low_pass).
    LowPass(LowPassOptions),
    /// [`Smoother::bilateral`](super::Smoother::bilateral).
    Bilateral(BilateralOptions),
    /// [`Smoother::prescribe`](super::Smoother::prescribe).
    Prescribe(PrescribeOptions<'a>),
}

impl<'a> From<Functional<'a>> for Method<'a> {
    /// The method that minimises a functional, and nothing else.
    fn from(functional: Functional<'a>) -> Self {
        match functional {
            Functional::Tikhonov(options) => Self::Tikhonov(options),
            Functional::LeastSquares(options) => Self::LeastSquares(options),
        }
    }
}

impl<'a> Method<'a> {
    /// The method's name.
    #[must_use]
    pub fn name(&self) -> MethodName {
        match self {
            Self::Tikhonov(_) => MethodName::Tikhonov,
            Self::Interpolate(_) => MethodName::Interpolate,
            Self::LeastSquares(_) => MethodName::LeastSquares,
            Self::LowPass(_) => MethodName::LowPass,
            Self::Bilateral(_) => MethodName::Bilateral,
            Self::Prescribe(_) => MethodName::Prescribe,
        }
    }

    /// Values per vertex.
    #[must_use]
    pub fn channels(&self) -> usize {
        match self {
            Self::Tikhonov(options) => options.channels,
            Self::Interpolate(options) => options.channels,
            Self::LeastSquares(options) => options.channels,
            Self::LowPass(options) => options.channels,
            Self::Bilateral(options) => options.channels,
            Self::Prescribe(options) => options.functional.channels(),
        }
    }

    /// What NaN means.
    #[must_use]
    pub fn missing(&self) -> Missing {
        match self {
            Self::Tikhonov(options) => options.missing,
            Self::Interpolate(options) => options.missing,
            Self::LeastSquares(options) => options.missing,
            Self::LowPass(options) => options.missing,
            Self::Bilateral(options) => options.missing,
            Self::Prescribe(options) => options.functional.missing(),
        }
    }

    /// What it minimises, if that has an ε.
    #[must_use]
    pub fn functional(&self) -> Option<Functional<'a>> {
        match self {
            Self::Tikhonov(options) => Some(Functional::Tikhonov(*options)),
            Self::LeastSquares(options) => Some(Functional::LeastSquares(*options)),
            Self::Prescribe(options) => Some(options.functional),
            Self::Interpolate(_) | Self::LowPass(_) | Self::Bilateral(_) => None,
        }
    }

    /// The same with another ε, where it has one.
    pub(super) fn with_epsilon(self, epsilon: f64) -> Self {
        match self {
            Self::Tikhonov(options) => Self::Tikhonov(TikhonovOptions { epsilon, ..options }),
            Self::LeastSquares(options) => Self::LeastSquares(LeastSquaresOptions { epsilon, ..options }),
            Self::Prescribe(options) => {
                Self::Prescribe(PrescribeOptions { functional: options.functional.with_epsilon(epsilon), ..options })
            }
            other => other,
        }
    }

    fn constraints(&self) -> Option<&Constraints<'a>> {
        match self {
            Self::Interpolate(options) => Some(&options.constraints),
            Self::LeastSquares(options) => Some(&options.constraints),
            Self::Prescribe(PrescribeOptions { functional: Functional::LeastSquares(options), .. }) => {
                Some(&options.constraints)
            }
            _ => None,
        }
    }

    /// The vertices that are named as extrema: of the input, or minima; and maxima.
    fn extrema(&self) -> [&'a [u32]; 2] {
        match self {
            Self::Prescribe(PrescribeOptions { extrema: Extrema::OfInput(vertices), .. }) => [vertices, &[]],
            Self::Prescribe(PrescribeOptions { extrema: Extrema::Named { minima, maxima }, .. }) => [minima, maxima],
            _ => [&[], &[]],
        }
    }

    /// The same with other vertices in their place.
    fn with_extrema<'b>(self, minima: &'b [u32], maxima: &'b [u32]) -> Method<'b>
    where
        'a: 'b,
    {
        let Self::Prescribe(options) = self else { return self };
        let extrema = match options.extrema {
            Extrema::OfInput(_) => Extrema::OfInput(minima),
            Extrema::Named { .. } => Extrema::Named { minima, maxima },
            rule => rule,
        };
        Method::Prescribe(PrescribeOptions { extrema, ..options })
    }

    /// The same with other constraints.
    fn with_features<'b>(self, features: Features<'b>) -> Method<'b>
    where
        'a: 'b,
    {
        match self {
            Self::Interpolate(options) => {
                let constraints = Constraints { features, ..options.constraints };
                Method::Interpolate(InterpolateOptions { constraints, ..options })
            }
            Self::LeastSquares(options) => {
                let constraints = Constraints { features, ..options.constraints };
                Method::LeastSquares(LeastSquaresOptions { constraints, ..options })
            }
            Self::Prescribe(PrescribeOptions { functional: Functional::LeastSquares(of), .. }) => {
                let constraints = Constraints { features, ..of.constraints };
                let functional = Functional::LeastSquares(LeastSquaresOptions { constraints, ..of });
                match self {
                    Self::Prescribe(options) => Method::Prescribe(PrescribeOptions { functional, ..options }),
                    other => other,
                }
            }
            other => other,
        }
    }

    /// Checks what can be told from the options alone.
    ///
    /// # Errors
    /// `InvalidOption`, `InapplicableOption`.
    pub(super) fn check(&self, smoother: SmootherOptions) -> Result<(), OptionError> {
        match self {
            Self::Tikhonov(options) => tikhonov::check(options, smoother)?,
            Self::Interpolate(_) => {}
            Self::LeastSquares(options) => tikhonov::check_epsilon(options.epsilon)?,
            Self::LowPass(options) => low_pass::check(options)?,
            Self::Bilateral(options) => bilateral::check(options)?,
            Self::Prescribe(options) => {
                options.functional.check(smoother)?;
                options.check()?;
            }
        }
        if self.missing() == Missing::Fill && matches!(self, Self::LowPass(_) | Self::Bilateral(_)) {
            let reason = "filters cannot fill in missing values".to_owned();
            return Err(OptionError::InapplicableOption { option: "missing".to_owned(), reason });
        }
        Ok(())
    }

    /// What is solved, whatever ε is, by the methods that have one.
    ///
    /// # Errors
    /// Those of the method.
    pub(super) fn regularization(&self, input: &Input<'_>, stages: &mut Stages<'_, '_>) -> Result<Regularization> {
        match self {
            Self::Tikhonov(options) => tikhonov::regularization(input, options),
            Self::LeastSquares(options) => least_squares::regularization(input, options, stages),
            _ => Err(OptionError::invalid("method", "`tikhonov` or `leastSquares`").into()),
        }
    }

    fn start(&self, input: &Input<'_>, systems: &mut Systems, watch: &Watch<'_>) -> Result<Smoothed> {
        match self {
            Self::Tikhonov(options) => tikhonov::start(input, systems, options, watch),
            Self::Interpolate(options) => interpolate::start(input, systems, options, watch),
            Self::LeastSquares(options) => least_squares::start(input, systems, options, watch),
            Self::LowPass(options) => low_pass::start(input, options, watch),
            Self::Bilateral(options) => bilateral::start(input, options, watch),
            Self::Prescribe(options) => prescribe::start(input, systems, options, watch),
        }
    }
}

/// The part of the mesh with values that the last call had, and its systems.
#[derive(Debug, Default)]
pub(super) struct Masked(Option<Mask>);

#[derive(Debug)]
struct Mask {
    missing: Arc<[u32]>,
    /// Nothing where no triangle has three values.
    part: Option<Arc<Part>>,
    systems: Systems,
}

impl Masked {
    /// The systems of a part, if it is the one of the last call.
    pub(super) fn of_part(&mut self, part: &Arc<Part>) -> Option<&mut Systems> {
        let mask = self.0.as_mut()?;
        mask.part.as_ref().is_some_and(|known| Arc::ptr_eq(known, part)).then_some(&mut mask.systems)
    }

    /// That of these missing vertices.
    fn get(
        &mut self,
        mesh: &TriMesh,
        missing: &[u32],
        options: SmootherOptions,
        watch: &Watch<'_>,
    ) -> Result<&mut Mask> {
        if self.0.as_ref().is_some_and(|mask| *mask.missing != *missing) {
            self.0 = None;
        }
        match &mut self.0 {
            Some(mask) => Ok(mask),
            none => {
                let part = Part::without(mesh, missing, options, watch)?.map(Arc::new);
                Ok(none.insert(Mask { missing: missing.into(), part, systems: Systems::default() }))
            }
        }
    }
}

/// Smooths by a method.
pub(super) fn apply(
    operators: &Arc<Operators>,
    systems: &mut Systems,
    masked: &mut Masked,
    values: &[f64],
    method: &Method<'_>,
    watch: &Watch<'_>,
) -> Result<Smoothed> {
    let mut smoothed = None;
    let start = &mut |input: &Input<'_>, systems: &mut Systems, method: &Method<'_>| {
        smoothed = Some(method.start(input, systems, watch)?);
        Ok(())
    };
    let part = on_input(operators, systems, masked, values, method, watch, start)?;
    let Some(smoothed) = smoothed else { return Err(MeshError::EmptyMesh { vertices: 0, triangles: 0 }.into()) };
    Ok(match part {
        None => smoothed,
        Some(part) => {
            let mut whole = values.to_vec();
            part.known.scatter(&smoothed.values, method.channels(), &mut whole);
            let mut reports = smoothed.reports;
            for prescribed in reports.iter_mut().filter_map(|report| report.prescribed.as_mut()) {
                for list in [&mut prescribed.minima, &mut prescribed.maxima, &mut prescribed.unavoidable] {
                    list.iter_mut().for_each(|v| *v = part.known.vertices[*v as usize]);
                }
            }
            Smoothed { values: whole, reports }
        }
    })
}

/// Does something with the field that a method smooths, and with its systems: with what is missing left out or to be filled in, as the
/// method's options say. Where it is left out, the method's constraints are vertices of the part that is returned.
pub(super) fn on_input(
    operators: &Arc<Operators>,
    systems: &mut Systems,
    masked: &mut Masked,
    values: &[f64],
    method: &Method<'_>,
    watch: &Watch<'_>,
    work: &mut dyn FnMut(&Input<'_>, &mut Systems, &Method<'_>) -> Result<()>,
) -> Result<Option<Arc<Part>>> {
    method.check(operators.options)?;
    watch.prepare(Phase::Analysis);
    let (mesh, channels) = (&operators.mesh, method.channels());
    // The values of the result, and those of the part that has values; lists and marks of vertices.
    memory::ensure((16 * channels.min(values.len()) + 16) as u64 * mesh.vertex_count() as u64)?;
    let missing = match method.missing() {
        Missing::Error => Vec::new(),
        Missing::Omit | Missing::Fill => missing_vertices(mesh, values, channels)?,
    };
    if missing.is_empty() {
        let input = Input { operators, channels: Channels::new(mesh, values, channels, Arc::default())?, gaps: None };
        work(&input, systems, method)?;
        return Ok(None);
    }
    let mask = masked.get(mesh, &missing, operators.options, watch)?;
    if method.missing() == Missing::Fill {
        let gaps = Gaps { missing: Arc::clone(&mask.missing), part: mask.part.as_ref() };
        let channels = Channels::new(mesh, values, channels, Arc::clone(&gaps.missing))?;
        work(&Input { operators, channels, gaps: Some(gaps) }, systems, method)?;
        return Ok(None);
    }
    let Some(part) = &mask.part else { return Err(MeshError::EmptyMesh { vertices: 0, triangles: 0 }.into()) };
    let Part { known, operators } = &**part;
    let listed = match method.constraints() {
        Some(Constraints { features: Features::Vertices(vertices), .. }) => {
            Some(known.find(vertices, mesh.vertex_count())?)
        }
        _ => None,
    };
    let method = listed.as_ref().map_or(*method, |vertices| method.with_features(Features::Vertices(vertices)));
    let [minima, maxima] = method.extrema().map(|listed| known.find(listed, mesh.vertex_count()));
    let (minima, maxima) = (minima?, maxima?);
    let method = method.with_extrema(&minima, &maxima);
    let of_part = known.gather(values, channels);
    let channels_of_part = Channels::new(&known.mesh, &of_part, channels, Arc::default())?;
    let input = Input { operators, channels: channels_of_part, gaps: None };
    work(&input, &mut mask.systems, &method).map_err(|error| to_whole(&known.vertices, error))?;
    Ok(Some(Arc::clone(part)))
}
