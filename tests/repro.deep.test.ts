/**
 * What once made a reader give way, and what the attack on the readers (`npm run attack`) finds in a moment: in a
 * thread like that of the attack, where memory is measured exactly.
 */
import { once } from 'node:events';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Worker } from 'node:worker_threads';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { corpus } from './attack/readers/corpus.ts';
import { type Input, Inputs } from './attack/readers/inputs.ts';
import { buildThread, startThread } from './attack/readers/start-thread.ts';
import { isSubject } from './attack/readers/subjects.ts';

let thread: Worker;
beforeAll(async () => {
  thread = startThread(await buildThread('asked-thread'));
});
afterAll(() => thread.terminate());

async function faultsOf(input: Input): Promise<unknown> {
  const answer = once(thread, 'message');
  thread.postMessage(input);
  return (await answer)[0];
}

const REPRO = fileURLToPath(new URL('repro/', import.meta.url));
const kept = existsSync(REPRO) ? readdirSync(REPRO).filter((name) => name.startsWith('readers-')) : [];

it.each(kept)('%s, which made a reader give way, is read or refused', async (name) => {
  const subject = name.slice(name.indexOf('.') + 1);
  expect(
    isSubject(subject) && (await faultsOf({ subject, bytes: new Uint8Array(readFileSync(REPRO + name)) })),
  ).toEqual([]);
});

/** Files of twice the size take the same share of what they may, at most half or two thirds, in twice the time. */
const SIZE = 24_000;
const many = (unit: string) => unit.repeat(SIZE / unit.length);
const END = 'MOTION Frames: 0 Frame Time: 1';

it.each([
  ['roots', 'bvh', `HIERARCHY ${many('ROOT{}')} ${END}`],
  ['joints', 'bvh', `HIERARCHY ROOT{${many('JOINT{}')}} ${END}`],
  ['joints in each other', 'bvh', `HIERARCHY ROOT{${many('JOINT{')}${'}'.repeat(1 + Math.floor(SIZE / 6))} ${END}`],
  ['roots', 'skel', many('balljoint{}')],
  ['compound joints', 'skel', `balljoint{${many('compoundjoint{}')}}`],
  ['joints in each other', 'skel', `${many('balljoint{')}${'}'.repeat(SIZE / 10)}`],
  ['short lines', 'txt', many('1\n')],
  ['marks behind a number', 'txt', `local 1${many('"')}`],
  ['words behind a number', 'txt', `1 local${many(' a')}`],
  ['labels', 'txt', many('7:1\n')],
  ['blocks', 'txt', many('t 1\n1\nt 2\n1\n')],
  ['JSON texts', 'json', many('[1]\n')],
  ['quotes in a cell', 'review.csv', `path\n"${'""'.repeat(200_000)}"`],
] as const)('many %s in a .%s are read in memory in proportion', async (_, subject, text) => {
  expect(await faultsOf({ subject, bytes: new TextEncoder().encode(text) })).toEqual([]);
});

const SEEDS = corpus();

it('every file that the attack mutates is read or refused, whole, in pieces, and written', async () => {
  for (const { subject, bytes } of SEEDS) {
    if (bytes.length > 4000) continue;
    expect([subject, await faultsOf({ subject, bytes: new Uint8Array(bytes) })]).toEqual([subject, []]);
  }
});

it('the first hundred of mutated files are read or refused', async () => {
  const inputs = new Inputs(SEEDS, 169);
  for (let index = 0; index < 100; index++) expect([index, await faultsOf(inputs.at(index))]).toEqual([index, []]);
});
