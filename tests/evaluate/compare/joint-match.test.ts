import { describe, expect, it } from 'vitest';
import { isSameSize, isSameSkeleton, matchJoints } from '../../../src/evaluate/compare/joint-match.ts';
import { skeleton } from '../../ui/builders.ts';

describe('joints of two skeletons', () => {
  const capture = skeleton(['hips', -1], ['leg_l', 0], ['foot', 1], ['leg_r', 0], ['foot', 3]);

  it('match by name and parent, whatever the order of siblings', () => {
    const other = skeleton(['hips', -1], ['leg_r', 0], ['foot', 1], ['leg_l', 0], ['foot', 3]);
    const match = matchJoints(capture, other);
    expect(match).toEqual({ first: [0, 1, 2, 3, 4], second: [0, 3, 4, 1, 2], onlyFirst: [], onlySecond: [] });
    expect(isSameSkeleton(match)).toBe(true);
  });

  it('joints of one name below one parent match in their order', () => {
    const twice = skeleton(['hips', -1], ['tail', 0], ['tail', 0]);
    expect(matchJoints(twice, twice)).toMatchObject({ first: [0, 1, 2], second: [0, 1, 2] });
  });

  it('joints of two skeletons without a partner are listed, with the whole limb below them', () => {
    const other = skeleton(['hips', -1], ['leg_l', 0], ['foot', 1], ['leg_x', 0], ['foot', 3]);
    const match = matchJoints(capture, other);
    expect(match).toEqual({ first: [0, 1, 2], second: [0, 1, 2], onlyFirst: [3, 4], onlySecond: [3, 4] });
    expect(isSameSkeleton(match)).toBe(false);
  });

  it('joints of skeletons with other names don’t match', () => {
    expect(matchJoints(capture, skeleton(['pelvis', -1], ['leg_l', 0])).first).toEqual([]);
  });

  it('skeletons are of one size if the bones that match are about as long, wherever their roots are', () => {
    const sized = (by: number, root = 0) => ({
      ...capture,
      joints: capture.joints.map((j, i) => ({ ...j, offset: [i === 0 ? root : 0, by, 0] as const })),
    });
    const isSame = (a: number, b: number) => isSameSize(sized(a), sized(b, 900), matchJoints(sized(a), sized(b, 900)));
    expect([isSame(1, 1.04), isSame(1, 1.2), isSame(1, 2.54), isSame(0, 0), isSame(0, 1)]).toEqual([
      true,
      false,
      false,
      true,
      false,
    ]);
    const strangers = skeleton(['pelvis', -1], ['leg_l', 0]);
    expect(isSameSize(capture, strangers, matchJoints(capture, strangers))).toBe(false);
  });
});
