/**
 * The joint types of `.skel`: the one table that reading and writing go by. Another type is another entry (and a
 * motion in `model/skeleton.ts`).
 *
 * A type's own tokens change its motion; what every joint has (offset, box, limits, pose) is in `read.ts`.
 */
import { DEFAULT_MOTION, EULER_ORDERS, type EulerOrder, type Motion } from '../../model/skeleton.ts';
import type { Part } from '../grammar.ts';
import type { Keywords, Tokens } from '../tokens.ts';

export interface JointType {
  /** `balljoint`. */
  readonly keyword: string;
  readonly kind: Motion['kind'];
  /** What it is without any token of its own. */
  readonly motion: Motion;
  /** Its own tokens, each reading its value. */
  readonly tokens: Readonly<Record<string, (t: Tokens, motion: Motion, keywords: Keywords) => Part<Motion>>>;
  /** The lines that bring a motion back; none for the default. */
  lines(motion: Motion): readonly string[];
}

export const JOINT_TYPES: readonly JointType[] = [
  {
    keyword: 'balljoint',
    kind: 'ball',
    motion: DEFAULT_MOTION,
    tokens: {
      *order(t, motion, keywords) {
        const order = yield* eulerOrder(t, keywords);
        return motion.kind === 'ball' && order ? { ...motion, order } : motion;
      },
    },
    lines: (motion) => (motion.kind !== 'ball' || motion.order === 'xyz' ? [] : [`order ${motion.order}`]),
  },
];

/** Three letters, the axis that is turned about first standing first. */
function* eulerOrder(t: Tokens, keywords: Keywords): Part<EulerOrder | undefined> {
  yield* t.next();
  const word = t.keyword();
  const order = EULER_ORDERS.find((o) => o === word);
  if (order) return order;
  t.error('order-unknown', `Expected one of ${EULER_ORDERS.join(', ')}, found ${t.found()}.`);
  if (t.kind !== 'word' || t.startsLine || keywords.has(word)) t.again();
  return undefined;
}

export function jointTypeOf(keyword: string): JointType | undefined {
  return JOINT_TYPES.find((type) => type.keyword === keyword);
}

export function jointTypeOfMotion(motion: Motion): JointType {
  const type = JOINT_TYPES.find(({ kind }) => kind === motion.kind);
  if (!type) throw new Error(`No joint type of .skel is for ${motion.kind}: add it to JOINT_TYPES.`);
  return type;
}

/** The classic tokens for the limits of a ball joint's DOFs; every other DOF's are `limit NAME min max`. */
export const LIMIT_TOKENS: Readonly<Record<string, string>> = { rx: 'rotxlimit', ry: 'rotylimit', rz: 'rotzlimit' };
