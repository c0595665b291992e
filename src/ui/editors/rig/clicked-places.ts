/**
 * Where a click in rig mode places a joint: on a skin of the character in the middle of the limb under the pointer, as
 * it is drawn; elsewhere in the camera-facing plane through the parent, snapped to the grid.
 *
 *     Shift   off the grid
 *     Ctrl    with round numbers
 *
 * Neither counts inside of a skin: a thin limb has no point of the grid.
 */
import { inverseOf, ontoGrid, parentToScene, snappedPoint, withoutDust } from '../../../edit/rig/dragged-places.ts';
import { setIdentity } from '../../../math/mat4.ts';
import { roundStep } from '../../../math/round-steps.ts';
import { transformPoint, type Vec3, ZERO } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import { insideSkin } from '../../../view/picking/inside-skin.ts';
import type { Uses } from '../../state/workbench.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';
import { gridSnap, SNAP_PIXELS } from './grid-snap.ts';
import { meanScale, type Rigged } from './rigged.ts';

const IDENTITY = new Float64Array(16);
setIdentity(IDENTITY, 0);

/** Position on the page, and keys that are held. */
export type ClickedAt = Pick<CanvasPointer, 'clientX' | 'clientY' | 'shiftKey' | 'ctrlKey' | 'metaKey'>;

/**
 * The offset of a child that a click adds, and where that is in the scene; undefined if its parent is scaled to zero.
 *
 * @param parent index
 */
export function placeForChild(
  wb: Uses<'viewport' | 'settings'>,
  { character, world, placement }: Rigged,
  parent: number,
  at: ClickedAt,
): { readonly offset: Vec3; readonly scene: Vec3 } | undefined {
  const space = parentToScene(placement, world, parent);
  const anchor = transformPoint(space, ZERO);
  const offset = clickedPlace(wb, character, anchor, space, at);
  return offset && { offset, scene: transformPoint(space, offset) };
}

/**
 * The first joint of a skeleton, in the character's own space.
 *
 * @param waiting a skin without a skeleton that gets it, if any
 */
export function placeForRoot(
  wb: Uses<'viewport' | 'settings'>,
  waiting: Character | undefined,
  at: ClickedAt,
): Vec3 | undefined {
  const placement = waiting && wb.viewport.placementOf(waiting.id, wb.viewport.pickedCopy(waiting));
  return clickedPlace(wb, waiting, ZERO, placement?.slice() ?? IDENTITY, at);
}

/** @param space that of the result, to the scene */
function clickedPlace(
  wb: Uses<'viewport' | 'settings'>,
  character: Character | undefined,
  anchor: Vec3,
  space: Float64Array,
  at: ClickedAt,
): Vec3 | undefined {
  const { viewport } = wb;
  const toSpace = inverseOf(space);
  if (!toSpace) return undefined;
  const unit = viewport.eye.unitsPerPixel(anchor) / meanScale(space);
  const inside = character && insideSkin(viewport, character, at.clientX, at.clientY);
  if (inside) return withoutDust(transformPoint(toSpace, inside), unit);
  const pointed = viewport.eye.inPlaneOf(anchor, at.clientX, at.clientY);
  const step = gridSnap(wb, at);
  if (step !== undefined) return withoutDust(transformPoint(toSpace, ontoGrid(pointed, anchor, step)), 1e-4 * unit);
  const place = transformPoint(toSpace, pointed);
  return at.ctrlKey || at.metaKey ? snappedPoint(place, roundStep(SNAP_PIXELS * unit)) : withoutDust(place, unit);
}
