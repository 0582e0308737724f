/** One 3D view: the surface coloured by a field, its level sets, its critical points. Draws only when something changed. */
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  DirectionalLight,
  DoubleSide,
  Group,
  LinearFilter,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  NearestFilter,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
  WireframeGeometry,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { SAMPLES } from './colormap';
import { CurveLayer } from './curves';
import { GlyphLayer, glyphRadius } from './glyphs';
import { Marker } from './marker';
import type { LitPoints } from './marker';
import { hitOf, listenToClicks, nearestOf } from './picking';
import type { DisplayMesh, Found } from './protocol';
import { RingLayer } from './rings';

const BACKGROUND = 0xffffff;
const FIELD_OF_VIEW = 30;
/** Room around the mesh for glyphs on its rim. */
const MARGIN = 1.1;
/** Radians a key press turns the view by, and the factor it zooms by. */
const KEY_TURN = Math.PI / 24;
const KEY_ZOOM = 1.12;
/** Of rings, by the radius of glyphs. */
const RING = 1.75;

export interface Layers {
  glyphs: boolean;
  levels: boolean;
  edges: boolean;
  complex: boolean;
  /** Colours by basin instead of by value. */
  basins: boolean;
  /** Colours by what has changed, where that is known. */
  difference: boolean;
}

/** Of the Morse complex: towards minima and towards maxima, near to the colours of those. */
const DESCENDING = 0x8fc1ff;
const ASCENDING = 0xff8a8f;
const DARK = 0x0d1320;

export class Viewer {
  /** Called after the user has moved this view's camera. */
  onMove: (() => void) | null = null;
  /** Called with the vertex that the user has clicked on. */
  onPick: ((vertex: number) => void) | null = null;

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  /** Turned so that what is "up" in the file is up on the screen. */
  private readonly model = new Group();
  private readonly surface: Mesh<BufferGeometry, MeshLambertMaterial>;
  private readonly plainMaterial: MeshLambertMaterial;
  private readonly basinMaterial: MeshLambertMaterial;
  private readonly differenceMaterial: MeshLambertMaterial;
  private readonly lines = new CurveLayer({ colour: DARK, width: 1.6, opacity: 0.85 });
  private readonly descending = new CurveLayer({ colour: DESCENDING, width: 2, casing: DARK });
  private readonly ascending = new CurveLayer({ colour: ASCENDING, width: 2, casing: DARK });
  private readonly marker = new Marker();
  private readonly edges: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly glyphs = new GlyphLayer();
  private readonly rings = new RingLayer();
  private readonly texture: DataTexture = textureOf(new Uint8Array(4 * SAMPLES));
  private mesh: DisplayMesh | null = null;
  private layers: Layers = {
    glyphs: true,
    levels: true,
    edges: false,
    complex: false,
    basins: false,
    difference: false,
  };
  private critical: { vertices: Uint32Array; kinds: Int8Array } | null = null;
  private constrained: Found | null = null;
  private frame = 0;

  /** Throws where there is no WebGL 2. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    differences: Uint8Array<ArrayBuffer>,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.scene.background = new Color(BACKGROUND);

    // The surface is pushed back a little in depth, so that lines lying on it are not eaten by it.
    const pushed = { side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1.5, polygonOffsetUnits: 4 } as const;
    this.plainMaterial = new MeshLambertMaterial({ ...pushed, map: this.texture });
    this.basinMaterial = new MeshLambertMaterial({ ...pushed, vertexColors: true });
    const differenceTexture = textureOf(differences);
    differenceTexture.channel = 1;
    this.differenceMaterial = new MeshLambertMaterial({ ...pushed, map: differenceTexture });
    this.surface = new Mesh(new BufferGeometry(), this.plainMaterial);
    // Before the lines, some of which leave no trace in depth.
    this.surface.renderOrder = -1;
    this.edges = new LineSegments(
      new BufferGeometry(),
      new LineBasicMaterial({ color: DARK, transparent: true, opacity: 0.22 }),
    );
    const curves = [this.lines, this.descending, this.ascending].map(({ group }) => group);
    this.model.add(this.surface, ...curves, this.edges, this.glyphs.group, this.rings.group, this.marker.group);
    this.model.visible = false;
    this.scene.add(this.model, this.camera, new AmbientLight(0xffffff, 2.3));
    // The light comes from beside the eye: shading shows the shape without hiding the colours.
    const light = new DirectionalLight(0xffffff, 1.5);
    light.position.set(-0.6, 0.9, 1);
    this.camera.add(light);

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

  setMesh(mesh: DisplayMesh): void {
    this.mesh = mesh;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(mesh.positions, 3));
    geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
    geometry.computeVertexNormals();
    this.surface.geometry.dispose();
    this.surface.geometry = geometry;
    this.constrained = null;
    this.rings.clear();
    this.edges.geometry.dispose();
    this.edges.geometry = new BufferGeometry();
    this.model.rotation.x = mesh.up === 'z' ? -Math.PI / 2 : 0;
    this.clearField();
  }

  /** Nothing to show until `setShades` is called. */
  clearField(): void {
    this.model.visible = false;
    this.critical = null;
    this.glyphs.clear();
    this.marker.clear();
    this.surface.geometry.deleteAttribute('color');
    this.surface.geometry.deleteAttribute('uv1');
    const none = new Float32Array(0);
    this.setComplex(none, none);
    this.setLines(none);
  }

