import { TriMesh } from 'morse-smooth';
import init, { Scene, sheet, snapshot } from 'morse-smooth/snapshot';
import { describe, expect, it } from 'vitest';
import { expectError, expectRejection } from './errors.js';
import { tetrahedron } from './meshes.js';
import { header } from './pictures.js';

const inNode = typeof process === 'object' && process.versions?.node !== undefined;
const { positions, triangles } = tetrahedron();
const values = [1, 2, 3, 4];
const usable = () => {
  const png = snapshot(positions, triangles, values, { width: 30, height: 20 });
  expect(header(png)).toMatchObject({ width: 30, height: 20 });
};

describe.runIf(inNode)('in Node', () => {
  it('pictures are drawn without init', usable);

  it('init resolves at once, always with the same promise', async () => {
    expect(init()).toBe(init({}));
    expect(await init()).toBeUndefined();
  });
});

// These run in order, in a page of their own: before, during and after loading.
describe.skipIf(inNode)('in a browser', () => {
  const loaded = () => performance.getEntriesByType('resource').filter(({ name }) => /\.wasm\b/.test(name));

  it('nothing is fetched or drawn before init', () => {
    expectError(() => snapshot(positions, triangles, values), 'NotInitialized');
    expectError(() => sheet(positions, triangles, values, values), 'NotInitialized');
    expectError(() => new Scene(positions, triangles), 'NotInitialized');
    expect(loaded()).toEqual([]);
  });

  it('reports what cannot be loaded, and can try again', async () => {
    await expectRejection(init({ wasm: new Response('gone', { status: 404 }) }), 'LoadFailed', { status: 404 });
    await expectRejection(init({ wasm: Uint8Array.of(1, 2, 3) }), 'LoadFailed');
    expectError(() => new Scene(positions, triangles), 'NotInitialized');
  });

  it('refuses the other module', async () => {
    const { default: core } = await import('morse-smooth/morse_smooth_bg.wasm?url');
    const error = await init({ wasm: core }).catch((error) => error);
    expect(error).toMatchObject({ code: 'LoadFailed', message: expect.stringContaining('morse-smooth/snapshot') });
    const { default: pictures } = await import('morse-smooth/morse_smooth_snapshot_bg.wasm?url');
    const { default: initCore } = await import('morse-smooth');
    await expectRejection(initCore({ wasm: pictures }), 'LoadFailed');
  });

  it('loads its own module once, and no other', async () => {
    const before = loaded().length;
    const first = init();
    expect(init()).toBe(first);
    expect(await first).toBeUndefined();
    expect(init()).toBe(first);
    usable();
    expect(loaded().slice(before)).toHaveLength(1);
    expect(loaded().at(-1).name).toContain('morse_smooth_snapshot_bg.wasm');
    expectError(() => new TriMesh(positions, triangles), 'NotInitialized');
  });
});

describe('everywhere', () => {
  it('init checks its options', async () => {
    await expectRejection(init({ wasn: 'x' }), 'UnknownOption', { option: 'wasn' });
    await expectRejection(init({ wasm: 5 }), 'InvalidOption', { option: 'wasm' });
    await expectRejection(init({ wasm: null }), 'InvalidOption', { option: 'wasm' });
    await expectRejection(init('x'), 'InvalidArgument', { argument: 'options' });
    usable();
  });
});
