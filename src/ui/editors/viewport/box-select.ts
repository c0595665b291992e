/**
 * Box selection of joints: Ctrl (Cmd) and a drag that begins beside the characters, in any mode. The joints inside are
 * added to the selection, those of the current character last; Escape restores it.
 */
import { transformPoint, type Vec3 } from '../../../math/vec3.ts';
import { withJointsOfAll } from '../../../model/skeleton/joint-selection.ts';
import { jointsIn, partOf } from '../../../model/skeleton/selected-joints.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { element, write } from '../../widgets/dom.ts';
import { type CanvasDrag, type CanvasPointer, type CanvasTool, CLICK_PIXELS } from './canvas-tools.ts';

/** A joint on the page. */
export interface SeenJoint {
  readonly characterId: string;
  readonly joint: number;
  /** Client coordinates. */
  readonly x: number;
  readonly y: number;
}

type Corner = Pick<CanvasPointer, 'clientX' | 'clientY'>;

/**
 * A mode's tool with box selection, where the tool itself has no use for the press.
 *
 * @param pick a click that the tool doesn't use
 */
export function withBoxSelect(
  wb: Workbench,
  tool: () => CanvasTool | undefined,
  pick: (at: CanvasPointer) => void,
): () => CanvasTool {
  const click = (at: CanvasPointer) => tool()?.click?.(at) ?? false;
  const clicked = (at: CanvasPointer) => {
    if (!click(at)) pick(at);
  };
  const made: CanvasTool = {
    press: (at) => tool()?.press(at) ?? (asksForBox(wb, at) ? drag(wb, at, clicked) : undefined),
    click,
    hover: (at) => tool()?.hover?.(at),
  };
  return () => made;
}

function asksForBox({ viewport }: Uses<'viewport'>, at: CanvasPointer): boolean {
  const { button, ctrlKey, metaKey, shiftKey, altKey, pointerType } = at;
  if (button !== 0 || !(ctrlKey || metaKey) || shiftKey || altKey || pointerType !== 'mouse') return false;
  return viewport.pointing.pick(at.clientX, at.clientY) === undefined;
}

function drag(wb: Workbench, from: CanvasPointer, clicked: (at: CanvasPointer) => void): CanvasDrag {
  const { store, viewportElement } = wb;
  const before = store.selection;
  const frame = element('div', { class: 'box-select', hidden: true });
  let seen: readonly SeenJoint[] | undefined;
  return {
    get hasBegun() {
      return seen !== undefined;
    },
    move(at) {
      if (!seen) {
        if (Math.hypot(at.clientX - from.clientX, at.clientY - from.clientY) <= CLICK_PIXELS) return;
        seen = jointsOnPage(wb);
        viewportElement.append(frame);
      }
      place(frame, viewportElement, from, at);
      const found = jointsInBox(seen, from, at, before.characterId ?? currentCharacter(wb)?.id);
      const added = found.filter(({ characterId, joint }) => {
        const part = partOf(before, characterId);
        return !part || !jointsIn(part).includes(joint);
      });
      store.select(added.length ? withJointsOfAll(added, before) : before);
    },
    end(at) {
      frame.remove();
      if (!seen) clicked(at);
    },
    cancel() {
      frame.remove();
      store.select(before);
    },
  };
}

/** The joints between two corners, those of the preferred character last. */
export function jointsInBox(
  seen: readonly SeenJoint[],
  a: Corner,
  b: Corner,
  preferred: string | undefined,
): readonly SeenJoint[] {
  const isWithin = (value: number, from: number, to: number) =>
    value >= Math.min(from, to) && value <= Math.max(from, to);
  const inside = seen.filter(({ x, y }) => isWithin(x, a.clientX, b.clientX) && isWithin(y, a.clientY, b.clientY));
  const isLast = ({ characterId }: SeenJoint) => characterId === preferred;
  return [...inside.filter((one) => !isLast(one)), ...inside.filter(isLast)];
}

/** Those of visible characters in front of the camera, at the instances that are edited. */
function jointsOnPage({ store, viewport }: Uses<'store' | 'viewport'>): readonly SeenJoint[] {
  const { eye } = viewport;
  return store.document.characters.flatMap((character) => {
    const world = character.isHidden ? undefined : viewport.character(character.id)?.worlds;
    const placement = viewport.placementOf(character.id, viewport.pickedCopy(character));
    if (!world || placement?.length !== 16) return [];
    return (character.skeleton?.joints ?? []).flatMap((_, joint) => {
      const o = 16 * joint + 12;
      const own: Vec3 = [world[o], world[o + 1], world[o + 2]];
      const { x, y, depth } = eye.toScreen(transformPoint(placement, own));
      return depth > 0 ? { characterId: character.id, joint, x, y } : [];
    });
  });
}

function place(frame: HTMLElement, within: HTMLElement, a: Corner, b: Corner): void {
  const { left, top } = within.getBoundingClientRect();
  write(frame, 'hidden', false);
  frame.style.left = `${Math.min(a.clientX, b.clientX) - left}px`;
  frame.style.top = `${Math.min(a.clientY, b.clientY) - top}px`;
  frame.style.width = `${Math.abs(a.clientX - b.clientX)}px`;
  frame.style.height = `${Math.abs(a.clientY - b.clientY)}px`;
}
