/** The table of critical points. Only the rows in sight are in the page: there may be a hundred thousand. */
import { element, short, whole } from '../dom';
import { COLUMNS, ORDINARY, sorted } from './points';
import type { Column, Order, Point } from './points';

const TITLES: Record<Column, [title: string, meaning: string]> = {
  kind: ['Kind', 'Minimum, saddle or maximum'],
  vertex: ['Vertex', 'Number of the vertex in the mesh'],
  value: ['Value', 'In units of the field'],
  persistence: [
    'Persistence',
    'Difference of value to the critical point that it is paired with, in units of the field; ∞ without a partner',
  ],
  vanishes: ['Vanishes at δ', 'The relative δ at which it stops being critical'],
};
const NAMES: Record<number, [name: string, glyph: string]> = {
  [-1]: ['minimum', 'minimum'],
  0: ['saddle', 'saddle'],
  1: ['maximum', 'maximum'],
  [ORDINARY]: ['ordinary', ''],
};
/** Above and below what is in sight, so that scrolling shows no gap. */
const SPARE = 6;

export interface TableEvents {
  toggle(vertex: number): void;
  /** The point that is pointed at, by pointer or keys; null for none. */
  point(point: Point | null): void;
}

export class PointTable {
  private points: readonly Point[] = [];
  private rows: Point[] = [];
  private order: Order = { by: 'persistence', descending: true };
  private chosen: ReadonlySet<number> = new Set();
  private editable = false;
  /** The row that the keys have come to. */
  private active: number | null = null;

  private readonly box = element('#points-box', HTMLElement);
  private readonly titles = element('#points-titles', HTMLElement);
  private readonly body = element('#points-rows', HTMLElement);
  private readonly kinds = element('#point-kinds', HTMLSelectElement);
  private readonly onlyChosen = element('#point-constrained', HTMLInputElement);
  private readonly text = element('#points-text', HTMLElement);

  constructor(private readonly events: TableEvents) {
    this.makeTitles();
    this.kinds.addEventListener('change', () => this.renew());
    this.onlyChosen.addEventListener('change', () => this.renew());
    this.box.addEventListener('scroll', () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.box);
    this.listen();
  }

  setPoints(points: readonly Point[]): void {
    this.points = points;
    this.renew();
  }

  /** `editable`: whether the method takes constraints. */
  setChosen(chosen: ReadonlySet<number>, editable: boolean): void {
    this.chosen = chosen;
    this.editable = editable;
    if (this.onlyChosen.checked) this.renew();
    else this.draw();
  }

  /** After anything that decides which rows there are. */
  private renew(): void {
    const { kinds, onlyChosen, chosen } = this;
    const isListed = ({ vertex, kind }: Point): boolean =>
      (kinds.value === 'all' || kind === Number(kinds.value)) && (!onlyChosen.checked || chosen.has(vertex));
    const last = this.active === null ? null : this.rows[this.active]?.vertex;
    this.rows = sorted(this.points.filter(isListed), this.order);
    const now = this.rows.findIndex(({ vertex }) => vertex === last);
    this.active = now >= 0 ? now : null;
    for (const title of this.titles.querySelectorAll<HTMLElement>('[data-sort]')) {
      const isIt = title.dataset['sort'] === this.order.by;
      title.ariaSort = isIt ? (this.order.descending ? 'descending' : 'ascending') : 'none';
    }
    this.draw();
  }

  private makeTitles(): void {
    const tick = document.createElement('span');
    tick.role = 'columnheader';
    tick.ariaLabel = 'Constrained';
    this.titles.append(tick);
    for (const column of COLUMNS) {
      const [title, meaning] = TITLES[column];
      const head = document.createElement('span');
      head.role = 'columnheader';
      head.dataset['sort'] = column;
      const button = document.createElement('button');
      button.type = 'button';
      button.title = meaning;
      button.textContent = title;
      button.dataset['testid'] = `sort-${column}`;
      button.addEventListener('click', () => {
        const isAgain = this.order.by === column;
        // Large numbers are what one looks for first; names and kinds go from the first to the last.
        this.order = {
          by: column,
          descending: isAgain ? !this.order.descending : column !== 'kind' && column !== 'vertex',
        };
        this.box.scrollTop = 0;
        this.renew();
      });
      head.append(button);
      this.titles.append(head);
    }
  }

  private get rowHeight(): number {
    return parseFloat(getComputedStyle(this.box).getPropertyValue('--row')) || 26;
  }

