// What `benches/solver.mjs` takes.
import { parseArgs } from 'node:util';
import { Problem } from '../../scripts/lib/log.mjs';
import { MESHES, SYSTEMS } from './peers.mjs';

export const USAGE = `node benches/solver.mjs, or npm run bench -- solver, with
  --size 10k,100k    numbers of vertices (default 10k,100k,250k; k and M are understood)
  --mesh torus       of ${MESHES.join(', ')} (default all)
  --system A         of ${SYSTEMS.slice(0, 3).join(', ')} (default all)
  --part speed       of speed, calls, accuracy, memory (default all)
  --rounds 5         measurements that a median is taken of (default 5; 3 above 100k)
  --clock cpu        time of the processor instead of the wall's, for a machine that is busy
  --quick            the torus with 10k vertices in few rounds: whether all of this works`;

const PARTS = ['speed', 'calls', 'accuracy', 'memory'];

export function readOptions(parameters) {
  const text = { type: 'string' };
  const options = { size: text, mesh: text, system: text, part: text, rounds: text, clock: text };
  const flags = { quick: { type: 'boolean' }, help: { type: 'boolean' } };
  let values;
  try {
    ({ values } = parseArgs({ args: parameters, options: { ...options, ...flags } }));
  } catch (error) {
    throw new Problem(`${error.message}\n\n${USAGE}`);
  }
  if (values.help) throw new Problem(USAGE);
  const { quick = false } = values;
  const sizes = values.size?.split(',').map(readSize);
  const rounds = values.rounds ? Number(values.rounds) : quick ? 2 : null;
  if (rounds !== null && !(rounds >= 1)) throw new Problem(`--rounds ${values.rounds}: a count is expected`);
  return {
    sizes: sizes ?? (quick ? [10_000] : [10_000, 100_000, 250_000]),
    meshes: oneOf('mesh', values.mesh, MESHES, quick ? ['torus'] : MESHES),
    systems: oneOf('system', values.system, SYSTEMS.slice(0, 3)),
    parts: oneOf('part', values.part, PARTS),
    rounds: (size) => rounds ?? (size > 100_000 ? 3 : 5),
    clock: oneOf('clock', values.clock, ['wall', 'cpu'], ['wall'])[0],
    // Whole calls and what must hold are about this size, errors about that.
    mainSize: sizes?.[0] ?? (quick ? 10_000 : 100_000),
    accuracySize: quick ? 2_500 : 20_000,
    memorySizes: sizes ?? (quick ? [10_000] : [10_000, 100_000, 250_000, 1_000_000]),
  };
}

export function oneOf(name, given, known, otherwise = known) {
  const chosen = given?.split(',') ?? otherwise;
  const unknown = chosen.find((item) => !known.includes(item));
  if (unknown !== undefined) throw new Problem(`--${name} ${unknown}: one of ${known.join(', ')} is expected`);
  return chosen;
}

export function readSize(text) {
  const [, digits, unit] = /^(\d+(?:\.\d+)?)([kM]?)$/.exec(text) ?? [];
  if (!digits) throw new Problem(`--size ${text}: a number such as 100k is expected`);
  return Math.round(Number(digits) * { '': 1, k: 1e3, M: 1e6 }[unit]);
}
