import { expect, it } from 'vitest';
import { grabOf, type UnderPointer } from '../../../../src/ui/editors/fk/grab.ts';
import type { HandleHit } from '../../../../src/view/gizmo/handle-at.ts';

const RING: HandleHit = { id: { kind: 'dof', dof: 3 }, yields: false, isAtPivot: false };
const FAINT: HandleHit = { ...RING, yields: true };
const BALL: HandleHit = { id: { kind: 'ball' }, yields: true, isAtPivot: false };
const MOUSE = { shiftKey: false, pointerType: 'mouse' };

const grabs = (handle: HandleHit | undefined, at = MOUSE) =>
  (['selected', 'other', undefined] satisfies UnderPointer[]).map((under) => grabOf(handle, () => under, at));

it('a press grabs a handle before any joint, unless the handle yields to another one', () => {
  expect(grabs(RING)).toEqual(['handle', 'handle', 'handle']);
  expect(grabs(FAINT)).toEqual(['handle', 'bone', 'handle']);
});

it('a press looks for joints only where the handle yields', () => {
  const never = () => {
    throw new Error('That takes a picking render.');
  };
  expect(grabOf(RING, never, MOUSE)).toBe('handle');
});

it('a press grabs the ball only beside the character, and bones anywhere else', () => {
  expect(grabs(BALL)).toEqual(['bone', 'bone', 'ball']);
  expect(grabs(undefined)).toEqual(['bone', 'bone', undefined]);
});

it('a press with Shift leaves bones and the ball to the camera', () => {
  const at = { ...MOUSE, shiftKey: true };
  expect(grabs(BALL, at)).toEqual([undefined, undefined, undefined]);
  expect(grabs(FAINT, at)).toEqual(['handle', undefined, 'handle']);
  expect(grabs(RING, at)).toEqual(['handle', 'handle', 'handle']);
});

it('a finger drags the bone of the selected joint only', () => {
  const at = { ...MOUSE, pointerType: 'touch' };
  expect(grabs(undefined, at)).toEqual(['bone', undefined, undefined]);
  expect(grabs(BALL, at)).toEqual(['bone', undefined, 'ball']);
  expect(grabs(FAINT, at)).toEqual(['handle', 'handle', 'handle']);
});
