/** The left panel: characters and their parts, and below them files and messages. */
import { type Document, findCharacter } from '../../../model/document.ts';
import type { Selection } from '../../../model/session.ts';
import { jointsIn, partOf, partsOf } from '../../../model/skeleton/selected-joints.ts';
import { currentCharacter, tryById } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { splitter } from '../../state/panels/splitter.ts';
import { onShown } from '../../state/shown-comparison.ts';
import type { Workbench } from '../../state/workbench.ts';
import { element, write } from '../../widgets/dom.ts';
import { icon } from '../../widgets/icons.ts';
import { setsStrip } from '../sets/strip.ts';
import { filesAndMessages } from './files-and-messages.ts';
import { characterKey, isFew, jointKey, keysAbove, type OutlineRow, outlineRows, sameOutline } from './outline-rows.ts';
import { activate, canRename, frame, isSelected, rename, select, selectRange, toggleSelected } from './row-actions.ts';
import { drawRow } from './row-drawing.ts';
import { marksOf, NO_MARKS, rowMarks } from './row-marks.ts';
import { rowMenu } from './row-menu.ts';
import { Tree } from './tree.ts';

export function outliner(wb: Workbench): HTMLElement {
  return new Outliner(wb).element;
}

class Outliner {
  readonly element: HTMLElement;
  private readonly tree: Tree;
  private readonly folds = new Map<string, boolean>();
  /** What selecting has expanded, of many characters: collapsed again when another is selected. */
  private readonly unfolded = { of: '', keys: new Set<string>() };
  private readonly search = searchBox();
  private readonly empty = element('p', { class: 'empty' });
  private renaming: string | undefined;
  private marks = NO_MARKS;
  private firstMatch: OutlineRow | undefined;

  constructor(private readonly wb: Workbench) {
    const startRename = (row: OutlineRow) => this.startRename(row);
    this.tree = new Tree('Characters and joints', {
      toggle: (row, open) => {
        this.unfolded.keys.delete(row.key);
        this.folds.set(row.key, open);
        this.show();
      },
      select: (row) => select(wb, row),
      toggleSelected: (row) => toggleSelected(wb, row),
      selectRange: (rows) => selectRange(wb, rows),
      activate: (row) => this.activate(row),
      doubleClick: (row) => (row.kind === 'character' ? startRename(row) : frame(wb, row)),
      menu: (row, at) => rowMenu(wb, row, at, startRename),
      draw: (row) => this.draw(row),
    });
    const target = this.tree.element;
    write(target.dataset, 'panel', 'outliner');
    target.addEventListener('keydown', (event) => this.onKey(event));
    this.search.input.addEventListener('input', () => this.find());
    this.search.input.addEventListener('keydown', (event) => this.onSearchKey(event));
    this.follow();
    this.show();
    this.showSelection(wb.store);
    this.element = element(
      'section',
      { class: 'panel outliner', 'aria-label': 'Outliner' },
      this.search.element,
      element('div', { class: 'outliner-tree' }, this.empty, target),
      setsStrip(wb),
      splitter(wb, 'filesHeight', 'Height of files and messages'),
      filesAndMessages(wb),
    );
  }

  private follow(): void {
    const { wb, tree } = this;
    wb.store.subscribe((now, before) => {
      if (!sameOutline(now.document, before.document)) this.show();
      const others = now.document.characters !== before.document.characters && now.selection.characterId === undefined;
      if (now.selection !== before.selection || others) this.showSelection(now);
    });
    wb.viewport.pointing.onHover(() => {
      const { hovered } = wb.viewport.pointing;
      tree.light(hovered && jointKey(hovered.characterId, hovered.joint));
    });
    wb.posing.rig.renameAsked.subscribe(() => {
      const { focused } = tree;
      if (focused?.kind === 'joint') this.startRename(focused);
    });
    const stopWaiting = wb.posing.mode.subscribe(async (mode) => {
      if (mode !== 'rig') return;
      stopWaiting();
      (await import('./tree-drag.ts')).letJointsBeDragged(wb, tree);
    });
    onShown(wb, (shown, comparing) => {
      const { marks } = this;
      const now = marksOf(shown, comparing);
      this.marks = now;
      // Many times may be compared, and play.
      if (now.characterId !== marks.characterId || now.marks.join() !== marks.marks.join()) this.drawAnew();
    });
    wb.files.unsaved.subscribe(() => this.drawAnew());
  }

