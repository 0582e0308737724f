// Times in seconds.

const clocks = {
  wall: () => performance.now() / 1000,
  /** Of the whole process: a busy machine disturbs it less, but the engine's own threads count. */
  cpu: () => process.cpuUsage().user / 1e6 + process.cpuUsage().system / 1e6,
};

/** Collects times by name; `time` runs `work` and returns its result. */
export class Stopwatch {
  samples = {};

  constructor(clock) {
    this.now = clocks[clock];
  }

  time(name, work) {
    const since = this.now();
    const result = work();
    this.add(name, this.now() - since);
    return result;
  }

  add(name, value) {
    (this.samples[name] ??= []).push(value);
  }
}

export function median(values) {
  if (!values?.length) return NaN;
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}
