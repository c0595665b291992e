/**
 * Where the floor is drawn. Characters whose origin is in their middle would be half below a floor at 0; if none of
 * those that are visible stands on it, the floor is at their lowest point. That is for the view alone: no number
 * changes.
 */
import type { Character } from '../model/document.ts';
import { filePose } from '../model/skeleton/dofs.ts';
import { extentOf } from './place-beside.ts';

/** Part of a character's height that is below 0 if its origin is in its middle. */
const SUNK = 0.1;

/** The scene's y of the floor: 0, or below it. @param characters those that are visible */
export function floorOf(characters: readonly Character[]): number {
  let floor = 0;
  for (const character of characters) {
    const { low, height } = restingOf(character);
    if (!(height > 0)) continue;
    if (!(low < -SUNK * height)) return 0;
    const [{ position, scale }] = character.placements;
    floor = Math.min(floor, position[1] + scale * low);
  }
  return floor;
}

/** In its file pose, or at the start of its take, which may carry it onto the floor. Before its placement. */
function restingOf(character: Character): { readonly low: number; readonly height: number } {
  const { driver, unkeyed, ...others } = character;
  const pose = filePose(character.skeleton, character.morphs.length);
  const rest = extentOf({ ...others, pose, takes: [], shownTake: -1 });
  const start = extentOf(character);
  return start.low > rest.low ? start : rest;
}
