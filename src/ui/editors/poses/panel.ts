/**
 * The poses tab: the pose library of the current character as cards.
 *
 *     click, Enter, Space   applies the pose                  arrows, Home, End   to another card
 *     Alt + drag            blends to it                       F2                  its name
 *     Delete                removes it                         double click on it
 *                                                              right click         all of these
 */
import { type Character, findCharacter } from '../../../model/document.ts';
import type { NamedPose } from '../../../model/poses.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { sectionsOf } from '../../state/actions/menu-entries.ts';
import { jointsText } from '../../state/joints/selected-joint.ts';
import type { TimelineTab } from '../../state/timeline.ts';
import type { Workbench } from '../../state/workbench.ts';
import { element, setAttribute, uniqueId, write } from '../../widgets/dom.ts';
import { HAS_KEYS } from '../../widgets/focus/focus.ts';
import { oncePerFrame } from '../../widgets/frame.ts';
import { openMenu } from '../../widgets/menu.ts';
import { observable } from '../../widgets/observable.ts';
import { PoseCard } from './card.ts';
import { blendByDrag } from './card-drags.ts';
import { cardEntries } from './card-menu.ts';
import { hierarchiesMeant } from './hierarchies.ts';
import { applyWithKeys, removePose, rename, update } from './pose-edits.ts';
import { Thumbnails } from './thumbnails.ts';
import { type PoseOptions, poseTools } from './tools.ts';

export function posesPanel(wb: Workbench): TimelineTab {
  return new PosesPanel(wb);
}

class PosesPanel implements TimelineTab {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly options = observable<PoseOptions>({ branch: false });
  private readonly grid = element('div', {
    ...{ class: 'pose-grid', role: 'listbox', tabindex: 0, 'aria-label': 'Pose library', [HAS_KEYS]: true },
  });
  private readonly empty = element('div', { class: 'empty pose-empty', hidden: true });
  private readonly thumbnails: Thumbnails;
  private readonly cards: PoseCard[] = [];
  private readonly seen: IntersectionObserver;
  private readonly inView = new Set<Element>();
  private visible = false;
  private focused = 0;
  private shownId: string | undefined;
  private shownPoses: readonly NamedPose[] = [];
  private readonly showSoon = oncePerFrame(() => this.show());

  constructor(private readonly wb: Workbench) {
    this.element = element('div', { class: 'poses', 'data-panel': 'poses' }, this.empty, this.grid);
    this.thumbnails = new Thumbnails(this.element);
    this.tools = poseTools(wb, this.options);
    this.seen = new IntersectionObserver((entries) => this.onSeen(entries), { root: this.grid, rootMargin: '120px' });
    this.grid.addEventListener('keydown', (event) => this.onKey(event));
    this.grid.addEventListener('pointerdown', (event) => this.onPointer(event));
    this.grid.addEventListener('click', (event) => this.onClick(event));
    this.element.addEventListener('contextmenu', (event) => this.onMenu(event));
    this.grid.addEventListener('dblclick', (event) => {
      const index = this.indexAt(event.target);
      if (index >= 0 && event.target instanceof Element && event.target.closest('.pose-name')) this.startRename(index);
    });
    wb.store.subscribe(this.showSoon);
  }

  setVisible(visible: boolean): void {
    if (visible === this.visible) return;
    this.visible = visible;
    this.show();
  }

  // This tab shows no time to fit.
  fitAll(): void {}
  fitSelected(): void {}

  recolour(): void {
    this.thumbnails.recolour();
    this.show();
  }

  private show(): void {
    if (!this.visible) return;
    const { wb, grid, cards } = this;
    const character = currentCharacter(wb);
    const poses = character?.poses ?? [];
    let isNew = false;
    if (character?.id !== this.shownId) this.focused = 0;
    // Focuses a newly saved pose.
    else if (poses.length > this.shownPoses.length) {
      this.focused = newIndex(poses, this.shownPoses);
      isNew = true;
    }
    this.shownId = character?.id;
    this.shownPoses = poses;
    this.focused = Math.max(0, Math.min(this.focused, poses.length - 1));
    wb.posing.libraryPose.set(this.focused);
    while (cards.length > poses.length) {
      const card = cards.pop();
      if (!card) break;
      this.seen.unobserve(card.element);
      this.inView.delete(card.element);
      this.thumbnails.forget(card.canvas);
      card.element.remove();
    }
    while (cards.length < poses.length) {
      const card = new PoseCard(uniqueId('pose'));
      cards.push(card);
      grid.append(card.element);
      this.seen.observe(card.element);
    }
    cards.forEach((card, i) => {
      if (!card.isRenaming) card.show(poses[i].name, i === this.focused);
      card.element.classList.toggle('focused', i === this.focused);
      if (character && this.inView.has(card.element)) this.thumbnails.show(card.canvas, character, poses[i]);
    });
    setAttribute(grid, 'aria-activedescendant', cards[this.focused]?.element.id);
    write(grid, 'hidden', poses.length === 0);
    if (isNew) cards[this.focused]?.element.scrollIntoView({ block: 'nearest' });
    write(this.empty, 'hidden', poses.length > 0);
    if (!this.empty.hidden) this.sayHow(character);
  }

  private sayHow(character: Character | undefined): void {
    const says = character
      ? `${character.name} has no saved poses yet. Pose it and click Save pose, or drop a .pose file here.`
      : 'No poses yet. Open a character first.';
    if (this.empty.textContent !== says) this.empty.replaceChildren(element('p', {}, says));
  }

