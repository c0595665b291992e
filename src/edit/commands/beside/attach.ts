/**
 * Attaching a character: its root follows a joint of another one in a span of its take (`evaluate/attached.ts`). Spans
 * are in seconds of the take, as in its `.attach.json`.
 */
import { followingRoot, jointInScene, offsetBetween } from '../../../evaluate/attached.ts';
import { inTakes } from '../../../evaluate/in-takes.ts';
import { provideLayers } from '../../../evaluate/layers.ts';
import { dofCountOf, poseAt } from '../../../evaluate/pose.ts';
import { NO_TRAVEL, placementMatrix } from '../../../evaluate/space/placements.ts';
import { invertAffine, multiplyAffine } from '../../../math/mat4.ts';
import { type Character, type Document, type Placement, shownTake } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { withMotions } from '../../../model/takes/layers.ts';
import { type Attachment, type Channel, restChannel, type Take } from '../../../model/takes/take.ts';
import { indexIn } from '../../arguments.ts';
import { requireKeyable } from '../../channel-edits.ts';
import { changeCharacter, requireCharacter } from '../../characters.ts';
import { command } from '../../command.ts';
import { CommandError } from '../../command-error.ts';
import { SHORT_NAME } from '../../cut-name.ts';
import { sameValue } from '../../delta.ts';
import { follows, leaderOf, provideLeaders, withAttached } from '../../follow/leaders.ts';
import { steppedTo } from '../../keys/stepped-to.ts';
import { layerValues } from '../../layers/layer-values.ts';
import { refuseMoved } from '../../refuse-moved.ts';
import { index, optional, text } from '../../schema/shape.ts';
import { CHARACTER, NOW, range } from '../../schema/shared-shapes.ts';
import { characterIn, jointIn } from '../../step-names.ts';
import { withChannels, withTake } from '../../takes.ts';
import { unkeyedAt, withoutUnkeyed, withUnkeyed } from '../../unkeyed.ts';

/**
 * Attaches the root to a joint of another character, where it is when the span begins: nothing jumps. A character
 * without a take gets one. An attachment that has begun before ends there. Characters at different places of the scene
 * are put at the place of the leader, and the keys of the root changed accordingly, so that nothing moves.
 */
export const addAttachment = command({
  id: 'attach.add',
  args: {
    ...CHARACTER,
    /** The character that is followed. */
    leaderId: text,
    /** Index among the leader's joints. */
    joint: index,
    /** Seconds of the take: from the first up to (excluding) the second. */
    span: range,
  },
  label: (document, { characterId, leaderId, joint }) =>
    `Attach ${characterIn(document, characterId, SHORT_NAME)} to ${jointIn(requireCharacter(document, leaderId), joint, SHORT_NAME)}`,
  run(document, { characterId, leaderId, joint, span }) {
    provideLayers();
    provideLeaders();
    const leader = requireCharacter(document, leaderId);
    refuseEmpty(span);
    return changeCharacter(document, characterId, (follower) => {
      refuseLeader(document, follower, leader);
      indexIn(joint, 0, leader.skeleton?.joints.length ?? 0, `joint of ${leader.name}`);
      const taken = withChannels(follower, leaderRange(leader, follower));
      const known = shownTake(taken)?.attached?.list ?? [];
      const list = known.flatMap((one) => before(span, one, taken));
      const placed = atPlaceOf(taken, leader);
      const leaders = [leaderOf(leader, placed)];
      const one = startingWhere(placed, { leaderId, joint, span, offset: NO_OFFSET }, leaders);
      return withAttached(placed, [...list, one], leaders);
    });
  },
});

/** Changes the span of an attachment. If it begins at another time, it begins where the root is then. */
export const changeAttachment = command({
  id: 'attach.change',
  args: {
    ...CHARACTER,
    /** Among the attachments of the shown take. */
    index,
    span: range,
  },
  label: (document, { characterId }) => `Change attachment of ${characterIn(document, characterId)}`,
  run: (document, { characterId, index: at, span }) =>
    changed(document, characterId, (character, list) => {
      const one = list[indexIn(at, 0, list.length, 'attachment')];
      refuseEmpty(span);
      if (sameValue(one.span, span)) return character;
      const others = list.toSpliced(at, 1);
      const next = others.find((other) => other.span[0] < span[1] && other.span[1] > span[0]);
      if (next) throw new CommandError(`It would overlap the attachment from ${next.span[0]} to ${next.span[1]} s.`);
      const moved = { ...one, span };
      if (span[0] === one.span[0]) return withAttached(character, list.with(at, moved), []);
      const free = withAttached(character, others, []);
      return withAttached(character, [...others, startingWhere(free, moved, character.leaders ?? [])], []);
    }),
});

