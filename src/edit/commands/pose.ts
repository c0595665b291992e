/**
 * Posing by hand: DOFs, root translation and morph weights are all DOFs of the character's one list. Where a value goes
 * depends on who has the say over its DOF:
 *
 *     no channel            the pose
 *     a channel, no keys    the value that it stands at: the take's own, as everything that is seen through a take is
 *     a channel with keys   *unkeyed*: shown until time moves; nothing where the keys give that very value
 *     one of samples        unkeyed too: no key can stand among frames
 *     another's take        unkeyed, where it moves the joint; else the pose
 *     auto-key              a key at that moment, whatever there was but samples
 *
 * The pose keeps what lies beneath a take: it shows again when the take is taken off, and it is what a `.skel` is saved
 * with. Writing to both would change one take by posing another.
 */
import { channelOf, dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { movedDofs } from '../../evaluate/retarget/moved-dofs.ts';
import { type Character, type Document, shownClip } from '../../model/document.ts';
import { type CharacterDof, characterDofs, type DofValue, filePose, restPose } from '../../model/dofs.ts';
import { jointName } from '../../model/joint-name.ts';
import { finiteNumber, listOf, oneOf } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { type KeyOptions, keyDofs } from '../key-dofs.ts';
import { type Command, CommandError, type Edit } from '../store.ts';
import { withTake } from '../takes.ts';
import { countUnkeyed, documentWithoutUnkeyed, unkeyedAt, withoutUnkeyed, withUnkeyed } from '../unkeyed.ts';

export interface SetDofs {
  readonly characterId: string;
  readonly dofs: readonly DofValue[];
  /** The transport's time: what keys drive is changed for this moment only. */
  readonly timeSeconds: number;
  /** Keys the DOFs at that moment instead: auto-key. */
  readonly key?: KeyOptions | undefined;
}

/** Sets DOFs, clamped to their limits while the character's switch is on. */
export const setDofs: Command<SetDofs, Document | Edit> = {
  id: 'pose.setDofs',
  label(document, { characterId, dofs, key }) {
    const character = requireCharacter(document, characterId);
    const verb = key ? 'Key' : 'Set';
    return dofs.length === 1 ? `${verb} ${dofName(character, dofs[0].index)}` : `${verb} pose`;
  },
  run: (document, { characterId, dofs, timeSeconds, key }) =>
    setValues(document, characterId, timeSeconds, key, (character) => {
      const all = characterDofs(character.skeleton, character.morphs);
      const values = new Map<number, number>();
      listOf(dofs, '"dofs"');
      for (const { index, value } of dofs) {
        const dof = all[index];
        if (!dof) throw new CommandError(`${character.name} has ${all.length} DOFs; there is no number ${index}.`);
        finiteNumber(value, `The value of DOF ${index}`);
        values.set(index, character.clampsToLimits ? withinLimit(dof, value) : value);
      }
      return values;
    }),
};

export interface ResetPose {
  readonly characterId: string;
  /** The pose of the file, or every DOF at rest. */
  readonly to: 'file' | 'zero';
  readonly timeSeconds: number;
  /** Keys every DOF at that moment instead: auto-key. */
  readonly key?: KeyOptions | undefined;
}

export const resetPose: Command<ResetPose, Document | Edit> = {
  id: 'pose.reset',
  label: (_document, { to }) => (to === 'file' ? 'Reset to file pose' : 'Reset to zero pose'),
  run: (document, { characterId, to, timeSeconds, key }) =>
    setValues(document, characterId, timeSeconds, key, (character) => {
      const make = oneOf(to, ['file', 'zero'], '"to"') === 'file' ? filePose : restPose;
      return new Map(make(character.skeleton, character.morphs.length).entries());
    }),
};

export const setClamping: Command<{ readonly characterId: string; readonly clamps: boolean }> = {
  id: 'pose.setClamping',
  label: (_document, { clamps }) => (clamps ? 'Enforce limits' : 'Ignore limits'),
  run: (document, { characterId, clamps }) =>
    changeCharacter(document, characterId, (c) =>
      c.clampsToLimits === oneOf(clamps, [true, false], '"clamps"') ? c : { ...c, clampsToLimits: clamps },
    ),
};

export interface DropUnkeyed {
  /** Of the transport: what was set by hand at that moment stays. With null all of it goes. */
  readonly exceptSeconds: number | null;
}

/** Of all characters, values that were set by hand over keys and not keyed: each DOF is again where its keys have it. */
export const discardUnkeyed: Command<DropUnkeyed> = {
  id: 'pose.dropUnkeyed',
  label(document, { exceptSeconds }) {
    const count = countUnkeyed(document, exceptSeconds);
    return `Discard ${count} unkeyed ${count === 1 ? 'change' : 'changes'}`;
  },
  run(document, { exceptSeconds }) {
    if (exceptSeconds !== null) finiteNumber(exceptSeconds, '"exceptSeconds"');
    return documentWithoutUnkeyed(document, exceptSeconds);
  },
};

/** The document with a character's DOFs at the values that are given for it, by whichever way they go. */
export function setValues(
  document: Document,
  characterId: string,
  timeSeconds: number,
  key: KeyOptions | undefined,
  valuesFor: (character: Character) => ReadonlyMap<number, number>,
): Document | Edit {
  const character = requireCharacter(document, characterId);
  const values = valuesFor(character);
  finiteNumber(timeSeconds, '"timeSeconds"');
  if (!key) return changeCharacter(document, characterId, () => pose(character, values, timeSeconds));
  const clip = shownClip(character);
  const overSamples = new Map([...values].filter(([dof]) => clip?.channels[dof]?.kind === 'samples'));
  const posed = overSamples.size ? pose(character, overSamples, timeSeconds) : character;
  const keyed = keyDofs(posed, values, timeSeconds, key);
  return { document: changeCharacter(document, characterId, () => keyed.character), keys: keyed.keys };
}

/** The character with each value where it belongs; the same object where all of them were there. */
function pose(character: Character, values: ReadonlyMap<number, number>, timeSeconds: number): Character {
  const clip = shownClip(character);
  const byHand = unkeyedAt(character, timeSeconds);
  const channels = clip && [...clip.channels];
  const posed = [...character.pose];
  let poseChanged = false;
  let clipChanged = false;
  let handChanged = false;
  const moved = movedDofs(character);
  let driven: Float64Array | undefined;
  for (const [dof, value] of values) {
    const channel = channelOf(character, dof);
    if ((channel && channel.kind !== 'rest') || moved?.has(dof)) {
      driven ??= drivenAt(character, timeSeconds);
      handChanged = true;
      // What is where its keys have it was not set by hand: there is nothing to key, and nothing to lose.
      if (driven[dof] === value) byHand.delete(dof);
      else byHand.set(dof, value);
      continue;
    }
    // Its keys may have gone since it was set by hand: what hides the value that is set goes with them.
    handChanged = byHand.delete(dof) || handChanged;
    if (!channel || !channels) {
      poseChanged ||= posed[dof] !== value;
      while (posed.length < dof) posed.push(0);
      posed[dof] = value;
    } else if (channel.value !== value) {
      channels[dof] = { ...channel, value: value + 0 };
      clipChanged = true;
    }
  }
  let next = poseChanged ? { ...character, pose: posed } : character;
  if (clip && channels && clipChanged) next = withTake(next, next.shownClip, { ...clip, channels });
  return handChanged ? withUnkeyed(next, timeSeconds, byHand) : next;
}

/** The pose as keys, samples and another's take have it at that moment, without what was set by hand. */
function drivenAt(character: Character, timeSeconds: number): Float64Array {
  const out = new Float64Array(dofCountOf(character));
  poseAt(withoutUnkeyed(character), timeSeconds, out);
  return out;
}

/** The value nearest to it that the DOF's limits allow. */
export function withinLimit({ limit, unit }: CharacterDof, value: number): number {
  // Weights beyond 0 and 1 exaggerate a morph, which is wanted; crossed limits are none.
  if (unit === 'weight' || limit.min > limit.max) return value;
  return Math.min(limit.max, Math.max(limit.min, value));
}

/** `rx of hip`, `morph smile`; for labels, so it has a word for what is not there too. */
export function dofName(character: Character, index: number): string {
  const dof = characterDofs(character.skeleton, character.morphs)[index];
  if (!dof) return `DOF ${index}`;
  if (dof.joint < 0) return `morph ${dof.name}`;
  return `${dof.name} of ${jointName(character.skeleton, dof.joint)}`;
}