  /** The colour is looked up for every pixel, not mixed between the vertices' colours. */
  setShades(shades: Float32Array): void {
    this.surface.geometry.setAttribute('uv', along(shades));
    this.model.visible = true;
    this.draw();
  }

  /** The same for what has changed, with colours of its own. */
  setDifference(shades: Float32Array): void {
    this.surface.geometry.setAttribute('uv1', along(shades));
    this.applyLayers();
  }

  /** `banded`: colours with steps between them, which must not be blurred. */
  setColormap(bytes: Uint8Array, banded: boolean): void {
    (this.texture.image.data as Uint8Array).set(bytes);
    this.texture.magFilter = this.texture.minFilter = banded ? NearestFilter : LinearFilter;
    this.texture.needsUpdate = true;
    this.draw();
  }

  setLines(segments: Float32Array): void {
    this.lines.set(segments);
    this.draw();
  }

  setComplex(descending: Float32Array, ascending: Float32Array): void {
    this.descending.set(descending);
    this.ascending.set(ascending);
    this.draw();
  }

  /** Red, green, blue of each vertex, mixed over the triangles in which basins meet. */
  setBasins(colours: Float32Array): void {
    this.surface.geometry.setAttribute('color', new BufferAttribute(colours, 3));
    this.applyLayers();
  }

  /** `path`: lines between the points, where they are known. */
  setLit(points: LitPoints | null, path: Float32Array = new Float32Array(0)): void {
    if (points && this.mesh && this.model.visible) this.marker.set(points, this.mesh, this.normals, path);
    else this.marker.clear();
    this.draw();
  }

  setConstrained(found: Found): void {
    this.constrained = found;
    this.drawRings();
  }

  setCritical(vertices: Uint32Array, kinds: Int8Array): void {
    this.critical = { vertices, kinds };
    this.applyLayers(true);
  }

  setLayers(layers: Layers): void {
    this.layers = layers;
    this.applyLayers();
  }

  /** Looks from `direction` (of the scene, y up) at the whole mesh, as near as it fits, with its picture in the middle. */
  frameMesh(direction: readonly [number, number, number]): void {
    if (!this.mesh) return;
    const { camera, controls } = this;
    camera.position.set(...direction).normalize();
    camera.lookAt(0, 0, 0);
    camera.updateMatrixWorld();
    this.model.updateMatrixWorld();
    const turn = camera.matrixWorldInverse.clone().setPosition(0, 0, 0).multiply(this.model.matrixWorld);
    const tangentY = Math.tan(((FIELD_OF_VIEW / 2) * Math.PI) / 180);
    const tangentX = tangentY * camera.aspect;
    // A point (x, y, z) is inside the right edge of a camera at (a, b, d) if x + z·tan ≤ a + d·tan; likewise the other edges.
    const [right, left, top, bottom] = this.reaches(turn, tangentX, tangentY);
    const distance = Math.max((right + left) / (2 * tangentX), (top + bottom) / (2 * tangentY), 0.1);
    const shift = new Vector3((right - left) / 2, (top - bottom) / 2, 0).applyQuaternion(camera.quaternion);
    camera.position.multiplyScalar(MARGIN * distance).add(shift);
    controls.target.copy(shift);
    controls.update();
    this.draw();
  }

