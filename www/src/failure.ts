/** Errors as the page shows them: a stable code and a sentence. */
import { MorseSmoothError } from 'morse-smooth';
import type { Failure } from './protocol';

/** What the page itself refuses, before the package is asked. */
export class Refusal extends Error {
  constructor(
    readonly code: string,
    message: string,
  ) {
    super(message);
    this.name = 'Refusal';
  }
}

export function failureOf(error: unknown): Failure {
  if (error instanceof MorseSmoothError || error instanceof Refusal)
    return { code: error.code, message: error.message };
  return { code: 'Unexpected', message: error instanceof Error ? error.message : String(error) };
}