  private draw(): void {
    const { rows, box, body } = this;
    const chosen = rows.reduce((count, { vertex }) => count + (this.chosen.has(vertex) ? 1 : 0), 0);
    this.text.textContent =
      `${whole(rows.length)} ${rows.length === 1 ? 'point' : 'points'}` +
      (this.editable ? `, ${whole(chosen)} constrained` : '. Interpolation and least squares can hold them.');
    box.ariaRowCount = String(rows.length + 1);
    const height = this.rowHeight;
    const first = Math.max(0, Math.floor(box.scrollTop / height) - SPARE);
    const last = Math.min(rows.length, Math.ceil((box.scrollTop + box.clientHeight) / height) + SPARE);
    body.style.paddingTop = `${first * height}px`;
    body.style.paddingBottom = `${(rows.length - last) * height}px`;
    body.replaceChildren(...rows.slice(first, last).map((point, k) => this.makeRow(point, first + k)));
    const active = this.active === null ? null : this.body.querySelector(`[data-row="${this.active}"]`);
    if (active) box.setAttribute('aria-activedescendant', active.id);
    else box.removeAttribute('aria-activedescendant');
  }

  private makeRow(point: Point, index: number): HTMLElement {
    const { vertex, kind, value, persistence, vanishes } = point;
    const row = document.createElement('div');
    const isChosen = this.chosen.has(vertex);
    row.className = 'points-row';
    row.id = `point-${vertex}`;
    row.role = 'row';
    row.ariaRowIndex = String(index + 2);
    row.ariaSelected = String(isChosen);
    row.dataset['row'] = String(index);
    row.classList.toggle('active', index === this.active);
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.checked = isChosen;
    box.disabled = !this.editable;
    // The keys of the table do it: thousands of stops on the way to what follows would be too many.
    box.tabIndex = -1;
    box.ariaLabel = `Constrain vertex ${vertex}`;
    const [name, glyph] = NAMES[kind]!;
    const isCritical = kind !== ORDINARY;
    const texts = [
      name,
      String(vertex),
      short(value),
      !isCritical ? '–' : Number.isFinite(persistence) ? short(persistence) : '∞',
      isCritical ? short(vanishes) : '–',
    ];
    const cells = texts.map((text) => cellOf(text));
    if (glyph) cells[0]!.prepend(glyphOf(glyph));
    row.append(cellOf(box), ...cells);
    return row;
  }

  private listen(): void {
    const at = (event: Event): number | null => {
      const row = (event.target as Element).closest<HTMLElement>('[data-row]');
      return row ? Number(row.dataset['row']) : null;
    };
    this.body.addEventListener('click', (event) => {
      const index = at(event);
      if (index === null) return;
      // The box shows what is constrained, which the worker has to find out first.
      if (event.target instanceof HTMLInputElement) event.preventDefault();
      this.goTo(index, false);
      this.toggle(index);
    });
    this.body.addEventListener('pointerover', (event) => {
      const index = at(event);
      this.events.point(index === null ? null : this.rows[index]!);
    });
    this.body.addEventListener('pointerleave', () => this.events.point(null));
    this.box.addEventListener('blur', () => this.events.point(null));
    this.box.addEventListener('keydown', (event) => {
      if (event.target !== this.box || event.ctrlKey || event.metaKey || event.altKey) return;
      const page = Math.max(1, Math.floor(this.box.clientHeight / this.rowHeight) - 2);
      const from = this.active;
      const goals: Record<string, number> = {
        ArrowDown: (from ?? -1) + 1,
        ArrowUp: (from ?? 1) - 1,
        PageDown: (from ?? 0) + page,
        PageUp: (from ?? 0) - page,
        Home: 0,
        End: this.rows.length - 1,
      };
      const goal = goals[event.key];
      if (goal !== undefined) this.goTo(Math.max(0, Math.min(this.rows.length - 1, goal)), true);
      else if ((event.key === ' ' || event.key === 'Enter') && from !== null) this.toggle(from);
      else if (event.key === 'Escape') this.events.point(null);
      else return;
      event.preventDefault();
    });
  }

  private toggle(index: number): void {
    const point = this.rows[index];
    if (point && this.editable) this.events.toggle(point.vertex);
  }

  private goTo(index: number, byKey: boolean): void {
    const point = this.rows[index];
    if (!point) return;
    this.active = index;
    if (byKey) {
      const height = this.rowHeight;
      const { box } = this;
      // The titles lie over the first row.
      const room = box.clientHeight - 2 * height;
      box.scrollTop = Math.min(index * height, Math.max(box.scrollTop, index * height - room));
      this.events.point(point);
    }
    this.draw();
  }
}

function cellOf(content: string | HTMLElement): HTMLElement {
  const cell = document.createElement('span');
  cell.role = 'gridcell';
  cell.append(content);
  return cell;
}

function glyphOf(name: string): SVGElement {
  const space = 'http://www.w3.org/2000/svg';
  const glyph = document.createElementNS(space, 'svg');
  glyph.setAttribute('class', name);
  glyph.setAttribute('aria-hidden', 'true');
  const use = document.createElementNS(space, 'use');
  use.setAttribute('href', `#glyph-${name}`);
  glyph.append(use);
  return glyph;
}
