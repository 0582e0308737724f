/** The page's worker: loads the WebAssembly modules once and answers one request after the other. */
import init, { TriMesh, version } from 'morse-smooth';
import type { EpsilonRule } from 'morse-smooth';
import initFiles, { MorseSmoothError, readField, readMesh, readTable } from 'morse-smooth/files';
import initPictures from 'morse-smooth/snapshot';
import { failureOf, Refusal } from './failure';
import type { Part, Reply, Request, Settings } from './protocol';
import { Session } from './session';

/** The few members of a worker's global scope that are used; the DOM's types describe a window instead. */
interface WorkerScope {
  postMessage(message: Reply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}
const scope = globalThis as unknown as WorkerScope;

/** Milliseconds without a request, after which something else may be done; more while a slider moves. */
const QUIET = 250;
const QUIET_AFTER_PREVIEW = 400;

let session: Session | null = null;
let timer = 0;

/** Typed arrays move to the page instead of being copied; all of them were made for this message. */
function post(message: Reply): void {
  scope.postMessage(message, message.kind === 'part' ? [...buffersIn(message.part)] : []);
}

function buffersIn(value: unknown, found = new Set<ArrayBuffer>()): Set<ArrayBuffer> {
  if (ArrayBuffer.isView(value)) found.add(value.buffer as ArrayBuffer);
  else if (typeof value === 'object' && value !== null)
    for (const inner of Object.values(value)) buffersIn(inner, found);
  return found;
}

const send = (part: Part): void => post({ kind: 'part', part });

/**
 * A new mesh takes the old one's place only once one of its fields has been classified. Where that is not the first one, it
 * opens all the same, and what was wrong with the first is said in the end.
 */
async function open({ file, added, settings, smooth }: Extract<Request, { kind: 'open' }>): Promise<void> {
  const bytes = await bytesOf(file);
  const read = named(file, () => readMesh(bytes, { fileName: file.name, triangleFields: 'average' }));
  const mesh = new TriMesh(read.positions, read.triangles);
  const opened = new Session(read, mesh, file.name, (fraction) => post({ kind: 'progress', fraction }));
  const troubles: unknown[] = [];
  try {
    for (const field of added)
      for (const [name, values] of await fieldsOf(field, opened)) opened.addField(name, values);
    const usable = opened.candidates(settings.field).find((field) => {
      try {
        begin(opened, { ...settings, field });
        return true;
      } catch (error) {
        troubles.push(error);
        return false;
      }
    });
    if (usable !== undefined && smooth) opened.updateAfter({ ...settings, field: usable }, send);
    if (usable !== undefined && !smooth) opened.leaveOut();
  } finally {
    if (session !== opened) opened.free();
  }
  if (troubles.length > 0) throw troubles[0];
}

function begin(opened: Session, settings: Settings): void {
  opened.updateBefore(settings, send, () => {
    session?.free();
    session = opened;
    opened.describe(send, settings.field);
  });
}

async function addField({ file, settings }: Extract<Request, { kind: 'addField' }>): Promise<void> {
  if (!session) throw new Refusal('NoMesh', 'Open a mesh before adding a field to it.');
  const fields = await fieldsOf(file, session);
  const keys = fields.map(([name, values]) => session!.addField(name, values));
  const [key] = keys;
  if (key === undefined || keys.length > 1) {
    session.sendFields(send, settings.field);
    const columns = fields.map(([name]) => name).join(', ');
    throw new Refusal('AmbiguousColumn', `${file.name} has several columns. Choose one as the field: ${columns}.`);
  }
  session.sendFields(send, key);
  update(session, { ...settings, field: key });
}

/** Where one side fails, the other goes back to the settings that both have in common. */
function update(open: Session, settings: Settings): void {
  open.updateBefore(settings, send);
  try {
    open.updateAfter(settings, send);
  } catch (error) {
    if (open.settings) open.updateBefore(open.settings, send);
    open.endPreview(send);
    throw error;
  }
}

function choose(rule: EpsilonRule): void {
  if (!session) throw new Refusal('NoMesh', 'Open a mesh before choosing ε.');
  send({ kind: 'chosen', choice: session.families.choose(rule) });
}

/** What nobody waits for, a step at a time: between two of them requests are heard. */
function workOn(quiet: number): void {
  const wait = Math.max(quiet, session?.families.pause ?? 0);
  timer = setTimeout(() => {
    if (session?.families.step()) workOn(0);
  }, wait);
}

async function bytesOf(file: File): Promise<Uint8Array> {
  return new Uint8Array(await file.arrayBuffer());
}

/** Reads a file: what is wrong with it is said with its name, since several may have been dropped. */
function named<T>(file: File, read: () => T): T {
  try {
    return read();
  } catch (error) {
    throw error instanceof MorseSmoothError ? new Refusal(error.code, `${file.name}: ${error.message}`) : error;
  }
}

/** The fields of a file by what they are to be called: the only column of a table, or all. */
async function fieldsOf(file: File, open: Session): Promise<[string, Float64Array][]> {
  const bytes = await bytesOf(file);
  try {
    return [[file.name, named(file, () => readField(bytes, { fileName: file.name, ...open.counts }))]];
  } catch (error) {
    if (!(error instanceof Refusal && error.code === 'AmbiguousColumn')) throw error;
    const { columns } = readTable(bytes, { fileName: file.name });
    return Object.entries(columns).map(([column, values]) => [`${file.name}: ${column}`, values]);
  }
}

async function answer(request: Request): Promise<void> {
  switch (request.kind) {
    case 'open':
      return open(request);
    case 'addField':
      return addField(request);
    case 'update':
      return session ? update(session, request.settings) : undefined;
    case 'preview':
      return session?.preview(request.settings, request.whole, send);
    case 'choose':
      return choose(request.rule);
    case 'save':
      return session?.save(send);
    case 'picture':
      return session?.draw(request.view, send);
  }
}

async function main(): Promise<void> {
  try {
    await Promise.all([init(), initFiles(), initPictures()]);
  } catch (error) {
    post({ kind: 'failed', failure: failureOf(error), settings: null });
    return;
  }
  // The page sends the next request only after the answer to the last, so that none of them overlap.
  scope.onmessage = ({ data }) => {
    clearTimeout(timer);
    answer(data)
      .then(
        () => post({ kind: 'done', settings: session?.settings ?? null }),
        (error: unknown) => post({ kind: 'failed', failure: failureOf(error), settings: session?.settings ?? null }),
      )
      .then(() => workOn(data.kind === 'preview' ? QUIET_AFTER_PREVIEW : QUIET));
  };
  post({ kind: 'started', version });
}

void main();
