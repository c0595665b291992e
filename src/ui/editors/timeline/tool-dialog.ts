/**
 * Dialogs that change the document: a form, a summary of the result, and a live preview of it: one undo step when
 * applied, nothing when closed.
 */

import type { Change } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import { EditPreview } from '../../../edit/edit-preview.ts';
import type { Steps } from '../../../evaluate/steps.ts';
import type { Document } from '../../../model/document.ts';
import { UserError } from '../../../model/user-error.ts';
import { untilClosed } from '../../state/until-closed.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, setText, write } from '../../widgets/dom.ts';
import { Form, type FormParts, plainButton } from '../../widgets/form/form.ts';
import { atMostEvery } from '../../widgets/frame.ts';
import { inSlices } from '../../widgets/in-slices.ts';
import { aboutKeysInHand } from './current-take.ts';

export interface ToolDialog<A> extends Pick<FormParts, 'about' | 'asked' | 'buttons' | 'applyTooltip'> {
  readonly title: string;
  /** Further CSS classes of the dialog. */
  readonly kind?: string;
  readonly command: Command<A, Document | Change>;
  args(answers: Form): A;
  /**
   * The command in steps, if it may take long: yields its progress, and returns the change with a summary. Changing an
   * answer or closing the dialog stops it.
   */
  steps?(base: Document, args: A): Steps<Stepped>;
  /** Whether steps with these answers run only on request: by the button, or when applying. */
  takesLong?(args: A): boolean;
  /** Other ways to end than by applying the command. */
  readonly others?: readonly OtherEnd<A>[];
  /** An answer was changed: of this field, or of an element between the fields. */
  changed?(field: string | undefined, form: Form): void;
  /** Called after the result was applied. */
  applied?(): void;
  /** Summary of the result without steps: `1,240 → 86 keys, largest error 0.12°`. `after` is the changed document. */
  result?(args: A, after: Document, form: Form): string;
}

/** Another way to end: a change of its own, as one undo step. */
export interface OtherEnd<A> {
  readonly button: HTMLButtonElement;
  /** Takes the answers, as applying does, and stands beside it. */
  readonly appliesAnswers: boolean;
  change(base: Document, args: () => A): { readonly document: Document; readonly label: string };
}

/** A change made in steps, and its summary. */
export interface Stepped {
  readonly change: Document | Change;
  readonly text: string;
  /** A warning shown before applying, and repeated afterwards. */
  readonly warning?: string;
}

/** Minimum interval of previews while typing. */
const PREVIEW_MS = 120;

type Parts = Uses<'store' | 'timeline' | 'messages' | 'dialog'>;

export function toolDialog<A>(wb: Parts, close: () => void, tool: ToolDialog<A>): DialogContent {
  const { form } = new Tool(wb, close, tool);
  return { title: tool.title, body: form.element, kind: `tool-dialog ${tool.kind ?? ''}`.trim() };
}

class Tool<A> {
  readonly form: Form;
  private readonly command: Command<A, Document | Change>;
  private readonly preview: EditPreview;
  /** The original document is the reference, whatever is previewed. */
  private readonly base: Document;
  private readonly warned = element('p', { class: 'tool-result wrong', role: 'status', hidden: true });
  private readonly tryOut: HTMLButtonElement;
  /** The undo step's name. */
  private called: string;
  /** Counts requests: steps of an older one stop. */
  private request = 0;
  /** Steps run only on request. */
  private waits = false;
  /** Steps are running; when they are done, the dialog applies and closes. */
  private keepsWhenDone = false;

