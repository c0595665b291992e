import { describe, expect, it } from 'vitest';
import type { Skeleton } from '../../../../src/model/skeleton/skeleton.ts';
import { nameNote } from '../../../../src/ui/editors/rig/joint-names.ts';
import { skeleton } from '../../builders.ts';

const named = (...names: readonly string[]): Skeleton => skeleton(...names.map((name, j) => [name, j - 1] as const));

describe('what is said of a joint’s name', () => {
  it('a joint’s note tells how a file writes its name, if not as it is', () => {
    expect(nameNote({ skeleton: named('left arm{') }, 0)).toBe('Saved as “left_arm_”.');
    expect(nameNote({ skeleton: named('left_arm') }, 0)).toBe('');
  });

  it('BVH names may contain blanks', () => {
    const { joints } = named('left arm', '{');
    const motion = { kind: 'bvh', channels: [], positions: 'replace' } as const;
    const bvh = { name: 'bvh', joints: joints.map((joint) => ({ ...joint, motion, limits: [], pose: [] })) };
    expect(nameNote({ skeleton: bvh }, 0)).toBe('');
    expect(nameNote({ skeleton: bvh }, 1)).toBe('Saved as “_”.');
  });

  it('a joint’s note tells that another joint has the same name', () => {
    const twice = { skeleton: named('a b', 'c', 'a b') };
    expect(nameNote(twice, 2)).toBe('Saved as “a_b”. Another joint has the same name. Files tell them apart by index.');
    expect(nameNote(twice, 1)).toBe('');
    expect(nameNote({ skeleton: named('', '') }, 1)).toBe('');
  });
});
