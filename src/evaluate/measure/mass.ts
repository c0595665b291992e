/**
 * The centre of mass as a sum over joints: c = Σ w_j p_j, with Σ w_j = 1, since the centre of each segment is a point
 * between two joints.
 *
 * Of a body whose arms and legs are recognised, the masses and centres of segments are those of P. de Leva,
 * *Adjustments to Zatsiorsky-Seluyanov's segment inertia parameters*, Journal of Biomechanics 29 (1996), table 4, men:
 * of the trunk that from the middle of the shoulders to that of the hips, of the shank that to the ankle. Head and
 * hands have their mass at their joint, as skeletons don't say where they end; the foot, from heel to toes in the
 * table, has its own between ankle and toes. Any other skeleton is uniform over its bones:
 * each from a joint to its parent, as heavy as it is long at rest.
 */
import { perObject } from '../../model/per-object.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { distance, type RetargetBody } from '../retarget/body.ts';
import { LIMB_SIDES, type LimbPart, type Roles, rolesOf } from '../retarget/roles.ts';

/** `segments`: by limb segments; `bones`: uniform over bones. */
export type MassModel = 'segments' | 'bones';

/** The centre of mass as weights of joints' positions. */
export interface JointMasses {
  readonly model: MassModel;
  /** One per joint; their sum is 1. */
  readonly weights: Float64Array;
}

interface Segment {
  readonly from: LimbPart;
  readonly to: LimbPart;
  /** Part of the body's mass. */
  readonly mass: number;
  /** Where its centre is: 0 at `from`, 1 at `to`. */
  readonly centre: number;
}

const SEGMENTS: readonly Segment[] = [
  { from: 'arm', to: 'forearm', mass: 0.0271, centre: 0.5772 },
  { from: 'forearm', to: 'hand', mass: 0.0162, centre: 0.4574 },
  { from: 'hand', to: 'hand', mass: 0.0061, centre: 0 },
  { from: 'thigh', to: 'shin', mass: 0.1416, centre: 0.4095 },
  { from: 'shin', to: 'foot', mass: 0.0433, centre: 0.4395 },
  { from: 'foot', to: 'toe', mass: 0.0137, centre: 0.4415 },
];
/** From the middle of the shoulders to the middle of the hips. */
const TRUNK = { mass: 0.4346, centre: 0.431 };
const HEAD = 0.0694;

/** Cached. */
export const jointMasses: (skeleton: Skeleton) => JointMasses = perObject((skeleton: Skeleton) => {
  const roles = rolesOf(skeleton, undefined);
  const weights = bySegments(skeleton, roles);
  return weights ? { model: 'segments', weights } : { model: 'bones', weights: byBones(skeleton, roles.rest) };
});

/** Undefined if a part of an arm or a leg is not recognised. */
function bySegments({ joints }: Skeleton, { single }: Roles): Float64Array | undefined {
  const weights = new Float64Array(joints.length);
  const add = (joint: number | undefined, mass: number) => {
    if (joint !== undefined) weights[joint] += mass;
    return joint !== undefined;
  };
  const head = single.get('head');
  if (head !== undefined) add(head, HEAD);
  for (const side of LIMB_SIDES) {
    for (const { from, to, mass, centre } of SEGMENTS) {
      const at = single.get(`${side} ${from}`);
      // A foot without toes has its mass at the ankle.
      const end = single.get(`${side} ${to}`) ?? (to === 'toe' ? at : undefined);
      if (!add(at, mass * (1 - centre)) || !add(end, mass * centre)) return undefined;
    }
    // Without a head, its mass is where the trunk ends.
    const top = TRUNK.mass * (1 - TRUNK.centre) + (head === undefined ? HEAD : 0);
    add(single.get(`${side} arm`), top / 2);
    add(single.get(`${side} thigh`), (TRUNK.mass * TRUNK.centre) / 2);
  }
  return weights;
}

function byBones({ joints }: Skeleton, rest: RetargetBody): Float64Array {
  const weights = new Float64Array(joints.length);
  let sum = 0;
  joints.forEach(({ parent }, j) => {
    if (parent < 0) return;
    const length = distance(rest, parent, j);
    weights[j] += length / 2;
    weights[parent] += length / 2;
    sum += length;
  });
  if (!(sum > 0)) return weights.fill(1 / Math.max(1, joints.length));
  for (let j = 0; j < weights.length; j++) weights[j] /= sum;
  return weights;
}
