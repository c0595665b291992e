/**
 * The text of a file as a field to type in, with line numbers, and the problems of what was typed: in the margin, and as
 * a list below. A plain field, which brings its own undo, selection and accessibility, and draws a key of 50,000 lines
 * within 60 ms; an editor such as CodeMirror would be several times the script of this tab.
 *
 *     Ctrl+Enter   applies the text          Escape   leaves, and asks about edits
 */

import type { Diagnostic } from '../../../model/diagnostic.ts';
import { sentenceOf } from '../../../model/failure.ts';
import type { CheckedText } from '../../state/source.ts';
import { button, element, setAttribute, setText, uniqueId, write } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { setTooltip } from '../../widgets/tooltip.ts';
import { worstFirst } from './problems.ts';

/** As in the styles. */
const LINE_HEIGHT = 18;
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
  private readonly status = element('span', {
    class: 'source-edit-status',
    role: 'status',
    id: uniqueId('source-edit'),
  });
  private readonly field = element('textarea', {
    ...{ class: 'source-field-text', wrap: 'off', spellcheck: 'false', autocapitalize: 'off', autocomplete: 'off' },
    ...{ [HAS_KEYS]: true, 'aria-describedby': this.status.id },
  });
  private readonly gutter = element('div', { class: 'source-gutter', 'aria-hidden': 'true' });
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
  private checked: { readonly text: string; readonly result: CheckedText } | undefined;
  private isChecking = false;
  private timer = 0;
  private problems: ReadonlyMap<number, Diagnostic> = new Map();
  private readonly drawSoon = oncePerFrame(() => this.draw());

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
      element('div', { class: 'source-edit-body' }, this.gutter, this.field),
      this.list,
      this.bar,
      this.question,
    );
    this.field.addEventListener('input', () => this.typed());
    this.field.addEventListener('scroll', () => this.drawSoon());
    this.element.addEventListener('keydown', (event) => this.onKey(event));
    new ResizeObserver(() => this.drawSoon()).observe(this.field);
  }

  /** Shows a text, or edits of it that were left. */
  open(name: string, base: string, draft?: Draft): void {
    this.name = name;
    this.base = withPlainEnds(draft?.base ?? base);
    this.field.value = draft?.text ?? this.base;
    setAttribute(this.field, 'aria-label', `Text of ${name}`);
    this.field.setSelectionRange(0, 0);
    this.field.scrollTop = 0;
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
    const { scrollTop, selectionStart } = this.field;
    this.base = now;
    this.field.value = now;
    this.field.setSelectionRange(selectionStart, selectionStart);
    this.field.scrollTop = scrollTop;
    this.reset();
  }

  get hasEdits(): boolean {
    return this.field.value !== this.base;
  }

  get draft(): Draft | undefined {
    return this.hasEdits ? { base: this.base, text: this.field.value } : undefined;
  }

  /** Forgets the text; edits too. */
  close(): void {
    clearTimeout(this.timer);
    this.base = '';
    this.field.value = '';
    this.reset();
  }

  /** Leaves the text, after asking if it was edited. */
  leave(): void {
    if (this.hasEdits) this.ask(true);
    else this.calls.leave();
  }

  focus(): void {
    this.field.focus({ preventScroll: true });
  }

  /** @param line from 1 */
  goTo(line: number): void {
    const { field } = this;
    let at = 0;
    for (let left = line - 1; left > 0 && at >= 0; left--) at = field.value.indexOf('\n', at) + 1 || field.value.length;
    const end = field.value.indexOf('\n', at);
    field.setSelectionRange(at, end < 0 ? field.value.length : end);
    const top = (line - 1) * LINE_HEIGHT;
    const { scrollTop, clientHeight } = field;
    if (top < scrollTop || top + LINE_HEIGHT > scrollTop + clientHeight) field.scrollTop = top - clientHeight / 3;
    this.focus();
  }

  /** The next occurrence after the selection, from the start again; false if there is none. */
  find(text: string): boolean {
    const { field } = this;
    const [all, wanted] = [field.value.toLowerCase(), text.toLowerCase()];
    const after = all.indexOf(wanted, field.selectionEnd);
    const at = after < 0 ? all.indexOf(wanted) : after;
    if (at < 0) return false;
    this.goTo(lineAt(all, at));
    field.setSelectionRange(at, at + wanted.length);
    return true;
  }

  private reset(): void {
    clearTimeout(this.timer);
    this.checked = undefined;
    this.isChecking = false;
    this.problems = new Map();
    this.ask(false, false);
    this.show();
  }

  private typed(): void {
    clearTimeout(this.timer);
    this.checked = undefined;
    if (this.hasEdits) this.timer = window.setTimeout(() => void this.check(), PAUSE);
    else this.problems = new Map();
    this.show();
  }

  /** Reads the text, if it was edited since; of several only the last one counts. */
  private async check(): Promise<CheckedText | undefined> {
    clearTimeout(this.timer);
    const text = this.field.value;
    if (this.checked?.text === text) return this.checked.result;
    if (this.isChecking) {
      this.timer = window.setTimeout(() => void this.check(), PAUSE);
      return undefined;
    }
    this.isChecking = true;
    const { base } = this;
    try {
      const result = await this.calls.check(text, base);
      if (this.field.value !== text || this.base !== base) return undefined;
      this.checked = { text, result };
      this.problems = worstFirst(result.diagnostics.filter(({ line }) => line > 0));
      return result;
    } catch (error) {
      this.say(sentenceOf(error));
      return undefined;
    } finally {
      this.isChecking = false;
      if (this.checked?.text === text) this.show();
    }
  }

  private async applyNow(): Promise<void> {
    const { name } = this;
    if (!this.hasEdits) {
      this.say('Nothing was edited, so nothing was applied.');
      return;
    }
    const found = await this.check();
    if (!found) return;
    const { isSame, apply } = found;
    if (!apply) this.say(`Not applied. ${this.whyNot() ?? ''}`.trim());
    else if (isSame) this.say('Nothing was applied: only blanks or comments were edited, which the page doesn’t keep.');
    else if (apply()) {
      this.base = this.field.value;
      this.reset();
      this.calls.applied();
      this.say(`Applied to ${name}. One Undo reverts it.`);
    } else this.say(`Not applied: the text of ${name} doesn’t fit what is open now.`);
  }

  private discardNow(): void {
    this.field.value = this.base;
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
    const found = this.checked?.result;
    if (!found || found.apply) return undefined;
    const errors = found.diagnostics.filter(({ severity }) => severity === 'error').length;
    return `The text has ${plural(errors, 'error')}. Correct ${errors === 1 ? 'it' : 'them'} first.`;
  }

  private show(): void {
    const { checked, hasEdits } = this;
    setAttribute(this.apply, 'aria-disabled', hasEdits && !this.whyNot() ? undefined : 'true');
    write(this.discard, 'hidden', !hasEdits);
    const found = checked?.result.diagnostics ?? [];
    write(this.list, 'hidden', found.length === 0);
    this.list.replaceChildren(...found.slice(0, MAX_PROBLEMS).map((each) => this.problem(each)));
    if (found.length > MAX_PROBLEMS) {
      this.list.append(element('li', {}, plural(found.length - MAX_PROBLEMS, 'more problem')));
    }
    if (!hasEdits) this.say('Edit the text, then apply it.');
    else if (!checked) this.say('Checking…');
    else this.say(this.whyNot() ?? 'The text can be applied.');
    this.drawSoon();
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

  /** The numbers of the lines in view. */
  private draw(): void {
    const { field, gutter } = this;
    if (this.element.hidden) return;
    const lines = field.value.split('\n').length;
    const first = Math.floor(field.scrollTop / LINE_HEIGHT);
    const last = Math.min(lines, first + Math.ceil(field.clientHeight / LINE_HEIGHT) + 1);
    this.element.style.setProperty('--source-digits', String(Math.max(3, String(lines).length)));
    const numbers: HTMLElement[] = [];
    for (let line = first + 1; line <= last; line++) {
      const problem = this.problems.get(line);
      const number = element('span', { class: 'source-gutter-line', 'data-severity': problem?.severity }, String(line));
      number.style.top = `${(line - 1) * LINE_HEIGHT - field.scrollTop}px`;
      if (problem) setTooltip(number, problem.message);
      numbers.push(number);
    }
    gutter.replaceChildren(...numbers);
  }

  private onKey(event: KeyboardEvent): void {
    const isApply = event.key === 'Enter' && (event.ctrlKey || event.metaKey) && !event.altKey && !event.shiftKey;
    if (event.isComposing || !(isApply || event.key === 'Escape')) return;
    event.preventDefault();
    event.stopPropagation();
    if (isApply) void this.applyNow();
    else if (this.question.hidden) this.leave();
    else this.ask(false);
  }
}

/** As a field has them. */
function withPlainEnds(text: string): string {
  return text.replace(/\r*\n|\r/g, '\n');
}

function lineAt(text: string, at: number): number {
  let line = 1;
  for (let end = text.indexOf('\n'); end >= 0 && end < at; end = text.indexOf('\n', end + 1)) line++;
  return line;
}
