import * as core from 'morse-smooth';
import init, { formats, readField, readMesh, readTable, writeMesh } from 'morse-smooth/files';
import { describe, expect, it } from 'vitest';
import { expectError, expectRejection } from './errors.js';
import { tetrahedron, text } from './meshes.js';

const inNode = typeof process === 'object' && process.versions?.node !== undefined;
const OFF = 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n';
const usable = () => expect(readMesh(text(OFF)).triangles).toEqual(Uint32Array.of(0, 1, 2));

describe.runIf(inNode)('in Node', () => {
  it('files are read without init', usable);

  it('init resolves at once, always with the same promise', async () => {
    expect(init()).toBe(init({}));
    expect(await init()).toBeUndefined();
  });
});

// These run in order, in a page of their own: before, during and after loading.
describe.skipIf(inNode)('in a browser', () => {
  const loaded = () => performance.getEntriesByType('resource').filter(({ name }) => /\.wasm\b/.test(name));

  it('nothing is fetched, read or written before init', () => {
    expectError(() => readMesh(text('OFF')), 'NotInitialized');
    expectError(() => readField(text('1')), 'NotInitialized');
    expectError(() => readTable(text('1')), 'NotInitialized');
    expectError(() => writeMesh(tetrahedron(), { format: 'ply' }), 'NotInitialized');
    expectError(() => formats(), 'NotInitialized');
    expect(loaded()).toEqual([]);
  });

  it('reports what cannot be loaded, and can try again', async () => {
    await expectRejection(init({ wasm: new Response('gone', { status: 404 }) }), 'LoadFailed', { status: 404 });
    await expectRejection(init({ wasm: Uint8Array.of(1, 2, 3) }), 'LoadFailed');
    expectError(() => readField(text('1')), 'NotInitialized');
  });

  it('refuses the other modules, and they refuse it', async () => {
    const { default: coreUrl } = await import('morse-smooth/morse_smooth_bg.wasm?url');
    const { default: filesUrl } = await import('morse-smooth/morse_smooth_files_bg.wasm?url');
    const { default: picturesUrl } = await import('morse-smooth/morse_smooth_snapshot_bg.wasm?url');
    const { default: initPictures } = await import('morse-smooth/snapshot');
    for (const wasm of [coreUrl, picturesUrl]) {
      const error = await init({ wasm }).catch((error) => error);
      expect(error).toMatchObject({ code: 'LoadFailed', message: expect.stringContaining('morse-smooth/files') });
    }
    await expectRejection(core.default({ wasm: filesUrl }), 'LoadFailed');
    await expectRejection(initPictures({ wasm: filesUrl }), 'LoadFailed');
  });

  it('loads its own module once, and no other', async () => {
    const before = loaded().length;
    const first = init();
    expect(init()).toBe(first);
    expect(await first).toBeUndefined();
    expect(init()).toBe(first);
    usable();
    expect(loaded().slice(before)).toHaveLength(1);
    expect(loaded().at(-1).name).toContain('morse_smooth_files_bg.wasm');
    const { positions, triangles } = tetrahedron();
    expectError(() => new core.TriMesh(positions, triangles), 'NotInitialized');
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

  it('the main entry knows no files', () => {
    expect(Object.keys(core).sort()).toEqual([
      'MorseSmoothError',
      'Smoother',
      'SmoothingFamily',
      'TriMesh',
      'default',
      'smooth',
      'version',
    ]);
  });
});
