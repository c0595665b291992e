/**
 * Editing the text of a file: its field, the problems of what was typed, in the margin and as a list below, and a bar
 * that applies or discards the edits.
 *
 *     Ctrl+Enter   applies the text          Escape   leaves, and asks about edits
 */

import type { Diagnostic } from '../../../model/diagnostic.ts';
import { sentenceOf } from '../../../model/failure.ts';
import type { CheckedText } from '../../state/source.ts';
import { button, element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { CodeField } from './code-field.ts';

/** Milliseconds without typing. */
const PAUSE = 400;
const MAX_PROBLEMS = 20;

/** A text that was edited and not applied. */
export interface Draft {
  readonly base: string;
  readonly text: string;
}

interface Calls {
  check(edited: string, base: string): Promise<CheckedText>;
  /** The text was applied: it is what the page has now. */
  applied(): void;
  /** Back to the lines. */
  leave(): void;
}

export class TextEditor {
  readonly element: HTMLElement;
  private readonly status = element('span', { class: 'source-edit-status', role: 'status' });
  private readonly field = new CodeField(() => this.typed());
  private readonly list = element('ul', {
    class: 'source-problems',
    'aria-label': 'Problems in the text',
    hidden: true,
  });
  private readonly apply: HTMLButtonElement;
  private readonly discard: HTMLButtonElement;
  private readonly bar: HTMLElement;
  /** Whether to discard edits. */
  private readonly question: HTMLElement;
  private readonly keep: HTMLButtonElement;
  private name = '';
  private base = '';
  /** Of the text as it is; undefined once it is edited. */
  private checked: CheckedText | undefined;
  private running: Promise<CheckedText | undefined> | undefined;
  private timer = 0;

  constructor(private readonly calls: Calls) {
    const keys = isMac ? '⌘↩' : 'Ctrl+Enter';
    this.apply = button('Apply', { class: 'plain' }, 'Apply', () => void this.applyNow());
    setTooltip(
      this.apply,
      () => this.whyNot() ?? 'Replace what was read from this file, as one undo step',
      () => keys,
    );
    this.discard = button('Discard edits', { class: 'plain' }, 'Discard', () => this.discardNow());
    this.keep = button('Keep editing', { class: 'plain' }, 'Keep editing', () => this.ask(false));
    const discard = button('Discard the edits and leave', { class: 'plain' }, 'Discard', () => {
      this.discardNow();
      this.calls.leave();
    });
    this.bar = element('div', { class: 'source-edit-bar' }, this.status, this.discard, this.apply);
    this.question = element(
      'div',
      { class: 'source-edit-bar', role: 'alertdialog', 'aria-label': 'Discard the edits?', hidden: true },
      element('span', { class: 'source-edit-status' }, 'The edits were not applied. Discard them?'),
      discard,
      this.keep,
    );
    this.element = element(
      'div',
      { class: 'source-edit', hidden: true },
      this.field.element,
      this.list,
      this.bar,
      this.question,
    );
    this.element.addEventListener('keydown', (event) => this.onKey(event));
  }

  /** Shows a text, or edits of it that were left. */
  open(name: string, base: string, draft?: Draft): void {
    this.name = name;
    this.base = withPlainEnds(draft?.base ?? base);
    this.field.open(this.label, draft?.text ?? this.base, this.base);
    this.reset();
    if (draft) this.typed();
    if (draft && withPlainEnds(base) !== draft.base) this.warnOfChange();
  }

  /** The page has another text now; edits stay. */
  follow(base: string): void {
    const now = withPlainEnds(base);
    if (now === this.base) return;
    if (this.hasEdits) {
      this.warnOfChange();
      return;
    }
    this.base = now;
    this.field.replace(this.label, now);
    this.reset();
  }

  get hasEdits(): boolean {
    return this.field.hasEdits;
  }

  get draft(): Draft | undefined {
    return this.hasEdits ? { base: this.base, text: this.field.text } : undefined;
  }

  /** Forgets the text; edits too. */
  close(): void {
    this.base = '';
    this.field.open(this.label, '');
    this.reset();
  }

  /** Leaves the text, after asking if it was edited. */
  leave(): void {
    if (this.hasEdits) this.ask(true);
    else this.calls.leave();
  }

  focus(): void {
    this.field.focus();
  }

  /** @param line from 1 */
  goTo(line: number): void {
    this.field.goTo(line);
  }

  /** Opens search and replace. */
  askText(): void {
    this.field.askText();
  }

  /** The next occurrence after the selection, from the start again; false if there is none. */
  find(text: string): boolean {
    return this.field.find(text);
  }

  private get label(): string {
    return `Text of ${this.name}`;
  }

  private reset(): void {
    clearTimeout(this.timer);
    this.checked = undefined;
    this.running = undefined;
    this.field.mark([]);
    this.ask(false, false);
    this.show();
  }

  private typed(): void {
    clearTimeout(this.timer);
    this.checked = undefined;
    if (this.hasEdits) this.timer = window.setTimeout(() => void this.check(), PAUSE);
    else this.field.mark([]);
    this.show();
  }

  /** Reads the text, if it was edited since; of several only the last one counts. */
  private async check(): Promise<CheckedText | undefined> {
    clearTimeout(this.timer);
    if (this.checked) return this.checked;
    if (this.running) {
      this.timer = window.setTimeout(() => void this.check(), PAUSE);
      return undefined;
    }
    const running = this.read().finally(() => {
      if (this.running === running) this.running = undefined;
    });
    this.running = running;
    return running;
  }

  private async read(): Promise<CheckedText | undefined> {
    const { base, field } = this;
    const { revision } = field;
    try {
      const result = await this.calls.check(field.text, base);
      if (field.revision !== revision || this.base !== base) return undefined;
      this.checked = result;
      field.mark(result.diagnostics);
      this.show();
      return result;
    } catch (error) {
      this.say(sentenceOf(error));
      return undefined;
    }
  }

  private async applyNow(): Promise<void> {
    const { name } = this;
    if (!this.hasEdits) {
      this.say('Nothing was edited, so nothing was applied.');
      return;
    }
    // Of an earlier text, perhaps.
    while (this.running) await this.running;
    const found = await this.check();
    if (!found) return;
    const { isSame, apply } = found;
    if (!apply) this.say(`Not applied. ${this.whyNot() ?? ''}`.trim());
    else if (isSame) this.say('Nothing was applied: only blanks or comments were edited, which the page doesn’t keep.');
    else if (apply()) {
      this.base = this.field.text;
      this.field.settle();
      this.reset();
      this.calls.applied();
      this.say(`Applied to ${name}. One Undo reverts it.`);
    } else this.say(`Not applied: the text of ${name} doesn’t fit what is open now.`);
  }

  private discardNow(): void {
    this.field.discard();
    this.reset();
    this.say('The edits were discarded.');
    this.focus();
  }

  private ask(asks: boolean, takesFocus = true): void {
    write(this.question, 'hidden', !asks);
    write(this.bar, 'hidden', asks);
    if (!takesFocus) return;
    if (asks) this.keep.focus();
    else this.focus();
  }

  private warnOfChange(): void {
    this.say('The page has changed since you started editing. Apply overwrites those changes too.');
  }

  /** Why the text can't be applied; undefined if it can. */
  private whyNot(): string | undefined {
    const found = this.checked;
    if (!found || found.apply) return undefined;
    const errors = found.diagnostics.filter(({ severity }) => severity === 'error').length;
    return `The text has ${plural(errors, 'error')}. Correct ${errors === 1 ? 'it' : 'them'} first.`;
  }

  private show(): void {
    const { checked, hasEdits } = this;
    setAttribute(this.apply, 'aria-disabled', hasEdits && !this.whyNot() ? undefined : 'true');
    write(this.discard, 'hidden', !hasEdits);
    const found = checked?.diagnostics ?? [];
    write(this.list, 'hidden', found.length === 0);
    this.list.replaceChildren(...found.slice(0, MAX_PROBLEMS).map((each) => this.problem(each)));
    if (found.length > MAX_PROBLEMS) {
      this.list.append(element('li', {}, plural(found.length - MAX_PROBLEMS, 'more problem')));
    }
    if (!hasEdits) this.say('Edit the text, then apply it.');
    else if (!checked) this.say('Checking…');
    else this.say(this.whyNot() ?? 'The text can be applied.');
  }

  private problem({ severity, line, message }: Diagnostic): HTMLElement {
    const text = `${line > 0 ? `Line ${line}: ` : ''}${message}`;
    const own = element('li', { 'data-severity': severity });
    if (line === 0) own.append(text);
    else own.append(button(text, { class: 'link' }, text, () => this.goTo(line)));
    return own;
  }

  private say(text: string): void {
    setText(this.status, text);
  }

  private onKey(event: KeyboardEvent): void {
    const isApply = event.key === 'Enter' && (event.ctrlKey || event.metaKey) && !event.altKey && !event.shiftKey;
    // The field closes its search first.
    if (event.defaultPrevented || event.isComposing || !(isApply || event.key === 'Escape')) return;
    event.preventDefault();
    event.stopPropagation();
    if (isApply) void this.applyNow();
    else if (this.question.hidden) this.leave();
    else this.ask(false);
  }
}

/** As the field has them. */
function withPlainEnds(text: string): string {
  return text.replace(/\r*\n|\r/g, '\n');
}
