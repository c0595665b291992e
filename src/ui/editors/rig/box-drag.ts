/**
 * Dragging a face of a joint's box, which snaps to multiples of the grid's spacing. Shift: fine, without the grid;
 * Ctrl: snaps to round numbers; Alt: moves the opposite face symmetrically. One undo step.
 */
import { setBox } from '../../../edit/commands/rig-joint.ts';
import { alongLine, type BoxSide, boxWithFace, parentToScene, withoutDust } from '../../../edit/rig/dragged-places.ts';
import { roundStep } from '../../../math/round-steps.ts';
import { transformPoint, type Vec3 } from '../../../math/vec3.ts';
import type { Axis } from '../../../view/rig/rig-screen.ts';
import type { Uses } from '../../state/workbench.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import type { BegunDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import { gridSnap, SNAP_PIXELS } from './grid-snap.ts';
import { editOfRig, type Rigged } from './rigged.ts';
import { rigging } from './rigging-args.ts';
import { SteadyHand } from './steady-hand.ts';

export function dragFace(
  wb: Uses<'store' | 'viewport' | 'transport' | 'posing' | 'settings' | 'messages'>,
  { character, skeleton, world, placement }: Rigged,
  joint: number,
  face: { readonly axis: Axis; readonly side: BoxSide },
  at: CanvasPointer,
): BegunDrag {
  const { axis, side } = face;
  const { eye } = wb.viewport;
  const { readout } = wb.posing.rig;
  const { box } = skeleton.joints[joint];
  const hand = new SteadyHand(at);
  const edit = editOfRig(wb, character);
  const space = parentToScene(placement, world, joint);
  const middle: [number, number, number] = [0, 0, 0];
  for (let k = 0; k < 3; k++) middle[k] = (box.min[k] + box.max[k]) / 2;
  middle[axis] = box[side][axis];
  const anchor = transformPoint(space, middle);
  // Along one unit of the box's own axis, so that the result is in the box's unit.
  const direction: Vec3 = [space[4 * axis], space[4 * axis + 1], space[4 * axis + 2]];
  const unit = eye.unitsPerPixel(anchor) / (Math.hypot(...direction) || 1);
  const from = alongLine(anchor, direction, eye.rayAt(at.clientX, at.clientY)) ?? 0;
  const end = () => readout.set('');
  return {
    move(now) {
      hand.move(now);
      const reached = alongLine(anchor, direction, eye.rayAt(hand.x, hand.y));
      if (reached === undefined) return;
      const snaps = now.ctrlKey || now.metaKey;
      const grid = snaps ? undefined : gridSnap(wb, now);
      const step = snaps ? roundStep(SNAP_PIXELS * unit) : grid && grid / (Math.hypot(...direction) || 1);
      const by = withoutDust([reached - from, 0, 0], unit)[0];
      const next = boxWithFace(box, axis, side, by, { both: now.altKey, step, unitsPerPixel: unit });
      edit.preview(setBox, { ...rigging(wb, character), joint, box: next });
      const size = next.max.map((most, k) => shown(Math.abs(most - next.min[k]))).join(' × ');
      readout.set(
        `Box: ${side} ${'xyz'[axis]} ${shown(next[side][axis])} · ${size}${grid === undefined ? '' : ` · grid ${shown(grid)}`}`,
      );
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