  private reaches(turn: Matrix4, tangentX: number, tangentY: number): [number, number, number, number] {
    const reach: [number, number, number, number] = [-Infinity, -Infinity, -Infinity, -Infinity];
    const { positions } = this.mesh!;
    const point = new Vector3();
    for (let i = 0; i < positions.length; i += 3) {
      const { x, y, z } = point.fromArray(positions, i).applyMatrix4(turn);
      reach[0] = Math.max(reach[0], z * tangentX + x);
      reach[1] = Math.max(reach[1], z * tangentX - x);
      reach[2] = Math.max(reach[2], z * tangentY + y);
      reach[3] = Math.max(reach[3], z * tangentY - y);
    }
    return reach;
  }

  copyCamera(other: Viewer): void {
    this.camera.position.copy(other.camera.position);
    this.camera.quaternion.copy(other.camera.quaternion);
    this.controls.target.copy(other.controls.target);
    this.draw();
  }

  private applyLayers(criticalChanged = false): void {
    const { glyphs, levels, edges, complex, basins, difference } = this.layers;
    this.lines.show(levels);
    this.descending.show(complex);
    this.ascending.show(complex);
    // Until the colours have come, values are shown.
    const has = (name: string): boolean => this.surface.geometry.hasAttribute(name);
    if (basins && has('color')) this.surface.material = this.basinMaterial;
    else if (difference && has('uv1')) this.surface.material = this.differenceMaterial;
    else this.surface.material = this.plainMaterial;
    this.edges.visible = edges;
    // Edges of a large mesh are only built when somebody wants to see them.
    if (edges && this.mesh && !this.edges.geometry.hasAttribute('position')) {
      this.edges.geometry = new WireframeGeometry(this.surface.geometry);
    }
    this.glyphs.group.visible = glyphs;
    if (criticalChanged && this.critical && this.mesh) {
      const { vertices, kinds } = this.critical;
      this.glyphs.set(vertices, kinds, this.mesh.positions, this.normals, this.glyphSize);
      this.drawRings();
    }
    this.draw();
  }

  private drawRings(): void {
    if (this.constrained && this.mesh)
      this.rings.set(this.constrained, this.mesh.positions, this.normals, this.ringSize);
    this.draw();
  }

  private get normals(): Float32Array {
    return this.surface.geometry.getAttribute('normal').array as Float32Array;
  }

  private get glyphSize(): number {
    return glyphRadius(this.mesh!.area, this.critical?.vertices.length ?? 0);
  }

  /** Around glyphs, and no smaller where the glyphs are many and the constraints few. */
  private get ringSize(): number {
    const count = this.constrained?.features.length ?? 0;
    return RING * Math.max(this.glyphSize, Math.min(0.014, glyphRadius(this.mesh!.area, 4 * count)));
  }

  /** The constrained vertex or the critical point whose sign is there, else the nearest corner of the triangle. */
  private vertexAt(clientX: number, clientY: number): number | null {
    const { mesh, model, surface } = this;
    if (!mesh || !model.visible) return null;
    const hit = hitOf(surface, model, this.camera, this.canvas, clientX, clientY);
    if (!hit) return null;
    const nearest = (vertices: Iterable<number>, reach: number): number | null =>
      nearestOf(vertices, mesh.positions, hit.place, reach);
    const marked = nearest(this.constrained?.features ?? [], this.ringSize);
    const critical = this.layers.glyphs ? nearest(this.critical?.vertices ?? [], this.glyphSize) : null;
    return marked ?? critical ?? nearest(hit.corners, Infinity);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
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

/** Texture coordinates that look shades up in a colour map. */
function along(shades: Float32Array): BufferAttribute {
  const uv = new Float32Array(2 * shades.length);
  for (let i = 0; i < shades.length; i++) {
    // From the middle of the first texel to the middle of the last.
    uv[2 * i] = (0.5 + (SAMPLES - 1) * shades[i]!) / SAMPLES;
    uv[2 * i + 1] = 0.5;
  }
  return new BufferAttribute(uv, 2);
}

function textureOf(bytes: Uint8Array<ArrayBuffer>): DataTexture {
  const texture = new DataTexture(bytes, SAMPLES, 1);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Joins the cameras of two views. */
export function link(first: Viewer, second: Viewer): void {
  first.onMove = () => second.copyCamera(first);
  second.onMove = () => first.copyCamera(second);
}
