/**
 * The page draws what has changed with its next frame. What a browser test reads at once after a click is what was
 * there before, once in a hundred runs: so what is read is polled, and the result of an action gets a name first.
 */
import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';

const FOLDER = fileURLToPath(new URL('./e2e/', import.meta.url));
/** `await` within the parentheses of `expect`, which end before a matcher or with the statement. */
const READ_AT_ONCE = /\bexpect\((?:(?!\)\s*\.(?:not|to)|;).)*?\bawait\b/gs;

function readsAtOnce(text: string): number[] {
  return [...text.matchAll(READ_AT_ONCE)].map(({ index }) => text.slice(0, index).split('\n').length);
}

it('a read at once is found whatever is around it, and a polled one is none', () => {
  expect(readsAtOnce(`\nexpect(await a()).toBe(1);`)).toEqual([2]);
  expect(readsAtOnce(`expect(\n  first((await all(page)).map((x) => x.y)),\n).not.toBe(1);`)).toEqual([1]);
  expect(readsAtOnce(`expect(a.toFixed(2), b).toBe(await c());\nexpect(Math.abs(await d())).toBe(1);`)).toEqual([2]);
  expect(readsAtOnce('await expect.poll(async () => (await all(page)).length).toBe(1);')).toEqual([]);
  expect(readsAtOnce('expect(a).toBe(1);\nawait b();')).toEqual([]);
});

it('browser tests expect nothing of a page that they read at once', () => {
  const files = readdirSync(FOLDER, { recursive: true, encoding: 'utf8' }).filter((file) => file.endsWith('.ts'));
  expect(files.length).toBeGreaterThan(20);
  const found = files.flatMap((file) =>
    readsAtOnce(readFileSync(FOLDER + file, 'utf8')).map((line) => `tests/e2e/${file}:${line}`),
  );
  expect(found, 'Poll what is read (`expect.poll`); give the result of an action a name.').toEqual([]);
});
