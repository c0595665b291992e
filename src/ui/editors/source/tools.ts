/** Controls of the tab *Source*, beside the tabs: the file, a search in it, and the number of a line. */
import { baseName } from '../../../model/files.ts';
import { element, keepsFocusElsewhere, setAttribute, setText, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { setTooltip } from '../../widgets/tooltip.ts';

export interface SourceTools {
  readonly element: HTMLElement;
  /** @param shown path of the file in view */
  showFiles(paths: readonly string[], shown: string | undefined): void;
  /** @param whyNot why the text can't be edited, as a sentence */
  showEditing(isOn: boolean, whyNot: string | undefined): void;
  /** Says in a few words what a line holds, or how far reading is. */
  say(text: string): void;
  askLine(): void;
  askText(): void;
}

interface Calls {
  choose(path: string): void;
  /** The next one after the current line. */
  find(text: string): void;
  goTo(line: number): void;
  /** Begins to edit the text, or ends it. */
  edit(): void;
  /** Back to the lines. */
  leave(): void;
}

export function sourceTools(calls: Calls): SourceTools {
  const files = element('select', { class: 'source-file', 'aria-label': 'File' });
  files.addEventListener('change', () => calls.choose(files.value));
  const find = field('search', 'Find in file', 'Find', (text) => calls.find(text), calls);
  const line = field(
    'text',
    'Go to line',
    'Line',
    (text) => {
      const number = Number.parseInt(text.replace(/\D/g, ''), 10);
      if (number > 0) calls.goTo(number);
    },
    calls,
  );
  line.inputMode = 'numeric';
  line.classList.add('source-go');
  const status = element('span', { class: 'source-status', role: 'status' });
  const editing = keepsFocusElsewhere(element('button', { type: 'button', class: 'tool source-toggle' }, 'Edit'));
  editing.addEventListener('click', () => calls.edit());
  let why: string | undefined;
  setTooltip(editing, () => why ?? 'Edit the text of this file');
  let listed = '';
  return {
    element: element(
      'div',
      { class: 'source-tools' },
      files,
      element('div', { class: 'search source-find' }, icon('search'), find),
      line,
      editing,
      status,
    ),
    showFiles(paths, shown) {
      const key = [...paths, shown].join('\n');
      if (key === listed) return;
      listed = key;
      files.replaceChildren(...paths.map((path) => element('option', { value: path }, labelOf(path, paths))));
      write(files, 'disabled', paths.length === 0);
      files.value = shown ?? '';
    },
    showEditing(isOn, whyNot) {
      why = whyNot;
      setAttribute(editing, 'aria-pressed', String(isOn));
      setAttribute(editing, 'aria-disabled', whyNot === undefined ? undefined : 'true');
    },
    say: (text) => setText(status, text),
    askLine: () => line.select(),
    askText: () => find.select(),
  };
}

/** The name, with folders if another file has the same. */
function labelOf(path: string, paths: readonly string[]): string {
  const name = baseName(path);
  return paths.some((other) => other !== path && baseName(other) === name) ? path : name;
}

function field(type: string, label: string, placeholder: string, run: (text: string) => void, calls: Calls) {
  const input = element('input', {
    ...{ type, 'aria-label': label, placeholder, spellcheck: 'false', autocomplete: 'off', class: 'source-field' },
  });
  input.addEventListener('keydown', (event) => {
    if (event.isComposing) return;
    if (event.key === 'Enter') run(input.value);
    else if (event.key === 'Escape') {
      input.value = '';
      calls.leave();
    } else if (event.key === 'ArrowDown') calls.leave();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  return input;
}
