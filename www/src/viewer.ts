/** One 3D view: draws what a draw list says, and the page's own signs on it. Draws only when something changed. */
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  DirectionalLight,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
  WireframeGeometry,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Camera, Lines, Solids, SolidSize, Surface } from 'morse-smooth/snapshot';
import { along, basinColors, textureOf, withGaps } from './colormap';
import { CurveLayer, segmentsOf } from './curves';
import { fieldOfView, frame } from './framing';
import { GlyphLayer, radiusOf, solidsAt } from './glyphs';
import type { Points } from './glyphs';
import { Marker } from './marker';
import { hitOf, listenToClicks, nearestOf } from './picking';
import { Places } from './places';
import type { Found, Look } from './protocol';
import { RingLayer } from './rings';

const BACKGROUND = 0xffffff;
const EDGES = 0x0d1320;
/** Radians a key press turns the view by, and the factor it zooms by. */
const KEY_TURN = Math.PI / 24;
const KEY_ZOOM = 1.12;
/** Of rings: by the radius of glyphs, and their least radius where they are few. */
const RING = 1.75;
const FEW_RINGS = 0.014;

export interface Layers {
  glyphs: boolean;
  levels: boolean;
  edges: boolean;
  complex: boolean;
  /** Colors by basin instead of by value. */
  basins: boolean;
  /** Colors by what has changed, where that is known. */
  difference: boolean;
}

export class Viewer {
  /** Called after the user has moved this view's camera. */
  onMove: (() => void) | null = null;
  /** Called with the vertex that the user has clicked on. */
  onPick: ((vertex: number) => void) | null = null;

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(fieldOfView(1), 1, 0.01, 100);
  private readonly controls: OrbitControls;
  /** Turned so that what is "up" in the file is up on the screen. */
  private readonly model = new Group();
  private readonly surface: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly plainMaterial: MeshLambertMaterial;
  private readonly basinMaterial: MeshLambertMaterial;
  private readonly differenceMaterial: MeshLambertMaterial;
  /** The color of what has no value. */
  private readonly gap = new Color();
  private readonly everywhere = new AmbientLight(0xffffff);
  private readonly aside = new DirectionalLight(0xffffff);
  private readonly curves: Record<Lines['kind'], CurveLayer> = {
    levels: new CurveLayer({ order: 1 }),
    descending: new CurveLayer({ order: 2 }),
    ascending: new CurveLayer({ order: 3 }),
  };
  private readonly marker = new Marker();
  private readonly edges: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly glyphs = new GlyphLayer();
  private readonly rings = new RingLayer();
  private look: Look | null = null;
  private places: Places | null = null;
  private layers: Layers = {
    glyphs: true,
    levels: true,
    edges: false,
    complex: false,
    basins: false,
    difference: false,
  };
  private solids: readonly Solids[] = [];
  private constrained: Found | null = null;
  private frame = 0;

  /** Throws where there is no WebGL 2. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.scene.background = new Color(BACKGROUND);

    // The surface is pushed back a little in depth, so that lines lying on it are not eaten by it: see `makeRoom`.
    const pushed = { side: DoubleSide, polygonOffset: true, polygonOffsetUnits: 4 } as const;
    this.plainMaterial = withGaps(new MeshLambertMaterial(pushed), this.gap);
    this.basinMaterial = withGaps(new MeshLambertMaterial({ ...pushed, vertexColors: true }), this.gap);
    this.differenceMaterial = withGaps(new MeshLambertMaterial(pushed), this.gap);
    this.surface = new Mesh(new BufferGeometry(), this.plainMaterial);
    // Before the lines, which leave no trace in depth.
    this.surface.renderOrder = -1;
    this.edges = new LineSegments(
      new BufferGeometry(),
      new LineBasicMaterial({ color: EDGES, transparent: true, opacity: 0.22 }),
    );
    const curves = Object.values(this.curves).map(({ group }) => group);
    this.model.add(this.surface, ...curves, this.edges, this.glyphs.group, this.rings.group, this.marker.group);
    this.model.visible = false;
    this.scene.add(this.model, this.camera, this.everywhere);
    // From beside the eye, wherever that is.
    this.camera.add(this.aside, this.aside.target);

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.3;
    this.controls.maxDistance = 20;
    this.controls.addEventListener('change', () => {
      this.draw();
      this.onMove?.();
    });
    canvas.addEventListener('keydown', (event) => this.onKey(event));
    listenToClicks(canvas, (clientX, clientY) => {
      const vertex = this.vertexAt(clientX, clientY);
      if (vertex !== null) this.onPick?.(vertex);
    });
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
  }

  /** `up`: which axis of the file points upwards on the screen. */
  setMesh(look: Look, up: Surface['up']): void {
    const { surface, light } = look;
    this.look = look;
    this.places = new Places(surface);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(surface.positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(surface.normals, 3));
    geometry.setIndex(new BufferAttribute(surface.triangles, 1));
    this.surface.geometry.dispose();
    this.surface.geometry = geometry;
    // A surface sends the π-th part of the light that it gets into each direction.
    this.everywhere.intensity = Math.PI * light.ambient;
    this.aside.intensity = Math.PI * light.diffuse;
    this.aside.position.set(...light.direction);
    this.constrained = null;
    this.rings.clear();
    this.edges.geometry.dispose();
    this.edges.geometry = new BufferGeometry();
    this.model.rotation.x = up === 'z' ? -Math.PI / 2 : 0;
    this.clearField();
  }

