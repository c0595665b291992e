import { describe, expect, it } from 'vitest';
import { setRetarget } from '../../../../src/edit/commands/retarget.ts';
import { trackJoints } from '../../../../src/evaluate/measure/tracks.ts';
import { runToEnd } from '../../../../src/evaluate/steps.ts';
import type { Character } from '../../../../src/model/document.ts';
import { withJoints } from '../../../../src/model/skeleton/joint-selection.ts';
import {
  emptyText,
  type Measured,
  massText,
  type Source,
  seriesAsCsv,
  seriesOf,
  sourcesOf,
  spanOf,
  unitOf,
  valueAt,
} from '../../../../src/ui/editors/measure/series.ts';
import { listOfTakes } from '../../../../src/ui/editors/takes/play.ts';
import { compareTakes } from '../../../../src/ui/editors/takes/start-comparison.ts';
import { sliding } from '../../../edit/hold/sliding.ts';
import { character, documentOf, joint, skeleton, takeOfValues } from '../../../helpers/builders.ts';
import { workbench } from '../../builders.ts';

const measured = (sources: readonly Source[]): readonly Measured[] =>
  sources.map((source) => ({
    source,
    tracks: runToEnd(trackJoints(source.character, source.frames, source.joints)),
  }));

/** Its root is at x, y as given. */
function take(id: string, x: number, more: Partial<Character> = {}): Character {
  return character({
    id,
    name: id,
    skeleton: skeleton(3),
    takes: [takeOfValues(`${id} take`, [x, 1.5])],
    shownTake: 0,
    ...more,
  });
}

describe('the plotted series', () => {
  it('all visible characters that play a take are measured, at the root if no joint is selected', () => {
    const { wb } = workbench(
      documentOf(take('a', 0), take('b', 1, { isHidden: true }), take('c', 2), take('d', 3, { shownTake: -1 })),
    );
    const sources = sourcesOf(wb);
    expect(sources.map(({ character: c, joints }) => [c.id, joints])).toEqual([
      ['a', [0]],
      ['c', [0]],
    ]);
  });

  it('the selected joints are measured, in other characters those of the same name', () => {
    const other = { name: 'other', joints: [joint(-1, { name: 'joint2' }), joint(0, { name: 'tail' })] };
    const { wb } = workbench(documentOf(take('a', 0), take('b', 1, { skeleton: other })));
    wb.store.select(withJoints({ characterId: 'a' }, [2, 1]));
    expect(sourcesOf(wb).map(({ joints }) => joints)).toEqual([[2, 1], [0]]);
  });

  it('of a comparison the two compared takes are measured, and of one character both', () => {
    const two = take('a', 0, { takes: [takeOfValues('walk', [0]), takeOfValues('run', [4])] });
    const { wb } = workbench(documentOf(two, take('b', 9)));
    const [walk, run] = listOfTakes(wb);
    compareTakes(wb, walk, run);
    const all = measured(sourcesOf(wb));
    const series = seriesOf(all, 'joints', 'x');
    expect(series.map(({ label, values }) => [label, values[0]])).toEqual([
      ['walk: joint0', 0],
      ['run: joint0', 4],
    ]);
    expect(series.map(({ source }) => source)).toEqual([0, 1]);
  });

  it('units are metres where every character states its own, and degrees for angles', () => {
    const inMetres = take('a', 0, { space: { up: 'y', unit: 'centimetres', lift: 0 } });
    const { wb } = workbench(documentOf(inMetres));
    expect(unitOf(measured(sourcesOf(wb)), 'speed')).toBe('m/s');
    const { wb: both } = workbench(documentOf(inMetres, take('b', 0)));
    expect(unitOf(measured(sourcesOf(both)), 'acceleration')).toBe('units/s²');
    expect(unitOf(measured(sourcesOf(both)), 'angle')).toBe('°');
  });

  it('the centre of mass has places and speeds but no angle, and says how masses were assumed', () => {
    const { wb } = workbench(documentOf(take('a', 2)));
    const all = measured(sourcesOf(wb));
    expect(seriesOf(all, 'mass', 'x')[0].values[0]).toBe(2);
    expect(seriesOf(all, 'mass', 'angle')).toEqual([]);
    expect(massText(all, 'mass', 'x')).toBe('Mass uniform over the bones');
    expect(massText(all, 'joints', 'x')).toBe('');
    expect(emptyText(sourcesOf(wb), 'mass', 'angle')).toContain('does not rotate');
    expect(seriesOf(all, 'joints', 'contact')).toEqual([]);
    expect(emptyText(sourcesOf(wb), 'joints', 'contact')).toContain('No feet');
    const endless = sourcesOf(wb).map((source) => ({ ...source, frames: { ...source.frames, frameCount: Infinity } }));
    expect(emptyText(endless, 'joints', 'x')).toContain('more than 1,000,000 frames');
    expect(emptyText([], 'joints', 'x')).toContain('No visible character has a take');
  });

  it('feet are measured without being selected, also of a take that is retargeted', () => {
    const { wb } = workbench(documentOf({ ...sliding(0.01), id: 'a' }, { ...sliding(0), id: 'b', name: 'b' }));
    wb.store.apply(setRetarget, { characterId: 'b', sourceId: 'a' });
    const all = measured(sourcesOf(wb));
    const series = seriesOf(all, 'feet', 'speed');
    expect(series.map(({ label }) => label.split(': ')[1])).toEqual(['LeftToe', 'RightToe', 'LeftToe', 'RightToe']);
    // They slide by a centimetre in a tenth of a second.
    for (const { values } of series) expect(values[5]).toBeCloseTo(0.1, 3);
    expect(seriesOf(all, 'joints', 'speed')).toHaveLength(2);
    expect(seriesOf(measured(sourcesOf(workbench(documentOf(take('a', 0))).wb)), 'feet', 'speed')).toEqual([]);
  });

  it('the CSV has exact numbers, a column a series, and a row for the times of all', () => {
    const frames = (startSeconds: number, frameSeconds: number) => ({ startSeconds, frameSeconds, frameCount: 2 });
    const series = [
      { label: '=a, "b"', frames: frames(0, 0.5), values: Float64Array.of(0.1, 1 / 3), source: 0, ordinal: 0 },
      { label: 'c', frames: frames(0.25, 0.25), values: Float64Array.of(-2, 1e-12), source: 1, ordinal: 0 },
    ];
    expect(seriesAsCsv(series, 'speed', 'm/s')).toBe(
      [
        `time (s),"'=a, ""b"" speed (m/s)",c speed (m/s)`,
        '0,0.1,',
        '0.25,,-2',
        '0.5,0.3333333333333333,1e-12',
        '',
      ].join('\r\n'),
    );
    expect(seriesAsCsv([], 'speed', 'm/s')).toBe('time (s)\r\n');
  });

  it('the value at a time is that of the nearest frame, and none is beyond the ends', () => {
    const frames = { startSeconds: 1, frameSeconds: 0.5, frameCount: 2 };
    const series = { label: 'a', frames, values: Float64Array.of(3, 4), source: 0, ordinal: 0 };
    expect([0.5, 1, 1.2, 1.3, 1.7, 2].map((t) => valueAt(series, t))).toEqual([undefined, 3, 3, 4, 4, undefined]);
  });
});

it('plotted takes span from the first frame of any to the last frame of any', () => {
  const frames = (startSeconds: number, frameCount: number) => ({
    frames: { startSeconds, frameSeconds: 0.5, frameCount },
  });
  expect(spanOf([])).toBeUndefined();
  expect(spanOf([frames(1, 3), frames(-2, 2)])).toEqual([-2, 2]);
});
