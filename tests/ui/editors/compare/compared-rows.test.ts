import { expect, it } from 'vitest';
import { inOrder, kindsIn, MAX_VERTICES, rowsOf, rowTitle } from '../../../../src/ui/editors/compare/compared-rows.ts';
import { jointNumbersIn, samplesOf } from '../../../../src/ui/editors/compare/detail.ts';
import { describeShared } from '../../../helpers/shared.ts';
import { comparedCase } from './compare-cases.ts';

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

  it('of vertices the worst are listed, the worst first', () => {
    const { result, character, frame } = resultOf([...WASP, 'cse169/wasp.skin'], 'd009.txt');
    expect(kindsIn(result)).toEqual(['vertices']);
    const rows = rowsOf('vertices', result, frame, character);
    const sorted = [...frame.vertexErrors].sort((a, b) => b - a);
    expect(rows.map(({ error }) => error)).toEqual(sorted.slice(0, MAX_VERTICES));
    expect([rowTitle('vertices', rows[0]), rows[0].name]).toEqual([
      `vertex ${rows[0].index}`,
      expect.stringMatching(/_/),
    ]);
    expect(rows.every(({ index, error }) => frame.vertexErrors[index] === error)).toBe(true);
  });

  it('channels have their largest error with its time, and list the samples that are wrong', () => {
    const { result, character } = resultOf(['../conformance/compare/curves.anim'], 'd042.txt', 0);
    const rows = rowsOf('channels', result, undefined, character);
    const wrong = rows.filter(({ mark }) => mark !== 'agrees');
    expect(wrong.map(({ index }) => index)).toEqual([4]);
    const samples = samplesOf(result, 4);
    expect(samples.every(({ isWrong }) => isWrong)).toBe(true);
    const worst = Math.max(...samples.map(({ theirs, ours }) => Math.abs(theirs - ours)));
    expect(wrong[0]).toMatchObject({
      error: worst,
      time: samples.find((s) => Math.abs(s.theirs - s.ours) === worst)?.time,
    });
    const right = rows.find(({ mark }) => mark === 'agrees');
    expect(samplesOf(result, right?.index ?? -1).length).toBeGreaterThan(0);
  });

  it('local matrices follow from world matrices', () => {
    const { result } = resultOf(WASP, 'd008.txt', 1.5);
    expect(jointNumbersIn(result.targets.frames[0])).toEqual(['world', 'local']);
  });
});
