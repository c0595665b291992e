/**
 * Which joint of one skeleton drives which joint of another: the same part of the body, recognised by name or by shape
 * (`roles.ts`); trunks with different numbers of joints in proportion; otherwise joints with the same name. In a copy
 * of one skeleton every joint drives itself.
 */

import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import type { JointPair } from '../../model/takes/retarget.ts';
import { FINGERS } from './fingers.ts';
import type { NameParts } from './names.ts';
import { type Roles, rolesOf } from './roles.ts';

/** A pair of joints, with how sure it is. */
export interface MatchedPair extends JointPair {
  /** 1 for the same name, down to 0.5 if only the shape matches. */
  readonly confidence: number;
  /** `left thigh, by name` */
  readonly reason: string;
}

const SAME_NAME = 1;
const BY_NAME = 0.9;
const IN_PROPORTION = 0.75;
const BY_SHAPE = 0.5;

/** In the order of the target's joints, each at most once. Joints without a pair stay at rest. */
export function automaticPairs(
  source: Skeleton,
  target: Skeleton,
  sourceSpace?: Space,
  targetSpace?: Space,
): readonly MatchedPair[] {
  if (isCopy(source, target)) {
    return target.joints.map((_, j) => ({ target: j, source: j, confidence: SAME_NAME, reason: 'same skeleton' }));
  }
  const from = rolesOf(source, sourceSpace);
  const onto = rolesOf(target, targetSpace);
  const matches = new Map<number, MatchedPair>();
  const add = (t: number, s: number, confidence: number, reason: string) => {
    if (!matches.has(t)) matches.set(t, { target: t, source: s, confidence, reason });
  };
  const isShape = (t: number, s: number) => onto.byShape.has(t) || from.byShape.has(s);
  for (const [role, t] of onto.single) {
    const s = from.single.get(role);
    if (s === undefined) continue;
    if (isShape(t, s)) add(t, s, BY_SHAPE, `${role}, by shape`);
    else if (sameWords(onto.names[t], from.names[s])) add(t, s, SAME_NAME, `${role}, same name`);
    else add(t, s, BY_NAME, `${role}, by name`);
  }
  inProportion(onto.spine, from.spine, 'spine');
  inProportion(onto.neck, from.neck, 'neck');
  // No substitute for a neck that the other skeleton lacks.
  const used = new Set([...matches.values()].map((m) => m.source));
  onto.names.forEach((name, t) => {
    if (matches.has(t) || !FINGERS.some((finger) => finger === name.word)) return;
    const s = from.names.findIndex(
      (n, j) => !used.has(j) && n.word === name.word && n.side === name.side && n.number === name.number,
    );
    if (s < 0) return;
    used.add(s);
    add(t, s, BY_NAME, `${name.side} ${name.word} ${name.number || ''}`.trim());
  });
  const taken = roleJoints(onto);
  onto.names.forEach((name, t) => {
    if (matches.has(t) || taken.has(t) || name.plain.split(' ').length < 2 || !/[a-z]{2}/.test(name.plain)) return;
    const s = from.names.findIndex((n, j) => !used.has(j) && n.plain === name.plain);
    // A joint called `root` above everything stays; the hips do its work.
    if (s < 0 || name.word === 'hips') return;
    used.add(s);
    add(t, s, SAME_NAME, 'same name');
  });
  return [...matches.values()].sort((a, b) => a.target - b.target);

  function inProportion(targets: readonly number[], sources: readonly number[], part: string): void {
    if (!sources.length) return;
    targets.forEach((t, k) => {
      // The last one carries what follows, so it is paired with the last.
      const at = targets.length > 1 ? k / (targets.length - 1) : 1;
      const s = sources[Math.round(at * (sources.length - 1))];
      const count = `${k + 1} of ${targets.length}`;
      if (isShape(t, s)) add(t, s, BY_SHAPE, `${part} ${count}, by shape`);
      else if (targets.length === sources.length) add(t, s, BY_NAME, `${part} ${count}, by name`);
      else add(t, s, IN_PROPORTION, `${part} ${count}, by proportion`);
    });
  }
}

/** Whether joint by joint names and parents are the same. */
function isCopy(a: Skeleton, b: Skeleton): boolean {
  return (
    a.joints.length === b.joints.length &&
    a.joints.every(({ name, parent }, j) => name === b.joints[j].name && parent === b.joints[j].parent)
  );
}

function sameWords(a: NameParts, b: NameParts): boolean {
  return a.plain === b.plain;
}

function roleJoints(roles: Roles): ReadonlySet<number> {
  return new Set([...roles.single.values(), ...roles.spine, ...roles.neck]);
}
