/**
 * Makes `call(options)` with an `onProgress` that can be handed to the wasm module: what the caller's throws must not pass through
 * the module, where it would leave memory in disorder. It stops the work instead, and is thrown when that has ended.
 */
export function watched(options, call) {
  const onProgress = options?.onProgress;
  if (typeof onProgress !== 'function') return call(options);
  let isStopped = false;
  let failure = null;
  const relay = (phase, fraction) => {
    if (isStopped) return false;
    try {
      isStopped = onProgress({ phase, fraction }) === false;
    } catch (error) {
      isStopped = true;
      failure = { error };
    }
    return !isStopped;
  };
  let result;
  try {
    result = call({ ...options, onProgress: relay });
  } catch (error) {
    throw failure === null ? error : failure.error;
  }
  if (failure !== null) throw failure.error;
  return result;
}
