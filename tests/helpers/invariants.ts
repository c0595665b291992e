/** Invariants of every document. */

import { controlCountOf } from '../../src/edit/limbs/goal-dofs.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { type Character, type Document, shownTake } from '../../src/model/document.ts';
import type { Morph } from '../../src/model/morph.ts';
import type { Selection } from '../../src/model/session.ts';
import { couplesOf } from '../../src/model/skeleton/couples.ts';
import { characterDofs } from '../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { bindingCount, type Skin, vertexCount } from '../../src/model/skin.ts';
import { withCurvesOfGoals } from '../../src/model/takes/layer-code.ts';
import { columnOf, type Samples } from '../../src/model/takes/samples.ts';
import { type Channel, EXTRAPOLATIONS, keysOf, type Take } from '../../src/model/takes/take.ts';
import { FIXED_TANGENT, TANGENT_KINDS } from '../../src/model/takes/tangent-kinds.ts';

/** Like `expect`, but fast enough for ten thousand calls. */
function must(holds: boolean, what: string): void {
  if (!holds) throw new Error(`not so: ${what}`);
}

function allFinite(values: ArrayLike<number>): boolean {
  return Array.prototype.every.call(values, Number.isFinite);
}

function ascends(values: ArrayLike<number>): boolean {
  return Array.prototype.every.call(values, (value, i) => i === 0 || value > values[i - 1]);
}

function isIndex(value: number, count: number): boolean {
  return Number.isInteger(value) && value >= 0 && value < count;
}

/** Those that were checked: most of a document is the same after a step. */
const sound = new WeakSet<Character>();

/** @throws Error naming the first broken invariant of `model/` */
export function checkDocument({ characters }: Document): void {
  must(new Set(characters.map(({ id }) => id)).size === characters.length, 'characters have ids of their own');
  for (const character of characters) {
    if (!sound.has(character)) checkCharacter(character);
    sound.add(character);
  }
}

export function checkCharacter(character: Character): void {
  const { name, skeleton, skins, morphs, takes, pose, poses, placements, ik, unkeyed, driver } = character;
  const joints = skeleton?.joints.length ?? 0;
  const dofs = characterDofs(skeleton, morphs).length;
  if (skeleton) checkSkeleton(skeleton);
  for (const skin of skins) checkSkin(skin);
  for (const morph of morphs) checkMorph(morph);
  for (const take of takes) checkTake(take);
  must(skins.length === 0 || isIndex(character.shownSkin, skins.length), `the shown skin of ${name} is there`);
  must(character.shownTake === -1 || isIndex(character.shownTake, takes.length), `the shown take of ${name} is there`);
  must(pose.length === dofs, `the pose of ${name} has a value for each of ${dofs} DOFs`);
  must(allFinite(pose) && Number.isFinite(character.timeOffsetSeconds), `pose and time offset of ${name} are finite`);
  must(placements.length > 0, `${name} is placed somewhere`);
  for (const { position, turn, scale } of placements) {
    must(allFinite([...position, ...turn]) && scale > 0, `placements of ${name} are finite, and scaled above 0`);
  }
  if (poses) {
    must(poses.length > 0, `${name} has poses, or no library`);
    must(new Set(poses.map((p) => p.name)).size === poses.length, `poses of ${name} have names of their own`);
    must(
      poses.every(({ values }) => values.length === dofs && allFinite(values)),
      `named poses of ${name} have a value for each DOF`,
    );
  }
  if (unkeyed) {
    must(unkeyed.dofs.length > 0 && unkeyed.dofs.length === unkeyed.values.length, `${name}: unkeyed DOFs have values`);
    const controls = controlCountOf(character);
    must(ascends(unkeyed.dofs) && unkeyed.dofs.every((d) => isIndex(d, controls)), `${name}: unkeyed DOFs ascend`);
  }
  if (ik) {
    const held = [...ik.pins, ...ik.stiff];
    must(
      held.every(({ joint }) => isIndex(joint, joints)),
      `${name}: pins and stiffness are of joints`,
    );
    must(new Set(ik.pins.map(({ id }) => id)).size === ik.pins.length, `${name}: pins have ids of their own`);
    must(ascends(ik.stiff.map(({ joint }) => joint)), `${name}: stiff joints ascend`);
  }
  if (driver) {
    const { pairs, source } = driver;
    must(ascends(pairs.map(({ target }) => target)), `${name}: pairs ascend`);
    must(
      pairs.every((p) => isIndex(p.target, joints) && isIndex(p.source, source.skeleton.joints.length)),
      `${name}: pairs are of joints`,
    );
  }
  const shown = new Float64Array(dofCountOf(character));
  poseAt(character, 0.25, shown);
  must(allFinite(shown), `the pose shown of ${name} is finite`);
}

