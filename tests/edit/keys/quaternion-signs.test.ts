import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { keyPose } from '../../../src/edit/commands/keying.ts';
import { setLimit } from '../../../src/edit/commands/limits.ts';
import { resetPose, setDofs } from '../../../src/edit/commands/pose.ts';
import type { Document } from '../../../src/model/document.ts';
import { shownTake } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';

const turning = joint(-1, {
  motion: { kind: 'quaternion' },
  limits: [0, 1, 2, 3].map(() => UNLIMITED),
  pose: [0, 0, 0, 1],
});
const growing = joint(0, {
  motion: { kind: 'scale', mode: 'uniform', axis: [1, 0, 0] },
  limits: [UNLIMITED],
  pose: [2],
});
const skeleton = { name: 'hero', joints: [turning, growing] };
const hero = documentOf(character({ skeleton, pose: filePose(skeleton, 0) }));

/** Keys a quaternion, as auto-key does. */
const keyed = (document: Document, timeSeconds: number, values: readonly number[]) =>
  (
    setDofs.run(document, {
      characterId: 'c1',
      dofs: values.map((value, i) => ({ index: 3 + i, value })),
      timeSeconds,
      key: {},
    }) as { document: Document }
  ).document;
const valuesAt = (document: Document, key: number) =>
  [3, 4, 5, 6].map((c) => keysOf(shownTake(document.characters[0])?.channels[c]).values[key]);

describe('a key of a quaternion joint', () => {
  const first = keyed(hero, 0, [0, 0, 0.6, 0.8]);

  it('takes the sign that is nearer to the key before it', () => {
    expect(valuesAt(keyed(first, 1, [0, 0, -0.8, -0.6]), 1)).toEqual([0, 0, 0.8, 0.6]);
    expect(valuesAt(keyed(first, 1, [0.1, 0, 0.8, 0.6]), 1)).toEqual([0.1, 0, 0.8, 0.6]);
  });

  it('uses the previous key, not one that it replaces or that comes after', () => {
    expect(valuesAt(keyed(first, 0, [0, 0, -0.6, -0.8]), 0)).toEqual([0, 0, -0.6, -0.8]);
    expect(valuesAt(keyed(first, -1, [0, 0, -0.6, -0.8]), 0)).toEqual([0, 0, -0.6, -0.8]);
    const later = keyed(first, 2, [0, 0, 1, 0]);
    expect(valuesAt(keyed(later, 2, [0, 0, -1, 0]), 1)).toEqual([0, 0, 1, 0]);
  });

  it('a key of a quaternion joint is unchanged if not all of it is keyed', () => {
    const { document } = keyPose.run(first, { characterId: 'c1', dofs: [5], timeSeconds: 1 });
    expect(keysOf(shownTake(document.characters[0])?.channels[5]).values[1]).toBe(0.6);
  });
});

describe('DOFs that do not rest at 0', () => {
  const poseOf = (to: 'file' | 'zero') =>
    (resetPose.run(hero, { characterId: 'c1', to, timeSeconds: 0 }) as Document).characters[0].pose;

  it('DOFs that do not rest at 0 are reset to their neutral value, or to the file', () => {
    expect(poseOf('zero')).toEqual([0, 0, 0, 0, 0, 0, 1, 1]);
    expect(poseOf('file')).toEqual([0, 0, 0, 0, 0, 0, 1, 2]);
  });

  it('take limits, but those of a quaternion', () => {
    expect(setLimit.run(hero, { characterId: 'c1', dof: 7, min: 0.5, max: 2 })).not.toBe(hero);
    expect(() => setLimit.run(hero, { characterId: 'c1', dof: 3, min: 0, max: 1 })).toThrow(CommandError);
  });
});
