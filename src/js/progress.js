/**
 * Carries what the caller's `onProgress` throws past the wasm module, which works on without noticing.
 *
 * Returns the options to hand on, and `run`, which makes a call with them and throws what the callback threw meanwhile.
 */
export function relayProgress(options) {
  const onProgress = options?.onProgress;
  if (typeof onProgress !== 'function') return { options, run: (call) => call() };
  let failure = null;
  const relayed = (progress) => {
    if (failure !== null) return;
    try {
      onProgress(progress);
    } catch (error) {
      failure = { error };
    }
  };
  const run = (call) => {
    failure = null;
    const result = call();
    if (failure !== null) throw failure.error;
    return result;
  };
  return { options: { ...options, onProgress: relayed }, run };
}
