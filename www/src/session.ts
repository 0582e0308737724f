/**
 * One open mesh, inside the worker: its fields, its smoother, and what was last computed from which settings.
 *
 * An update recomputes what depends on a changed setting and sends only that. It has two stages, before and after; a stage
 * that fails sends nothing, so that the page goes on with what it had.
 */
import { Smoother, writeMesh } from 'morse-smooth';
import type { MeshFile, TriMesh } from 'morse-smooth';
import { displayMesh, placementOf, rangeOf, segmentsOf, shadesOf } from './display';
import type { Placement } from './display';
import { Refusal } from './failure';
import type { FieldEntry, Part, Settings, Side } from './protocol';

export type Send = (part: Part) => void;

const AXES = ['x', 'y', 'z'] as const;

export class Session {
  readonly name: string;
  /** The settings of what the page shows now; null until the first update succeeded. */
  settings: Settings | null = null;

  private readonly file: MeshFile;
  private readonly mesh: TriMesh;
  private readonly positions: Float64Array;
  private readonly placement: Placement;
  private readonly entries: FieldEntry[];
  private readonly fields = new Map<string, Float64Array>();
  private smoother: Smoother | null = null;
  private smoothed: Float64Array | null = null;
  /** Key of a smoothing that is not to be tried again, since it took too long. */
  private leftOut: string | null = null;
  /** Key of the settings behind each thing that the page holds. */
  private readonly sent = new Map<string, string>();

  constructor(
    file: MeshFile,
    name: string,
    private readonly onProgress: (fraction: number) => void,
  ) {
    this.file = file;
    this.mesh = file.mesh;
    this.name = name;
    this.positions = file.mesh.positions();
    this.placement = placementOf(this.positions);
    this.entries = [];
    for (const [label, values] of Object.entries(file.fields))
      this.enter({ key: `file:${label}`, label, origin: 'file' }, values);
    // A mesh without any field still has something to look at: its own coordinates.
    AXES.forEach((axis, offset) => {
      const values = new Float64Array(this.mesh.vertexCount);
      for (let i = 0; i < values.length; i++) values[i] = this.positions[3 * i + offset]!;
      this.enter({ key: `coordinate:${axis}`, label: `${axis} coordinate`, origin: 'coordinate' }, values);
    });
  }

  describe(send: Send, chosen: string): void {
    const { vertexCount, edgeCount, triangleCount, topology } = this.mesh;
    const { format, warnings } = this.file;
    send({
      kind: 'mesh',
      summary: { name: this.name, format, vertexCount, edgeCount, triangleCount, topology, warnings },
      mesh: displayMesh(this.mesh, this.positions, this.placement),
    });
    this.sendFields(send, chosen);
  }

  sendFields(send: Send, chosen: string): void {
    send({ kind: 'fields', fields: [...this.entries], chosen });
  }

  /** What to try to open the mesh with: the wanted field, or all of them where there is none of that key. */
  candidates(wanted: string): string[] {
    return this.fields.has(wanted) ? [wanted] : this.entries.map(({ key }) => key);
  }

  /** Refuses a field of the wrong length with both numbers, before anything else sees it. */
  addField(name: string, values: Float64Array): string {
    const { vertexCount } = this.mesh;
    if (values.length !== vertexCount) {
      throw new Refusal(
        'LengthMismatch',
        `${name} has ${values.length.toLocaleString('en')} values, but ${this.name} has ${vertexCount.toLocaleString('en')} vertices`,
      );
    }
    this.mesh.criticalPoints(values);
    const key = `added:${name}`;
    this.enter({ key, label: name, origin: 'added' }, values);
    // A field of a known name may have new values.
    this.sent.clear();
    return key;
  }

  save(send: Send): void {
    const { settings, smoothed } = this;
    if (!settings || !smoothed) throw new Refusal('NothingToSave', 'There is no smoothed field yet.');
    const label = this.labelOf(settings.field);
    const fields = { [label]: this.fields.get(settings.field)!, [`${label}_smoothed`]: smoothed };
    const bytes = writeMesh(this.mesh, { format: 'ply', fields: plainNames(fields), binary: true });
    const stem = this.name.replace(/\.[^.]*$/, '');
    send({ kind: 'saved', name: `${stem}_smoothed.ply`, bytes: new Uint8Array(bytes) });
  }

  /** The page goes on without a smoothed field until something that it depends on changes. */
  leaveOut(): void {
    if (this.settings) this.leftOut = smoothingKey(this.settings);
  }

  free(): void {
    this.smoother?.free();
    this.mesh.free();
  }

