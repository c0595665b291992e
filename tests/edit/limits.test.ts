import { describe, expect, it } from 'vitest';
import { clearLimit, setLimit } from '../../src/edit/commands/limits.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import { UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { character, documentOf, morph, skeleton } from '../helpers/builders.ts';

const document = documentOf(
  character({ skeleton: skeleton(2), morphs: [morph('smile')], pose: [9, 0, 0, 0, 0, 0, 0, 2, 0, 0] }),
);
const only = (d: typeof document) => d.characters[0];
const limit = (dof: number, min: number, max: number, on = document) =>
  setLimit.run(on, { characterId: 'c1', dof, min, max });

describe('skeleton.setLimit', () => {
  it('clamps the DOF from then on, and keeps the pose as it was set', () => {
    const limited = only(limit(7, -1, 1));
    const shown = new Float64Array(dofCountOf(limited));
    poseAt(limited, 0, shown);
    expect(shown[7]).toBe(1);
    expect(limited.pose).toBe(only(document).pose);
  });

  it('skeleton.setLimit changes the one joint only', () => {
    const before = only(document).skeleton?.joints ?? [];
    const after = only(limit(7, -1, 1)).skeleton?.joints ?? [];
    expect(after.map((j, i) => j === before[i])).toEqual([true, false]);
    expect(after[1].limits).toEqual([UNLIMITED, { min: -1, max: 1 }, UNLIMITED]);
  });

  it('skeleton.setLimit is in the .skel that is saved', () => {
    const limited = only(limit(7, -1, 0.5)).skeleton;
    if (!limited) throw new Error('no skeleton');
    const { value } = readSkel(writeSkel([limited], 'hero.skel').text, 'hero.skel');
    expect(value?.[0].joints[1].limits[1]).toEqual({ min: -1, max: 0.5 });
  });

  it('returns the same document if the limits do not change', () => {
    const once = limit(7, -1, 1);
    expect(limit(7, -1, 1, once)).toBe(once);
  });

  it('refuses crossed limits, and DOFs that have none', () => {
    expect(() => limit(7, 1, -1)).toThrow('above');
    expect(() => limit(0, -1, 1)).toThrow('tx of joint0 can’t have limits');
    expect(() => limit(9, 0, 1)).toThrow('morph smile can’t have limits');
    expect(() => limit(10, 0, 1)).toThrow('no DOF number 10');
    expect(() => limit(7, Number.NEGATIVE_INFINITY, 1)).toThrow('finite');
  });
});

describe('skeleton.clearLimit', () => {
  it('skeleton.clearLimit takes them off', () => {
    const cleared = clearLimit.run(limit(7, -1, 1), { characterId: 'c1', dof: 7 });
    expect(only(cleared).skeleton?.joints[1].limits).toEqual([UNLIMITED, UNLIMITED, UNLIMITED]);
    expect(clearLimit.run(document, { characterId: 'c1', dof: 7 })).toBe(document);
  });
});
