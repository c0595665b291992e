/**
 * Numbers in the layouts that programs print: each way to write names, rows, numbers and headings with every other.
 * What is printed is read back, and agrees.
 */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readDump } from '../../src/formats/dump/read.ts';
import { shownTake } from '../../src/model/document.ts';
import { fitDumps } from '../../src/teaching/dump/fit-dump.ts';
import { characterOf } from '../../src/teaching/kit/answers.ts';
import { kitFiles } from '../../src/teaching/kit/files.ts';
import { channelValue, RIGHT_CURVES } from '../../src/teaching/program/curve-rules.ts';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { compared } from './planted.ts';

const character = characterOf(['tree.skel', 'tree_sway.anim'], kitFiles());
const names = character.skeleton?.joints.map(({ name }) => name) ?? [];
const TIME = 1.2;
const { world } = new Evaluator(character).frame(RIGHT_PROGRAM, TIME, {
  local: false,
  vertices: false,
  normals: false,
});
const matrices = names.map((_, j) => Array.from(world.subarray(16 * j, 16 * j + 16)));
const take = shownTake(character);

/** Lines above the numbers. */
const HEADINGS: readonly string[] = [
  '',
  'Project 3',
  'Project 3 output\n',
  'CSE 169 HW2',
  'Homework 2:',
  'Homework 1:',
  'My arm',
  'Output of the program:\nSecond part',
  '== my program, build 12 ==',
  '# written by version 1.2.3 on 2026-11-27 10:30:22',
  '2026-11-27 10:30:22 INFO start',
  'Student: A12345678\nAssignment 2, part 1',
  'Skeleton with 7 joints, 21 DOFs',
  'Frame 39 of 45',
  'frame 12',
  'Loaded tree.skel in 0.013 s.\nOpenGL 4.6 (Core Profile) on display 1',
  '---------- 3D viewer v2.0 ----------',
];
const TIMES: readonly string[] = [
  'time 1.2',
  'time = 1.2s',
  't=1.2',
  't = 1.200000 s',
  'Time: 1.2 sec',
  'time (s): 1.2',
  'Time,1.2',
  '# t: 1.2',
  'currentTime = 1.2f',
  'Frame 36 of 45 at t = 1.2 s:',
  'Frame 36, time 1.2',
  '[time 1.2]',
  'time 1200 ms',
  '=== time 1.2 ===',
  'at 1.2 s:',
  'time\t1.2',
];
const NAMED: readonly ((name: string, numbers: string, index: number) => string)[] = [
  (name, n) => `${name} ${n}`,
  (name, n) => `${name}\t${n}`,
  (name, n) => `${name}: ${n}`,
  (name, n) => `${name} = ${n}`,
  (name, n) => `"${name}": ${n},`,
  (name, n) => `${name} -> ${n}`,
  (name, n) => `[${name}] ${n}`,
  (name, n) => `joint ${name}: ${n}`,
  (name, n) => `Joint "${name}" = ${n}`,
  (name, n) => `| ${name} | ${n} |`,
  (name, n, j) => `${j}: ${name} ${n}`,
  (name, n, j) => `joint ${j} (${name}): ${n}`,
  (name, n, j) => `${j} ${name} ${n}`,
  (name, n) => `world position of ${name}: ${n}`,
  (name, n) => `${name} position: ${n}`,
  (name, n) => `INFO: ${name}: ${n}`,
  (name, n) => `('${name}', ${n})`,
  (name, n) => `${name}:\n  ${n}`,
  (_, n, j) => `${j}: ${n}`,
  (_, n, j) => `joint ${j}: ${n}`,
  (_, n) => n,
];
const SEPARATORS = [' ', '  ', ', ', ',', '\t', '; ', ' | '];
const BRACKETS: readonly ((row: string) => string)[] = [
  (row) => row,
  (row) => `(${row})`,
  (row) => `[${row}]`,
  (row) => `{${row}}`,
  (row) => `vec3(${row})`,
  (row) => `glm::vec3(${row})`,
  (row) => `Vector3(${row})`,
  (row) => `array([${row}])`,
  (row) => `<Vector (${row})>`,
];
const NUMBERS: readonly ((value: number) => string)[] = [
  (value) => value.toFixed(6),
  (value) => String(Number(value.toPrecision(7))),
  (value) => value.toExponential(7),
  (value) => `${value.toFixed(5)}f`,
  (value) => value.toFixed(6).padStart(12),
];
const LINE_ENDS = ['\n', '\r\n', '\r'];

