/**
 * Moving a joint by dragging: in the camera-facing plane, in depth, or along an arrow. Changes the joint's offset, and
 * that of the other selected joints, which move as far in the scene; one undo step. The joint snaps to the grid.
 *
 *     Shift   fine, without the grid
 *     Alt     in depth (so does the right button, from the press on)
 *     Ctrl    snaps to round numbers, or to the mirror image of another joint (across x = 0)
 */
import { setOffset } from '../../../edit/commands/rig-joint.ts';
import { inTurn } from '../../../edit/in-turn.ts';
import {
  alongLine,
  offsetMoved,
  ontoGrid,
  opposite,
  snapped,
  snappedPoint,
  withoutDust,
} from '../../../edit/rig/dragged-places.ts';
import { roundStep } from '../../../math/round-steps.ts';
import { add, scaled, subtract, transformPoint, transformVector, type Vec3, ZERO } from '../../../math/vec3.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Axis } from '../../../view/rig/rig-screen.ts';
import { jointsText, selectedJointsOf } from '../../state/joints/selected-joint.ts';
import type { RigChildren } from '../../state/rig-hand.ts';
import type { Uses } from '../../state/workbench.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import type { BegunDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import { gridSnap, SNAP_PIXELS } from './grid-snap.ts';
import { outermostJoints } from './outermost.ts';
import { editOfRig, meanScale, type Rigged, scenePivot, spaceOfOffset } from './rigged.ts';
import { rigging } from './rigging-args.ts';
import { SteadyHand } from './steady-hand.ts';

/** Snap distance to a mirrored joint on screen. */
const OPPOSITE_PIXELS = 12;

interface Moved {
  readonly offset: Vec3;
  readonly note?: string;
}

function dragJoint(
  wb: Uses<'store' | 'viewport' | 'transport' | 'posing' | 'settings' | 'messages'>,
  rigged: Rigged,
  joint: number,
  at: CanvasPointer,
  move: (hand: SteadyHand, at: CanvasPointer) => Moved | undefined,
): BegunDrag {
  const hand = new SteadyHand(at);
  const { character } = rigged;
  const state = wb.posing.rig;
  const { skeleton } = character;
  const edit = editOfRig(wb, character);
  const joints = selectedJointsOf(wb, character.id);
  const command = inTurn(setOffset, `Move ${jointsText(skeleton, joints)}`);
  const letTravel = wb.viewport.freezeRootMotion(character.id);
  const end = () => {
    letTravel();
    state.readout.set('');
  };
  return {
    move(now) {
      hand.move(now);
      if (skeleton === undefined) return;
      // Where it began, its numbers are as before, neither rounded nor on the grid.
      const isBack = hand.x === at.clientX && hand.y === at.clientY;
      const moved = isBack ? { offset: skeleton.joints[joint].offset } : move(hand, now);
      if (!moved) return;
      const children = state.children.get();
      const each = isBack ? [{ joint, ...moved }] : movedTogether(rigged, joints, joint, moved.offset, children);
      const shared = { ...rigging(wb, character), children };
      edit.preview(
        command,
        each.map((one) => ({ ...shared, ...one })),
      );
      const numbers = moved.offset.map((part) => shown(part)).join(', ');
      state.readout.set(`${jointName(skeleton, joint)}: offset ${numbers}${moved.note ?? ''}`);
    },
    end() {
      edit.commit();
      end();
    },
    cancel() {
      edit.cancel();
      end();
    },
  };
}

/**
 * The offsets that move all selected joints as far as the dragged one. Of joints whose children follow, only the
 * outermost are moved; if children stay, the last joints come first, so that moving their parents leaves them there.
 *
 * @param joints selected ones
 * @param offset of the dragged one
 */
export function movedTogether(
  rigged: Rigged,
  joints: readonly number[],
  dragged: number,
  offset: Vec3,
  children: RigChildren,
): readonly { readonly joint: number; readonly offset: Vec3 }[] {
  if (joints.length < 2 || !joints.includes(dragged)) return [{ joint: dragged, offset }];
  const { skeleton } = rigged;
  const by = transformVector(spaceOfOffset(rigged, dragged), subtract(offset, skeleton.joints[dragged].offset));
  const meant = children === 'follow' ? outermostJoints(skeleton, joints) : [...joints].sort((a, b) => b - a);
  return meant.flatMap((joint) => {
    if (joint === dragged) return { joint, offset };
    const own = offsetMoved(skeleton.joints[joint].offset, spaceOfOffset(rigged, joint), ZERO, by);
    return own ? { joint, offset: own } : [];
  });
}

