/** The page: joins the controls, the worker, the two views and the plots. What is computed, and when, is the worker's business. */
import type { SolidSize } from 'morse-smooth/snapshot';
import { Client } from './client';
import { Colors } from './colors';
import { Controls } from './controls';
import { about, download, element, input } from './dom';
import { acceptDrops, isFieldName } from './drop';
import { DEFAULT_VIEW, EXAMPLES, fetchExample } from './examples';
import type { Example } from './examples';
import { Panel } from './panel';
import type { MeshSummary, Part, Request, Settings } from './protocol';
import { NO_OVERRIDES } from './reading/pairs';
import { Paths } from './reading/paths';
import { Reading } from './reading/reading';
import type { Lit } from './reading/reading';
import { clearReport, showMesh, showReport } from './readout';
import { Choosing } from './smoothing/choosing';
import { Constraining } from './smoothing/constraining';
import { MovingEpsilon } from './smoothing/epsilon';
import { ReportPanel } from './smoothing/report';
import { ChosenExtrema, EXACT_PREVIEW } from './smoothing/extrema';
import { INITIAL_SMOOTHING, isExact, smoothingKey } from './smoothing/settings';
import { describe, Status } from './status';
import { makeTabs } from './tabs';
import { link } from './viewer';

const OPENING = EXAMPLES[0]!;
const INITIAL: Settings = {
  ...INITIAL_SMOOTHING,
  field: '',
  epsilon: OPENING.epsilon,
  delta: 0,
  link: 'consecutive',
  levels: OPENING.levels,
  levelPlaces: 'even',
  persistence: 0.1,
  overrides: NO_OVERRIDES,
  coloring: 'value',
  colormap: 'viridis',
  bands: false,
  complex: false,
  paths: false,
};

/** For another mesh: pairs and vertices are those of one. */
const NO_DECISIONS = { overrides: NO_OVERRIDES, picked: [] } as const;

/** What was opened last, kept so that it can be given to a new worker. */
interface Source {
  file: File;
  example: Example | null;
  added: File[];
}

const status = new Status();
const panels = { before: new Panel('before'), after: new Panel('after') };
if (panels.before.viewer && panels.after.viewer) link(panels.before.viewer, panels.after.viewer);
const colors = new Colors(panels);
const report = new ReportPanel();

let source: Source | null = null;
/** Becomes `source` when the worker has accepted it. */
let offered: Source | null = null;
let shown: { summary: MeshSummary; size: SolidSize } | null = null;
let accepted: Settings = INITIAL;
let lit: Lit | null = null;
let wantsPaths = false;
let paths: Paths | null = null;
/** Counts examples asked for, so that a slow download does not overtake a later choice. */
let choice = 0;

const controls = new Controls(EXAMPLES, INITIAL, {
  settings: change,
  field: () => {
    forgetDecisions();
    update();
  },
  epsilon: moveEpsilon,
  delta: showDelta,
  persistence: (value) => {
    reading.setThreshold(value);
    change();
  },
  layers: (layers) => eachViewer((viewer) => viewer.setLayers(layers)),
  example: (id) => void openExample(EXAMPLES.find((example) => example.id === id) ?? OPENING),
  meshFile: (file) => openFiles([file]),
  fieldFile: addField,
  resetView,
  save: () => ask({ kind: 'save' }),
  picture: savePicture,
  stop,
});

const reading = new Reading({
  delta: (value) => {
    controls.writeDelta(value);
    controls.changeDelta();
  },
  deltaEnd: (value) => controls.setDeltaEnd(value),
  threshold: (value) => {
    controls.writePersistence(value);
    controls.changePersistence();
  },
  overrides: change,
  toggle: (ends) => constraining.toggle(ends),
  lit: light,
  kept: () => markExtrema(),
});
const constraining = new Constraining({
  picked: update,
  rule: (rule) => controls.writeRule(rule),
  marked: (found) => {
    for (const panel of Object.values(panels)) panel.setConstrained(found);
  },
  chosen: (vertices) => reading.setChosen(vertices),
  point: (point) => {
    for (const panel of Object.values(panels)) panel.setSpot(point);
  },
  extremum: (vertex) => reading.toggleAt(vertex),
});
const extrema = new ChosenExtrema(reading, constraining);
const moving = new MovingEpsilon({
  preview: (whole) => client.run({ kind: 'preview', settings: readSettings(), whole }),
  rest: update,
});
const choosing = new Choosing({
  epsilon: (value) => {
    controls.writeEpsilon(value);
    moveEpsilon();
  },
  choose: (rule) => ask({ kind: 'choose', rule }),
});
for (const handle of [input('epsilon'), input('persistence'), ...choosing.handles]) moving.holdBy(handle);
eachViewer((viewer) => {
  viewer.onPick = (vertex) => constraining.toggle([vertex]);
});
makeTabs(element('.tabs', HTMLElement));
reading.setState(INITIAL.delta, INITIAL.persistence, INITIAL.overrides);

