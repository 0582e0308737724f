// The entry for Node, bundled once for `import` and once for `require`.
import { packed } from 'this:embedded';
import module from 'this:module';
import { onDemand } from '../runtime/load-node.js';

export * from 'this:api';
export default onDemand(module, packed);
