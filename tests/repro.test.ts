/** What once made a reader give way, and what the attack on the readers (`npm run attack`) finds in a moment. */
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';
import { faultsOf } from './attack/readers/check.ts';
import { corpus } from './attack/readers/corpus.ts';
import { Inputs } from './attack/readers/inputs.ts';
import { isSubject } from './attack/readers/subjects.ts';

const REPRO = fileURLToPath(new URL('repro/', import.meta.url));
const kept = existsSync(REPRO) ? readdirSync(REPRO).filter((name) => name.startsWith('readers-')) : [];

it.each(kept)('%s, which made a reader give way, is read or refused', async (name) => {
  const subject = name.slice(name.indexOf('.') + 1);
  expect(
    isSubject(subject) && (await faultsOf({ subject, bytes: new Uint8Array(readFileSync(REPRO + name)) })),
  ).toEqual([]);
});

it('every file that the attack mutates is read or refused, whole, in pieces, and written', async () => {
  for (const { subject, bytes } of corpus()) {
    if (bytes.length > 4000) continue;
    expect([subject, await faultsOf({ subject, bytes: new Uint8Array(bytes) })]).toEqual([subject, []]);
  }
});

it('the first hundreds of mutated files are read or refused', async () => {
  const inputs = new Inputs(corpus(), 169);
  for (let index = 0; index < 300; index++) expect([index, await faultsOf(inputs.at(index))]).toEqual([index, []]);
});
