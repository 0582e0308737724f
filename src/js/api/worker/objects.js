// Objects that live in workers, and what stands for them here.
import { MorseSmoothError, invalidArgument } from '../../runtime/error.js';
import { freed } from './failures.js';
import { classes } from './table.js';

/** What is known of each object of the classes below. */
const states = new WeakMap();

/** An object: how it was made, so that any worker can make it again. */
export class RemoteObject {
  static #count = 0;
  number = ++RemoteObject.#count;
  /** The call that makes it. */
  recipe = null;
  /** The methods that have changed it since, one after the other. */
  changes = [];
  facts = {};
  /** How many calls need it that are not over. */
  uses = 0;
  isFreed = false;

  constructor(connection, kind) {
    this.connection = connection;
    this.kind = kind;
    this.isSingle = classes[kind].isSingle ?? false;
  }

  free() {
    this.isFreed = true;
    this.connection.sweep();
  }
}

/** Objects that were forgotten are freed when the collector runs. */
const forgotten = new FinalizationRegistry((state) => state.free());

/** What stands for an object here. */
export function proxyOf(state) {
  const proxy = Object.create(prototypes[state.kind]);
  states.set(proxy, state);
  forgotten.register(proxy, state, state);
  return proxy;
}

/** The object that a value stands for; nothing for all other values. */
export function stateOf(value, connection) {
  const state = states.get(value);
  if (state === undefined) return undefined;
  if (state.connection !== connection) {
    const object = state.kind;
    throw new MorseSmoothError('InvalidArgument', `this ${object} is one of another connection`, { object });
  }
  return alive(state);
}

function alive(state) {
  if (state.isFreed) throw freed(state.kind);
  return state;
}

function ownState(proxy, kind) {
  const state = states.get(proxy);
  if (state?.kind !== kind) throw invalidArgument('this', `a ${kind} of a connection`);
  return state;
}

/** A copy of numbers, arrays and records. (jsdom has no `structuredClone`.) */
function copyOf(value) {
  if (ArrayBuffer.isView(value)) return value.slice();
  if (Array.isArray(value)) return value.map(copyOf);
  if (typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(Object.entries(value).map(([name, entry]) => [name, copyOf(entry)]));
}

/** The methods and properties of a class, from the table. */
function prototypeOf(kind, { facts, methods }) {
  const prototype = {
    free() {
      const state = ownState(this, kind);
      forgotten.unregister(state);
      state.free();
    },
  };
  for (const name of Object.keys(methods)) {
    prototype[name] = async function (...given) {
      const state = ownState(this, kind);
      return state.connection.call(kind, alive(state), name, given);
    };
    Object.defineProperty(prototype[name], 'name', { value: name });
  }
  for (const fact of facts) {
    // A copy, as everywhere: the caller may change it.
    Object.defineProperty(prototype, fact, {
      get() {
        return copyOf(alive(ownState(this, kind)).facts[fact]);
      },
      configurable: true,
    });
  }
  for (const name of Object.keys(prototype)) Object.defineProperty(prototype, name, { enumerable: false });
  Object.defineProperty(prototype, Symbol.toStringTag, { value: `Remote${kind}` });
  if (Symbol.dispose) Object.defineProperty(prototype, Symbol.dispose, { value: prototype.free });
  return prototype;
}

const prototypes = Object.fromEntries(Object.entries(classes).map(([kind, about]) => [kind, prototypeOf(kind, about)]));