/** Removes an attachment: the root has its own motion there. */
export const removeAttachment = command({
  id: 'attach.remove',
  args: {
    ...CHARACTER,
    /** Among the attachments of the shown take. */
    index,
  },
  label: (document, { characterId }) => `Detach ${characterIn(document, characterId)}`,
  run: (document, { characterId, index: at }) =>
    changed(document, characterId, (character, list) => {
      indexIn(at, 0, list.length, 'attachment');
      return withAttached(character, list.toSpliced(at, 1), []);
    }),
});

/**
 * Puts the character down at a time: it is attached no longer, and its root is keyed where it is, as a step, so that
 * nothing jumps; later keys stay. At the start of the attachment, that is removed; after its end it is refused.
 */
export const putDown = command({
  id: 'attach.putDown',
  args: {
    ...NOW,
    /** Among the attachments of the shown take; default: the one at that time, else the last one before it. */
    index: optional(index),
  },
  label: (document, { characterId }) => `Put down ${characterIn(document, characterId)}`,
  run: (document, { characterId, timeSeconds, index: at }) =>
    changed(document, characterId, (character, list) => {
      const time = timeSeconds + character.timeOffsetSeconds;
      const found = at ?? list.findLastIndex(({ span }) => span[0] <= time);
      if (found < 0) throw new CommandError(`${character.name} is not attached at that time.`);
      const one = list[indexIn(found, 0, list.length, 'attachment')];
      const [start, end] = one.span;
      // At its very end it is let go anyway, and is keyed where it was.
      if (time < start || time > end || time === list[found + 1]?.span[0])
        throw new CommandError(
          `${character.name} is attached to ${leadingJoint(character, one)} from ${start} to ${end} s only. Put it down in between.`,
        );
      if (time === start) return withAttached(character, list.toSpliced(found, 1), []);
      const held = withAttached(character, [{ ...one, span: [start, Number.POSITIVE_INFINITY] }], []);
      const left = list.with(found, { ...one, span: [start, time] });
      return keyedRoot(time < end ? withAttached(character, left, []) : character, held, timeSeconds);
    }),
});

const NO_OFFSET = { position: [0, 0, 0], rotation: [0, 0, 0] } as const;

function changed(
  document: Document,
  characterId: string,
  change: (character: Character, list: readonly Attachment[]) => Character,
): Document {
  provideLayers();
  provideLeaders();
  return changeCharacter(document, characterId, (character) => {
    refuseMoved(character);
    const list = shownTake(character)?.attached?.list ?? [];
    if (list.length === 0) throw new CommandError(`${character.name} is not attached in its take.`);
    return change(character, list);
  });
}

/** `hand_r of Walker`. */
function leadingJoint({ leaders }: Character, { leaderId, joint }: Attachment): string {
  const leader = leaders?.find(({ id }) => id === leaderId);
  return `${jointName(leader?.skeleton, joint)} of ${leader?.name ?? 'a character'}`;
}

function refuseEmpty([start, end]: readonly [number, number]): void {
  if (!(start < end)) throw new CommandError(`The attachment must begin before it ends, found ${start} to ${end} s.`);
}

function refuseLeader(document: Document, follower: Character, leader: Character): void {
  refuseMoved(follower);
  if (follower === leader) throw new CommandError(`${follower.name} can’t be attached to itself.`);
  if (!leader.skeleton) throw new CommandError(`${leader.name} has no skeleton, so there is no joint to follow.`);
  if (follows(document, leader, follower.id)) {
    throw new CommandError(
      `${follower.name} can’t be attached to ${leader.name}, which follows ${follower.name} itself. Detach ${leader.name} first.`,
    );
  }
  if (follower.skeleton && !followingRoot(follower.skeleton)) {
    throw new CommandError(
      `The root of ${follower.name} can’t be moved along x, y and z before its own rotation, so it can’t follow.`,
    );
  }
}

/** The range of the leader's take in seconds of the follower's, for a take that has to be created. */
function leaderRange(leader: Character, follower: Character): readonly [number, number] {
  const shift = follower.timeOffsetSeconds - leader.timeOffsetSeconds;
  const [start, end] = shownTake(leader)?.range ?? [0, 1];
  return [start + shift, end > start ? end + shift : start + shift + 1];
}

