/** The options of every function, and of those options that are objects. (A test compares them with what the functions take.) */
const analysis = 'missing onProgress';
const systems = 'weights operator solver precision bounds';
const extrema = 'extrema complete values margin prominence range representatives again preview';
const family = `method metric massScale constraints weights unconstrained epsilonRange tolerance epsilon factorizations channels ${analysis}`;
const tikhonov = `epsilon cutoffWavelength metric massScale unconstrained channels ${analysis}`;

export const options = {
  'new TriMesh': 'weld',
  criticalPoints: `delta deltaIs link rule ${analysis}`,
  deltaHierarchy: `link ${analysis}`,
  levelSets: analysis,
  bands: analysis,
  persistence: analysis,
  persistenceCurve: analysis,
  simplify: `threshold thresholdIs keep ${analysis}`,
  morseComplex: `persistence paths ${analysis}`,
  morseHierarchy: analysis,
  basins: `persistence ${analysis}`,
  constrainedVertices: `channels ${analysis}`,
  smoothness: `weights ${analysis}`,
  laplacian: 'weights',
  mass: 'kind massScale',
  'new Smoother': `${systems} onProgress`,
  tikhonov,
  interpolate: `constraints unconstrained energy channels ${analysis}`,
  leastSquares: `constraints unconstrained epsilon weights channels ${analysis}`,
  lowPass: `iterations lambda mu channels ${analysis}`,
  bilateral: `iterations radius sigmaDistance sigmaValue channels ${analysis}`,
  prescribe: `epsilon cutoffWavelength metric massScale constraints weights unconstrained ${extrema} ${analysis}`,
  family,
  sweep: `epsilons counts channel ${family}`,
  smooth: `method constraints energy ${systems} ${extrema} ${tikhonov}`,
  'family.sweep': 'epsilons counts channel onProgress',
  'family.lives': 'channel onProgress',
  weld: 'tolerance',
  constraints: 'from vertices stars delta deltaIs link threshold thresholdIs clusters seed',
  levels: 'count saddles',
  extrema: 'from minima maxima threshold thresholdIs of',
  epsilon: 'rule noise count',
};
