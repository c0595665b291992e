/** A thumbnail of a character in a pose, on a canvas: transparent background, two colours of the page. */
import { readName } from '../evaluate/retarget/names.ts';
import { frontOf } from '../evaluate/shapes/front.ts';
import { look } from '../evaluate/shapes/look.ts';
import { type Rgb, rasterise } from '../evaluate/shapes/rasterise.ts';
import { type Posed, solidOf } from '../evaluate/shapes/solids.ts';
import type { Character } from '../model/document.ts';
import type { Joint } from '../model/skeleton/skeleton.ts';
import { DEFAULT_SPACE } from '../model/space.ts';

export interface ThumbnailColours {
  readonly dark: Rgb;
  readonly bright: Rgb;
}

/** Supersampling per axis, for smooth edges. */
const OVERSAMPLED = 2;

/** By its role, else by its name. */
const sideByName = ({ name, role }: Pick<Joint, 'name' | 'role'>) => readName(role ?? name).side;

/**
 * Draws it at the canvas's size; false if there is nothing to draw.
 *
 * @param values one per DOF of the character
 */
export function drawPose(
  canvas: HTMLCanvasElement,
  character: Posed & Pick<Character, 'space'>,
  values: ArrayLike<number>,
  { dark, bright }: ThumbnailColours,
): boolean {
  const g = canvas.getContext('2d');
  const { up } = character.space ?? DEFAULT_SPACE;
  const solid = solidOf(character, values);
  if (!g) return false;
  g.clearRect(0, 0, canvas.width, canvas.height);
  if (!solid || solid.points.length === 0) return false;
  const [width, height] = [OVERSAMPLED * canvas.width, OVERSAMPLED * canvas.height];
  const shaded = look(solid, up, frontOf(character.skeleton, values, up, sideByName), width, height);
  const large = document.createElement('canvas');
  large.width = width;
  large.height = height;
  large
    .getContext('2d')
    ?.putImageData(new ImageData(rasterise(shaded, width, height, dark, bright), width, height), 0, 0);
  g.imageSmoothingQuality = 'high';
  g.drawImage(large, 0, 0, canvas.width, canvas.height);
  return true;
}