const layout = {
  heading: fc.constantFrom(...HEADINGS),
  time: fc.constantFrom(...TIMES),
  named: fc.constantFrom(...NAMED),
  separator: fc.constantFrom(...SEPARATORS),
  bracket: fc.constantFrom(...BRACKETS),
  number: fc.constantFrom(...NUMBERS),
  lineEnd: fc.constantFrom(...LINE_ENDS),
};
const RUNS = { numRuns: 100 };

function expectRead(lines: readonly string[], lineEnd: string, kinds: object): void {
  const text = lines
    .filter((line) => line !== '')
    .join('\n')
    .concat('\n')
    .replaceAll('\n', lineEnd);
  const { value, diagnostics } = readDump(text, 'mine.txt');
  expect(diagnostics, text).toEqual([]);
  if (!value) throw new Error(`Expected a dump: ${text}`);
  const { targets, diagnostics: misfits } = fitDumps(character, [{ fileName: 'mine.txt', dump: value }], undefined);
  expect(misfits, text).toEqual([]);
  expect(targets && compared(character, targets), text).toMatchObject({ agrees: true, compared: kinds });
}

describe('what a program prints is read', () => {
  it('as positions of joints, whatever is around the numbers', () => {
    fc.assert(
      fc.property(fc.record(layout), ({ heading, time, named, separator, bracket, number, lineEnd }) => {
        const rows = names.map((name, j) =>
          named(name, bracket(matrices[j].slice(12, 15).map(number).join(separator)), j),
        );
        expectRead([heading, time, ...rows], lineEnd, { positions: names.length });
      }),
      RUNS,
    );
  });

  it('as matrices in one line, in four, or in brackets', () => {
    const rowsOf = (m: readonly number[]) => [0, 1, 2, 3].map((r) => [0, 1, 2, 3].map((c) => m[4 * c + r]));
    const columnsOf = (m: readonly number[]) => [0, 1, 2, 3].map((c) => m.slice(4 * c, 4 * c + 4));
    const written: readonly ((m: readonly number[], row: (values: readonly number[]) => string) => string)[] = [
      (m, row) => row(rowsOf(m).flat()),
      (m, row) => row(m),
      (m, row) => `\n${rowsOf(m).map(row).join('\n')}\n`,
      (m, row) =>
        `mat4x4(${columnsOf(m)
          .map((column) => `(${row(column)})`)
          .join(', ')})`,
      (m, row) => `[[${rowsOf(m).map(row).join(']\n [')}]]`,
      (m, row) => `[[${rowsOf(m).map(row).join('],\n       [')}]]`,
      (m, row) => `<Matrix 4x4 (${rowsOf(m).map(row).join(')\n            (')})>`,
      (m, row) => `Float32Array(16) [\n  ${columnsOf(m).map(row).join(',\n  ')}\n]`,
      (m, row) => `[${rowsOf(m).map(row).join(';\n ')}]`,
    ];
    fc.assert(
      fc.property(
        fc.record({ ...layout, one: fc.constantFrom(...written) }),
        ({ heading, time, named, separator, number, lineEnd, one }) => {
          const rows = names.map((name, j) =>
            named(
              name,
              one(matrices[j], (values) => values.map(number).join(separator)),
              j,
            ),
          );
          expectRead([heading, time, 'world matrices', ...rows], lineEnd, { world: names.length });
        },
      ),
      RUNS,
    );
  });

  it('as values of channels: rows of a time and values', () => {
    const channels = take?.channels ?? [];
    const times = Array.from({ length: 12 }, (_, i) => Number((-1.03 + 0.3 * i).toFixed(2)));
    const valuesAt = (time: number) =>
      channels.map((one) => channelValue(one, take?.range ?? [0, 1], time, RIGHT_CURVES));
    const header = (list: readonly string[], separator: string) => list.join(separator === '  ' ? ' ' : separator);
    const numbered = channels.map((_, c) => `c${c}`);
    type Rows = (
      separator: string,
      row: (time: number) => string,
      list: (values: readonly number[]) => string,
    ) => readonly string[];
    const written: readonly Rows[] = [
      (_, row) => times.map(row),
      (separator, row) => [header(['time', ...numbered], separator), ...times.map(row)],
      (separator, row) => [
        header(
          ['Time (s)', ...numbered].map((n) => (separator.trim() === '' ? n.replace(' (s)', '') : n)),
          separator,
        ),
        ...times.map(row),
      ],
      (separator, row) => [
        header(['frame', 't', ...numbered], separator),
        ...times.map((time, i) => `${i}${separator}${row(time)}`),
      ],
      ...[
        (c: number) => `ch ${c}`,
        (c: number) => `"Channel ${c} (rad)"`,
        (c: number) => `joint ${Math.floor(c / 3)} r${'xyz'[c % 3]}`,
        (c: number) => `DOF ${c + 1} of the left upper arm's ball joint`,
      ].flatMap((cell): readonly Rows[] => [
        (_, row) => [['time', ...channels.map((_, c) => cell(c))].join(','), ...times.map(row)],
        (separator, row) => [
          ['frame', 'time', ...channels.map((_, c) => cell(c))].join(separator.trim() === '' ? ',' : separator),
          ...times.map((time, i) => `${i}${separator}${row(time)}`),
        ],
      ]),
      (_separator, _row, list) => times.map((time) => `${time}: ${list(valuesAt(time))}`),
      (_separator, _row, list) => times.map((time) => `t=${time}: ${list(valuesAt(time))}`),
      (_separator, _row, list) => times.map((time) => `time ${time.toFixed(4)} | ${list(valuesAt(time))}`),
      (_separator, _row, list) => [
        `[[${times.map((time) => wrapped(list([time, ...valuesAt(time)]))).join(']\n [')}]]`,
      ],
      (_separator, row) => [`Channels of sample 2, ${times.length} rows`, ...times.map(row)],
    ];
    fc.assert(
      fc.property(
        fc.record({ ...layout, rows: fc.constantFrom(...written) }),
        ({ heading, separator, number, lineEnd, rows }) => {
          const list = (values: readonly number[]) => values.map(number).join(separator);
          const lines = rows(separator, (time) => [String(time), ...valuesAt(time).map(number)].join(separator), list);
          expectRead([heading, ...lines], lineEnd, { channels: channels.length });
        },
      ),
      RUNS,
    );
  });

  /** As numpy breaks lines. */
  function wrapped(row: string): string {
    return row
      .split(/(?<=[\s,;|])(?=[-+\d])/)
      .map((word, i) => (i > 0 && i % 5 === 0 ? `\n  ${word}` : word))
      .join('');
  }
});

