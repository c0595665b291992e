/**
 * Dialogs of the tools for whole curves: a few fields, a summary of the result, and a live preview of the curves: one
 * undo step when applied, nothing when closed.
 */

import type { Edit } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import { CommandError } from '../../../edit/command-error.ts';
import { EditPreview } from '../../../edit/edit-preview.ts';
import type { Steps } from '../../../evaluate/steps.ts';
import type { Document } from '../../../model/document.ts';
import { unitsBehind } from '../../state/joints/angles.ts';
import type { DialogName, Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { atMostEvery } from '../../widgets/frame.ts';
import { inSlices } from '../../widgets/in-slices.ts';
import { parseNumber } from '../../widgets/numbers/number-text.ts';
import { aboutKeysInHand } from './current-take.ts';

export interface NumberAsked {
  readonly kind: 'number';
  readonly name: string;
  readonly label: string;
  readonly value: number;
  /** Shown after the field. */
  readonly unit?: string;
  readonly onlyFor?: OnlyFor;
}

export interface ChoiceAsked {
  readonly kind: 'choice';
  readonly name: string;
  readonly label: string;
  readonly value: string;
  readonly options: readonly (readonly [string, string])[];
  readonly onlyFor?: OnlyFor;
}

/** Shown only while the choice of this name has this value. */
export type OnlyFor = readonly [name: string, value: string];

export type Asked = NumberAsked | ChoiceAsked;

/** The answers, by the names of the questions. */
export interface Answers {
  number(name: string): number;
  choice(name: string): string;
}

export interface ToolDialog<A> {
  readonly name: DialogName;
  readonly title: string;
  /** What the tool does, in one sentence. */
  readonly about: string;
  readonly asked: readonly Asked[];
  readonly command: Command<A, Document | Edit>;
  args(answers: Answers): A;
  /**
   * The command in steps, if it may take long: yields its progress, and returns the change with a summary. Changing an
   * answer or closing the dialog stops it.
   */
  steps?(base: Document, args: A): Steps<Stepped>;
  /** Whether steps with these answers run only on request: by the button, or when applying. */
  takesLong?(args: A): boolean;
  /** Called after the result was applied. */
  applied?(): void;
  /** Summary of the result: `1,240 → 86 keys, largest error 0.12°`. `after` is the changed document. */
  result(args: A, after: Document): string;
}

/** A change made in steps, and its summary. */
export interface Stepped {
  readonly change: Document | Edit;
  readonly text: string;
  /** A warning shown before applying, and repeated afterwards. */
  readonly warning?: string;
}

/** Minimum interval of previews while typing. */
const PREVIEW_MS = 120;

export function toolDialog<A>(
  wb: Uses<'store' | 'timeline' | 'messages' | 'dialog'>,
  close: () => void,
  tool: ToolDialog<A>,
): DialogContent {
  const { store } = wb;
  const fields = new Map<string, HTMLInputElement | HTMLSelectElement>();
  const result = element('p', { class: 'tool-result', role: 'status' });
  const warned = element('p', { class: 'tool-result wrong', role: 'status', hidden: true });
  const apply = element('button', { type: 'submit', class: 'plain primary' }, 'Apply');
  const cancel = element('button', { type: 'button', class: 'plain' }, 'Cancel');
  const body = element('form', { class: 'tool-form' }, element('p', { class: 'faint' }, tool.about));
  const rows = tool.asked.map((asked) => ({ asked, row: fieldOf(asked, fields) }));
  for (const { row } of rows) body.append(row);
  const showAsked = () => {
    for (const { asked, row } of rows) {
      write(row, 'hidden', asked.onlyFor !== undefined && fields.get(asked.onlyFor[0])?.value !== asked.onlyFor[1]);
    }
  };
  showAsked();
  const tryOut = element('button', { type: 'button', class: 'plain', hidden: true }, 'Preview');
  body.append(result, warned, element('div', { class: 'tool-buttons' }, tryOut, cancel, apply));

  const answers: Answers = {
    number(name) {
      const asked = tool.asked.find((one) => one.name === name);
      const unit = asked?.kind === 'number' ? asked.unit : undefined;
      const typed = parseNumber(fields.get(name)?.value ?? '', unit ? unitsBehind(unit) : undefined);
      if (typed === undefined) throw new CommandError(`${labelOf(tool.asked, name)} must be a number.`);
      return typed;
    },
    choice: (name) => fields.get(name)?.value ?? '',
  };
  const name = tool.title.replace('…', '');
  const command = aboutKeysInHand(wb, asEdit(tool.command));
  const preview = new EditPreview(store, name, () => {
    wb.messages.note(`${name} was not applied because the document has changed. Try again.`, 'warning');
    unsubscribe();
    close();
  });
  // The original document is the reference, whatever is previewed.
  const { base } = preview;
  /** The undo step's name. */
  let called = name;
  /** Counts requests: steps of an older one stop. */
  let asked = 0;
  /** Steps are running; when they are done, the dialog applies and closes. */
  let waits = false;
  let keepsWhenDone = false;
  const warn = (text = '') => {
    write(warned, 'hidden', text === '');
    setText(warned, text);
  };
  const refuse = (error: unknown) => {
    if (!(error instanceof CommandError)) throw error;
    warn();
    preview.show(base);
    setText(result, error.message);
    result.classList.add('wrong');
    write(apply, 'disabled', true);
  };
  const goOn = (steps: Steps<Stepped>, mine: number) =>
    inSlices(steps, {
      isOver: () => preview.over || mine !== asked,
      progress: (part) => setText(result, `Working… ${Math.floor(100 * part)}%`),
      done({ change, text, warning }) {
        preview.show(change);
        setText(result, text);
        warn(warning);
        write(apply, 'disabled', store.document === base);
        if (keepsWhenDone && !apply.disabled) {
          end(true);
          close();
        }
        keepsWhenDone = false;
      },
      failed: refuse,
    });
  /** @param isAsked the user has requested a preview that takes long */
  const showPreview = (isAsked = false) => {
    if (preview.over) return;
    try {
      const args = tool.args(answers);
      called = command.label(base, args);
      if (tool.steps) {
        result.classList.remove('wrong');
        warn();
        waits = !isAsked && tool.takesLong?.(args) === true;
        write(tryOut, 'hidden', !waits);
        write(apply, 'disabled', !waits);
        if (waits) {
          asked++;
          preview.show(base);
          setText(result, 'This takes a moment. Preview or apply it to see the result.');
          return;
        }
        goOn(tool.steps(base, args), ++asked);
        return;
      }
      const edit = command.run(base, args);
      preview.show(edit);
      setText(result, tool.result(args, edit.document));
      result.classList.remove('wrong');
      write(apply, 'disabled', store.document === base);
    } catch (error) {
      asked++;
      waits = keepsWhenDone = false;
      write(tryOut, 'hidden', true);
      refuse(error);
    }
  };
  const end = (keep: boolean) => {
    if (preview.over) return;
    // Steps are already done when their result is applied.
    if (keep && !tool.steps) showPreview();
    unsubscribe();
    if (!keep) return preview.putBack();
    preview.keep(called);
    tool.applied?.();
    if (warned.textContent) wb.messages.note(warned.textContent, 'warning');
  };
  const unsubscribe = wb.dialog.subscribe((shown) => {
    if (shown !== tool.name) end(false);
  });
  const soon = atMostEvery(PREVIEW_MS, () => showPreview());
  body.addEventListener('input', () => {
    showAsked();
    // The result is outdated.
    if (tool.steps) write(apply, 'disabled', true);
    keepsWhenDone = false;
    soon();
  });
  body.addEventListener('submit', (event) => {
    event.preventDefault();
    if (apply.disabled) return;
    if (waits) {
      keepsWhenDone = true;
      showPreview(true);
      return;
    }
    end(true);
    close();
  });
  tryOut.addEventListener('click', () => {
    // The button disappears, so move the focus.
    cancel.focus();
    showPreview(true);
  });
  cancel.addEventListener('click', close);
  showPreview();
  return { title: tool.title, body, kind: 'tool-dialog' };
}

/** A command that returns no keys selects none. */
function asEdit<A>(command: Command<A, Document | Edit>): Command<A, Edit> {
  return {
    ...command,
    run(document, args) {
      const change = command.run(document, args);
      return 'document' in change ? change : { document: change, keys: [] };
    },
  };
}

function fieldOf(asked: Asked, fields: Map<string, HTMLInputElement | HTMLSelectElement>): HTMLElement {
  const field =
    asked.kind === 'number'
      ? element('input', {
          type: 'text',
          inputmode: 'decimal',
          autocomplete: 'off',
          class: 'number-field',
          value: String(asked.value),
        })
      : element(
          'select',
          {},
          ...asked.options.map(([value, label]) =>
            element('option', { value, selected: value === asked.value }, label),
          ),
        );
  fields.set(asked.name, field);
  const row = element('label', { class: 'tool-field' }, element('span', {}, asked.label), field);
  // A choice uses the unit's column too.
  if (asked.kind === 'number') row.append(element('span', { class: 'faint' }, asked.unit));
  return row;
}

function labelOf(asked: readonly Asked[], name: string): string {
  return asked.find((a) => a.name === name)?.label ?? name;
}
