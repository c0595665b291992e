/**
 * Posing by hand. DOFs, root translation and morph weights are all DOFs in the character's list. What a new value
 * changes depends on what drives its DOF:
 *
 *     no channel            the pose
 *     a channel, no keys    the channel's rest value, which belongs to the take
 *     a channel with keys   an *unkeyed change*, shown until the time changes; none if the keys give that value
 *     a sampled channel     an unkeyed change too: samples take no keys
 *     layers                an unkeyed change, whatever the channel: what is shown is a sum
 *     retargeting           an unkeyed change, if it drives the joint; else the pose
 *     auto-key              a key at that time, except for sampled channels
 *     a lock                nothing changes; how many there were is told
 *     a limb in IK          its goal is set instead, if it moves, by the indices of the goal's channels
 *
 * The pose keeps the values beneath a take: it shows again without the take, and is saved to `.skel`. Writing to both
 * would change one take by posing in another.
 */

import { channelOf, dofCountOf, isDriven, poseAt } from '../../evaluate/pose.ts';
import { type Character, type Document, shownTake } from '../../model/document.ts';
import { type CharacterDof, characterDofs, type DofValue, restPose, wholeFilePose } from '../../model/skeleton/dofs.ts';
import { withChannelsOf } from '../../model/takes/channels-with-goals.ts';
import { withCurvesOfGoals } from '../../model/takes/layer-code.ts';
import { indexIn } from '../arguments.ts';
import type { Change } from '../change.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { type KeyOptions, keyDofs } from '../key-dofs.ts';
import { controlCountOf, withGoalsPosed } from '../limbs/goal-dofs.ts';
import { openValues } from '../pose/locks.ts';
import { type Tween, tweenedPose } from '../pose/tween.ts';
import { boolean, index, list, number, oneOf, optional, record } from '../schema/shape.ts';
import { CHARACTER, indices, key, NOW } from '../schema/shared-shapes.ts';
import { characterIn, dofsIn, poseLabel } from '../step-names.ts';
import { withTake } from '../takes.ts';
import { unkeyedAt, withoutUnkeyed, withUnkeyed } from '../unkeyed.ts';

/** Arguments of posing: values in the DOFs' units. */
export interface SetDofs {
  readonly characterId: string;
  readonly dofs: readonly DofValue[];
  /** Transport time: keyed DOFs are changed at this time only. */
  readonly timeSeconds: number;
  /** Auto-key: keys the DOFs at that time instead. */
  readonly key?: KeyOptions;
}

/** Sets DOFs, clamped to their limits if the character enforces them. */
export const setDofs = command({
  id: 'pose.setDofs',
  args: { ...NOW, dofs: list(record({ index, value: number })), key },
  label(document, { characterId, dofs, key }) {
    const character = requireCharacter(document, characterId);
    const indices = dofs.map(({ index }) => index);
    return key ? `Key ${dofsIn(character, indices)}` : poseLabel(character, indices);
  },
  run: (document, { characterId, dofs, timeSeconds, key }) =>
    setValues(document, characterId, timeSeconds, key, (character) => {
      const all = characterDofs(character.skeleton, character.morphs);
      const values = new Map<number, number>();
      for (const { index, value } of dofs) {
        indexIn(index, 0, controlCountOf(character), 'DOF');
        const isClamped = character.clampsToLimits && index < all.length;
        values.set(index, isClamped ? withinLimit(all[index], value) : value);
      }
      return values;
    }),
});

/** Sets every DOF to its value in the file, or at rest. */
export const resetPose = command({
  id: 'pose.reset',
  args: {
    ...NOW,
    /** The file pose, or every DOF at rest. */
    to: oneOf(['file', 'zero']),
    /** Auto-key: keys every DOF at that time instead. */
    key,
  },
  label: (document, { characterId, to }) =>
    `Reset ${characterIn(document, characterId)} to ${to === 'file' ? 'file pose' : 'zero pose'}`,
  run: (document, { characterId, to, timeSeconds, key }) =>
    setValues(document, characterId, timeSeconds, key, ({ skeleton, morphs }) => {
      const values = to === 'file' ? wholeFilePose(skeleton, morphs) : restPose(skeleton, morphs.length);
      return new Map(values.entries());
    }),
});

/** The ways a pose can be tweened: between the keys around the time, or toward the file pose. */
export const TWEEN_TOWARD = ['keys', 'rest'] as const;

const OF_POSE = {
  ...NOW,
  /** Indices into the character's DOFs; default all. Those without a key on both sides are left alone. */
  dofs: optional(indices),
  key,
} as const;

/** Sets DOFs to values between their keys around the time: 0 is that before, 1 that after; any number. */
export const tweenPose = command({
  id: 'pose.tween',
  args: { ...OF_POSE, u: number, toward: optional(oneOf(TWEEN_TOWARD)) },
  label: (document, args) => `Tween ${whatOf(document, args)}${args.toward === 'rest' ? ' toward file pose' : ''}`,
  run: (document, { u, toward = 'keys', ...of }) => tweened(document, of, { kind: toward, u }),
});