  /** Nothing to show until `setShades` is called. */
  clearField(): void {
    this.model.visible = false;
    this.solids = [];
    this.glyphs.clear();
    this.marker.clear();
    this.surface.geometry.deleteAttribute('color');
    this.surface.geometry.deleteAttribute('uv1');
    for (const curves of Object.values(this.curves)) curves.clear();
    this.draw();
  }

  /** `gap`: the color of gaps; null where there are none. */
  setShades(shades: Float32Array, gap: number | null): void {
    if (gap !== null) this.gap.setHex(gap);
    this.surface.geometry.setAttribute('uv', along(shades));
    this.model.visible = true;
    this.draw();
  }

  /** Colors and critical points of another field on the way, without its lines. `open`: whether the surface is seen from both sides. */
  setPreview(shades: Float32Array, points: Points, size: SolidSize, open: boolean): void {
    if (!this.look || !this.places) return;
    this.surface.geometry.setAttribute('uv', along(shades));
    for (const curves of Object.values(this.curves)) curves.clear();
    this.setSolids(solidsAt(points, this.look.solids, this.places, radiusOf(size, points.vertices.length), open));
  }

  /** `stepped`: colors with steps between them. */
  setColors(colors: Uint8Array, stepped: boolean): void {
    paint(this.plainMaterial, textureOf(colors, stepped));
    this.draw();
  }

  /** The same for what has changed, with colors of its own. */
  setDifference(shades: Float32Array, colors: Uint8Array, gap: number | null): void {
    if (gap !== null) this.gap.setHex(gap);
    this.surface.geometry.setAttribute('uv1', along(shades));
    const texture = textureOf(colors, false);
    texture.channel = 1;
    paint(this.differenceMaterial, texture);
    this.applyLayers();
  }

  /** In place of all lines of those kinds. */
  setLines(kinds: readonly Lines['kind'][], all: readonly Lines[]): void {
    for (const kind of kinds) this.curves[kind].clear();
    for (const lines of all) this.curves[lines.kind].set(segmentsOf(lines), lines.stroke);
    this.makeRoom();
    this.draw();
  }

  /** The numbers of the vertices' colors, which are mixed over the triangles in which basins meet. */
  setBasins(numbers: Uint8Array): void {
    if (!this.look) return;
    const colors = basinColors(numbers, this.look.surface.vertices);
    this.surface.geometry.setAttribute('color', new BufferAttribute(colors, 3));
    this.applyLayers();
  }

  /** `path`: the two vertices of each segment of a line between the points, where it is known. */
  setLit(points: Points | null, path: Uint32Array = new Uint32Array(0)): void {
    if (points && this.look && this.places && this.model.visible)
      this.marker.set(points, this.look.solids, this.places, path);
    else this.marker.clear();
    this.draw();
  }

  setConstrained(found: Found): void {
    this.constrained = found;
    this.drawRings();
  }

  setSolids(solids: readonly Solids[]): void {
    this.solids = solids;
    this.glyphs.set(solids);
    this.drawRings();
  }

  setLayers(layers: Layers): void {
    this.layers = layers;
    this.applyLayers();
  }

  /** Looks from `direction` (of the scene, y up) at the whole mesh, as near as it fits, with its picture in the middle. */
  frameMesh(direction: readonly [number, number, number]): void {
    if (!this.look) return;
    const { camera, controls, model } = this;
    camera.position.set(...direction).normalize();
    camera.lookAt(0, 0, 0);
    model.updateMatrixWorld();
    controls.target.copy(frame(camera, this.look.surface.positions, model.matrixWorld));
    controls.update();
    this.draw();
  }

  /** From where the mesh is seen, in its own coordinates. */
  get direction(): Required<Camera> {
    const { camera, model } = this;
    const back = model.quaternion.clone().invert().multiply(camera.quaternion);
    const [direction, up] = [new Vector3(0, 0, 1), new Vector3(0, 1, 0)].map((axis) => axis.applyQuaternion(back));
    return { direction: direction!.toArray(), up: up!.toArray() };
  }

