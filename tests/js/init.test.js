import init, { MorseSmoothError, TriMesh, smooth, version } from 'morse-smooth';
import { describe, expect, it } from 'vitest';
import { expectError, expectRejection } from './errors.js';
import { tetrahedron } from './meshes.js';

const inNode = typeof process === 'object' && process.versions?.node !== undefined;
const usable = () => {
  const { positions, triangles } = tetrahedron();
  expect(new TriMesh(positions, triangles).vertexCount).toBe(4);
};

describe.runIf(inNode)('in Node', () => {
  it('works without init', usable);

  it('init resolves at once, always with the same promise', async () => {
    expect(init()).toBe(init({}));
    expect(await init()).toBeUndefined();
  });
});

// These run in order, in a page of their own: before, during and after loading.
describe.skipIf(inNode)('in a browser', () => {
  it('refuses calls before init', () => {
    const { positions, triangles } = tetrahedron();
    expectError(() => new TriMesh(positions, triangles), 'NotInitialized');
    expectError(() => smooth({}, [], { epsilon: 1 }), 'NotInitialized');
  });

  it('reports what cannot be loaded, and can try again', async () => {
    await expectRejection(init({ wasm: new URL('/no-such-folder/x.wasm', location.href) }), 'LoadFailed');
    await expectRejection(init({ wasm: new Response('gone', { status: 404 }) }), 'LoadFailed', { status: 404 });
    await expectRejection(init({ wasm: Uint8Array.of(1, 2, 3) }), 'LoadFailed');
    const emptyModule = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);
    await expectRejection(init({ wasm: emptyModule }), 'LoadFailed');
    expectError(() => smooth({}, [], { epsilon: 1 }), 'NotInitialized');
  });

  it('loads once', async () => {
    const first = init();
    expect(init()).toBe(first);
    expect(await first).toBeUndefined();
    expect(init()).toBe(first);
    usable();
  });
});

describe('everywhere', () => {
  it('checks the options of init', async () => {
    await expectRejection(init({ wasn: 'x' }), 'UnknownOption', { option: 'wasn' });
    await expectRejection(init({ wasm: 5 }), 'InvalidOption', { option: 'wasm' });
    await expectRejection(init({ wasm: null }), 'InvalidOption', { option: 'wasm' });
    await expectRejection(init('x'), 'InvalidArgument', { argument: 'options' });
    await expectRejection(init(null), 'InvalidArgument', { argument: 'options' });
    usable();
  });

  it('has a version', () => {
    expect(version).toMatch(/^\d+\.\d+\.\d+/);
  });

  it('has errors that others can make, too', () => {
    const error = new MorseSmoothError('Code', 'message', { vertex: 3 }, { cause: 1 });
    expect(error).toMatchObject({
      name: 'MorseSmoothError',
      code: 'Code',
      message: 'message',
      detail: { vertex: 3 },
      cause: 1,
    });
    expect(String(error)).toBe('MorseSmoothError: message');
  });
});
