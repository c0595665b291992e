import { describe, expect, it } from 'vitest';
import { importFile } from '../../src/files/imports.ts';
import type { ParsedFile, WholeCharacter } from '../../src/model/files.ts';
import { trackedOf } from '../../src/model/takes/tracked-take.ts';
import { WorkerClient, type WorkerLike } from '../../src/worker/client.ts';
import { parse } from '../../src/worker/parse.ts';
import { partsOf } from '../../src/worker/parts.ts';
import { passageOf } from '../../src/worker/passage.ts';
import type { FromWorker } from '../../src/worker/protocol.ts';
import { fromMessage, settledTakes } from '../../src/worker/settled-takes.ts';
import { forMessage } from '../../src/worker/tracked-takes.ts';
import { chainGlb } from '../import/chain-glb.ts';

const SMALL = { joints: 4, takes: 5, keys: 12, vertices: 8 };

async function characterOf(content = SMALL): Promise<WholeCharacter> {
  const bytes = chainGlb(content);
  const { value } = await importFile('gltf', { fileName: 'a.glb', bytes, beside: async () => undefined });
  if (!value) throw new Error('It was not read.');
  return value.characters[0];
}

const charactersIn = (files: readonly ParsedFile[]) =>
  files.flatMap((file) => (file.kind === 'character' ? file.characters : []));
const isTracked = ({ takes }: WholeCharacter) => takes.map((take) => trackedOf(take) !== undefined);

describe('takes with tracks of quaternions, from worker to page', () => {
  it('only the shown one has channels on the page, until another is asked for its own', async () => {
    const blob = new Blob([chainGlb(SMALL)]);
    const worker: WorkerLike = {
      onmessage: null,
      onerror: null,
      onmessageerror: null,
      terminate: () => undefined,
      async postMessage({ id }) {
        const answer = (data: FromWorker) => worker.onmessage?.(new MessageEvent('message', { data }));
        const output = await parse({ files: [{ path: 'a.glb', blob }] }, () => undefined);
        for (const { part, transfer } of partsOf(output))
          answer({ id, kind: 'part', part: structuredClone(part, { transfer }) });
        answer({ id, kind: 'done', job: 'parse', output: { ...output, files: [], facts: [] } });
      },
    };
    const { files } = await new WorkerClient(() => worker).run('parse', { files: [] });
    const [received] = charactersIn(files);
    expect(isTracked(received)).toEqual([false, true, true, true, true]);
    expect(received).toStrictEqual(await characterOf());
    expect(isTracked(received)).toEqual([false, false, false, false, false]);
  });

  it('are posted with one buffer for all their numbers, none of it the file’s', async () => {
    const character = settledTakes(await characterOf({ ...SMALL, joints: 40, takes: 8, keys: 35 }));
    const tracks = character.takes.flatMap((take) => {
      const { tracked = [] } = trackedOf(take) ?? {};
      return tracked.flatMap((channel) => (channel.kind === 'tracked' ? channel.rotation.track : []));
    });
    const buffers = new Set(tracks.flatMap(({ times, values }) => [times.buffer, values.buffer]));
    expect(buffers.size).toBe(1);
    const message = forMessage(character);
    expect(message.takes.flatMap(({ channels }) => channels)).toEqual(character.takes[0].channels);
    expect(passageOf(message).transfer).toEqual([...buffers]);
    // Weighing a message makes nothing.
    expect(passageOf(character).transfer).toEqual([...buffers]);
    expect(isTracked(character).filter(Boolean)).toHaveLength(7);
  });

  it('long ones have channels on the page, and so have those of uneven times', async () => {
    const long = settledTakes(await characterOf({ ...SMALL, joints: 10, takes: 2, keys: 501 }));
    expect(isTracked(long)).toEqual([false, false]);
    const { takes, ...rest } = await characterOf();
    const uneven = takes.map(
      (take) => fromMessage({ takes: [{ ...forMessage({ takes: [take] }).takes[0] }] }).takes[0],
    );
    expect(isTracked(settledTakes({ ...rest, takes: uneven }))).toEqual([false, true, true, true, true]);
    const unstated = takes.map((take) => {
      const { framesPerSecond: _, ...head } = forMessage({ takes: [take] }).takes[0];
      return fromMessage({ takes: [head] }).takes[0];
    });
    expect(isTracked(settledTakes({ ...rest, takes: unstated }))).toEqual([false, false, false, false, false]);
  });

  it('a character of ordinary takes is posted as it is', async () => {
    const character = await characterOf();
    const ordinary = { ...character, takes: character.takes.map((take) => ({ ...take })) };
    expect(forMessage(ordinary)).toBe(ordinary);
    expect(fromMessage(ordinary)).toBe(ordinary);
    expect(settledTakes(ordinary)).toBe(ordinary);
  });
});
