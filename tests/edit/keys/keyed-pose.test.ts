import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { keyPose } from '../../../src/edit/commands/keying.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { abruptKey, keyedPose } from '../../../src/edit/keys/keyed-pose.ts';
import type { KeyedChannel } from '../../../src/model/takes/take.ts';
import { restChannel } from '../../../src/model/takes/take.ts';
import { character, documentOf, skeleton, take } from '../../ui/builders.ts';
import { channelOf } from './channels.ts';

const WALK = channelOf(
  [
    [0, 0],
    [0.4, 1],
    [0.8, 0],
  ],
  'cycle',
);
const DENSE = channelOf(Array.from({ length: 61 }, (_, i) => [i / 30, 0] as const));

function posedAt(channel: KeyedChannel, timeSeconds: number, value: number) {
  const channels = [restChannel(), restChannel(), restChannel(), channel, restChannel(), restChannel()];
  const start = documentOf(character({ skeleton: skeleton(['hips', -1]), takes: [take([0, 2], ...channels)] }));
  const before = documentIn(setDofs.run(start, { characterId: 'c1', dofs: [{ index: 3, value }], timeSeconds }));
  const after = documentIn(keyPose.run(before, { characterId: 'c1', dofs: [3, 4], timeSeconds }));
  return { before, after };
}

describe('a pose that was keyed', () => {
  it('is told by the DOFs that have another value than their curve had', () => {
    const { before, after } = posedAt(DENSE, 1, 0.5);
    expect(keyedPose(before, after, 1)).toEqual({ characterId: 'c1', dofs: [{ index: 3, value: 0.5 }] });
    expect(keyedPose(before, after, 1.2)).toBeUndefined();
    const still = posedAt(DENSE, 1, 0);
    expect(keyedPose(still.before, still.after, 1)).toBeUndefined();
  });

  it('is abrupt between keys of every frame and within a cycle, and not between keys far apart', () => {
    const of = (channel: KeyedChannel, time: number) => {
      const { before, after } = posedAt(channel, time, 0.5);
      return abruptKey(after.characters[0], keyedPose(before, after, time)?.dofs ?? [], time);
    };
    expect(of(DENSE, 1)).toEqual({ kind: 'jumps', dof: 3, seconds: expect.closeTo(1 / 30, 9) });
    expect(of(WALK, 0.2)).toEqual({ kind: 'repeats', dof: 3, seconds: 0.8 });
    const sparse = channelOf([
      [0, 0],
      [2, 0],
    ]);
    expect(of(sparse, 1)).toBeUndefined();
  });
});
