/**
 * ε while it moves, and the choice of exact extrema: previews are shown as long as there is something to take them from, and the exact
 * solve is asked for when it rests. Without it every position is solved for, as for any other setting.
 */

/** Milliseconds without a change, after which it rests; while the pointer holds it, until it is let go. */
const REST = 250;

export interface MovingEvents {
  /** `whole`: it stands still, so that there is time for everything. */
  preview(whole: boolean): void;
  /** To be solved for. */
  rest(): void;
}

export class MovingEpsilon {
  /** Whether there is a family. */
  canPreview = false;
  private timer = 0;
  private isMoving = false;
  private isHeld = false;

  constructor(private readonly events: MovingEvents) {
    for (const end of ['pointerup', 'pointercancel'] as const) window.addEventListener(end, () => this.letGo());
  }

  /** Between the first change and the request for the exact field. */
  get moving(): boolean {
    return this.isMoving;
  }

  /** What the pointer can hold it by. */
  holdBy(handle: HTMLElement): void {
    handle.addEventListener('pointerdown', ({ button }) => {
      this.isHeld = button === 0;
    });
    handle.addEventListener('change', () => {
      if (this.isHeld) this.letGo();
    });
  }

  /** `anyway`: even without a family. */
  moved(anyway = false): void {
    if (!this.canPreview && !anyway) return this.events.rest();
    this.isMoving = true;
    this.events.preview(false);
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      if (this.isHeld) this.events.preview(true);
      else this.events.rest();
    }, REST);
  }

  private letGo(): void {
    this.isHeld = false;
    if (this.isMoving) this.events.rest();
  }

  /** What is asked for now has the latest ε with it. */
  settle(): void {
    window.clearTimeout(this.timer);
    this.isMoving = false;
  }
}
