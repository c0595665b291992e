import { describe, expect, it } from 'vitest';
import { type Channel, type Extrapolation, restChannel } from '../../../../src/model/takes/take.ts';
import { firstRange, writtenOutText } from '../../../../src/ui/editors/ik/hold-dialog.ts';
import { character, skeleton, take } from '../../builders.ts';

const BODY = skeleton(['root', -1], ['toe_r', 0]);
/** x and y of the toe. */
const [TOE_X, TOE_Y] = [6, 7];

function keyed(before: Extrapolation, after: Extrapolation): Channel {
  const flat = { kinds: new Uint8Array(2), slopes: new Float64Array(2) };
  return {
    kind: 'keys',
    ...{ extrapolateIn: before, extrapolateOut: after, tangentsIn: flat, tangentsOut: flat },
    times: Float64Array.of(0, 1),
    values: Float64Array.of(0, 1),
  };
}

function takeWith(channels: Readonly<Record<number, Channel>>) {
  return { ...take([0, 6]), channels: Array.from({ length: 9 }, (_, i) => channels[i] ?? restChannel(0)) };
}

describe('what is asked for first when pins are held', () => {
  it('holding pins begins with the whole playback range where that is short', () => {
    expect(firstRange([1, 2.5], 2)).toEqual([1, 2.5]);
  });

  it('holding pins begins with half a second from the current time, within what is played', () => {
    expect(firstRange([0, 6], 2)).toEqual([2, 2.5]);
    expect(firstRange([0, 6], 5.9)).toEqual([5.5, 6]);
    expect(firstRange([0, 6], -3)).toEqual([0, 0.5]);
  });
});

describe('what is told of curves that repeated', () => {
  const before = character({
    skeleton: BODY,
    takes: [takeWith({ [TOE_X]: keyed('cycle', 'cycle'), [TOE_Y]: keyed('linear', 'linear') })],
  });

  it('names curves that are written out on either side, and no others', () => {
    const after = takeWith({ [TOE_X]: keyed('cycle', 'constant'), [TOE_Y]: keyed('constant', 'constant') });
    expect(writtenOutText(before, { take: after, channels: [TOE_X, TOE_Y] })).toBe(
      'toe_r rx no longer repeats: keys replace the cycle over the playback range.',
    );
  });

  it('mentions no curves that are unchanged', () => {
    const after = takeWith({ [TOE_X]: keyed('cycle', 'cycle') });
    expect(writtenOutText(before, { take: after, channels: [TOE_X] })).toBe('');
  });
});
