/** Which joints are the bones of VRM's humanoid: as a file states them, else as retargeting recognises them. */

import { FINGERS } from '../../evaluate/retarget/fingers.ts';
import type { BodyParts, BodySide, LimbPart } from '../../evaluate/retarget/roles.ts';
import { LIMB_SIDES } from '../../evaluate/retarget/roles.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/** Joint by VRM's name of a bone. */
export type HumanBones = ReadonlyMap<string, number>;

const LIMBS: Readonly<Record<LimbPart, string>> = {
  collar: 'Shoulder',
  arm: 'UpperArm',
  forearm: 'LowerArm',
  hand: 'Hand',
  thigh: 'UpperLeg',
  shin: 'LowerLeg',
  foot: 'Foot',
  toe: 'Toes',
};
/** A limb's parts, from the trunk outwards. */
const PARTS = Object.keys(LIMBS) as readonly LimbPart[];
const TRUNK = ['hips', 'spine', 'chest', 'upperChest', 'neck', 'head'] as const;
const SPINE = ['spine', 'chest', 'upperChest'] as const;
const OPTIONAL = /Shoulder|Toes/;

/** Bones that every humanoid has. */
export const REQUIRED: readonly string[] = [
  'hips',
  'spine',
  'head',
  ...LIMB_SIDES.flatMap((side) => PARTS.map((part) => boneName(side, part)).filter((bone) => !OPTIONAL.test(bone))),
];

function boneName(side: BodySide, part: LimbPart): string {
  return `${side}${LIMBS[part]}`;
}

/** The bones of a skeleton: those that it has. */
export function humanBones({ joints }: Skeleton, parts: BodyParts): HumanBones {
  const bones = new Map<string, number>();
  joints.forEach(({ role }, j) => {
    if (role && isBone(role) && !bones.has(role)) bones.set(role, j);
  });
  if (bones.size > 0) return bones;
  const { single, spine, neck, names } = parts;
  const add = (bone: string, joint: number | undefined) => {
    if (joint !== undefined) bones.set(bone, joint);
  };
  add('hips', single.get('hips'));
  // The lowest, the one above it, and the highest.
  const [lowest, second, ...others] = spine;
  [lowest, second, others.at(-1)].forEach((joint, i) => {
    add(SPINE[i], joint);
  });
  add('neck', neck.at(0));
  add('head', single.get('head'));
  for (const side of LIMB_SIDES) {
    for (const part of PARTS) add(boneName(side, part), single.get(`${side} ${part}`));
    for (const finger of FINGERS) {
      const own = joints.flatMap((_, j) => (names[j].word === finger && names[j].side === side ? [j] : []));
      fingerBones(own, joints, finger === 'thumb').forEach(([bone, joint]) => {
        add(`${side}${FINGER_NAMES[finger]}${bone}`, joint);
      });
    }
  }
  return bones;
}

const FINGER_NAMES = { thumb: 'Thumb', index: 'Index', middle: 'Middle', ring: 'Ring', pinky: 'Little' } as const;
const FINGER_BONES = ['Proximal', 'Intermediate', 'Distal'];
const THUMB_BONES = ['Metacarpal', 'Proximal', 'Distal'];

/** The first three bones of a finger that follow each other. */
function fingerBones(own: readonly number[], joints: Skeleton['joints'], isThumb: boolean): [string, number][] {
  const chain = own.slice(0, 1);
  for (const joint of own.slice(1)) if (joints[joint].parent === chain[chain.length - 1]) chain.push(joint);
  return (isThumb ? THUMB_BONES : FINGER_BONES).slice(0, chain.length).map((bone, i) => [bone, chain[i]]);
}

const SIDED = new RegExp(
  `^(left|right)(${[...Object.values(LIMBS), '(Thumb|Index|Middle|Ring|Little)\\w+'].join('|')})$`,
);

function isBone(name: string): boolean {
  return TRUNK.some((bone) => bone === name) || SIDED.test(name);
}
