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

export function letJointsBeDragged(
  wb: Uses<'store' | 'transport' | 'timeline' | 'posing' | 'settings' | 'messages'>,
  tree: Pick<Tree, 'element' | 'rowUnder'>,
): void {
  const line = element('div', { class: 'drop-line', hidden: true });
  let drag: Drag | undefined;
  let marked: HTMLElement | undefined;

  const unmark = () => {
    line.remove();
    marked?.classList.remove('is-drop-parent');
    marked = undefined;
  };
  const finish = () => {
    unmark();
    tree.element.classList.remove('is-rearranged');
    for (const row of tree.element.querySelectorAll('.is-dragged')) row.classList.remove('is-dragged');
    if (drag && tree.element.hasPointerCapture(drag.pointerId)) tree.element.releasePointerCapture(drag.pointerId);
    window.removeEventListener('keydown', onKey, true);
    drag = undefined;
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.key !== 'Escape') return waitOutDrag(event);
    event.preventDefault();
    event.stopPropagation();
    finish();
  };

  const follow = (event: PointerEvent) => {
    if (!drag) return;
    unmark();
    drag.place = undefined;
    drag.whyNot = undefined;
    const under = tree.rowUnder(event.clientY);
    const joints = findCharacter(wb.store.document, drag.row.characterId)?.skeleton?.joints;
    if (!under || !joints || under.row.kind !== 'joint' || under.row.characterId !== drag.row.characterId) return;
    const box = under.made.getBoundingClientRect();
    const part = rowPart((event.clientY - box.top) / box.height);
    drag.place = dropPlace(joints, drag.row.index, under.row.index, part, under.row.expanded);
    if (!drag.place) {
      drag.whyNot = whyNoDrop(joints, drag.row.index, under.row.index);
      return;
    }
    if (drag.place.parent === under.row.index && part === 'on') {
      marked = under.made;
      marked.classList.add('is-drop-parent');
      return;
    }
    const { parentElement } = under.made;
    const isBelow = part !== 'above';
    const depth = under.row.depth + (drag.place.parent === under.row.index ? 1 : 0);
    write(line, 'hidden', false);
    line.style.top = `${under.made.offsetTop + (isBelow ? under.made.offsetHeight : 0) - 1}px`;
    line.style.left = `calc(${depth} * var(--step) + 18px)`;
    parentElement?.append(line);
  };

  tree.element.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || !event.isPrimary || event.pointerType === 'touch' || drag) return;
    if (wb.posing.mode.get() !== 'rig' || !(event.target instanceof Element)) return;
    if (event.target.closest('.twisty,input,button')) return;
    const under = tree.rowUnder(event.clientY);
    if (under?.row.kind !== 'joint' || under.row.index === 0) return;
    if (!under.made.contains(event.target)) return;
    drag = {
      row: under.row,
      x: event.clientX,
      y: event.clientY,
      pointerId: event.pointerId,
      moved: false,
      place: undefined,
      whyNot: undefined,
    };
  });
  tree.element.addEventListener('pointermove', (event) => {
    if (!drag || event.pointerId !== drag.pointerId) return;
    if (event.buttons === 0) return finish();
    if (!drag.moved) {
      if (Math.hypot(event.clientX - drag.x, event.clientY - drag.y) <= CLICK_PIXELS) return;
      drag.moved = true;
      tree.element.setPointerCapture(event.pointerId);
      tree.element.classList.add('is-rearranged');
      tree.rowUnder(drag.y)?.made.classList.add('is-dragged');
      window.addEventListener('keydown', onKey, true);
    }
    const { top, bottom } = tree.element.getBoundingClientRect();
    if (event.clientY < top + EDGE_PIXELS) tree.element.scrollTop -= EDGE_PIXELS / 2;
    else if (event.clientY > bottom - EDGE_PIXELS) tree.element.scrollTop += EDGE_PIXELS / 2;
    follow(event);
  });
  tree.element.addEventListener('pointerup', (event) => {
    if (!drag || event.pointerId !== drag.pointerId) return;
    const { moved, place, row, whyNot } = drag;
    finish();
    if (!moved) return;
    // Releasing a drag isn't a click on the row below.
    const swallow = (click: MouseEvent) => click.stopPropagation();
    tree.element.addEventListener('click', swallow, { capture: true, once: true });
    setTimeout(() => tree.element.removeEventListener('click', swallow, true));
    if (whyNot !== undefined) wb.messages.note(whyNot, 'warning');
    if (!place) return;
    void import('../rig/rig-edits.ts').then((m) => m.moveUnder(wb, row.characterId, { joint: row.index, ...place }));
  });
  for (const type of ['pointercancel', 'lostpointercapture'] as const) {
    tree.element.addEventListener(type, (event) => {
      if (event.pointerId === drag?.pointerId) finish();
    });
  }
}