  constructor(
    private readonly wb: Parts,
    private readonly close: () => void,
    private readonly tool: ToolDialog<A>,
  ) {
    const name = tool.title.replace('…', '');
    this.called = name;
    this.command = aboutKeysInHand(wb, tool.command);
    this.preview = new EditPreview(wb.store, name, () => {
      wb.messages.note(`${name} was not applied because the document has changed. Try again.`, 'warning');
      close();
    });
    this.base = this.preview.base;
    this.tryOut = plainButton('Preview', () => {
      // The button disappears, so move the focus.
      this.form.cancel.focus();
      this.show(true);
    });
    write(this.tryOut, 'hidden', true);
    for (const other of tool.others ?? []) other.button.addEventListener('click', () => this.endBy(other));
    const soon = atMostEvery(PREVIEW_MS, () => this.show());
    this.form = new Form({
      ...tool,
      below: [this.warned],
      buttons: [...(tool.buttons ?? []), this.tryOut],
      beside: (tool.others ?? []).flatMap(({ button, appliesAnswers }) => (appliesAnswers ? button : [])),
      apply: 'Apply',
      changed: (field) => {
        tool.changed?.(field, this.form);
        // The result is outdated.
        if (tool.steps) this.form.allow(false);
        this.keepsWhenDone = false;
        soon();
      },
      applied: () => this.apply(),
      close,
    });
    untilClosed(wb).addEventListener('abort', () => {
      if (!this.preview.over) this.preview.putBack();
    });
    this.show();
  }

  /** @param isAsked the user has requested a preview that takes long */
  private show(isAsked = false): void {
    if (this.preview.over) return;
    const { tool, form, base, preview } = this;
    try {
      const args = tool.args(form);
      this.called = this.command.label(base, args);
      if (tool.steps) this.begin(tool.steps(base, args), !isAsked && tool.takesLong?.(args) === true);
      else {
        const change = this.command.run(base, args);
        preview.show(change);
        form.say(tool.result?.(args, 'document' in change ? change.document : change, form) ?? '');
        form.allow(this.wb.store.document !== base);
      }
    } catch (error) {
      this.request++;
      this.waits = this.keepsWhenDone = false;
      write(this.tryOut, 'hidden', true);
      this.refuse(error);
    }
  }

  private begin(steps: Steps<Stepped>, waits: boolean): void {
    const { form, preview, tryOut } = this;
    const mine = ++this.request;
    this.waits = waits;
    this.warn();
    form.allow(waits);
    write(tryOut, 'hidden', !waits);
    if (waits) {
      preview.show(this.base);
      form.say('This takes a moment. Preview or apply it to see the result.');
      return;
    }
    inSlices(steps, {
      isOver: () => preview.over || mine !== this.request,
      progress: (part) => form.say(`Working… ${Math.floor(100 * part)}%`),
      done: (stepped) => this.showStepped(stepped),
      failed: (error) => this.refuse(error),
    });
  }

  private showStepped({ change, text, warning }: Stepped): void {
    this.preview.show(change);
    this.form.say(text);
    this.warn(warning);
    this.form.allow(this.wb.store.document !== this.base);
    if (this.keepsWhenDone && this.form.isAllowed) this.keep();
    this.keepsWhenDone = false;
  }

  private warn(text = ''): void {
    write(this.warned, 'hidden', text === '');
    setText(this.warned, text);
  }

  private refuse(error: unknown): void {
    if (!(error instanceof UserError)) throw error;
    this.warn();
    this.preview.show(this.base);
    this.form.say(error.message, true);
    this.form.allow(false);
  }

  private apply(): void {
    if (this.waits) {
      this.keepsWhenDone = true;
      this.show(true);
      return;
    }
    // Steps are already done when their result is applied.
    if (!this.tool.steps) this.show();
    if (this.form.isAllowed) this.keep();
  }

  private endBy({ change }: OtherEnd<A>): void {
    if (this.preview.over) return;
    try {
      const { document, label } = change(this.base, () => this.tool.args(this.form));
      this.preview.show(document);
      this.called = label;
      this.keep();
    } catch (error) {
      this.refuse(error);
    }
  }

  private keep(): void {
    if (this.preview.over) return;
    this.preview.keep(this.called);
    const warning = this.warned.textContent;
    this.close();
    this.tool.applied?.();
    if (warning) this.wb.messages.note(warning, 'warning');
  }
}
