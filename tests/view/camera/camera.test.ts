import { Box3, Vector3 } from 'three';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { CameraRig } from '../../../src/view/camera/camera.ts';

const box = (from: number, to: number) => new Box3(new Vector3(from, from, from), new Vector3(to, to, to));
let rig: CameraRig;

beforeEach(() => {
  vi.stubGlobal('window', new EventTarget());
  // What OrbitControls uses of an element.
  const ownerDocument = new EventTarget();
  const element = Object.assign(new EventTarget(), { style: {}, ownerDocument, getRootNode: () => ownerDocument });
  rig = new CameraRig(element as unknown as HTMLElement, () => {});
  rig.resize(400, 300);
  rig.frame([box(0, 1)], 0, false);
  rig.fitDepth(box(0, 1), true);
  return () => vi.unstubAllGlobals();
});

describe.each([false, true])('a camera that is orthographic: %s', (orthographic) => {
  beforeEach(() => rig.setOrthographic(orthographic));

  it('the camera goes back to what it showed when its controls have made it look nowhere', () => {
    rig.fitDepth(box(0, 1), true);
    const before = rig.view;
    rig.target.x = Number.NaN;
    rig.fitDepth(box(0, 1), true);
    expect(rig.view.target).toEqual(before.target);
    expect(rig.view.distance).toBeCloseTo(before.distance, 9);
    expect([...rig.camera.matrixWorldInverse.elements].every(Number.isFinite)).toBe(true);
  });

  it('the camera frames a point, and nothing that is infinite', () => {
    rig.frame([box(2, 2)], 0, false);
    rig.fitDepth(box(2, 2), false);
    expect(rig.view.target.map((value) => Math.round(value * 1e9) / 1e9)).toEqual([2, 2, 2]);
    expect(rig.view.distance).toBeGreaterThan(0);
    const before = rig.view;
    rig.frame([box(-Infinity, Infinity)], 0, false);
    expect(rig.view).toEqual(before);
  });

  it('turning about a point leaves it where it is in the picture, and turning back restores the view', () => {
    const point = new Vector3(0.9, 0.3, 0.1);
    const seen = () => {
      rig.camera.updateMatrixWorld();
      return point.clone().project(rig.camera).toArray();
    };
    const before = { at: seen(), view: rig.view };
    rig.turn(0.7, 0, point);
    for (const [axis, value] of seen().entries()) expect(value).toBeCloseTo(before.at[axis], 9);
    expect(rig.view.azimuth).toBeCloseTo(before.view.azimuth + 0.7, 9);
    rig.turn(-0.7, 0, point);
    for (const [axis, value] of rig.view.target.entries()) expect(value).toBeCloseTo(before.view.target[axis], 9);
    for (let i = 0; i < 40; i++) rig.turn(0, 0.2);
    expect(rig.view.polar).toBeCloseTo(Math.PI, 3);
  });

  it('the camera keeps its projection while panels leave the viewport no room', () => {
    const before = [...rig.camera.projectionMatrix.elements];
    rig.resize(400, 0);
    rig.resize(0, 0);
    expect([...rig.camera.projectionMatrix.elements]).toEqual(before);
  });
});
