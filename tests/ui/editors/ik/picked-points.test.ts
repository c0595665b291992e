/** Which joint a point picked on a skin belongs to. */
import { afterEach, expect, it } from 'vitest';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import type { Character } from '../../../../src/model/document.ts';
import { pointUnder } from '../../../../src/ui/editors/ik/pins-on-screen.ts';
import type { CanvasPointer } from '../../../../src/ui/editors/viewport/canvas-tools.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { documentOf, skin } from '../../../helpers/builders.ts';
import { BODY, body, FORE_L, ikPage, PIXELS_PER_UNIT } from './ik-page.ts';

const ARM_L = 1;
let stop = () => {};
afterEach(() => stop());

/** What is under the pointer on a skin that follows one joint only, the left arm, at a point of the world. */
function pickedAt(place: Vec3, more: Partial<Character> = {}, of = ARM_L) {
  const page = ikPage(documentOf(body({ skins: [skin('body', of)], ...more })));
  stop = page.stop;
  const { wb } = page;
  const viewport = {
    ...wb.viewport,
    pointing: { pick: () => ({ characterId: 'c1', placement: 0, joint: of, vertex: 0 }) },
    vertexAt: () => place,
  };
  const at = { clientX: PIXELS_PER_UNIT * place[0], clientY: -PIXELS_PER_UNIT * place[1] };
  // Picking asks nothing else of either.
  return pointUnder({ ...wb, viewport: viewport as unknown as Workbench['viewport'] }, at as CanvasPointer);
}

it('a point of the skin at the pivot of a child is the child’s: the ankle is the foot’s, though the shin moves the skin', () => {
  const picked = pickedAt([2.03, 0.52, 0.1]);
  expect(picked?.joint).toBe(FORE_L);
  expect(picked?.natural?.kind).toBe('origin');
  expect(picked?.point).toEqual([0, 0, 0]);
});

it('a point of the skin away from pivots is of the joint that moves it', () => {
  const picked = pickedAt([1.5, 0.2, 0.1]);
  expect(picked?.joint).toBe(ARM_L);
  expect(picked?.natural).toBeUndefined();
  expect(picked?.vertex).toBe(0);
});

it('of joints at one pivot the first is meant: the hips, not the leg that begins there', () => {
  const joints = BODY.joints.map((one, j) => (j === FORE_L ? { ...one, offset: [0, 0, 0] as const } : one));
  const picked = pickedAt([1.02, 0, 0.1], { skeleton: { ...BODY, joints } }, FORE_L);
  expect(picked).toMatchObject({ joint: ARM_L, point: [0, 0, 0], natural: { kind: 'origin' } });
});
