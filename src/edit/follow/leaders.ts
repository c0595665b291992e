/**
 * Characters whose root follows a joint of another one (`Take.attached`): what they contain of it, and keeping that up
 * to date.
 *
 * A follower contains what moves its leaders, so that a pose depends on one character only. When a step changes a
 * leader, its followers are updated in the same step, so that undo reverts both. A leader that is removed, or loses the
 * joint, leaves them unchanged.
 */
import { dofCountOf } from '../../evaluate/pose.ts';
import { type Character, type Document, findCharacter, shownTake, type Unkeyed } from '../../model/document.ts';
import { newCharacter } from '../../model/new-character.ts';
import type { Attachment, Take } from '../../model/takes/take.ts';
import { sameValue } from '../delta.ts';
import { sameJoints } from '../pose/same-joints.ts';
import { provideFollow } from './code.ts';

/** Passes this code on to what changes documents, before a character follows another one. */
export function provideLeaders(): void {
  provideFollow({ leaders: followLeaders });
}

/** Ids of the characters that any of its takes follows. */
function leaderIds({ takes }: Pick<Character, 'takes'>): readonly string[] {
  return [...new Set(takes.flatMap(({ attached }) => attached?.list.map(({ leaderId }) => leaderId) ?? []))];
}

/** The characters that none of the others follows: files of a leader may be given only for what follows it. */
export function notLeading(characters: readonly Character[]): readonly Character[] {
  const leading = new Set(characters.flatMap(leaderIds));
  return characters.filter(({ id }) => !leading.has(id));
}

/** Whether a character follows another one, or one that does, or is retargeted from such. */
export function follows(document: Document, follower: Character, leaderId: string): boolean {
  const seen = new Set<string>();
  const reaches = (character: Character | undefined): boolean =>
    character !== undefined &&
    [...leaderIds(character), ...(character.driver ? [character.driver.sourceId] : [])].some((id) => {
      if (id === leaderId) return true;
      if (seen.has(id)) return false;
      seen.add(id);
      return reaches(findCharacter(document, id));
    });
  return reaches(follower);
}

/**
 * A leader with only what moves it, at times of a follower's takes; the same object that the follower has if nothing
 * differs.
 */
export function leaderOf(leader: Character, follower: Character): Character {
  const known = follower.leaders?.find(({ id }) => id === leader.id);
  const now = leaderMade(leader, follower.timeOffsetSeconds);
  const made = known?.unkeyed && sameValue(now.unkeyed, known.unkeyed) ? { ...now, unkeyed: known.unkeyed } : now;
  return known && haveSame([...KEPT, ...PASSING], made, known) ? known : made;
}

function leaderMade(leader: Character, offset: number): Character {
  const { id, name, skeleton, pose, clampsToLimits, placements, space, driver, limbs, leaders } = leader;
  const take = shownTake(leader);
  const { parts: _none, ...bare } = newCharacter(id, name);
  return {
    ...bare,
    ...{ pose, clampsToLimits, placements: placements.slice(0, 1) },
    ...(take && { takes: [take], shownTake: 0 }),
    timeOffsetSeconds: leader.timeOffsetSeconds - offset,
    ...(skeleton && { skeleton }),
    ...(space && { space }),
    ...(driver && { driver }),
    ...(limbs && { limbs }),
    ...(leaders && { leaders }),
    ...unkeyedOf(leader, offset),
  };
}

/** Without those of morphs, which it lacks: those of goals come after them. */
function unkeyedOf(leader: Character, offset: number): { readonly unkeyed?: Unkeyed } {
  const { unkeyed, morphs } = leader;
  if (!unkeyed) return {};
  const end = dofCountOf(leader);
  const kept = unkeyed.dofs.flatMap((dof, i) => (dof < end - morphs.length || dof >= end ? [i] : []));
  const dofs = kept.map((i) => unkeyed.dofs[i] - (unkeyed.dofs[i] < end ? 0 : morphs.length));
  const values = kept.map((i) => unkeyed.values[i]);
  return { unkeyed: { timeSeconds: unkeyed.timeSeconds + offset, dofs, values } };
}

/**
 * The character with other attachments of a take, and the leaders that its takes then need.
 * @param leaders those that are new or have changed, as `leaderOf` makes them
 * @param index of the take
 */
