/** The manual's table of files has every kind that is read. */
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';
import { FORMAT_KINDS, isSaved, KINDS } from '../../src/files/kinds.ts';

const PAGE = readFileSync(fileURLToPath(new URL('../../docs/reference/files.md', import.meta.url)), 'utf8');
const rows = PAGE.split('\n').filter((line) => line.startsWith('| `'));

it.each(FORMAT_KINDS)('the page of files has a row for the kind %s, which says if it is read only', (kind) => {
  const [extension] = KINDS[kind].extensions;
  // The first has the form that is written.
  const own = rows.find((row) => row.split('|')[1].includes(`\`.${extension}\``));
  expect(own).toBeDefined();
  expect(own?.includes('read only')).toBe(!isSaved(kind));
});
