import { OrthographicCamera, PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { CameraProjection } from '../../../src/view/camera/camera-projection.ts';

/** CSS pixels. */
const [WIDTH, HEIGHT] = [800, 400];
const NEAR = 1e-9;

function perspective(): PerspectiveCamera {
  const camera = new PerspectiveCamera(50, WIDTH / HEIGHT, 0.1, 100);
  camera.position.set(1, 2, 5);
  camera.lookAt(0, 0, 0);
  return camera;
}

function orthographic(): OrthographicCamera {
  const camera = new OrthographicCamera(-4, 4, 2, -2, 0.1, 100);
  camera.position.set(-3, 1, 2);
  camera.lookAt(0, 0, 0);
  camera.zoom = 1.5;
  camera.updateProjectionMatrix();
  return camera;
}
const cameras = [
  ['perspective', perspective],
  ['orthographic', orthographic],
] as const;
const points: readonly Vec3[] = [
  [0, 0, 0],
  [0.4, -0.3, 0.8],
  [-1, 0.5, -2],
];

describe.each(cameras)('a %s camera', (_kind, made) => {
  it('has points where three.js has them, in pixels from the left top', () => {
    const camera = made();
    const projection = new CameraProjection();
    projection.look(camera, HEIGHT);
    for (const point of points) {
      const out = new Float64Array(3);
      expect(projection.project(point, out, 1)).toBe(true);
      const take = new Vector3(...point).project(camera);
      expect(Math.abs(out[1] - ((take.x + 1) / 2) * WIDTH)).toBeLessThan(NEAR * WIDTH);
      expect(Math.abs(out[2] - ((1 - take.y) / 2) * HEIGHT)).toBeLessThan(NEAR * WIDTH);
    }
  });

  it('knows how long a pixel is there', () => {
    const camera = made();
    const projection = new CameraProjection();
    projection.look(camera, HEIGHT);
    for (const point of points) {
      const pixel = projection.unitsPerPixel(point);
      const up = new Vector3(0, 1, 0).applyQuaternion(camera.quaternion).multiplyScalar(pixel);
      const [here, there] = [new Float64Array(2), new Float64Array(2)];
      projection.project(point, here, 0);
      projection.toPixels(point[0] + up.x, point[1] + up.y, point[2] + up.z, there, 0);
      expect(Math.abs(here[1] - there[1] - 1)).toBeLessThan(1e-6);
    }
  });

  it('is towards the viewer against the line of sight', () => {
    const camera = made();
    const projection = new CameraProjection();
    projection.look(camera, HEIGHT);
    const wanted = camera.getWorldDirection(new Vector3()).negate();
    // In the centre of the view, for a perspective camera.
    projection.towardsViewer([0, 0, 0]).forEach((v, k) => {
      expect(Math.abs(v - wanted.getComponent(k))).toBeLessThan(NEAR);
    });
    expect(projection.depthAt(0, 0, 0)).toBeCloseTo(camera.position.length(), 9);
  });

  it('says whether the view is another one', () => {
    const camera = made();
    const projection = new CameraProjection();
    expect(projection.look(camera, HEIGHT)).toBe(true);
    expect(projection.look(camera, HEIGHT)).toBe(false);
    camera.position.x += 0.01;
    expect(projection.look(camera, HEIGHT)).toBe(true);
    expect(projection.look(camera, HEIGHT + 1)).toBe(true);
    expect(projection.look(camera, HEIGHT + 1, 3 * HEIGHT)).toBe(true);
  });
});

it('has nothing behind the viewer on the screen', () => {
  const projection = new CameraProjection();
  projection.look(perspective(), HEIGHT);
  const out = new Float64Array(2);
  expect(projection.project([2, 4, 10], out, 0)).toBe(false);
  expect([...out]).toEqual([Number.NaN, Number.NaN]);
  expect(projection.depthAt(2, 4, 10)).toBeLessThan(0);
});
