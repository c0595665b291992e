import { expect, it } from 'vitest';
import { perSkeleton } from '../../../src/model/skeleton/per-skeleton.ts';
import { sharedJoints } from '../../../src/model/skeleton/shared-joints.ts';
import type { Joint } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';

/** Made anew each time, as by a reader. */
const read = (change: Partial<Joint> = {}): readonly Joint[] => [
  joint(-1, { name: 'Hips', endSites: [[0, 1, 0]], ...change }),
  joint(0, { name: 'Spine', offset: [0, 2, 0] }),
];

it('equal joints of another file are the joints read before', () => {
  const first = sharedJoints(read());
  expect(sharedJoints(read())).toBe(first);
});

it.each([
  { name: 'hips' },
  { offset: [0, 0, 1e-12] },
  { offset: [0, -0, 0] },
  { endSites: [[0, 1, 0.5]] },
  { endSites: [] },
  { role: 'hips' },
  { limits: [] },
] satisfies Partial<Joint>[])('joints that differ in %o stay their own', (change) => {
  sharedJoints(read());
  const other = read(change);
  expect(sharedJoints(other)).toBe(other);
});

it('joints of eight skeletons are remembered, those used last', () => {
  const kept = sharedJoints(read({ name: 'kept' }));
  const gone = sharedJoints(read({ name: 'gone' }));
  for (let i = 0; i < 7; i++) {
    sharedJoints(read({ name: `other ${i}` }));
    expect(sharedJoints(read({ name: 'kept' }))).toBe(kept);
  }
  expect(sharedJoints(read({ name: 'gone' }))).not.toBe(gone);
});

it('what is computed from joints is computed once for skeletons of different names', () => {
  let made = 0;
  const count = perSkeleton(({ joints }) => {
    made++;
    return joints.length;
  });
  const joints = read();
  expect(count({ name: 'walk', joints })).toBe(2);
  expect(count({ name: 'run', joints })).toBe(2);
  expect(made).toBe(1);
  expect(count({ name: 'walk', joints: joints.slice(0, 1) })).toBe(1);
});
