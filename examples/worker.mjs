// node examples/worker.mjs: the API in a worker, so that nothing here waits for it. In a browser the same lines do.
import { readFileSync } from 'node:fs';
import { connect } from 'morse-smooth/worker';

const remote = await connect();
const { positions, triangles, fields } = await remote.readMesh(readFileSync('www/public/examples/torus_irregular.ply'));
const mesh = await remote.createMesh(positions, triangles);
const smoother = await remote.createSmoother(mesh);

// A call that tells its progress and is stopped.
const controller = new AbortController();
const onProgress = ({ phase, fraction }) => {
  if (phase === 'solve' || fraction > 0.5) controller.abort();
};
const call = smoother.tikhonov(fields.noisy, { epsilon: 0.05, onProgress, signal: controller.signal });
console.log(await call.catch(({ name }) => name));

const { before, after } = (await smoother.tikhonov(fields.noisy, { epsilon: 0.05 })).report;
console.log(`minima ${before.minima} → ${after.minima}, maxima ${before.maxima} → ${after.maxima}`);

// A slider: of calls that come faster than their answers, only the last one matters.
const family = await smoother.family(fields.noisy);
async function show(epsilon) {
  const values = await family.values(epsilon, { latest: true });
  console.log(`ε = ${epsilon}: ${values.length} values`);
}
await Promise.allSettled([0.01, 0.02, 0.05, 0.1].map(show));

remote.close();
