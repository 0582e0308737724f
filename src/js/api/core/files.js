import { toBytes, toOptions } from '../../runtime/convert.js';
import { Handle, disposable } from '../../runtime/handles.js';
import { toFields } from './arguments.js';
import { handleOf, meshOf } from './mesh.js';
import { core } from './module.js';

export function readMesh(bytes, options) {
  const { instance } = core;
  const input = toBytes(bytes);
  const settings = toOptions(options);
  const file = instance.work((glue) => glue.readMesh(input, settings));
  const mesh = meshOf(new Handle('TriMesh', instance, file.mesh));
  const { fields, format, warnings } = file;
  return disposable({ mesh, fields, format, warnings }, () => mesh.free());
}

export function readField(bytes, options) {
  const { instance } = core;
  const input = toBytes(bytes);
  const settings = toOptions(options);
  return instance.work((glue) => glue.readField(input, settings));
}

export function writeMesh(mesh, options) {
  void core.instance;
  const source = handleOf(mesh);
  const settings = toOptions(options);
  if (settings?.fields !== undefined) settings.fields = toFields(settings.fields);
  return source.use((rawMesh, glue) => glue.writeMesh(rawMesh, settings));
}