const client = new Client({
  part: show,
  progress: (fraction) => status.progress(fraction),
  working: (request) => {
    if (request.kind !== 'preview') status.working(describe(request));
  },
  done: (request, settings) => {
    if (request.kind === 'preview') return;
    showPreview(null);
    if (request.kind === 'addField') {
      source?.added.push(request.file);
      if (!client.busy) forgetDecisions();
    }
    if (request.kind === 'open' && !request.smooth)
      panels.after.say('Stopped. Another ε, metric or field smooths again.');
    if (settings) accepted = settings;
    status.dismiss();
  },
  failed: (_request, failure, settings) => {
    showPreview(null);
    status.fail(failure);
    offered = null;
    if (client.lost) moving.canPreview = false;
    if (settings) accepted = settings;
    // Back to what is shown, unless the user has already asked for something else.
    if (settings && !client.busy) writeSettings(settings);
    showSource();
    for (const panel of Object.values(panels))
      if (panel.awaiting) panel.say(shown ? 'There is no smoothed field.' : 'No mesh is open.');
  },
  idle: () => {
    if (!moving.moving) status.idle();
  },
});

function readSettings(): Settings {
  return { ...controls.read(), overrides: reading.overrides, picked: constraining.vertices, paths: wantsPaths };
}

function writeSettings(settings: Settings): void {
  moving.settle();
  controls.write(settings);
  reading.setState(settings.delta, settings.persistence, settings.overrides);
  constraining.vertices = settings.picked;
  for (const panel of Object.values(panels)) panel.setDelta(settings.delta);
  showChoices();
}

/** They are about the pairs of one field. */
function forgetDecisions(): void {
  const { delta, persistence } = controls.read();
  reading.setState(delta, persistence, NO_OVERRIDES);
}

function eachViewer(use: (viewer: NonNullable<Panel['viewer']>) => void): void {
  for (const { viewer } of Object.values(panels)) if (viewer) use(viewer);
}

// ---------------------------------------------------------------- what the worker sends

function show(part: Part): void {
  switch (part.kind) {
    case 'mesh':
      return showNewMesh(part);
    case 'fields':
      return controls.setFields(part.fields, part.chosen);
    case 'values':
      return showValues(part);
    case 'colors':
      return colors.setTable(part.colors, part.bands);
    case 'hierarchy':
      reading.setHierarchy(part.side, part.hierarchy);
      if (part.side === 'before') constraining.setHierarchy(part.hierarchy);
      if (shown) panels[part.side].setHierarchy(part, shown.size, controls.read().delta);
      return;
    case 'pairs':
      reading.setPairs(part.pairs, part.range);
      return constraining.setPairs(part.pairs);
    case 'pairsAfter':
      return reading.setResult(part.pairs);
    case 'lines':
      panels[part.side].viewer?.setLines(['levels'], part.lines ? [part.lines] : []);
      if (part.side === 'before') colors.setLevels(part.levels);
      return;
    case 'complex':
      return panels[part.side].viewer?.setLines(['descending', 'ascending'], part.lines);
    case 'arcs':
      paths = new Paths(part.arcs);
      return light(lit);
    case 'basins':
      return colors.setBasins(part);
    case 'constraints':
      return constraining.setFound(part.found);
    case 'difference':
      return colors.setDifference(part);
    case 'report':
      controls.setSaveable(true);
      extrema.report = part.report.exact;
      markExtrema();
      report.show(part.report);
      return showReport(part.report);
    case 'unsmoothed':
      return clearAfter(part.reason.message);
    case 'family':
      moving.canPreview = part.state === 'growing' || part.state === 'complete';
      return choosing.setFamily(part);
    case 'epsilonCurve':
      return choosing.setCurve(part.curve);
    case 'choices':
      return choosing.setChoices(part.choices);
    case 'chosen':
      controls.writeEpsilon(part.choice.epsilon);
      choosing.setChosen(part.choice);
      return update();
    case 'previewed':
      return showPreview(part.error === null ? EXACT_PREVIEW : `Preview, error ${about(part.error)}`);
    case 'preview':
      // Of the field after there are no counts at other δ on the way.
      reading.setHierarchy('after', null);
      reading.setResult(null);
      return panels.after.setPreview(part);
    case 'saved':
      return download(part.name, part.bytes);
  }
}

function showNewMesh({ summary, look }: Extract<Part, { kind: 'mesh' }>): void {
  const isNew = offered !== null;
  shown = { summary, size: look.size };
  source = offered ?? source;
  offered = null;
  showMesh(summary);
  controls.setUnits({ meanEdge: summary.meanEdge });
  constraining.setMesh(summary.topology.components);
  showSource();
  eachViewer((viewer) => viewer.setMesh(look, source?.example?.up ?? look.surface.up));
  if (isNew) resetView();
}

function showValues({ side, label, range, shades, gap, gaps }: Extract<Part, { kind: 'values' }>): void {
  panels[side].setShades(label, shades, gap);
  if (side === 'after') return;
  paths = null;
  colors.setField(label, range, gap);
  controls.setGaps(gaps);
  controls.setUnits({ width: range[1] - range[0] });
  controls.setDrawable();
  // The field is another one: what stands on the other side belongs to the last.
  clearAfter('Smoothing…');
}

