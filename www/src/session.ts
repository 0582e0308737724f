/**
 * One open mesh, inside the worker: its fields, its smoother, and what was last computed from which settings.
 *
 * An update recomputes what depends on a changed setting and sends only that. It has two stages, before and after; a stage
 * that fails sends nothing, so that the page goes on with what it had.
 */
import type { PersistencePairs, TriMesh } from 'morse-smooth';
import type { MeshFile } from 'morse-smooth/files';
import { Scene } from 'morse-smooth/snapshot';
import type { Solids } from 'morse-smooth/snapshot';
import { colorBasins } from './basins';
import { complexLines, differencePart, levelLines, lookOf, pictureOf, rangeOption } from './drawing';
import { Refusal } from './failure';
import { arcsOf, hierarchyOf, levelsOf, pairsOf } from './findings';
import { fieldFrom, gapsIn, omitting, shapeOf } from './gaps';
import type { Field } from './gaps';
import { meanEdgeOf, rangeOf } from './measures';
import type { Coloring, FieldEntry, Found, Hierarchy, Part, PictureView, Settings, Side } from './protocol';
import { findConstraints, nothingHeld, partUnheld } from './smoothing/constraints';
import { fileOf, plainName } from './saving';
import { Families, whyNoFamily } from './smoothing/family';
import { Methods } from './smoothing/methods';
import { isQuick, quickPart } from './smoothing/preview';
import {
  constraintsKey,
  familyKey,
  hasConstraints,
  isExact,
  smoothingKey,
  smoothingOf,
  suffixOf,
  usesDelta,
  usesPairs,
} from './smoothing/settings';

export type Send = (part: Part) => void;

const AXES = ['x', 'y', 'z'] as const;

export class Session {
  readonly name: string;
  /** The settings of what the page shows now; null until the first update succeeded. */
  settings: Settings | null = null;

  private readonly file: MeshFile;
  private readonly mesh: TriMesh;
  private readonly positions: Float64Array;
  private readonly scene: Scene;
  private readonly entries: FieldEntry[];
  private readonly fields = new Map<string, Field>();
  private readonly triangles: Uint32Array;
  private readonly meanEdge: number;
  private readonly methods: Methods;
  /** Of the settings behind the field after. */
  readonly families: Families;
  private smoothed: Float64Array | null = null;
  /** How long it took. */
  private milliseconds = 0;
  /** Whether the page shows another ε than that of the settings. */
  private isPreview = false;
  /** The vertex of each corner of the surface. */
  private corners: Uint32Array | null = null;
  /** Of the field before. */
  private pairs: PersistencePairs | null = null;
  /** Of the field before. */
  private found: Found | null = null;
  /** Where the lines on both sides are. */
  private levels: number[] = [];
  /** The colors of the basins before, by their extrema. */
  private basinColors: ReadonlyMap<number, number> = new Map();
  /** Key of a smoothing that is not to be tried again, since it took too long. */
  private leftOut: string | null = null;
  /** Key of the settings behind each thing that the page holds. */
  private readonly sent = new Map<string, string>();

