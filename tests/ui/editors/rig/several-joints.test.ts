/** Moving several joints by dragging one, and what snaps to the grid. */
import { describe, expect, it } from 'vitest';
import { setOffset } from '../../../../src/edit/commands/rig-joint.ts';
import { inTurn } from '../../../../src/edit/in-turn.ts';
import { ontoGrid } from '../../../../src/edit/rig/dragged-places.ts';
import { Store } from '../../../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../../../src/evaluate/kinematics.ts';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { filePose } from '../../../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../../../src/model/skeleton/skeleton.ts';
import { gridSnap } from '../../../../src/ui/editors/rig/grid-snap.ts';
import { movedTogether } from '../../../../src/ui/editors/rig/joint-drags.ts';
import { outermostJoints } from '../../../../src/ui/editors/rig/outermost.ts';
import { setType } from '../../../../src/ui/editors/rig/rig-edits.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

const IDENTITY = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
const bare = skeleton(['hips', -1], ['leg_l', 0], ['foot_l', 1], ['leg_r', 0], ['foot_r', 3]);
/** The hips are turned, so that offsets have other axes than the scene. */
const bones = { ...bare, joints: bare.joints.map((one, j) => (j === 0 ? { ...one, pose: [0.3, 0.8, -0.5] } : one)) };

function worldOf(of: Skeleton): Float64Array {
  const world = new Float64Array(16 * of.joints.length);
  worldMatrices(compileSkeleton(of), Float64Array.from(filePose(of, 0)), world);
  return world;
}

const place = (of: Skeleton, joint: number) => [...worldOf(of).subarray(16 * joint + 12, 16 * joint + 15)];

/** Moves what is selected by dragging one joint; returns how far each joint got in the scene. */
function ways(joints: readonly number[], dragged: number, offset: Vec3, children: 'follow' | 'stay') {
  const one = character({ skeleton: bones, shownTake: -1 });
  const store = new Store(documentOf(one));
  const rigged = { character: one, skeleton: bones, world: worldOf(bones), placement: IDENTITY };
  const each = movedTogether(rigged, joints, dragged, offset, children);
  store.apply(
    inTurn(setOffset, 'Move'),
    each.map((change) => ({ characterId: 'c1', children, ...change })),
  );
  const after = store.document.characters[0].skeleton ?? bones;
  return bones.joints.map((_, joint) => {
    const before = place(bones, joint);
    return place(after, joint).map((part, k) => part - before[k]);
  });
}

const expectSame = (a: readonly number[], b: readonly number[]) =>
  a.forEach((part, k) => {
    expect(part).toBeCloseTo(b[k], 12);
  });
const STILL = [0, 0, 0];

describe('several joints moved together', () => {
  it('several joints move as far in the scene as the dragged one, and their children with them', () => {
    const [hips, leftLeg, leftFoot, rightLeg, rightFoot] = ways([1, 4], 4, [0.5, 1, 0.25], 'follow');
    expect(Math.hypot(...rightFoot)).toBeCloseTo(Math.hypot(0.5, 0.25), 12);
    expectSame(leftLeg, rightFoot);
    expectSame(leftFoot, rightFoot);
    expectSame(hips, STILL);
    expectSame(rightLeg, STILL);
  });

  it('a selected joint below another selected one is not moved twice', () => {
    const [, leg, foot] = ways([1, 2], 2, [0.5, 1, 0], 'follow');
    expect(Math.hypot(...foot)).toBeCloseTo(0.5, 12);
    expectSame(leg, foot);
  });

  it('several joints whose children stay move alone, and as far as the dragged one', () => {
    const [, leg, foot, rightLeg, rightFoot] = ways([1, 2, 3], 1, [0.5, 1, 0], 'stay');
    expect(Math.hypot(...leg)).toBeCloseTo(0.5, 12);
    expectSame(foot, leg);
    expectSame(rightLeg, leg);
    expectSame(rightFoot, STILL);
  });

  it('a joint that isn’t selected is dragged alone', () => {
    const rigged = { character: character(), skeleton: bones, world: worldOf(bones), placement: IDENTITY };
    expect(movedTogether(rigged, [1, 2], 3, [1, 2, 3], 'follow')).toEqual([{ joint: 3, offset: [1, 2, 3] }]);
  });

  it('the outermost of several joints are those without a selected joint above', () => {
    expect(outermostJoints(bones, [2, 1, 4])).toEqual([1, 4]);
    expect(outermostJoints(bones, [4, 0, 2])).toEqual([0]);
  });
});

it('several joints get another type in one step, and keep what is selected', () => {
  const { wb } = workbench(documentOf(character({ skeleton: bones, shownTake: -1 })));
  const selection = { characterId: 'c1', joint: 4, others: [1, 2] };
  wb.store.select(selection);
  const before = wb.store.document;
  setType(wb, 'hinge');
  const kinds = () => wb.store.document.characters[0].skeleton?.joints.map(({ motion }) => motion.kind);
  expect(kinds()).toEqual(['ball', 'hinge', 'hinge', 'ball', 'hinge']);
  expect(wb.store.undoLabel).toBe('Set type of 3 joints');
  expect(wb.store.selection).toEqual(selection);
  wb.store.undo();
  expect(wb.store.document).toEqual(before);
  expect(wb.store.undoLabel).toBeUndefined();
});

describe('snapping to the grid', () => {
  it('a point snaps to the nearest lines, but for coordinates that a drag doesn’t change', () => {
    expect(ontoGrid([0.34, -1.26, 0.123], [0, 0, 0.123], 0.1)).toEqual([0.3, -1.3, 0.123]);
    expect(ontoGrid([0.34, -1.26, 0.123 + 1e-9], [0, 0, 0.123], 0.1)).toEqual([0.3, -1.3, 0.123]);
    expect(ontoGrid([7.4, 0, 0], [1, 1, 1], 5)).toEqual([5, 0, 0]);
  });

  it('joints snap to the visible lines, unless Shift is held, the grid is hidden, or the setting is off', () => {
    const { wb } = workbench();
    const shown = (gridStep: number | undefined) => Object.assign(wb.viewport, { gridStep });
    const at = { shiftKey: false };
    shown(0.2);
    expect(gridSnap(wb, at)).toBe(0.2);
    expect(gridSnap(wb, { shiftKey: true })).toBeUndefined();
    wb.settings.update((s) => ({ ...s, snapsToGrid: false }));
    expect(gridSnap(wb, at)).toBeUndefined();
    wb.settings.update((s) => ({ ...s, snapsToGrid: true }));
    shown(undefined);
    expect(gridSnap(wb, at)).toBeUndefined();
  });
});
