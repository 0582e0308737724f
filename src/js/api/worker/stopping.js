// How a call that runs in a worker learns that it shall stop: the worker gets no message meanwhile.
//
// Where pages may share memory, by a number in it. Elsewhere by an address that holds as long as the call may go on: a worker can look
// synchronously whether it still does. Where neither works, and in Node without shared memory, a call cannot be asked.

/** What is served at an address. */
const CONTENT = '1';
/** How many milliseconds pass between two looks at an address; one takes about one. */
const INTERVAL = 30;

/** This end: how to tell the calls of one worker to stop, one after the other. */
export class Stopper {
  #flag = typeof SharedArrayBuffer === 'function' ? new Int32Array(new SharedArrayBuffer(4)) : null;
  #address = null;

  /** What the worker needs to know. It tries the addresses, of which the second one must not hold. */
  greeting() {
    if (this.#flag) return { flag: this.#flag };
    const [good, bad] = [newAddress(), newAddress()];
    this.#address = good;
    if (bad !== null) URL.revokeObjectURL(bad);
    return { probes: [good, bad] };
  }

  /** Before a call: the address that holds until it is over or shall stop. */
  begin() {
    this.end();
    if (!this.#flag) this.#address = newAddress();
    return this.#address;
  }

  ask(id) {
    if (this.#flag) Atomics.store(this.#flag, 0, id);
    else this.end();
  }

  end() {
    if (this.#address !== null) URL.revokeObjectURL(this.#address);
    this.#address = null;
  }
}

/** The worker's end: `isStopped(id, address)` is a function that says whether the call shall stop; null where it cannot know. */
export function hearing({ flag, probes }) {
  if (flag) return (id) => () => Atomics.load(flag, 0) === id;
  if (!holds(probes[0]) || holds(probes[1])) return null;
  return (_, address) => {
    let last = performance.now();
    let isStopped = false;
    return () => {
      const now = performance.now();
      if (isStopped || now - last < INTERVAL) return isStopped;
      isStopped = !holds(address);
      last = performance.now();
      return isStopped;
    };
  };
}

function holds(address) {
  if (address === null || typeof XMLHttpRequest !== 'function') return false;
  try {
    const request = new XMLHttpRequest();
    request.open('GET', address, false);
    request.send();
    return request.responseText === CONTENT;
  } catch {
    return false;
  }
}

function newAddress() {
  return typeof Blob === 'function' && typeof URL.createObjectURL === 'function'
    ? URL.createObjectURL(new Blob([CONTENT]))
    : null;
}
