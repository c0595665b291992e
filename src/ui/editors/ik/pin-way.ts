/** Drags a handle of a pin: what each position of the pointer makes of it, and in words. */
import { DraggedValue } from '../../../evaluate/handles/dragged-value.ts';
import type { Handle, HandleId, JointHandles, PlaneHandle } from '../../../evaluate/handles/joint-handles.ts';
import { axisOf, sameHandle } from '../../../evaluate/handles/joint-handles.ts';
import { add, type Vec3 } from '../../../math/vec3.ts';
import { planeMeasure, type Sight, slideMeasure, turnMeasure } from '../../../view/gizmo/pointer-measures.ts';
import { wantsOf } from '../fk/movers.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';
import type { HandPull } from './hand-pull.ts';

/** How far a pin has been moved along an axis, in the world's unit, or turned about it, in radians. */
export interface PinMove {
  /** 0, 1 or 2. */
  readonly axis: number;
  readonly by: number;
}

/** Moves the pin for a position of the pointer, and says by what. */
export type PinWay = (at: CanvasPointer) => readonly PinMove[];

/** What values snap to with Ctrl: lengths in the world's unit, and radians. */
export interface PinSnaps {
  readonly length: number;
  readonly angle: number;
}

const FREE = { min: 1, max: 0, hold: false };

/** What a drag of a handle goes by, from its press on. */
export interface PinPress {
  readonly sight: Sight;
  readonly at: CanvasPointer;
  /** Of the rings in the world. */
  readonly size: number;
  readonly snaps: PinSnaps;
}

/** Undefined if there is no such handle. */
export function pinWay(
  id: HandleId,
  { handles, planes = [] }: JointHandles,
  hand: HandPull,
  press: PinPress,
): PinWay | undefined {
  const plane = planes.find((one) => sameHandle(one.id, id));
  if (plane) return planeWay(plane, hand, press);
  const handle = handles.find((one) => sameHandle(one.id, id));
  return handle && axisWay(handle, hand, press);
}

function axisWay(
  { id, axis: direction, centre, kind }: Handle,
  hand: HandPull,
  { sight, at: { clientX, clientY }, size, snaps }: PinPress,
): PinWay | undefined {
  const axis = axisOf(id);
  if (axis === undefined) return undefined;
  const isTurn = kind === 'turn';
  const from = hand.hand;
  const measure = isTurn
    ? turnMeasure(sight, direction, centre, size, clientX, clientY)
    : slideMeasure(sight, direction, centre, clientX, clientY);
  const value = new DraggedValue(0, FREE, isTurn ? snaps.angle : snaps.length, true);
  return (now) => {
    const by = value.by(measure(now.clientX, now.clientY), wantsOf(now)).value;
    if (isTurn) hand.turn(direction, by);
    else hand.to(add(from, direction, by));
    return [{ axis, by }];
  };
}

function planeWay(
  { id, axes, centre }: PlaneHandle,
  hand: HandPull,
  { sight, at: { clientX, clientY }, snaps: { length } }: PinPress,
): PinWay | undefined {
  const axis = axisOf(id);
  if (axis === undefined) return undefined;
  const from: Vec3 = hand.hand;
  const measure = planeMeasure(sight, axes, centre, clientX, clientY);
  const values = axes.map(() => new DraggedValue(0, FREE, length, true));
  return (now) => {
    const by = measure(now.clientX, now.clientY);
    const [a, b] = values.map((value, i) => value.by(by[i], wantsOf(now)).value);
    hand.to(add(add(from, axes[0], a), axes[1], b));
    return [
      { axis: (axis + 1) % 3, by: a },
      { axis: (axis + 2) % 3, by: b },
    ];
  };
}