/** What a new attachment leaves of another one: nothing if both begin at once. */
function before([start, end]: readonly [number, number], one: Attachment, character: Character): readonly Attachment[] {
  if (one.span[1] <= start || one.span[0] >= end) return [one];
  if (one.span[0] === start) return [];
  if (one.span[0] < start) return [{ ...one, span: [one.span[0], start] }];
  throw new CommandError(
    `${character.name} is attached to ${leadingJoint(character, one)} from ${one.span[0]} to ${one.span[1]} s. Detach it first, or end before.`,
  );
}

/**
 * An attachment with the offset by which it begins where the root is then.
 * @param character without it
 * @param leaders its own is among them
 */
function startingWhere(character: Character, one: Attachment, leaders: readonly Character[]): Attachment {
  const leader = leaders.find(({ id }) => id === one.leaderId);
  if (!leader) throw new CommandError('The character that it follows is no longer there.');
  const [start] = one.span;
  // Leaders have the time of this character's take.
  const joint = jointInScene(inTakes(leader), one.joint, start);
  const root = jointInScene(inTakes(character), 0, start - character.timeOffsetSeconds);
  const { others } = one.offset;
  return { ...one, offset: { ...offsetBetween(joint, root), ...(others && { others }) } };
}

/**
 * The character at the place of its leader, where it does not move: what its files hold is then right beside the files
 * of the leader, and when both are opened again. The same object where that is more than another origin.
 */
function atPlaceOf(character: Character, leader: Character): Character {
  const { skeleton, placements, space, takes } = character;
  const [own, ...others] = placements;
  const placement: Placement = { ...leader.placements[0], scale: own.scale };
  const root = skeleton && followingRoot(skeleton);
  if (!root || others.length > 0 || sameValue(placement, own) || !sameValue(placement.turn, own.turn)) return character;
  const isSampled = (take: Take) => [...root.travel].some((dof) => take.channels[dof]?.kind === 'samples');
  if (takes.some((take) => take.layers || take.attached || take.goals || isSampled(take))) return character;
  const [from, to, moved] = [new Float64Array(16), new Float64Array(16), new Float64Array(16)];
  placementMatrix(own, space, NO_TRAVEL, from);
  placementMatrix(placement, space, NO_TRAVEL, to);
  invertAffine(to, 0, to, 0);
  multiplyAffine(to, 0, from, 0, moved, 0);
  const by = new Map([...root.travel].map((dof, k) => [dof, moved[12 + k]]));
  const shifted = (channel: Channel, dof: number): Channel => {
    const add = by.get(dof) ?? 0;
    if (add === 0 || channel.kind === 'samples') return channel;
    if (channel.kind === 'rest') return { ...channel, ...restChannel(channel.value + add) };
    return { ...channel, values: channel.values.map((value) => value + add) };
  };
  return {
    ...withoutUnkeyed(character),
    placements: [placement],
    pose: character.pose.map((value, dof) => value + (by.get(dof) ?? 0)),
    takes: takes.map((take) => withMotions(take, ({ channels }) => ({ channels: channels.map(shifted) }))),
  };
}

/** The character with its root keyed at a time as another pose of it has it, as steps. */
function keyedRoot(character: Character, held: Character, timeSeconds: number): Character {
  const { skeleton } = character;
  const take = shownTake(character);
  const root = skeleton && followingRoot(skeleton);
  if (!take || !root) return character;
  const dofs = [...root.travel, ...(root.turned?.dofs ?? [])];
  requireKeyable(take, dofs);
  const pose = new Float64Array(dofCountOf(held));
  poseAt(inTakes(held), timeSeconds, pose);
  const wanted = new Map(dofs.map((dof) => [dof, pose[dof]]));
  const values = take.layers ? layerValues(character, wanted, timeSeconds) : wanted;
  const time = timeSeconds + character.timeOffsetSeconds;
  const channels = [...take.channels];
  for (const [dof, value] of values) channels[dof] = steppedTo(channels[dof], time, value, 'continues', take.range);
  const byHand = unkeyedAt(character, timeSeconds);
  for (const dof of dofs) byHand.delete(dof);
  return withTake(withUnkeyed(character, timeSeconds, byHand), character.shownTake, { ...take, channels });
}
