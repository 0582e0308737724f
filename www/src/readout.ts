/** The facts of the mesh and, in a line, what was last done to the field; smoothing/report.ts has all of it. */
import { duration, element, short, whole } from './dom';
import { surplus } from './smoothing/exact-report';
import type { AfterReport, MeshSummary } from './protocol';

const text = (id: string, value: string): void => {
  element(`#${id}`, HTMLElement).textContent = value;
};

const IDS = ['read-linf', 'read-sobolev', 'read-time'] as const;

export function showReport({ lInfinity, sobolevBefore, sobolevAfter, milliseconds, exact }: AfterReport): void {
  element('#readout-energy', HTMLElement).hidden = exact === null;
  if (exact) text('read-energy', surplus(exact));
  text('read-linf', `${short(100 * lInfinity)} % of the range`);
  text('read-sobolev', `${short(sobolevBefore)} → ${short(sobolevAfter)}`);
  text('read-time', duration(milliseconds));
}

export function clearReport(): void {
  element('#readout-energy', HTMLElement).hidden = true;
  for (const id of IDS) text(id, '–');
}

export function showMesh({ vertexCount, triangleCount, topology, warnings }: MeshSummary): void {
  const facts = [
    `${whole(vertexCount)} vertices`,
    `${whole(triangleCount)} triangles`,
    `χ = ${whole(topology.eulerCharacteristic)}`,
  ];
  if (topology.genus !== null) facts.push(`genus ${topology.genus}`);
  if (topology.components !== 1) facts.push(`${whole(topology.components)} components`);
  if (topology.boundaryLoops > 0)
    facts.push(topology.boundaryLoops === 1 ? '1 boundary loop' : `${whole(topology.boundaryLoops)} boundary loops`);
  if (!topology.orientable) facts.push('not orientable');
  const nonManifold = topology.nonManifoldEdges + topology.nonManifoldVertices;
  if (nonManifold > 0) facts.push(`${whole(nonManifold)} non-manifold edges and vertices`);
  // Breaks between facts, never inside one.
  text('facts', facts.map((fact) => fact.replaceAll(' ', '\u00a0')).join(' · '));

  const details = element('#warnings', HTMLDetailsElement);
  details.hidden = warnings.length === 0;
  details.open = false;
  element('summary', HTMLElement, details).textContent =
    warnings.length === 1 ? '1 warning about this file' : `${warnings.length} warnings about this file`;
  element('ul', HTMLElement, details).replaceChildren(
    ...warnings.map(({ code, message }) => {
      const item = document.createElement('li');
      item.textContent = `${code}: ${message}`;
      return item;
    }),
  );
}
