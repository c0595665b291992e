import { describe, expect, it } from 'vitest';
import { provideSources } from '../../src/edit/follow/sources.ts';
import { poseByNames, takePose } from '../../src/edit/pose/by-names.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import type { Character, Driver } from '../../src/model/document.ts';
import type { IkSetup } from '../../src/model/ik.ts';
import { type Joint, type Motion, type Skeleton, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { character, documentOf, joint, skelFile, takeOfValues } from '../helpers/builders.ts';

const HINGE: Motion = { kind: 'hinge', axis: [1, 0, 0] };
const hinge = (parent: number, name: string, more: Partial<Joint> = {}) =>
  joint(parent, { name, motion: HINGE, limits: [UNLIMITED], pose: [0], ...more });
const fixed = (parent: number, name: string) =>
  joint(parent, { name, motion: { kind: 'fixed' }, limits: [], pose: [] });
const skeletonOf = (...joints: Joint[]): Skeleton => ({ name: 'hero', joints });

/** Root translation, then a value for each hinge. */
const kept = (...values: number[]) => [{ name: 'sit', values: [0, 0, 0, ...values] }];
const pinned = (joint: number, more: Partial<IkSetup> = {}): IkSetup => ({
  pins: [{ id: 7, joint, point: [0, 1, 0], weight: 1, holdsOrientation: false }],
  stiff: [],
  rootIsFree: true,
  ...more,
});

/** A character whose `hero.skel` is opened again with other joints. */
function reloaded(before: Partial<Character> & { skeleton: Skeleton }, after: Skeleton, ...others: Character[]) {
  const source = { name: 'hero.skel', path: 'hero.skel', bytes: 1 };
  const { document, diagnostics } = openFiles(documentOf(character({ ...before, sources: [source] }), ...others), [
    skelFile('hero.skel', after),
  ]);
  return { character: document.characters[0], document, diagnostics: diagnostics.map((d) => [d.severity, d.code]) };
}

/** hip – knee – foot. */
const LEG = skeletonOf(hinge(-1, 'hip'), hinge(0, 'knee'), hinge(1, 'foot'));

describe('pins and stiff joints, where a skeleton is read again', () => {
  it('pins and stiff joints, where a skeleton is read again go with joints that are gone, and it is said', () => {
    const ik = pinned(2, { stiff: [{ joint: 1, stiffness: 4 }, { joint: 2 }] });
    const { character: after, diagnostics } = reloaded({ skeleton: LEG, ik }, skeletonOf(...LEG.joints.slice(0, 2)));
    expect(after.ik).toEqual({ pins: [], stiff: [{ joint: 1, stiffness: 4 }], rootIsFree: true });
    expect(diagnostics).toEqual([['info', 'ik-lost']]);
  });

  it('pins and stiff joints follow their joints to new indices when a skeleton is read again', () => {
    const ik = pinned(2, { stiff: [{ joint: 0 }, { joint: 1 }] });
    const after = skeletonOf(hinge(-1, 'pelvis'), hinge(0, 'foot'), hinge(0, 'hip'), hinge(2, 'knee'));
    const { character: now, diagnostics } = reloaded({ skeleton: LEG, ik }, after);
    expect(now.ik).toEqual({ ...pinned(1), stiff: [{ joint: 2 }, { joint: 3 }] });
    expect(diagnostics).toEqual([]);
  });

  it('leave no setup behind that says nothing any more', () => {
    const { character: after } = reloaded({ skeleton: LEG, ik: pinned(2) }, skeletonOf(...LEG.joints.slice(0, 2)));
    expect(after.ik).toBeUndefined();
    const stays = pinned(2, { rootIsFree: false });
    const { character: still } = reloaded({ skeleton: LEG, ik: stays }, skeletonOf(...LEG.joints.slice(0, 2)));
    expect(still.ik).toEqual({ pins: [], stiff: [], rootIsFree: false });
  });
});

describe('poses that were kept, where a skeleton is read again', () => {
  const poseOf = (now: Character) => now.poses?.[0].values.slice(3);

  it('poses that were kept, where a skeleton is read again keep what they have of a joint that has another name now', () => {
    const renamed = skeletonOf(LEG.joints[0], hinge(0, 'shin'), LEG.joints[2]);
    const { character: now, diagnostics } = reloaded({ skeleton: LEG, poses: kept(1, 2, 3) }, renamed);
    expect(poseOf(now)).toEqual([1, 2, 3]);
    expect(diagnostics).toEqual([]);
  });

  it('poses that were kept, where a skeleton is read again keep what belongs to joints without names when another joint is inserted before them', () => {
    const bone = (parent: number, x: number) => hinge(parent, '', { offset: [x, 0, 0] });
    const before = skeletonOf(bone(-1, 0), bone(0, 1), bone(1, 1), bone(0, 2));
    const after = skeletonOf(bone(-1, 0), bone(0, 9), bone(0, 1), bone(2, 1), bone(0, 2));
    const { character: now, diagnostics } = reloaded({ skeleton: before, poses: kept(1, 2, 3, 4) }, after);
    expect(poseOf(now)).toEqual([1, 0, 2, 3, 4]);
    expect(diagnostics).toEqual([]);
  });

  it('find joints without names by index after they have moved', () => {
    const before = skeletonOf(hinge(-1, ''), hinge(0, ''), fixed(0, ''), hinge(0, ''));
    const [root, a, still, b] = before.joints;
    const after = skeletonOf(root, { ...a, offset: [0, 5, 0] }, still, { ...b, offset: [0, 6, 0] }, hinge(3, ''));
    expect(poseOf(reloaded({ skeleton: before, poses: kept(1, 2, 3) }, after).character)).toEqual([1, 2, 3, 0]);
  });

  it('lose what belonged to a joint that was removed or moves by other DOFs, and report it', () => {
    const ball = skeletonOf(LEG.joints[0], joint(0, { name: 'knee' }));
    const { character: now, diagnostics } = reloaded({ skeleton: LEG, poses: kept(1, 2, 3) }, ball);
    expect(poseOf(now)).toEqual([1, 0, 0, 0]);
    expect(diagnostics).toEqual([['info', 'kept-pose-lost']]);
    // At rest it says nothing.
    expect(reloaded({ skeleton: LEG, poses: kept(1, 0, 0) }, ball).diagnostics).toEqual([]);
  });

  it('lose nothing of the root’s translation', () => {
    const poses = [{ name: 'sit', values: [4, 5, 6, 1, 2, 3] }];
    const { character: now, diagnostics } = reloaded(
      { skeleton: LEG, poses },
      skeletonOf(...LEG.joints, hinge(0, 'tail')),
    );
    expect(now.poses?.[0].values).toEqual([4, 5, 6, 1, 2, 3, 0]);
    expect(diagnostics).toEqual([]);
  });
});

it('a pose of joints without names applies to a skeleton with more of them', () => {
  const two = character({ skeleton: skeletonOf(hinge(-1, ''), hinge(0, '')) });
  const pose = poseByNames(two, { name: 'a', values: [0, 0, 0, 1, 2] });
  const three = character({ skeleton: skeletonOf(hinge(-1, ''), hinge(0, ''), hinge(1, '')) });
  expect([...takePose(three, pose).values.entries()].slice(0, 2)).toEqual([
    [3, 1],
    [4, 2],
  ]);
  // Not to one that has a name, nor to other DOFs.
  const others = character({ skeleton: skeletonOf(hinge(-1, 'hip'), joint(0, { name: '' }), hinge(1, '')) });
  expect([...takePose(others, pose).values.keys()].sort()).toEqual([0, 1, 2]);
});

describe('retargeting when a skeleton is read again', () => {
  // Here no command makes the driver.
  provideSources();
  const driver = (sourceId: string, own: Skeleton): Driver => ({
    sourceId,
    source: { name: 'x', skeleton: own, take: WALK, pose: [], clampsToLimits: true, timeOffsetSeconds: 0 },
    pairs: LEG.joints.map((_, j) => ({ target: j, source: j })),
    options: { reference: 'rest', plantsFeet: false },
  });
  const WALK = takeOfValues('walk', new Array(6).fill(0));
  const after = skeletonOf(hinge(-1, 'hip'), hinge(0, 'foot'));

  it('drives the same joints after they were renumbered or removed', () => {
    const bee = character({ id: 'c2', skeleton: LEG });
    const { character: now } = reloaded({ skeleton: LEG, driver: driver('c2', LEG) }, after, bee);
    expect(now.driver?.pairs).toEqual([
      { target: 0, source: 0 },
      { target: 1, source: 2 },
    ]);
  });

  it('retargeting when a skeleton is read again is driven by the same joints after these were renumbered or removed', () => {
    const bee = character({ id: 'c2', skeleton: LEG, driver: driver('c1', LEG) });
    const { document } = reloaded({ skeleton: LEG, takes: [WALK], shownTake: 0 }, after, bee);
    expect(document.characters[1].driver?.pairs).toEqual([
      { target: 0, source: 0 },
      { target: 2, source: 1 },
    ]);
    expect(document.characters[1].driver?.source.skeleton).toBe(after);
  });
});
