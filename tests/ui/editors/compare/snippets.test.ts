import { expect, it } from 'vitest';
import { readDump } from '../../../../src/formats/dump/read.ts';
import { Evaluator } from '../../../../src/teaching/program/evaluator.ts';
import { RIGHT_PROGRAM } from '../../../../src/teaching/program/program.ts';
import { SNIPPETS } from '../../../../src/ui/editors/compare/snippets.ts';
import { compareDumps } from '../../../../src/worker/compare-program.ts';
import { characterOf, OWN } from '../../../teaching/lesson-files.ts';

const crawler = characterOf(...OWN.crawler);
const TIME = 0.4;

/** What the lines print in their language: `print(*numbers)`, `glm::to_string`, `console.log`. */
const PRINTED: Readonly<Record<string, (name: string, columns: readonly number[][]) => string>> = {
  'C++': (name, columns) =>
    `${name}: mat4x4(${columns.map((c) => `(${c.map((x) => x.toFixed(6)).join(', ')})`).join(', ')})`,
  Python: (name, columns) => `${name}: ${[0, 1, 2, 3].flatMap((r) => columns.map((c) => c[r])).join(' ')}`,
  JavaScript: (name, columns) => `${name}: ${columns.flat().join(' ')}`,
};

it.each(SNIPPETS)('what the lines for %s print is compared at its time, and agrees', (language) => {
  const { world } = new Evaluator(crawler).frame(RIGHT_PROGRAM, TIME, {
    local: false,
    vertices: false,
    normals: false,
  });
  const rows = (crawler.skeleton?.joints ?? []).map(({ name }, j) =>
    PRINTED[language](
      name,
      [0, 4, 8, 12].map((c) => [...world.subarray(16 * j + c, 16 * j + c + 4)]),
    ),
  );
  const { value } = readDump([`time ${TIME}`, ...rows].join('\n'), 'mine.txt');
  if (!value) throw new Error('It can’t be read.');
  const dumps = [{ fileName: 'mine.txt', dump: value }];
  const { comparison } = compareDumps({ character: crawler, dumps }, () => undefined);
  expect(comparison).toMatchObject({ agrees: true, frames: [{ time: TIME }], compared: { world: rows.length } });
});
