/** What the form asks about exact extrema beside what other methods take, too. */
import { clamp, input, select } from '../dom';
import { INITIAL_SMOOTHING } from './settings';
import type { Exact } from './settings';

/** In per cent; more than all of the range would be a field that leaves it. */
const PROMINENCE_RANGE = [0, 100] as const;

export class ExactControls {
  private readonly of = select('exact-of');
  private readonly keepValues = input('keep-values');
  private readonly prominence = input('prominence');

  constructor(changed: () => void) {
    this.prominence.addEventListener('change', () => {
      this.write(this.read());
    });
    for (const choice of [this.of, this.keepValues, this.prominence]) choice.addEventListener('change', changed);
  }

  read(): Exact {
    const { valueAsNumber } = this.prominence;
    const percent = Number.isFinite(valueAsNumber) ? valueAsNumber : 100 * INITIAL_SMOOTHING.exact.prominence;
    return {
      of: this.of.value as Exact['of'],
      keepValues: this.keepValues.checked,
      prominence: clamp(percent, PROMINENCE_RANGE) / 100,
    };
  }

  write({ of, keepValues, prominence }: Exact): void {
    this.of.value = of;
    this.keepValues.checked = keepValues;
    this.prominence.value = String(Number((100 * prominence).toPrecision(6)));
  }
}