function checkSkeleton({ joints }: Skeleton): void {
  const open: number[] = [];
  joints.forEach(({ parent, motion, limits, pose, offset, couples }, j) => {
    while (open.length && open.at(-1) !== parent) open.pop();
    must((open.at(-1) ?? -1) === parent, `joint ${j} is in pre-order`);
    must((j === 0) === (parent === -1), `joint ${j} is the root or has a parent`);
    open.push(j);
    const names = dofsOf(motion).map(({ name }) => name);
    must(
      limits.length === names.length && pose.length === names.length,
      `joint ${j} has limits and a pose for its DOFs`,
    );
    must(allFinite(pose) && allFinite(offset), `pose and offset of joint ${j} are finite`);
    must(!limits.some(({ min, max }) => Number.isNaN(min) || Number.isNaN(max)), `limits of joint ${j} are numbers`);
    if (!couples) return;
    must(couples.length > 0 && ascends(couples.map(({ dof }) => names.indexOf(dof))), `couples of joint ${j} ascend`);
    for (const { dof, joint, follows } of couples) {
      must(names.includes(dof), `couple ${dof} of joint ${j} is of its DOF`);
      must(
        joints[joint] !== undefined && dofsOf(joints[joint].motion).some(({ name }) => name === follows),
        `couple ${dof} of joint ${j} follows a DOF`,
      );
    }
  });
  must(couplesOf({ name: '', joints }).circular.length === 0, 'no DOF follows itself');
}

function checkSkin(skin: Skin): void {
  const { name, positions, normals, triangles, bindings, attachments } = skin;
  must(positions.length % 3 === 0 && bindings.length % 16 === 0, `${name} has whole vertices and bindings`);
  must(allFinite(positions) && allFinite(bindings) && allFinite(normals ?? []), `${name} is finite`);
  must(normals === undefined || normals.length === positions.length, `${name} has a normal a vertex`);
  must(
    triangles.every((v) => isIndex(v, vertexCount(skin))),
    `triangles of ${name} are of vertices`,
  );
  if (!attachments) return;
  const { start, joints, weights } = attachments;
  must(start.length === vertexCount(skin) + 1 && start.at(-1) === joints.length, `${name} has attachments a vertex`);
  must(weights.length === joints.length && allFinite(weights), `attachments of ${name} have weights`);
  must(
    joints.every((joint) => joint < bindingCount(skin)),
    `attachments of ${name} are of bound joints`,
  );
}

function checkMorph({ name, positions, normals }: Morph): void {
  for (const { indices, values } of [positions, normals]) {
    must(values.length === 3 * indices.length && allFinite(values), `rows of morph ${name} have values`);
  }
}

function checkTake({ name, range, channels, samples }: Take): void {
  must(allFinite(range) && range[0] <= range[1], `the range of ${name} is one`);
  channels.forEach((channel, c) => {
    const where = `channel ${c} of ${name}`;
    const hasColumn = columnOf(samples, c) >= 0;
    must(channel.kind !== 'samples' || hasColumn, `${where} has a column to follow`);
    must(channel.kind !== 'rest' || !hasColumn, `${where} is at rest`);
    checkChannel(channel, where);
  });
  if (samples) checkSamples(name, samples, channels.length);
}

/** A channel without its take's samples. */
export function checkChannel(channel: Channel, where = 'the channel'): void {
  const { extrapolateIn, extrapolateOut } = channel;
  const { times, values, tangentsIn, tangentsOut } = keysOf(channel);
  must(channel.kind !== 'keys' || times.length > 0, `${where} has keys`);
  must(channel.kind !== 'rest' || Number.isFinite(channel.value), `${where} rests at a finite value`);
  const columns = [values, tangentsIn.kinds, tangentsIn.slopes, tangentsOut.kinds, tangentsOut.slopes];
  must(
    columns.every((column) => column.length === times.length),
    `${where} has columns of one length`,
  );
  must(
    times.every((time, k) => k === 0 || time >= times[k - 1]),
    `${where} is sorted by time`,
  );
  must(allFinite(times) && allFinite(values), `${where} is finite`);
  must(EXTRAPOLATIONS.includes(extrapolateIn) && EXTRAPOLATIONS.includes(extrapolateOut), `${where} extrapolates`);
  for (const { kinds, slopes } of [tangentsIn, tangentsOut]) {
    must(
      kinds.every((kind, k) => kind < TANGENT_KINDS.length && (kind === FIXED_TANGENT || slopes[k] === 0)),
      `${where} has slopes where they are fixed`,
    );
    must(allFinite(slopes), `${where} has finite slopes`);
  }
}

function checkSamples(name: string, samples: Samples, channels: number): void {
  const { frameCount, frameSeconds, startSeconds, firstChannel, values, scales } = samples;
  must(frameCount >= 1 && frameSeconds > 0 && Number.isFinite(startSeconds), `${name} has frames`);
  must(values.length === frameCount * scales.length && allFinite(values), `frames of ${name} have all columns`);
  must(
    scales.every((scale) => scale !== 0),
    `columns of ${name} have scales`,
  );
  must(firstChannel >= 0 && firstChannel + scales.length <= channels, `columns of ${name} drive channels`);
}

/** @throws Error if something selected doesn't exist */
export function checkSelection({ characters }: Document, { characterId, joint, keys }: Selection): void {
  if (characterId === undefined) return;
  const character = characters.find(({ id }) => id === characterId);
  if (!character) throw new Error('not so: the selected character is there');
  must(joint === undefined || isIndex(joint, character.skeleton?.joints.length ?? 0), 'the selected joint is there');
  const take = shownTake(character);
  const channels = take
    ? withCurvesOfGoals(take, characterDofs(character.skeleton, character.morphs).length).channels
    : [];
  must(ascends((keys ?? []).map(({ channel }) => channel)), 'channels of selected keys ascend');
  for (const { channel, indices } of keys ?? []) {
    const count = keysOf(channels[channel]).times.length;
    must(
      indices.length > 0 && ascends(indices) && indices.every((k) => isIndex(k, count)),
      `selected keys of channel ${channel} are there`,
    );
  }
}
