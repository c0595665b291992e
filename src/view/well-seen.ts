/** Whether one sees well enough what one wants to look at, or the camera has to go there. */
import { type Box3, type Camera, PerspectiveCamera, Vector3 } from 'three';

/** The picture reaches from −1 to 1 both ways. */
const MIDDLE = 0.5;
const EDGE = 1.1;
/** What is smaller than a third of the picture's height is looked at from nearer. */
const MIN_SIZE = 2 / 3;

/**
 * The figure is in the picture as a whole and no smaller than a third of it; and where it goes has its centre in the
 * middle part. Who lies down is as large as it is long.
 *
 * @param figure around it as it stands, in the world; not empty
 * @param room around it at all moments played
 * @param covered part of the picture's height, at its top, that something else lies over
 */
export function isWellSeen(figure: Box3, room: Box3, camera: Camera, covered = 0): boolean {
  camera.updateMatrixWorld();
  const at = new Vector3();
  if (!project(room.getCenter(at), camera) || Math.max(Math.abs(at.x), Math.abs(at.y)) > MIDDLE) return false;
  const { min, max } = figure;
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

/** From the world into the picture, in place; false for what is behind the camera. */
function project(at: Vector3, camera: Camera): boolean {
  at.applyMatrix4(camera.matrixWorldInverse);
  if (camera instanceof PerspectiveCamera && at.z > -camera.near) return false;
  at.applyMatrix4(camera.projectionMatrix);
  return true;
}
