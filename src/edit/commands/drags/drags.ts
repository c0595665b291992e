/** Drags of points as commands: of a joint by IK, and of a key on a motion path. */
import { dragReach, lockedIn, WHOLE } from '../../../evaluate/ik/drag/drag-reach.ts';
import { Pull } from '../../../evaluate/ik/drag/pull.ts';
import { limbOf } from '../../../evaluate/ik/limb.ts';
import { dofsOnPath } from '../../../evaluate/ik/path-dofs.ts';
import { ikOf, pinTargets } from '../../../evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../evaluate/pose.ts';
import { wholeFrameAt } from '../../../evaluate/samples/sampling.ts';
import { NO_TRAVEL, placementMatrix } from '../../../evaluate/space/placements.ts';
import { transformPoint, type Vec3, ZERO } from '../../../math/vec3.ts';
import { type Character, type Document, shownTake } from '../../../model/document.ts';
import { type LockedDofs, NO_SETS } from '../../../model/sets.ts';
import { characterDofs, type DofValue } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { columnOf } from '../../../model/takes/samples.ts';
import type { Take } from '../../../model/takes/take.ts';
import { indexIn } from '../../arguments.ts';
import { type Change, isChange } from '../../change.ts';
import { changeCharacter, requireCharacter } from '../../characters.ts';
import { command } from '../../command.ts';
import { CommandError } from '../../command-error.ts';
import { keyDofs } from '../../key-dofs.ts';
import { findKey } from '../../keys/same-time.ts';
import { layerValues } from '../../layers/layer-values.ts';
import { openValues } from '../../pose/locks.ts';
import { refuseMoved } from '../../refuse-moved.ts';
import { index, oneOf, optional } from '../../schema/shape.ts';
import { key, NOW, vector } from '../../schema/shared-shapes.ts';
import { jointIn } from '../../step-names.ts';
import { withTake } from '../../takes.ts';
import { unkeyedAt, withUnkeyed } from '../../unkeyed.ts';
import { setDofs } from '../pose.ts';

/** Drags a point of a joint by IK, from where it is to where it should be: a whole drag, with pins and planted feet. */
export const moveByIk = command({
  id: 'ik.move',
  args: {
    ...NOW,
    joint: index,
    /** The point, in the joint's space; default its pivot. */
    point: optional(vector),
    /** Where it should be, in the character's space. */
    to: vector,
    /** What bends; default `limb`. */
    reach: optional(oneOf(['limb', 'chain', 'body'])),
    /** For `chain`: the joint that it ends with; default the root. */
    top: optional(index),
    key,
  },
  label: (document, { characterId, joint }) => `Drag ${jointIn(requireCharacter(document, characterId), joint)}`,
  run(document, args): Document | Change {
    const { characterId, timeSeconds, joint, point = ZERO, to, reach = 'limb', top = 0, key } = args;
    const character = requireCharacter(document, characterId);
    const skeleton = jointsOf(character, joint);
    indexIn(top, 0, skeleton.joints.length, 'joint');
    const { dofs, world, placement } = shownAt(character, skeleton, timeSeconds);
    const chosen = reach === 'chain' ? { top } : reach;
    const moving = dragReach(character, skeleton, world, placement, joint, chosen);
    const held = pinTargets(ikOf(character), world);
    const pull = new Pull(character, skeleton, { dofs, world }, held, { joint, point }, placement, moving);
    const values = pulled(pull, transformPoint(placement, to));
    if (values.length === 0) return document;
    const locked = lockedIn(character, moving.bending);
    const change = setDofs.run(document, { characterId, timeSeconds, dofs: values, key });
    return locked > 0 ? { ...(isChange(change) ? change : { document: change }), locked } : change;
  },
});

/**
 * Moves a joint at a time of its motion path by its limb, the root by its translation. Changes the keys, or the frame
 * of samples, that these DOFs have at that time, and nothing else; on the seam of a loop, the key at its other end too,
 * so that it stays closed. Locked DOFs are skipped.
 */
