/**
 * Characters of very different sizes, shown equally tall by the scale of their placements: skeletons, skins and takes
 * are left alone. They are placed side by side again, since the gaps between them were made for their own sizes.
 *
 *     scale = height of the reference as placed / own height
 */
import type { Character, Placement } from '../model/document.ts';
import { sameValue } from './delta.ts';
import { extentOf, leadersOf, Placing } from './place-beside.ts';

/** Something flat counts as this part of its longest side. */
const MIN_PART_OF_SIZE = 0.25;

/** Before its placement, at the start of its take; 0 if nothing of it has a size. */
export function ownHeight(character: Character): number {
  const { height, size } = extentOf(character);
  return Math.max(height, MIN_PART_OF_SIZE * size);
}

/** Own heights. Characters of one file, which keep their relative sizes, have that of the tallest. */
function heightsOf(characters: readonly Character[]): (character: Character) => number {
  const leaderOf = leadersOf(characters);
  const heights = new Map<Character, number>();
  for (const character of characters) {
    const leader = leaderOf(character);
    heights.set(leader, Math.max(heights.get(leader) ?? 0, ownHeight(character)));
  }
  return (character) => heights.get(leaderOf(character)) ?? 0;
}

/** The smallest and the largest height of these characters as placed; undefined if none of them has one. */
export function spreadOfHeights(characters: readonly Character[]): readonly [least: number, most: number] | undefined {
  const heightOf = heightsOf(characters);
  const placed = characters.map((c) => heightOf(c) * c.placements[0].scale).filter((height) => height > 0);
  let [least, most] = [Infinity, 0];
  for (const height of placed) {
    least = Math.min(least, height);
    most = Math.max(most, height);
  }
  return placed.length > 0 ? [least, most] : undefined;
}

/**
 * Scales these characters to the height of one of `all` as placed; those without a height keep their scale. Undefined
 * if it has none itself.
 */
export function withSameHeight(
  all: readonly Character[],
  these: readonly Character[],
  reference: Character,
): readonly Character[] | undefined {
  return scaledTo(all, these, reference, (height, target) => target / height);
}

/**
 * Scales these characters by powers of ten to about the height of one of `all` as placed, as if their files had other
 * units: within a factor of √10. Those without a height keep their scale. Undefined if it has none itself.
 */
export function withSameUnit(
  all: readonly Character[],
  these: readonly Character[],
  reference: Character,
): readonly Character[] | undefined {
  // Its own scale may be any, and its height is the one that counts.
  return scaledTo(all, these, reference, (height, target, character) =>
    character === reference ? character.placements[0].scale : 10 ** tensBetween(height, target),
  );
}

/** @param scaleOf of a character with that height, unscaled; `target` is that of the reference as placed */
function scaledTo(
  all: readonly Character[],
  these: readonly Character[],
  reference: Character,
  scaleOf: (height: number, target: number, character: Character) => number,
): readonly Character[] | undefined {
  const heightOf = heightsOf(all);
  const target = heightOf(reference) * reference.placements[0].scale;
  if (!(target > 0)) return undefined;
  return sideBySide(all, these, (character) => {
    const height = heightOf(character);
    return height > 0 ? scaleOf(height, target, character) : character.placements[0].scale;
  });
}

/** The power of ten that brings the first height nearest to the second. */
export function tensBetween(height: number, target: number): number {
  return Math.round(Math.log10(target / height));
}

/** Scales these characters to the size that their files give. */
export function withOwnHeights(all: readonly Character[], these: readonly Character[]): readonly Character[] {
  return sideBySide(all, these, () => 1);
}

/**
 * Scales and places these characters, beside the others and each other. Further instances keep their position relative
 * to the first. The same list if nothing changes.
 */
function sideBySide(
  all: readonly Character[],
  these: readonly Character[],
  scaleOf: (character: Character) => number,
): readonly Character[] {
  const moved = new Set(these);
  const placing = new Placing(all.filter((character) => !moved.has(character)));
  const next = all.map((character) => {
    if (!moved.has(character)) return character;
    const after = putAt(character, placing.place(character, scaleOf(character)));
    placing.add(after);
    return after;
  });
  return next.every((character, i) => character === all[i]) ? all : next;
}

function putAt(character: Character, { position, scale }: Placement): Character {
  const [first] = character.placements;
  if (scale === first.scale && sameValue(position, first.position)) return character;
  const by = scale / first.scale;
  const placements = character.placements.map((p, i): Placement => {
    if (i === 0) return { ...p, position, scale };
    const at = (k: 0 | 1 | 2) => position[k] + by * (p.position[k] - first.position[k]);
    return { ...p, position: [at(0), at(1), at(2)], scale: by * p.scale };
  });
  return { ...character, placements };
}
