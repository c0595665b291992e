/** How a character's own space maps to the scene, the meaning of its position channels, and whether it is visible. */

import { metresPerUnit } from '../../evaluate/space/metres.ts';
import { liftOntoGround } from '../../evaluate/space/space.ts';
import { type Character, type Document, shownTake } from '../../model/document.ts';
import { poseForPositions, positionsTaken, withPositions } from '../../model/skeleton/position-channels.ts';
import { skeletonKey } from '../../model/skeleton/skeleton-key.ts';
import { LENGTH_UNITS, type Space } from '../../model/space.ts';
import { changeCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { boolean, list, number, oneOf, optional, record, text } from '../schema/shape.ts';
import { CHARACTER } from '../schema/shared-shapes.ts';
import { characterIn } from '../step-names.ts';
import { withoutUnkeyed } from '../unkeyed.ts';

const space = record({
  up: oneOf(['y', 'z', '-y']),
  unit: oneOf(LENGTH_UNITS),
  lift: number,
  metres: optional(number),
});

/** Sets unit, up axis and lift of a character, and of others with the same skeleton if asked to. */
export const setSpace = command({
  id: 'character.setSpace',
  args: {
    ...CHARACTER,
    space,
    /** Also of the other characters with the same skeleton: takes of one session. Default false. */
    ofSkeleton: optional(boolean),
  },
  label(document, args) {
    const others = args.ofSkeleton ? alike(document, args.characterId).length : 0;
    const name = characterIn(document, args.characterId);
    return `Set space of ${name}${others ? ` and ${others} more` : ''}`;
  },
  run(document, { characterId, space, ofSkeleton = false }) {
    const next = checked(space);
    const ids = ofSkeleton ? alike(document, characterId) : [];
    const set = (c: Character) => (c.space && sameSpace(c.space, next) ? c : { ...c, space: next });
    return ids.reduce((all, id) => changeCharacter(all, id, set), changeCharacter(document, characterId, set));
  },
});

/** Ids of the other characters with the same skeleton. */
export function alike({ characters }: Document, characterId: string): readonly string[] {
  const own = characters.find(({ id }) => id === characterId)?.skeleton;
  const key = own && skeletonKey(own);
  return characters.flatMap(({ id, skeleton }) =>
    id !== characterId && skeleton && skeletonKey(skeleton) === key ? [id] : [],
  );
}

function checked(space: Space): Space {
  const { metres = 0, ...next } = space;
  if (next.unit !== 'own') return next;
  if (metres > 0) return { ...next, metres };
  throw new CommandError(`A unit must be longer than 0 m, found ${metres}.`);
}

function sameSpace(a: Space, b: Space): boolean {
  return a.up === b.up && a.unit === b.unit && a.lift === b.lift && metresPerUnit(a) === metresPerUnit(b);
}

/**
 * Whether position channels replace OFFSETs or are added to them. The pose as set stays in place; the take's values are
 * kept, since it is their meaning that changes. A character that stood on the ground is put on the ground again.
 */
export const setPositionChannels = command({
  id: 'skeleton.setPositionChannels',
  args: { ...CHARACTER, positions: oneOf(['replace', 'add']) },
  label: (document, { characterId, positions }) => {
    const name = characterIn(document, characterId);
    return positions === 'add' ? `Add positions of ${name} to offsets` : `Replace offsets of ${name} with positions`;
  },
  run: (document, { characterId, positions }) =>
    changeCharacter(document, characterId, (c) => {
      const { skeleton } = c;
      if (!skeleton || positionsTaken(skeleton) === undefined) {
        throw new CommandError(`${c.name} has no joints with position channels.`);
      }
      const next = withPositions(skeleton, positions);
      if (next === skeleton) return c;
      const pose = poseForPositions(skeleton, c.pose, positions);
      return onTheGround({ ...withoutUnkeyed(c), skeleton: next, pose });
    }),
});

function onTheGround(character: Character): Character {
  const { skeleton, space } = character;
  if (!skeleton || !space) return character;
  return { ...character, space: { ...space, lift: liftOntoGround(skeleton, shownTake(character), space) } };
}

/** Hides or shows characters; hidden ones keep playing. */
export const setHidden = command({
  id: 'character.setHidden',
  args: { ids: list(text), hidden: boolean },
  label(document, { ids, hidden }) {
    const what = ids.length === 1 ? characterIn(document, ids[0]) : `${ids.length} characters`;
    return `${hidden ? 'Hide' : 'Show'} ${what}`;
  },
  run(document, { ids, hidden }) {
    let next = document;
    for (const id of ids) next = changeCharacter(next, id, (c) => seen(c, hidden));
    return next;
  },
});

function seen(character: Character, hidden: boolean): Character {
  if ((character.isHidden ?? false) === hidden) return character;
  if (hidden) return { ...character, isHidden: true };
  const { isHidden: _gone, ...rest } = character;
  return rest;
}
