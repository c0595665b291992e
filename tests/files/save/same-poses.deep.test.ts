/**
 * A saved file is what was shown: whatever is done to a character, its files, read again, move joints and vertices as
 * before, and are written as the same bytes.
 */
import { env } from 'node:process';
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { ALL_COMMANDS } from '../../../src/edit/commands/all.ts';
import { Store } from '../../../src/edit/store.ts';
import { framesFor } from '../../../src/evaluate/bvh-capture.ts';
import { KINDS } from '../../../src/files/kinds.ts';
import { type SavedFile, savedFileOf } from '../../../src/files/save/output.ts';
import { jointPose } from '../../../src/files/save/saved-poses.ts';
import { writeParts } from '../../../src/files/save/saving.ts';
import { partsOf } from '../../../src/model/character-parts.ts';
import { type Character, type Document, isBvh } from '../../../src/model/document.ts';
import type { FileContent, WholeCharacter } from '../../../src/model/files.ts';
import type { Morph } from '../../../src/model/morph.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Skin } from '../../../src/model/skin.ts';
import { restChannel, type Take } from '../../../src/model/takes/take.ts';
import { anyCommand, argumentsFor, COMMANDS_HERE } from '../../edit/any-command.ts';
import { Dice, thrown } from '../../edit/dice.ts';
import { randomDocument, seeds } from '../../edit/rig/random-rig.ts';
import { read } from '../../formats/read-in-pieces.ts';
import { farthest, posed } from '../../helpers/posed.ts';
import { writeFile } from '../../helpers/write-file.ts';

/** Documents; more by MARROW_DOCUMENTS, together with MARROW_SEED=random. */
const DOCUMENTS = Number(env.MARROW_DOCUMENTS ?? 60);

/** Of the size of the character: degrees and radians are converted, and positions added to offsets. */
const CLOSE = 1e-9;

const TIMES = [-1, 0, 0.3, 0.5, 1, 1.7, 2.5];

function edited(document: Document, commands: readonly (readonly [string, readonly number[]])[]): Document {
  const store = new Store(document);
  store.select({ characterId: 'c1', joint: 0 });
  for (const [id, throws] of commands) {
    const command = ALL_COMMANDS.get(id);
    const args = command && argumentsFor(id, store, new Dice(throws));
    try {
      // By name and with arguments made up: as from the console.
      if (command && args) store.apply(command, args as never);
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
    }
  }
  return store.document;
}

/** A document whose takes all have channels: others can't be written. */
function withChannels(seed: number): Document {
  const document = randomDocument(seed);
  const characters = document.characters.map((character) => ({
    ...character,
    takes: character.takes.map((take) => (take.channels.length ? take : { ...take, channels: [restChannel()] })),
  }));
  return { ...document, characters };
}

/** The file read again; it is written as the same bytes. */
function again({ name, text }: SavedFile): FileContent {
  const { value, diagnostics } = read(name, text);
  if (!value) throw new Error(`${name} can't be read: ${JSON.stringify(diagnostics)}\n${text}`);
  expect(writeFile(value, name)?.text).toBe(text);
  return value;
}

interface Saved {
  readonly skeleton?: Skeleton;
  readonly skins: readonly Skin[];
  readonly morphs: readonly Morph[];
  readonly takes: readonly Take[];
}

/** A character as its own files have it. */
function savedAndRead(character: Character): Saved {
  const pose = jointPose(character);
  const saved = partsOf(character).map((part) =>
    again(savedFileOf(writeParts(`x.${KINDS[part.kind].extensions[0]}`, [{ character, part, pose }]))),
  );
  const captures = saved.flatMap((content) => (content.kind === 'bvh' ? content.captures : []));
  const skeletons = saved.flatMap((content) => (content.kind === 'skel' ? content.skeletons : []));
  const skeleton = skeletons[0] ?? captures[0]?.skeleton;
  return {
    ...(skeleton && { skeleton }),
    skins: saved.flatMap((content) => (content.kind === 'skin' ? [content.skin] : [])),
    morphs: saved.flatMap((content) => (content.kind === 'morph' ? [content.morph] : [])),
    takes: [
      ...captures.flatMap(({ take }) => take ?? []),
      ...saved.flatMap((content) => (content.kind === 'anim' ? [content.take] : [])),
    ],
  };
}

