/** The left panel: characters and their parts, and below them files and messages. */
import { removeCopy, renameCharacter, showClip, showSkin } from '../../../edit/commands/characters.ts';
import { duplicateClip, removeClip, renameClip } from '../../../edit/commands/clips.ts';
import { setHidden } from '../../../edit/commands/spaces.ts';
import { type JointMark, jointMarks, MARK_TEXTS } from '../../../lesson/joint-marks.ts';
import { type Character, type Document, findCharacter } from '../../../model/document.ts';
import type { PartKind } from '../../../model/files.ts';
import { jointsIn, withJoints, withJointToggled } from '../../../model/selected-joints.ts';
import type { Selection } from '../../../model/session.ts';
import { element } from '../../kit/dom.ts';
import { icon } from '../../kit/icons.ts';
import { isMac } from '../../kit/keyboard.ts';
import { type MenuEntry, type MenuPlace, openMenu } from '../../kit/menu.ts';
import { setTooltip } from '../../kit/tooltip.ts';
import { actionsOf, currentCharacter, runAction } from '../../state/action.ts';
import { attempt } from '../../state/attempt.ts';
import type { DumpComparison, ShownComparison } from '../../state/dump-comparison.ts';
import { itemOf } from '../../state/menu-entries.ts';
import { onDemand } from '../../state/on-demand.ts';
import { selectedJointsOf } from '../../state/selected-joint.ts';
import { actionFor, shortcutsOf } from '../../state/shortcuts.ts';
import { onShown } from '../../state/shown-comparison.ts';
import { splitter } from '../../state/splitter.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { movedEntries } from '../retarget/moved.ts';
import { filesAndMessages } from './files-and-messages.ts';
import {
  characterKey,
  groupKey,
  isFew,
  jointKey,
  keysAbove,
  type OutlineRow,
  outlineRows,
  sameOutline,
} from './outline-rows.ts';
import { Tree } from './tree.ts';

const ICONS = {
  character: 'character',
  joint: 'joint',
  skin: 'skin',
  clip: 'clip',
  morph: 'morph',
} as const;

