#!/usr/bin/env node
// The command `morse-smooth`.
import { main } from '../cli/main.js';

await main(process.argv.slice(2));
