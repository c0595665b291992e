import { describe, expect, it } from 'vitest';
import { type Extrapolation, type KeyedChannel, restChannel } from '../../../../../src/model/takes/take.ts';
import { LINEAR } from '../../../../../src/model/takes/tangent-kinds.ts';
import { whyValue } from '../../../../../src/teaching/explain/channel-why.ts';
import { type WhyPlace, whySubject } from '../../../../../src/ui/editors/curves/why/why-subject.ts';
import { keyLines, placeLines, slopeLines } from '../../../../../src/ui/editors/curves/why/why-text.ts';
import { channel, take } from '../../../builders.ts';

const TIMES = [0, 0.5, 0.75, 2];

function wave(extrapolation: Extrapolation = 'constant'): KeyedChannel {
  const made = { ...channel(...TIMES), extrapolateIn: extrapolation, extrapolateOut: extrapolation };
  made.values.set([1, -0.3, 0.25, 4]);
  made.tangentsIn.kinds.fill(LINEAR);
  made.tangentsOut.kinds.fill(LINEAR);
  return made;
}

describe('what Why this curve explains', () => {
  const place: WhyPlace = {
    hover: { kind: 'empty' },
    pointerTime: undefined,
    playhead: 0.4,
    selected: [],
    drawn: [3, 4],
    timesOf: () => Float64Array.from(TIMES),
  };
  const selected = [
    { channel: 3, indices: [0] },
    { channel: 4, indices: [1, 2] },
  ];

  it('the curve under the pointer comes first, there, with its selected key', () => {
    const hover = { kind: 'curve', channel: 3, timeSeconds: 0.6, value: 0 } as const;
    expect(whySubject({ ...place, hover, pointerTime: 0.61 })).toEqual({ channel: 3, time: 0.6 });
    expect(whySubject({ ...place, hover, selected })).toEqual({ channel: 3, time: 0.6, key: 0 });
  });

  it('a key or handle under the pointer is explained itself, unless a drag has deleted it', () => {
    const hover = { kind: 'key', channel: 4, index: 2 } as const;
    expect(whySubject({ ...place, hover, selected })).toEqual({ channel: 4, time: 0.75, key: 2 });
    expect(whySubject({ ...place, hover: { ...hover, index: 9 } })).toEqual({ channel: 3, time: 0.4 });
  });

  it('else it is the channel of the last selected key, or the first one drawn, under the pointer or at the playhead', () => {
    expect(whySubject({ ...place, selected, pointerTime: 1 })).toEqual({ channel: 4, time: 1, key: 2 });
    expect(whySubject({ ...place, selected })).toEqual({ channel: 4, time: 0.4, key: 2 });
    expect(whySubject(place)).toEqual({ channel: 3, time: 0.4 });
    expect(whySubject({ ...place, drawn: [] })).toBeUndefined();
  });
});

describe('the sentences of Why this curve', () => {
  const linesAt = (time: number, extrapolation?: Extrapolation) => {
    const why = whyValue(take([0, 2], wave(extrapolation)), 0, time);
    return why ? placeLines(why) : [];
  };

  it('tell where the slopes of a key come from, in numbers', () => {
    expect(keyLines(wave(), 2)).toEqual([
      'Key 2: 0.25 at 0.75 s',
      'linear in: (0.25 − (−0.3)) / (0.75 − 0.5) = 2.2',
      'linear out: (4 − 0.25) / (2 − 0.75) = 3',
    ]);
  });

  it('tell the segment of a time, and its slopes', () => {
    expect(linesAt(0.6)).toEqual(['Between keys 1 and 2, 0.25 s apart.']);
    expect(linesAt(0.75)).toEqual(['At key 2: the key’s own value.']);
    const why = whyValue(take([0, 2], wave()), 0, 0.6);
    if (why?.kind !== 'keys' || !why.segment) throw new Error('No segment.');
    expect(slopeLines(wave(), why.segment)[1]).toBe('m₁, linear in: (0.25 − (−0.3)) / (0.75 − 0.5) = 2.2');
  });

  it('tell what becomes of a time outside the keys', () => {
    expect(linesAt(5)).toEqual(['After the last key, constant: the value of key 3.']);
    expect(linesAt(-1, 'linear')).toEqual(['Before the first key, linear: the value of key 0 + −2.6 · (−1) s.']);
    expect(linesAt(4.6, 'cycle_offset')).toEqual([
      'After the last key, cycle_offset: period 2 of 2 s.',
      'Folded to 0.6 s.',
      'Added: 2 · 3 = 6.',
      'Between keys 1 and 2, 0.25 s apart.',
    ]);
    expect(linesAt(-0.6, 'bounce').slice(0, 2)).toEqual([
      'Before the first key, bounce: period −1 of 2 s.',
      'Folded to 0.6 s, backwards since it is odd.',
    ]);
    expect(linesAt(4, 'cycle').at(-1)).toBe('At key 0: the key’s own value.');
  });

  it('tell of samples the frames between which a time is, and of a channel without keys that it rests', () => {
    const samples = { kind: 'samples', interpolation: 'linear', frame: 3.25, frameCount: 10, value: 1 } as const;
    expect(placeLines(samples)).toEqual(['Between frames 3 and 4, 0.25 of the way: linear.']);
    expect(placeLines({ ...samples, frame: 3 })).toEqual(['Frame 3 of 10, from 0: the sample itself.']);
    expect(placeLines({ kind: 'rest', value: restChannel(2).value })).toEqual([
      'No keys: the channel keeps one value.',
    ]);
  });
});
