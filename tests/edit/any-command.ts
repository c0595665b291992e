/**
 * Arguments for every command, made up for the document as it is: keys that are there, times that keys are at, values
 * near theirs. Some are refused, as some of what people ask for is.
 */
import fc from 'fast-check';
import { ARRANGEMENTS, type TakeRef } from '../../src/edit/commands/takes.ts';
import type { KeyOptions } from '../../src/edit/key-dofs.ts';
import { copyKeys } from '../../src/edit/keys/clipboard.ts';
import { allKeys } from '../../src/edit/keys/selection.ts';
import { poseByNames } from '../../src/edit/pose/by-names.ts';
import type { Store } from '../../src/edit/store.ts';
import { type Character, isBvh, type Placement, shownTake } from '../../src/model/document.ts';
import type { ChannelKeys } from '../../src/model/session.ts';
import { characterDofs } from '../../src/model/skeleton/dofs.ts';
import { NO_REVIEW } from '../../src/model/takes/review.ts';
import { INTERPOLATIONS } from '../../src/model/takes/samples.ts';
import { EXTRAPOLATIONS, type Take } from '../../src/model/takes/take.ts';
import { TANGENT_KINDS } from '../../src/model/takes/tangent-kinds.ts';
import type { Dice } from './dice.ts';
import { RIG_COMMANDS, rigArguments } from './rig/random-rig.ts';

/** One or more of the character's takes. */
const someTakes = (dice: Dice, { id, takes }: Character) =>
  [dice.below(takes.length), ...dice.some([...takes.keys()], 0.3)].map((take) => ({ characterId: id, take }));

/** Paths of takes in review. */
const REVIEWED = ['a.bvh', 'b/a.bvh', 'c.bvh'] as const;

interface Situation {
  readonly dice: Dice;
  readonly character: Character;
  readonly take: Take;
  /** The document's other characters. */
  readonly others: readonly Character[];
  /** The selected keys, or any. */
  readonly keys: readonly ChannelKeys[];
}

/** On eighths of seconds as a rule, so that keys meet. */
function time(dice: Dice): number {
  const eighths = dice.below(40) / 8 - 1;
  return dice.is(0.2) ? eighths + dice.number() / 8 : eighths;
}

const value = (dice: Dice) => (dice.is(0.3) ? dice.below(5) - 2 : (dice.number() - 0.5) * 8);
const seconds = (dice: Dice) => (dice.below(33) - 16) / 8;
const side = (dice: Dice) => dice.pick(['in', 'out', 'both'] as const);
const onCollision = (dice: Dice) => dice.pick(['replace', 'step', undefined] as const);

function range(dice: Dice): [number, number] {
  const from = time(dice);
  return [from, from + dice.below(20) / 8];
}

function channels({ dice, take }: Situation, share = 0.3): number[] {
  return dice.some([...take.channels.keys()], share);
}

/** Ids; undefined where nothing is pinned. */
const pinsOf = ({ character }: Situation) =>
  character.ik?.pins.length ? character.ik.pins.map(({ id }) => id) : undefined;

/** Any values for any of the character's DOFs, by names. */
function madeUpPose(dice: Dice, character: Character) {
  const values = characterDofs(character.skeleton, character.morphs).map(() => value(dice));
  return poseByNames(character, { name: dice.pick(['rest', 'sting', 'land']), values });
}

/** One of the poses in the library; undefined without any. */
function ofPose({ dice, character }: Situation, rest: object): object | undefined {
  return character.poses && { characterId: character.id, pose: dice.below(character.poses.length), ...rest };
}

function placement(dice: Dice): Placement {
  const [x, z] = [dice.below(3), dice.below(3)];
  return { position: [x, 0, z], turn: [0, dice.below(2), 0], scale: dice.pick([1, 2]) };
}

function anyTake(dice: Dice, { id, takes }: Character): TakeRef {
  return { characterId: id, take: dice.below(takes.length + 1) - 1 };
}

const of = ({ character, keys }: Situation) => ({ characterId: character.id, keys });