export function withAttached(
  character: Character,
  list: readonly Attachment[],
  leaders: readonly Character[],
  index = character.shownTake,
): Character {
  const takes = character.takes.map((take, i) => (i === index ? takeWith(take, list) : take));
  return withLeaders({ ...character, takes }, [...leaders, ...(character.leaders ?? [])]);
}

/** @param known the first of an id counts */
function withLeaders(character: Character, known: readonly Character[]): Character {
  const { leaders: _before, ...rest } = character;
  const leaders = leaderIds(character).flatMap((id) => known.find((leader) => leader.id === id) ?? []);
  return leaders.length > 0 ? { ...rest, leaders } : rest;
}

function takeWith(take: Take, list: readonly Attachment[]): Take {
  const { attached, ...rest } = take;
  if (list.length === 0) return rest;
  return { ...rest, attached: { ...attached, list: [...list].sort((a, b) => a.span[0] - b.span[0]) } };
}

/** The document with all followers up to date; the same object if none changed. */
export function followLeaders(before: Document, after: Document): Document {
  if (before === after || !after.characters.some(({ leaders }) => leaders)) return after;
  const done = new Map<string, Character>();
  const upToDate = (id: string): Character | undefined => {
    const known = done.get(id) ?? findCharacter(after, id);
    if (!known || done.has(id)) return known;
    // Its leaders come first.
    done.set(id, known);
    const made = following(known, before, upToDate);
    done.set(id, made);
    return made;
  };
  const characters = after.characters.map((character) => upToDate(character.id) ?? character);
  return characters.every((character, i) => character === after.characters[i]) ? after : { ...after, characters };
}

function following(character: Character, before: Document, upToDate: (id: string) => Character | undefined): Character {
  const ids = leaderIds(character);
  const { leaders: known = [] } = character;
  if (ids.length === 0 && known.length === 0) return character;
  const joints = new Map<string, ArrayLike<number>>();
  const changed = new Set<string>();
  const leaders = ids.flatMap((id): Character | readonly Character[] => {
    const was = known.find((leader) => leader.id === id);
    const now = upToDate(id);
    if (!now?.skeleton) return was ?? [];
    if (!was) return leaderOf(now, character);
    const isSameTime = was.timeOffsetSeconds === now.timeOffsetSeconds - character.timeOffsetSeconds;
    // Only what this step has changed, since an undone document contains copies.
    if (isSameTime && isSameLeader(now, findCharacter(before, id))) return was;
    const made = leaderOf(now, character);
    if (made === was) return was;
    if (was.skeleton && was.skeleton !== now.skeleton) {
      const to = sameJoints(was.skeleton, now.skeleton);
      if (attachmentsTo(character, id).some(({ joint }) => !(to[joint] >= 0))) return was;
      joints.set(id, to);
    }
    if (!haveSame(KEPT, made, was)) changed.add(id);
    return made;
  });
  if (leaders.length === known.length && leaders.every((leader, i) => leader === known[i])) return character;
  // The plain files of these takes are others now.
  const takes = character.takes.map((take) => {
    const { attached } = take;
    if (!attached?.list.some(({ leaderId }) => changed.has(leaderId))) return take;
    const list = attached.list.map((one) => ({ ...one, joint: joints.get(one.leaderId)?.[one.joint] ?? one.joint }));
    return { ...take, attached: { ...attached, list } };
  });
  return withLeaders({ ...character, takes }, leaders);
}

function attachmentsTo({ takes }: Character, id: string): readonly Attachment[] {
  return takes.flatMap(({ attached }) => attached?.list.filter(({ leaderId }) => leaderId === id) ?? []);
}

/** The fields of a leader that it has in files and exports, and others. */
const KEPT = ['name', 'skeleton', 'pose', 'clampsToLimits', 'timeOffsetSeconds', 'space', 'driver', 'limbs'] as const;
const PASSING = ['unkeyed', 'leaders'] as const;

function isSameLeader(a: Character, b: Character | undefined): boolean {
  return a === b || (b !== undefined && haveSame([...KEPT, ...PASSING], a, b));
}

function haveSame(keys: readonly (keyof Character)[], a: Character, b: Character): boolean {
  return shownTake(a) === shownTake(b) && a.placements[0] === b.placements[0] && keys.every((key) => a[key] === b[key]);
}
