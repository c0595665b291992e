/**
 * Recognises parts of a body by shape, for skeletons with meaningless names: two chains that hang down on either side
 * are legs, two that reach outwards above them are arms, and the top between those is the head.
 *
 *     Pairs of branches of one joint, of similar length (within a quarter) and on opposite sides:
 *     the pair that reaches lowest is the legs, the widest one that starts above it the arms.
 *
 * Left is +x, since characters in files face +z, or −y if z is up.
 */
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { distance, type RetargetBody } from './body.ts';

/** Joints, from the body outwards. */
export interface ShapeRoles {
  readonly hips: number;
  /** Thigh, shin, foot and possibly toe. */
  readonly legs: { readonly left: readonly number[]; readonly right: readonly number[] } | undefined;
  /** Possibly with a collar first. */
  readonly arms:
    | {
        readonly left: { readonly collar: number; readonly chain: readonly number[] };
        readonly right: { readonly collar: number; readonly chain: readonly number[] };
      }
    | undefined;
  /** Between hips and arms, from the bottom up. */
  readonly spine: readonly number[];
  readonly neck: readonly number[];
  readonly head: number;
}

interface Branch {
  readonly chain: readonly number[];
  readonly length: number;
  /** Average of its joints. */
  readonly x: number;
  readonly low: number;
  readonly high: number;
}

interface Pair {
  readonly at: number;
  readonly left: Branch;
  readonly right: Branch;
}

/** No body has more, and what follows takes time that grows with the square of their number. */
const MAX_JOINTS = 2000;

/** Undefined if there are no legs to be seen, or thousands of joints. */
export function rolesByShape({ joints }: Skeleton, rest: RetargetBody): ShapeRoles | undefined {
  if (joints.length > MAX_JOINTS) return undefined;
  const children: number[][] = joints.map(() => []);
  joints.forEach(({ parent }, j) => {
    if (parent >= 0) children[parent].push(j);
  });
  const reach = new Float64Array(joints.length);
  for (let j = joints.length - 1; j > 0; j--) {
    const p = joints[j].parent;
    reach[p] = Math.max(reach[p], reach[j] + distance(rest, j, p));
  }
  const branchOf = (first: number): Branch => {
    const chain = [first];
    for (let j = first; children[j].length > 0; ) {
      j = children[j].reduce((best, c) =>
        reach[c] + distance(rest, c, joints[c].parent) > reach[best] + distance(rest, best, joints[best].parent)
          ? c
          : best,
      );
      chain.push(j);
    }
    const heights = chain.map((j) => rest.points[3 * j + 1]);
    return {
      chain,
      length: reach[first] + distance(rest, first, joints[first].parent),
      x: chain.reduce((sum, j) => sum + rest.points[3 * j], 0) / chain.length,
      low: Math.min(...heights),
      high: Math.max(...heights),
    };
  };
  const pairs: Pair[] = [];
  joints.forEach((_, at) => {
    const branches = children[at].map(branchOf).filter(({ chain }) => chain.length >= 3);
    const x = rest.points[3 * at];
    for (const left of branches) {
      for (const right of branches) {
        if (!(left.x > x && right.x < x)) continue;
        const longer = Math.max(left.length, right.length);
        const isAlike = Math.min(left.length, right.length) > 0.75 * longer;
        if (isAlike && Math.abs(left.low - right.low) < 0.25 * longer) pairs.push({ at, left, right });
      }
    }
  });
  if (!pairs.length) return undefined;
  const low = ({ left, right }: Pair) => (left.low + right.low) / 2;
  const legs = pairs.reduce((a, b) => (low(b) < low(a) ? b : a));
  const width = ({ left, right }: Pair) => left.x - right.x;
  const above = pairs.filter((p) => p !== legs && p.at !== legs.at && rest.points[3 * p.at + 1] > low(legs));
  const arms = above.length ? above.reduce((a, b) => (width(b) > width(a) ? b : a)) : undefined;
  const spine: number[] = [];
  if (arms) for (let j = arms.at; j > legs.at; j = joints[j].parent) spine.unshift(j);
  const top = spine.at(-1) ?? legs.at;
  const others = children[top].filter(
    (c) => ![arms?.left, arms?.right, legs.left, legs.right].some((b) => b?.chain[0] === c),
  );
  const upward = others.map(branchOf).sort((a, b) => b.high - a.high)[0];
  const isHead = upward && upward.high > rest.points[3 * top + 1];
  const head = isHead ? headOf(upward.chain) : undefined;
  return {
    hips: legs.at,
    legs: { left: legOf(legs.left.chain, rest), right: legOf(legs.right.chain, rest) },
    arms: arms && { left: armOf(arms.left.chain, arms.at, rest), right: armOf(arms.right.chain, arms.at, rest) },
    spine,
    neck: head?.neck ?? [],
    head: head?.head ?? -1,
  };
}

/** The ankle is the first joint in the lowest quarter of the leg; the knee is the one nearest to half way. */
function legOf(chain: readonly number[], rest: RetargetBody): readonly number[] {
  const y = (j: number) => rest.points[3 * j + 1];
  const [top] = chain;
  const bottom = Math.min(...chain.map(y));
  const ankle = chain.findIndex((j, i) => i >= 2 && y(j) < bottom + 0.25 * (y(top) - bottom));
  if (ankle < 2) return chain.slice(0, 4);
  const half = (y(top) + y(chain[ankle])) / 2;
  const between = chain.slice(1, ankle);
  const knee = between.reduce((a, b) => (Math.abs(y(b) - half) < Math.abs(y(a) - half) ? b : a));
  return [top, knee, ...chain.slice(ankle, ankle + 2)];
}

/** A collar is a first joint near the middle, followed by three more. */
function armOf(chain: readonly number[], at: number, rest: RetargetBody) {
  const out = (j: number) => Math.abs(rest.points[3 * j] - rest.points[3 * at]);
  const hasCollar = chain.length >= 4 && out(chain[0]) < 0.6 * out(chain[1]);
  return { collar: hasCollar ? chain[0] : -1, chain: chain.slice(hasCollar ? 1 : 0).slice(0, 3) };
}

/** A joint at the end of a bone is not the head if there are others. */
function headOf(chain: readonly number[]) {
  const head = chain.length > 2 ? 1 : chain.length - 1;
  return { head: chain[head], neck: chain.slice(0, head) };
}
