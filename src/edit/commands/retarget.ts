/**
 * Retargeting takes to other characters: live, or baked into a take of the character's own.
 *
 * Live, only the mapping between the skeletons is stored: the source's take can still be edited, and the target
 * follows. Baking samples what is displayed.
 */

import { bakeTake, framesOf } from '../../evaluate/bake.ts';
import { provideRetargeting } from '../../evaluate/retarget/driving.ts';
import { automaticPairs } from '../../evaluate/retarget/match.ts';
import { movedDofs } from '../../evaluate/retarget/moved-dofs.ts';
import { frameRateOf } from '../../evaluate/samples/frame-rate.ts';
import type { Character, Driver } from '../../model/document.ts';
import { restPose } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { DEFAULT_RETARGET, type JointPair, type RetargetOptions } from '../../model/takes/retarget.ts';
import type { Samples } from '../../model/takes/samples.ts';
import { SAMPLED } from '../../model/takes/take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName, SHORT_NAME } from '../cut-name.ts';
import { sameValue } from '../delta.ts';
import { withoutDriver } from '../drivers.ts';
import { follows } from '../follow/leaders.ts';
import { driverSource, provideSources } from '../follow/sources.ts';
import { retimed } from '../markers.ts';
import { refuseTooMany } from '../samples/most-frames.ts';
import { jointRotations, unrollTriples } from '../samples/rotations.ts';
import { boolean, either, index, list, number, oneOf, optional, record, type Shape, text } from '../schema/shape.ts';
import { CHARACTER } from '../schema/shared-shapes.ts';
import { characterIn } from '../step-names.ts';
import { takeNameOf, uniqueTakeName } from '../takes.ts';
import { unkeyedAt, withoutUnkeyed, withUnkeyed } from '../unkeyed.ts';

const PAIRS = { pairs: optional(list(record({ target: index, source: index }))) } as const;
const options: Shape<Partial<RetargetOptions>> = record({
  scale: optional(number),
  reference: optional(either(oneOf(['automatic', 'rest']), number)),
  plantsFeet: optional(boolean),
});
const OPTIONS = { options: optional(options) } as const;

/**
 * Retargets another character's shown take live; without `pairs`, joints are matched by name and shape. Refuses a
 * source that is retargeted itself, or has no skeleton or take.
 */
export const setRetarget = command({
  id: 'retarget.set',
  args: {
    ...CHARACTER,
    /** The character whose shown take is retargeted. */
    sourceId: text,
    ...PAIRS,
    ...OPTIONS,
  },
  label: (document, { characterId, sourceId }) => {
    const source = requireCharacter(document, sourceId);
    return `Retarget ${takeOf(driverSource(source))} to ${characterIn(document, characterId, SHORT_NAME)}`;
  },
  run: (document, { characterId, sourceId, pairs, options }) => {
    const from = requireCharacter(document, sourceId);
    return changeCharacter(document, characterId, (c) => {
      if (from === c) throw new CommandError(`${c.name} can’t be retargeted from itself.`);
      if (!from.driver && follows(document, from, c.id))
        throw new CommandError(`${c.name} can’t be retargeted from ${from.name}, which follows it. Detach that first.`);
      return retargetedTo(c, from, pairs, options);
    });
  },
});

/**
 * The character, with another's shown take retargeted to it: for the page and the command alike. It keeps its own
 * takes: one of them may tell how its joints are meant to be rotated (`evaluate/retarget/reference.ts`).
 * @param pairs default: matched by name and shape
 * @throws CommandError
 */
export function retargetedTo(
  target: Character,
  from: Character,
  pairs?: readonly JointPair[],
  options?: Partial<RetargetOptions>,
): Character {
  const skeleton = requireSkeleton(target);
  if (from.driver)
    throw new CommandError(`${from.name} is itself retargeted from ${from.driver.source.name}. Bake that first.`);
  const source = driverSource(from);
  if (!source) throw new CommandError(`${from.name} needs a skeleton and a take to retarget from.`);
  const matched = pairs
    ? checkedPairs(pairs, skeleton, source.skeleton)
    : automaticPairs(source.skeleton, skeleton, source.space, target.space).map(({ target, source }) => ({
        target,
        source,
      }));
  const driver: Driver = {
    sourceId: from.id,
    source,
    pairs: matched,
    options: checkedOptions({ ...DEFAULT_RETARGET, ...options }),
  };
  return withDriver(withoutUnkeyed(target), driver);
}

/** Changes pairs or options; omitted ones are kept. */
export const changeRetarget = command({
  id: 'retarget.change',
  args: {
    ...CHARACTER,
    ...PAIRS,
    ...OPTIONS,
  },
  label: (document, { characterId }) => `Change retargeting of ${characterIn(document, characterId)}`,
  run: (document, { characterId, pairs, options }) =>
    changeCharacter(document, characterId, (c) => {
      const driver = requireDriver(c);
      if (!pairs && !options) throw new CommandError('Give "pairs" or "options" to change.');
      return withDriver(c, {
        ...driver,
        pairs: pairs ? checkedPairs(pairs, requireSkeleton(c), driver.source.skeleton) : driver.pairs,
        options: checkedOptions({ ...driver.options, ...options }),
      });
    }),
});

/** Back to the character's own take and pose; discards unkeyed changes made over the retargeted one. */
export const clearRetarget = command({
  id: 'retarget.clear',
  args: CHARACTER,
  label: (document, { characterId }) => {
    const { driver } = requireCharacter(document, characterId);
    return `Stop retargeting ${takeOf(driver?.source)} to ${characterIn(document, characterId, SHORT_NAME)}`;
  },
  run: (document, { characterId }) =>
    changeCharacter(document, characterId, (c) => {
      requireDriver(c);
      return withoutDriver(withoutUnkeyedOverTake(c));
    }),
});

