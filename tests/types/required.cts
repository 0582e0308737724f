// The same types from CommonJS.
import morse = require('morse-smooth');
import files = require('morse-smooth/files');
import pictures = require('morse-smooth/snapshot');

const { TriMesh, smooth } = morse;
const { values } = smooth(new TriMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]), [1, 2, 3], { epsilon: 1 });
const ready: Promise<void> = morse.default();
smooth(new TriMesh([], []), values, {});
// @ts-expect-error there is no such rule
smooth(new TriMesh([], []), values, { epsilon: { rule: 'best' } });
const family: morse.SmoothingFamily = new morse.Smoother(new TriMesh([], [])).family(values);

const png: Uint8Array = pictures.snapshot([0, 0, 0], [0, 0, 0], values, { camera: { up: [0, 1, 0] } });
const drawable: Promise<void> = pictures.default();
const isOurs = (error: unknown): error is morse.MorseSmoothError => error instanceof pictures.MorseSmoothError;
// @ts-expect-error there is no such option
pictures.snapshot([], [], [], { colour: true });

const { positions, triangles, fields }: files.MeshFile = files.readMesh(new Uint8Array(3));
const written: Uint8Array = files.writeMesh({ positions, triangles }, { format: 'off' });
const readable: Promise<void> = files.default();
// @ts-expect-error there is no such option
files.readField(new Uint8Array(3), { colunm: 1 });

export = { values, family, ready, png, drawable, isOurs, fields, written, readable };
