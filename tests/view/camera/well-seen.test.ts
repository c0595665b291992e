import { Box3, OrthographicCamera, PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { isWellSeen } from '../../../src/view/camera/well-seen.ts';

/** Five metres in front of a person at the origin. */
function camera(distance = 5) {
  const made = new PerspectiveCamera(40, 1.5, 0.01, 100);
  made.position.set(0, 0.9, distance);
  return made;
}
const person = (x = 0, scale = 1) =>
  new Box3(new Vector3(x - 0.3 * scale, 0, -0.2 * scale), new Vector3(x + 0.3 * scale, 1.8 * scale, 0.2 * scale));

describe('what one wants to look at', () => {
  it('what one wants to look at is well in view at the centre, and at a third of the view’s height', () => {
    expect(isWellSeen(person(), person(), camera())).toBe(true);
  });

  it('what one wants to look at is not well in view as a speck, nor if larger than the view', () => {
    expect(isWellSeen(person(), person(), camera(15))).toBe(false);
    expect(isWellSeen(person(0, 0.01), person(0, 0.01), camera())).toBe(false);
    expect(isWellSeen(person(0, 100), person(0, 100), camera())).toBe(false);
  });

  it('what one wants to look at is not well in view at the side, behind the camera, or if it walks out of view', () => {
    expect(isWellSeen(person(1.8), person(1.8), camera())).toBe(false);
    expect(isWellSeen(person(), person(), camera(-5))).toBe(false);
    expect(isWellSeen(person(), person().union(person(6)), camera())).toBe(false);
  });

  it('what one wants to look at is not well in view if its head is under the toolbars', () => {
    expect(isWellSeen(person(), person(), camera(), 0.2)).toBe(true);
    expect(isWellSeen(person(), person(), camera(), 0.25)).toBe(false);
  });

  it('what one wants to look at may lie down', () => {
    const lying = new Box3(new Vector3(-0.9, 0.7, -0.2), new Vector3(0.9, 1, 0.2));
    expect(isWellSeen(lying, lying, camera())).toBe(true);
  });

  it('what one wants to look at is judged the same without perspective', () => {
    const flat = new OrthographicCamera(-3, 3, 2, -2, -10, 10);
    flat.position.set(0, 0.9, 5);
    expect(isWellSeen(person(), person(), flat)).toBe(true);
    expect(isWellSeen(person(0, 0.2), person(0, 0.2), flat)).toBe(false);
  });
});
