import fc from 'fast-check';
import { PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import {
  distanceForHalfHeight,
  easeOut,
  fitEye,
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
  const size = fc.double({ min: 0, max: 1, noNaN: true });
  const angle = fc.double({ min: -1.5, max: 1.5, noNaN: true });
  const boxAt = fc
    .tuple(size, size, size, size, size, size)
    .map(([x, y, z, w, h, d]) => [x - w, y - h, z - d, x + w, y + h, z + d]);

  /** Each corner as it is seen from where `fitEye` puts the camera, and the camera's distance. */
  function seen(boxes: readonly (readonly number[])[], azimuth: number, height: number, aspect: number, covered = 0) {
    const m = new Float64Array(12);
    lookingFrom(azimuth, Math.PI / 2 - height, m);
    const { x, y, z, middle } = fitEye(boxes.flat(), m, TAN, aspect, 1.1, covered);
    const camera = cameraAt(azimuth, height, 10, aspect);
    camera.near = 1e-4;
    camera.updateProjectionMatrix();
    camera.position.set(0, 0, 0);
    for (const [i, along] of [x, y, z].entries()) {
      camera.position.add(new Vector3(m[4 * i], m[4 * i + 1], m[4 * i + 2]).multiplyScalar(along));
    }
    camera.updateMatrixWorld();
    const corners = boxes.flatMap((box) =>
      Array.from({ length: 8 }, (_, c) =>
        new Vector3(box[c & 1 ? 3 : 0], box[c & 2 ? 4 : 1], box[c & 4 ? 5 : 2]).project(camera),
      ),
    );
    return { corners, distance: z - middle };
  }

  it('framing has every corner of boxes in the picture, from any side, and nothing under what covers the top', () => {
    const covered = fc.double({ min: 0, max: 0.4, noNaN: true });
    const boxes = fc.array(boxAt, { minLength: 1, maxLength: 4 });
    const scale = fc.constantFrom(0.01, 1, 100);
    fc.assert(
      fc.property(boxes, scale, angle, angle, fc.constantFrom(0.5, 1, 2.2), covered, (given, by, a, h, aspect, top) => {
        fc.pre(given.some((box) => box[3] - box[0] + box[4] - box[1] + box[5] - box[2] > 1e-3));
        const { corners, distance } = seen(
          given.map((box) => box.map((n) => n * by)),
          a,
          h,
          aspect,
          top,
        );
        expect(distance).toBeGreaterThan(0);
        // In front of the camera.
        const isSeen = ({ x, y, z }: Vector3) => z < 1 && Math.abs(x) < 1 && y > -1 && y < 1 - 2 * top;
        expect(corners.filter((corner) => !isSeen(corner))).toEqual([]);
      }),
      { numRuns: 150 },
    );
  });

  it('framing leaves no more room than asked for: two opposite margins are touched', () => {
    const long = boxAt.filter(([x0, y0, z0, x1, y1, z1]) => Math.max(x1 - x0, y1 - y0) > 0.05 + 3 * (z1 - z0));
    fc.assert(
      fc.property(fc.array(long, { minLength: 1, maxLength: 4 }), fc.constantFrom(0.5, 1, 2.2), (given, aspect) => {
        const depths = given.flatMap((box) => [box[2], box[5]]);
        const { corners, distance } = seen(given, 0, 0, aspect);
        const spread = (Math.max(...depths) - Math.min(...depths)) / 2;
        fc.pre(distance > 1.501 * spread);
        const reach = (of: (corner: Vector3) => number) =>
          Math.min(Math.max(...corners.map(of)), -Math.min(...corners.map(of)));
        expect(
          Math.max(
            reach((c) => c.x),
            reach((c) => c.y),
          ),
        ).toBeCloseTo(1 / 1.1, 6);
      }),
    );
  });

  it('several moments of a motion are shown larger than the box around them all', () => {
    const moments = Array.from({ length: 16 }, (_, i) => {
      const [x, z] = [Math.cos((i * Math.PI) / 8), Math.sin((i * Math.PI) / 8)];
      return [x - 0.3, 0, z - 0.3, x + 0.3, 1.6, z + 0.3];
    });
    const around = seen([[-1.3, 0, -1.3, 1.3, 1.6, 1.3]], 0.6, 0.25, 1.7).distance;
    expect(seen(moments, 0.6, 0.25, 1.7).distance).toBeLessThan(0.93 * around);
  });

  it('framing has the axes of a camera from its angles', () => {
    const m = new Float64Array(12);
    lookingFrom(0.7, 1.1, m);
    const { elements } = cameraAt(0.7, Math.PI / 2 - 1.1, 3, 1).matrixWorld;
    for (let i = 0; i < 12; i++) expect(m[i]).toBeCloseTo(elements[i], 9);
  });

  it('framing keeps a distance from a point too', () => {
    expect(seen([[1, 2, 3, 1, 2, 3]], 0.3, 0.2, 1).distance).toBeGreaterThan(0);
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

  it('framing keeps near within reach of far where one looks closely at something huge', () => {
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
