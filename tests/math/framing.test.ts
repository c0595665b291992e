import fc from 'fast-check';
import { PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import {
  distanceForHalfHeight,
  easeOut,
  fitDistance,
  lookingFrom,
  orthographicDepth,
  perspectiveDepth,
  shortTurn,
} from '../../src/math/framing.ts';

const TAN = Math.tan(Math.PI / 10);

function cameraAt(azimuth: number, height: number, distance: number, aspect: number): PerspectiveCamera {
  const camera = new PerspectiveCamera(36, aspect, distance * 1e-3, distance * 1e3);
  camera.position.setFromSphericalCoords(distance, Math.PI / 2 - height, azimuth);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  return camera;
}

describe('framing', () => {
  it('framing has every corner of a box of any size in the picture, from any side', () => {
    const size = fc.double({ min: 0, max: 1, noNaN: true });
    const angle = fc.double({ min: -1.5, max: 1.5, noNaN: true });
    fc.assert(
      fc.property(
        size,
        size,
        size,
        fc.constantFrom(0.01, 1, 100),
        angle,
        angle,
        fc.constantFrom(0.5, 1, 2.2),
        (hx, hy, hz, scale, azimuth, height, aspect) => {
          fc.pre(hx + hy + hz > 1e-3);
          const far = cameraAt(azimuth, height, scale * 10, aspect);
          const m = far.matrixWorld.elements;
          const distance = fitDistance(hx * scale, hy * scale, hz * scale, m, TAN, aspect, 1.1);
          const camera = cameraAt(azimuth, height, distance, aspect);
          for (const x of [-1, 1]) {
            for (const y of [-1, 1]) {
              for (const z of [-1, 1]) {
                const corner = new Vector3(x * hx, y * hy, z * hz).multiplyScalar(scale).project(camera);
                expect(Math.max(Math.abs(corner.x), Math.abs(corner.y))).toBeLessThan(1);
              }
            }
          }
        },
      ),
    );
  });

  it('leaves no more room than asked for', () => {
    // A flat square seen head on: its edges are at 1 / 1.25 of the picture's.
    const distance = fitDistance(1, 1, 0, cameraAt(0, 0, 1, 1).matrixWorld.elements, TAN, 1, 1.25);
    expect(new Vector3(1, 1, 0).project(cameraAt(0, 0, distance, 1)).y).toBeCloseTo(0.8, 9);
  });

  it('keeps every corner out from under what covers the top', () => {
    const size = fc.double({ min: 0.05, max: 1, noNaN: true });
    const angle = fc.double({ min: -1.5, max: 1.5, noNaN: true });
    const covered = fc.double({ min: 0, max: 0.4, noNaN: true });
    fc.assert(
      fc.property(
        size,
        size,
        size,
        angle,
        angle,
        fc.constantFrom(0.5, 1, 2.2),
        covered,
        (hx, hy, hz, azimuth, height, aspect, top) => {
          const m = new Float64Array(12);
          lookingFrom(azimuth, Math.PI / 2 - height, m);
          const distance = fitDistance(hx, hy, hz, m, TAN, aspect, 1.1, top);
          const camera = cameraAt(azimuth, height, distance, aspect);
          const raised = top * TAN * distance;
          camera.position.add(new Vector3(m[4], m[5], m[6]).multiplyScalar(raised));
          camera.updateMatrixWorld();
          expect(new Vector3().project(camera).y).toBeCloseTo(-top, 6);
          for (let corner = 0; corner < 8; corner++) {
            const at = new Vector3(corner & 1 ? hx : -hx, corner & 2 ? hy : -hy, corner & 4 ? hz : -hz).project(camera);
            expect(Math.abs(at.x)).toBeLessThan(1);
            expect(at.y).toBeGreaterThan(-1);
            expect(at.y).toBeLessThan(1 - 2 * top);
          }
        },
      ),
      // Something thin that points at the camera, once found on the very edge.
      { examples: [[0.05, 0.4141262773465366, 0.05, 0, 1.4506417935452305, 1, 0.3999999999999974]], numRuns: 300 },
    );
  });

  it('framing has the axes of a camera from its angles', () => {
    const m = new Float64Array(12);
    lookingFrom(0.7, 1.1, m);
    const { elements } = cameraAt(0.7, Math.PI / 2 - 1.1, 3, 1).matrixWorld;
    for (let i = 0; i < 12; i++) expect(m[i]).toBeCloseTo(elements[i], 9);
  });

  it('keeps a distance from a point too', () => {
    expect(fitDistance(0, 0, 0, cameraAt(0, 0, 1, 1).matrixWorld.elements, TAN, 1, 1.2)).toBeGreaterThan(0);
  });

  it.each([0.02, 2, 200])('sees the ground before and the grid behind a character of %d units', (size) => {
    const distance = 3 * size;
    const { near, far } = perspectiveDepth(distance, 5 * distance);
    expect(near).toBeLessThan(0.05 * distance);
    expect(near).toBeGreaterThan(0);
    expect(far).toBeGreaterThanOrEqual(6 * distance);
    // Steps of 24 bits of depth at the character, z² / (near · 2²⁴), are far below its size.
    expect(distance ** 2 / (near * 2 ** 24)).toBeLessThan(1e-4 * size);
  });

  it('keeps near within reach of far where one looks closely at something huge', () => {
    const { near, far } = perspectiveDepth(0.01, 200);
    expect(far / near).toBeLessThanOrEqual(1.0001e5);
  });

  it('sees behind an orthographic camera as well', () => {
    expect(orthographicDepth(1, 50)).toEqual({ near: -49, far: 51 });
  });

  it('shows as much at the target in both kinds of picture', () => {
    expect(distanceForHalfHeight(4 * TAN, TAN)).toBeCloseTo(4, 12);
  });

  it('framing turns the short way round', () => {
    expect(shortTurn(3, -3)).toBeCloseTo(2 * Math.PI - 6, 12);
    expect(shortTurn(-3, 3)).toBeCloseTo(6 - 2 * Math.PI, 12);
    expect(shortTurn(0.5, 1)).toBeCloseTo(0.5, 12);
    expect(shortTurn(0, 4 * Math.PI + 0.1)).toBeCloseTo(0.1, 12);
  });

  it('moves from start to end and no further', () => {
    expect([-1, 0, 1, 2].map(easeOut)).toEqual([0, 0, 1, 1]);
  });
});