/** Moves DOFs toward the straight line between their keys around the time, by a share; less than 0 pushes them away. */
export const relaxPose = command({
  id: 'pose.relax',
  args: { ...OF_POSE, amount: number },
  label: (document, args) => `${args.amount < 0 ? 'Push' : 'Relax'} ${whatOf(document, args)}`,
  run: (document, { amount, ...of }) => tweened(document, of, { kind: 'relax', amount }),
});

interface OfPose {
  readonly characterId: string;
  readonly timeSeconds: number;
  readonly dofs?: readonly number[];
  readonly key?: KeyOptions;
}

function tweened(document: Document, { characterId, timeSeconds, dofs, key }: OfPose, tween: Tween): Document | Change {
  return setValues(document, characterId, timeSeconds, key, (character) => {
    const count = dofCountOf(character);
    const given = dofs?.map((dof) => indexIn(dof, 0, count, 'DOF'));
    return tweenedPose(character, timeSeconds, tween, given).values;
  });
}

function whatOf(document: Document, { characterId, dofs }: OfPose): string {
  return dofs ? dofsIn(requireCharacter(document, characterId), dofs) : characterIn(document, characterId);
}

/** Sets whether the limits of a character are enforced; its values stay as they are. */
export const setClamping = command({
  id: 'pose.setClamping',
  args: { ...CHARACTER, clamps: boolean },
  label: (document, { characterId, clamps }) =>
    `${clamps ? 'Enforce' : 'Ignore'} limits of ${characterIn(document, characterId)}`,
  run: (document, { characterId, clamps }) =>
    changeCharacter(document, characterId, (c) => (c.clampsToLimits === clamps ? c : { ...c, clampsToLimits: clamps })),
});

/** The document with these values for a character's DOFs, stored as described above. */
export function setValues(
  document: Document,
  characterId: string,
  timeSeconds: number,
  key: KeyOptions | undefined,
  valuesFor: (character: Character) => ReadonlyMap<number, number>,
): Document | Change {
  const character = requireCharacter(document, characterId);
  const { open, locked } = openValues(character, valuesFor(character));
  const values = withGoalsPosed(character, open, timeSeconds, false);
  const told = locked > 0 && { locked };
  if (!key) {
    const next = changeCharacter(document, characterId, () => pose(character, values, timeSeconds));
    return told ? { document: next, ...told } : next;
  }
  const take = shownTake(character);
  const overSamples = new Map([...values].filter(([dof]) => take?.channels[dof]?.kind === 'samples'));
  const posed = overSamples.size ? pose(character, overSamples, timeSeconds) : character;
  const keyed = keyDofs(posed, values, timeSeconds, key);
  return { document: changeCharacter(document, characterId, () => keyed.character), keys: keyed.keys, ...told };
}

/** The character with each value stored where it belongs; the same object if none changed. */
function pose(character: Character, values: ReadonlyMap<number, number>, timeSeconds: number): Character {
  const take = shownTake(character);
  const byHand = unkeyedAt(character, timeSeconds);
  const count = dofCountOf(character);
  const channels = take && [...withCurvesOfGoals(take, count).channels];
  const posed = [...character.pose];
  let poseChanged = false;
  let takeChanged = false;
  let handChanged = false;
  let driven: Float64Array | undefined;
  for (const [dof, value] of values) {
    const channel = channelOf(character, dof);
    if (isDriven(character, dof)) {
      driven ??= drivenAt(character, timeSeconds);
      handChanged = true;
      // A value equal to that of the keys is no unkeyed change: nothing to key, nothing to lose.
      if (driven[dof] === value) byHand.delete(dof);
      else byHand.set(dof, value);
      continue;
    }
    // Its keys may have been deleted since the unkeyed change, which would hide the new value.
    handChanged = byHand.delete(dof) || handChanged;
    if (channel?.kind !== 'rest' || !channels) {
      poseChanged ||= posed[dof] !== value;
      while (posed.length < dof) posed.push(0);
      posed[dof] = value;
    } else if (channel.value !== value) {
      channels[dof] = { ...channel, value: value + 0 };
      takeChanged = true;
    }
  }
  let next = poseChanged ? { ...character, pose: posed } : character;
  if (take && channels && takeChanged) next = withTake(next, next.shownTake, withChannelsOf(take, channels, count));
  return handChanged ? withUnkeyed(next, timeSeconds, byHand) : next;
}

/** The pose at that time from keys, samples and retargeting, without unkeyed changes. */
function drivenAt(character: Character, timeSeconds: number): Float64Array {
  const out = new Float64Array(dofCountOf(character));
  poseAt(withoutUnkeyed(character), timeSeconds, out);
  return out;
}

/** The value clamped to the DOF's limits. */
export function withinLimit({ limit, unit }: CharacterDof, value: number): number {
  // Weights beyond 0 and 1 exaggerate a morph deliberately; limits with min > max don't apply.
  if (unit === 'weight' || limit.min > limit.max) return value;
  return Math.min(limit.max, Math.max(limit.min, value));
}
