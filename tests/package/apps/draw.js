// What users of pictures do. Returns what tells whether it worked: the size that the file says it has, and a sum over its bytes.
export function draw({ MorseSmoothError, Scene, snapshot }) {
  const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0];
  const triangles = [0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1];
  const png = snapshot(positions, triangles, [5, 1, 2, 3, 4], { width: 160, height: 120, title: 'heat' });
  const view = new DataView(png.buffer);
  const scene = new Scene(positions, triangles);
  const { vertices } = scene.surface();
  scene.free();
  let code = null;
  try {
    scene.surface();
  } catch (error) {
    code = error instanceof MorseSmoothError ? error.code : String(error);
  }
  const sum = png.reduce((sum, byte) => (Math.imul(sum, 31) + byte) >>> 0, 0);
  return {
    signature: view.getUint32(0),
    size: [view.getUint32(16), view.getUint32(20)],
    sum,
    vertices: [...vertices],
    code,
  };
}
