// What commands that make a field do with it: the mesh goes to a file, and the report says what was done.
import { misuse } from '../failures.js';
import { aligned, jsonText, shown } from '../report.js';
import { write } from '../output.js';

/** Writes the mesh with its new field, then the report, each to its place. */
export async function deliver(target, { name, values, json, lines }, { input, file, field, given, notes }) {
  const about = { file: input, field: field.name, name, ...(target && target.path !== '-' && { output: target.path }) };
  const text = given.json ? jsonText({ ...about, ...json }) : [`${field.name} → ${name}`, ...lines, ''].join('\n');
  notes.clear();
  if (target) await target.write(file, fieldsFor(target, file, field, { name, values }));
  if (target?.path === '-') notes.say(text.trimEnd());
  else await write('-', text);
  if (!target) notes.say('nothing was written: -o FILE writes the mesh with the new field, --to csv prints its values');
}

/** In a mesh the new field stands beside the others; a table has the two that belong together, or the new one. */
function fieldsFor({ isTable, format }, { fields }, field, { name, values }) {
  if (!isTable) return { ...fields, [name]: values };
  return format === 'txt' ? { [name]: values } : { [field.name]: field.values, [name]: values };
}

/** Says before the work that a format has no room for its result. */
export function refuseFieldless(target) {
  if (target?.refuse) throw target.refuse;
}

/** The report of a smoothing. */
export function smoothLines(report) {
  const { method, equation, epsilon, choice, before, after, constraintCount, solver } = report;
  const how = epsilon === null ? '' : `, ε = ${shown(epsilon)}${choice ? ` by ${choice.rule}` : ''}`;
  const lines = [
    `${method}, ${sourceOf(equation)}${how}`,
    ...(choice ? [choice.reason] : []),
    '',
    ...countsTable(before, after),
    '',
  ];
  lines.push(`largest change ${shown(100 * report.lInfinity)} % of the range`);
  lines.push(
    `xᵀLx ${shown(report.sobolevBefore)} → ${shown(report.sobolevAfter)}, ‖Lx‖ ${shown(report.laplacianNorm)}`,
  );
  if (constraintCount > 0) {
    const { preserved, constrainedCriticalPoints, freeExtrema } = report;
    lines.push(
      `constrained ${constraintCount} vertices, ${preserved} of ${constrainedCriticalPoints} critical points kept, ${freeExtrema} extrema elsewhere`,
    );
  }
  if (report.perturbationFactor !== null)
    lines.push(`a change e of the values changes the result by at most ${shown(report.perturbationFactor)} ‖e‖`);
  if (solver.route !== 'none')
    lines.push(`solved by ${solver.route}, residual ${solver.relativeResidual.toExponential(1)}`);
  return lines;
}

/** Where the report's equation stands. */
function sourceOf(equation) {
  if (equation === 'fem') return 'by finite elements';
  return `${equation.startsWith('[') ? 'reference' : 'equation'} ${equation}`;
}

/** Numbers of critical points before and after. */
export function countsTable(before, after) {
  const rows = ['minima', 'saddles', 'maxima'].map((name) => [name, String(before[name]), String(after[name])]);
  return aligned([['', 'before', 'after'], ...rows]);
}

/** A rule that has to be given, or an error that says so. */
export function needed(given, names, advice) {
  if (names.every((name) => given[name] === undefined))
    throw misuse(`${names.map((name) => `--${name}`).join(' or ')} is needed`, advice);
}
