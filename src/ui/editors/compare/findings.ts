/** The left part of the panel: the causes, and the facts of the comparison. */
import type { Comparison } from '../../../teaching/compare/compare.ts';
import { comparedText } from '../../../teaching/compare/compared-text.ts';
import type { NamedDump } from '../../../teaching/dump/fit-dump.ts';
import type { ComparedResult, CompareState, DumpComparison } from '../../state/dump-comparison.ts';
import { statesTime, takeTimeShown } from '../../state/dump-times.ts';
import type { Uses } from '../../state/workbench.ts';
import { button, element, setAttribute, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { NumberField } from '../../widgets/numbers/number-field.ts';
import { exact, shown } from '../../widgets/numbers/number-text.ts';
import { causesList } from './causes.ts';
import { isOfChannels } from './dump-kinds.ts';
import { largestText } from './largest-text.ts';

/** Times listed at most. */
const MAX_TIMES = 60;

export class Findings {
  readonly element = element('div', { class: 'compare-findings' });
  private readonly found = element('div');
  private readonly times = element('div', { class: 'compare-times', role: 'group', 'aria-label': 'Compared times' });
  private readonly facts = element('div');
  private readonly files = element('div', { class: 'compare-files' });
  private readonly tolerance: NumberField;
  private of: DumpComparison | undefined;
  private state: CompareState | undefined;
  /** Whether a take moves the character: else there is no other time than that of the file pose. */
  private isMoved = false;

  constructor(private readonly wb: Uses<'comparing' | 'transport' | 'messages'>) {
    const refuse = (reason: string) => wb.messages.note(reason, 'warning');
    this.tolerance = new NumberField({
      label: 'Tolerance, relative to the size and to 1 radian',
      class: 'compare-number',
      text: exact,
      commit: (value) => {
        if (value > 0) this.of?.setTolerance(value);
        else {
          refuse('The tolerance must be greater than 0.');
          this.tolerance.refresh();
        }
      },
      refuse,
    });
    this.element.append(
      this.found,
      this.times,
      factRow('Numbers', this.files),
      this.facts,
      factRow('Tolerance', this.tolerance.element),
    );
  }

  /** @param told the frame that is told of; −1 if none */
  show(comparing: DumpComparison, told: number): void {
    const state = comparing.state.get();
    this.of = comparing;
    if (state.result !== this.state?.result) this.showResult(state);
    const isMoved = takeTimeShown(this.wb, comparing.character) !== undefined;
    const isOther = state.dumps !== this.state?.dumps || state.result !== this.state?.result;
    if (isOther || isMoved !== this.isMoved) this.showDumps(state, isMoved);
    this.isMoved = isMoved;
    this.state = state;
    this.tolerance.show(state.tolerance);
    for (const [i, made] of [...this.times.children].entries()) setAttribute(made, 'aria-pressed', String(i === told));
  }

  forget(): void {
    this.of = this.state = undefined;
    this.showResult({});
  }

  private showResult({ result, newest = [] }: Partial<Pick<CompareState, 'result' | 'newest'>>): void {
    this.found.replaceChildren();
    this.times.replaceChildren();
    this.facts.replaceChildren();
    if (!result) return;
    const { comparison, targets } = result;
    const { frames, layout, compared } = comparison;
    const hasSeveral = (targets.origins?.fileNames.length ?? 1) > 1;
    this.found.append(causesList(result, newest, hasSeveral));
    this.element.scrollTop = 0;
    if (frames.length > 1)
      this.times.append(...frames.slice(0, MAX_TIMES).map((_, i) => this.timeButton(comparison, i)));
    this.facts.append(
      factRow('Compared', comparedText(compared, frames.length)),
      layout ? factRow('Read as', `${layout.order}, ${layout.numbers} numbers`) : '',
      factRow('Largest error', largestText(result)),
    );
  }

  private timeButton({ frames }: Comparison, index: number): HTMLElement {
    const { time, agrees } = frames[index];
    const text = time === undefined ? 'File pose' : `${shown(time, 4)} s`;
    const mark = agrees ? 'agrees' : 'own';
    const made = button(`${text}, ${agrees ? 'agrees' : 'differs'}`, { class: 'tool text-tool' }, undefined, () =>
      this.of?.goTo(index),
    );
    made.append(element('span', { class: 'compare-swatch', 'data-mark': mark, 'aria-hidden': 'true' }), text);
    return made;
  }

  private showDumps({ dumps, result, replaced = [] }: CompareState, isMoved: boolean): void {
    const rows = dumps.map((dump) => this.fileRow(dump, result, dumps.length > 1, isMoved));
    const instead =
      replaced.length > 0 ? [element('div', { class: 'faint' }, `instead of ${replaced.join(', ')}`)] : [];
    this.files.replaceChildren(...rows, ...instead);
  }

  private fileRow(
    dump: NamedDump,
    result: ComparedResult | undefined,
    canRemove: boolean,
    isMoved: boolean,
  ): HTMLElement {
    const { fileName } = dump;
    const row = element('div', { class: 'compare-file' }, fileName);
    if (isMoved && !statesTime(dump) && !(result && isOfChannels(result, fileName))) row.append(...this.timeOf(dump));
    if (canRemove) {
      const remove = () => this.of?.remove(fileName);
      row.append(button(`Remove ${fileName}`, { class: 'tool small' }, icon('close'), remove));
    }
    return row;
  }

  /** Of a dump that states none. */
  private timeOf({ fileName, assumed }: NamedDump): readonly HTMLElement[] {
    const setTime = (time: number | undefined) => this.of?.setTime(fileName, time);
    const field = new NumberField({
      label: `Time of ${fileName}, in seconds`,
      class: 'compare-number',
      text: (value) => shown(value, 4),
      commit: setTime,
      refuse: (reason) => this.wb.messages.note(reason, 'warning'),
    });
    write(field.element, 'placeholder', 'file pose');
    field.show(assumed?.time ?? Number.NaN);
    const act = (label: string, tooltip: string, run: () => void) =>
      button(`${label}: ${fileName}`, { class: 'link', tooltip }, label, run);
    return [
      element('span', { class: 'faint' }, 'at'),
      field.element,
      act('Now', 'Compare at the current time', () => setTime(takeTimeShown(this.wb, this.of?.character))),
      act('File pose', 'Compare with the file pose, without the take', () => setTime(undefined)),
    ];
  }
}

function factRow(name: string, ...values: (HTMLElement | string)[]): HTMLElement {
  return element(
    'div',
    { class: 'fact' },
    element('span', { class: 'faint' }, name),
    element('span', { class: 'fact-value' }, ...values),
  );
}
