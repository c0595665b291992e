/**
 * How each joint type moves: one rule per type, from a motion to the matrix J(φ) of its DOFs and its derivative with
 * respect to each of them.
 *
 * Everything else about a type is in its record (`model/joint-types.ts`). A fast path for the most common type gains
 * nothing, since calls of a single function are inlined anyway.
 */
import { perObject } from '../model/per-object.ts';
import type { Motion } from '../model/skeleton/skeleton.ts';
import { acclaimMotion } from './motions/acclaim.ts';
import { prismaticMotion, screwMotion } from './motions/axis.ts';
import { BALLS } from './motions/ball.ts';
import type { JointMotion } from './motions/motion.ts';
import { bvhMotion, freeMotion } from './motions/moving.ts';
import { factorOf, productOf, universalMotion } from './motions/product.ts';
import { QUATERNION } from './motions/quaternion.ts';
import { SHEAR_MOTION, scaleMotion } from './motions/scale.ts';

type Rules = { readonly [K in Motion['kind']]: (motion: Extract<Motion, { kind: K }>) => JointMotion };

const MOTION_RULES: Rules = {
  ball: ({ order }) => BALLS[order],
  hinge: ({ axis }) => screwMotion(axis, 0),
  universal: ({ order }) => universalMotion(order),
  quaternion: () => QUATERNION,
  prismatic: ({ axis }) => prismaticMotion(axis),
  translational: () => TRANSLATIONAL,
  free: ({ order }) => freeMotion(order),
  screw: ({ axis, pitch }) => screwMotion(axis, pitch),
  scale: ({ mode, axis }) => scaleMotion(mode, axis),
  shear: () => SHEAR_MOTION,
  fixed: () => FIXED,
  compound: ({ dofs }) => productOf(dofs.map(factorOf)),
  bvh: bvhMotion,
  acclaim: acclaimMotion,
  point: () => POINT,
};

const TRANSLATIONAL = productOf(['tx', 'ty', 'tz'].map(factorOf));
const FIXED = productOf([]);
/** Whether it is there moves it nowhere. */
const POINT: JointMotion = {
  ...TRANSLATIONAL,
  writeDerivative(dofs, first, dof, out, o) {
    if (dof < 3) TRANSLATIONAL.writeDerivative(dofs, first, dof, out, o);
    else out.fill(0, o, o + 16);
  },
};

/** The rule of a joint. Cached, since thousands of joints share what they don't state. */
export const jointMotion = perObject((motion: Motion): JointMotion => {
  // Each rule takes the kind that it is stored under.
  const rule = MOTION_RULES[motion.kind] as (motion: Motion) => JointMotion;
  return rule(motion);
});
