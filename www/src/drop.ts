/** Files dropped anywhere on the page: fields by their ending, everything else is taken for a mesh. */
import { element } from './dom';

export function isFieldName(name: string): boolean {
  return /\.(txt|csv|tsv|dat|xyz|npy|curv|sulc|thickness|area)(\.gz)?$/i.test(name);
}

export function acceptDrops(use: (files: File[]) => void): void {
  const veil = element('#drop', HTMLElement);
  const holdsFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  // Entering a child leaves its parent: counting tells when the pointer has left the window.
  let depth = 0;
  const settle = (): void => {
    veil.hidden = depth <= 0;
  };
  window.addEventListener('dragenter', (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    depth += 1;
    settle();
  });
  window.addEventListener('dragleave', (event) => {
    if (!holdsFiles(event)) return;
    depth -= 1;
    settle();
  });
  window.addEventListener('dragover', (event) => {
    if (holdsFiles(event)) event.preventDefault();
  });
  window.addEventListener('drop', (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    depth = 0;
    settle();
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length > 0) use(files);
  });
}
