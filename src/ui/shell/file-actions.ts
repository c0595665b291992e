/** Opening and saving. */

import { EXCHANGE_FORMATS, EXCHANGE_LABELS } from '../../export/formats.ts';
import { KINDS, SAVED_KINDS, type Saving } from '../../files/kinds.ts';
import { currentCharacter } from '../state/actions/action.ts';
import { needs } from '../state/actions/needs.ts';
import type { Action, Uses } from '../state/workbench.ts';
import { contentText, whenText } from './start/kept-text.ts';

const needsCharacters = needs(
  'There is no character to save. Open one first.',
  (wb: Uses<'store'>) => wb.store.document.characters.length > 0,
);

export const FILE_ACTIONS: readonly Action[] = [
  {
    id: 'file.open',
    label: 'Open files…',
    also: 'add beside',
    group: 'Files',
    menu: 'Open',
    shortcuts: ['Ctrl+O'],
    icon: 'file',
    run: (wb) => wb.files.open(),
  },
  {
    id: 'file.openFolder',
    label: 'Open folder…',
    group: 'Files',
    menu: 'Open',
    icon: 'folder',
    run: (wb) => wb.files.openFolder(),
  },
  {
    id: 'file.reload',
    label: 'Reload from disk',
    detail: 'Rereads the character’s changed files',
    group: 'Files',
    menu: 'Open',
    section: 1,
    // Ctrl+R stays the browser's.
    shortcuts: ['Alt+R'],
    refuses: needs('The character’s files can’t be reread. Open or drop them again.', (wb) => {
      const character = currentCharacter(wb);
      return character !== undefined && wb.files.canReload(character.id);
    }),
    run(wb) {
      const character = currentCharacter(wb);
      if (character) wb.files.reload(character.id);
    },
  },
  {
    id: 'save.changed',
    label: 'Save changes',
    group: 'Files',
    menu: 'Save',
    shortcuts: ['Ctrl+S'],
    icon: 'save',
    refuses: needs(
      'There is nothing to save. Open a character first.',
      ({ store }: Uses<'store'>) => store.document.characters.length > 0 || store.document.review !== undefined,
    ),
    async run(wb) {
      const { unsaved } = wb.files;
      const isListUnsaved = wb.timeline.review.isUnsaved(wb.store.document.review ?? []);
      if (isListUnsaved) (await import('../editors/review/edits.ts')).saveList(wb, 'csv');
      if (!isListUnsaved || unsaved.get().length > 0) wb.files.saveChanged();
    },
  },
  {
    id: 'save.list',
    label: 'Save as…',
    group: 'Files',
    menu: 'Save',
    shortcuts: ['Ctrl+Shift+S'],
    refuses: needsCharacters,
    run: (wb) => wb.dialog.set('save'),
  },
  ...SAVED_KINDS.map(
    (kind): Action => ({
      id: `save.${kind}`,
      label: KINDS[kind].save.label,
      group: 'Files',
      menu: 'Save',
      section: 1,
      refuses(wb) {
        const { has, obstacle }: Saving = KINDS[kind].save;
        const character = currentCharacter(wb);
        if (character && has(character)) return undefined;
        return (character && obstacle?.(character)) ?? 'The character has nothing to save in this format.';
      },
      explained: 'obstacle' in KINDS[kind].save,
      run(wb) {
        const character = currentCharacter(wb);
        if (character) wb.files.save(character.id, kind);
      },
    }),
  ),
  ...EXCHANGE_FORMATS.map(
    (format): Action => ({
      id: `save.${format}`,
      label: `${EXCHANGE_LABELS[format]} (.${format})…`,
      group: 'Files',
      menu: 'Save',
      section: 2,
      refuses: needsCharacters,
      run: (wb) => wb.dialog.set(format),
    }),
  ),
  {
    id: 'save.all',
    label: 'Whole character (.zip)',
    group: 'Files',
    menu: 'Save',
    section: 2,
    refuses: needsCharacters,
    run(wb) {
      const character = currentCharacter(wb);
      if (character) wb.files.saveAll(character.id);
    },
  },
  {
    id: 'save.picture',
    label: 'Picture (PNG)…',
    also: 'screenshot image snapshot render transparent',
    group: 'Files',
    menu: 'Save',
    section: 3,
    refuses: needsCharacters,
    run: (wb) => wb.dialog.set('picture'),
  },
  {
    id: 'save.video',
    label: 'Video…',
    also: 'movie animation record playblast mp4 webm gif png sequence',
    group: 'Files',
    menu: 'Save',
    section: 3,
    refuses: needsCharacters,
    run: (wb) => wb.dialog.set('video'),
  },
  {
    id: 'save.link',
    label: 'Copy link',
    detail: 'Opens what is shown, if it came from the web',
    also: 'share address url',
    group: 'Files',
    menu: 'Save',
    section: 4,
    refuses: needsCharacters,
    run: async (wb) => (await wb.files.sharing())?.copyLink(),
  },
  {
    id: 'save.webPage',
    label: 'Web page (.html)',
    detail: 'Shows the same view anywhere, from disk, without a network',
    also: 'share embed offline html export',
    group: 'Files',
    menu: 'Save',
    section: 4,
    refuses: needsCharacters,
    run: async (wb) => (await wb.files.sharing())?.saveWebPage(),
  },
];

const KIT_ACTION: Action = {
  id: 'kit.save',
  label: 'Test kit (.zip)',
  detail: 'Small files with the right numbers, to test your own program',
  group: 'Files',
  menu: 'Examples',
  section: 1,
  run: (wb) => wb.files.saveKit(),
};

/** Sessions left by an earlier page, as long as there are any: postponed ones stay reachable. */
export function keptActions(wb: Uses<'kept'>): Action[] {
  const offer = wb.kept.get();
  const [work] = offer?.works ?? [];
  if (!offer || !work) return [];
  return [
    {
      id: 'session.restore',
      label: 'Restore last session…',
      detail: `${whenText(work.savedAtMs)}: ${contentText(work.characters)}`,
      group: 'Files',
      menu: 'Open',
      section: 2,
      run: () => offer.again(),
    },
  ];
}

/** One for each example, and the files to test other programs with. */
export function sampleActions(wb: Uses<'files'>): Action[] {
  const samples = wb.files.samples.map(
    (sample): Action => ({
      id: `sample.${sample.id}`,
      label: sample.label,
      detail: sample.description,
      group: 'Files',
      menu: 'Examples',
      run: () => wb.files.openSample(sample.id),
    }),
  );
  return [...samples, KIT_ACTION];
}
