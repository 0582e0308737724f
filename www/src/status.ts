/** The page's one state (ready, working, error), the line that says it, and the notice that explains an error. */
import { element } from './dom';
import type { Failure, Request } from './protocol';

/** Work that ends sooner is not worth a button to stop it. */
const STOP_AFTER = 1500;

export class Status {
  private readonly root = document.documentElement;
  private readonly line = element('#status', HTMLElement);
  private readonly stop = element('#stop', HTMLButtonElement);
  private readonly notice = element('#notice', HTMLElement);
  private timer = 0;

  constructor() {
    element('#notice-close', HTMLButtonElement).addEventListener('click', () => this.dismiss());
  }

  working(what: string): void {
    this.root.dataset['state'] = 'working';
    this.line.textContent = what;
    if (!this.timer)
      this.timer = window.setTimeout(() => {
        this.stop.hidden = false;
      }, STOP_AFTER);
  }

  /** The page is not yet at rest, though nobody has to wait. */
  preview(what: string): void {
    this.root.dataset['state'] = 'working';
    this.line.textContent = what;
  }

  /** Only where it takes long enough to be read. */
  progress(fraction: number): void {
    if (!this.stop.hidden) this.line.textContent = `Working… ${Math.round(100 * fraction)} %`;
  }

  /** Nothing is under way: ready, or in error for as long as the notice stands. */
  idle(): void {
    window.clearTimeout(this.timer);
    this.timer = 0;
    this.stop.hidden = true;
    const failed = !this.notice.hidden;
    this.root.dataset['state'] = failed ? 'error' : 'ready';
    this.line.textContent = failed ? 'Not done' : 'Ready';
  }

  fail({ code, message }: Failure): void {
    element('#notice-code', HTMLElement).textContent = code;
    element('#notice-message', HTMLElement).textContent = message;
    this.notice.hidden = false;
  }

  /** Called by the next thing that succeeds, too. */
  dismiss(): void {
    this.notice.hidden = true;
    if (this.root.dataset['state'] === 'error') this.idle();
  }
}

/** What is under way. */
export function describe(request: Request): string {
  switch (request.kind) {
    case 'open':
      return `Opening ${request.file.name}…`;
    case 'addField':
      return `Reading ${request.file.name}…`;
    case 'update':
    case 'preview':
      return 'Working…';
    case 'choose':
      return 'Choosing ε…';
    case 'save':
      return 'Writing…';
    case 'picture':
      return 'Drawing…';
  }
}
