/** Editing the text of the file that is shown: when it can be, its field, and what was left unapplied of other files. */
import { sentenceOf } from '../../../model/failure.ts';
import { baseName } from '../../../model/files.ts';
import { onDemand } from '../../state/on-demand.ts';
import { MAX_TEXT_BYTES, type TextEdits } from '../../state/source.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, write } from '../../widgets/dom.ts';
import { bytes, count } from '../../widgets/numbers/number-text.ts';
import { contentKey, type TextState } from './as-opened.ts';
import type { OpenedSource } from './opened-source.ts';
import type { Draft, TextEditor } from './text-editor.ts';

/** More lines are not edited. */
const MAX_LINES = 500_000;

type Parts = Uses<'store' | 'messages'>;

interface Calls {
  edits(): Promise<TextEdits>;
  /** It begins or ends. */
  onChange(): void;
  say(text: string): void;
}

export class Editing {
  readonly element = element('div', { class: 'source-editing', hidden: true });
  /** The file that is edited. */
  path: string | undefined;
  private editor: TextEditor | undefined;
  /** What the page had from the file when the text was taken. */
  private key = '';
  private isBeginning = false;
  private readonly drafts = new Map<string, Draft>();

  constructor(
    private readonly wb: Parts,
    private readonly calls: Calls,
  ) {
    window.addEventListener('beforeunload', (event) => {
      if (this.editor?.hasEdits || this.drafts.size > 0) event.preventDefault();
    });
  }

  /** Why a file can't be edited, as a sentence; undefined if it can. */
  whyNot(opened: OpenedSource | undefined, state: TextState, hasErrors: boolean): string | undefined {
    if (!opened) return 'There is no file to edit.';
    const { path, map } = opened;
    const name = baseName(path);
    const isOpen = contentKey(this.wb.store.document, path) !== '';
    if (state === 'other' && !hasErrors)
      return `This is not the version of ${name} that is open. Open the file again to edit it.`;
    // A text with errors is corrected, and opened by that.
    if (!isOpen && !hasErrors) return `Nothing open belongs to ${name}.`;
    if (!map) return `${name} is being read.`;
    const { bytes: size, count: lines } = map.index;
    if (size <= MAX_TEXT_BYTES && lines <= MAX_LINES) return undefined;
    const most = `${bytes(MAX_TEXT_BYTES)} and ${count(MAX_LINES)} lines`;
    return `Texts up to ${most} can be edited here; this one has ${bytes(size)} and ${count(lines)} lines.`;
  }

  /** Whether a file has edits that were left. */
  hasDraft(path: string): boolean {
    return this.drafts.has(path);
  }

  /** @param isOpened whether the text is what was opened */
  async begin(opened: OpenedSource, isOpened: boolean): Promise<void> {
    if (this.isBeginning) return;
    this.isBeginning = true;
    try {
      const { path } = opened;
      const editor = await this.loaded();
      const key = contentKey(this.wb.store.document, path);
      const base = editor && (await (isOpened ? this.textNow(opened) : opened.text?.text()));
      if (!editor || base === undefined) return;
      this.key = key;
      this.path = path;
      for (const each of [this.element, editor.element]) write(each, 'hidden', false);
      editor.open(baseName(path), base, this.drafts.get(path));
      this.drafts.delete(path);
      this.calls.onChange();
      editor.focus();
    } catch (error) {
      this.calls.say(sentenceOf(error));
    } finally {
      this.isBeginning = false;
    }
  }

  /** Asks if there are edits. */
  leave(): void {
    this.editor?.leave();
  }

  /** Ends it; edits are kept for the next time. */
  end(): void {
    const { path, editor } = this;
    if (path === undefined || !editor) return;
    const { draft } = editor;
    if (draft) this.drafts.set(path, draft);
    this.path = undefined;
    for (const each of [this.element, editor.element]) write(each, 'hidden', true);
    editor.close();
    this.calls.onChange();
  }

  /** The document may have changed. */
  async follow(opened: OpenedSource | undefined): Promise<void> {
    const { path, editor } = this;
    // A file that was saved in place holds what is shown.
    if (path === undefined || !editor || opened?.path !== path || opened.isOld) return;
    const key = contentKey(this.wb.store.document, path);
    if (key === this.key) return;
    this.key = key;
    try {
      const base = await this.textNow(opened);
      if (base !== undefined && this.path === path && this.key === key) editor.follow(base);
    } catch (error) {
      this.calls.say(sentenceOf(error));
    }
  }

  goTo(line: number): void {
    this.editor?.goTo(line);
  }

  askText(): void {
    this.editor?.askText();
  }

  find(text: string): boolean {
    return this.editor?.find(text) ?? false;
  }

  focus(): void {
    this.editor?.focus();
  }

  /** The text as the page has it now. */
  private async textNow({ path, text }: OpenedSource): Promise<string | undefined> {
    const { changed } = await (await this.calls.edits()).changes(path);
    return await (changed?.text ?? text)?.text();
  }

  private async loaded(): Promise<TextEditor | undefined> {
    if (this.editor) return this.editor;
    const module = await onDemand(this.wb.messages, 'The text editor', () => import('./text-editor.ts'));
    if (!module) return undefined;
    this.editor = new module.TextEditor({
      check: async (edited, base) => (await this.calls.edits()).check(this.path ?? '', edited, base),
      applied: () => {
        this.key = contentKey(this.wb.store.document, this.path ?? '');
      },
      leave: () => this.end(),
    });
    this.element.append(this.editor.element);
    return this.editor;
  }
}
