/** Whether something is well in view, or the camera has to move. */
import { type Box3, type Camera, PerspectiveCamera, Vector3 } from 'three';

/** The view spans −1 to 1 both ways. */
const MIDDLE = 0.5;
const EDGE = 1.1;
/** Smaller than a third of the view's height counts as too small. */
const MIN_SIZE = 2 / 3;

/**
 * The character is fully in view and at least a third of its height, and the centre of its motion is near the middle. A
 * lying character counts by its length.
 *
 * @param character bounds of its current pose, in the world; not empty
 * @param room bounds of its motion over the playback range
 * @param covered part of the view's height, at its top, covered by overlays
 */
export function isWellSeen(character: Box3, room: Box3, camera: Camera, covered = 0): boolean {
  camera.updateMatrixWorld();
  const at = new Vector3();
  if (!project(room.getCenter(at), camera) || Math.max(Math.abs(at.x), Math.abs(at.y)) > MIDDLE) return false;
  const { min, max } = character;
  const top = covered > 0 ? 1 - 2 * covered : EDGE;
  let [left, right, low, high] = [EDGE, -EDGE, EDGE, -EDGE];
  for (let corner = 0; corner < 8; corner++) {
    at.set(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z);
    if (!project(at, camera) || Math.max(Math.abs(at.x), -at.y) > EDGE || at.y > top) return false;
    [left, right] = [Math.min(left, at.x), Math.max(right, at.x)];
    [low, high] = [Math.min(low, at.y), Math.max(high, at.y)];
  }
  const { elements } = camera.projectionMatrix;
  const aspect = elements[5] / elements[0];
  return Math.max((right - left) * aspect, high - low) >= MIN_SIZE;
}

/** Projects from world to take coordinates, in place; false if behind the camera. */
function project(at: Vector3, camera: Camera): boolean {
  at.applyMatrix4(camera.matrixWorldInverse);
  if (camera instanceof PerspectiveCamera && at.z > -camera.near) return false;
  at.applyMatrix4(camera.projectionMatrix);
  return true;
}
