/**
 * The field that a text is edited in: CodeMirror, with search and replace, its own undo, matching braces, and the
 * colours of the lines outside the editor. It lives in a shadow root, whose adopted sheets take its styles: a `<style>`
 * in the page would break the page's policy.
 */
import {
  copyLineDown,
  copyLineUp,
  cursorMatchingBracket,
  deleteLine,
  history,
  historyKeymap,
  indentLess,
  indentMore,
  moveLineDown,
  moveLineUp,
  standardKeymap,
} from '@codemirror/commands';
import { bracketMatching } from '@codemirror/language';
import { lintGutter, type Diagnostic as Mark, nextDiagnostic, setDiagnostics } from '@codemirror/lint';
import {
  closeSearchPanel,
  findNext,
  findPrevious,
  openSearchPanel,
  SearchQuery,
  search,
  setSearchQuery,
} from '@codemirror/search';
import { EditorState, type Extension, Text } from '@codemirror/state';
import {
  Decoration,
  type DecorationSet,
  EditorView,
  keymap,
  lineNumbers,
  MatchDecorator,
  ViewPlugin,
  type ViewUpdate,
} from '@codemirror/view';
import type { Diagnostic } from '../../../model/diagnostic.ts';
import { element } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { codeTheme } from './code-theme.ts';
import { WORDS } from './line-text.ts';
import { searchPanel } from './search-panel.ts';

/** Escape and Ctrl+Enter are those of the editor around the field, Tab moves the focus on. */
const KEYS = keymap.of([
  { key: 'F3', run: findNext, shift: findPrevious, scope: 'editor search-panel', preventDefault: true },
  { key: 'Escape', run: closeSearchPanel, scope: 'editor search-panel' },
  { key: 'F8', run: nextDiagnostic },
  { key: 'Alt-ArrowUp', run: moveLineUp, shift: copyLineUp },
  { key: 'Alt-ArrowDown', run: moveLineDown, shift: copyLineDown },
  { key: 'Mod-[', run: indentLess },
  { key: 'Mod-]', run: indentMore },
  { key: 'Shift-Mod-k', run: deleteLine },
  { key: 'Shift-Mod-\\', run: cursorMatchingBracket },
  ...historyKeymap,
  ...standardKeymap,
]);

const WORD = new MatchDecorator({ regexp: WORDS, decoration: Decoration.mark({ class: 'cm-word' }) });

/** Of the lines in view only. */
class WordColours {
  marks: DecorationSet;

  constructor(view: EditorView) {
    this.marks = WORD.createDeco(view);
  }

  update(update: ViewUpdate): void {
    this.marks = WORD.updateDeco(update, this.marks);
  }
}

/**
 * What is typed over a selection. Chromium would keep the colour of a word that it deletes by an inline style, which
 * the page's policy refuses.
 */
const TYPED_OVER = EditorView.domEventHandlers({
  beforeinput({ inputType, data, isComposing }, view) {
    if (inputType !== 'insertText' || data === null || isComposing || view.state.selection.main.empty) return false;
    view.dispatch(view.state.replaceSelection(data), { userEvent: 'input.type', scrollIntoView: true });
    return true;
  },
});

export class CodeField {
  readonly element = element('div', { class: 'source-code', tabindex: 0, [HAS_KEYS]: true });
  private readonly view: EditorView;
  /** The text without edits. */
  private base = Text.empty;
  /** Counts edits. */
  revision = 0;

  /** @param onEdit called after every edit, undone and redone ones too */
  constructor(private readonly onEdit: () => void) {
    // The focus goes to the text, which asks for it by `autofocus`.
    const parent = this.element.attachShadow({ mode: 'open', delegatesFocus: true });
    this.view = new EditorView({ parent });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  get hasEdits(): boolean {
    return !this.view.state.doc.eq(this.base);
  }

  /**
   * Shows a text, with nothing to undo.
   *
   * @param label its accessible name
   * @param base what it is without edits, default the same
   */
  open(label: string, text: string, base = text): void {
    this.base = Text.of(base.split('\n'));
    this.view.setState(EditorState.create({ doc: text, extensions: this.extensions(label) }));
    this.revision++;
  }

  /** Shows another text at the same place. */
  replace(label: string, text: string): void {
    const { view } = this;
    const { head } = view.state.selection.main;
    const scroll = view.scrollSnapshot();
    this.open(label, text);
    view.dispatch({ selection: { anchor: Math.min(head, view.state.doc.length) }, effects: scroll });
  }

  /** The text as it is counts as without edits. */
  settle(): void {
    this.base = this.view.state.doc;
  }

  /** Takes all edits back, which can be undone. */
  discard(): void {
    const { view, base } = this;
    view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: base } });
  }

  focus(): void {
    this.view.focus();
  }

  /** Selects a line, from 1; the last one if there are fewer. */
  goTo(line: number): void {
    const { view } = this;
    const { from, to } = view.state.doc.line(Math.min(line, view.state.doc.lines));
    view.dispatch({
      selection: { anchor: from, head: to },
      effects: EditorView.scrollIntoView(from, { y: 'nearest', yMargin: 36 }),
    });
    this.focus();
  }

  /** Opens search and replace, or goes to its field. */
  askText(): void {
    openSearchPanel(this.view);
  }

  /** Selects the next occurrence, from the start again, and opens search and replace with it; false if there is none. */
  find(text: string): boolean {
    const { view } = this;
    openSearchPanel(view);
    view.dispatch({ effects: setSearchQuery.of(new SearchQuery({ search: text, literal: true })) });
    return findNext(view);
  }

  /** Marks problems at their places; those without a line have none. */
  mark(problems: readonly Diagnostic[]): void {
    const { state } = this.view;
    const marks = problems
      .filter(({ line }) => line > 0 && line <= state.doc.lines)
      .map((each) => markOf(state.doc, each));
    this.view.dispatch(setDiagnostics(state, marks));
  }

  private extensions(label: string): Extension {
    return [
      lintGutter(),
      lineNumbers(),
      history(),
      bracketMatching({ brackets: '{}' }),
      search({ top: true, createPanel: searchPanel }),
      ViewPlugin.fromClass(WordColours, { decorations: ({ marks }) => marks }),
      EditorState.tabSize.of(4),
      EditorView.contentAttributes.of({
        autofocus: '',
        tabindex: '0',
        'aria-label': label,
        'aria-description': 'Tab moves on, Escape leaves the editor',
      }),
      KEYS,
      TYPED_OVER,
      codeTheme,
      EditorView.updateListener.of(({ docChanged }) => {
        if (!docChanged) return;
        this.revision++;
        this.onEdit();
      }),
    ];
  }
}

/** From where the problem is to the end of its word. A column counts characters, the editor units of UTF-16. */
export function markOf(doc: Text, { line: number, column, severity, message }: Diagnostic): Mark {
  const line = doc.line(number);
  let at = 0;
  for (let left = column - 1; left > 0 && at < line.length; left--)
    at += (line.text.codePointAt(at) ?? 0) > 0xffff ? 2 : 1;
  const from = line.from + at;
  const length = /^[^\s{}]+/.exec(line.text.slice(from - line.from))?.[0].length ?? 1;
  return { from, to: Math.min(line.to, from + length), severity, message };
}
