import { expect, it } from 'vitest';
import { WorkerClient, type WorkerLike } from '../../src/worker/client.ts';
import { parse } from '../../src/worker/parse.ts';
import { partsOf } from '../../src/worker/parts.ts';
import { passageOf } from '../../src/worker/passage.ts';
import type { FromWorker } from '../../src/worker/protocol.ts';
import { skin } from '../helpers/builders.ts';
import { expectEqual } from '../helpers/equal.ts';
import { walkerFiles } from '../helpers/hero.ts';

const read = (count: number) => parse({ files: walkerFiles(count) }, () => undefined);

it('passes many files on in small parts, and hardly any buffers of their own', async () => {
  const [few, many] = [partsOf(await read(5)), partsOf(await read(40))];
  const weights = many.map(({ part }) => passageOf(part).weight);
  expect(Math.max(...weights)).toBeLessThan(9000);
  expect(many.length).toBeGreaterThan(4 * few.length);
  // The large columns of each skin.
  const transferred = many.reduce((sum, { transfer }) => sum + transfer.length, 0);
  expect(transferred).toBeLessThan(10 * 40);
});

it('puts the parts together again: files in their order, and skins as they were measured', async () => {
  const output = await read(12);
  const expected = structuredClone(output);
  const worker: WorkerLike = {
    onmessage: null,
    onerror: null,
    onmessageerror: null,
    terminate: () => undefined,
    postMessage: ({ id }) => {
      const answer = (data: FromWorker) => worker.onmessage?.(new MessageEvent('message', { data }));
      const parts = partsOf(output);
      expect(parts.length).toBeGreaterThan(1);
      for (const { part, transfer } of parts) answer({ id, kind: 'part', part: structuredClone(part, { transfer }) });
      answer({ id, kind: 'done', job: 'parse', output: { ...output, files: [], facts: [] } });
    },
  };
  const received = await new WorkerClient(() => worker).run('parse', { files: [] });
  expectEqual(received, expected);
  const skins = received.files.flatMap((file) => (file.kind === 'skin' ? [file.skin] : []));
  const morphs = received.files.flatMap((file) => (file.kind === 'morph' ? [file.morph] : []));
  expect(received.facts.every((known) => skins.includes(known.skin))).toBe(true);
  expect(received.facts.flatMap((known) => known.morphs).every((morph) => morphs.includes(morph))).toBe(true);
});

it('clones a buffer of several parts', () => {
  const positions = new Float64Array(30_000);
  const files = Array.from({ length: 2 }, (_, i) => ({
    kind: 'skin' as const,
    skin: skin(`a${i}`, 0, {
      positions,
      surfaces: Array.from({ length: 9000 }, () => ({ triangleStart: 0, triangleCount: 1 })),
    }),
    source: { name: `a${i}.skin`, path: `a${i}.skin`, bytes: 1 },
  }));
  const parts = partsOf({ files, facts: [] });
  expect(parts.map(({ part, transfer }) => [part.files.length, transfer.length])).toEqual([
    [1, 0],
    [1, 0],
  ]);
});
