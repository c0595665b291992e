/** One row of the list of layers: a layer, or the base below all. */
import type { LayerInfo } from '../../../model/takes/layer-code.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { type MenuEntry, menuButton } from '../../widgets/menu.ts';
import { middleCut } from '../../widgets/middle-cut.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

/** A layer as it is at the current time; `index` −1 is the base. */
export interface LayerRow {
  readonly index: number;
  /** Absent of the base. */
  readonly info?: LayerInfo;
  readonly name: string;
  readonly isActive: boolean;
  /** Whether it has no part in what is shown: muted, or another is solo. */
  readonly isSilent: boolean;
  readonly isWeightKeyed: boolean;
  /** What it touches, `all` or `3 joints`; and the same in full. */
  readonly mask: string;
  readonly maskText: string;
}

export interface RowEvents {
  toggleMode(row: LayerRow): void;
  toggle(row: LayerRow, what: 'mute' | 'solo'): void;
  /** While the weight is dragged. */
  previewWeight(row: LayerRow, weight: number): void;
  /** The end of a drag of the weight. */
  commitWeight(): void;
  keyWeight(row: LayerRow): void;
  maskMenu(row: LayerRow): MenuEntry[];
  rename(row: LayerRow, name: string): void;
  refuse(reason: string): void;
}

const STEP = 0.01;

export class LayerRowView {
  readonly element: HTMLElement;
  private row: LayerRow;
  private readonly name = middleCut('layer-label');
  private readonly nameCell: HTMLElement;
  private readonly mode: HTMLButtonElement;
  private readonly slider = element('input', { type: 'range', min: 0, max: 1, step: STEP, class: 'layer-slider' });
  private readonly field: NumberField;
  private readonly key: HTMLButtonElement;
  private readonly switches: Readonly<Record<'mute' | 'solo', HTMLButtonElement>>;
  private readonly mask: HTMLButtonElement;
  private readonly ofLayer: readonly HTMLElement[];

  constructor(
    row: LayerRow,
    private readonly events: RowEvents,
  ) {
    this.row = row;
    const tool = (label: string, className: string, content: Node | string, run: () => void) =>
      keepsFocusElsewhere(button(label, { class: `tool small ${className}`, tabindex: -1 }, content, run));
    this.mode = tool('Mode', 'layer-mode', '', () => events.toggleMode(this.row));
    this.key = tool('Key weight', 'layer-key', icon('key'), () => events.keyWeight(this.row));
    this.switches = {
      mute: tool('Mute', 'layer-mute', 'M', () => events.toggle(this.row, 'mute')),
      solo: tool('Solo', 'layer-solo', 'S', () => events.toggle(this.row, 'solo')),
    };
    this.mask = keepsFocusElsewhere(
      element('button', { type: 'button', class: 'tool small layer-mask', tabindex: -1 }),
    );
    menuButton(this.mask, 'What it touches', () => events.maskMenu(this.row));
    this.field = new NumberField({
      label: 'Weight',
      text: (value) => shown(value, 2),
      commit: (value) => this.setWeight(value),
      refuse: events.refuse,
      step: 0.1,
    });
    this.slider.addEventListener('input', () => {
      this.field.show(Number(this.slider.value));
      events.previewWeight(this.row, Number(this.slider.value));
    });
    this.slider.addEventListener('change', () => events.commitWeight());
    this.nameCell = cell(
      'layer-name',
      element('span', { class: 'layer-mark', 'aria-hidden': 'true' }),
      this.name.element,
    );
    this.ofLayer = [
      cell('', this.mode),
      cell('layer-weight', this.slider, this.field.element, this.key),
      cell('layer-switches', this.switches.mute, this.switches.solo),
      cell('', this.mask),
    ];
    this.element = element('div', { class: 'sort-row layer-row', role: 'row' }, this.nameCell, ...this.ofLayer);
  }