export function outliner(wb: Workbench): HTMLElement {
  const folds = new Map<string, boolean>();
  const search = searchBox();
  const empty = element('p', { class: 'empty' });
  let renaming: string | undefined;
  let marks = NO_MARKS;
  let firstMatch: OutlineRow | undefined;

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
    // The key that opens the panel also closes it.
    isShortcut: (event) =>
      actionFor(shortcutsOf(event, isMac), actionsOf(wb), 'outliner', wb.settings.get())?.id === 'page.outliner',
    draw: (row) => (row.key === renaming ? [renameField(row)] : drawRow(wb, row, markOf(row, marks))),
  });
  tree.element.dataset.panel = 'outliner';
  tree.element.addEventListener('keydown', (event) => {
    const row = tree.focused;
    // With a joint selected, Delete must not remove the character; in rig mode it deletes the joint.
    const isJoint = row?.kind === 'joint' && wb.posing.mode.get() === 'rig';
    if (event.key === 'Delete' && row?.kind !== 'character') {
      event.preventDefault();
      if (isJoint) {
        if (!isSelected(wb, row)) select(wb, row);
        void runAction(wb, event.shiftKey ? 'rigging.deleteBranch' : 'rigging.delete');
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
    empty.hidden = rows.length > 0;
    tree.element.hidden = rows.length === 0;
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
    const field = element('input', { type: 'text', class: 'rename', 'aria-label': 'Name', value: row.label });
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

  search.input.addEventListener('input', show);
  search.input.addEventListener('keydown', (event) => {
    if (event.isComposing) return;
    if (event.key === 'ArrowDown' || (event.key === 'Enter' && firstMatch)) tree.goTo(firstMatch);
    else if (event.key === 'Escape' && search.input.value) {
      search.input.value = '';
      show();
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

function drawRow(wb: Uses<'store' | 'files'>, row: OutlineRow, mark: JointMark | undefined): Node[] {
  const unsaved = isUnsaved(wb, row);
  const unnamed = row.kind === 'joint' ? `joint ${row.detail}` : 'unnamed';
  const label = row.label === '' ? element('i', { class: 'label' }, unnamed) : element('span', { class: 'label' });
  if (row.label) {
    if (row.label.length <= 2 * TAIL) label.textContent = row.label;
    else {
      // Read as one word.
      label.setAttribute('role', 'img');
      label.setAttribute('aria-label', row.label);
      label.append(
        element('span', { class: 'label-head' }, row.label.slice(0, -TAIL)),
        element('span', {}, row.label.slice(-TAIL)),
      );
    }
    setTooltip(label, row.label);
  }
  const isTold = row.kind === 'joint' && row.label === '';
  const detail = isTold ? '' : row.detail;
  const nodes: Node[] = [label, element('span', { class: 'detail', tooltip: detail }, detail)];
  if (unsaved)
    nodes.splice(
      1,
      0,
      element('span', { class: 'unsaved-dot', role: 'img', 'aria-label': 'Not saved', tooltip: 'Not saved' }),
    );
  if (mark) nodes.splice(1, 0, markElement(mark));
  if (row.shown !== undefined) nodes.unshift(element('span', { class: 'radio', 'aria-hidden': 'true' }));
  else if (row.kind !== 'group') nodes.unshift(icon(ICONS[row.kind]));
  if (row.kind === 'character') nodes.push(eyeOf(wb, row));
  return nodes;
}

/** How the joints of a character compare with those of another program. */
interface Marks {
  readonly characterId: string | undefined;
  readonly marks: readonly JointMark[];
}
const NO_MARKS: Marks = { characterId: undefined, marks: [] };

function marksOf(shown: ShownComparison | undefined, comparing: DumpComparison | undefined): Marks {
  if (!shown || !comparing) return NO_MARKS;
  return { characterId: comparing.characterId, marks: jointMarks(shown.frame, shown.result.tolerance) };
}

function markOf(row: OutlineRow, { characterId, marks }: Marks): JointMark | undefined {
  return row.kind === 'joint' && row.characterId === characterId ? marks[row.index] : undefined;
}

function markElement(mark: JointMark): HTMLElement {
  const text = MARK_TEXTS[mark];
  return element('span', {
    class: 'compare-swatch',
    'data-mark': mark,
    role: 'img',
    'aria-label': text,
    tooltip: text,
  });
}

/** Of a long name both ends stay readable: what it is on the left, and its side or number on the right. */
const TAIL = 7;

/** For the mouse; by keyboard the row's menu does the same. Children of rows are no tab stops. */
function eyeOf(wb: Uses<'store'>, { characterId, label, hidden = false }: OutlineRow): HTMLElement {
  const text = `${hidden ? 'Show' : 'Hide'} ${label}`;
  const eye = element(
    'button',
    {
      type: 'button',
      class: 'eye',
      tabindex: '-1',
      'aria-pressed': String(hidden),
      'aria-label': text,
      tooltip: text,
    },
    icon(hidden ? 'eyeOff' : 'eye'),
  );
  eye.addEventListener('click', (event) => {
    event.stopPropagation();
    wb.store.apply(setHidden, { ids: [characterId], hidden: !hidden });
  });
  eye.addEventListener('dblclick', (event) => event.stopPropagation());
  return eye;
}

/** Whether a row's part is unsaved; the joints represent the skeleton's file. */
function isUnsaved(wb: Uses<'files'>, { kind, key, characterId, index }: OutlineRow): boolean {
  const isSkeleton = key === groupKey(characterId, 'joint');
  if (!isSkeleton && kind !== 'skin' && kind !== 'morph' && kind !== 'clip') return false;
  return wb.files.unsaved.get().some((part) => {
    if (part.characterId !== characterId) return false;
    // Motion capture has skeleton and clip in one file.
    if (part.kind === 'bvh') return kind === 'clip' && part.index === index;
    return isSkeleton ? part.kind === 'skel' : part.kind === PART_KINDS[kind] && part.index === index;
  });
}

const PART_KINDS: Partial<Record<OutlineRow['kind'], PartKind>> = { skin: 'skin', morph: 'morph', clip: 'anim' };

function select(wb: Uses<'store'>, { kind, characterId, index }: OutlineRow): void {
  if (kind === 'joint') wb.store.select({ characterId, joint: index });
  else if (kind === 'character' || wb.store.selection.characterId !== characterId) wb.store.select({ characterId });
}

function isSelected(wb: Uses<'store'>, { kind, characterId, index }: OutlineRow): boolean {
  return kind === 'joint' && selectedJointsOf(wb, characterId).includes(index);
}

/** Only joints can be selected together. */
function toggleSelected(wb: Uses<'store'>, row: OutlineRow): void {
  const { kind, characterId, index } = row;
  if (kind === 'joint') wb.store.select(withJointToggled(wb.store.selection, { characterId, joint: index }));
  else select(wb, row);
}

/** The joints among these rows that belong to the character of the last one. */
function selectRange(wb: Uses<'store'>, rows: readonly OutlineRow[]): void {
  const last = rows.at(-1);
  if (last?.kind === 'joint') {
    const { characterId } = last;
    const joints = rows.filter((row) => row.kind === 'joint' && row.characterId === characterId);
    const indices = joints.map(({ index }) => index);
    wb.store.select(withJoints({ characterId }, indices));
  } else if (last) select(wb, last);
}

function activate(wb: Uses<'store' | 'viewport'>, row: OutlineRow): void {
  const { kind, characterId, index } = row;
  if (kind === 'skin') wb.store.apply(showSkin, { characterId, skin: index });
  else if (kind === 'clip') wb.store.apply(showClip, { characterId, clip: index });
  else if (kind === 'character') wb.viewport.frameSelection({ characterId });
  else if (kind === 'joint') wb.viewport.frameSelection({ characterId, joint: index });
}

function canRename({ kind }: OutlineRow): boolean {
  return kind === 'character' || kind === 'clip' || kind === 'joint';
}

function rename(
  wb: Uses<'store' | 'transport' | 'posing' | 'messages'>,
  { kind, characterId, index }: OutlineRow,
  name: string,
): void {
  if (kind === 'joint') void import('../rig/rig-edits.ts').then((m) => m.renameIt(wb, characterId, index, name));
  else if (kind === 'clip') wb.store.apply(renameClip, { characterId, clip: index, name });
  else wb.store.apply(renameCharacter, { characterId, name });
}

const CHARACTER_ACTIONS = [
  'character.hide',
  'character.copy',
  'pose.resetToFile',
  'pose.resetToZero',
  'pose.holdLimits',
];
const JOINT_ACTIONS = [
  'key.joint',
  'pose.copyJoints',
  'pose.paste',
  'pose.resetJoints',
  'select.hierarchy',
  'select.mirrored',
  'view.frameSelection',
  'draw.follow',
  'draw.skin.heat',
];

function rowMenu(wb: Workbench, row: OutlineRow, at: MenuPlace, rename: (row: OutlineRow) => void): void {
  const character = findCharacter(wb.store.document, row.characterId);
  if (character && row.kind === 'clip') return void openMenu(at, takeEntries(wb, row, rename), { label: row.label });
  if (character && row.kind === 'skin') return void openMenu(at, skinEntries(wb, row), { label: row.label });
  if (!character || (row.kind !== 'character' && row.kind !== 'joint')) return;
  const ids = row.kind === 'joint' ? JOINT_ACTIONS : CHARACTER_ACTIONS;
  const actions = actionsOf(wb);
  const pick = (id: string) => actions.filter((a) => a.id === id).map((a) => itemOf(wb, a));
  const entries = ids.flatMap(pick);
  if (row.kind === 'joint') {
    void onDemand(wb.messages, 'The joint menu', () => import('./tree-menu.ts')).then((module) => {
      // If it can't be loaded, the other entries remain.
      const rigging = module?.jointEntries(wb, character, row.index, () => rename(row)) ?? [];
      openMenu(at, [...rigging, ...entries], { label: row.label || 'Joint' });
    });
    return;
  }
  const last = character.placements.length - 1;
  const removeLast = () => wb.store.apply(removeCopy, { characterId: character.id, index: last });
  openMenu(
    at,
    [
      ...movedEntries(wb, character),
      { kind: 'item', label: 'Rename', shortcut: 'F2', enabled: true, run: () => rename(row) },
      ...entries,
      { kind: 'item', label: 'Remove last instance', enabled: last > 0, run: removeLast },
      { kind: 'line' },
      ...pick('character.remove'),
    ],
    { label: character.name },
  );
}

function skinEntries(wb: Uses<'store' | 'actions' | 'settings'>, row: OutlineRow): MenuEntry[] {
  const { characterId, index } = row;
  /** Applies to what is shown, of the selected character. */
  const showIt = () => {
    if (currentCharacter(wb)?.id !== characterId) wb.store.select({ characterId });
    if (findCharacter(wb.store.document, characterId)?.shownSkin === index) return;
    wb.store.apply(showSkin, { characterId, skin: index });
  };
  const weights = actionsOf(wb).filter((a) => a.id === 'skin.weights');
  return [
    { kind: 'item', label: 'Show', enabled: !row.shown, run: showIt },
    ...weights.map((action): MenuEntry => {
      const hasSkeleton = findCharacter(wb.store.document, characterId)?.skeleton !== undefined;
      const run = () => {
        showIt();
        void runAction(wb, action.id);
      };
      return { ...itemOf(wb, action), enabled: hasSkeleton, run };
    }),
  ];
}

function takeEntries(wb: Uses<'store'>, row: OutlineRow, rename: (row: OutlineRow) => void): MenuEntry[] {
  const { characterId, index } = row;
  const take = { characterId, clip: index };
  const item = (label: string, run: () => void): MenuEntry => ({ kind: 'item', label, enabled: true, run });
  return [
    row.shown
      ? item('Show no take', () => wb.store.apply(showClip, { characterId, clip: -1 }))
      : item('Show', () => wb.store.apply(showClip, take)),
    { kind: 'item', label: 'Rename', shortcut: 'F2', enabled: true, run: () => rename(row) },
    item('Duplicate', () => wb.store.apply(duplicateClip, take)),
    { kind: 'line' },
    item(`Remove ${row.label}`, () => wb.store.apply(removeClip, take)),
  ];
}