export const movePathKey = command({
  id: 'path.moveKey',
  args: {
    ...NOW,
    joint: index,
    /** Where its pivot should be at that time, in the character's space. */
    to: vector,
  },
  label: (document, { characterId, joint }) =>
    `Move ${jointIn(requireCharacter(document, characterId), joint)} on its path`,
  run(document, { characterId, timeSeconds, joint, to }): Document | Change {
    const character = requireCharacter(document, characterId);
    const skeleton = jointsOf(character, joint);
    if (character.driver) refuseMoved(character);
    const there = setOnPath(character, skeleton, joint, timeSeconds);
    const { open, locked } = openValues(character, there);
    const { ik: _pins, ...free } = withOnly(character, skeleton, open);
    const { dofs, world } = shownAt(character, skeleton, timeSeconds);
    const pull = new Pull(free, skeleton, { dofs, world }, new Map(), { joint, point: ZERO }, undefined, WHOLE);
    const values = new Map(pulled(pull, to).map(({ index: dof, value }) => [dof, value]));
    if (values.size === 0) return document;
    const { character: keyed, keys } = keyDofs(character, values, timeSeconds);
    const sampled = withFrame(keyed, values, timeSeconds);
    return { document: changeCharacter(document, characterId, () => sampled), keys, ...(locked > 0 && { locked }) };
  },
});

/**
 * The DOFs that dragging a joint's motion path at a time sets: those on the path that have a key or a frame there, with
 * what they show.
 * @throws CommandError if there are none
 */
function setOnPath(
  character: Character,
  skeleton: Skeleton,
  joint: number,
  timeSeconds: number,
): ReadonlyMap<number, number> {
  const time = timeSeconds + character.timeOffsetSeconds;
  const take = shownTake(character);
  const { dofs } = shownAt(character, skeleton, timeSeconds);
  const found = dofsOnPath(skeleton, joint).filter((dof) => {
    const channel = take?.channels[dof];
    return channel?.kind === 'keys' ? findKey(channel, time) >= 0 : take && frameOf(take, dof, time) !== undefined;
  });
  if (found.length > 0) return new Map(found.map((dof) => [dof, dofs[dof]]));
  const what =
    limbOf(skeleton, joint) === 'body' ? 'The translation of the root' : `The limb of ${jointName(skeleton, joint)}`;
  throw new CommandError(`${what} has no key at ${timeSeconds} s. Key the pose there first.`);
}

/** The frame of a sampled channel that is at a time of the take; undefined between frames, and for other channels. */
function frameOf({ channels, samples }: Take, dof: number, time: number): number | undefined {
  if (channels[dof]?.kind !== 'samples' || !samples || columnOf(samples, dof) < 0) return undefined;
  return wholeFrameAt(samples, time);
}

/** The character with these values in the frame of its samples at that time; the others of its DOFs are left alone. */
function withFrame(character: Character, values: ReadonlyMap<number, number>, timeSeconds: number): Character {
  const take = shownTake(character);
  const time = timeSeconds + character.timeOffsetSeconds;
  const own = new Map([...values].filter(([dof]) => take && frameOf(take, dof, time) !== undefined));
  if (!take?.samples || own.size === 0) return character;
  const { scales, values: before } = take.samples;
  const changed = before.slice();
  for (const [dof, value] of layerValues(character, own, timeSeconds)) {
    const column = columnOf(take.samples, dof);
    changed[(frameOf(take, dof, time) ?? 0) * scales.length + column] = value / scales[column];
  }
  const framed = withTake(character, character.shownTake, { ...take, samples: { ...take.samples, values: changed } });
  const byHand = unkeyedAt(framed, timeSeconds);
  for (const dof of own.keys()) byHand.delete(dof);
  return withUnkeyed(framed, timeSeconds, byHand);
}

/** All other DOFs of joints locked. */
function withOnly(character: Character, skeleton: Skeleton, open: ReadonlyMap<number, number>): Character {
  const locked = new Map<number, string[]>();
  characterDofs(skeleton, []).forEach(({ joint, name }, d) => {
    if (!open.has(d)) locked.set(joint, [...(locked.get(joint) ?? []), name]);
  });
  const rows = [...locked].map(([joint, dofs]): LockedDofs => ({ joint, dofs }));
  return { ...character, sets: { ...NO_SETS, locked: rows } };
}

/** The result of a pull that has come to rest. */
function pulled(pull: Pull, to: Vec3): readonly DofValue[] {
  pull.to(to);
  while (pull.isOnItsWay) pull.goOn();
  pull.settle();
  return pull.changes;
}

function jointsOf({ skeleton, name }: Character, joint: number): Skeleton {
  if (!skeleton) throw new CommandError(`${name} has no skeleton.`);
  indexIn(joint, 0, skeleton.joints.length, 'joint');
  return skeleton;
}

/** The displayed pose, and its first instance's place in the scene. */
function shownAt(character: Character, skeleton: Skeleton, timeSeconds: number) {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, timeSeconds, dofs);
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  const placement = new Float64Array(16);
  placementMatrix(character.placements[0], character.space, NO_TRAVEL, placement);
  return { dofs, world, placement };
}
