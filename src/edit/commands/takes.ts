/**
 * Commands on several takes: which of them play, when and where. Each is a single undo step, however many characters it
 * affects, since a folder of fifty files is fifty characters with a take each.
 */

import { isSameSize, matchJoints } from '../../evaluate/compare/joint-match.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { type Character, type Document, findCharacter, shownTake } from '../../model/document.ts';
import { isCaptureKind, NO_MARKS, type PartMark } from '../../model/part.ts';
import type { Space } from '../../model/space.ts';
import type { Take } from '../../model/takes/take.ts';
import { indexIn } from '../arguments.ts';
import { requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName, SHORT_NAME } from '../cut-name.ts';
import { RETARGETED, withoutDriver } from '../drivers.ts';
import { driverSource } from '../follow/sources.ts';
import { extentOf } from '../place-beside.ts';
import { ownHeight } from '../same-height.ts';
import { boolean, number, oneOf, optional, shape } from '../schema/shape.ts';
import { CHARACTERS, TAKES, takeRef } from '../schema/shared-shapes.ts';
import { characterIn } from '../step-names.ts';
import { withoutUnkeyed } from '../unkeyed.ts';

/** One take of one character. */
export interface TakeRef {
  readonly characterId: string;
  /** Index of the character's takes; -1: the character in its pose, without a take; `RETARGETED`. */
  readonly take: number;
}

/** Shows these takes; `alone` also hides all other characters. */
export const showTakes = command({
  id: 'takes.show',
  args: { ...TAKES, alone: optional(boolean) },
  label(document, { takes, alone }) {
    const one = takes.length === 1 ? nameOfTake(document, takes[0]) : `${takes.length} takes`;
    if (!alone) return `Show ${one}`;
    return takes.length === 1 ? `Play ${one} alone` : `Play ${one} together`;
  },
  run: (document, { takes, alone }) => shown(document, takesIn(document, takes), alone === true),
});

function shown(document: Document, takes: ReadonlyMap<string, number>, alone: boolean): Document {
  return mapCharacters(document, (c) => {
    const take = takes.get(c.id);
    if (take === undefined) return alone ? hidden(c) : c;
    if (take === RETARGETED) return visible(c);
    // Showing a take of its own ends retargeting.
    const seen = withoutDriver(visible(c));
    return seen.shownTake === take ? seen : { ...withoutUnkeyed(seen), shownTake: take };
  });
}

/** Makes takes start at the same transport time, by default 0. */
export const alignStarts = command({
  id: 'takes.alignStarts',
  args: { ...CHARACTERS, atSeconds: optional(number) },
  label: (document, { characterIds }) => `Align starts of ${namesOf(document, characterIds)}`,
  run(document, { characterIds, atSeconds = 0 }) {
    const aligned = new Set(idsIn(document, characterIds));
    // The offset is added to transport time, so that the take's first second falls on this time.
    const ofOwn = (take: Take) => take.range[0] - atSeconds + 0;
    return changeThese(document, characterIds, (c) => {
      const { driver } = c;
      const take = driver?.source.take ?? shownTake(c);
      if (!take) return c;
      if (!driver) return offsetBy(c, ofOwn(take));
      // A retargeted take has its source's offset too, as it will be if the source is aligned by the same step.
      const source = findCharacter(document, driver.sourceId);
      const sourceTake = source && shownTake(source);
      const isAligned = source && sourceTake && !source.driver && aligned.has(source.id);
      const theirs = isAligned ? ofOwn(sourceTake) : driver.source.timeOffsetSeconds;
      return offsetBy(c, ofOwn(take) - theirs);
    });
  },
});

/** Sets how many seconds are added to the transport's time for each of the characters. */
export const setTimeOffsets = command({
  id: 'takes.setTimeOffsets',
  args: { ...CHARACTERS, seconds: number },
  label: (document, { characterIds }) => `Set start time of ${namesOf(document, characterIds)}`,
  run(document, { characterIds, seconds }) {
    return changeThese(document, characterIds, (c) => offsetBy(c, seconds));
  },
});

/**
 * `grid`: side by side in rows, by their starting positions. `spot`: all start where the first one does. `space`: all
 * in the first one's coordinates, as recorded together.
 */
export const ARRANGEMENTS = ['grid', 'spot', 'space'] as const;
/** How characters are placed; see `ARRANGEMENTS`. */
export type Arrangement = (typeof ARRANGEMENTS)[number];

const ARRANGED: Readonly<Record<Arrangement, string>> = {
  grid: 'side by side',
  spot: 'at the same spot',
  space: 'in the same space',
};