/** As saving sees it: in the pose as set. */
function asSet(character: Character): WholeCharacter | undefined {
  const { skeleton, skins, morphs, takes, textures } = character;
  if (!skeleton) return undefined;
  const pose = jointPose(character);
  let start = 0;
  const joints = skeleton.joints.map((joint) => {
    const own = pose.slice(start, start + joint.pose.length);
    start += joint.pose.length;
    return { ...joint, pose: own };
  });
  // A .bvh has no weights of morphs.
  return { skeleton: { ...skeleton, joints }, skins, morphs: isBvh(character) ? [] : morphs, takes, textures };
}

/** The second of a take at the first frame of its .bvh. */
function startOf(character: Character, take: number): number {
  const { driver: _, ...own } = character;
  return framesFor({ ...own, shownTake: take }, 30).startSeconds;
}

function expectSamePoses(character: Character): void {
  const shown = asSet(character);
  if (!shown) return;
  const { skeleton, ...parts } = savedAndRead(character);
  if (!skeleton) throw new Error('The skeleton was not saved.');
  const found: WholeCharacter = { ...shown, ...parts, skeleton, ...(isBvh(character) && { morphs: [] }) };
  // A .bvh has no pose beside its take.
  const takes = isBvh(character) && shown.takes.length > 0 ? [...shown.takes.keys()] : [-1, ...shown.takes.keys()];
  const { clampsToLimits } = character;
  // Neither root translation nor weights are in a .skel; a .bvh has both in its frames, but for the weights.
  const whole = character.pose.slice(0, filePose(shown.skeleton, 0).length);
  const pose = isBvh(character) ? whole : filePose(shown.skeleton, shown.morphs.length);
  for (const index of takes) {
    const take = shown.takes[index];
    // Keys of motion capture are sampled, and samples of a .skel are keyed: the same at the frames that were written.
    const samples = isBvh(character) ? found.takes[index]?.samples : take?.samples;
    const times = samples
      ? Array.from(
          { length: Math.min(6, samples.frameCount) },
          (_, f) => samples.startSeconds + f * samples.frameSeconds,
        )
      : index < 0
        ? [0]
        : TIMES;
    for (const time of times) {
      // A .bvh starts at 0.
      const from = isBvh(character) && samples && take ? time - samples.startSeconds + startOf(character, index) : time;
      // A pose that a .bvh can hold only as a frame.
      const takeFound = index < 0 && isBvh(character) ? found.takes.length - 1 : index;
      const distance = farthest(
        posed(found, takeFound, time, { clampsToLimits }),
        posed(shown, index, from, { clampsToLimits, pose }),
      );
      if (!(distance < CLOSE)) {
        throw new Error(
          `${take?.name ?? 'The pose'} differs by ${distance} at ${time} s after ${skeleton.joints.map(({ motion }) => motion.kind)}.`,
        );
      }
    }
  }
}

it('whatever is done to a character, its files read again move joints and vertices as before', {
  timeout: 3_600_000,
}, () => {
  const rigging = COMMANDS_HERE.filter((id) => /^(rig|skeleton|poses?)\./.test(id));
  const command = fc.oneof(fc.constantFrom(...rigging), fc.constantFrom(...COMMANDS_HERE), anyCommand);
  const commands = fc.array(fc.tuple(command, thrown), { maxLength: 4 });
  fc.assert(
    fc.property(seeds, commands, (seed, all) => {
      for (const { takes, ...character } of edited(withChannels(seed), all).characters) {
        // A take that lost all its channels with the DOFs of a joint can't be written, which is said.
        expectSamePoses({ ...character, takes: takes.filter(({ channels }) => channels.length > 0) });
      }
    }),
    { numRuns: DOCUMENTS },
  );
});
