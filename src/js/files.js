import { toBytes, toFields, toOptions } from './convert.js';
import { attempt } from './error.js';
import { Handle } from './handle.js';
import { core } from './core-instance.js';
import { TriMesh, handleOf } from './mesh.js';

export function readMesh(bytes, options) {
  const module = core();
  const input = toBytes(bytes);
  const settings = toOptions(options);
  const { mesh, fields, format, warnings } = attempt(() => module.readMesh(input, settings));
  return { mesh: new TriMesh(new Handle('TriMesh', mesh)), fields, format, warnings };
}

export function readField(bytes, options) {
  const module = core();
  const input = toBytes(bytes);
  const settings = toOptions(options);
  return attempt(() => module.readField(input, settings));
}

export function writeMesh(mesh, options) {
  const module = core();
  const source = handleOf(mesh);
  const settings = toOptions(options);
  if (settings?.fields !== undefined) settings.fields = toFields(settings.fields);
  return source.use((rawMesh) => module.writeMesh(rawMesh, settings));
}