/** Moves characters into a grid, onto one spot, or to one placement, so that they are as far apart as in their files. */
export const arrange = command({
  id: 'takes.arrange',
  args: { ...CHARACTERS, how: oneOf(ARRANGEMENTS) },
  label: (document, { characterIds, how }) => `Arrange ${namesOf(document, characterIds)} ${ARRANGED[how]}`,
  run(document, { characterIds, how }) {
    const characters = idsIn(document, characterIds).map((id) => requireCharacter(document, id));
    const places =
      how === 'space' ? sameSpace(characters) : how === 'spot' ? onOneSpot(characters) : inGrid(characters);
    return mapCharacters(document, (c) => {
      const position = places.get(c.id);
      return position ? placedAt(c, position) : c;
    });
  },
});

/**
 * Overlays one take on another: shows both and nothing else, the second in the place of the first. Takes of one actor
 * also share its scale, unit and ground. Others keep their own sizes; only where a unit isn't known and one is far
 * taller, the second is made as tall as the first. Two takes of one character can't both be shown: there the first is
 * shown, or the retargeted one, and the viewer draws the other over it.
 */
export const overlayTakes = command({
  id: 'takes.overlay',
  args: { first: takeRef, second: takeRef },
  label: (document, { first, second }) =>
    `Compare ${nameOfTake(document, first, SHORT_NAME)} with ${nameOfTake(document, second, SHORT_NAME)}`,
  run(document, { first, second }) {
    if (first.characterId === second.characterId) {
      const [, one] = checkedRefs(document, [first, second], -1);
      return shown(document, takesIn(document, [one.take === RETARGETED ? one : first]), true);
    }
    const next = shown(document, takesIn(document, [first, second]), true);
    const like = requireCharacter(next, first.characterId);
    const { space } = like;
    return mapCharacters(next, (c) => {
      if (c.id !== second.characterId) return c;
      const isSame = isSameActor(like, c);
      const placement = isSame ? like.placements[0] : { ...like.placements[0], scale: overlaidScale(like, c) };
      const placed = samePlacement(c.placements[0], placement)
        ? c
        : { ...c, placements: [placement, ...c.placements.slice(1)] };
      // Unit and ground level were guessed for each separately; that is no difference between takes of one actor.
      return isSame && space && c.space && !liesAlike(c.space, space) ? { ...placed, space } : placed;
    });
  },
});

function isSameActor({ skeleton: a }: Character, { skeleton: b }: Character): boolean {
  return !a || !b || isSameSize(a, b, matchJoints(a, b));
}

/** Heights further apart than this factor are made equal where a unit isn't known. */
const FAR_TALLER = 2;

function overlaidScale(first: Character, second: Character): number {
  const { scale } = second.placements[0];
  if (hasUnit(first) && hasUnit(second)) return scale;
  const [target, height] = [first.placements[0].scale * ownHeight(first), ownHeight(second)];
  if (!(target > 0 && height > 0)) return scale;
  const ratio = (scale * height) / target;
  return ratio > FAR_TALLER || ratio < 1 / FAR_TALLER ? target / height : scale;
}

const hasUnit = ({ space }: Character) => space !== undefined && space.unit !== 'asIs';

const wholeCharacters = shape('a list of characters', (value): value is readonly Character[] => Array.isArray(value));

/**
 * Undoes the changes of overlaying takes: spaces, takes shown, visibility. Places and sizes are those from before,
 * whatever changed them meanwhile: while takes are compared they are part of the comparison. Other changes are kept.
 *
 * @param before characters as they were before
 * @param overlaid the same ones right after
 */
export const endOverlay = command({
  id: 'takes.endOverlay',
  args: { before: wholeCharacters, overlaid: wholeCharacters },
  notFromScripts: 'it takes whole characters. Run "compare.stop"',
  label: (_document, { before, overlaid }) => `Stop comparing ${comparedNames(before, overlaid)}`,
  run(document, { before, overlaid }) {
    const was = new Map(before.map((c) => [c.id, c]));
    const became = new Map(overlaid.map((c) => [c.id, c]));
    return mapCharacters(document, (c) => {
      const [from, to] = [was.get(c.id), became.get(c.id)];
      return from && to ? putBack(document, c, from, to) : c;
    });
  },
});

