/**
 * The legend over the viewport while another program's numbers are drawn: what the looks of joints or the colours of
 * vertices mean, and which of both programs is drawn.
 */

import { MARK_TEXTS } from '../../../teaching/compare/joint-marks.ts';
import type { ComparedSide } from '../../../view/compare/compared-skeleton.ts';
import { heatLegend } from '../../state/heat-legend.ts';
import { button, element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import type { ComparedPart } from './drawn.ts';

const SIDES: Readonly<Record<ComparedSide, string>> = { ours: 'Marrow’s', both: 'Both', theirs: 'Yours' };
const SIDE_TIPS: Readonly<Record<ComparedSide, string>> = {
  ours: 'Draw only Marrow’s character',
  both: 'Draw Marrow’s character, and yours as a ghost',
  theirs: 'Draw only what your program printed',
};
const PARTS: Readonly<Record<ComparedPart, string>> = { joints: 'Joints', skin: 'Skin' };
const PART_TIPS: Readonly<Record<ComparedPart, string>> = {
  joints: 'Compare joints and bones',
  skin: 'Compare the skin’s vertices',
};

export interface LegendState {
  readonly side: ComparedSide;
  readonly part: ComparedPart;
  /** To choose from. */
  readonly parts: readonly ComparedPart[];
  /** Whether own and inherited errors are told apart. */
  readonly tellsOwn: boolean;
  /** Scale of the skin's errors. */
  readonly scale?: ScaleText;
}

export interface ScaleText {
  readonly title: string;
  readonly explanation: string;
  /** At the bright end: `1.5 cm, 2 % of size`. */
  readonly top: string;
  /** `Worst: vertex 96, 1.2 cm`; empty if all agree. */
  readonly worst: string;
}

export interface LegendEvents {
  side(side: ComparedSide): void;
  part(part: ComparedPart): void;
  /** Selects the worst vertex. */
  worst(): void;
  /** Moves the camera so that both are in view. */
  frame(): void;
}

export class CompareLegend {
  readonly element: HTMLElement;
  private readonly sides: Radios<ComparedSide>;
  private readonly parts: Radios<ComparedPart>;
  private readonly joints = element('ul', { class: 'compare-looks' });
  private readonly own = element('span', {});
  private readonly inherited: HTMLElement;
  private readonly scale = element('div', { class: 'compare-scale' });
  private readonly title = element('span', { class: 'compare-scale-title' });
  private readonly ramp = heatLegend('Vertex errors, from dark (none) to light (largest)');
  private readonly worst: HTMLButtonElement;

  constructor(events: LegendEvents) {
    this.sides = new Radios('Drawn', SIDES, SIDE_TIPS, (side) => events.side(side));
    this.parts = new Radios('Compared', PARTS, PART_TIPS, (part) => events.part(part));
    this.inherited = look('inherited', MARK_TEXTS.inherited);
    setTooltip(this.inherited, 'Inherited: wrong only because a parent is');
    setTooltip(this.own, 'Own error: wrong relative to its parent');
    const theirs = look('theirs', 'yours');
    this.joints.append(
      look('agrees', MARK_TEXTS.agrees),
      element('li', {}, swatch('own'), this.own),
      this.inherited,
      theirs,
    );
    this.worst = keepsFocusElsewhere(button('Select the worst vertex', { class: 'link' }, '', () => events.worst()));
    this.scale.append(this.title, this.ramp.element, this.worst);
    this.element = element(
      'section',
      { class: 'compare-legend', 'aria-label': 'Legend of the comparison' },
      element(
        'div',
        { class: 'compare-choices' },
        this.sides.element,
        this.parts.element,
        keepsFocusElsewhere(button('Frame both', { class: 'tool' }, icon('frame'), () => events.frame())),
      ),
      this.joints,
      this.scale,
    );
  }

  show({ side, part, parts, tellsOwn, scale }: LegendState): void {
    this.sides.show(side);
    write(this.parts.element, 'hidden', parts.length < 2);
    this.parts.show(part);
    write(this.joints, 'hidden', part !== 'joints');
    write(this.scale, 'hidden', part !== 'skin');
    setText(this.own, MARK_TEXTS[tellsOwn ? 'own' : 'differs']);
    write(this.inherited, 'hidden', !tellsOwn);
    if (!scale) return;
    setText(this.title, scale.title);
    setTooltip(this.title, scale.explanation);
    this.ramp.show(scale.top);
    write(this.worst, 'hidden', scale.worst === '');
    setText(this.worst, scale.worst);
    setAttribute(this.worst, 'aria-label', `${scale.worst}: select`);
  }
}

function look(name: string, text: string): HTMLElement {
  return element('li', {}, swatch(name), text);
}

function swatch(name: string): HTMLElement {
  return element('span', { class: `compare-look ${name}`, 'aria-hidden': 'true' });
}

/** Buttons of which one is chosen: one tab stop, with arrow keys between them. */
class Radios<Name extends string> {
  readonly element: HTMLElement;
  private readonly buttons: ReadonlyMap<Name, HTMLButtonElement>;

  constructor(
    label: string,
    labels: Readonly<Record<Name, string>>,
    tips: Readonly<Record<Name, string>>,
    choose: (name: Name) => void,
  ) {
    // The keys of a record by its own type.
    const names = Object.keys(labels) as Name[];
    this.buttons = new Map(
      names.map((name) => {
        const made = button(labels[name], { class: 'tool text-tool', role: 'radio' }, labels[name], () => choose(name));
        setTooltip(made, tips[name]);
        return [name, keepsFocusElsewhere(made)];
      }),
    );
    this.element = element('div', { class: 'tools segmented', role: 'radiogroup', 'aria-label': label });
    this.element.append(...this.buttons.values());
    this.element.addEventListener('keydown', (event) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key] ?? 0;
      const from = names.findIndex((name) => this.buttons.get(name) === event.target);
      if (!step || from < 0) return;
      event.preventDefault();
      const next = names[(from + step + names.length) % names.length];
      choose(next);
      this.buttons.get(next)?.focus();
    });
  }

  show(chosen: Name): void {
    for (const [name, made] of this.buttons) {
      setAttribute(made, 'aria-checked', String(name === chosen));
      write(made, 'tabIndex', name === chosen ? 0 : -1);
    }
  }
}