/** In the camera-facing plane, or in depth. */
export function dragFreely(
  wb: Uses<'store' | 'viewport' | 'transport' | 'posing' | 'settings' | 'messages'>,
  rigged: Rigged,
  joint: number,
  at: CanvasPointer,
): BegunDrag {
  const { eye } = wb.viewport;
  const start = scenePivot(rigged, joint);
  const space = spaceOfOffset(rigged, joint);
  const perPixel = eye.unitsPerPixel(start);
  const onScreen = eye.toScreen(start);
  const { offset } = rigged.skeleton.joints[joint];
  const byRight = at.button === 2;
  const unit = perPixel / meanScale(space);
  return dragJoint(wb, rigged, joint, at, (hand, now) => {
    const [dx, dy] = [hand.x - at.clientX, hand.y - at.clientY];
    const isDeep = byRight || now.altKey;
    const to = isDeep ? eye.inDepth(start, -dy * perPixel) : eye.inPlaneOf(start, onScreen.x + dx, onScreen.y + dy);
    const rounds = now.ctrlKey || now.metaKey;
    const step = rounds ? undefined : gridSnap(wb, now);
    const moved = offsetMoved(offset, space, start, step === undefined ? to : ontoGrid(to, start, step));
    if (!moved) return undefined;
    if (step !== undefined) return { offset: withoutDust(moved, 1e-4 * unit), note: gridNote(step) };
    if (!rounds) return { offset: withoutDust(moved, unit) };
    const across = isDeep ? undefined : oppositePlace(wb, rigged, joint, onScreen.x + dx, onScreen.y + dy);
    const there = across && offsetMoved(offset, space, start, across.at);
    // To the last digit of the other joint, without rounding noise.
    if (there) return { offset: withoutDust(there, 1e-4 * unit), note: ` · opposite ${across.name}` };
    return { offset: snappedPoint(moved, roundStep(SNAP_PIXELS * unit)) };
  });
}

/** Along one of the arrows. */
export function dragAlong(
  wb: Uses<'store' | 'viewport' | 'transport' | 'posing' | 'settings' | 'messages'>,
  rigged: Rigged,
  joint: number,
  axis: Axis,
  at: CanvasPointer,
): BegunDrag {
  const { eye } = wb.viewport;
  const start = scenePivot(rigged, joint);
  const space = spaceOfOffset(rigged, joint);
  const inWorld = wb.posing.rig.axes.get() === 'world';
  const direction: Vec3 = inWorld
    ? [axis === 0 ? 1 : 0, axis === 1 ? 1 : 0, axis === 2 ? 1 : 0]
    : [space[4 * axis], space[4 * axis + 1], space[4 * axis + 2]];
  const { offset } = rigged.skeleton.joints[joint];
  const unit = eye.unitsPerPixel(start) / meanScale(space);
  const from = alongLine(start, direction, eye.rayAt(at.clientX, at.clientY)) ?? 0;
  return dragJoint(wb, rigged, joint, at, (hand, now) => {
    const reached = alongLine(start, direction, eye.rayAt(hand.x, hand.y));
    if (reached === undefined) return undefined;
    const by = reached - from;
    const snaps = now.ctrlKey || now.metaKey;
    const step = snaps ? undefined : gridSnap(wb, now);
    const note = step === undefined ? {} : { note: gridNote(step) };
    if (inWorld) {
      const to = add(start, scaled(direction, by));
      const moved = offsetMoved(offset, space, start, step === undefined ? to : ontoGrid(to, start, step));
      if (!moved) return undefined;
      if (step !== undefined) return { offset: withoutDust(moved, 1e-4 * unit), ...note };
      return { offset: snaps ? snappedPoint(moved, roundStep(SNAP_PIXELS * unit)) : withoutDust(moved, unit) };
    }
    // Along the parent's own axis only this number changes; the others keep their last digit.
    const next: [number, number, number] = [...offset];
    const value = offset[axis] + by;
    const own = snaps ? roundStep(SNAP_PIXELS * unit) : step && step / (Math.hypot(...direction) || 1);
    next[axis] = own ? snapped(value, own) : withoutDust([value, 0, 0], unit)[0];
    return { offset: next, ...note };
  });
}

/**
 * The mirror image, across x = 0 of the character's space, of another joint under the pointer: makes limbs symmetric.
 */
function oppositePlace(
  wb: Uses<'viewport'>,
  { world, placement, skeleton }: Rigged,
  joint: number,
  x: number,
  y: number,
) {
  const { eye } = wb.viewport;
  let best: { readonly at: Vec3; readonly name: string } | undefined;
  let least = OPPOSITE_PIXELS;
  for (const j of skeleton.joints.keys()) {
    if (j === joint) continue;
    const across = opposite([world[16 * j + 12], world[16 * j + 13], world[16 * j + 14]]);
    const at = transformPoint(placement, across);
    const seen = eye.toScreen(at);
    const distance = Math.hypot(seen.x - x, seen.y - y);
    if (seen.depth <= 0 || distance > least) continue;
    least = distance;
    best = { at, name: jointName(skeleton, j) };
  }
  return best;
}

function gridNote(step: number): string {
  return ` · grid ${shown(step)}`;
}
