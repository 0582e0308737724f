/** Lines on the surface, all of one colour and some pixels wide. The surface steps back for them: see viewer.ts. */
import { GreaterDepth, Group } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';

export interface CurveStyle {
  colour: number;
  width: number;
  opacity?: number;
  /** A darker or lighter line under it, so that it stands out from any colour of the surface. */
  casing?: number;
  /** Only what is hidden is seen. */
  ghost?: boolean;
}

export class CurveLayer {
  readonly group = new Group();
  private readonly lines: LineSegments2[];
  private isShown = true;
  private isEmpty = true;

  constructor({ colour, width, opacity = 1, casing, ghost = false }: CurveStyle) {
    const strokes = [{ color: colour, linewidth: width }];
    if (casing !== undefined) strokes.unshift({ color: casing, linewidth: width + 2 });
    this.lines = strokes.map((stroke, k) => {
      const material = new LineMaterial({ ...stroke, transparent: opacity < 1, opacity });
      const lines = new LineSegments2(new LineSegmentsGeometry(), material);
      // The upper stroke lies exactly on the lower one, which therefore leaves no trace in depth.
      lines.renderOrder = k;
      material.depthWrite = !ghost && k === strokes.length - 1;
      if (ghost) material.depthFunc = GreaterDepth;
      return lines;
    });
    this.group.add(...this.lines);
    this.settle();
  }

  /** Six numbers a segment. */
  set(segments: Float32Array): void {
    this.isEmpty = segments.length === 0;
    for (const line of this.lines) {
      line.geometry.dispose();
      line.geometry = new LineSegmentsGeometry();
      if (!this.isEmpty) line.geometry.setPositions(segments);
    }
    this.settle();
  }

  show(isShown: boolean): void {
    this.isShown = isShown;
    this.settle();
  }

  private settle(): void {
    this.group.visible = this.isShown && !this.isEmpty;
  }
}
