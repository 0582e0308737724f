// The one table of options of the command line, by the names that they have in the JavaScript API.
import { options as core } from '../api/core/options.js';
import { options as files } from '../api/files/options.js';
import { options as pictures } from '../api/snapshot/options.js';

/** The names of the options of every function, and of those options that are objects, by entry. */
export const api = { core, files, pictures };

/**
 * - `kind`: how a value is read (`values.js`); a `flag` has none, and the flag of a `switch` turns off what is on by default.
 * - `value`: what stands for the value in the help.
 */
const number = (value, help) => ({ kind: 'number', value, help });
const choice = (value, help) => ({ kind: 'choice', value, help });
const text = (value, help) => ({ kind: 'text', value, help });
const flag = (help) => ({ kind: 'flag', help });

/** What people may give for an option of the API, for those that a command line has. */
const TABLE = {
  // Files.
  column: text('NAME', 'the column of the file of values: its name, or its number from 0'),
  format: text('NAME', 'the format of the mesh; default: told from content and name'),
  weld: flag('vertices at the same place become one'),
  tolerance: number('X', 'welds also what is nearer than this part of the bounding box’s diagonal'),
  triangleFields: choice('NAME', 'average: fields on triangles become fields on vertices'),
  binary: flag('writes a binary file where the format has that'),

  // Analyses, and what constraints take of them.
  missing: choice('NAME', 'values that are missing (NaN): error (default), omit'),
  keep: { kind: 'vertices', value: 'IDS', help: 'the extrema to keep, instead of a threshold' },
  levels: { kind: 'numbers', value: 'X,Y,…', help: 'the level sets at these values' },
  saddles: flag('two level sets for each saddle, just below and just above'),
  offset: number('X', 'their distance from the saddle, relative to the range; default: the nearest'),

  // Smoothing.
  method: choice(
    'NAME',
    'tikhonov (default), leastSquares (default with constraints), interpolate, lowPass, bilateral',
  ),
  epsilon: {
    kind: 'epsilon',
    value: 'X|RULE',
    help: 'closeness to the field, or what chooses it: auto (default), gcv, lCurve, discrepancy, atMostCriticalPoints',
  },
  noise: number('X', 'the standard deviation of the noise, for --epsilon discrepancy'),
  count: number('N', 'so many level sets, equally far apart'),
  cutoffWavelength: number('X', 'instead of ε, with --operator fem: waves of this length lose half their height'),
  metric: choice('NAME', 'how closeness is measured: mass (default), lumped, identity'),
  massScale: choice('NAME', 'meanOne (default), raw'),
  weights: choice('NAME', 'cotangent (default), intrinsicDelaunay, meanValue, normalizedCotangent, uniform'),
  operator: choice('NAME', 'paper (default), fem'),
  solver: choice('NAME', 'auto (default), cholesky, cg'),
  precision: choice('NAME', 'of factors: double (default), single'),
  bounds: flag('also says how far the result moves when the values do'),
  constraints: {
    kind: 'verticesOrRule',
    value: 'IDS|RULE',
    help: 'vertices, or what finds them: criticalPoints, persistence (with --threshold), kMeans (with --clusters)',
  },
  delta: number('X', 'differences up to this do not count; default 0'),
  deltaIs: choice('NAME', 'relative (default): to the greatest difference along an edge; absolute'),
  link: choice('NAME', 'saddles where δ > 0: consecutive (default), skip'),
  rule: choice('NAME', 'extrema where δ > 0: strict (default), literal'),
  threshold: number('X', 'the least persistence'),
  thresholdIs: choice('NAME', 'relative (default): to the range of the field; absolute'),
  stars: { kind: 'switch', help: 'constrains the vertices that the rule finds without those next to them' },
  clusters: number('N', 'the number of clusters of values, for --constraints kMeans'),
  seed: number('N', 'the seed of their random numbers; default 0'),
  unconstrained: choice('NAME', 'parts of the mesh without a constraint: error (default), keep, mean'),
  energy: choice('NAME', 'of interpolation: harmonic (default), biharmonic'),
  iterations: number('N', 'how often the filter is applied'),
  lambda: number('X', 'the step of the low-pass filter; default 0.5'),
  mu: number('X', 'its second step, from −1 to 0; default 0'),
  radius: number('X', 'neighbours of the bilateral filter are within this, in units of the mesh'),
  sigmaDistance: number('X', 'its standard deviation of distances'),
  sigmaValue: number('X', 'its standard deviation of differences'),

  // Prescribed extrema.
  extrema: {
    kind: 'verticesOrRule',
    value: 'IDS|RULE',
    help: 'persistence (default): by --threshold, or so many --minima and --maxima; named: --minima and --maxima are vertices; or extrema of the field by vertex',
  },
  minima: { kind: 'vertices', value: 'N|IDS', help: 'how many minima, or which vertices' },
  maxima: { kind: 'vertices', value: 'N|IDS', help: 'how many maxima, or which vertices' },
  of: choice('NAME', 'whose persistence it is: smoothed (default), input'),
  complete: flag('adds the lowest and highest vertex to parts of the mesh without a chosen one'),
  margin: number('X', 'the least rise along a step, relative to the range; default 1e-6'),
  prominence: number('X', 'the least persistence in the result, relative to the range'),
  representatives: number('N', '1 (default) or 3: from how many smoothed fields the steps are taken'),
  again: flag('takes steps once more, from the result'),
  preview: flag('the smoothed field, flooded: quick, but flat'),

  // Pictures.
  width: number('N', 'in pixels; default 1200'),
  height: number('N', 'in pixels; default 900'),
  colormap: choice('NAME', 'viridis (default), cividis, magma, inferno, plasma, coolWarm, blueRed, purpleGreen'),
  range: {
    kind: 'numbers',
    value: 'X,Y',
    help: 'the values with the first and the last color; default: least and greatest',
  },
  bands: flag('one color between two level sets'),
  criticalPoints: { kind: 'switch', help: 'leaves out the critical points' },
  morseComplex: flag('draws the Morse complex'),
  persistence: number('X', 'draws it without pairs up to this, relative to the range'),
  colorBar: { kind: 'switch', help: 'leaves out the color bar' },
  title: text('TEXT', 'what stands above the picture'),
  direction: { kind: 'numbers', value: 'X,Y,Z', help: 'from the middle of the mesh towards the camera' },
  up: { kind: 'numbers', value: 'X,Y,Z', help: 'what points upwards in the picture' },
  titles: { kind: 'texts', value: 'A,B,C', help: 'what stands above the three pictures' },
  differenceColormap: choice('NAME', 'of the difference; default coolWarm'),
  largestDifference: number('X', 'the difference with the last color'),
};

