import { expect, it } from 'vitest';
import { Keeper } from '../../../src/app/autosave/keeper.ts';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { readSession } from '../../../src/app/autosave/restore.ts';
import { addAttachment } from '../../../src/edit/commands/beside/attach.ts';
import { removeCharacter } from '../../../src/edit/commands/characters.ts';
import { setRetarget } from '../../../src/edit/commands/retarget.ts';
import { cropSamples } from '../../../src/edit/commands/samples.ts';
import { DEFAULT_PLAYBACK } from '../../../src/edit/playback.ts';
import { Store } from '../../../src/edit/store.ts';
import { provideDrivenPose } from '../../../src/evaluate/driven-pose.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { type Character, type Document, EMPTY_DOCUMENT, shownTake } from '../../../src/model/document.ts';
import { NOTHING_SELECTED } from '../../../src/model/session.ts';
import { DEFAULT_TIMELINE_VIEW } from '../../../src/ui/state/timeline.ts';
import { parse } from '../../../src/worker/parse.ts';
import type { GivenBlob } from '../../../src/worker/protocol.ts';
import { bvhJoint, captureOf } from '../../helpers/bvh.ts';
import { writeBvh } from '../../helpers/bvh-text.ts';
import { memoryStore } from './memory-store.ts';

/** Hips and a nodding head, in two files: one is retargeted to the other. */
const skeleton = (name: string) => ({
  name,
  joints: [
    { ...bvhJoint(-1, ['tx', 'ty', 'tz', 'rx', 'ry', 'rz']), name: 'Hips' },
    { ...bvhJoint(0, ['rx', 'ry', 'rz'], { endSites: [[0, 1, 0]] }), name: 'Head' },
  ],
});
const file = (name: string, nod: number): GivenBlob => {
  const rows = Array.from({ length: 200 }, (_, f) => [0, 1, 0, 0, 0, 0, nod * Math.sin(f / 9), 0, 0]);
  return { path: `${name}.bvh`, blob: new Blob([writeBvh([captureOf(skeleton(name), rows)]).text]) };
};
const FILES = [file('dancer', 30), file('other', 0)];

const read = async (files: readonly GivenBlob[]) => structuredClone(await parse({ files }, () => undefined));
const worker = { run: (_job: 'parse', { files }: { files: readonly GivenBlob[] }) => read(files) };

/** The document after reloading the page. */
async function reloaded(document: Document, origins: Origins): Promise<Document> {
  const store = memoryStore();
  const camera = { target: [0, 1, 0], azimuth: 0.5, polar: 1, distance: 3 } as const;
  const rest = { selection: NOTHING_SELECTED, transport: DEFAULT_PLAYBACK, timeline: DEFAULT_TIMELINE_VIEW, camera };
  await new Keeper('s', store, origins).save({ document, ...rest }, 1);
  const reading = { signal: new AbortController().signal, onProgress: () => undefined };
  return (await readSession('s', store, worker, new Origins(1000), reading)).state.document;
}

const poseOf = (character: Character, seconds: number) => {
  const dofs = new Float64Array(dofCountOf(character));
  poseAt(character, seconds, dofs);
  return [...dofs];
};

it('restores a retargeted character, which still follows edits of its source', async () => {
  const origins = new Origins();
  const { files } = await read(FILES);
  origins.learn(FILES, files);
  const page = new Store();
  page.replace('Open', openFiles(EMPTY_DOCUMENT, files));
  const [dancer, other] = page.document.characters;
  page.apply(setRetarget, { characterId: other.id, sourceId: dancer.id });

  const next = new Store();
  next.replace('Restore', await reloaded(page.document, origins));
  const [source, driven] = next.document.characters;
  const seconds = (shownTake(source)?.range[1] ?? 0) * 0.3;
  expect(poseOf(driven, seconds)).toEqual(poseOf(page.document.characters[1], seconds));
  expect(poseOf(driven, seconds).some((v) => Math.abs(v) > 0.05 && v !== 1)).toBe(true);
  // Not a copy: the same skeleton and samples, stored once.
  expect(driven.driver?.source.skeleton).toBe(source.skeleton);
  expect(driven.driver?.source.take).toBe(shownTake(source));

  next.apply(cropSamples, { characterId: source.id, from: seconds, to: 2 * seconds });
  const [cropped, following] = next.document.characters;
  expect(shownTake(cropped)?.range).not.toEqual(shownTake(source)?.range);
  expect(following.driver?.source.take).toBe(shownTake(cropped));
});

it('restores a character that follows a retargeted one, removed meanwhile', async () => {
  const origins = new Origins();
  const given = [...FILES, file('sword', 0)];
  const { files } = await read(given);
  origins.learn(given, files);
  const page = new Store();
  page.replace('Open', openFiles(EMPTY_DOCUMENT, files));
  const [dancer, other, sword] = page.document.characters;
  page.apply(setRetarget, { characterId: other.id, sourceId: dancer.id });
  page.apply(addAttachment, { characterId: sword.id, leaderId: other.id, joint: 1, span: [0, 2] });
  page.apply(removeCharacter, { characterId: other.id });
  const [, held] = page.document.characters;
  const expected = poseOf(held, 1);
  // As in a page that has loaded no code of retargeting.
  provideDrivenPose(() => {
    throw new Error('not provided');
  });
  const [, follower] = (await reloaded(page.document, origins)).characters;
  expect(poseOf(follower, 1)).toEqual(expected);
});
