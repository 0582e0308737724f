/** The form: reads settings from it, writes settings into it, and says when the user changed something. */
import type { Link } from 'morse-smooth';
import type { Colormap } from 'morse-smooth/snapshot';
import { clamp, element, input, select } from './dom';
import type { Example } from './examples';
import type { Coloring, FieldEntry, LevelPlaces, Settings } from './protocol';
import { SmoothingControls } from './smoothing/controls';
import type { Rule } from './smoothing/settings';
import type { Layers } from './viewer';

const DELTA_RANGE = [0, 0.5] as const;
const PERSISTENCE_RANGE = [0, 1] as const;
const LEVELS_RANGE = [0, 60] as const;

const ORIGINS: readonly [FieldEntry['origin'], string][] = [
  ['added', 'Added'],
  ['file', 'In the file'],
  ['coordinate', 'Coordinates'],
];

/** All settings but those that are made on the surface, in the table and in the persistence diagram. */
export type Choices = Omit<Settings, 'overrides' | 'picked' | 'paths'>;

export interface ControlEvents {
  settings(): void;
  /** Another field of the same mesh. */
  field(): void;
  /** ε alone, while it moves. */
  epsilon(): void;
  /** Said before `settings`, for what needs no worker. */
  delta(value: number): void;
  /** In place of `settings`, since what depends on it may have a preview. */
  persistence(value: number): void;
  layers(layers: Layers): void;
  example(id: string): void;
  meshFile(file: File): void;
  fieldFile(file: File): void;
  resetView(): void;
  save(): void;
  picture(): void;
  stop(): void;
}

export class Controls {
  private readonly delta = input('delta');
  private readonly deltaNumber = input('delta-number');
  private readonly levels = input('levels');
  private readonly field = select('field');
  private readonly link = select('link');
  private readonly persistence = input('persistence');
  private readonly persistenceNumber = input('persistence-number');
  private readonly coloring = select('coloring');
  private readonly levelPlaces = select('level-places');
  private readonly colormap = select('colormap');
  private readonly bands = input('show-bands');
  private readonly complex = input('show-complex');
  /** What is shown or not without being computed anew. */
  private readonly layerBoxes = [input('show-glyphs'), input('show-levels'), input('show-edges')] as const;
  private readonly example = select('example');
  private readonly smoothing: SmoothingControls;

  constructor(
    examples: readonly Example[],
    private readonly initial: Choices,
    private readonly events: ControlEvents,
  ) {
    for (const { id, label } of examples) this.example.add(new Option(label, id));
    this.smoothing = new SmoothingControls(
      () => events.settings(),
      () => events.epsilon(),
    );
    this.write(initial);
    this.wireSettings();
    this.wireDisplay();
    this.wireFiles();
  }

  /** The number boxes hold the exact values; the sliders follow them to their nearest step. */
  read(): Choices {
    return {
      ...this.smoothing.read(),
      field: this.field.value,
      delta: Number(this.deltaNumber.value),
      link: this.link.value as Link,
      levels: Number(this.levels.value),
      levelPlaces: this.levelPlaces.value as LevelPlaces,
      persistence: Number(this.persistenceNumber.value),
      coloring: this.coloring.value as Coloring,
      colormap: this.colormap.value as Colormap,
      bands: this.bands.checked,
      complex: this.complex.checked,
    };
  }

  write(settings: Choices): void {
    this.field.value = settings.field;
    this.link.value = settings.link;
    this.levels.value = String(settings.levels);
    this.levelPlaces.value = settings.levelPlaces;
    this.coloring.value = settings.coloring;
    this.colormap.value = settings.colormap;
    this.bands.checked = settings.bands;
    this.complex.checked = settings.complex;
    this.smoothing.write(settings);
    this.writeDelta(settings.delta);
    this.writePersistence(settings.persistence);
    this.showLayers();
  }

  setFields(fields: readonly FieldEntry[], chosen: string): void {
    this.field.replaceChildren();
    for (const [origin, title] of ORIGINS) {
      const members = fields.filter((entry) => entry.origin === origin);
      if (members.length === 0) continue;
      const group = document.createElement('optgroup');
      group.label = title;
      for (const { key, label } of members) group.append(new Option(label, key));
      this.field.append(group);
    }
    this.field.value = chosen;
  }

  /** `null` for a mesh of the user's own, whose name takes the example's place in the list. */
  showSource(id: string | null, name: string): void {
    this.example.querySelector('option[value=""]')?.remove();
    if (id === null) this.example.prepend(new Option(name, ''));
    this.example.value = id ?? '';
  }

  setSaveable(saveable: boolean): void {
    element('#save', HTMLButtonElement).disabled = !saveable;
  }

  /** There is something to make a picture of. */
  setDrawable(): void {
    element('#save-picture', HTMLButtonElement).disabled = false;
  }

