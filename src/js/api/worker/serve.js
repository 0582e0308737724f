// The end of a connection that is in a worker.
import * as core from '../core/index.js';
import { core as coreModule } from '../core/module.js';
import * as files from '../files/index.js';
import { files as filesModule } from '../files/module.js';
import * as snapshot from '../snapshot/index.js';
import { pictures } from '../snapshot/module.js';
import { isRecord } from '../../runtime/convert.js';
import { buffersIn, decode } from './encode.js';
import { toReport } from './reports.js';
import { hearing } from './stopping.js';
import { GREETING, callOf, classes } from './table.js';

const modules = { core: coreModule, files: filesModule, snapshot: pictures };
const names = { core, files, snapshot };

/** Makes a connection if a message that came to the worker asks for one. */
export function answer(message) {
  if (typeof message === 'object' && message !== null && GREETING in message) serve(message);
}

/** Serves one connection. */
function serve({ port, [GREETING]: codes, ...greeting }) {
  const objects = new Map();
  const stopOf = hearing(greeting);
  const post = (message) => port.postMessage(message, [...buffersIn(message)]);
  const fail = (id, error, made) => post({ id, error: toReport(error), made });
  try {
    start(codes);
  } catch (error) {
    return fail(0, error, []);
  }
  port.onmessage = ({ data }) => {
    if (data.frees) free(data.frees);
    if (data.call) run(data);
    if (data.isClosed) close();
  };
  post({ id: 0, value: { canHear: stopOf !== null }, made: [] });

  function run({ id, codes, makes, call, isHeard, address }) {
    const made = [];
    const isStopped = stopOf === null ? () => false : stopOf(id, address);
    const goesOn = () => !isStopped();
    const watch = (progress) => {
      if (isHeard) port.postMessage({ id, progress });
      return goesOn();
    };
    try {
      start(codes);
      for (const make of makes) made.push({ object: make.makes, time: timeOf(() => restore(make, goesOn)) });
      let answer;
      const time = timeOf(() => {
        answer = perform(call, watch);
      });
      if (call.makes !== null) made.push({ object: call.makes, time });
      post({ id, ...answer, made });
    } catch (error) {
      fail(id, error, made);
    }
  }

  /** Makes an object that there was before in another worker. */
  function restore(make, watch) {
    perform(make, watch);
    const { kind } = callOf(make.kind, make.name).makes;
    for (const name of make.changes) perform({ kind, target: make.makes, name, args: [], makes: null }, watch);
  }

  /** Makes a call; what it makes of objects stays here. */
  function perform({ kind, target, name, args, makes }, onProgress) {
    const call = callOf(kind, name);
    const given = withProgress(decode(args, objects), call, onProgress);
    const value = valueOf(call, kind === null ? names[call.module] : objects.get(target), name, given);
    const about = call.changes ? factsOf(kind, objects.get(target)) : null;
    if (makes === null) return { value, facts: about };
    const { kind: kindMade, at } = call.makes;
    const object = at === null ? value : value[at];
    const rest = at === null ? null : Object.fromEntries(Object.entries(value).filter(([entry]) => entry !== at));
    try {
      const facts = factsOf(kindMade, object);
      objects.set(makes, object);
      return { value: rest, facts };
    } catch (error) {
      object.free();
      throw error;
    }
  }

  function free(numbers) {
    for (const number of numbers) {
      // One that was never made here, or that went with its instance, has nothing to give back.
      objects.get(number)?.free();
      objects.delete(number);
    }
  }

  function close() {
    free([...objects.keys()].reverse());
    port.close();
  }
}

/** Starts modules from their compiled code, and again after they were lost: at once, which a worker may. */
function start(codes) {
  for (const [name, code] of Object.entries(codes)) {
    if (modules[name].code !== null) continue;
    modules[name].onDemand(() => code, globalThis);
    void modules[name].instance;
  }
}

function valueOf({ isConstructor, isProperty, makes, module }, receiver, name, args) {
  if (isConstructor) return new names[module][makes.kind](...args);
  return isProperty ? receiver[name] : receiver[name](...args);
}

/** Arguments with `onProgress` among the options, unless there is something else in their place, which will be refused. */
function withProgress(args, { before, isWatched }, onProgress) {
  if (!isWatched) return args;
  const all = Array.from({ length: before + 1 }, (_, k) => args[k]);
  const options = all[before];
  if (options === undefined || isRecord(options)) all[before] = { ...options, onProgress };
  return all;
}

const factsOf = (kind, object) => Object.fromEntries(classes[kind].facts.map((fact) => [fact, object[fact]]));

/** How many milliseconds something takes. */
function timeOf(action) {
  const start = performance.now();
  action();
  return performance.now() - start;
}
