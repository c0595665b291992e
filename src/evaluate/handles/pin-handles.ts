/** The handles of a pin: an arrow along each axis, a square across each, and rings if it holds an orientation. */
import { transformVector, unit, type Vec3 } from '../../math/vec3.ts';
import { FRAME_SIZE, writeFrame } from '../ik/orientation.ts';
import { type Handle, type JointHandles, ownRing } from './joint-handles.ts';

/** The axes that a pin is moved along: the character's own, those of the pin's joint, or those of the joint above. */
export const PIN_AXES = ['world', 'local', 'parent'] as const;
/** One of them. */
export type PinAxes = (typeof PIN_AXES)[number];

/** Normalised, in the space of the world matrices, and at right angles. */
export type Axes = readonly [Vec3, Vec3, Vec3];

/**
 * The axes of a pin of a joint.
 * @param world from `worldMatrices`
 * @param parent of the joint; −1 for the root, above which is the character
 */
export function pinAxes(which: PinAxes, joint: number, parent: number, world: Float64Array): Axes {
  const of = which === 'local' ? joint : which === 'parent' ? parent : -1;
  if (of < 0) {
    return [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ];
  }
  const frame = new Float64Array(FRAME_SIZE);
  writeFrame(world, 16 * of, frame, 0);
  const column = (k: number): Vec3 => [frame[3 * k], frame[3 * k + 1], frame[3 * k + 2]];
  return [column(0), column(1), column(2)];
}

/**
 * The handles of a pin in the scene.
 *
 * @param pivot where the pin is, in the scene
 * @param size of the gizmo's joint, as `JointHandles` has it
 * @param placement from the space of the axes to the scene
 * @param turns whether the pin holds an orientation
 */
export function pinHandles(
  pivot: Vec3,
  size: number,
  axes: Axes,
  placement: Float64Array,
  turns: boolean,
): JointHandles {
  const [x, y, z] = axes.map((axis) => unit(transformVector(placement, axis)) ?? axis);
  const all = [x, y, z];
  const each = [0, 1, 2] as const;
  const rings = each.map((k) => ownRing(k, all[k], pivot));
  const arrows = each.map((k): Handle => ({ ...rings[k], id: { kind: 'along', axis: k }, kind: 'slide' }));
  const planes = each.map((k) => {
    const plane = [all[(k + 1) % 3], all[(k + 2) % 3]] as const;
    return { id: { kind: 'across', axis: k }, centre: pivot, axes: plane, hue: k } as const;
  });
  return { pivot, size, handles: [...(turns ? rings : []), ...arrows], planes, freeTurn: undefined };
}
