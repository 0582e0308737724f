import init, * as api from 'morse-smooth/inline';
import { use } from './use.js';

await init();
console.log(JSON.stringify(use(api)));