  /** The mesh is the one that was made of the file, and freed with the session. */
  constructor(file: MeshFile, mesh: TriMesh, name: string, onProgress: (fraction: number) => void) {
    this.file = file;
    this.mesh = mesh;
    this.name = name;
    this.positions = mesh.positions();
    this.triangles = mesh.triangles();
    this.scene = new Scene(this.positions, this.triangles);
    this.meanEdge = meanEdgeOf(this.positions, this.triangles);
    this.methods = new Methods(this.mesh, this.meanEdge, onProgress);
    this.families = new Families(onProgress);
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
    const { format } = this.file;
    const warnings = [...this.file.warnings, ...this.mesh.warnings];
    const { name, meanEdge } = this;
    send({
      kind: 'mesh',
      summary: { name, format, vertexCount, edgeCount, triangleCount, topology, meanEdge, warnings },
      look: lookOf(this.scene, vertexCount, this.triangles),
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

  /** What the values of a field are told by: nothing where the file has other vertices than the mesh. */
  get counts(): { vertices?: number; triangles?: number } {
    const { vertexCount: vertices, triangleCount: triangles } = this.mesh;
    return this.file.vertexMap === null ? { vertices, triangles } : {};
  }

  /**
   * A field with a value for each vertex of the mesh, or of the file where some of its vertices were left out. Refuses one of another length
   * with both numbers, before anything else sees it.
   */
  addField(name: string, given: Float64Array): string {
    const { vertexCount } = this.mesh;
    const map = this.file.vertexMap;
    const isOfFile = map !== null && given.length !== vertexCount && map.every((vertex) => vertex < given.length);
    const values = isOfFile ? Float64Array.from(map, (vertex) => given[vertex]!) : given;
    if (values.length !== vertexCount) {
      throw new Refusal(
        'LengthMismatch',
        `${name} has ${values.length.toLocaleString('en')} values, but ${this.name} has ${vertexCount.toLocaleString('en')} vertices`,
      );
    }
    this.mesh.criticalPoints(values, omitting(values));
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
    const suffix = suffixOf(settings);
    const fields = { [label]: this.fields.get(settings.field)!.values, [`${label}_${suffix}`]: smoothed };
    const bytes = fileOf(this.positions, this.triangles, fields);
    send({ kind: 'saved', name: `${this.stem}_${suffix}.ply`, bytes });
  }

  /** What the page shows, as a picture. */
  draw(view: PictureView, send: Send): void {
    const { settings, smoothed, levels } = this;
    if (!settings) throw new Refusal('NothingToSave', 'There is no field yet.');
    const before = this.fields.get(settings.field)!.known;
    const label = this.labelOf(settings.field);
    const subject = { before, after: smoothed, range: rangeOf(before), levels, title: `${this.name}, ${label}` };
    const bytes = pictureOf(this.scene, subject, settings, view);
    send({ kind: 'saved', name: `${this.stem}_${plainName(label)}.png`, bytes: new Uint8Array(bytes) });
  }

  /** The page goes on without a smoothed field until something that it depends on changes. */
  leaveOut(): void {
    if (this.settings) this.leftOut = smoothingKey(this.settings);
  }

  free(): void {
    this.families.drop();
    this.methods.free();
    this.scene.free();
    this.mesh.free();
  }

  /** `announce` runs when the field has proved usable and nothing has been sent yet. */
  updateBefore(wanted: Settings, send: Send, announce?: () => void): void {
    const field = this.known(wanted.field);
    const { known: values, gaps } = this.fields.get(field)!;
    const holes = omitting(values);
    const parts: Part[] = [];
    const keys: [string, string][] = [];
    const isDue = (slot: string, key: string): boolean => {
      if (this.sent.get(slot) === key) return false;
      keys.push([slot, key]);
      return true;
    };
    let { pairs, found, levels, basinColors } = this;

    const isNew = isDue('values', field);
    const hierarchy = isDue('before.hierarchy', `${field} ${wanted.link}`)
      ? hierarchyOf(this.mesh, values, wanted)
      : null;
    if (isDue('before.pairs', field) || !pairs) {
      pairs = this.mesh.persistence(values, holes);
      parts.push({ kind: 'pairs', range: rangeOf(values), pairs: pairsOf(pairs, values) });
    }
    if (hasConstraints(wanted) && isDue('before.constraints', constraintsKey({ ...wanted, field }))) {
      found = findConstraints(this.mesh, wanted, values, pairs);
      parts.push({ kind: 'constraints', found: copied(found) });
    }
    const { complex, coloring, colormap, bands, persistence } = wanted;
    const lines = isDue('before.lines', linesKey(field, wanted)) ? levelsOf(this.mesh, values, pairs, wanted) : null;
    const separatrices = complex && isDue('before.complex', `${field} ${persistence}`) ? { persistence } : null;
    const isPainted = isDue('colors', `${colormap} ${bands ? linesKey(field, wanted) : ''}`);
    if (isNew || hierarchy || lines || separatrices || isPainted) {
      const list = this.scene.drawList(values, {
        colormap,
        bands,
        levels: lines ?? (isPainted && bands ? levels : []),
        criticalPoints: hierarchy ?? false,
        morseComplex: separatrices
          ? this.mesh.morseComplex(values, { ...separatrices, paths: 'merged', ...holes })
          : false,
        ...holes,
      });
      const { range, shades, gap, colors, solids } = list;
      if (lines) levels = [...list.levels];
      const drawn: Part[] = [];
      if (isNew) drawn.push({ kind: 'values', side: 'before', label: this.labelOf(field), range, shades, gap, gaps });
      if (isPainted) drawn.push({ kind: 'colors', colors, bands });
      if (hierarchy) drawn.push(this.hierarchyPart('before', values, hierarchy, solids));
      if (lines) drawn.push({ kind: 'lines', side: 'before', lines: levelLines(list), levels });
      if (separatrices) drawn.push({ kind: 'complex', side: 'before', lines: complexLines(list) });
      // The values come before all that is about them.
      parts.unshift(...drawn);
    }
    if (isByBasins(coloring) && isDue('before.basins', `${field} ${persistence} ${coloring}`)) {
      const { part, byExtremum } = this.basins('before', values, coloring, persistence);
      basinColors = byExtremum;
      parts.push(part);
    }
    if (wanted.paths && isDue('before.arcs', field)) parts.push({ kind: 'arcs', arcs: arcsOf(this.mesh, values) });

    announce?.();
    if (keys.some(([slot]) => slot === 'values')) this.forgetAfter();
    Object.assign(this, { pairs, found, levels, basinColors });
    for (const [slot, key] of keys) this.sent.set(slot, key);
    parts.forEach(send);
    // What belongs to the other side is still what it was.
    const last = this.settings ?? wanted;
    this.settings = { ...wanted, ...smoothingOf(last), field };
    if (field !== last.field) return;
    const { persistence: threshold, overrides, delta, link } = last;
    if (usesPairs(last) && usesPairs(wanted)) Object.assign(this.settings, { persistence: threshold, overrides });
    if (usesDelta(last) && usesDelta(wanted)) Object.assign(this.settings, { delta, link });
  }

  updateAfter(wanted: Settings, send: Send): void {
    const field = this.known(wanted.field);
    const given = this.fields.get(field)!;
    const key = smoothingKey({ ...wanted, field });
    if (key === this.leftOut) return;
    this.leftOut = null;
    if (this.sent.get('smoothed') !== key || !this.smoothed) {
      if (!this.smooth(given, { ...wanted, field }, key, send)) return;
    }
    this.settings = { ...wanted, field };
    this.isPreview = false;
    this.showAfter(this.smoothed!, this.settings, key, send);
    this.prepareFamily(given, this.settings, send);
  }

  private prepareFamily(field: Field, settings: Settings, send: Send): void {
    const found = hasConstraints(settings) ? this.found : null;
    const job = {
      key: familyKey(settings),
      why: whyNoFamily(settings, this.mesh.vertexCount),
      cost: this.milliseconds,
      make: () => this.methods.family(field, settings, found),
    };
    this.families.prepare(job, send);
  }

  /** Shows another ε or choice, without a report, where its field is at hand; what is saved stays what it was. */
  preview(wanted: Settings, whole: boolean, send: Send): void {
    const settings = { ...wanted, field: this.known(wanted.field) };
    const read = isExact(settings)
      ? this.previewExact(settings, send)
      : this.families.read(familyKey(settings), settings.epsilon);
    if (!read) return;
    const { values, error } = read;
    send({ kind: 'previewed', error });
    this.isPreview = true;
    if (whole || isQuick(this.mesh)) return this.showAfter(values, settings, `preview ${smoothingKey(settings)}`, send);
    this.forgetShown();
    const { coloring } = settings;
    const before = this.fields.get(settings.field)!;
    this.corners ??= this.scene.surface().vertices;
    send(quickPart(this.mesh, values, this.corners, before, settings));
    if (isExact(settings)) send(this.pairsAfter(values));
    if (isByBasins(coloring)) send(this.basins('after', values, coloring, 0).part);
    if (coloring === 'difference') send(differencePart(this.scene, before.known, values));
  }

  private previewExact(settings: Settings, send: Send): { values: Float64Array; error: null } | null {
    const { pairs } = this;
    if (!pairs || settings.field !== this.settings?.field) return null;
    try {
      const { values } = this.methods.exact(this.fields.get(settings.field)!, settings, pairs, true);
      return { values, error: null };
    } catch (error) {
      this.endPreview(send);
      throw error;
    }
  }

  /** After a preview that came to nothing the page gets back what it had. */
  endPreview(send: Send): void {
    if (this.isPreview && this.settings && this.smoothed) this.updateAfter(this.settings, send);
  }

  /** Sends what is due of the side after. `key`: everything that the values depend on. */
  private showAfter(values: Float64Array, wanted: Settings, key: string, send: Send): void {
    const { field } = wanted;
    const before = this.fields.get(field)!.known;
    const holes = omitting(values);
    const parts: Part[] = [];
    const keys: [string, string][] = [];
    const isDue = (slot: string, slotKey: string): boolean => {
      if (this.sent.get(slot) === slotKey) return false;
      keys.push([slot, slotKey]);
      return true;
    };
    const { complex, coloring, persistence } = wanted;
    const isNew = isDue('after.values', key);
    const hierarchy = isDue('after.hierarchy', `${key} ${wanted.link}`) ? hierarchyOf(this.mesh, values, wanted) : null;
    const hasLines = isDue('after.lines', `${key} ${linesKey(field, wanted)}`);
    const hasComplex = complex && isDue('after.complex', key);
    if (isNew || hierarchy || hasLines || hasComplex) {
      const list = this.scene.drawList(values, {
        // Colored by the range of the input, so that a loss of amplitude shows.
        ...rangeOption(rangeOf(before)),
        levels: hasLines ? this.levels : [],
        criticalPoints: hierarchy ?? false,
        morseComplex: hasComplex && this.mesh.morseComplex(values, { persistence: 0, paths: 'merged', ...holes }),
        ...holes,
      });
      const { range, shades, gap, solids } = list;
      if (isNew) {
        const [label, gaps] = [this.labelOf(field), gapsIn(values)];
        parts.push({ kind: 'values', side: 'after', label, range, shades, gap, gaps });
      }
      if (hierarchy) parts.push(this.hierarchyPart('after', values, hierarchy, solids));
      if (hasLines) parts.push({ kind: 'lines', side: 'after', lines: levelLines(list), levels: this.levels });
      if (hasComplex) parts.push({ kind: 'complex', side: 'after', lines: complexLines(list) });
    }
    if (isDue('after.pairs', key)) parts.push(this.pairsAfter(values));
    // The colors follow those on the left, which depend on the threshold.
    if (isByBasins(coloring) && isDue('after.basins', `${key} ${persistence} ${coloring}`))
      parts.push(this.basins('after', values, coloring, 0).part);
    if (coloring === 'difference' && isDue('after.difference', key))
      parts.push(differencePart(this.scene, before, values));
    for (const [slot, slotKey] of keys) this.sent.set(slot, slotKey);
    parts.forEach(send);
  }

  /** False where there is nothing to hold the field with: that is said, and the page goes on without a smoothed field. */
  private smooth(before: Field, wanted: Settings, key: string, send: Send): boolean {
    const start = performance.now();
    const found = hasConstraints(wanted) ? this.found : null;
    try {
      if (found?.features.length === 0 && wanted.unconstrained === 'error') throw new Unheld();
      const { values, ...report } = this.methods.run(before, wanted, this.pairs!, found);
      this.smoothed = values;
      this.sent.set('smoothed', key);
      this.milliseconds = performance.now() - start;
      send({ kind: 'report', report: { ...report, milliseconds: this.milliseconds } });
      return true;
    } catch (error) {
      const reason = error instanceof Unheld ? nothingHeld(wanted) : partUnheld(error, this.mesh.topology.components);
      if (!reason) throw error;
      this.forgetAfter();
      this.settings = wanted;
      send({ kind: 'unsmoothed', reason });
      return false;
    }
  }

  private forgetAfter(): void {
    this.smoothed = null;
    this.families.drop();
    this.sent.delete('smoothed');
    this.forgetShown();
  }

  private forgetShown(): void {
    for (const slot of [...this.sent.keys()]) if (slot.startsWith('after.')) this.sent.delete(slot);
  }

  private hierarchyPart(side: Side, values: Float64Array, hierarchy: Hierarchy, solids: Solids[]): Part {
    // For the index sum, which is checked against the Euler characteristic.
    const { counts } = this.mesh.criticalPoints(values, omitting(values));
    return { kind: 'hierarchy', side, counts, hierarchy, solids, shape: shapeOf(this.mesh, values) };
  }

  private pairsAfter(values: Float64Array): Part {
    return { kind: 'pairsAfter', pairs: pairsOf(this.mesh.persistence(values, omitting(values)), values) };
  }

  private basins(side: Side, values: Float64Array, coloring: 'minima' | 'maxima', persistence: number) {
    const found = this.mesh.basins(values, { persistence, ...omitting(values) });
    const labels = coloring === 'minima' ? found.descending : found.ascending;
    const { colors, byExtremum } = colorBasins(labels, this.triangles, side === 'after' ? this.basinColors : undefined);
    const part: Part = { kind: 'basins', side, colors, count: byExtremum.size };
    return { part, byExtremum };
  }

  private enter(entry: FieldEntry, values: Float64Array): void {
    const known = this.entries.findIndex(({ key }) => key === entry.key);
    if (known >= 0) this.entries[known] = entry;
    else if (entry.origin === 'added') this.entries.unshift(entry);
    else this.entries.push(entry);
    this.fields.set(entry.key, fieldFrom(values, this.triangles));
  }

  /** A request may have been made while another mesh, with other fields, was still shown. */
  private known(field: string): string {
    return this.fields.has(field) ? field : (this.settings?.field ?? this.entries[0]!.key);
  }

  private get stem(): string {
    return this.name.replace(/\.[^.]*$/, '');
  }

  private labelOf(key: string): string {
    return this.entries.find((entry) => entry.key === key)?.label ?? key;
  }
}

/** No vertex is constrained at all: found out before the package is asked. */
class Unheld extends Error {}

const isByBasins = (coloring: Coloring): coloring is 'minima' | 'maxima' =>
  coloring === 'minima' || coloring === 'maxima';

/** What is sent is given away. */
function copied({ features, values, all }: Found): Found {
  return { features: features.slice(), values: values.slice(), all: all.slice() };
}

/** Everything that the levels depend on. */
function linesKey(field: string, { levels, levelPlaces, persistence, overrides }: Settings): string {
  return levelPlaces === 'even'
    ? `${field} ${levels}`
    : `${field} ${levels} ${persistence} ${JSON.stringify(overrides)}`;
}
