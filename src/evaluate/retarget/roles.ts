/**
 * Which joint of a skeleton is which part of the body: by name as far as possible, otherwise by shape.
 *
 *     hips ─┬─ spine … ─┬─ neck … ─ head
 *           │           └─ collar ─ arm ─ forearm ─ hand      (left and right)
 *           └─ thigh ─ shin ─ foot ─ toe                      (left and right)
 */

import { perSkeleton } from '../../model/skeleton/per-skeleton.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { DEFAULT_SPACE, type Space } from '../../model/space.ts';
import { type RetargetBody, retargetBody } from './body.ts';
import { type NameParts, readName, type Word } from './names.ts';
import { rolesByShape } from './shape.ts';

/** Parts that exist once, or once per side. */
const LIMB_PARTS = ['collar', 'arm', 'forearm', 'hand', 'thigh', 'shin', 'foot', 'toe'] as const;
/** A part of an arm or leg. */
export type LimbPart = (typeof LIMB_PARTS)[number];
/** The sides that limbs come on. */
export const LIMB_SIDES = ['left', 'right'] as const;
/** The side of a limb. */
export type BodySide = (typeof LIMB_SIDES)[number];

/** `left thigh`, or `hips`. */
export type Role = `${BodySide} ${LimbPart}` | 'hips' | 'head';

/** Parts of the body that a skeleton's joints are, whatever its unit and its place. */
export interface BodyParts {
  readonly single: ReadonlyMap<Role, number>;
  /** From the bottom up. */
  readonly spine: readonly number[];
  readonly neck: readonly number[];
  /** Joints recognised by shape. */
  readonly byShape: ReadonlySet<number>;
  readonly names: readonly NameParts[];
}

/** The parts of a body by joint, with the character in which they were recognised. */
export interface Roles extends BodyParts {
  readonly rest: RetargetBody;
}

/** Which joint of a skeleton is which part of the body, in its file pose. */
export function rolesOf(skeleton: Skeleton, space: Space | undefined): Roles {
  return { ...partsOf(skeleton, space?.up), rest: retargetBody(skeleton, space) };
}

/** Cached. @param up by which shapes are recognised; default y */
export function partsOf(skeleton: Skeleton, up: Space['up'] = 'y'): BodyParts {
  return PARTS[up](skeleton);
}

const PARTS = {
  y: perSkeleton((skeleton) => find(skeleton, 'y')),
  z: perSkeleton((skeleton) => find(skeleton, 'z')),
  '-y': perSkeleton((skeleton) => find(skeleton, '-y')),
} as const satisfies Readonly<Record<Space['up'], (skeleton: Skeleton) => BodyParts>>;

/** From the root to a joint. */
function chainIn(joints: Skeleton['joints'], joint: number): number[] {
  const chain: number[] = [];
  for (let j = joint; j >= 0; j = joints[j].parent) chain.unshift(j);
  return chain;
}

