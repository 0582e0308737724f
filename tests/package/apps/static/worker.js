// The package's folder is named by the page: that of the package, or one where files are missing.
import { remote } from '../remote.js';

const folder = new URLSearchParams(location.search).get('dist');
import(`${folder}/worker.js`)
  .then((worker) => remote(worker))
  .then(
    (found) => (globalThis.result = { ...found, isolated: crossOriginIsolated }),
    (error) => (globalThis.result = String(error)),
  );
