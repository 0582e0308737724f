/** The options of every function, and of those options that are objects. (A test compares them with what the functions take.) */
const draw = 'colormap range levels bands criticalPoints morseComplex missing';
const snapshot = `width height colorBar title camera ${draw}`;

export const options = {
  drawList: draw,
  snapshot,
  sheet: `titles differenceColormap largestDifference ${snapshot}`,
  camera: 'direction up',
  levels: 'count points offsets levels closed',
  criticalPoints: 'vertices kinds',
  morseComplex: 'persistence vertices offsets kinds',
};