function find(skeleton: Skeleton, up: Space['up']): BodyParts {
  const { joints } = skeleton;
  const names = namesOf(skeleton);
  const single = new Map<Role, number>();
  const byShape = new Set<number>();
  const chainTo = (joint: number) => chainIn(joints, joint);
  const first = (word: Word, side: string) => names.findIndex((n) => n.word === word && n.side === side);
  const take = (role: Role, ...candidates: readonly number[]) => {
    const found = candidates.find((j) => j >= 0);
    if (found !== undefined && !single.has(role)) single.set(role, found);
  };
  for (const side of LIMB_SIDES) {
    const [shoulder, arm] = [first('shoulder', side), first('arm', side)];
    take(`${side} collar`, first('collar', side), arm >= 0 ? shoulder : -1);
    take(`${side} arm`, arm, shoulder);
    take(`${side} forearm`, first('forearm', side));
    take(`${side} hand`, first('hand', side));
    const [leg, shin, above] = [first('leg', side), first('shin', side), first('thigh', side)];
    const thigh = above >= 0 ? above : first('sidedHip', side);
    take(`${side} thigh`, thigh, shin >= 0 ? leg : -1);
    take(`${side} shin`, shin, thigh >= 0 ? leg : -1);
    take(`${side} foot`, first('foot', side));
    take(`${side} toe`, first('toe', side));
  }
  // The hips carry both legs, whatever their name.
  const thighs = LIMB_SIDES.map((side) => single.get(`${side} thigh`));
  const named = names.findIndex((n) => n.word === 'hips' && n.side === 'middle' && /hip|pelvis/i.test(n.plain));
  if (thighs[0] !== undefined && thighs[1] !== undefined) {
    const [left, right] = [chainTo(thighs[0]), chainTo(thighs[1])];
    const common = left.filter((j) => right.includes(j)).at(-1) ?? 0;
    // A pelvis on the path to the legs is meant; one beside it rotates no legs.
    single.set('hips', named >= 0 && left.includes(named) && right.includes(named) ? named : common);
  } else take('hips', named, first('hips', 'middle'));
  take('head', first('head', 'middle'));

  const shape = hasLimbs(single) ? undefined : rolesByShape(skeleton, retargetBody(skeleton, { ...DEFAULT_SPACE, up }));
  if (shape) {
    const guess = (role: Role, joint: number | undefined) => {
      if (joint === undefined || joint < 0 || single.has(role)) return;
      if ([...single.values()].includes(joint)) return;
      single.set(role, joint);
      byShape.add(joint);
    };
    for (const side of LIMB_SIDES) {
      const leg = shape.legs?.[side] ?? [];
      (['thigh', 'shin', 'foot', 'toe'] as const).forEach((part, i) => {
        guess(`${side} ${part}`, leg[i]);
      });
      const arm = shape.arms?.[side];
      guess(`${side} collar`, arm?.collar);
      (['arm', 'forearm', 'hand'] as const).forEach((part, i) => {
        guess(`${side} ${part}`, arm?.chain[i]);
      });
    }
    guess('hips', shape.hips);
    guess('head', shape.head);
  }
  const taken = new Set(single.values());
  const hips = single.get('hips') ?? -1;
  const end = single.get('head') ?? last(names, 'neck') ?? last(names, 'spine') ?? -1;
  const trunk = end >= 0 ? chainTo(end).filter((j) => j > hips && !taken.has(j)) : [];
  const spine = trunk.filter((j) => names[j].word === 'spine');
  const neck = trunk.filter((j) => names[j].word === 'neck');
  if (!spine.length && shape) {
    spine.push(...shape.spine.filter((j) => !taken.has(j)));
    for (const j of spine) byShape.add(j);
  }
  if (!neck.length && shape) {
    neck.push(...shape.neck.filter((j) => !taken.has(j)));
    for (const j of neck) byShape.add(j);
  }
  // `LowerNeck`, `Neck` and nothing above: the last one carries the head.
  if (!single.has('head') && neck.length > 1) {
    const top = neck.pop();
    if (top !== undefined) single.set('head', top);
  }
  return { single, spine, neck, byShape, names };
}

/** Cached, since shapes are looked for along two axes; equal names share what they say. */
const namesOf = perSkeleton((skeleton): readonly NameParts[] => {
  const stated = statedNames(skeleton);
  if (stated) return stated;
  const known = new Map<string, NameParts>();
  return skeleton.joints.map(({ name }) => {
    const parts = known.get(name) ?? readName(name);
    known.set(name, parts);
    return parts;
  });
});

/** The parts of the body that a file states, as names; undefined if it states none. */
function statedNames({ joints }: Skeleton): readonly NameParts[] | undefined {
  if (!joints.some(({ role }) => role)) return undefined;
  return joints.map(({ name, role }) => {
    // Hair and clothes may be called after the part that they hang on.
    if (!role) return { ...readName(name), word: undefined };
    const own = readName(role);
    const bones = own.word === 'thumb' ? THUMB_BONES : FINGER_BONES;
    return { ...own, number: bones.findIndex((bone) => role.endsWith(bone)) + 1 };
  });
}

const FINGER_BONES = ['Proximal', 'Intermediate', 'Distal'];
const THUMB_BONES = ['Metacarpal', 'Proximal', 'Distal'];

function last(names: readonly NameParts[], word: Word): number | undefined {
  const found = names.findLastIndex((n) => n.word === word && n.side === 'middle');
  return found >= 0 ? found : undefined;
}

function hasLimbs(single: ReadonlyMap<Role, number>): boolean {
  return LIMB_SIDES.every((side) =>
    (['arm', 'forearm', 'thigh', 'shin', 'foot'] as const).every((part) => single.has(`${side} ${part}`)),
  );
}