  private onSeen(entries: readonly IntersectionObserverEntry[]): void {
    const character = findCharacter(this.wb.store.document, this.shownId);
    for (const { target, isIntersecting } of entries) {
      if (isIntersecting) this.inView.add(target);
      else this.inView.delete(target);
      const index = this.cards.findIndex((card) => card.element === target);
      const pose = this.shownPoses[index];
      if (!character || !pose) continue;
      if (isIntersecting) this.thumbnails.show(this.cards[index].canvas, character, pose);
      else this.thumbnails.forget(this.cards[index].canvas);
    }
  }

  private indexAt(target: EventTarget | null): number {
    const card = target instanceof Element ? target.closest('.pose-card') : null;
    return card ? this.cards.findIndex((one) => one.element === card) : -1;
  }

  private focus(index: number): void {
    this.focused = Math.max(0, Math.min(index, this.cards.length - 1));
    this.show();
    this.cards[this.focused]?.element.scrollIntoView({ block: 'nearest' });
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || this.cards.length === 0) return;
    const columns = this.columns();
    const steps: Readonly<Record<string, number>> = {
      ArrowLeft: -1,
      ArrowRight: 1,
      ArrowUp: -columns,
      ArrowDown: columns,
      Home: -this.cards.length,
      End: this.cards.length,
    };
    const step = steps[event.key];
    if (step !== undefined) {
      const to = this.focused + step;
      // Up from the first row and down from the last does nothing.
      if (Math.abs(step) === 1 || Math.abs(step) === this.cards.length || (to >= 0 && to < this.cards.length))
        this.focus(to);
    } else if (event.key === 'Enter' || event.key === ' ') this.take(this.focused);
    else if (event.key === 'F2') this.startRename(this.focused);
    else if (event.key === 'Delete' || event.key === 'Backspace') this.remove(this.focused);
    else if (event.key === 'ContextMenu' || (event.key === 'F10' && event.shiftKey)) {
      const { left, bottom } = this.cards[this.focused].element.getBoundingClientRect();
      this.menu(this.focused, { x: left + 8, y: bottom - 24 }, true);
    } else return;
    event.preventDefault();
  }

  private columns(): number {
    const top = this.cards[0].element.offsetTop;
    const next = this.cards.findIndex((card) => card.element.offsetTop !== top);
    return next < 0 ? this.cards.length : next;
  }

  private onPointer(event: PointerEvent): void {
    const index = this.indexAt(event.target);
    if (index < 0 || event.button !== 0) return;
    event.preventDefault();
    this.grid.focus({ preventScroll: true });
    this.focus(index);
    if (event.altKey) this.blend(index, event);
  }

  /** Pressed and released on one card. */
  private onClick({ target, detail, altKey }: MouseEvent): void {
    const index = this.indexAt(target);
    // The second click of a double click must not blend again.
    if (index < 0 || altKey || detail > 1) return;
    // On the name it only focuses the card: a double click there renames.
    if (target instanceof Element && !target.closest('.pose-name')) this.take(index);
  }

  /** Alt+drag. */
  private blend(index: number, down: PointerEvent): void {
    const { wb, grid } = this;
    const character = findCharacter(wb.store.document, this.shownId);
    if (!character || !this.shownPoses[index]) return;
    const blended = {
      characterId: character.id,
      pose: index,
      joints: hierarchiesMeant(this.wb, character, this.options.get().branch),
    };
    blendByDrag(wb, grid, down, blended, (share) => this.cards[index]?.showShare(share));
  }

  private onMenu(event: MouseEvent): void {
    const index = this.indexAt(event.target);
    event.preventDefault();
    if (index < 0) {
      openMenu({ x: event.clientX, y: event.clientY }, sectionsOf(this.wb, MENU_OF_ALL), { label: 'Pose library' });
      return;
    }
    this.focus(index);
    this.menu(index, { x: event.clientX, y: event.clientY }, false);
  }

  private menu(index: number, at: { readonly x: number; readonly y: number }, byKey: boolean): void {
    const pose = this.shownPoses[index];
    // Removed since its card was drawn.
    if (!pose) return;
    const character = findCharacter(this.wb.store.document, this.shownId);
    const joints = character && hierarchiesMeant(this.wb, character, true);
    const name = joints && jointsText(character?.skeleton, joints);
    const entries = cardEntries(name, {
      take: (share, isBranch) => this.take(index, share, isBranch),
      update: () => update(this.wb, this.shownId ?? '', index),
      rename: () => this.startRename(index),
      save: () => this.wb.files.save(this.shownId ?? '', 'pose'),
      remove: () => this.remove(index),
    });
    openMenu(at, entries, { label: pose.name, focusFirst: byKey, opener: this.grid });
  }

  private take(index: number, share = 1, isBranch = this.options.get().branch): void {
    const character = findCharacter(this.wb.store.document, this.shownId);
    if (!character || !this.shownPoses[index]) return;
    const joints = hierarchiesMeant(this.wb, character, isBranch);
    applyWithKeys(this.wb, { characterId: character.id, pose: index, share, joints });
  }

  private startRename(index: number): void {
    const id = this.shownId;
    if (id === undefined) return;
    this.focus(index);
    this.cards[index]?.startRename({
      rename: (name) => rename(this.wb, id, index, name),
      renamed: () => {
        this.grid.focus({ preventScroll: true });
        this.show();
      },
    });
  }

  private remove(index: number): void {
    if (this.shownId !== undefined && this.shownPoses[index]) removePose(this.wb, this.shownId, index);
  }
}

/** Beside the cards. */
const MENU_OF_ALL = [['pose.keep'], ['pose.copy', 'pose.paste', 'pose.mirror'], ['file.open']];

/** Index of the last new pose. */
function newIndex(poses: readonly NamedPose[], before: readonly NamedPose[]): number {
  const known = new Set(before);
  return poses.findLastIndex((pose) => !known.has(pose));
}
