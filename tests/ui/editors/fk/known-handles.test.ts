import { expect, it } from 'vitest';
import { jointHandles } from '../../../../src/evaluate/handles/joint-handles.ts';
import { KnownHandles } from '../../../../src/ui/editors/fk/known-handles.ts';
import { skeleton } from '../../builders.ts';

const ARM = skeleton(['shoulder', -1], ['elbow', 0]);
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const dofs = () => new Float64Array(9);
const world = Float64Array.from([...IDENTITY, ...IDENTITY]);
const placement = () => Float64Array.from(IDENTITY);

it('returns the same handles for the same pose at the same placement', () => {
  const known = new KnownHandles();
  const first = known.of(ARM, 1, dofs(), world, placement(), true);
  expect(first).toEqual(jointHandles(ARM, 1, dofs(), world, placement()));
  expect(known.of(ARM, 1, dofs(), world, placement(), true)).toBe(first);
});

it('recomputes them for another pose, placement, joint or skeleton', () => {
  const known = new KnownHandles();
  const [pose, place] = [dofs(), placement()];
  const seen = [known.of(ARM, 1, pose, world, place, true)];
  const again = (...args: Parameters<typeof jointHandles>) => {
    const found = known.of(...args, true);
    expect(seen).not.toContain(found);
    expect(found).toEqual(jointHandles(...args));
    seen.push(found);
  };
  // The view overwrites its own arrays.
  pose[6] = 0.3;
  again(ARM, 1, pose, world, place);
  place[12] = 2;
  again(ARM, 1, pose, world, place);
  again(ARM, 0, pose, world, place);
  again({ ...ARM }, 0, pose, world, place);
});

it('a locked DOF has no handle while limits are enforced', () => {
  const limits = ARM.joints[1].limits.map((limit, i) => (i === 2 ? { min: 0.1, max: 0.1 } : limit));
  const locked = { ...ARM, joints: ARM.joints.map((one, j) => (j === 1 ? { ...one, limits } : one)) };
  const known = new KnownHandles();
  const dofsOf = (holds: boolean) => known.of(locked, 1, dofs(), world, placement(), holds).handles.map(({ id }) => id);
  const id = (dof: number) => ({ kind: 'dof', dof });
  expect(dofsOf(true)).toEqual([6, 7].map(id));
  expect(dofsOf(false)).toEqual([6, 7, 8].map(id));
});