/** What a command line has other ways for, or none: the reasons stand beside. */
const ELSEWHERE = {
  onProgress: 'a terminal shows it',
  channels: 'a file holds fields of one number each',
  fileName: 'the name of the file itself',
  fields: '--field',
  values: '--keep-values',
  vertices: '--constraints, or what is known of the mesh',
  triangles: 'what is known of the mesh',
  from: '--constraints and --extrema',
  camera: '--direction and --up',
  points: 'drawn as it was found before',
  offsets: 'drawn as it was found before',
  closed: 'drawn as it was found before',
  kinds: 'drawn as it was found before',
};

/** The options of the API that a command takes: the names are those of `src/js/api/`, one text for each function. */
export function take(...names) {
  const wanted = names.join(' ').split(' ');
  return Object.fromEntries(Object.entries(TABLE).filter(([name]) => wanted.includes(name)));
}

/** Whether an option of the API is one here, too, and whether there is at least a reason why not. */
export const isOption = (name) => Object.hasOwn(TABLE, name);
export const isKnown = (name) => isOption(name) || Object.hasOwn(ELSEWHERE, name);

/** Options that the API has no name for. */
export const own = {
  common: {
    quiet: { ...flag('prints neither progress nor warnings'), short: 'q' },
    help: { ...flag('prints this'), short: 'h' },
  },
  field: {
    field: text('NAME', 'the field, where the mesh has several'),
    values: text('FILE', 'the field from another file: numbers, or a column of a table'),
  },
  result: {
    output: { ...text('FILE', 'where the mesh with the new field goes; - is the standard output'), short: 'o' },
    to: text('FORMAT', 'what is written; default: by the ending of the file. csv and txt have values alone'),
    name: text('NAME', 'the name of the new field'),
  },
  report: {
    output: { ...text('FILE', 'where the report goes; default: the standard output'), short: 'o' },
    to: text('FORMAT', 'text (default), csv, json'),
  },
  json: { json: flag('the report as JSON') },
};

/** The name of an option on the command line, and back. */
export const kebab = (name) => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);
export const camel = (name) => name.replace(/-([a-z])/g, (_, letter) => letter.toUpperCase());
/** An option as people write it. */
export const written = (name, { kind }) => (kind === 'switch' ? `--no-${kebab(name)}` : `--${kebab(name)}`);
