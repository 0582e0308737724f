// The page's views beside the pictures of `morse-smooth/snapshot`, which draw the same list with another renderer: both must come to
// the same. And the pictures that the page saves.
import { readFileSync } from 'node:fs';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { Scene } from 'morse-smooth/snapshot';
import { openTorus, page, torus } from './opened.js';

/** Where the page looks at the torus from, which lies flat: its z is up on the screen. See www/src/examples.ts. */
const VIEW = [0.15, 0.8, 0.8];
const DIRECTION = [VIEW[0], -VIEW[2], VIEW[1]];
const LEVELS = 14;
/** Pixels of the squares whose mean colors are compared: anti-aliased edges differ, and their means do not. */
const SQUARE = 8;
/**
 * Of the mean difference of the three colors, 0 to 255, over the squares in which something is drawn. It is between 0.5 and 1.0 for
 * what is compared here: edges, and lines whose corners the pictures round. The least of what is wrong below comes to 1.8.
 */
const DRIFT = 1.4;

let scene;
beforeAll(() => {
  scene = new Scene(torus.mesh.positions(), torus.mesh.triangles());
});
afterAll(() => scene?.free());

/** With views of that size, whose pixels can be read. Lines are a pixel for each of their widths where 900 pixels are the shorter side. */
async function openSized(width, height) {
  const prepare = (tab) =>
    tab.addInitScript(() => {
      const original = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, options, ...more) {
        return original.call(this, kind, { ...options, preserveDrawingBuffer: true }, ...more);
      };
    });
  await openTorus({ viewport: { width: 1000 + 2 * width, height: 1000 + height }, prepare });
  for (const side of ['before', 'after']) {
    await page.at(`${side}-canvas`).evaluate((canvas, [w, h]) => {
      canvas.parentElement.style.cssText = `flex: none; box-sizing: content-box; width: ${w}px; height: ${h}px`;
    }, [width, height]); // prettier-ignore
    await page.picture(side);
  }
  await page.page.getByText('Fit view').click();
}

/** The very pixels of a view, as PNG. */
async function pixels(side) {
  await page.picture(side);
  const address = await page.at(`${side}-canvas`).evaluate((canvas) => canvas.toDataURL());
  return Buffer.from(address.split(',')[1], 'base64');
}

const sizeOf = (png) => [png.readUInt32BE(16), png.readUInt32BE(20)];

/** A picture of the size of another one, without bar and title. */
function snapshotLike(png, values, options) {
  const [width, height] = sizeOf(png);
  const picture = { width, height, colorBar: false, levels: { count: LEVELS }, camera: { direction: DIRECTION } };
  return Buffer.from(scene.snapshot(values, { ...picture, ...options }));
}

/** How far two pictures of one size are apart. */
function driftOf(one, other) {
  expect(sizeOf(one)).toEqual(sizeOf(other));
  return page.page.evaluate(
    async ([pngs, square]) => {
      const [a, b] = await Promise.all(
        pngs.map(async (base64) => {
          const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
          const bitmap = await createImageBitmap(new Blob([bytes]));
          const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
          context.drawImage(bitmap, 0, 0);
          return context.getImageData(0, 0, bitmap.width, bitmap.height);
        }),
      );
      const mean = ({ data, width }, left, top) => {
        const sum = [0, 0, 0];
        for (let y = top; y < top + square; y++)
          for (let x = left; x < left + square; x++) sum.forEach((_, c) => (sum[c] += data[4 * (y * width + x) + c]));
        return sum.map((total) => total / square ** 2);
      };
      let [sum, count] = [0, 0];
      for (let top = 0; top + square <= a.height; top += square)
        for (let left = 0; left + square <= a.width; left += square) {
          const [p, q] = [mean(a, left, top), mean(b, left, top)];
          if (Math.min(...p, ...q) > 250) continue;
          sum += p.reduce((total, value, c) => total + Math.abs(value - q[c]) / 3, 0);
          count += 1;
        }
      return sum / count;
    },
    [[one, other].map((png) => png.toString('base64')), SQUARE],
  );
}