/** One of the take's layers; undefined without any. */
function ofLayer({ dice, character, take }: Situation, rest: object): object | undefined {
  return take.layers && { characterId: character.id, layer: dice.below(take.layers.list.length), ...rest };
}

/** One of the attachments of the take, if it has any. */
function ofAttachment({ dice, character, take }: Situation, rest: object): object | undefined {
  return take.attached && { characterId: character.id, index: dice.below(take.attached.list.length), ...rest };
}

/** One of the character's limbs; undefined without any. */
function ofLimb({ dice, character }: Situation, rest: object): object | undefined {
  const count = character.limbs?.list.length ?? 0;
  return count > 0
    ? { characterId: character.id, limb: dice.below(count), timeSeconds: time(dice), ...rest }
    : undefined;
}

/** Two or three joints in a row; undefined if there are none. */
function chainIn({ dice, character: { skeleton } }: Situation): readonly number[] | undefined {
  const joints = skeleton?.joints ?? [];
  if (joints.length < 2) return undefined;
  const last = 1 + dice.below(joints.length - 1);
  const { parent } = joints[last];
  const above = dice.is(0.5) ? joints[parent].parent : -1;
  return above < 0 ? [parent, last] : [above, parent, last];
}

/** How auto-key asks for keys, or not at all. */
function autoKey(dice: Dice): { readonly key?: KeyOptions } {
  if (dice.is(0.6)) return {};
  const tangents = dice.pick(['smooth', 'linear', 'flat', undefined] as const);
  return { key: { tangents, playedRange: dice.is(0.5) ? range(dice) : undefined } };
}

