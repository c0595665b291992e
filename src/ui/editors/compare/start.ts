/** What the panel shows before there is a dump: what to print, how, and a field for it. */

import { tryById } from '../../state/actions/action.ts';
import { manualLink } from '../../state/manual-link.ts';
import type { Uses } from '../../state/workbench.ts';
import { BLOCKED, copyText } from '../../widgets/clipboard.ts';
import { button, element, uniqueId } from '../../widgets/dom.ts';
import { plainButton } from '../../widgets/form/form.ts';
import { icon } from '../../widgets/icons.ts';
import { SNIPPETS } from './snippets.ts';

/** The name of numbers that were pasted: those of the next paste take their place. */
const PASTED = 'pasted.txt';

/** Compares text as if it were a file that was dropped. */
export function compareText({ files }: Uses<'files'>, text: string): void {
  const data = new DataTransfer();
  data.items.add(new File([text], PASTED, { type: 'text/plain' }));
  files.paste(data);
}

export function startPage(wb: Uses<'files' | 'messages' | 'actions'>): HTMLElement {
  const id = uniqueId('paste');
  const field = element('textarea', {
    id,
    class: 'compare-field',
    rows: 3,
    spellcheck: 'false',
    autocomplete: 'off',
    placeholder: 'root: 1 0 0 0  0 1 0 0  0 0 1 0  0 0.36 0 1',
  });
  const run = button('Compare', { class: 'offer-accept', tooltip: undefined }, 'Compare', () => {
    if (field.value.trim() === '') {
      wb.messages.note('Paste the numbers that your program printed first.');
      field.focus();
      return;
    }
    compareText(wb, field.value);
  });
  field.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    run.click();
  });
  return element(
    'div',
    { class: 'compare-start' },
    element(
      'div',
      { class: 'compare-about' },
      element(
        'label',
        { for: id },
        'Print your world matrices, one joint per line, and drop or open the file, or paste the numbers:',
      ),
      field,
      element(
        'div',
        { class: 'compare-run' },
        run,
        plainButton('Open file…', () => tryById(wb, 'file.open')),
      ),
      element(
        'p',
        {},
        'Marrow tells you which joint is wrong first, and which mistake explains all of it. Vertices, normals, joint ' +
          'positions and channel values (rows of a time and values) work too, as do OBJ, PLY and JSON.',
      ),
      element(
        'p',
        { class: 'faint' },
        'They are compared with the selected character, at the time given in the text (time 1.5) or, if none, the current time. ' +
          'Nothing in the document is changed. ',
        manualLink('How to check a program', 'comparing'),
      ),
    ),
    element('div', { class: 'compare-snippets' }, ...SNIPPETS.map(([language, code]) => snippet(wb, language, code))),
  );
}

function snippet({ messages }: Uses<'messages'>, language: string, code: string): HTMLElement {
  const copy = async () => {
    if (await copyText(code)) messages.note(`Copied the ${language} lines.`);
    else messages.note(BLOCKED, 'warning');
  };
  return element(
    'section',
    { class: 'compare-snippet', 'aria-label': language },
    element(
      'div',
      { class: 'compare-snippet-head' },
      element('h4', {}, language),
      button(`Copy for ${language}`, { class: 'tool small' }, icon('copy'), () => void copy()),
    ),
    element('pre', { tabindex: 0 }, element('code', {}, code)),
  );
}
