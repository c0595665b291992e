/** Points inside of a skin, from points of the picture. */
import { Matrix4, Ray, Vector3 } from 'three';
import { middleOfFirstPassage } from '../../evaluate/first-passage.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import type { Eye, Ray as SceneRay } from '../camera/eye.ts';
import type { ShownCharacter } from '../shown-characters.ts';
import type { Viewport } from '../viewport.ts';

/** Up to this many triangles `insideSkin` takes less than 10 ms: 2 for a skin of 30,000, and as much in a new pose. */
const QUICK_TRIANGLES = 100_000;

/** Scratch, never escapes. */
const toOwn = new Matrix4();
const ray = new Ray();
const way = new Vector3();

/**
 * World position in the middle of the limb under a point of the page, of the skin of a character's edited instance as
 * it is drawn; undefined off the skin, where that is open, or if it isn't drawn.
 */
export function insideSkin(
  viewport: Pick<Viewport, 'withDrawnSkin' | 'pickedCopy'> & { readonly eye: Pick<Eye, 'rayAt'> },
  character: Pick<Character, 'id' | 'placements'>,
  clientX: number,
  clientY: number,
): Vec3 | undefined {
  const shown = viewport.withDrawnSkin(character.id);
  return shown && middleUnder(shown, viewport.pickedCopy(character), viewport.eye.rayAt(clientX, clientY));
}

/** Whether `insideSkin` takes a few milliseconds at most, for every move of the pointer. */
export function isInsideQuick(viewport: Pick<Viewport, 'withDrawnSkin'>, characterId: string): boolean {
  const skin = viewport.withDrawnSkin(characterId)?.view.skinnedMeshes[0]?.shared.skin;
  return !skin || skin.triangles.length <= 3 * QUICK_TRIANGLES;
}

/**
 * The scene point midway through the limb that a ray meets first, of a skin as it is drawn: posed, with morphs.
 * Undefined if the ray misses it or never leaves it.
 */
function middleUnder(
  { view, placements }: ShownCharacter,
  placement: number,
  { origin, direction }: SceneRay,
): Vec3 | undefined {
  const triangles = view.skinnedMeshes[placement]?.geometry.index?.array;
  if (!triangles) return undefined;
  toOwn.fromArray(placements, 16 * placement).invert();
  ray.origin.fromArray(origin);
  ray.direction.fromArray(direction);
  ray.applyMatrix4(toOwn);
  const { localBox } = view;
  if (!ray.intersectsBox(localBox)) return undefined;
  // To a point beyond the box.
  const reach = localBox.distanceToPoint(ray.origin) + localBox.getSize(way).length();
  way.copy(ray.direction).multiplyScalar(1.01 * reach);
  const mesh = { positions: view.drawnVertices, triangles };
  const part = middleOfFirstPassage(mesh, ray.origin.toArray(), way.toArray());
  if (part === undefined) return undefined;
  return ray.origin.addScaledVector(way, part).applyMatrix4(toOwn.invert()).toArray();
}
