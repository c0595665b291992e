import { describe, expect, it } from 'vitest';
import { DEFAULT_PLACEMENT } from '../../../../src/model/document.ts';
import type { Take } from '../../../../src/model/takes/take.ts';
import { listedTakes, takeRows } from '../../../../src/ui/editors/takes/rows.ts';
import { character, documentOf, takeOfValues, takesFrom } from '../../../helpers/builders.ts';

const sampled = (name: string, frameCount: number): Take => ({
  ...takeOfValues(name, [], [0, (frameCount - 1) / 50]),
  samples: {
    frameCount,
    frameSeconds: 0.02,
    startSeconds: 0,
    firstChannel: 0,
    values: new Float64Array(frameCount),
    scales: Float64Array.of(1),
    interpolation: 'linear',
  },
});

const document = documentOf(
  character({
    id: 'c1',
    name: 'walk_10',
    takes: [sampled('walk_10', 11)],
    shownTake: 0,
    parts: takesFrom('day1/walk_10.bvh'),
  }),
  character({
    id: 'c2',
    name: 'wasp',
    takes: [takeOfValues('walk_2', [0]), takeOfValues('sting', [0], [0, 3])],
    shownTake: 1,
    parts: takesFrom('walk_2.anim', 'sting.anim'),
    placements: [{ ...DEFAULT_PLACEMENT, position: [2, 0, -1] }],
    timeOffsetSeconds: 0.5,
  }),
  character({ id: 'c3', name: 'rig' }),
);

describe('the rows of takes', () => {
  const rows = takeRows(document);

  it('the rows of takes are one for each take of each character', () => {
    expect(rows.map((r) => [r.key, r.name, r.character, r.isShown, r.file])).toEqual([
      ['c1/0', 'walk_10', '', true, 'day1/walk_10.bvh'],
      ['c2/0', 'walk_2', 'wasp', false, 'walk_2.anim'],
      ['c2/1', 'sting', 'wasp', true, 'sting.anim'],
    ]);
  });

  it('tell frames and frame rate of sampled takes, and when and where they play', () => {
    expect(rows[0]).toMatchObject({ frameCount: 11, framesPerSecond: 50, durationSeconds: 0.2 });
    expect(rows[2]).toMatchObject({ durationSeconds: 3, offsetSeconds: 0.5, startSeconds: -0.5, x: 2, z: -1 });
    expect(rows[2]).not.toHaveProperty('frameCount');
  });

  it('keyed takes have the frame rate that their file states, or that of their keys, and frames by it', () => {
    const every = (rate: number): Take => {
      const [channel] = takeOfValues('one', [0]).channels;
      if (channel.kind !== 'keys') throw new Error('The helper makes keys.');
      const times = Float64Array.from({ length: 49 }, (_, frame) => frame / rate);
      const flat = { kinds: new Uint8Array(49), slopes: new Float64Array(49) };
      const keys = { ...channel, times, values: new Float64Array(49), tangentsIn: flat, tangentsOut: flat };
      return { name: 'even', range: [0, 48 / rate], channels: [keys] };
    };
    const takes = [
      { ...takeOfValues('stated', [0], [0, 2]), framesPerSecond: 60 },
      every(24),
      takeOfValues('uneven', [0], [0, 3]),
    ];
    expect(takeRows(documentOf(character({ takes })))).toMatchObject([
      { isKeyed: true, framesPerSecond: 60, frameCount: 121 },
      { isKeyed: true, framesPerSecond: 24, frameCount: 49 },
      { isKeyed: true, durationSeconds: 3 },
    ]);
  });

  it('hidden characters show no take', () => {
    const [c1] = document.characters;
    expect(takeRows(documentOf({ ...c1, isHidden: true }))[0]).toMatchObject({ isShown: false, isHidden: true });
  });

  it('the rows of takes are the same objects as long as their character is', () => {
    const [, c2] = document.characters;
    const next = takeRows({ ...document, characters: [c2] });
    expect(next[0]).toBe(rows[1]);
  });
});

describe('the Takes tab', () => {
  const names = (...args: Parameters<typeof listedTakes>) => listedTakes(...args).map((r) => r.name);
  const rows = takeRows(document);

  it('finds takes with every word in the name, the character or the file', () => {
    expect(names(rows, 'WALK', undefined)).toEqual(['walk_10', 'walk_2']);
    expect(names(rows, 'wasp walk', undefined)).toEqual(['walk_2']);
    expect(names(rows, 'day1', undefined)).toEqual(['walk_10']);
  });

  it('sorts by a column, numbers in names as numbers', () => {
    expect(names(rows, '', { column: 'name', descending: false })).toEqual(['sting', 'walk_2', 'walk_10']);
    expect(names(rows, '', { column: 'duration', descending: true })).toEqual(['sting', 'walk_2', 'walk_10']);
  });

  it('leaves equal ones in the document’s order, either way', () => {
    const order = { column: 'start', descending: true } as const;
    expect(names(rows, '', { ...order, descending: false })).toEqual(['walk_2', 'sting', 'walk_10']);
    expect(names(rows, '', { ...order, column: 'rate' })).toEqual(['walk_10', 'walk_2', 'sting']);
  });
});