describe('what else programs print is read', () => {
  const points = names.map((_, j) => matrices[j].slice(12, 15).map((value) => value.toFixed(6)));
  const each = (one: (name: string, point: readonly string[], j: number) => string, between = '\n') =>
    names.map((name, j) => one(name, points[j], j)).join(between);
  const POINTS: Readonly<Record<string, string>> = {
    'a dict of tuples': `{'time': 1.2, 'positions': {${each((name, p) => `'${name}': (${p.join(', ')})`, ', ')}}}`,
    'a dict of arrays': `time 1.2\n{${each((name, p) => `'${name}': array([${p.join(', ')}])`, ',\n ')}}`,
    'an object of JavaScript': `time: 1.2\n{\n${each((name, p) => `  ${name}: [ ${p.join(', ')} ]`, ',\n')}\n}`,
    'vectors over several lines': `t = 1.2\n${each((name, [x, y, z]) => `${name} Vector3 {\n  x: ${x},\n  y: ${y},\n  z: ${z}\n}`)}`,
    'names behind the numbers': `time 1.2\n${each((name, p) => `${p.join(' ')} ${name}`)}`,
    'their number before them': `time 1.2\n${names.length}\n${each((_, p) => p.join(' '))}`,
    'parents beside them': `time 1.2\n${each((name, p, j) => `${name} (parent ${names[j - 1] ?? 'none'}): ${p.join(' ')}`)}`,
    'durations beside them': `Elapsed time: 0.0023 s\nt: 1.2\n${each((name, p) => `${name} ${p.join(' ')}`)}\nDone in 12 ms.`,
    'a table with bars': `time 1.2\n| joint | x | y | z |\n|---|---|---|---|\n${each((name, p) => `| ${name} | ${p.join(' | ')} |`)}`,
    'decimal commas': `Zeit t = 1,2\n${each((name, p) => `${name} (${p.join('; ').replaceAll('.', ',')})`)}`,
    'log lines': `[10:30:21] t = 1.2\n${each((name, p) => `[10:30:21.${p.length}42] INFO ${name}: (${p.join(', ')})\nUnityEngine.Debug:Log(Object)`)}`,
    'times of the day as ISO writes them': `t = 1.2\n${each((name, p, j) => `2026-11-27T10:30:2${j % 10}.123Z [info] ${name}: ${p.join(' ')}`)}`,
    'a tree': `time 1.2\n${each((name, p, j) => `${'│  '.repeat(j)}├─ ${name} (${p.join(', ')})`)}`,
    'sentences above them': `${'This program prints the positions of all joints of the character.\n'.repeat(6)}time 1.2\n${each((name, p) => `${name}: ${p.join(' ')}`)}`,
  };
  it.each(Object.entries(POINTS))('with %s', (_, text) => {
    expectRead([text], '\n', { positions: names.length });
  });

  it('with other names beside them, which are told', () => {
    const rows = each((name, p) => `${name} (${p.join(', ')})`);
    const text = `time 1.2\nCamera (0.5, 1.0, 5.0)\n${rows}\nLight (2.5, 3.5, 1.5)`;
    const { value } = readDump(text, 'mine.txt');
    if (!value) throw new Error('Expected a dump.');
    const { targets, diagnostics } = fitDumps(character, [{ fileName: 'mine.txt', dump: value }], undefined);
    expect(diagnostics).toMatchObject([{ severity: 'info', line: 2, message: expect.stringContaining('2 rows') }]);
    expect(targets && compared(character, targets)).toMatchObject({ agrees: true });
  });

  const channels = take?.channels ?? [];
  const valuesAt = (time: number) =>
    channels.map((one) => channelValue(one, take?.range ?? [0, 1], time, RIGHT_CURVES).toFixed(6));
  const TIMES_OF_ROWS = [-1, -0.37, 0, 0.5, 1.93];
  const atEach = (one: (time: number, values: readonly string[]) => string) =>
    TIMES_OF_ROWS.map((time) => one(time, valuesAt(time))).join('\n');
  const CHANNELS: Readonly<Record<string, string>> = {
    'a time above each row': atEach((time, values) => `time ${time}\n${values.join(' ')}`),
    'a time above each list': atEach((time, values) => `t = ${time}\n${values.map((v, c) => `${c} ${v}`).join('\n')}`),
    'frames and times before them': atEach(
      (time, values) => `Frame ${3 * time + 3}, time ${time}: ${values.join(' ')}`,
    ),
    'a function of the time': atEach((time, values) => `evaluate(${time}) = ${values.join(', ')}`),
    'tuples of a time and a list': atEach((time, values) => `(${time}, [${values.join(', ')}])`),
    'arrays over several lines': atEach(
      (time, values) => `[\n  ${[time, ...values].join(', ').replaceAll(/(?<=5,) /g, '\n  ')}\n]`,
    ),
    'rows over several lines': atEach(
      (time, values) => `${time} ${values.slice(0, 9).join(' ')}\n  ${values.slice(9).join(' ')}`,
    ),
    'names of DOFs above them': `t,${channels.map((_, c) => `j${Math.floor(c / 3)}.r${'xyz'[c % 3]}`).join()}\n${atEach((time, values) => [time, ...values].join())}`,
    'a table of pandas': `  time  ${channels.map((_, c) => `c${c}`).join('  ')}\n${atEach((time, values) => `${TIMES_OF_ROWS.indexOf(time)}  ${[time, ...values].join('  ')}`)}`,
    'blocks of a channel each': channels
      .map(
        (_, c) => `Channel ${c} of ${channels.length}\n${atEach((time, values) => `${time.toFixed(2)}: ${values[c]}`)}`,
      )
      .join('\n'),
  };
  it.each(Object.entries(CHANNELS))('with %s', (_, text) => {
    expectRead([text], '\n', { channels: channels.length });
  });
});