  /** Doesn't interrupt renaming. */
  private drawAnew(): void {
    if (this.renaming === undefined) this.tree.drawAnew();
  }

  private draw(row: OutlineRow): Node[] {
    if (row.key === this.renaming) return [this.renameField(row)];
    const { wb } = this;
    const joints = findCharacter(wb.store.document, row.characterId)?.skeleton?.joints ?? [];
    return drawRow(wb, row, rowMarks(row, this.marks, joints));
  }

  private show(): void {
    const { folds, tree, empty } = this;
    const { document } = this.wb.store;
    const query = this.search.input.value;
    const rows = outlineRows(document, (key, otherwise) => folds.get(key) ?? otherwise, query);
    this.firstMatch = query.trim() ? rows.find((row) => !row.onTheWay) : undefined;
    write(empty, 'hidden', rows.length > 0);
    write(tree.element, 'hidden', rows.length === 0);
    empty.textContent = document.characters.length && query ? `Nothing matches “${query}”.` : EMPTY;
    tree.show(rows);
  }

  /** Whether any were collapsed. */
  private foldOthers({ characters }: Document, selection: Selection): boolean {
    const { unfolded, folds } = this;
    const { characterId } = selection;
    if (characterId === undefined || (unfolded.of && partOf(selection, unfolded.of))) return false;
    const isAny = unfolded.keys.size > 0 && !isFew(characters);
    if (isAny) for (const key of unfolded.keys) folds.delete(key);
    unfolded.of = characterId;
    unfolded.keys.clear();
    return isAny;
  }

  private showSelection({ document, selection }: { document: Document; selection: Selection }): void {
    const { tree, folds, unfolded } = this;
    const character = findCharacter(document, selection.characterId);
    const meant = character ? undefined : currentCharacter(this.wb);
    tree.mean(meant && characterKey(meant.id));
    const parts = partsOf(selection).flatMap((part) => {
      const of = findCharacter(document, part.characterId);
      return of ? { character: of, part } : [];
    });
    let opened = this.foldOthers(document, selection);
    const above = parts.flatMap(({ character: of, part }) =>
      part.joint === undefined ? [] : keysAbove(of, part.joint),
    );
    for (const key of above) {
      if (folds.get(key) === true) continue;
      folds.set(key, true);
      unfolded.keys.add(key);
      opened = true;
    }
    if (opened) this.show();
    const keys = parts.flatMap(({ character: { id }, part }) =>
      part.joint === undefined ? characterKey(id) : jointsIn(part).map((joint) => jointKey(id, joint)),
    );
    tree.select(keys);
  }

  private onKey(event: KeyboardEvent): void {
    const { wb } = this;
    const row = this.tree.focused;
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
    this.startRename(row);
  }

  // Names.

  private startRename(row: OutlineRow): void {
    this.renaming = row.key;
    this.tree.drawAnew();
    const field = this.tree.element.querySelector('input');
    field?.focus();
    field?.select();
  }

  private renameField(row: OutlineRow): HTMLElement {
    const { wb, tree } = this;
    const field = element('input', {
      type: 'text',
      class: 'rename',
      'aria-label': 'Name',
      value: row.name ?? row.label,
    });
    const finish = (keep: boolean) => {
      if (this.renaming === undefined) return;
      this.renaming = undefined;
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

  // Search.

  private find(): void {
    this.show();
    // What was selected among the matches is somewhere in the whole tree.
    if (!this.search.input.value.trim()) this.tree.revealActive();
  }

  /** What was searched for is found. */
  private activate(row: OutlineRow): void {
    activate(this.wb, row);
    const { input } = this.search;
    if (!input.value) return;
    input.value = '';
    this.find();
  }

  private onSearchKey(event: KeyboardEvent): void {
    const { firstMatch } = this;
    const { input } = this.search;
    if (event.isComposing) return;
    if (event.key === 'ArrowDown' || (event.key === 'Enter' && firstMatch)) this.tree.goTo(firstMatch);
    else if (event.key === 'Escape' && input.value) {
      input.value = '';
      this.find();
    } else return;
    event.preventDefault();
  }
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
