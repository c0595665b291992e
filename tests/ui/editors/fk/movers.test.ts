/** Drags of the active joint: the other selected joints change by the same amounts. */
import { expect, it } from 'vitest';
import type { HandleId } from '../../../../src/evaluate/handles/joint-handles.ts';
import { boneMover, type FkGrip } from '../../../../src/ui/editors/fk/movers.ts';
import type { Sight } from '../../../../src/view/gizmo/pointer-measures.ts';
import { character, skeleton } from '../../builders.ts';

const bones = skeleton(['hips', -1], ['left', 0], ['right', 0]);
const at = (clientY: number, clientX = 0) => ({
  clientX,
  clientY,
  button: 0,
  altKey: false,
  shiftKey: false,
  ctrlKey: false,
  metaKey: false,
  pointerType: 'mouse',
});
const IDENTITY = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
/** Looks along −z at one unit per pixel. */
const sight: Pick<Sight, 'unitsPerPixel'> = { unitsPerPixel: () => 0.01 };

function grip(others: readonly number[]): FkGrip {
  const posed = character({ skeleton: bones });
  const dofs = Float64Array.of(0, 0, 0, 0, 0, 0, 0.1, 0, 0, 0.5, 0, 0);
  return {
    selected: { character: posed, skeleton: bones, joint: 1 },
    others,
    dofs,
    placement: IDENTITY,
    // Only the scale is read for a bone.
    sight: sight as Sight,
    radius: 50,
    at: at(0),
  };
}

it('a dragged bone turns the same DOF of the other selected joints by the same angle', () => {
  const RX: HandleId = { kind: 'dof', dof: 6 };
  const moved = boneMover(RX.dof, grip([2, 0]))?.(at(-90));
  expect(moved?.dofs).toEqual([{ index: 6, value: expect.closeTo(0.1 + Math.PI / 4, 12) }]);
  expect(moved?.others).toEqual([
    { index: 9, value: expect.closeTo(0.5 + Math.PI / 4, 12) },
    { index: 3, value: expect.closeTo(Math.PI / 4, 12) },
  ]);
});

it('a bone dragged alone changes nothing else', () => {
  expect(boneMover(6, grip([]))?.(at(-90)).others).toEqual([]);
});
