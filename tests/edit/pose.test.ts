import { describe, expect, it } from 'vitest';
import { documentIn } from '../../src/edit/change.ts';
import { resetPose, setClamping, setDofs } from '../../src/edit/commands/pose.ts';
import { documentWithoutUnkeyed } from '../../src/edit/unkeyed.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { keysOf, restChannel } from '../../src/model/takes/take.ts';
import { character, documentOf, joint, morph, takeOfValues } from '../helpers/builders.ts';

const limited = joint(-1, {
  name: 'hip',
  limits: [
    { min: -1, max: 1 },
    { min: 2, max: -2 },
    { min: 0, max: 0 },
  ],
  pose: [3, 0, 0],
});
const still = documentOf(character({ skeleton: { name: 's', joints: [limited] }, morphs: [morph('smile')] }));
const set = (document: typeof still, index: number, value: number, timeSeconds = 0) =>
  documentIn(setDofs.run(document, { characterId: 'c1', dofs: [{ index, value }], timeSeconds }));
const poseOf = (document: typeof still) => document.characters[0].pose;

describe('pose.setDofs', () => {
  it('clamps to the limits, ignoring crossed ones', () => {
    expect(poseOf(set(still, 3, 5))[3]).toBe(1);
    expect(poseOf(set(still, 4, 5))[4]).toBe(5);
  });

  it('pose.setDofs does not clamp root translation, morph weights, or a character whose switch is off', () => {
    expect(poseOf(set(still, 1, 1e6))[1]).toBe(1e6);
    expect(poseOf(set(still, 6, 1.5))[6]).toBe(1.5);
    const free = setClamping.run(still, { characterId: 'c1', clamps: false });
    expect(poseOf(set(free, 3, 5))[3]).toBe(5);
  });

  it('pose.setDofs names what it sets', () => {
    const label = (...indices: number[]) =>
      setDofs.label(still, { characterId: 'c1', dofs: indices.map((index) => ({ index, value: 0 })), timeSeconds: 0 });
    expect([label(0), label(3), label(6)]).toEqual(['Move hip (tx)', 'Rotate hip (rx)', 'Set morph smile']);
    expect([label(3, 4, 5), label(0, 1), label(0, 3), label(3, 6)]).toEqual([
      'Rotate hip',
      'Move hip',
      'Pose hip',
      'Pose 2 DOFs',
    ]);
  });

  it('refuses a DOF that is not there, and values that are no numbers', () => {
    expect(() => set(still, 7, 0)).toThrow('There is no DOF number 7; there are 7.');
    expect(() => set(still, 3, Number.NaN)).toThrow('finite');
  });

  it('returns the same document if nothing changes', () => {
    expect(set(still, 0, 0)).toBe(still);
  });
});

describe('what is set by hand over a take', () => {
  const playing = documentOf(
    character({
      skeleton: { name: 's', joints: [limited] },
      takes: [takeOfValues('walk', [0, 0, 0, 0.5])],
      shownTake: 0,
    }),
  );

  it('what is set by hand over a take is no unkeyed change if the keys give that value, and is discarded when it returns to it', () => {
    const shown = new Float64Array(dofCountOf(playing.characters[0]));
    poseAt(playing.characters[0], 1.5, shown);
    expect(set(playing, 3, shown[3], 1.5)).toBe(playing);
    const once = set(set(playing, 3, 0.25, 1.5), 0, 2, 1.5);
    expect(set(once, 3, shown[3], 1.5).characters[0].unkeyed).toEqual({ timeSeconds: 1.5, dofs: [0], values: [2] });
  });

  it('what is set by hand over a take is unkeyed at that time, if a channel drives it', () => {
    const once = set(playing, 3, 0.25, 1.5);
    expect(once.characters[0].unkeyed).toEqual({ timeSeconds: 1.5, dofs: [3], values: [0.25] });
    expect(set(once, 0, 2, 1.5).characters[0].unkeyed).toEqual({
      timeSeconds: 1.5,
      dofs: [0, 3],
      values: [2, 0.25],
    });
    expect(set(once, 0, 2, 1.6).characters[0].unkeyed).toEqual({ timeSeconds: 1.6, dofs: [0], values: [2] });
  });

  it('what is set by hand over a take is part of the pose if no channel drives it', () => {
    expect(set(playing, 5, 0, 1.5).characters[0].unkeyed).toBeUndefined();
  });

  it('what is set by hand over a take is no part of the pose, and leaves no trace when discarded', () => {
    const once = set(playing, 3, 0.25, 1.5);
    expect(poseOf(once)).toEqual(poseOf(playing));
    expect(documentWithoutUnkeyed(once, 2).characters[0]).toEqual(playing.characters[0]);
  });

  it('what is set by hand over a take is discarded when the time changes', () => {
    const once = set(playing, 3, 0.25, 1.5);
    expect(documentWithoutUnkeyed(once, 1.5)).toBe(once);
    expect(documentWithoutUnkeyed(once, 1.6).characters[0].unkeyed).toBeUndefined();
  });
});

