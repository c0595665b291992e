/**
 * `couple NAME JOINT.DOF gain offset` in a `.skel`: JOINT is `#index` or a unique joint name, split from the DOF at the
 * last dot. Joints may refer to later ones, so names are resolved at the end of the tree.
 */

import { oneToken } from '../../model/names/written-names.ts';
import { couplesOf } from '../../model/skeleton/couples.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { isJointIndex, jointReferences } from '../../model/skeleton/joint-reference.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Couple, Joint } from '../../model/skeleton/skeleton.ts';
import { type GrammarPart, number } from '../grammar.ts';
import type { Keywords, Mark, Tokens } from '../tokens.ts';

/** A link as written. */
export interface OpenCouple {
  /** The joint that contains it. */
  readonly owner: number;
  readonly dof: string;
  readonly dofPlace: Mark;
  /** As written, up to the last dot. */
  readonly target: string;
  readonly follows: string;
  readonly place: Mark;
  readonly gain: number;
  readonly offset: number;
}

/** At the keyword. Undefined if something is missing, which is an error. */
export function* couple(t: Tokens, owner: number, keywords: Keywords): GrammarPart<OpenCouple | undefined> {
  const dof = yield* name(t, 'the name of a DOF after couple', keywords);
  if (dof === undefined) return undefined;
  const dofPlace = t.mark();
  const full = yield* name(t, `the JOINT.DOF that ${dof} follows`, keywords);
  if (full === undefined) return undefined;
  const place = t.mark();
  const dot = full.lastIndexOf('.');
  if (dot < 0) t.error('couple-target', `Expected the JOINT.DOF that ${dof} follows, found ${t.found()}.`);
  const gain = yield* number(t, `the gain of ${dof}`, keywords);
  if (gain === undefined) return undefined;
  const offset = yield* number(t, `the offset of ${dof}`, keywords);
  if (offset === undefined || dot < 0) return undefined;
  const follows = full.slice(dot + 1).toLowerCase();
  return { owner, dof: dof.toLowerCase(), dofPlace, target: full.slice(0, dot), follows, place, gain, offset };
}

/** A word that is not a number. */
function* name(t: Tokens, what: string, keywords: Keywords): GrammarPart<string | undefined> {
  yield* t.next();
  if (t.kind === 'word' && Number.isNaN(t.value()) && !keywords.has(t.keyword())) return t.text();
  t.error('name-expected', `Expected ${what}, found ${t.found()}.`);
  if (t.kind !== 'word' || t.startsLine || keywords.has(t.keyword())) t.again();
  else yield* t.skipUnknown();
  return undefined;
}

/** The joints with their links: resolves names, rejects cycles. */
export function resolveCouples(t: Tokens, joints: readonly Joint[], couples: readonly OpenCouple[]): readonly Joint[] {
  if (couples.length === 0) return joints;
  const byName = new Map<string, number[]>();
  joints.forEach(({ name }, index) => {
    const own = byName.get(name);
    if (own) own.push(index);
    else byName.set(name, [index]);
  });
  // One map by joint and DOF: thousands of maps would take more than the joints.
  const found = new Map<string, { readonly couple: Couple; readonly place: Mark }>();
  const owners = new Set<number>();
  for (const { owner, dof, dofPlace, target, follows, place, gain, offset } of couples) {
    if (!hasDof(t, joints, owner, dof, dofPlace)) continue;
    const joint = jointNamed(t, joints, byName, target, place);
    if (joint === undefined || !hasDof(t, joints, joint, follows, place)) continue;
    const key = `${owner} ${dof}`;
    if (found.has(key)) {
      const message = `${dof} of ${called(joints, owner)} is linked a second time.`;
      t.report.warn('repeated', message, t.placeOf(dofPlace, 'warning'), 'the later one is used');
    }
    owners.add(owner);
    found.set(key, { couple: { dof, joint, follows, gain, offset }, place: dofPlace });
  }
  const coupled = joints.map((joint, index) => {
    if (!owners.has(index)) return joint;
    const inOrder = dofsOf(joint.motion).flatMap(({ name }) => found.get(`${index} ${name}`)?.couple ?? []);
    return { ...joint, couples: inOrder };
  });
  const skeleton = { name: '', joints: coupled };
  const first = firstDofs(skeleton);
  for (const { dof } of couplesOf(skeleton).circular) {
    const joint = first.findLastIndex((start) => start <= dof);
    const own = dofsOf(joints[joint].motion)[dof - first[joint]].name;
    const place = found.get(`${joint} ${own}`)?.place;
    const message = `${own} of ${called(joints, joint)} ends up following itself.`;
    if (place) t.report.error('couple-cycle', message, t.placeOf(place, 'error'));
  }
  return coupled;
}

function hasDof(t: Tokens, joints: readonly Joint[], joint: number, dof: string, place: Mark): boolean {
  const names = dofsOf(joints[joint].motion).map(({ name }) => name);
  if (names.includes(dof)) return true;
  const message = `Expected a DOF of ${called(joints, joint)} (${names.join(' ') || 'it has none'}), found ${dof}.`;
  t.report.error('dof-unknown', message, t.placeOf(place, 'error'));
  return false;
}

/** `#index`, or a unique name. */
function jointNamed(
  t: Tokens,
  joints: readonly Joint[],
  byName: ReadonlyMap<string, readonly number[]>,
  target: string,
  place: Mark,
): number | undefined {
  if (isJointIndex(target)) {
    const index = Number(target.slice(1));
    if (index < joints.length) return index;
    const message = `Expected a joint of this skeleton, #0 to #${joints.length - 1}, found ${target}.`;
    t.report.error('joint-unknown', message, t.placeOf(place, 'error'));
    return undefined;
  }
  const fits = byName.get(target) ?? [];
  if (fits.length === 1) return fits[0];
  const message =
    fits.length === 0
      ? `Expected the name of a joint to follow, found "${target}".`
      : `Expected a unique joint name or #index, found "${target}", which ${fits.length} joints have: #${fits.join(', #')}.`;
  t.report.error(fits.length ? 'joint-ambiguous' : 'joint-unknown', message, t.placeOf(place, 'error'));
  return undefined;
}

function called(joints: readonly Joint[], index: number): string {
  return joints[index].name || `joint #${index}`;
}

/** How links refer to each joint: by its written name if that is unique; else `#index`. */
export function coupleTargets(joints: readonly Joint[]): readonly string[] {
  return jointReferences(joints.map(({ name }) => ({ name: oneToken(name) })));
}