  /** `announce` runs when the field has proved usable and nothing has been sent yet. */
  updateBefore(wanted: Settings, send: Send, announce?: () => void): void {
    const field = this.known(wanted.field);
    const values = this.fields.get(field)!;
    const parts: Part[] = [];
    const keys: [string, string][] = [];
    const stage = (slot: string, key: string, make: () => Part): void => {
      if (this.sent.get(slot) === key) return;
      parts.push(make());
      keys.push([slot, key]);
    };
    stage('values', field, () => {
      const range = rangeOf(values);
      return { kind: 'values', side: 'before', label: this.labelOf(field), range, shades: shadesOf(values, range) };
    });
    stage('before.critical', `${field} ${wanted.delta} ${wanted.link}`, () => this.critical('before', values, wanted));
    stage('before.lines', `${field} ${wanted.levels}`, () =>
      this.lines('before', values, levelsOf(values, wanted.levels)),
    );

    announce?.();
    if (keys.some(([slot]) => slot === 'values')) {
      this.smoothed = null;
      for (const slot of ['smoothed', 'after.critical', 'after.lines']) this.sent.delete(slot);
    }
    for (const [slot, key] of keys) this.sent.set(slot, key);
    parts.forEach(send);
    const { metric, epsilon } = this.settings ?? wanted;
    this.settings = { ...wanted, field, metric, epsilon };
  }

  updateAfter(wanted: Settings, send: Send): void {
    const field = this.known(wanted.field);
    const before = this.fields.get(field)!;
    const key = smoothingKey({ ...wanted, field });
    if (key === this.leftOut) return;
    this.leftOut = null;
    if (this.sent.get('smoothed') !== key || !this.smoothed) {
      const start = performance.now();
      // Kept for the mesh: its operators and symbolic factors serve every ε and every field.
      this.smoother ??= new Smoother(this.mesh, { onProgress: ({ fraction }) => this.onProgress(fraction) });
      const { values, report } = this.smoother.tikhonov(before, { epsilon: wanted.epsilon, metric: wanted.metric });
      const milliseconds = performance.now() - start;
      this.smoothed = values;
      this.sent.set('smoothed', key);
      // Coloured by the range of the input, so that a loss of amplitude shows.
      const shades = shadesOf(values, rangeOf(before));
      send({ kind: 'values', side: 'after', label: this.labelOf(field), range: rangeOf(values), shades });
      send({ kind: 'report', report, milliseconds });
    }
    const values = this.smoothed;
    const criticalKey = `${key} ${wanted.delta} ${wanted.link}`;
    if (this.sent.get('after.critical') !== criticalKey) {
      send(this.critical('after', values, wanted));
      this.sent.set('after.critical', criticalKey);
    }
    const linesKey = `${key} ${wanted.levels}`;
    if (this.sent.get('after.lines') !== linesKey) {
      send(this.lines('after', values, levelsOf(before, wanted.levels)));
      this.sent.set('after.lines', linesKey);
    }
    this.settings = { ...wanted, field };
  }

  private critical(side: Side, values: Float64Array, { delta, link }: Settings): Part {
    const found = this.mesh.criticalPoints(values, { delta, link });
    return {
      kind: 'critical',
      side,
      delta,
      counts: found.counts,
      vertices: new Uint32Array(found.vertices),
      kinds: new Int8Array(found.kinds),
    };
  }

  private lines(side: Side, values: Float64Array, levels: number[]): Part {
    const found = this.mesh.levelSets(values, levels);
    return { kind: 'lines', side, levels, segments: segmentsOf(found, this.placement) };
  }

  private enter(entry: FieldEntry, values: Float64Array): void {
    const known = this.entries.findIndex(({ key }) => key === entry.key);
    if (known >= 0) this.entries[known] = entry;
    else if (entry.origin === 'added') this.entries.unshift(entry);
    else this.entries.push(entry);
    this.fields.set(entry.key, values);
  }

  /** A request may have been made while another mesh, with other fields, was still shown. */
  private known(field: string): string {
    return this.fields.has(field) ? field : (this.settings?.field ?? this.entries[0]!.key);
  }

  private labelOf(key: string): string {
    return this.entries.find((entry) => entry.key === key)?.label ?? key;
  }
}

function smoothingKey({ field, metric, epsilon }: Settings): string {
  return `${field} ${metric} ${epsilon}`;
}

/**
 * Evenly spaced inside the range, ends left out. The same levels serve both sides: lines that move are then the field's
 * doing and not the choice of levels.
 */
function levelsOf(values: Float64Array, count: number): number[] {
  const [low, high] = rangeOf(values);
  if (!(high > low)) return [];
  return Array.from({ length: count }, (_, k) => low + ((high - low) * (k + 1)) / (count + 1));
}

/** PLY property names are single words. */
function plainNames(fields: Record<string, Float64Array>): Record<string, Float64Array> {
  return Object.fromEntries(Object.entries(fields).map(([name, values]) => [name.replace(/[^\w.-]+/g, '_'), values]));
}