/** By the command's id; undefined if the document has nothing to use it on. */
const ARGUMENTS: Readonly<Record<string, (s: Situation) => object | undefined>> = {
  'pose.setDofs': ({ dice, character }) => ({
    characterId: character.id,
    dofs: dice
      .some([...characterDofs(character.skeleton, character.morphs).keys()], 0.2)
      .map((index) => ({ index, value: value(dice) })),
    timeSeconds: time(dice),
    ...autoKey(dice),
  }),
  'pose.reset': ({ dice, character }) => ({
    characterId: character.id,
    to: dice.pick(['file', 'zero']),
    timeSeconds: time(dice),
    ...autoKey(dice),
  }),
  'pose.tween': ({ dice, character }) => ({
    characterId: character.id,
    timeSeconds: time(dice),
    u: value(dice),
    toward: dice.pick(['keys', 'rest', undefined]),
    ...autoKey(dice),
  }),
  'pose.relax': ({ dice, character }) => ({
    characterId: character.id,
    timeSeconds: time(dice),
    amount: value(dice),
    ...autoKey(dice),
  }),
  'pose.dropUnkeyed': ({ dice }) => ({ exceptSeconds: dice.is(0.5) ? time(dice) : null }),
  'poses.mirror': ({ dice, character }) => ({
    characterId: character.id,
    joint: dice.is(0.5) ? undefined : dice.below(character.skeleton?.joints.length ?? 0),
    way: dice.pick(['swap', 'toOther']),
    timeSeconds: time(dice),
    ...autoKey(dice),
  }),
  'poses.paste': ({ dice, character }) => ({
    characterId: character.id,
    pose: madeUpPose(dice, character),
    timeSeconds: time(dice),
    ...autoKey(dice),
  }),
  'poses.keep': ({ dice, character }) => ({ characterId: character.id, timeSeconds: time(dice) }),
  'poses.update': (s) => ofPose(s, { timeSeconds: time(s.dice) }),
  'poses.rename': (s) => ofPose(s, { name: s.dice.pick(['sting', 'land', 'pose 1']) }),
  'poses.remove': ({ dice, character }) =>
    character.poses && { characterId: character.id, poses: [dice.below(character.poses.length)] },
  'poses.apply': (s) =>
    ofPose(s, {
      share: s.dice.pick([undefined, 0.5, 1]),
      joints: s.dice.is(0.5) ? undefined : [0, 1].map(() => s.dice.below(s.character.skeleton?.joints.length ?? 0)),
      timeSeconds: time(s.dice),
      ...autoKey(s.dice),
    }),
  'poses.add': ({ dice, character }) => ({ characterId: character.id, poses: [madeUpPose(dice, character)] }),
  'pose.setClamping': ({ dice, character }) => ({ characterId: character.id, clamps: dice.is(0.5) }),
  'pose.key': ({ dice, character }) => ({
    characterId: character.id,
    dofs: dice.is(0.3) ? undefined : dice.some([...characterDofs(character.skeleton, character.morphs).keys()], 0.3),
    timeSeconds: time(dice),
    tangents: dice.pick(['smooth', 'linear', 'flat']),
  }),
  'keys.forMoment': ({ dice, character }) => ({
    characterId: character.id,
    timeSeconds: time(dice),
    dofs: dice
      .some([...characterDofs(character.skeleton, character.morphs).keys()], 0.3)
      .map((index) => ({ index, value: dice.pick([0, 0.5, -1]) })),
    easeIn: dice.pick([0.1, 0.5]),
    easeOut: dice.pick([0.1, 2]),
  }),
  'ik.pin': ({ dice, character }) => ({
    characterId: character.id,
    joint: dice.below(character.skeleton?.joints.length ?? 1),
    point: [0, dice.pick([0, -0.5]), 0],
    holdsOrientation: dice.is(0.2),
  }),
  'ik.unpin': (s) => pinsOf(s) && { characterId: s.character.id, pins: s.dice.some(pinsOf(s) ?? [], 0.5) },
  'ik.clearPins': ({ character }) => ({ characterId: character.id }),
  'ik.setPin': (s) =>
    pinsOf(s) && {
      characterId: s.character.id,
      pin: s.dice.pick(pinsOf(s) ?? []),
      weight: s.dice.pick([undefined, 2]),
      holdsOrientation: s.dice.is(0.5),
    },
  'ik.setStiffness': ({ dice, character }) => ({
    characterId: character.id,
    joints: dice.some([...(character.skeleton?.joints.keys() ?? [])], 0.3),
    stiffness: dice.pick(['locked', 'usual', 4]),
  }),
  'sets.add': ({ dice, character }) =>
    character.skeleton && {
      characterId: character.id,
      name: dice.pick(['arms', 'legs']),
      color: dice.pick([undefined, '#4a90e2']),
      joints: [dice.below(character.skeleton.joints.length), 0],
    },
  'sets.change': ({ dice, character }) =>
    character.sets?.sets.length
      ? {
          characterId: character.id,
          set: dice.below(character.sets.sets.length),
          name: dice.pick([undefined, 'spine']),
          color: dice.pick([undefined, '', 'red']),
          joints: dice.pick([undefined, [0]]),
        }
      : undefined,
  'sets.remove': ({ dice, character }) =>
    character.sets?.sets.length
      ? { characterId: character.id, set: dice.below(character.sets.sets.length) }
      : undefined,
  'dofs.setLocked': ({ dice, character }) => ({
    characterId: character.id,
    dofs: dice.some([...characterDofs(character.skeleton, []).keys()], 0.2),
    locked: dice.is(0.6),
  }),
  'ik.move': ({ dice, character }) => ({
    characterId: character.id,
    joint: dice.below(character.skeleton?.joints.length ?? 1),
    to: [dice.below(3) - 1, dice.below(3), dice.below(3) - 1],
    reach: dice.pick([undefined, 'limb', 'chain', 'body'] as const),
    timeSeconds: time(dice),
    ...autoKey(dice),
  }),
  'path.moveKey': ({ dice, character }) => ({
    characterId: character.id,
    joint: dice.below(character.skeleton?.joints.length ?? 1),
    to: [dice.below(3) - 1, dice.below(3), dice.below(3) - 1],
    timeSeconds: dice.below(3),
  }),
  'ik.setRootFree': ({ dice, character }) => ({ characterId: character.id, isFree: dice.is(0.7) }),
  'hold.pins': (s) =>
    pinsOf(s) && {
      characterId: s.character.id,
      pins: pinsOf(s),
      range: range(s.dice),
      atSeconds: time(s.dice),
      framesPerSecond: s.dice.pick([4, 8]),
      easeSeconds: s.dice.pick([0, 0.25]),
    },
  'take.create': ({ dice, character }) => ({ characterId: character.id, range: range(dice) }),
  'take.rename': ({ dice, character }) => ({ characterId: character.id, name: dice.pick(['walk', 'run', 'sting']) }),
  'take.duplicate': ({ character }) => (character.takes.length < 4 ? { characterId: character.id } : undefined),
  'take.remove': ({ character }) => (character.takes.length > 1 ? { characterId: character.id } : undefined),
  'take.setRange': ({ dice, character }) => ({ characterId: character.id, range: range(dice) }),
  'skeleton.setLimit': ({ dice, character }) => ({
    characterId: character.id,
    dof: dice.below(16),
    min: -dice.number(),
    max: dice.number(),
  }),
  'skeleton.clearLimit': ({ dice, character }) => ({ characterId: character.id, dof: dice.below(16) }),
  'character.rename': ({ dice, character }) => ({ characterId: character.id, name: dice.pick(['wasp', 'bee', 'fly']) }),
  'character.showTake': ({ dice, character }) => ({
    characterId: character.id,
    take: dice.is(0.1) ? -1 : dice.below(character.takes.length),
  }),
  'character.setTimeOffset': ({ dice, character }) => ({ characterId: character.id, seconds: seconds(dice) }),
  'takes.show': ({ dice, character }) => ({
    takes: [{ characterId: character.id, take: dice.below(character.takes.length + 1) - 1 }],
    alone: dice.is(0.5),
  }),
  'takes.alignStarts': ({ dice, character }) => ({
    characterIds: [character.id],
    atSeconds: dice.is(0.5) ? seconds(dice) : undefined,
  }),
  'takes.setTimeOffsets': ({ dice, character }) => ({ characterIds: [character.id], seconds: seconds(dice) }),
  'attach.add': ({ dice, character, others }) => {
    if (others.length === 0) return undefined;
    const leader = dice.pick(others);
    const joint = dice.below(leader.skeleton?.joints.length ?? 0);
    return { characterId: character.id, leaderId: leader.id, joint, span: range(dice) };
  },
  'attach.change': (s) => ofAttachment(s, { span: range(s.dice) }),
  'attach.remove': (s) => ofAttachment(s, {}),
  'attach.putDown': (s) => ofAttachment(s, { timeSeconds: time(s.dice) }),
  'layers.add': ({ dice, character }) => ({
    characterId: character.id,
    mode: dice.pick(['additive', 'override', undefined] as const),
    joints: dice.is(0.7) ? undefined : [dice.below(character.skeleton?.joints.length ?? 0)],
  }),
  // Rarely, so that there are several to be moved.
  'layers.remove': (s) => (s.dice.is(0.4) ? ofLayer(s, {}) : undefined),
  'layers.rename': (s) => ofLayer(s, { name: s.dice.pick(['arm', 'face', 'layer']) }),
  'layers.set': (s) =>
    ofLayer(s, { weight: s.dice.pick([undefined, 0, 0.5, 1]), mute: s.dice.is(0.3), solo: s.dice.is(0.2) }),
  'layers.keyWeight': (s) => ofLayer(s, { timeSeconds: time(s.dice), weight: s.dice.pick([0, 0.5, 1]) }),
  'layers.move': (s) => ofLayer(s, { to: s.dice.below(s.take.layers?.list.length ?? 1) }),
  'layers.activate': (s) => ofLayer(s, {}),
  'layers.mergeDown': (s) => (s.dice.is(0.4) ? ofLayer(s, {}) : undefined),
  'layers.flatten': ({ dice, character, take }) =>
    take.layers && dice.is(0.3) ? { characterId: character.id } : undefined,
  'limbs.add': (s) => {
    const joints = chainIn(s);
    return joints && { characterId: s.character.id, joints, orient: s.dice.is(0.5) };
  },
  // Rarely, so that there are some to be keyed.
  'limbs.remove': (s) => {
    const { dice, character } = s;
    return character.limbs?.list.length && dice.is(0.3) ? { characterId: character.id, limb: 0 } : undefined;
  },
  'limbs.change': ({ dice, character }) =>
    character.limbs?.list.length
      ? { characterId: character.id, limb: 0, name: dice.pick(['leg', 'arm']), orient: dice.is(0.5) }
      : undefined,
  'limbs.key': (s) =>
    ofLimb(s, {
      goal: s.dice.is(0.5) ? [value(s.dice), value(s.dice), value(s.dice), 0, 0.3, 0] : undefined,
      blend: s.dice.pick([undefined, 0, 0.5, 1]),
      space: s.dice.pick([undefined, undefined, 'world', 'parent']),
    }),
  'limbs.switch': (s) => ofLimb(s, { to: s.dice.pick(['ik', 'fk']) }),
  'limbs.setSpace': (s) => ofLimb(s, { space: s.dice.pick(['world', 'parent']) }),
  'limbs.flatten': ({ dice, character, take }) =>
    take.goals && dice.is(0.3) ? { characterId: character.id } : undefined,
  'markers.add': ({ dice, character }) => {
    const [timeSeconds, endSeconds] = range(dice);
    const marker = { timeSeconds, label: dice.pick(['step', 'turn', '']) };
    return { characterId: character.id, markers: [dice.is(0.5) ? marker : { ...marker, endSeconds }] };
  },
  'markers.change': ({ dice, character, take }) =>
    take.markers && {
      characterId: character.id,
      index: dice.below(take.markers.length),
      marker: { timeSeconds: time(dice), label: 'moved' },
    },
  'markers.remove': ({ dice, character, take }) =>
    take.markers && { characterId: character.id, indices: [dice.below(take.markers.length)] },
  'takes.lockFeet': ({ dice, others }) => {
    const onLegs = others.find(
      ({ skeleton, takes }) => takes.length && skeleton?.joints.some(({ name }) => /Toe/.test(name)),
    );
    return onLegs && { takes: someTakes(dice, onLegs), easeSeconds: dice.number() / 2 };
  },
  'takes.makeLoop': ({ dice, character }) =>
    character.takes.length ? { takes: someTakes(dice, character), blendSeconds: dice.number() } : undefined,
  'takes.setSpeed': ({ dice, character }) =>
    character.takes.length ? { takes: someTakes(dice, character), factor: dice.pick([0.5, 0.8, 2]) } : undefined,
  'takes.join': ({ dice, character }) =>
    character.takes.length > 1 && character.takes.length < 4
      ? { takes: [1, 0].map((take) => ({ characterId: character.id, take })), overlapSeconds: dice.number() }
      : undefined,
  'takes.cutOut': ({ dice, others }) => {
    const captured = others.find(({ takes }) => takes[0]?.samples);
    const samples = captured?.takes[0].samples;
    if (!captured || !samples) return undefined;
    const length = (samples.frameCount - 1) * samples.frameSeconds;
    const from = samples.startSeconds + (dice.number() * length) / 2;
    const align = dice.pick(['root', 'foot', 'none'] as const);
    const refs = [{ characterId: captured.id, take: 0 }];
    return { takes: refs, from, to: from + dice.number() * length, align, overlapSeconds: dice.number() / 4 };
  },
  'takes.insert': ({ dice, character, others }) => {
    // Only captures take what is inserted; the others say why not.
    const captured = others.find(({ takes }) => takes[0]?.samples);
    const own = character.takes.length ? someTakes(dice, character)[0] : undefined;
    const into = captured && dice.is(0.5) ? { characterId: captured.id, take: 0 } : own;
    return into && { into, atSeconds: time(dice), holdSeconds: dice.number() };
  },
  'takes.mirror': ({ dice, character }) => (character.takes.length ? { takes: someTakes(dice, character) } : undefined),
  'review.add': ({ dice }) => ({ paths: dice.some(REVIEWED, 0.5) }),
  'review.remove': ({ dice }) => ({ paths: dice.some(REVIEWED, 0.3) }),
  'review.set': ({ dice }) => ({
    paths: dice.some(REVIEWED, 0.5),
    review: { verdict: dice.pick(['good', 'bad', ''] as const), stars: dice.below(6), tags: dice.some(REVIEWED, 0.3) },
  }),
  'review.read': ({ dice }) => ({
    takes: dice.some(REVIEWED, 0.5).map((path) => ({ path, ...NO_REVIEW, stars: dice.below(6), notes: path })),
  }),
  'takes.remove': ({ character }) =>
    character.takes.length > 1 ? { takes: [{ characterId: character.id, take: 0 }] } : undefined,
  'retarget.set': ({ dice, character, others }) =>
    others.length > 0
      ? {
          characterId: character.id,
          sourceId: dice.pick(others).id,
          options: { reference: dice.pick(['automatic', 'rest', time(dice)]), plantsFeet: dice.is(0.5) },
        }
      : undefined,
  'retarget.change': ({ dice, character }) =>
    character.driver && {
      characterId: character.id,
      pairs: dice.is(0.5) ? [{ target: dice.below(5), source: dice.below(2) }] : undefined,
      options: { scale: dice.is(0.5) ? undefined : dice.number() + 0.1 },
    },
  'retarget.clear': ({ dice, character }) =>
    character.driver && dice.is(0.6) ? { characterId: character.id } : undefined,
  'retarget.bake': ({ dice, character }) =>
    character.driver && character.takes.length < 4 && dice.is(0.3)
      ? { characterId: character.id, framesPerSecond: dice.pick([2, 5]) }
      : undefined,
  'keys.insert': (s) => ({ characterId: s.character.id, channels: channels(s), timeSeconds: time(s.dice) }),
  'keys.add': ({ dice, character, take }) => ({
    characterId: character.id,
    channel: dice.below(take.channels.length),
    timeSeconds: time(dice),
    value: value(dice),
  }),
  'keys.move': (s) => ({
    ...of(s),
    seconds: s.dice.is(0.3) ? 0 : seconds(s.dice),
    values: s.dice.is(0.4) ? undefined : s.keys.map(() => value(s.dice)),
    onCollision: onCollision(s.dice),
  }),
  'keys.scale': (s) => ({
    ...of(s),
    pivotSeconds: time(s.dice),
    timeFactor: s.dice.pick([1, 2, 0.5, -1, -2, 0]),
    valueFactor: s.dice.pick([1, 2, -1, 0, 0.1]),
    pivotValues: s.dice.is(0.5) ? undefined : s.keys.map(() => value(s.dice)),
    onCollision: onCollision(s.dice),
  }),
  'keys.set': (s) => ({
    ...of(s),
    ...(s.dice.is(0.4) && { timeSeconds: time(s.dice) }),
    ...(s.dice.is(0.4) && { value: value(s.dice) }),
    ...(s.dice.is(0.3) && { slopeIn: value(s.dice) }),
    ...(s.dice.is(0.3) && { slopeOut: value(s.dice) }),
  }),
  'keys.tween': (s) => ({ ...of(s), u: value(s.dice) }),
  'keys.relax': (s) => ({ ...of(s), amount: value(s.dice) }),
  'keys.ease': (s) => ({ ...of(s), amount: value(s.dice) }),
  'keys.snap': (s) => ({
    ...of(s),
    framesPerSecond: s.dice.pick([4, 30]),
    offsetSeconds: s.dice.is(0.5) ? seconds(s.dice) : undefined,
  }),
  'keys.remove': (s) => ({ ...of(s), timeSeconds: time(s.dice) }),
  'keys.ripple': (s) => ({ ...of(s), seconds: seconds(s.dice) }),
  'keys.setTangents': (s) => ({ ...of(s), side: side(s.dice), kind: s.dice.pick([...TANGENT_KINDS, 'step']) }),
  'keys.setSlopes': (s) => ({ ...of(s), side: side(s.dice), slope: value(s.dice) }),
  'keys.unify': of,
  'keys.break': of,
  'keys.paste': (s) => ({
    characterId: s.character.id,
    copied: copyKeys(s.take, s.keys),
    timeSeconds: time(s.dice),
    into: s.dice.is(0.5) ? undefined : channels(s),
    mode: s.dice.pick(['merge', 'replace', 'insert']),
  }),
  'channels.simplify': (s) => ({
    characterId: s.character.id,
    channels: channels(s),
    tolerance: s.dice.is(0.5)
      ? s.dice.number()
      : { angle: s.dice.number(), length: s.dice.number(), weight: s.dice.number() },
    range: s.dice.is(0.5) ? range(s.dice) : undefined,
  }),
  'channels.resample': (s) => {
    const [from, to] = range(s.dice);
    const framesPerSecond = s.dice.pick([2, 5]);
    const tangents = s.dice.pick(['smooth', 'linear']);
    const offsetSeconds = s.dice.is(0.5) ? seconds(s.dice) : undefined;
    return { characterId: s.character.id, channels: channels(s), framesPerSecond, offsetSeconds, from, to, tangents };
  },
  'channels.eulerFilter': (s) => ({ characterId: s.character.id, channels: channels(s, 0.9) }),
  'channels.bakeExtrapolation': (s) => {
    const [from, to] = range(s.dice);
    return { characterId: s.character.id, channels: channels(s), from, to };
  },
  'channels.makeLoop': (s) => ({ characterId: s.character.id, channels: channels(s), keepOffset: s.dice.is(0.5) }),
  'samples.crop': ({ dice, character }) => {
    const [from, to] = range(dice);
    return { characterId: character.id, from, to };
  },
  'samples.trim': ({ dice, character }) => ({
    characterId: character.id,
    side: dice.pick(['start', 'end']),
    timeSeconds: time(dice),
  }),
  'samples.split': ({ dice, character }) =>
    character.takes.length < 4 ? { characterId: character.id, timeSeconds: time(dice) } : undefined,
  'samples.resample': ({ dice, character }) => ({ characterId: character.id, framesPerSecond: dice.pick([5, 8, 12]) }),
  'samples.reverse': ({ character }) => ({ characterId: character.id }),
  'samples.smooth': (s) => ({
    characterId: s.character.id,
    channels: s.dice.is(0.5) ? undefined : channels(s),
    ...(s.dice.is(0.5)
      ? { filter: 'median', frames: s.dice.pick([3, 5, 7]) }
      : { sigmaSeconds: s.dice.number() / 4 + 0.01 }),
    range: s.dice.is(0.5) ? range(s.dice) : undefined,
  }),
  'samples.convertToKeys': (s) => ({
    characterId: s.character.id,
    channels: channels(s),
    tolerance: { position: s.dice.number() + 0.01, angle: s.dice.number() + 0.01 },
  }),
  'channels.setExtrapolation': (s) => ({
    characterId: s.character.id,
    channels: channels(s),
    side: side(s.dice),
    extrapolation: s.dice.pick(EXTRAPOLATIONS),
  }),
  ...Object.fromEntries(
    RIG_COMMANDS.map((id) => [
      id,
      ({ dice, character }: Situation) => rigArguments(id, character, dice, { characterId: character.id }),
    ]),
  ),
  'rig.create': ({ dice, others }) => (others.length < 4 ? { name: dice.pick(['ant', undefined]) } : undefined),
  'skin.autoWeights': ({ dice, character }) => ({
    characterId: character.id,
    skin: dice.below(character.skins.length),
    timeSeconds: time(dice),
    bind: dice.pick([undefined, 'file']),
    mostInfluences: 1 + dice.below(4),
  }),
  'character.remove': ({ others }) => (others.length > 2 ? { characterId: others.at(-1)?.id } : undefined),
  'character.showSkin': ({ dice, character }) => ({
    characterId: character.id,
    skin: dice.below(character.skins.length),
  }),
  'character.place': ({ dice, character }) => ({
    characterId: character.id,
    index: dice.below(character.placements.length),
    placement: placement(dice),
  }),
  'character.addCopy': ({ dice, character }) =>
    character.placements.length < 4 ? { characterId: character.id, placement: placement(dice) } : undefined,
  'character.removeCopy': ({ dice, character }) => ({
    characterId: character.id,
    index: dice.below(character.placements.length),
  }),
  'characters.sameHeight': ({ dice, character, others }) => ({
    characterIds: dice.some([character, ...others].map(({ id }) => id)),
    like: character.id,
  }),
  'characters.sameUnit': ({ dice, character, others }) => ({
    characterIds: dice.some([character, ...others].map(({ id }) => id)),
    like: character.id,
  }),
  'characters.ownHeights': ({ dice, character, others }) => ({
    characterIds: dice.some([character, ...others].map(({ id }) => id)),
  }),
  'character.setSpace': ({ dice, character }) => ({
    characterId: character.id,
    space: { up: dice.pick(['y', 'z']), unit: dice.pick(['asIs', 'inches']), lift: dice.below(2) },
    ofSkeleton: dice.is(0.5),
  }),
  'character.setHidden': ({ dice, character, others }) => ({
    ids: dice.some([character, ...others].map(({ id }) => id)),
    hidden: dice.is(0.5),
  }),
  'take.setInterpolation': ({ dice, character }) => ({
    characterId: character.id,
    interpolation: dice.pick(INTERPOLATIONS),
  }),
  'skeleton.setPositionChannels': ({ dice, others }) => ({
    characterId: others.find(isBvh)?.id,
    positions: dice.pick(['replace', 'add']),
  }),
  'takes.arrange': ({ dice, character, others }) => ({
    characterIds: dice.some([character, ...others].map(({ id }) => id)),
    how: dice.pick(ARRANGEMENTS),
  }),
  'takes.overlay': ({ dice, character, others }) => ({
    first: anyTake(dice, character),
    second: anyTake(dice, dice.pick([character, ...others])),
  }),
  'takes.endOverlay': ({ dice, character, others }) => {
    const overlaid = [character, ...others];
    const before = overlaid.map((c) => ({ ...c, placements: [placement(dice)], shownTake: anyTake(dice, c).take }));
    return { before, overlaid };
  },
};

