import { expect, it } from 'vitest';
import { type Channel, restChannel } from '../../../../../src/model/takes/take.ts';
import { changesBeyond } from '../../../../../src/ui/editors/curves/dialogs/tool-changes.ts';
import { channel, take } from '../../../builders.ts';

const cycle = { extrapolateIn: 'cycle', extrapolateOut: 'cycle' } as const;
const takeOf = (...channels: Channel[]) => take([0, 2], ...channels);

it('does not mention curves whose extrapolation is unchanged', () => {
  const before = takeOf({ ...channel(0, 2), ...cycle }, channel(0, 1), { ...channel(0, 1), extrapolateOut: 'linear' });
  const after = takeOf({ ...channel(0, 1, 2), ...cycle }, channel(0, 3), {
    ...channel(0, 3),
    extrapolateOut: 'linear',
  });
  expect(changesBeyond(before, after, [0, 1, 2])).toEqual([]);
});

it('tells when a cycle becomes constant, and when it will repeat new keys', () => {
  const before = takeOf({ ...channel(0, 2), ...cycle }, { ...channel(0, 2), ...cycle }, restChannel());
  const baked = { ...channel(0, 2, 4), ...cycle, extrapolateOut: 'constant' } as const;
  expect(changesBeyond(before, takeOf(baked, baked, restChannel()), [0, 1, 2])).toEqual([
    'Before the keys, 2 curves will repeat all keys, including the new ones: every 4 s instead of every 2 s.',
    'After the keys, 2 curves will be constant instead of cycle.',
  ]);
});

it('gives no numbers if they differ between curves', () => {
  const before = takeOf({ ...channel(0, 2), ...cycle }, { ...channel(0, 1), ...cycle });
  const after = takeOf({ ...channel(0, 2, 4), ...cycle }, { ...channel(0, 1, 4), ...cycle });
  const sentence = '2 curves will repeat all keys, including the new ones: at different intervals than before.';
  expect(changesBeyond(before, after, [0, 1])).toEqual([`Before the keys, ${sentence}`, `After the keys, ${sentence}`]);
});

it('mentions the given curves only', () => {
  const before = takeOf({ ...channel(0, 2), ...cycle });
  expect(changesBeyond(before, takeOf(channel(0, 2)), [])).toEqual([]);
});