describe('what is set by hand where a channel has no keys', () => {
  const take = takeOfValues('walk', [0, 0, 0, 0.5]);
  const channels = [...take.channels, restChannel(0.25), restChannel()];
  const playing = documentOf(
    character({
      skeleton: { name: 's', joints: [limited] },
      morphs: [morph('smile')],
      takes: [{ ...take, channels }, take],
      shownTake: 0,
    }),
  );
  const channelsOf = (document: typeof playing) => document.characters[0].takes[0].channels;

  it('a value set by hand on a channel without keys holds at every time', () => {
    const once = set(playing, 4, 0.75, 1.5);
    expect(once.characters[0].unkeyed).toBeUndefined();
    expect(channelsOf(once)[4]).toMatchObject({ kind: 'rest', value: 0.75 });
    const shown = new Float64Array(7);
    for (const time of [0, 1.5, 9]) {
      poseAt(once.characters[0], time, shown);
      expect(shown[4]).toBe(0.75);
    }
  });

  it('belongs to the take: neither the pose beneath nor other channels change', () => {
    const once = set(playing, 4, 0.75);
    expect(once.characters[0].pose).toBe(playing.characters[0].pose);
    expect(once.characters[0].takes[1]).toBe(take);
    expect(channelsOf(once).filter((c, i) => c !== channelsOf(playing)[i])).toHaveLength(1);
  });

  it('shows, though it was set by hand over keys that are gone', () => {
    const byHand = set(playing, 3, 0.9, 2);
    const [hero] = byHand.characters;
    const keyless = documentOf({ ...hero, takes: [{ ...take, channels: take.channels.with(3, restChannel()) }] });
    expect(set(keyless, 3, 0.1, 2).characters[0].unkeyed).toBeUndefined();
  });

  it('what is set by hand where a channel has no keys is 0 without a word about it, as a channel without keys is', () => {
    expect(channelsOf(set(playing, 4, 0))[4]).toEqual(restChannel());
    expect(set(playing, 4, 0.25)).toBe(playing);
  });

  it('stores each value where it belongs, in one step', () => {
    const values = [0.9, 0.8, 0.7].map((value, i) => ({ index: [3, 4, 6][i], value }));
    const once = documentIn(setDofs.run(playing, { characterId: 'c1', dofs: values, timeSeconds: 2 }));
    expect(once.characters[0].unkeyed).toEqual({ timeSeconds: 2, dofs: [3], values: [0.9] });
    expect(channelsOf(once)[4]).toMatchObject({ kind: 'rest', value: 0.8 });
    expect(poseOf(once)[6]).toBe(0.7);
  });
});

describe('with auto-key', () => {
  const key = { tangents: 'linear' as const };

  it('a value is a key at that moment, whoever had the say before', () => {
    const change = { characterId: 'c1', dofs: [{ index: 3, value: 5 }], timeSeconds: 0.5, key };
    const result = setDofs.run(still, change);
    const [hero] = documentIn(result).characters;
    const [channel] = hero.takes[0].channels.slice(3);
    // Within the limits, as without it.
    expect([[...keysOf(channel).times], [...keysOf(channel).values]]).toEqual([[0.5], [1]]);
    expect(hero.takes[0].channels.filter((c) => keysOf(c).times.length > 0)).toHaveLength(1);
    expect(hero.unkeyed).toBeUndefined();
    expect(hero.pose).toEqual(poseOf(still));
    expect('document' in result && result.keys).toEqual([{ channel: 3, indices: [0] }]);
    expect(setDofs.label(still, change)).toBe('Key rx of hip');
  });

  it('a reset is one of every DOF', () => {
    const reset = resetPose.run(still, { characterId: 'c1', to: 'zero', timeSeconds: 0, key });
    const [take] = documentIn(reset).characters[0].takes;
    expect(take.channels.map((c) => [...keysOf(c).values])).toEqual(new Array(7).fill([0]));
  });
});

describe('pose.reset', () => {
  it('returns to the file pose or to zero', () => {
    const moved = set(set(still, 0, 4), 6, 1);
    const reset = (to: 'file' | 'zero') =>
      poseOf(documentIn(resetPose.run(moved, { characterId: 'c1', to, timeSeconds: 0 })));
    expect(reset('file')).toEqual([0, 0, 0, 3, 0, 0, 0]);
    expect(reset('zero')).toEqual([0, 0, 0, 0, 0, 0, 0]);
  });
});
