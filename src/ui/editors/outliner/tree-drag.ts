/**
 * Dragging joints in the tree, in rig mode: onto a row to reparent, between rows to reorder. Escape cancels. By
 * keyboard: "Move under" in the row's menu.
 */
import { findCharacter } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';
import { element, write } from '../../widgets/dom.ts';
import { waitOutDrag } from '../../widgets/focus/keyboard.ts';
import { dropPlace, type NewPlace, rowPart, whyNoDrop } from './drop-place.ts';
import type { OutlineRow } from './outline-rows.ts';
import type { Tree } from './tree.ts';

const CLICK_PIXELS = 4;
/** Scrolls near the tree's top and bottom edge. */
const EDGE_PIXELS = 20;

interface Drag {
  readonly row: OutlineRow;
  readonly x: number;
  readonly y: number;
  readonly pointerId: number;
  moved: boolean;
  place: NewPlace | undefined;
  /** Why it can't be dropped here. */
  whyNot: string | undefined;
}

type Parts = Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>;
type DraggedTree = Pick<Tree, 'element' | 'rowUnder'>;

export function letJointsBeDragged(wb: Parts, tree: DraggedTree): void {
  new TreeDrag(wb, tree).listen();
}

class TreeDrag {
  private readonly line = element('div', { class: 'drop-line', hidden: true });
  private drag: Drag | undefined;
  private marked: HTMLElement | undefined;

  constructor(
    private readonly wb: Parts,
    private readonly tree: DraggedTree,
  ) {}

  listen(): void {
    const target = this.tree.element;
    target.addEventListener('pointerdown', (event) => this.press(event));
    target.addEventListener('pointermove', (event) => this.move(event));
    target.addEventListener('pointerup', (event) => this.release(event));
    for (const type of ['pointercancel', 'lostpointercapture'] as const) {
      target.addEventListener(type, (event) => {
        if (event.pointerId === this.drag?.pointerId) this.finish();
      });
    }
  }

  private press(event: PointerEvent): void {
    if (event.button !== 0 || !event.isPrimary || event.pointerType === 'touch' || this.drag) return;
    if (this.wb.posing.mode.get() !== 'rig' || !(event.target instanceof Element)) return;
    if (event.target.closest('.twisty,input,button')) return;
    const under = this.tree.rowUnder(event.clientY);
    if (under?.row.kind !== 'joint' || under.row.index === 0) return;
    if (!under.made.contains(event.target)) return;
    const { clientX: x, clientY: y, pointerId } = event;
    this.drag = { row: under.row, x, y, pointerId, moved: false, place: undefined, whyNot: undefined };
  }

  private move(event: PointerEvent): void {
    const { drag, tree } = this;
    if (!drag || event.pointerId !== drag.pointerId) return;
    if (event.buttons === 0) {
      this.finish();
      return;
    }
    if (!drag.moved) {
      if (Math.hypot(event.clientX - drag.x, event.clientY - drag.y) <= CLICK_PIXELS) return;
      drag.moved = true;
      tree.element.setPointerCapture(event.pointerId);
      tree.element.classList.add('is-rearranged');
      tree.rowUnder(drag.y)?.made.classList.add('is-dragged');
      window.addEventListener('keydown', this.onKey, true);
    }
    const { top, bottom } = tree.element.getBoundingClientRect();
    if (event.clientY < top + EDGE_PIXELS) tree.element.scrollTop -= EDGE_PIXELS / 2;
    else if (event.clientY > bottom - EDGE_PIXELS) tree.element.scrollTop += EDGE_PIXELS / 2;
    this.follow(drag, event.clientY);
  }

  private follow(drag: Drag, clientY: number): void {
    this.unmark();
    drag.place = undefined;
    drag.whyNot = undefined;
    const under = this.tree.rowUnder(clientY);
    const joints = findCharacter(this.wb.store.document, drag.row.characterId)?.skeleton?.joints;
    if (!under || !joints || under.row.kind !== 'joint' || under.row.characterId !== drag.row.characterId) return;
    const box = under.made.getBoundingClientRect();
    const part = rowPart((clientY - box.top) / box.height);
    drag.place = dropPlace(joints, drag.row.index, under.row.index, part, under.row.expanded);
    if (!drag.place) {
      drag.whyNot = whyNoDrop(joints, drag.row.index, under.row.index);
      return;
    }
    const isParent = drag.place.parent === under.row.index;
    if (isParent && part === 'on') {
      this.marked = under.made;
      this.marked.classList.add('is-drop-parent');
      return;
    }
    const { line } = this;
    const bottom = part === 'above' ? 0 : under.made.offsetHeight;
    write(line, 'hidden', false);
    line.style.top = `${under.made.offsetTop + bottom - 1}px`;
    line.style.left = `calc(${under.row.depth + (isParent ? 1 : 0)} * var(--step) + 18px)`;
    under.made.parentElement?.append(line);
  }

  private release(event: PointerEvent): void {
    const { drag, wb, tree } = this;
    if (!drag || event.pointerId !== drag.pointerId) return;
    const { moved, place, row, whyNot } = drag;
    this.finish();
    if (!moved) return;
    // Releasing a drag isn't a click on the row below.
    const swallow = (click: MouseEvent) => click.stopPropagation();
    tree.element.addEventListener('click', swallow, { capture: true, once: true });
    setTimeout(() => tree.element.removeEventListener('click', swallow, true));
    if (whyNot !== undefined) wb.messages.note(whyNot, 'warning');
    if (!place) return;
    void import('../rig/rig-edits.ts').then((m) => m.moveUnder(wb, row.characterId, { joint: row.index, ...place }));
  }

  private readonly onKey = (event: KeyboardEvent): void => {
    if (event.key !== 'Escape') {
      waitOutDrag(event);
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    this.finish();
  };

  private unmark(): void {
    this.line.remove();
    this.marked?.classList.remove('is-drop-parent');
    this.marked = undefined;
  }

  private finish(): void {
    const { drag } = this;
    const target = this.tree.element;
    this.unmark();
    target.classList.remove('is-rearranged');
    for (const row of target.querySelectorAll('.is-dragged')) row.classList.remove('is-dragged');
    if (drag && target.hasPointerCapture(drag.pointerId)) target.releasePointerCapture(drag.pointerId);
    window.removeEventListener('keydown', this.onKey, true);
    this.drag = undefined;
  }
}