function putBack(document: Document, now: Character, from: Character, to: Character): Character {
  let c = withPlacements(now, from.placements);
  if (from.space && to.space && c.space && !liesAlike(from.space, to.space) && liesAlike(c.space, to.space)) {
    c = { ...c, space: from.space };
  }
  // Takes are identified by index, which means nothing after some were added or removed.
  const sameTakes = c.takes.length === from.takes.length;
  if (from.shownTake !== to.shownTake && c.shownTake === to.shownTake && sameTakes) {
    c = { ...withoutUnkeyed(c), shownTake: from.shownTake };
  }
  if (from.driver && !to.driver && !c.driver) {
    // The source may have changed while it was not retargeted.
    const mover = document.characters.find(({ id }) => id === from.driver?.sourceId);
    const source = (mover && !mover.driver && driverSource(mover)) || from.driver.source;
    c = { ...c, driver: { ...from.driver, source } };
  }
  const wasHidden = from.isHidden ?? false;
  if (wasHidden !== (to.isHidden ?? false) && wasHidden !== (c.isHidden ?? false))
    c = wasHidden ? hidden(c) : visible(c);
  return c;
}

/** With these placements; instances added meanwhile stay where they are. */
function withPlacements(character: Character, [first, ...others]: Character['placements']): Character {
  const now = character.placements;
  const isSameCount = now.length === others.length + 1;
  const next: Character['placements'] = [first, ...(isSameCount ? others : now.slice(1))];
  return now.every((placement, i) => samePlacement(placement, next[i]))
    ? character
    : { ...character, placements: next };
}

/** Whether both have the same up axis, unit and lift. */
function liesAlike(a: Space, b: Space): boolean {
  return a.up === b.up && a.unit === b.unit && a.lift === b.lift && a.metres === b.metres;
}

/** Removes takes; a character that consists only of takes (a motion capture file) is removed with its last one. */
export const removeTakes = command({
  id: 'takes.remove',
  args: TAKES,
  label: (document, { takes }) =>
    takes.length === 1 ? `Remove ${nameOfTake(document, takes[0])}` : `Remove ${takes.length} takes`,
  run(document, { takes }) {
    const gone = new Map<string, Set<number>>();
    for (const { characterId, take } of checkedRefs(document, takes, 0)) {
      gone.set(characterId, (gone.get(characterId) ?? new Set()).add(take));
    }
    if (!gone.size) return document;
    const characters: Character[] = [];
    for (const character of document.characters) {
      const without = gone.get(character.id);
      const kept = without?.delete(RETARGETED) ? withoutDriver(character) : character;
      if (!without?.size) characters.push(kept);
      else if (without.size < character.takes.length || !isOnlyTakes(character)) {
        characters.push(withoutTakes(kept, without));
      }
    }
    return { ...document, characters };
  },
});

/** Whether a character is only a skeleton that came with its motion, and not worth keeping without it. */
function isOnlyTakes({ skins, morphs, skeleton, parts = NO_MARKS }: Character): boolean {
  if (!skeleton) return true;
  const isOther = (mark: PartMark | undefined) => mark?.file !== undefined && !isCaptureKind(mark.file.kind);
  const { file } = parts.skeleton ?? {};
  const isOfCapture = isCaptureKind(file?.kind) && ![...parts.takes, parts.poses].some(isOther);
  return skins.length === 0 && morphs.length === 0 && isOfCapture;
}

/** If the take was shown, the next one is shown instead, or the previous one if it was the last. */
function withoutTakes(character: Character, gone: ReadonlySet<number>): Character {
  const takes = character.takes.filter((_, i) => !gone.has(i));
  const before = character.takes.filter((_, i) => i < character.shownTake && !gone.has(i)).length;
  if (character.shownTake < 0 || !gone.has(character.shownTake)) {
    return { ...character, takes, shownTake: character.shownTake < 0 ? -1 : before };
  }
  return { ...withoutUnkeyed(character), takes, shownTake: Math.min(before, takes.length - 1) };
}

// Placements.

const ROOM = 1.6;
const MIN_CELL_SIZE = 0.5;

/** Starting position of a character's root on the scene's ground, without its placement, and the character's width. */
function startOf(character: Character): { readonly x: number; readonly z: number; readonly width: number } {
  const { min, max, depth } = extentOf(character);
  const [{ scale }] = character.placements;
  return { x: (scale * (min + max)) / 2, z: scale * depth, width: scale * (max - min) };
}

/** Nearly square; the first one at the back left, rows towards the viewer. */
function inGrid(characters: readonly Character[]): Map<string, Vec3> {
  const starts = characters.map(startOf);
  const cell = ROOM * starts.reduce((most, s) => Math.max(most, s.width), MIN_CELL_SIZE);
  const columns = Math.ceil(Math.sqrt(characters.length));
  const rows = Math.ceil(characters.length / columns);
  return new Map(
    characters.map((c, i) => {
      const x = ((i % columns) - (columns - 1) / 2) * cell;
      const z = (Math.floor(i / columns) - (rows - 1) / 2) * cell;
      return [c.id, place(x - starts[i].x, c, z - starts[i].z)];
    }),
  );
}

