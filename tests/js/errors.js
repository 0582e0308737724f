import { MorseSmoothError } from 'morse-smooth';
import { expect } from 'vitest';

/** Expects a MorseSmoothError of that code whose detail has (at least) those entries. */
export function expectError(call, code, detail = {}) {
  let thrown;
  try {
    call();
  } catch (error) {
    thrown = error;
  }
  expect(thrown, `nothing thrown instead of ${code}`).toBeDefined();
  expectCode(thrown, code, detail);
}

/** The same for a promise. */
export async function expectRejection(promise, code, detail = {}) {
  const thrown = await promise.then(
    () => undefined,
    (error) => error,
  );
  expectCode(thrown, code, detail);
}

function expectCode(thrown, code, detail) {
  expect(thrown).toBeInstanceOf(MorseSmoothError);
  expect(thrown).toBeInstanceOf(Error);
  expect(thrown.name).toBe('MorseSmoothError');
  expect(thrown.code, thrown.message).toBe(code);
  expect(thrown.message.length).toBeGreaterThan(10);
  expect(thrown.detail).toMatchObject(detail);
}