/** `text`: why there is nothing. */
function clearAfter(text: string): void {
  panels.after.clear(text);
  reading.setHierarchy('after', null);
  reading.setResult(null);
  extrema.report = null;
  colors.clearDifference();
  moving.canPreview = false;
  choosing.clear(text);
  clearReport();
  report.clear(text);
  controls.setSaveable(false);
}

/** Names what is open; also puts the list back when something else could not be opened. */
function showSource(): void {
  if (source) controls.showSource(source.example?.id ?? null, source.file.name);
}

// ---------------------------------------------------------------- what the user asks for

function update(): void {
  moving.settle();
  showChoices();
  ask({ kind: 'update', settings: readSettings() });
}

/** For the mesh that is open: a worker that broke down has to be given it again. */
function ask(request: Request): void {
  // What is saved, and what a field is added to, is not a preview.
  if (moving.moving) update();
  if (client.lost && source) open(source, accepted, !panels.after.awaiting);
  client.run(request);
}

function open(next: Source, settings: Settings, smooth = true): void {
  client.run({ kind: 'open', file: next.file, added: next.added, settings, smooth });
}

async function openExample(example: Example): Promise<void> {
  const mine = ++choice;
  status.working(`Fetching ${example.label}…`);
  try {
    const file = await fetchExample(example);
    if (mine !== choice) return;
    const { field, epsilon, levels } = example;
    writeSettings({ ...readSettings(), epsilon, levels, delta: 0, ...NO_DECISIONS });
    offered = { file, example, added: [] };
    open(offered, { ...readSettings(), field });
  } catch (error) {
    complain('NotFetched', `The example could not be fetched. ${error instanceof Error ? error.message : ''}`);
  }
}

/** The mesh first, then the fields, whatever order they were dropped in. */
function openFiles(files: File[]): void {
  const mesh = files.find(({ name }) => !isFieldName(name));
  if (mesh) {
    choice += 1;
    offered = { file: mesh, example: null, added: [] };
    writeSettings({ ...readSettings(), delta: 0, ...NO_DECISIONS });
    open(offered, { ...readSettings(), field: '' });
  }
  for (const file of files) if (isFieldName(file.name)) addField(file);
}

function addField(file: File): void {
  ask({ kind: 'addField', file, settings: { ...readSettings(), overrides: NO_OVERRIDES } });
}

/** A worker that computes cannot listen: ending it is the only way to make it stop. */
function stop(): void {
  client.restart();
  moving.canPreview = false;
  offered = null;
  if (source) {
    writeSettings(accepted);
    showSource();
    // Smoothing is left out where it was the very thing that took too long.
    open(source, accepted, !panels.after.awaiting);
  } else {
    complain('Stopped', 'Nothing is open. Choose an example or open a mesh.');
  }
}

function complain(code: string, message: string): void {
  status.fail({ code, message });
  showSource();
  if (!client.busy) status.idle();
}

/** What does not wait for the worker. */
function showChoices(): void {
  const { coloring, method, rule, epsilon } = controls.read();
  markExtrema();
  choosing.setEpsilon(epsilon);
  colors.name(coloring);
  constraining.setMethod(method, rule);
}

/** At once: the page knows the critical points of every δ. */
function showDelta(delta: number): void {
  reading.setDelta(delta);
  for (const panel of Object.values(panels)) panel.setDelta(delta);
}

/** Shown from the family at once, where there is one, and solved for when it rests. */
function moveEpsilon(): void {
  choosing.setEpsilon(controls.read().epsilon);
  moving.moved(canPreviewExtrema());
}

/** A change to the choice of exact extrema has a preview; anything else is asked for. */
function change(): void {
  const settings = readSettings();
  if (!canPreviewExtrema() || smoothingKey(settings) === smoothingKey(accepted)) return update();
  showChoices();
  moving.moved(true);
}

/** A worker that broke down has to be given the mesh first. */
function canPreviewExtrema(): boolean {
  return isExact(controls.read()) && shown !== null && !client.lost;
}

function markExtrema(): void {
  extrema.mark(controls.read());
}

/** Null where what is shown is no preview. */
function showPreview(text: string | null): void {
  document.documentElement.toggleAttribute('data-preview', text !== null);
  if (text !== null) status.preview(text);
}

/** The ways between pairs are asked for when somebody first points at one. */
function light(pair: Lit | null): void {
  lit = pair;
  const path = pair ? paths?.between(pair) : undefined;
  for (const panel of Object.values(panels)) panel.setLit(pair, path);
  if (!pair || wantsPaths) return;
  wantsPaths = true;
  update();
}

/** What both views show, from where they show it. */
function savePicture(): void {
  const { glyphs, levels } = controls.layers;
  ask({ kind: 'picture', view: { camera: panels.before.viewer?.direction ?? null, glyphs, levels } });
}

function resetView(): void {
  panels.before.viewer?.frameMesh(source?.example?.view ?? DEFAULT_VIEW);
}

acceptDrops(openFiles);
// An address can name the example to open: …/#torus.
void openExample(EXAMPLES.find(({ id }) => location.hash === `#${id}`) ?? OPENING);
