/**
 * The tab of the poses: the library of the character at hand as cards.
 *
 *     click, Enter, Space   takes the pose on                  arrows, Home, End   to another card
 *     Alt + drag            blends to it                       F2                  its name
 *     Delete                removes it                         right click         all of these
 */
import { applyPose } from '../../edit/commands/poses.ts';
import { type Character, findCharacter } from '../../model/document.ts';
import type { NamedPose } from '../../model/poses.ts';
import { currentCharacter } from '../actions/action.ts';
import { element, setAttribute, uniqueId } from '../dom.ts';
import { HAS_KEYS } from '../focus.ts';
import { oncePerFrame } from '../frame.ts';
import { HandEdit } from '../hand-edit.ts';
import { openMenu } from '../menu.ts';
import { observable } from '../observable.ts';
import type { TimelineTab } from '../timeline/timeline.ts';
import type { Workbench } from '../workbench.ts';
import { PoseCard } from './card.ts';
import { moment, remove, rename, selectedJoint, take } from './pose-edits.ts';
import { Thumbnails } from './thumbnails.ts';
import { type PoseOptions, poseTools } from './tools.ts';

/** A drag of that many CSS pixels to the right is the whole pose. */
const WHOLE_DRAG = 160;

export function posesPanel(wb: Workbench): TimelineTab {
  return new PosesPanel(wb);
}

class PosesPanel implements TimelineTab {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly options = observable<PoseOptions>({ share: 1, branch: false });
  private readonly grid = element('div', {
    ...{ class: 'pose-grid', role: 'listbox', tabindex: 0, 'aria-label': 'Poses', [HAS_KEYS]: true },
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
    this.grid.addEventListener('contextmenu', (event) => this.onMenu(event));
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

  // There is no time in this tab to be fitted.
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
    // A pose that was just kept is the one that is gone on from.
    else if (poses.length > this.shownPoses.length) {
      this.focused = newIndex(poses, this.shownPoses);
      isNew = true;
    }
    this.shownId = character?.id;
    this.shownPoses = poses;
    this.focused = Math.max(0, Math.min(this.focused, poses.length - 1));
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
    grid.hidden = poses.length === 0;
    if (isNew) cards[this.focused]?.element.scrollIntoView({ block: 'nearest' });
    this.empty.hidden = poses.length > 0;
    if (!this.empty.hidden) this.sayHow(character);
  }

  private sayHow(character: Character | undefined): void {
    const says = character
      ? `${character.name} has no poses yet. Pose it and press “Keep pose”, or drop a .pose file here.`
      : 'Poses of a character will stand here: open one first.';
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
      // Up from the first row and down from the last stay in their column.
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
    else this.press(index, event);
  }

  /** A click: pressed and let go on one card. */
  private press(index: number, down: PointerEvent): void {
    const { grid } = this;
    const up = (event: PointerEvent) => {
      if (event.pointerId !== down.pointerId) return;
      grid.removeEventListener('pointerup', up);
      // The second click of two on the name is about the name.
      if (this.indexAt(event.target) === index && down.detail < 2) this.take(index);
    };
    grid.addEventListener('pointerup', up);
  }

  /** Alt and a drag: as much of the pose as the hand has moved to the right. */
  private blend(index: number, down: PointerEvent): void {
    const { wb, grid } = this;
    const character = findCharacter(wb.store.document, this.shownId);
    if (!character) return;
    const hand = new HandEdit(wb.store, wb.messages);
    const at = moment(wb);
    const joint = this.jointMeant(character);
    grid.setPointerCapture(down.pointerId);
    const move = (event: PointerEvent) => {
      if (hand.cancelled) return end(event);
      const share = Math.min(1, Math.max(0, (event.clientX - down.clientX) / WHOLE_DRAG));
      hand.preview(applyPose, { characterId: character.id, pose: index, share, joint, ...at });
      this.cards[index]?.showShare(share);
    };
    const end = (event: PointerEvent) => {
      grid.removeEventListener('pointermove', move);
      grid.removeEventListener('pointerup', end);
      grid.removeEventListener('pointercancel', end);
      if (event.type === 'pointercancel') hand.cancel();
      hand.commit();
      this.cards[index]?.showShare(undefined);
    };
    grid.addEventListener('pointermove', move);
    grid.addEventListener('pointerup', end);
    grid.addEventListener('pointercancel', end);
  }

  private onMenu(event: MouseEvent): void {
    const index = this.indexAt(event.target);
    if (index < 0) return;
    event.preventDefault();
    this.focus(index);
    this.menu(index, { x: event.clientX, y: event.clientY }, false);
  }

  private menu(index: number, at: { readonly x: number; readonly y: number }, byKey: boolean): void {
    const item = (label: string, run: () => void, shortcut?: string) =>
      ({ kind: 'item', label, enabled: true, run, ...(shortcut && { shortcut }) }) as const;
    const character = findCharacter(this.wb.store.document, this.shownId);
    const joint = character && selectedJoint(this.wb, character);
    const name = joint === undefined ? undefined : character?.skeleton?.joints[joint]?.name || `joint ${joint}`;
    openMenu(
      at,
      [
        item('Take on', () => this.take(index, { share: 1, branch: false }), 'Enter'),
        item('Take on half of it', () => this.take(index, { share: 0.5, branch: false })),
        ...(name === undefined
          ? []
          : [item(`Take on from ${name} down`, () => this.take(index, { share: 1, branch: true }))]),
        { kind: 'line' },
        item('Rename', () => this.startRename(index), 'F2'),
        item('Save poses…', () => this.wb.files.save(this.shownId ?? '', 'pose')),
        { kind: 'line' },
        item('Remove', () => this.remove(index), 'Del'),
      ],
      { label: this.shownPoses[index].name, focusFirst: byKey, opener: this.grid },
    );
  }

  private take(index: number, options: PoseOptions = this.options.get()): void {
    const character = findCharacter(this.wb.store.document, this.shownId);
    if (!character || !this.shownPoses[index]) return;
    const joint = options.branch ? selectedJoint(this.wb, character) : undefined;
    take(this.wb, { characterId: character.id, pose: index, share: options.share, joint });
  }

  private jointMeant(character: Character): number | undefined {
    return this.options.get().branch ? selectedJoint(this.wb, character) : undefined;
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
    if (this.shownId !== undefined && this.shownPoses[index]) remove(this.wb, this.shownId, index);
  }
}

/** Where the last one of those is that were not there before. */
function newIndex(poses: readonly NamedPose[], before: readonly NamedPose[]): number {
  const known = new Set(before);
  return poses.findLastIndex((pose) => !known.has(pose));
}
