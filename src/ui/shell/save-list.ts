/** The save dialog: each character, with every file format it can be saved as. */

import { EXCHANGE_FORMATS, EXCHANGE_LABELS } from '../../export/formats.ts';
import { KINDS, SAVED_KINDS } from '../../files/kinds.ts';
import { unitNotKept } from '../../files/save/unit-not-kept.ts';
import { type Counted, type PlayedRange, WRITERS, type Writer } from '../../files/writers.ts';
import type { Uses } from '../state/workbench.ts';
import type { DialogContent } from '../widgets/dialog.ts';
import { element } from '../widgets/dom.ts';
import { icon } from '../widgets/icons.ts';
import { plural, shown } from '../widgets/numbers/number-text.ts';
import { setTooltip } from '../widgets/tooltip.ts';

export function saveList(wb: Uses<'store' | 'transport' | 'files' | 'dialog'>, close: () => void): DialogContent {
  const body = element('div', { class: 'save-list' });
  for (const character of wb.store.document.characters) {
    const row = element('div', { class: 'save-files' });
    for (const kind of SAVED_KINDS) {
      const { save } = KINDS[kind];
      if (!save.has(character)) continue;
      const { detail, lost }: Writer<never> = WRITERS[kind];
      const text = detail(character, wb.transport.get().framesPerSecond).map(textOfDetail).join(', ');
      const button = saveButton(save.label, text, () => {
        close();
        wb.files.save(character.id, kind);
      });
      setTooltip(button, lost?.(character).join(' ') ?? '');
      row.append(button);
    }
    row.append(
      ...EXCHANGE_FORMATS.map((format) =>
        saveButton(`${EXCHANGE_LABELS[format]} (.${format})…`, 'for other programs', () => {
          // The dialog is about the current character.
          if (wb.store.selection.characterId !== character.id) wb.store.select({ characterId: character.id });
          wb.dialog.set(format);
        }),
      ),
      saveButton('Everything (.zip)', 'with textures', () => {
        close();
        wb.files.saveAll(character.id);
      }),
    );
    const unit = unitNotKept(character);
    const note = unit === undefined ? [] : [element('p', { class: 'faint' }, unit)];
    body.append(element('section', {}, element('h3', {}, character.name), row, ...note));
  }
  if (!body.children.length) body.append(element('p', { class: 'empty' }, 'There is nothing to save yet.'));
  return { title: 'Save as', body, kind: 'save-dialog' };
}

function saveButton(label: string, detail: string, save: () => void): HTMLElement {
  const made = element(
    'button',
    { type: 'button', class: 'save-file' },
    icon('save'),
    element('span', {}, label),
    element('span', { class: 'faint' }, detail),
  );
  made.addEventListener('click', save);
  return made;
}

function textOfDetail(detail: string | Counted | PlayedRange): string {
  // The take's own, which may differ from the playback range.
  if (typeof detail === 'object' && 'range' in detail) return `range ${detail.range.map((t) => shown(t)).join('–')} s`;
  return typeof detail === 'string' ? detail : plural(detail.count, detail.one, detail.many);
}
