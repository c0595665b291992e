/**
 * Which joints of two characters are compared, joint by joint:
 *
 *     1. one follows the other live    the pairs of its retargeting
 *     2. the same name and parent      as in takes of one skeleton (`joint-match.ts`)
 *     3. the same part of the body     as the retargeter finds it (`retarget/match.ts`), of the joints that are left
 *
 * Each joint has at most one partner, and the order of the two characters doesn't matter: of a trunk with four joints
 * and one with two, only the pairs that both directions find are used.
 */
import type { Character } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import { automaticPairs } from '../retarget/match.ts';
import { isSameSkeleton, type JointMatch, matchJoints } from './joint-match.ts';

/** The pairs of joints that are compared between two characters. */
export interface ComparedJoints extends JointMatch {
  /** Why each pair is compared: `same name`, `left forearm, by name`, `retargeted`. */
  readonly reasons: readonly string[];
  /** Whether both have the same joints. */
  readonly isSame: boolean;
}

const NONE: ComparedJoints = { first: [], second: [], onlyFirst: [], onlySecond: [], reasons: [], isSame: false };

/** Cached; without a skeleton on either side no joints. */
export function comparedJoints(a: Character, b: Character): ComparedJoints {
  if (!a.skeleton || !b.skeleton) return NONE;
  const byB = known.get(a.skeleton) ?? new WeakMap<Skeleton, Known>();
  known.set(a.skeleton, byB);
  const before = byB.get(b.skeleton);
  const pairs = drivenPairs(a, b);
  if (before && before.pairs === pairs.of && before.spaces[0] === a.space && before.spaces[1] === b.space) {
    return before.joints;
  }
  const joints = match(a.skeleton, b.skeleton, a.space, b.space, pairs.list());
  byB.set(b.skeleton, { joints, spaces: [a.space, b.space], pairs: pairs.of });
  return joints;
}

interface Known {
  readonly joints: ComparedJoints;
  readonly spaces: readonly [Space | undefined, Space | undefined];
  /** Pairs of the driver, by identity. */
  readonly pairs: unknown;
}
const known = new WeakMap<Skeleton, WeakMap<Skeleton, Known>>();

type Pair = readonly [a: number, b: number];

/** The pairs of a character that follows the other one. */
function drivenPairs(a: Character, b: Character): { readonly of: unknown; list(): readonly Pair[] } {
  if (a.driver && a.driver.sourceId === b.id && a.driver.source.skeleton === b.skeleton) {
    const { pairs } = a.driver;
    return { of: pairs, list: () => pairs.map(({ target, source }): Pair => [target, source]) };
  }
  if (b.driver && b.driver.sourceId === a.id && b.driver.source.skeleton === a.skeleton) {
    const { pairs } = b.driver;
    return { of: pairs, list: () => pairs.map(({ target, source }): Pair => [source, target]) };
  }
  return { of: undefined, list: () => [] };
}

function match(
  a: Skeleton,
  b: Skeleton,
  spaceA: Space | undefined,
  spaceB: Space | undefined,
  driven: readonly Pair[],
): ComparedJoints {
  const named = matchJoints(a, b);
  if (isSameSkeleton(named) && !driven.length) {
    return { ...named, reasons: named.first.map(() => SAME), isSame: true };
  }
  const partner = new Int32Array(a.joints.length).fill(-1);
  const reasons: string[] = [];
  const taken = new Uint8Array(b.joints.length);
  const add = (i: number, j: number, reason: string) => {
    if (partner[i] >= 0 || taken[j]) return;
    partner[i] = j;
    taken[j] = 1;
    reasons[i] = reason;
  };
  const parts = mutualPairs(a, b, spaceA, spaceB);
  const isPart = new Set(parts.map(({ pair: [i, j] }) => `${i} ${j}`));
  // Several joints of a trunk may follow one: its counterpart is compared with it.
  for (const [i, j] of driven) if (isPart.has(`${i} ${j}`)) add(i, j, RETARGETED);
  for (const [i, j] of driven) add(i, j, RETARGETED);
  if (!driven.length) {
    named.first.forEach((i, k) => {
      add(i, named.second[k], SAME);
    });
    for (const { pair, reason } of parts) add(...pair, reason);
  }
  const first = [...a.joints.keys()].filter((i) => partner[i] >= 0);
  return {
    first,
    second: first.map((i) => partner[i]),
    onlyFirst: [...a.joints.keys()].filter((i) => partner[i] < 0),
    onlySecond: [...b.joints.keys()].filter((j) => !taken[j]),
    reasons: first.map((i) => reasons[i]),
    isSame: isSameSkeleton(named),
  };
}

const SAME = 'same name';
const RETARGETED = 'retargeted';

/** Pairs that are found whichever of the two is the target. */
function mutualPairs(a: Skeleton, b: Skeleton, spaceA: Space | undefined, spaceB: Space | undefined) {
  const back = new Map(automaticPairs(a, b, spaceA, spaceB).map(({ target, source }) => [target, source]));
  return automaticPairs(b, a, spaceB, spaceA)
    .filter(({ target, source }) => back.get(source) === target)
    .map(({ target, source, reason }) => ({ pair: [target, source] as const, reason }));
}

/** Why a joint of one skeleton has no partner in the other, as a sentence without its full stop. */
export function whyLeftOut(
  own: Character,
  other: Character,
  joint: number,
  { first, second }: JointMatch,
  isFirst: boolean,
): string {
  const [here, there] = isFirst ? [first, second] : [second, first];
  const name = own.skeleton?.joints[joint]?.name ?? '';
  const same = other.skeleton?.joints.findIndex((j) => j.name === name) ?? -1;
  if (same < 0) return `${other.name} has no matching joint`;
  const taken = there.indexOf(same);
  if (taken < 0) return `${other.name} has a ${name} elsewhere in its hierarchy, as another body part`;
  const partner = own.skeleton?.joints[here[taken]]?.name ?? '';
  return `The ${name} of ${other.name} is compared with ${partner}`;
}