  copyCamera(other: Viewer): void {
    this.camera.position.copy(other.camera.position);
    this.camera.quaternion.copy(other.camera.quaternion);
    this.controls.target.copy(other.controls.target);
    this.draw();
  }

  private applyLayers(): void {
    const { glyphs, levels, edges, complex, basins, difference } = this.layers;
    this.curves.levels.show(levels);
    this.curves.descending.show(complex);
    this.curves.ascending.show(complex);
    // Until the colors have come, values are shown.
    const has = (name: string): boolean => this.surface.geometry.hasAttribute(name);
    if (basins && has('color')) this.surface.material = this.basinMaterial;
    else if (difference && has('uv1')) this.surface.material = this.differenceMaterial;
    else this.surface.material = this.plainMaterial;
    this.edges.visible = edges;
    // Edges of a large mesh are only built when somebody wants to see them.
    if (edges && this.look && !this.edges.geometry.hasAttribute('position')) {
      this.edges.geometry = new WireframeGeometry(this.surface.geometry);
    }
    this.glyphs.group.visible = glyphs;
    this.makeRoom();
    this.draw();
  }

  /** A line is as deep at its sides as in its middle: the surface, which may rise between them, steps back for the widest one. */
  private makeRoom(): void {
    const width = Math.max(...Object.values(this.curves).map((curves) => curves.width));
    for (const material of [this.plainMaterial, this.basinMaterial, this.differenceMaterial])
      material.polygonOffsetFactor = 0.75 + (this.renderer.getPixelRatio() * width) / 2;
  }

  private drawRings(): void {
    if (this.constrained && this.places) this.rings.set(this.constrained, this.places, this.ringSize);
    this.draw();
  }

  /** Around glyphs, and no smaller where the glyphs are many and the constraints few. */
  private get ringSize(): number {
    const { size } = this.look!;
    const count = this.constrained?.features.length ?? 0;
    const glyph = this.solids[0]?.radius ?? radiusOf(size, 0);
    return RING * Math.max(glyph, Math.min(FEW_RINGS, radiusOf(size, 4 * count)));
  }

  /** The constrained vertex or the critical point whose sign is there, else the nearest corner of the triangle. */
  private vertexAt(clientX: number, clientY: number): number | null {
    const { look, places, model } = this;
    if (!look || !places || !model.visible) return null;
    const hit = hitOf(this.surface, model, this.camera, this.canvas, clientX, clientY);
    if (!hit) return null;
    const nearest = (vertices: Iterable<number>, reach: number): number | null =>
      nearestOf(vertices, places, hit.place, reach);
    const marked = nearest(this.constrained?.features ?? [], this.ringSize);
    const shown = this.layers.glyphs ? this.solids : [];
    const critical = nearest(
      shown.flatMap(({ vertices }) => [...vertices]),
      shown[0]?.radius ?? 0,
    );
    const corners = hit.corners.map((corner) => look.surface.vertices[corner]!);
    return marked ?? critical ?? nearest(corners, Infinity);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.fov = fieldOfView(this.camera.aspect);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      const eye = this.model.worldToLocal(this.camera.position.clone());
      this.glyphs.face(eye);
      this.marker.face(eye);
      this.renderer.render(this.scene, this.camera);
    });
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turns: Record<string, [number, number]> = {
      ArrowLeft: [-KEY_TURN, 0],
      ArrowRight: [KEY_TURN, 0],
      ArrowUp: [0, -KEY_TURN],
      ArrowDown: [0, KEY_TURN],
    };
    const offset = new Vector3().subVectors(this.camera.position, this.controls.target);
    const turn = turns[event.key];
    if (turn) {
      offset.applyAxisAngle(new Vector3(0, 1, 0), turn[0]);
      const side = new Vector3(1, 0, 0).applyQuaternion(this.camera.quaternion);
      const tilted = offset.clone().applyAxisAngle(side, turn[1]);
      // Not over the pole, where the view would flip.
      if (Math.abs(tilted.y) < 0.99 * tilted.length()) offset.copy(tilted);
    } else if (event.key === '+' || event.key === '=') offset.divideScalar(KEY_ZOOM);
    else if (event.key === '-') offset.multiplyScalar(KEY_ZOOM);
    else return;
    event.preventDefault();
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
  }
}

/** In place of the texture that the material had. */
function paint(material: MeshLambertMaterial, texture: DataTexture): void {
  // With its first texture it becomes another program.
  if (!material.map) material.needsUpdate = true;
  material.map?.dispose();
  material.map = texture;
}

/** Joins the cameras of two views. */
export function link(first: Viewer, second: Viewer): void {
  first.onMove = () => second.copyCamera(first);
  second.onMove = () => first.copyCamera(second);
}
