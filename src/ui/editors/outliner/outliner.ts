/** The left panel: characters and their parts, and below them files and messages. */
import { type Character, type Document, findCharacter } from '../../../model/document.ts';
import type { Selection } from '../../../model/session.ts';
import { jointsIn } from '../../../model/skeleton/selected-joints.ts';
import { currentCharacter, tryById } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { splitter } from '../../state/panels/splitter.ts';
import { onShown } from '../../state/shown-comparison.ts';
import type { Workbench } from '../../state/workbench.ts';
import { element, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { filesAndMessages } from './files-and-messages.ts';
import { characterKey, isFew, jointKey, keysAbove, type OutlineRow, outlineRows, sameOutline } from './outline-rows.ts';
import { activate, canRename, isSelected, rename, select, selectRange, toggleSelected } from './row-actions.ts';
import { drawRow } from './row-drawing.ts';
import { marksOf, NO_MARKS, rowMarks } from './row-marks.ts';
import { rowMenu } from './row-menu.ts';
import { Tree } from './tree.ts';

export function outliner(wb: Workbench): HTMLElement {
  const folds = new Map<string, boolean>();
  const search = searchBox();
  const empty = element('p', { class: 'empty' });
  let renaming: string | undefined;
  let marks = NO_MARKS;
  let firstMatch: OutlineRow | undefined;

  const jointsOf = ({ characterId }: OutlineRow) =>
    findCharacter(wb.store.document, characterId)?.skeleton?.joints ?? [];

  const tree = new Tree('Characters and joints', {
    toggle(row, open) {
      unfolded.keys.delete(row.key);
      folds.set(row.key, open);
      show();
    },
    select: (row) => select(wb, row),
    toggleSelected: (row) => toggleSelected(wb, row),
    selectRange: (rows) => selectRange(wb, rows),
    activate: (row) => activate(wb, row),
    doubleClick: (row) => (row.kind === 'character' ? startRename(row) : activate(wb, row)),
    menu: (row, at) => rowMenu(wb, row, at, startRename),
    draw: (row) => (row.key === renaming ? [renameField(row)] : drawRow(wb, row, rowMarks(row, marks, jointsOf(row)))),
  });
  write(tree.element.dataset, 'panel', 'outliner');
  tree.element.addEventListener('keydown', (event) => {
    const row = tree.focused;
    // With a joint selected, Delete must not remove the character; in rig mode it deletes the joint.
    const isJoint = row?.kind === 'joint' && wb.posing.mode.get() === 'rig';
    if (event.key === 'Delete' && row?.kind !== 'character') {
      event.preventDefault();
      if (isJoint) {
        if (!isSelected(wb, row)) select(wb, row);
        tryById(wb, event.shiftKey ? 'rigging.deleteBranch' : 'rigging.delete');
      }
    }
    if (event.key !== 'F2' || !row || !canRename(row)) return;
    event.preventDefault();
    startRename(row);
  });

  const show = () => {
    const { document } = wb.store;
    const query = search.input.value;
    const rows = outlineRows(document, (key, otherwise) => folds.get(key) ?? otherwise, query);
    firstMatch = query.trim() ? rows.find((row) => !row.onTheWay) : undefined;
    write(empty, 'hidden', rows.length > 0);
    write(tree.element, 'hidden', rows.length === 0);
    empty.textContent = document.characters.length && query ? `Nothing matches “${query}”.` : EMPTY;
    tree.show(rows);
  };
  /** What selecting has expanded, of many characters: collapsed again when another is selected. */
  const unfolded = { of: '', keys: new Set<string>() };
  const foldOthers = ({ characters }: Document, character: Character | undefined) => {
    if (!character || unfolded.of === character.id) return false;
    const isAny = unfolded.keys.size > 0 && !isFew(characters);
    if (isAny) for (const key of unfolded.keys) folds.delete(key);
    unfolded.of = character.id;
    unfolded.keys.clear();
    return isAny;
  };
  const showSelection = ({ document, selection }: { document: Document; selection: Selection }) => {
    const character = findCharacter(document, selection.characterId);
    const meant = character ? undefined : currentCharacter(wb);
    tree.mean(meant && characterKey(meant.id));
    let opened = foldOthers(document, character);
    if (!character || selection.joint === undefined) {
      if (opened) show();
      return tree.select(character ? [characterKey(character.id)] : []);
    }
    for (const key of keysAbove(character, selection.joint)) {
      if (folds.get(key) === true) continue;
      folds.set(key, true);
      unfolded.keys.add(key);
      opened = true;
    }
    if (opened) show();
    tree.select(jointsIn(selection).map((joint) => jointKey(character.id, joint)));
  };

  function startRename(row: OutlineRow): void {
    renaming = row.key;
    tree.drawAnew();
    const field = tree.element.querySelector('input');
    field?.focus();
    field?.select();
  }
  function renameField(row: OutlineRow): HTMLElement {
    const field = element('input', {
      type: 'text',
      class: 'rename',
      'aria-label': 'Name',
      value: row.name ?? row.label,
    });
    const finish = (keep: boolean) => {
      if (renaming === undefined) return;
      renaming = undefined;
      const name = field.value.trim();
      if (keep && name) attempt(wb.messages, () => rename(wb, row, name));
      tree.drawAnew();
      tree.element.focus();
    };
    field.addEventListener('blur', () => finish(true));
    field.addEventListener('keydown', (event) => {
      event.stopPropagation();
      if (event.key === 'Enter') finish(true);
      if (event.key === 'Escape') finish(false);
    });
    return field;
  }

  const find = () => {
    show();
    // What was selected among the matches is somewhere in the whole tree.
    if (!search.input.value.trim()) tree.revealActive();
  };
  search.input.addEventListener('input', find);
  search.input.addEventListener('keydown', (event) => {
    if (event.isComposing) return;
    if (event.key === 'ArrowDown' || (event.key === 'Enter' && firstMatch)) tree.goTo(firstMatch);
    else if (event.key === 'Escape' && search.input.value) {
      search.input.value = '';
      find();
    } else return;
    event.preventDefault();
  });
  wb.store.subscribe((now, before) => {
    if (!sameOutline(now.document, before.document)) show();
    const others = now.document.characters !== before.document.characters && now.selection.characterId === undefined;
    if (now.selection !== before.selection || others) showSelection(now);
  });
  wb.viewport.onHover(() => {
    const { hovered } = wb.viewport;
    tree.light(hovered && jointKey(hovered.characterId, hovered.joint));
  });
  wb.posing.rig.renameAsked.subscribe(() => {
    const { focused } = tree;
    if (focused?.kind === 'joint') startRename(focused);
  });
  const stopWaiting = wb.posing.mode.subscribe(async (mode) => {
    if (mode !== 'rig') return;
    stopWaiting();
    (await import('./tree-drag.ts')).letJointsBeDragged(wb, tree);
  });
  onShown(wb, (shown, comparing) => {
    const now = marksOf(shown, comparing);
    const isSame = now.characterId === marks.characterId && now.marks.join() === marks.marks.join();
    marks = now;
    // Many times may be compared, and play.
    if (!isSame && renaming === undefined) tree.drawAnew();
  });
  wb.files.unsaved.subscribe(() => {
    // Doesn't interrupt renaming.
    if (renaming === undefined) tree.drawAnew();
  });
  show();
  showSelection(wb.store);

  const lower = filesAndMessages(wb);
  const panel = element(
    'section',
    { class: 'panel outliner', 'aria-label': 'Outliner' },
    search.element,
    element('div', { class: 'outliner-tree' }, empty, tree.element),
    splitter(wb, 'filesHeight', 'Height of files and messages'),
    lower,
  );
  return panel;
}

const EMPTY = 'No characters yet. Drop files here or choose Open.';

function searchBox() {
  const input = element('input', {
    type: 'search',
    'aria-label': 'Search joints, skins, takes and morphs',
    placeholder: 'Search outliner',
    spellcheck: 'false',
    autocomplete: 'off',
  });
  return { input, element: element('div', { class: 'search' }, icon('search'), input) };
}
