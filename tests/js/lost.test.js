// An instance of the module that failed in a way that leaves its memory in disorder, and the one after it.
import { beforeAll, describe, expect, it } from 'vitest';
// The entry for browsers, also in Node: it takes the code that it is given.
import init, { Smoother, TriMesh, smooth } from 'morse-smooth/inline';
import { heights, sphere, tetrahedron } from './meshes.js';
import { wasmBytes, withTrap } from './wasm-bytes.js';

const make = ({ positions, triangles }) => new TriMesh(positions, triangles);
const shape = sphere(2);
const values = heights(shape);

// Not by `expectError`: in Node the class of errors of this entry is another one than that of the main entry.
const expectCode = (call, code) => expect(thrownBy(call)).toMatchObject({ name: 'MorseSmoothError', code });

function thrownBy(call) {
  try {
    call();
  } catch (error) {
    return error;
  }
}

// They run in order. All but the last use a module whose `basins` traps.
beforeAll(async () => {
  await init({ wasm: withTrap(await wasmBytes(), 'rawtrimesh_basins') });
});

describe('an instance that fails', () => {
  it('is lost with its objects, and init makes another', async () => {
    const mesh = make(shape);
    const smoother = new Smoother(mesh);
    const expected = smoother.tikhonov(values, { epsilon: 0.1 });
    const family = smoother.family(values);
    const curves = family.sweep();
    const points = mesh.criticalPoints(values);

    const thrown = thrownBy(() => mesh.basins(values));
    expect(thrown).toMatchObject({ code: 'InternalError', detail: {} });
    expect(thrown.cause).toBeInstanceOf(WebAssembly.RuntimeError);

    for (const call of [
      () => mesh.criticalPoints(values),
      () => mesh.vertexCount,
      () => mesh.topology,
      () => mesh.basins(values),
      () => smoother.tikhonov(values, { epsilon: 0.1 }),
      () => family.values(0.1),
      () => family.dimension,
      () => family.grow(),
      () => smoother.sweep(values),
      () => smoother.prescribe(values, { epsilon: 0.1 }),
      () => new Smoother(mesh),
      () => smooth(mesh, values, { epsilon: 0.1 }),
      () => mesh.positions(),
    ])
      expectCode(call, 'InstanceLost');
    // What is new waits for init.
    expectCode(() => make(tetrahedron()), 'InstanceLost');
    expect(() => make(tetrahedron())).toThrow('init()');

    const again = init();
    expect(init()).toBe(again);
    await again;
    expect(init()).toBe(again);
    // The old objects stay lost; freeing them does nothing.
    expectCode(() => mesh.vertexCount, 'InstanceLost');
    expectCode(() => new Smoother(mesh), 'InstanceLost');
    expectCode(() => smooth(mesh, values, { epsilon: 0.1 }), 'InstanceLost');
    family.free();
    smoother.free();
    mesh.free();
    mesh.free();
    expectCode(() => mesh.vertexCount, 'UseAfterFree');

    const fresh = make(shape);
    expect(fresh.criticalPoints(values)).toEqual(points);
    expect(new Smoother(fresh).tikhonov(values, { epsilon: 0.1 })).toEqual(expected);
    expect(new Smoother(fresh).sweep(values)).toEqual(curves);
  });

  it('is lost to a call from within a callback, too', async () => {
    const mesh = make(shape);
    const onProgress = () => {
      mesh.basins(values);
    };
    expectCode(() => smooth(mesh, values, { epsilon: 0.1, onProgress }), 'InternalError');
    expectCode(() => mesh.vertexCount, 'InstanceLost');
    await init();
    const fresh = make(shape);
    const swallowing = () => {
      thrownBy(() => fresh.basins(values));
    };
    expectCode(() => smooth(fresh, values, { epsilon: 0.1, onProgress: swallowing }), 'InstanceLost');
    await init();
    expect(make(shape).vertexCount).toBe(66);
  });

  it('need not trap: it may have no stack left', async () => {
    const mesh = make(shape);
    const deep = () => {
      try {
        deep();
      } catch (error) {
        if (error.code !== undefined) throw error;
        mesh.persistence(values);
      }
    };
    const thrown = thrownBy(deep);
    // There may be room enough at the end of an engine's stack, or too little to say at once what happened: the call from the next
    // frame then hears that the instance is lost.
    if (thrown !== undefined) {
      expect(['InternalError', 'InstanceLost']).toContain(thrown.code);
      expectCode(() => mesh.vertexCount, 'InstanceLost');
      await init();
    }
    expect(make(shape).persistence(values).extrema.length).toBe(0);
  });

  it('can be followed by one of other code', async () => {
    const mesh = make(shape);
    expectCode(() => mesh.basins(values), 'InternalError');
    await init({ wasm: await wasmBytes() });
    expect(make(shape).basins(values).descending.length).toBe(66);
  });
});

const inNode = typeof process === 'object' && process.versions?.node !== undefined;

describe.runIf(inNode)('in Node', () => {
  it('what is new gets another instance by itself', async () => {
    const main = await import('morse-smooth');
    const old = new main.TriMesh(shape.positions, shape.triangles);
    const expected = old.persistence(values);
    // A call that begins where the stack ends, and needs more of it.
    const deep = () => {
      try {
        deep();
      } catch (error) {
        if (error.code !== undefined) throw error;
        old.morseHierarchy(values);
      }
    };
    const thrown = thrownBy(deep);
    if (thrown !== undefined) expectCode(() => old.vertexCount, 'InstanceLost');
    old.free();
    const fresh = new main.TriMesh(shape.positions, shape.triangles);
    expect(fresh.persistence(values)).toEqual(expected);
    await main.default();
    expect(fresh.vertexCount).toBe(66);
  });
});
