import { chooseField, readInput } from '../input.js';
import { misuse } from '../failures.js';
import { api, own, take } from '../options.js';
import { targetOf } from '../output.js';
import { counted } from '../report.js';

export const convert = {
  name: 'convert',
  summary: 'writes a mesh, or its fields, in another format',
  options: {
    field: { ...own.field.field, help: 'a field to keep, as often as there are; default: all', several: true },
    values: own.field.values,
    ...take('column', api.files.readMesh, api.files.weld),
    output: { ...own.result.output, help: 'where the mesh goes; default: the standard output, with --to' },
    to: { ...own.result.to, help: 'the format; default: by the ending of the file. csv and txt have the fields alone' },
    ...take('binary'),
    ...own.common,
  },
  examples: [
    'morse-smooth convert surface.vtk -o surface.ply --binary',
    'morse-smooth convert torus.ply --field noisy --to txt > noisy.txt',
    'morse-smooth convert shape.obj --values heat.csv --column T -o shape.ply',
    'cat torus.ply | morse-smooth convert - --to off > torus.off',
  ],
  async run({ input, given, notes }) {
    const target = await targetOf(given);
    if (target === null)
      throw misuse('what to write is not said', 'give -o FILE, or --to FORMAT for the standard output');
    const file = await readInput(input, given, notes);
    const chosen = [...(given.field ?? []), ...(file.chosen === null ? [] : [file.chosen])];
    const names = given.field || file.chosen === null ? chosen : Object.keys(file.fields);
    const fields = given.field === undefined ? file.fields : {};
    for (const name of names) fields[name] = chooseField({ ...file, chosen: name }, {}, input).values;
    const count = Object.keys(fields).length;
    if (target.isTable && count === 0)
      throw misuse(`${input === '-' ? 'the mesh' : input} has no field`, 'give one by --values');
    if (target.refuse && count > 0) {
      // What is asked for by name must not go silently, and neither must the others.
      if (chosen.length > 0) throw target.refuse;
      notes.say(`${target.format} holds no fields: ${counted(count, 'field')} left out`);
    }
    await target.write(file, fields);
  },
};
