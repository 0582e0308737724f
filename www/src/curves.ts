/** Draws lines on the surface, some pixels wide. The surface steps back for them: see viewer.ts. */
import { GreaterDepth, Group } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import type { Lines, Stroke } from 'morse-smooth/snapshot';

export class CurveLayer {
  readonly group = new Group();
  private readonly line: LineSegments2;
  private readonly casing: LineSegments2;

  /** `order`: of layers that lie over each other. `ghost`: only what is hidden is seen. */
  constructor({ order = 1, ghost = false }: { order?: number; ghost?: boolean } = {}) {
    // All casings lie under all lines, so that lines that meet are not cut by each other's.
    [this.casing, this.line] = [0, order].map((place) => {
      // They lie on each other in the order that is said, and leave no trace in depth that would decide otherwise.
      const material = new LineMaterial({ transparent: true, depthWrite: false });
      if (ghost) material.depthFunc = GreaterDepth;
      const lines = new LineSegments2(new LineSegmentsGeometry(), material);
      lines.renderOrder = place;
      lines.visible = false;
      return lines;
    }) as [LineSegments2, LineSegments2];
    this.group.add(this.casing, this.line);
  }

  /** Six numbers a segment. */
  set(segments: Float32Array, { color, width, opacity, casing }: Stroke): void {
    this.draw(this.line, segments, color, width, opacity);
    this.draw(this.casing, casing ? segments : NOTHING, casing?.color ?? 0, casing?.width ?? 0, 1);
  }

  clear(): void {
    for (const lines of [this.line, this.casing]) this.draw(lines, NOTHING, 0, 0, 1);
  }

  /** Of what is shown, in pixels. */
  get width(): number {
    const shown = this.group.visible ? [this.line, this.casing].filter(({ visible }) => visible) : [];
    return Math.max(0, ...shown.map(({ material }) => material.linewidth));
  }

  show(isShown: boolean): void {
    this.group.visible = isShown;
  }

  private draw(lines: LineSegments2, segments: Float32Array, color: number, width: number, opacity: number): void {
    lines.geometry.dispose();
    lines.geometry = new LineSegmentsGeometry();
    lines.visible = segments.length > 0;
    if (!lines.visible) return;
    lines.geometry.setPositions(segments);
    lines.material.color.setHex(color);
    lines.material.linewidth = width;
    lines.material.opacity = opacity;
  }
}

const NOTHING = new Float32Array(0);

/** The lines cut into segments, six numbers each. */
export function segmentsOf({ points, offsets, closed }: Lines): Float32Array {
  let total = 0;
  for (let k = 0; k < closed.length; k++)
    total += Math.max(0, offsets[k + 1]! - offsets[k]! - 1) + (closed[k] === 1 ? 1 : 0);
  const joined = new Float32Array(6 * total);
  let at = 0;
  const add = (from: number, to: number): void => {
    joined.set(points.subarray(3 * from, 3 * from + 3), at);
    joined.set(points.subarray(3 * to, 3 * to + 3), at + 3);
    at += 6;
  };
  for (let k = 0; k < closed.length; k++) {
    const first = offsets[k]!;
    const last = offsets[k + 1]! - 1;
    for (let i = first; i < last; i++) add(i, i + 1);
    if (closed[k] === 1 && last > first) add(last, first);
  }
  return joined.subarray(0, at);
}
