// The same types from CommonJS.
import morse = require('morse-smooth');

const { TriMesh, smooth } = morse;
const { values } = smooth(new TriMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]), [1, 2, 3], { epsilon: 1 });
const ready: Promise<void> = morse.default();
// @ts-expect-error ε has no default
smooth(new TriMesh([], []), values, {});

export = { values, ready };
