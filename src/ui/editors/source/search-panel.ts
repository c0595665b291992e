/** Search and replace above the text in its field, with how many matches there are. */
import {
  closeSearchPanel,
  findNext,
  findPrevious,
  getSearchQuery,
  replaceAll,
  replaceNext,
  SearchQuery,
  setSearchQuery,
} from '@codemirror/search';
import { type Command, type EditorView, type Panel, runScopeHandlers, type ViewUpdate } from '@codemirror/view';
import { element, setAttribute, setText, write } from '../../widgets/dom.ts';
import { count, plural } from '../../widgets/numbers/number-text.ts';

/** More are not counted, nor any in a longer text, in characters: it would take up to a second for every key. */
const MAX_COUNTED = 1000;
const MAX_SEARCHED = 500_000;

export function searchPanel(view: EditorView): Panel {
  return new SearchPanel(view);
}

class SearchPanel implements Panel {
  readonly top = true;
  readonly dom: HTMLElement;
  private readonly find = field('Find');
  private readonly replacement = field('Replace with');
  private readonly matchCase = checkBox('Match case');
  private readonly wholeWord = checkBox('Whole words');
  private readonly regexp = checkBox('Regular expression');
  private readonly matches = element('span', { class: 'cm-matches', role: 'status' });

  constructor(private readonly view: EditorView) {
    // CodeMirror focuses it when the panel is asked for again.
    setAttribute(this.find, 'main-field', 'true');
    const button = (label: string, command: Command) => {
      const own = element('button', { type: 'button', class: 'cm-button' }, label);
      own.addEventListener('click', () => this.run(command));
      return own;
    };
    this.dom = element(
      'div',
      { class: 'cm-search', role: 'search', 'aria-label': 'Find and replace' },
      element('div', {}, this.find, button('Next', findNext), button('Previous', findPrevious)),
      element('div', {}, this.replacement, button('Replace', replaceNext), button('Replace all', replaceAll)),
      element('div', {}, ...[this.matchCase, this.wholeWord, this.regexp].map(({ label }) => label)),
      this.matches,
      button('Close', closeSearchPanel),
    );
    for (const each of ['input', 'change']) this.dom.addEventListener(each, () => this.ask());
    this.dom.addEventListener('keydown', (event) => this.onKey(event));
    this.show(getSearchQuery(view.state));
  }

  mount(): void {
    this.find.select();
  }

  update({ transactions, docChanged, state }: ViewUpdate): void {
    const isAsked = transactions.some(({ effects }) => effects.some((effect) => effect.is(setSearchQuery)));
    if (isAsked) this.show(getSearchQuery(state));
    else if (docChanged) setText(this.matches, '');
  }

  /** Takes what the fields say. */
  private ask(): void {
    const query = new SearchQuery({
      search: this.find.value,
      replace: this.replacement.value,
      caseSensitive: this.matchCase.box.checked,
      wholeWord: this.wholeWord.box.checked,
      regexp: this.regexp.box.checked,
      literal: !this.regexp.box.checked,
    });
    if (!query.eq(getSearchQuery(this.view.state))) this.view.dispatch({ effects: setSearchQuery.of(query) });
  }

  private show(query: SearchQuery): void {
    write(this.find, 'value', query.search);
    write(this.replacement, 'value', query.replace);
    write(this.matchCase.box, 'checked', query.caseSensitive);
    write(this.wholeWord.box, 'checked', query.wholeWord);
    write(this.regexp.box, 'checked', query.regexp);
    this.count(query);
  }

  private count(query: SearchQuery): void {
    if (!query.valid) {
      setText(this.matches, query.search === '' ? '' : 'Not a regular expression');
      return;
    }
    if (this.view.state.doc.length > MAX_SEARCHED) {
      setText(this.matches, '');
      return;
    }
    const cursor = query.getCursor(this.view.state);
    let found = 0;
    while (found <= MAX_COUNTED && !cursor.next().done) found++;
    const some = found > MAX_COUNTED ? `More than ${count(MAX_COUNTED)} matches` : plural(found, 'match', 'matches');
    setText(this.matches, found === 0 ? 'No matches' : some);
  }

  private onKey(event: KeyboardEvent): void {
    if (runScopeHandlers(this.view, event, 'search-panel')) {
      event.preventDefault();
      return;
    }
    const { key, target, shiftKey, ctrlKey, metaKey, isComposing } = event;
    if (key !== 'Enter' || ctrlKey || metaKey || isComposing || !(target instanceof HTMLInputElement)) return;
    event.preventDefault();
    if (target === this.replacement) this.run(replaceNext);
    else this.run(shiftKey ? findPrevious : findNext);
  }

  private run(command: Command): void {
    if (!command(this.view)) setText(this.matches, 'No matches');
  }
}

function field(label: string): HTMLInputElement {
  return element('input', {
    ...{ class: 'cm-textfield', 'aria-label': label, placeholder: label, spellcheck: 'false', autocomplete: 'off' },
  });
}

function checkBox(text: string): { readonly label: HTMLElement; readonly box: HTMLInputElement } {
  const box = element('input', { type: 'checkbox' });
  return { label: element('label', {}, box, text), box };
}
