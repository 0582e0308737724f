// What users of workers do: everything that use.js, read.js and draw.js do in some way, a call that is stopped, and the next one.
export async function remote({ MorseSmoothError, connect }) {
  const there = await connect();
  const side = 60;
  const positions = [];
  const triangles = [];
  for (let k = 0; k < side * side; k++) positions.push(k % side, Math.floor(k / side), 0);
  for (let k = 0; k < side * (side - 1); k++) {
    if (k % side < side - 1) triangles.push(k, k + 1, k + side + 1, k, k + side + 1, k + side);
  }
  const values = Float64Array.from({ length: side * side }, (_, k) => ((k * 7919) % 1009) / 1009);
  const mesh = await there.createMesh(positions, triangles);
  const smoother = await there.createSmoother(mesh);
  const controller = new AbortController();
  const call = smoother.prescribe(values, {
    epsilon: 1e-3,
    signal: controller.signal,
    onProgress: () => controller.abort(),
  });
  const stopped = await call.catch(({ name }) => name);
  const { report } = await smoother.tikhonov(values, { epsilon: 0.1 });
  let code = null;
  try {
    await there.createMesh([0, 0, 0], [0, 1, 2]);
  } catch (error) {
    code = error instanceof MorseSmoothError ? error.code : String(error);
  }
  const formats = await there.formats();
  const png = await there.snapshot(positions, triangles, values, { width: 160, height: 120 });
  there.close();
  const closed = await mesh.topology().catch(({ code }) => code);
  return {
    vertices: mesh.vertexCount,
    euler: report.before.indexSum,
    stopped,
    code,
    formats: formats.length,
    png: png.length > 1000,
    closed,
  };
}
