import { expect, it } from 'vitest';
import { Evaluator } from '../../../../src/teaching/program/evaluator.ts';
import { RIGHT_PROGRAM } from '../../../../src/teaching/program/program.ts';
import { numberText } from '../../../../src/ui/editors/compare/banner-text.ts';
import {
  countsOf,
  hasRows,
  inOrder,
  kindsIn,
  MAX_VERTICES,
  type RowKind,
  rowsOf,
  rowTitle,
} from '../../../../src/ui/editors/compare/compared-rows.ts';
import { jointNumbersIn, samplesOf, samplesText } from '../../../../src/ui/editors/compare/detail.ts';
import { isOfChannels } from '../../../../src/ui/editors/compare/dump-kinds.ts';
import { largestText } from '../../../../src/ui/editors/compare/largest-text.ts';
import { describeShared } from '../../../helpers/shared.ts';
import { comparedCase, comparedDumps } from './compare-cases.ts';

function resultOf(...args: Parameters<typeof comparedCase>) {
  const { result, character } = comparedCase(...args);
  if (!result) throw new Error('Nothing was compared.');
  return { result, character, frame: result.comparison.frames[0] };
}
const WASP = ['cse169/wasp.skel', 'cse169/wasp_walk.anim'];

describeShared('the tables of a comparison', () => {
  it('joints have their errors and marks, and are put in order by any column', () => {
    const { result, character, frame } = resultOf(WASP, 'd008.txt', 1.5);
    expect(kindsIn(result)).toEqual(['joints']);
    const rows = rowsOf('joints', result, frame, character);
    expect(rows.slice(6, 9)).toMatchObject([
      { index: 6, mark: 'agrees' },
      { index: 7, name: 'hip_03_r', mark: 'own' },
      { index: 8, mark: 'own' },
    ]);
    const errors = inOrder(rows, { column: 'error', descending: true }).map(({ error }) => error);
    expect(errors).toEqual([...frame.jointErrors].sort((a, b) => b - a));
    expect(inOrder(rows, { column: 'mark', descending: false })[0].index).toBe(7);
    expect(inOrder(rows, { column: 'index', descending: true })[0].index).toBe(22);
    const names = inOrder(rows, { column: 'name', descending: true }).map(({ name }) => name);
    expect([names[0], names.at(-1)]).toEqual(['wing_02_r', 'abdomen']);
  });

  it('a joint that is wrong by itself is told from those that inherit it', () => {
    const { result, character, frame } = resultOf(WASP, 'd039.json');
    const marks = rowsOf('joints', result, frame, character).map(({ mark }) => mark);
    expect(marks.filter((mark) => mark === 'own')).toHaveLength(1);
    expect(marks.filter((mark) => mark === 'inherited')).toHaveLength(frame.inherited.length);
    expect(frame.inherited.length).toBeGreaterThan(0);
    expect(marks.filter((mark) => mark === 'differs')).toEqual([]);
  });

  it('of positions it is known only that joints differ', () => {
    const { result, character, frame } = resultOf(WASP, 'd012.txt');
    const marks = new Set(rowsOf('joints', result, frame, character).map(({ mark }) => mark));
    expect(marks).toEqual(new Set(['agrees', 'differs']));
    expect(jointNumbersIn(result.targets.frames[0])).toEqual(['positions']);
  });

  it('of vertices the worst are listed, the worst first, and the first that is wrong', () => {
    const { result, character, frame } = resultOf([...WASP, 'cse169/wasp.skin'], 'd009.txt');
    expect(kindsIn(result)).toEqual(['vertices']);
    const rows = rowsOf('vertices', result, frame, character);
    expect(rows).toHaveLength(MAX_VERTICES);
    const sorted = [...frame.vertexErrors].sort((a, b) => b - a);
    expect(rows.slice(0, -1).map(({ error }) => error)).toEqual(sorted.slice(0, MAX_VERTICES - 1));
    expect([rowTitle('vertices', rows[0]), rows[0].name]).toEqual([
      `vertex ${rows[0].index}`,
      expect.stringMatching(/_/),
    ]);
    expect(rows.every(({ index, error }) => frame.vertexErrors[index] === error)).toBe(true);
    const [first] = inOrder(rows, { column: 'index', descending: false });
    expect(first.index).toBe(frame.first?.index);
    expect(countsOf('vertices', frame, result.tolerance)).toEqual({
      wrong: frame.vertexErrors.filter((error) => error > result.tolerance).length,
      of: 694,
    });
  });

  it('of few wrong vertices no right ones are listed, which would come before the first wrong one', () => {
    const { character } = comparedCase([...WASP, 'cse169/wasp.skin'], 'd009.txt');
    const { vertices } = new Evaluator(character).frame(RIGHT_PROGRAM, 0.8, {
      local: false,
      vertices: true,
      normals: false,
    });
    const moved = vertices.slice();
    for (const v of [300, 200]) moved[3 * v] += 0.5 + v;
    const lines = Array.from({ length: moved.length / 3 }, (_, v) => `v ${moved.slice(3 * v, 3 * v + 3).join(' ')}`);
    const { result, frame } = resultOf([...WASP, 'cse169/wasp.skin'], 'few.obj', 0.8, 1e-4, lines.join('\n'));
    expect(rowsOf('vertices', result, frame, character).map(({ index }) => index)).toEqual([300, 200]);
  });

  it('channels have their largest error and the first wrong time, and list the samples that are wrong, or all', () => {
    const { result, character } = resultOf(['../conformance/compare/curves.anim'], 'd042.txt', 0);
    const rows = rowsOf('channels', result, undefined, character);
    const wrong = rows.filter(({ mark }) => mark !== 'agrees');
    expect(wrong.map(({ index }) => index)).toEqual([4]);
    const { samples, wrong: count, of } = samplesOf(result, 4);
    expect(samples.every(({ isWrong }) => isWrong)).toBe(true);
    expect([samples.length, count < of]).toEqual([Math.min(60, count), true]);
    const worst = Math.max(...samples.map(({ theirs, ours }) => Math.abs(theirs - ours)));
    expect(wrong[0]).toMatchObject({ error: worst, firstTime: Math.min(...samples.map(({ time }) => time)) });
    const all = samplesOf(result, 4, true);
    expect(all.samples).toHaveLength(of);
    expect(all.samples.filter(({ isWrong }) => isWrong)).toHaveLength(count);
    const right = rows.find(({ mark }) => mark === 'agrees');
    expect(right?.firstTime).toBeUndefined();
    expect(samplesOf(result, right?.index ?? -1).samples.length).toBeGreaterThan(0);
  });

  it.each([
    [12, 12, 400, false, '12 of 400 differ; matching ones aren’t listed.'],
    [60, 120, 400, false, '120 of 400 differ; the first 60 are listed; matching ones aren’t listed.'],
    [400, 12, 400, true, '12 of 400 differ.'],
    [600, 12, 900, true, '12 of 900 differ; the first 600 are listed.'],
    [9, 9, 9, false, '9 of 9 differ.'],
    [60, 0, 900, false, 'All 900 agree; the first 60 are listed.'],
  ])('of samples it is said what is listed: %d listed, %d of %d wrong, all: %s', (listed, wrong, of, all, text) => {
    expect(samplesText(listed, wrong, of, all)).toBe(text);
  });

  it('joints, vertices and channels are each of the dumps that have them', () => {
    const several = comparedDumps(
      [...WASP, 'cse169/wasp.skin'],
      [{ name: 'd009.txt' }, { name: 'd008.txt', time: 1.5 }],
    );
    if (!several.result) throw new Error('Nothing was compared.');
    const { frames } = several.result.comparison;
    expect(kindsIn(several.result)).toEqual(['joints', 'vertices']);
    const kinds: readonly RowKind[] = ['joints', 'vertices', 'channels'];
    expect(frames.map((frame) => kinds.map((kind) => hasRows(kind, frame)))).toEqual([
      [false, true, false],
      [true, false, false],
    ]);
    expect(isOfChannels(several.result, 'd009.txt')).toBe(false);
    const { result } = resultOf(['../conformance/compare/curves.anim'], 'd042.txt', 0);
    expect(isOfChannels(result, 'd042.txt')).toBe(true);
  });

  it('the largest error is told with its place, kind and unit', () => {
    const { result, frame } = resultOf([...WASP, 'cse169/wasp.skin'], 'd009.txt');
    const { index, error } = frame.largest ?? { index: -1, error: 0 };
    const [theirs, ours] = [result.targets.frames[0].vertices ?? [], frame.ours.vertices];
    const apart = Math.hypot(...[0, 1, 2].map((k) => theirs[3 * index + k] - ours[3 * index + k]));
    expect(apart).toBeGreaterThan(error * frame.size);
    const told = new RegExp(
      `^vertex ${index}: ${numberText(apart)} apart, ${numberText(error * frame.size)} along [xyz], for a size of `,
    );
    expect(largestText(result)).toMatch(told);
    expect(largestText(resultOf(WASP, 'd008.txt', 1.5).result)).toMatch(/ in its rotation$| apart, /);
    expect(largestText(resultOf(WASP, 'd000.txt', 1.5).result)).toMatch(/^[^:]*, over a size of /);
    const rx = '0 0 0 0 0 0 0 0 0.3'.split(' ');
    const row = [0.5, ...Array.from({ length: 72 }, (_, c) => Number(rx[c] ?? 0))].join(' ');
    const channels = resultOf([...WASP, 'cse169/wasp.skin'], 'channels.txt', 0, 1e-4, `${row}\n`);
    expect(largestText(channels.result)).toMatch(/^channel \d+ \(\S+\) at 0\.5 s: \S+ (rad|of length)$/);
  });

  it('local matrices follow from world matrices', () => {
    const { result } = resultOf(WASP, 'd008.txt', 1.5);
    expect(jointNumbersIn(result.targets.frames[0])).toEqual(['world', 'local']);
  });
});
