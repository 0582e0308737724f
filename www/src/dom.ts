/** Finds what index.html promises; a missing element is a mistake of ours and is said by name. */
export function element<T extends Element>(
  selector: string,
  type: abstract new (...parameters: never[]) => T,
  root: ParentNode = document,
): T {
  const found = root.querySelector(selector);
  if (!(found instanceof type)) throw new Error(`the page has no ${type.name} at ${selector}`);
  return found;
}

export const input = (id: string): HTMLInputElement => element(`#${id}`, HTMLInputElement);
export const select = (id: string): HTMLSelectElement => element(`#${id}`, HTMLSelectElement);

export function clamp(value: number, [low, high]: readonly [number, number]): number {
  return Math.min(high, Math.max(low, value));
}

/** Three significant digits, with an exponent only where the plain number would be long. */
export function short(value: number): string {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3)
    return value
      .toExponential(size >= 1e5 ? 2 : 1)
      .replace('e+', 'e')
      .replace('-', '−')
      .replace('e-', 'e−');
  return Number(value.toPrecision(3)).toString().replace('-', '−');
}

/** Of a relative error: one digit. */
export function about(error: number): string {
  if (error < 1e-9) return 'below 1e−9';
  if (error < 1e-4) return `about ${error.toExponential(0).replace('e-', 'e−')}`;
  return `about ${short(Number((100 * error).toPrecision(1)))} %`;
}

export function whole(value: number): string {
  return value.toLocaleString('en').replace('-', '−');
}

export function duration(milliseconds: number): string {
  return milliseconds < 1000 ? `${Math.max(1, Math.round(milliseconds))} ms` : `${(milliseconds / 1000).toFixed(1)} s`;
}

/** Gives the user a file. */
export function download(name: string, bytes: Uint8Array<ArrayBuffer>): void {
  const address = URL.createObjectURL(new Blob([bytes], { type: 'application/octet-stream' }));
  const anchor = document.createElement('a');
  anchor.href = address;
  anchor.download = name;
  anchor.click();
  // The browser has taken its own hold of the data by the next turn of the event loop.
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