describe('the views', () => {
  test('show what the pictures show, and differ from anything else', async () => {
    await openSized(1000, 900);
    const view = await pixels('before');
    expect(await driftOf(view, snapshotLike(view, torus.noisy))).toBeLessThan(DRIFT);
    for (const [what, options] of Object.entries({
      'another map': { colormap: 'cividis' },
      'no points': { criticalPoints: false },
      'no lines': { levels: [] },
      'another direction': { camera: { direction: DIRECTION.map((x, axis) => x + (axis === 0 ? 0.02 : 0)) } },
    }))
      expect(await driftOf(view, snapshotLike(view, torus.noisy, options)), what).toBeGreaterThan(DRIFT);
  });

  test('frame the mesh as the pictures do, upright, too', async () => {
    await openSized(900, 1200);
    const view = await pixels('before');
    expect(await driftOf(view, snapshotLike(view, torus.noisy))).toBeLessThan(DRIFT);
  });

  test('do so with the Morse complex and bands, on the other side', async () => {
    await openSized(1000, 900);
    await page.after(() => page.at('show-complex').check());
    await page.after(() => page.at('show-bands').check());
    await page.choose('colormap', 'purpleGreen');
    const { values } = torus.smoothed('tikhonov', { epsilon: 0.1 });
    const { range, levels } = scene.drawList(torus.noisy, { levels: { count: LEVELS } });
    const view = await pixels('after');
    const options = { range, levels, colormap: 'purpleGreen', bands: true, morseComplex: true };
    expect(await driftOf(view, snapshotLike(view, values, options))).toBeLessThan(DRIFT);
    for (const other of [{ bands: false }, { morseComplex: false }])
      expect(await driftOf(view, snapshotLike(view, values, { ...options, ...other }))).toBeGreaterThan(DRIFT);
  });
});

describe('a saved picture', () => {
  async function saved() {
    const [download] = await Promise.all([page.page.waitForEvent('download'), page.at('save-picture').click()]);
    expect(await page.settled()).toBe('ready');
    return { name: download.suggestedFilename(), png: readFileSync(await download.path()) };
  }

  /** What the page shows at first, as a sheet. */
  function sheetOf(options) {
    const { values } = torus.smoothed('tikhonov', { epsilon: 0.1 });
    const { range } = scene.drawList(torus.noisy);
    const title = 'torus_irregular.ply, noisy';
    const camera = { direction: DIRECTION };
    return Buffer.from(
      scene.sheet(torus.noisy, values, { range, levels: { count: LEVELS }, camera, title, ...options }),
    );
  }

  test('has before, after and difference, as they are seen', async () => {
    await openTorus();
    const { name, png } = await saved();
    expect(name).toBe('torus_irregular_noisy.png');
    // The direction is rounded on its way through the camera.
    expect(await driftOf(png, sheetOf())).toBeLessThan(0.1);
    for (const other of [{ levels: [] }, { colormap: 'cividis' }, { camera: {} }])
      expect(await driftOf(png, sheetOf(other))).toBeGreaterThan(DRIFT);
  });

  test('follows the controls and the view', async () => {
    await openTorus();
    await page.at('show-glyphs').uncheck();
    await page.choose('colormap', 'coolWarm');
    await page.after(() => page.at('show-complex').check());
    const plain = await saved();
    const options = { colormap: 'coolWarm', criticalPoints: false, morseComplex: { persistence: 0.1 } };
    expect(await driftOf(plain.png, sheetOf(options))).toBeLessThan(0.1);
    await page.at('before-canvas').focus();
    await page.page.keyboard.press('ArrowLeft');
    expect((await saved()).png.equals(plain.png)).toBe(false);
    await page.choose('field', 'file:clean');
    const other = await saved();
    expect(other.name).toBe('torus_irregular_clean.png');
    expect(other.png.equals(plain.png)).toBe(false);
  });

  test('has the one field that there is, also without a view', async () => {
    const prepare = (tab) =>
      tab.addInitScript(() => {
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
          return kind.startsWith('webgl') ? null : original.call(this, kind, ...more);
        };
      });
    await openTorus({ prepare });
    await page.choose('method', 'interpolate');
    await page.after(() => page.at('clear-picked').click());
    const { png } = await saved();
    expect(sizeOf(png)).toEqual([1200, 900]);
    const title = 'torus_irregular.ply, noisy';
    const same = scene.snapshot(torus.noisy, { title, levels: { count: LEVELS } });
    expect(png.equals(Buffer.from(same))).toBe(true);
    page.complaints = page.complaints.filter((text) => !text.includes('WebGL'));
  });
});
