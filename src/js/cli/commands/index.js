// The commands, one file each, in the order in which the help lists them.
import { convert } from './convert.js';
import { critical } from './critical.js';
import { draw } from './draw.js';
import { info } from './info.js';
import { levels } from './levels.js';
import { persistence } from './persistence.js';
import { prescribe } from './prescribe.js';
import { simplify } from './simplify.js';
import { smooth } from './smooth.js';

export const commands = [info, critical, persistence, smooth, simplify, prescribe, levels, draw, convert];
