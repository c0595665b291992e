import { describe, expect, it } from 'vitest';
import type { Skeleton } from '../../../../src/model/skeleton.ts';
import { nameNote } from '../../../../src/ui/editors/rig/joint-names.ts';
import { skeleton } from '../../builders.ts';

const named = (...names: readonly string[]): Skeleton => skeleton(...names.map((name, j) => [name, j - 1] as const));

describe('what is said of a joint’s name', () => {
  it('what is said of a joint’s name is how a file writes it, where it can’t be written as it is', () => {
    expect(nameNote({ skeleton: named('left arm{') }, 0)).toBe('Saved as “left_arm_”.');
    expect(nameNote({ skeleton: named('left_arm') }, 0)).toBe('');
  });

  it('knows that BVH takes blanks within a name', () => {
    const { joints } = named('left arm', '{');
    const motion = { kind: 'bvh', channels: [], positions: 'replace' } as const;
    const bvh = { name: 'bvh', joints: joints.map((joint) => ({ ...joint, motion, limits: [], pose: [] })) };
    expect(nameNote({ skeleton: bvh }, 0)).toBe('');
    expect(nameNote({ skeleton: bvh }, 1)).toBe('Saved as “_”.');
  });

  it('what is said of a joint’s name is that another joint is called so, which is no fault', () => {
    const twice = { skeleton: named('a b', 'c', 'a b') };
    expect(nameNote(twice, 2)).toBe('Saved as “a_b”. Another joint has the same name. They are told apart by index.');
    expect(nameNote(twice, 1)).toBe('');
    expect(nameNote({ skeleton: named('', '') }, 1)).toBe('');
  });
});