  /** @param isFocused its controls are stops of the keyboard */
  show(row: LayerRow, isFocused: boolean): void {
    this.row = row;
    const { info, isActive, isSilent, isWeightKeyed } = row;
    setAttribute(this.element, 'aria-selected', String(isActive));
    this.element.classList.toggle('silent', isSilent);
    this.element.classList.toggle('is-base', !info);
    this.name.show(row.name);
    setTooltip(this.nameCell, isActive ? `${row.name}: poses and keys go into it` : `${row.name}: click to edit it`);
    for (const each of this.ofLayer) write(each, 'hidden', !info);
    for (const each of [this.slider, this.field.element, this.mode, this.key, this.mask, ...this.both()]) {
      write(each, 'tabIndex', isFocused ? 0 : -1);
    }
    if (info) this.showLayer(row, info, isWeightKeyed);
  }

  private both(): readonly HTMLButtonElement[] {
    return [this.switches.mute, this.switches.solo];
  }

  private showLayer({ name, mask, maskText }: LayerRow, info: LayerInfo, isWeightKeyed: boolean): void {
    const { mode, slider, field, key, switches } = this;
    const isAdditive = info.mode === 'additive';
    setText(mode, isAdditive ? 'Additive' : 'Override');
    setAttribute(mode, 'aria-label', `Mode of ${name}: ${isAdditive ? 'additive' : 'override'}`);
    setTooltip(
      mode,
      isAdditive
        ? 'Additive: its values are added to those below. Click for override'
        : 'Override: its values take the place of those below. Click for additive',
    );
    setAttribute(slider, 'aria-label', `Weight of ${name}`);
    setTooltip(slider, isWeightKeyed ? 'Weight: it is keyed, so a drag keys it at the current time' : 'Weight');
    if (slider.value !== String(info.weight)) slider.value = String(info.weight);
    setAttribute(field.element, 'aria-label', `Weight of ${name}, number`);
    field.show(info.weight);
    setAttribute(key, 'aria-label', `Key weight of ${name}`);
    setTooltip(
      key,
      isWeightKeyed ? 'Key the weight at the current time' : 'Key the weight, so that it can change over time',
    );
    setAttribute(key, 'aria-pressed', String(isWeightKeyed));
    for (const [what, label] of [
      ['mute', 'Mute'],
      ['solo', 'Solo'],
    ] as const) {
      setAttribute(switches[what], 'aria-label', `${label} ${name}`);
      setAttribute(switches[what], 'aria-pressed', String(info[what]));
      setTooltip(switches[what], label);
    }
    setText(this.mask, mask);
    setAttribute(this.mask, 'aria-label', `${name} touches ${maskText}`);
    setTooltip(this.mask, `Touches ${maskText}`);
  }

  private setWeight(value: number): void {
    if (!(value >= 0 && value <= 1)) {
      this.events.refuse(`Weight must be from 0 to 1; you entered ${shown(value)}.`);
      this.field.refresh();
      return;
    }
    this.events.previewWeight(this.row, value);
    this.events.commitWeight();
  }

  /** A field in place of its name: Enter names it, Escape leaves it. @param done the focus goes back */
  edit(done: () => void): void {
    const { row, name } = this;
    if (!row.info) return;
    const field = element('input', { class: 'layer-field', 'aria-label': 'Name of the layer', value: row.name });
    let isOver = false;
    const end = (keeps: boolean) => {
      if (isOver) return;
      isOver = true;
      field.replaceWith(name.element);
      if (keeps && field.value.trim() !== row.name) this.events.rename(row, field.value);
    };
    field.addEventListener('keydown', (event) => {
      event.stopPropagation();
      if (event.isComposing || (event.key !== 'Enter' && event.key !== 'Escape')) return;
      event.preventDefault();
      end(event.key === 'Enter');
      done();
    });
    field.addEventListener('blur', () => end(true));
    name.element.replaceWith(field);
    field.focus();
    field.select();
  }
}

function cell(className: string, ...children: Node[]): HTMLElement {
  return element('div', { role: 'gridcell', class: `sort-cell ${className}` }, ...children);
}