function onOneSpot(characters: readonly Character[]): Map<string, Vec3> {
  const [first] = characters;
  const spot = startOf(first);
  const [{ position }] = first.placements;
  return new Map(
    characters.slice(1).map((c) => {
      const own = startOf(c);
      return [c.id, place(position[0] + spot.x - own.x, c, position[2] + spot.z - own.z)];
    }),
  );
}

function sameSpace(characters: readonly Character[]): Map<string, Vec3> {
  const [{ placements }] = characters;
  return new Map(characters.map((c) => [c.id, placements[0].position]));
}

/** Rounded to millimetres, precise enough for placing. */
function place(x: number, { placements }: Character, z: number): Vec3 {
  return [Number(x.toFixed(3)) + 0, placements[0].position[1], Number(z.toFixed(3)) + 0];
}

function placedAt(character: Character, position: Vec3): Character {
  const [first, ...others] = character.placements;
  if (first.position.every((p, k) => p === position[k])) return character;
  return { ...character, placements: [{ ...first, position }, ...others] };
}

function samePlacement(a: Character['placements'][number], b: Character['placements'][number]): boolean {
  const same = (p: Vec3, q: Vec3) => p.every((v, k) => v === q[k]);
  return a === b || (same(a.position, b.position) && same(a.turn, b.turn) && a.scale === b.scale);
}

// Characters.

function offsetBy(character: Character, seconds: number): Character {
  return character.timeOffsetSeconds === seconds ? character : { ...character, timeOffsetSeconds: seconds };
}

function visible(character: Character): Character {
  if (!character.isHidden) return character;
  const { isHidden: _gone, ...rest } = character;
  return rest;
}

function hidden(character: Character): Character {
  return character.isHidden ? character : { ...character, isHidden: true };
}

/** The same document object if all characters are unchanged. */
function mapCharacters(document: Document, change: (c: Character) => Character): Document {
  const characters = document.characters.map(change);
  return characters.every((c, i) => c === document.characters[i]) ? document : { ...document, characters };
}

function changeThese(document: Document, ids: readonly string[], change: (c: Character) => Character): Document {
  const these = new Set(idsIn(document, ids));
  return mapCharacters(document, (c) => (these.has(c.id) ? change(c) : c));
}

function idsIn(document: Document, ids: readonly string[]): string[] {
  const found = ids.map((id) => requireCharacter(document, id).id);
  if (!found.length) throw new CommandError('Give at least one character.');
  return found;
}

/** A retargeted take of the character is valid too. @param least the smallest valid index: -1 if no take is valid */
export function checkedRefs(document: Document, takes: readonly TakeRef[], least: number): TakeRef[] {
  return takes.map(({ characterId, take }) => {
    const character = requireCharacter(document, characterId);
    if (take === RETARGETED && character.driver) return { characterId: character.id, take };
    return { characterId: character.id, take: indexIn(take, least, character.takes.length, 'take') };
  });
}

/** The take to show for each character. */
function takesIn(document: Document, takes: readonly TakeRef[]): ReadonlyMap<string, number> {
  const found = new Map<string, number>();
  for (const { characterId, take } of checkedRefs(document, takes, -1)) {
    if (found.has(characterId) && found.get(characterId) !== take) {
      const { name } = requireCharacter(document, characterId);
      throw new CommandError(`${name} shows one take at a time. Use Compare for two of them.`);
    }
    found.set(characterId, take);
  }
  return found;
}

/**
 * The name of a take, cut to `length` characters: the retargeted one's if it is meant, the character's if there is
 * none.
 * @throws CommandError if the character does not exist
 */
export function nameOfTake(document: Document, { characterId, take }: TakeRef, length?: number): string {
  const character = requireCharacter(document, characterId);
  const named = take === RETARGETED ? character.driver?.source.take : character.takes[take];
  return cutName(named?.name ?? character.name, length);
}

/** `walk and run`; without takes the names of their characters. */
function comparedNames(before: readonly Character[], overlaid: readonly Character[]): string {
  const was = new Map(before.map((c) => [c.id, c]));
  const compared = overlaid.filter((c) => !c.isHidden && was.has(c.id));
  if (compared.length > 2) return `${compared.length} takes`;
  return compared.map((c) => cutName(shownTake(c)?.name ?? c.name, SHORT_NAME)).join(' and ') || 'takes';
}

function namesOf(document: Document, ids: readonly string[]): string {
  return ids.length === 1 ? characterIn(document, ids[0]) : `${ids.length} takes`;
}
