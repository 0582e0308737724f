// Packs the package and installs it into an empty folder, where the tests use it as anybody would.
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { npm } from '../../scripts/lib/run.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const apps = fileURLToPath(new URL('apps', import.meta.url));

export default function setup({ provide }) {
  const folder = mkdtempSync(join(tmpdir(), 'morse-smooth-package-'));
  const run = (cwd, ...parameters) => {
    const [command, all] = npm(...parameters);
    return execFileSync(command, all, { cwd, encoding: 'utf8' });
  };
  // The files are built; --ignore-scripts leaves out what a publication would do first.
  const [{ filename, files }] = JSON.parse(
    run(root, 'pack', '--ignore-scripts', '--json', '--pack-destination', folder),
  );
  writeFileSync(join(folder, 'package.json'), JSON.stringify({ private: true, type: 'module' }));
  run(folder, 'install', '--no-audit', '--no-fund', '--offline', join(folder, filename));
  cpSync(apps, folder, { recursive: true });
  provide('installed', folder);
  provide('packed', files.map((file) => file.path).sort());
  return () => rmSync(folder, { recursive: true, force: true });
}