/** Bakes what is displayed into a take of the character's own, shows it, and ends retargeting. */
export const bakeRetarget = command({
  id: 'retarget.bake',
  args: {
    ...CHARACTER,
    /** Default: the rate of the source's take, or 30 if it has none. */
    framesPerSecond: optional(number),
    /** Default: the character's and the source take's name, `walker_dance`. A name in use gets a number. */
    name: optional(text),
  },
  label: (document, { characterId }) => {
    const { driver } = requireCharacter(document, characterId);
    return `Bake ${takeOf(driver?.source)} into ${characterIn(document, characterId, SHORT_NAME)}`;
  },
  run: (document, { characterId, framesPerSecond, name }) =>
    changeCharacter(document, characterId, (c) => retargetBaked(c, framesPerSecond, name)),
});

/**
 * The character with what a retargeted take makes of it as a take of its own, which is shown, without the retargeting.
 * @param framesPerSecond default: the rate of the source's take, or 30 if it has none
 * @param name default: the character's and the source take's
 * @throws CommandError
 */
export function retargetBaked(c: Character, framesPerSecond?: number, name = ''): Character {
  const skeleton = requireSkeleton(c);
  const { take, timeOffsetSeconds } = requireDriver(c).source;
  const own = take.samples ? 1 / take.samples.frameSeconds : (frameRateOf(take) ?? 30);
  const rate = framesPerSecond ?? own;
  if (!(rate > 0)) throw new CommandError(`Frames per second must be greater than 0, found ${rate}.`);
  // Frames are baked at times of the source's take, and shifted to those of this character's take.
  const frames = framesOf(take.range, rate);
  const range = [take.range[0] - timeOffsetSeconds, take.range[1] - timeOffsetSeconds] as const;
  refuseTooMany(frames.frameCount, restPose(skeleton, c.morphs.length).length);
  const samples = { ...bakeTake(c, frames), startSeconds: range[0] };
  unrollRotations(skeleton, samples);
  const given = name.trim();
  const called = given ? uniqueTakeName(c, given) : takeNameOf(c, take.name);
  const channels = restPose(skeleton, c.morphs.length).map(() => SAMPLED);
  const plain = withoutDriver(withoutUnkeyed(c));
  const made = { name: called, range, channels, samples };
  const markers = retimed(take.markers, (seconds) => seconds - timeOffsetSeconds);
  return {
    ...plain,
    takes: [...plain.takes, withMarkers(made, markers)],
    shownTake: plain.takes.length,
  };
}

/** Unrolls angles so that they don't jump between equivalent forms, for readable curves. */
function unrollRotations(skeleton: Skeleton, { values, scales, frameCount }: Samples): void {
  const width = scales.length;
  for (const { channels } of jointRotations(skeleton)) {
    const column = (c: number) => Float64Array.from({ length: frameCount }, (_, f) => values[f * width + c]);
    const triple = [column(channels[0]), column(channels[1]), column(channels[2])] as const;
    unrollTriples(triple);
    triple.forEach((angles, i) => {
      for (let f = 0; f < frameCount; f++) values[f * width + channels[i]] = angles[f];
    });
  }
}

/** Discards unkeyed changes where retargeting drives the character, since they were made over that take. */
function withoutUnkeyedOverTake(character: Character): Character {
  const { unkeyed } = character;
  const moved = movedDofs(character);
  if (!unkeyed || !moved) return character;
  const left = [...unkeyedAt(character, unkeyed.timeSeconds)].filter(([dof]) => !moved.has(dof));
  return withUnkeyed(character, unkeyed.timeSeconds, new Map(left));
}

/** The same object if it has that driver already. */
function withDriver(character: Character, driver: Driver): Character {
  provideRetargeting();
  provideSources();
  return sameValue(driver, character.driver) ? character : { ...character, driver };
}

function requireSkeleton({ name, skeleton }: Character): Skeleton {
  if (!skeleton) throw new CommandError(`${name} has no skeleton to retarget to.`);
  return skeleton;
}

function requireDriver({ name, driver }: Character): Driver {
  if (!driver) throw new CommandError(`${name} is not retargeted.`);
  return driver;
}

function checkedPairs(pairs: readonly JointPair[], target: Skeleton, source: Skeleton): readonly JointPair[] {
  const checked = pairs.map((pair) => ({
    target: indexIn(pair.target, 0, target.joints.length, `joint of ${target.name}`),
    source: indexIn(pair.source, 0, source.joints.length, `joint of ${source.name}`),
  }));
  checked.sort((a, b) => a.target - b.target);
  const twice = checked.find((pair, i) => pair.target === checked[i + 1]?.target);
  if (twice) throw new CommandError(`${target.joints[twice.target].name} can only follow one joint.`);
  return checked;
}

/** Scale of ants to mountains; beyond it, positions are no longer finite. */
const LARGEST_SCALE = 1e9;

function checkedOptions({ scale, reference, plantsFeet }: RetargetOptions): RetargetOptions {
  if (scale !== undefined && !(scale > 0 && scale <= LARGEST_SCALE)) {
    throw new CommandError(`The scale must be greater than 0, and at most ${LARGEST_SCALE}, found ${scale}.`);
  }
  return { ...(scale !== undefined && { scale }), reference, plantsFeet };
}

function takeOf(source: { readonly take: { readonly name: string } } | undefined): string {
  return cutName(source?.take.name ?? 'take', SHORT_NAME);
}