export const COMMANDS_HERE: readonly string[] = Object.keys(ARGUMENTS);

/** Done less often: keys are what matters, and each of these leads to a take without any, or with others. */
const OFTEN = COMMANDS_HERE.filter((id) =>
  /^(keys|channels|samples|retarget|ik\.pin|hold|pose\.(key|setDofs|dropUnkeyed))/.test(id),
);

/** One of the commands, by chance. */
export const anyCommand = fc.oneof(
  { weight: 4, arbitrary: fc.constantFrom(...OFTEN) },
  { weight: 1, arbitrary: fc.constantFrom(...COMMANDS_HERE) },
);

/** One character's situation; commands that need keys or a take get those of a take without keys if there is none. */
export function argumentsFor(id: string, store: Store, dice: Dice): object | undefined {
  const [character, ...others] = store.document.characters;
  const take = shownTake(character) ?? { name: 'none', range: [0, 1], channels: [] };
  return ARGUMENTS[id]?.({ dice, character, others, take, keys: keysFor(store, take, dice) });
}

/** Usually the selected keys, else any. */
export function keysFor({ selection }: Store, take: Take, dice: Dice): readonly ChannelKeys[] {
  return selection.keys && dice.is(0.7) ? selection.keys : someKeys(take, dice);
}

export function someKeys(take: Take, dice: Dice): readonly ChannelKeys[] {
  const share = dice.number();
  return allKeys(take)
    .filter(() => dice.is(0.4))
    .map(({ channel, indices }) => ({ channel, indices: dice.some(indices, share) }))
    .filter(({ indices }) => indices.length > 0);
}