describe('what is not read', () => {
  const messageOf = (text: string) => {
    const { value } = readDump(text, 'mine.txt');
    if (!value) throw new Error('Expected a dump.');
    return fitDumps(character, [{ fileName: 'mine.txt', dump: value }], undefined).diagnostics.map(
      ({ message }) => message,
    );
  };

  it('is told as it looks, headings too', () => {
    const row = '1 0 0 0.5\n0 1 0 0.5\n0 0 1 0.5\n0 0 0 1\n';
    expect(messageOf(`Project 3\n\n\n${row.repeat(23)}`)).toEqual([
      expect.stringContaining('found 368 numbers: line 1 has 1 number; lines 4–95 look like 23 matrices'),
    ]);
    expect(messageOf('42')).toEqual([expect.stringContaining('found 1 number: line 1 has 1 number.')]);
    expect(messageOf('1.5 2.5 3.5\n4.5 5.5\n')).toEqual([
      expect.stringContaining('found 5 numbers: line 1 looks like 1 point; line 2 has 2 numbers'),
    ]);
  });

  it('is told once where hundreds of blocks are alike', () => {
    const blocks = Array.from({ length: 300 }, (_, i) => `time ${i}\n1.5 2.5 3.5 4.5\n`);
    expect(messageOf(blocks.join(''))).toHaveLength(3);
  });
});
