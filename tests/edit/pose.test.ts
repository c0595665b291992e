import { describe, expect, it } from 'vitest';
import { dropUnkeyed, resetPose, setClamping, setDofs } from '../../src/edit/commands/pose.ts';
import { character, clip, documentOf, joint, morph } from '../helpers/builders.ts';

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
  setDofs.run(document, { characterId: 'c1', dofs: [{ index, value }], timeSeconds });
const poseOf = (document: typeof still) => document.characters[0].pose;

describe('pose.setDofs', () => {
  it('clamps to the limits, ignoring crossed ones', () => {
    expect(poseOf(set(still, 3, 5))[3]).toBe(1);
    expect(poseOf(set(still, 4, 5))[4]).toBe(5);
  });

  it('does not clamp root translation, morph weights, or a character whose switch is off', () => {
    expect(poseOf(set(still, 1, 1e6))[1]).toBe(1e6);
    expect(poseOf(set(still, 6, 1.5))[6]).toBe(1.5);
    const free = setClamping.run(still, { characterId: 'c1', clamps: false });
    expect(poseOf(set(free, 3, 5))[3]).toBe(5);
  });

  it('names what it sets', () => {
    const label = (index: number) =>
      setDofs.label(still, { characterId: 'c1', dofs: [{ index, value: 0 }], timeSeconds: 0 });
    expect([label(0), label(3), label(6)]).toEqual(['Set tx of hip', 'Set rx of hip', 'Set morph smile']);
  });

  it('refuses a DOF that is not there, and values that are no numbers', () => {
    expect(() => set(still, 7, 0)).toThrow('7 DOFs');
    expect(() => set(still, 3, Number.NaN)).toThrow('finite');
  });

  it('gives the very same document back where nothing changes', () => {
    expect(set(still, 0, 0)).toBe(still);
  });
});

describe('what is set by hand over a clip', () => {
  const playing = documentOf(
    character({ skeleton: { name: 's', joints: [limited] }, clips: [clip('walk', [0, 0, 0, 0.5])], shownClip: 0 }),
  );

  it('is unkeyed for that moment, where a channel drives it', () => {
    const once = set(playing, 3, 0.25, 1.5);
    expect(once.characters[0].unkeyed).toEqual({ timeSeconds: 1.5, dofs: [3], values: [0.25] });
    expect(set(once, 0, 2, 1.5).characters[0].unkeyed).toEqual({
      timeSeconds: 1.5,
      dofs: [0, 3],
      values: [2, 0.25],
    });
    expect(set(once, 0, 2, 1.6).characters[0].unkeyed).toEqual({ timeSeconds: 1.6, dofs: [0], values: [2] });
  });

  it('is part of the pose where none does', () => {
    expect(set(playing, 5, 0, 1.5).characters[0].unkeyed).toBeUndefined();
  });

  it('is no part of the pose, and leaves no trace when it goes', () => {
    const once = set(playing, 3, 0.25, 1.5);
    expect(poseOf(once)).toEqual(poseOf(playing));
    expect(dropUnkeyed(once, 2).characters[0]).toEqual(playing.characters[0]);
  });

  it('goes when time moves on', () => {
    const once = set(playing, 3, 0.25, 1.5);
    expect(dropUnkeyed(once, 1.5)).toBe(once);
    expect(dropUnkeyed(once, 1.6).characters[0].unkeyed).toBeUndefined();
  });
});

describe('pose.reset', () => {
  it('goes back to the file’s pose or to zero', () => {
    const moved = set(set(still, 0, 4), 6, 1);
    const reset = (to: 'file' | 'zero') => poseOf(resetPose.run(moved, { characterId: 'c1', to, timeSeconds: 0 }));
    expect(reset('file')).toEqual([0, 0, 0, 3, 0, 0, 0]);
    expect(reset('zero')).toEqual([0, 0, 0, 0, 0, 0, 0]);
  });
});
