/**
 * The joint types of `.skel`: the one table that reading and writing go by. Another type is another entry (and a
 * motion in `model/skeleton.ts`).
 *
 * A type's own tokens change its motion; what every joint has (offset, box, limits, pose) is in `read.ts`.
 */
import type { Vec3 } from '../../math/vec3.ts';
import {
  AXIS_PAIRS,
  COMPOUND_DOFS,
  type CompoundDof,
  EULER_ORDERS,
  type Motion,
  SCALE_MODES,
  type ScaleMode,
} from '../../model/skeleton.ts';
import type { Part } from '../grammar.ts';
import type { Keywords, Tokens } from '../tokens.ts';
import { listOfWords, numberToken, oneOfWords, vectorToken } from './own-tokens.ts';

/** A token of a type's own. */
export interface OwnToken<M> {
  /** The keyword is at hand: reads its value. What it gives is what changes of the motion; nothing after an error. */
  read(t: Tokens, keywords: Keywords): Part<Partial<M>>;
  /** The value as it is written; undefined where it is the default. */
  written(motion: M, numbers: (values: readonly number[]) => string): string | undefined;
}

export interface JointType {
  /** `balljoint`. */
  readonly keyword: string;
  /** What it is without any token of its own. */
  readonly motion: Motion;
  readonly tokens: ReadonlyMap<string, OwnToken<Motion>>;
}

/** What can be written: BVH's joints become others first (`model/skel-motion.ts`). */
type SkelKind = Exclude<Motion['kind'], 'bvh'>;
type MotionOf<K extends SkelKind> = Extract<Motion, { readonly kind: K }>;

const X: Vec3 = [1, 0, 0];

const axis: OwnToken<{ readonly axis: Vec3 }> = {
  *read(t, keywords) {
    const place = t.mark();
    const found = yield* vectorToken(t, 'axis', keywords);
    if (!found) return {};
    if (found.some((part) => part !== 0)) return { axis: found };
    t.report.error('axis-zero', 'Expected an axis of any length but zero, found 0 0 0.', t.placeOf(place, 'error'));
    return {};
  },
  written: (motion, numbers) => (motion.axis.every((v, i) => Object.is(v, X[i])) ? undefined : numbers(motion.axis)),
};

/** One word out of a few, the first of which is the default. */
function order<W extends string>(words: readonly W[]): OwnToken<{ readonly order: W }> {
  return {
    *read(t, keywords) {
      const word = yield* oneOfWords(t, 'order', words, keywords);
      return word === undefined ? {} : { order: word };
    },
    written: (motion) => (motion.order === words[0] ? undefined : motion.order),
  };
}

const mode: OwnToken<{ readonly mode: ScaleMode }> = {
  *read(t, keywords) {
    const word = yield* oneOfWords(t, 'mode', SCALE_MODES, keywords);
    return word === undefined ? {} : { mode: word };
  },
  written: (motion) => (motion.mode === 'uniform' ? undefined : motion.mode),
};

const pitch: OwnToken<{ readonly pitch: number }> = {
  *read(t, keywords) {
    const found = yield* numberToken(t, 'pitch', keywords);
    return found === undefined ? {} : { pitch: found };
  },
  written: (motion, numbers) => (Object.is(motion.pitch, 0) ? undefined : numbers([motion.pitch])),
};

const dofs: OwnToken<{ readonly dofs: readonly CompoundDof[] }> = {
  *read(t, keywords) {
    return { dofs: yield* listOfWords(t, 'dofs', COMPOUND_DOFS, keywords) };
  },
  written: (motion) => (motion.dofs.length ? motion.dofs.join(' ') : undefined),
};

const TYPES: { readonly [K in SkelKind]: JointType } = {
  ball: type<'ball'>('balljoint', { kind: 'ball', order: 'xyz' }, { order: order(EULER_ORDERS) }),
  hinge: type<'hinge'>('hingejoint', { kind: 'hinge', axis: X }, { axis }),
  universal: type<'universal'>('universaljoint', { kind: 'universal', order: 'xy' }, { order: order(AXIS_PAIRS) }),
  quaternion: type<'quaternion'>('quaternionjoint', { kind: 'quaternion' }, {}),
  prismatic: type<'prismatic'>('prismaticjoint', { kind: 'prismatic', axis: X }, { axis }),
  translational: type<'translational'>('translationaljoint', { kind: 'translational' }, {}),
  free: type<'free'>('freejoint', { kind: 'free', order: 'xyz' }, { order: order(EULER_ORDERS) }),
  screw: type<'screw'>('screwjoint', { kind: 'screw', axis: X, pitch: 0 }, { axis, pitch }),
  scale: type<'scale'>('scalejoint', { kind: 'scale', mode: 'uniform', axis: X }, { mode, axis }),
  shear: type<'shear'>('shearjoint', { kind: 'shear' }, {}),
  fixed: type<'fixed'>('fixedjoint', { kind: 'fixed' }, {}),
  compound: type<'compound'>('compoundjoint', { kind: 'compound', dofs: [] }, { dofs }),
};

function type<K extends SkelKind>(
  keyword: string,
  motion: MotionOf<K>,
  tokens: Readonly<Record<string, OwnToken<MotionOf<K>>>>,
): JointType {
  // A type's tokens get motions of its kind only: the table looks them up by it.
  const own = new Map(Object.entries(tokens)) as ReadonlyMap<string, OwnToken<Motion>>;
  return { keyword, motion, tokens: own };
}

export const JOINT_TYPES: readonly JointType[] = Object.values(TYPES);

const BY_KEYWORD = new Map(JOINT_TYPES.map((one) => [one.keyword, one]));

export function jointTypeOf(keyword: string): JointType | undefined {
  return BY_KEYWORD.get(keyword);
}

/** Throws for a joint of BVH, which no `.skel` has: `model/skel-motion.ts` makes another of it. */
export function jointTypeOfMotion(motion: Motion): JointType {
  if (motion.kind === 'bvh') throw new Error('A joint of BVH has to be converted before it is written to .skel.');
  return TYPES[motion.kind];
}

/** Reads one of a type's own tokens, whose keyword is at hand, into a motion of that type. */
export function* readOwn(t: Tokens, token: OwnToken<Motion>, motion: Motion, keywords: Keywords): Part<Motion> {
  // Of the same kind as before: a token changes what its own type has.
  return { ...motion, ...(yield* token.read(t, keywords)) } as Motion;
}

/** What a joint is called for people and scripts: its keyword, or `bvh`. */
export function typeName(motion: Motion): string {
  return motion.kind === 'bvh' ? 'bvh' : TYPES[motion.kind].keyword;
}

/** The lines of a type's own tokens that bring a motion back; none for the default. */
export function ownLines(motion: Motion, numbers: (values: readonly number[]) => string): readonly string[] {
  return [...jointTypeOfMotion(motion).tokens].flatMap(([token, own]) => {
    const value = own.written(motion, numbers);
    return value === undefined ? [] : [`${token} ${value}`];
  });
}

/** The classic tokens for the limits of a ball joint's DOFs; every other DOF's are `limit NAME min max`. */
export const LIMIT_TOKENS: Readonly<Record<string, string>> = { rx: 'rotxlimit', ry: 'rotylimit', rz: 'rotzlimit' };
