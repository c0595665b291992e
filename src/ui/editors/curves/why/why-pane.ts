/**
 * *Why this curve*, beside the plot: of the curve under the pointer, or of the selected key, where its slopes come
 * from, and how they make the value. Updated with the plot, while visible.
 */

import { keysOf } from '../../../../model/takes/take.ts';
import { whyValue } from '../../../../teaching/explain/channel-why.ts';
import type { Uses } from '../../../state/workbench.ts';
import { element, write } from '../../../widgets/dom.ts';
import { NumberGrid } from '../../../widgets/numbers/number-grid.ts';
import { shown } from '../../../widgets/numbers/number-text.ts';
import { channelName } from '../../timeline/channels.ts';
import { laterThan } from '../../timeline/edit-all.ts';
import { namedIn, partWith, timelineTake } from '../../timeline/timeline-take.ts';
import { type WhyPlace, type WhySubject, whySubject } from './why-subject.ts';
import { keyLines, placeLines, slopeLines } from './why-text.ts';

const NOTHING = 'Point at a curve, or select a key, to see where its slopes and values come from.';

export class WhyPane {
  readonly element = element('section', { class: 'why', 'aria-label': 'Why this curve', 'data-panel': 'why' });
  private readonly title = element('h3', { class: 'step-head' });
  private readonly unit = element('p', { class: 'step-law' });
  private readonly keyPart = new Lines('key');
  private readonly placePart = new Lines('place');
  private readonly slopePart = new Lines('slopes');
  private readonly inputs = new NumberGrid({
    label: 'Hermite inputs',
    rows: 1,
    columns: 4,
    columnLabels: ['p₀', 'p₁', 'h·m₀', 'h·m₁'],
  });
  private readonly cubic = new NumberGrid({
    label: 'Coefficients of the cubic',
    rows: 2,
    columns: 4,
    rowLabels: ['in u', 'in s'],
    columnLabels: ['a', 'b', 'c', 'd'],
  });
  private readonly at = new NumberGrid({
    label: 'Position in the segment',
    rows: 1,
    columns: 2,
    columnLabels: ['u', 's'],
  });
  private readonly result = new NumberGrid({ label: 'Value', rows: 1, columns: 1, columnLabels: ['value'] });
  private readonly segment: HTMLElement;
  private readonly empty = element('p', { class: 'empty' }, NOTHING);
  private readonly body: HTMLElement;
  private channel: number | undefined;

  constructor(private readonly wb: Uses<'store' | 'settings'>) {
    this.segment = element(
      'div',
      { class: 'why-segment' },
      this.slopePart.element,
      this.inputs.element,
      element(
        'p',
        { class: 'step-law' },
        'p = a·u³ + b·u² + c·u + d, with u = (t − t₀) / h from 0 to 1. “in s”: the same cubic over the seconds since the key, which is what is evaluated',
      ),
      this.cubic.element,
      this.at.element,
    );
    this.body = element(
      'div',
      { class: 'why-body', hidden: true },
      this.title,
      this.unit,
      this.keyPart.element,
      this.placePart.element,
      this.segment,
      this.result.element,
    );
    this.element.append(this.empty, this.body);
  }

  show(place: WhyPlace): void {
    const current = timelineTake(this.wb);
    const subject = current && whySubject(place);
    const why = current && subject && whyValue(current.take, subject.channel, subject.time);
    write(this.empty, 'hidden', why !== undefined);
    write(this.body, 'hidden', why === undefined);
    // Another curve is read from its beginning.
    if (subject?.channel !== this.channel) this.element.scrollTop = 0;
    this.channel = subject?.channel;
    if (!current || !subject || !why) return;
    const { take } = current;
    const named = namedIn(current, subject.channel);
    const later = laterThan(current.character, partWith(current, subject.channel).character);
    const keys = keysOf(take.channels[subject.channel]);
    this.title.textContent = channelName(named);
    this.unit.textContent = `at ${shown(subject.time + later)} s of the take${named.unit === 'angle' ? ', in radians' : ''}`;
    this.keyPart.show(keyOf(subject, keys.times.length) === undefined ? [] : keyLines(keys, subject.key ?? 0));
    this.placePart.show(placeLines(why));
    const segment = why.kind === 'keys' ? why.segment : undefined;
    write(this.segment, 'hidden', !segment);
    if (segment) {
      this.slopePart.show(slopeLines(keys, segment));
      this.inputs.setRow(0, segment.inputs);
      this.cubic.setRow(0, segment.inU);
      this.cubic.setRow(1, segment.inSeconds);
      this.at.setRow(0, [segment.u, segment.tau]);
    }
    this.result.set(0, 0, why.value);
  }
}

/** The subject's key, if the channel still has it. */
function keyOf({ key }: WhySubject, keyCount: number): number | undefined {
  return key !== undefined && key < keyCount ? key : undefined;
}

/** Lines of text that change in place. */
class Lines {
  readonly element: HTMLElement;
  private shown: readonly string[] = [];

  constructor(name: string) {
    this.element = element('div', { class: `why-lines why-${name}` });
  }

  show(lines: readonly string[]): void {
    if (lines.length === this.shown.length && lines.every((line, i) => line === this.shown[i])) return;
    this.shown = lines;
    this.element.replaceChildren(...lines.map((line) => element('p', {}, line)));
  }
}