  writeEpsilon(value: number): void {
    this.smoothing.writeEpsilon(value);
  }

  writeRule(rule: Rule): void {
    this.smoothing.writeRule(rule);
  }

  /** How many vertices of the field have no value. */
  setGaps(count: number): void {
    this.smoothing.setGaps(count);
  }

  /** What the filters' multiples are of. */
  setUnits(units: { meanEdge?: number; width?: number }): void {
    this.smoothing.setUnits(units);
  }

  /** As far as the curve goes: beyond it nothing changes. */
  setDeltaEnd(end: number): void {
    this.delta.max = String(end);
    this.delta.step = String(end / 100);
    this.delta.value = this.deltaNumber.value;
  }

  writeDelta(value: number): void {
    const delta = clamp(value, DELTA_RANGE);
    this.deltaNumber.value = String(Number(delta.toPrecision(6)));
    this.delta.value = String(delta);
  }

  /** Half of the slider is for the lowest quarter of the range, where most decisions fall. */
  writePersistence(value: number): void {
    const persistence = clamp(value, PERSISTENCE_RANGE);
    this.persistenceNumber.value = String(Number(persistence.toPrecision(4)));
    this.persistence.value = String(Math.sqrt(persistence));
    this.persistence.setAttribute('aria-valuetext', this.persistenceNumber.value);
  }

  get layers(): Layers {
    const [glyphs, levels, edges] = this.layerBoxes;
    return {
      glyphs: glyphs.checked,
      levels: levels.checked,
      edges: edges.checked,
      complex: this.complex.checked,
      basins: this.coloring.value === 'minima' || this.coloring.value === 'maxima',
      difference: this.coloring.value === 'difference',
    };
  }

  private showLayers(): void {
    this.events.layers(this.layers);
  }

  private wireSettings(): void {
    const { events } = this;
    // Sliders report while they move; the client drops what a newer position makes stale.
    this.delta.addEventListener('input', () => {
      this.writeDelta(Number(this.delta.value));
      this.changeDelta();
    });
    this.persistence.addEventListener('input', () => {
      this.writePersistence(Number((Number(this.persistence.value) ** 2).toPrecision(3)));
      this.changePersistence();
    });
    const number = (
      box: HTMLInputElement,
      fallback: number,
      write: (value: number) => void,
      changed = (): void => events.settings(),
    ): void => {
      box.addEventListener('change', () => {
        write(Number.isFinite(box.valueAsNumber) ? box.valueAsNumber : fallback);
        changed();
      });
    };
    number(
      this.deltaNumber,
      this.initial.delta,
      (value) => this.writeDelta(value),
      () => this.changeDelta(),
    );
    number(
      this.persistenceNumber,
      this.initial.persistence,
      (value) => this.writePersistence(value),
      () => this.changePersistence(),
    );
    number(this.levels, this.initial.levels, (value) => {
      this.levels.value = String(Math.round(clamp(value, LEVELS_RANGE)));
    });
    for (const choice of [this.link, this.levelPlaces]) choice.addEventListener('change', () => events.settings());
    this.field.addEventListener('change', () => events.field());
    element('#controls', HTMLFormElement).addEventListener('submit', (event) => event.preventDefault());
  }

  /** From wherever: the slider, the number or a plot. */
  changeDelta(): void {
    this.events.delta(Number(this.deltaNumber.value));
    this.events.settings();
  }

  changePersistence(): void {
    this.events.persistence(Number(this.persistenceNumber.value));
  }

  private wireDisplay(): void {
    const { events, complex, coloring } = this;
    for (const box of this.layerBoxes) box.addEventListener('change', () => this.showLayers());
    // These two have to be computed, too.
    for (const choice of [complex, coloring]) {
      choice.addEventListener('change', () => {
        this.showLayers();
        events.settings();
      });
    }
    for (const choice of [this.colormap, this.bands]) choice.addEventListener('change', () => events.settings());
    element('#reset-view', HTMLButtonElement).addEventListener('click', () => events.resetView());
  }

  private wireFiles(): void {
    const { events } = this;
    this.example.addEventListener('change', () => {
      if (this.example.value) events.example(this.example.value);
    });
    const picker = (id: string, use: (file: File) => void): void => {
      const box = input(id);
      box.addEventListener('change', () => {
        const file = box.files?.[0];
        // Emptied, so that choosing the same file again is a change again.
        box.value = '';
        if (file) use(file);
      });
    };
    picker('open-mesh', (file) => events.meshFile(file));
    picker('open-field', (file) => events.fieldFile(file));
    element('#save', HTMLButtonElement).addEventListener('click', () => events.save());
    element('#save-picture', HTMLButtonElement).addEventListener('click', () => events.picture());
    element('#stop', HTMLButtonElement).addEventListener('click', () => events.stop());
  }
}
