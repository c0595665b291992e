/**
 * Commands on whole takes: create, rename, duplicate, remove, playback range. Each applies to the shown take unless
 * another is given.
 */

import { type Character, type Document, shownTake } from '../../model/document.ts';
import { sameName } from '../../model/files.ts';
import { INTERPOLATIONS } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName, SHORT_NAME } from '../cut-name.ts';
import { filledText, oneOf, optional } from '../schema/shape.ts';
import { CHARACTER, range, TAKE } from '../schema/shared-shapes.ts';
import { fileInTheWay, newTakeName, requireTake, uniqueTakeName, withNewTake, withTake } from '../takes.ts';
import { withoutUnkeyed } from '../unkeyed.ts';

interface OfTake {
  readonly characterId: string;
  /** Index of the character's takes; default: the shown one. */
  readonly take?: number;
}

/** Sets the seconds of a take that play; its keys stay. */
export const setTakeRange = command({
  id: 'take.setRange',
  args: {
    ...TAKE,
    /** First and last second that play, in seconds of the take. */
    range,
  },
  label: (document, args) => `Set range of ${nameOf(document, args)}`,
  run(document, { characterId, take, range }) {
    return changeCharacter(document, characterId, (c) => {
      const index = takeIndex(c, take);
      const was = c.takes[index];
      const same = was.range[0] === range[0] && was.range[1] === range[1];
      return same ? c : withTake(c, index, { ...was, range });
    });
  },
});

/** How samples are interpolated between frames. */
export const setInterpolation = command({
  id: 'take.setInterpolation',
  args: { ...TAKE, interpolation: oneOf(INTERPOLATIONS) },
  label: (document, args) => `Set interpolation of ${nameOf(document, args)}`,
  run: (document, { characterId, take, interpolation }) =>
    changeCharacter(document, characterId, (c) => {
      const index = takeIndex(c, take);
      const was = c.takes[index];
      if (!was.samples) throw new CommandError(`${was.name} has only keys. Their tangents set the interpolation.`);
      if (was.samples.interpolation === interpolation) return c;
      return withTake(c, index, { ...was, samples: { ...was.samples, interpolation } });
    }),
});

/** Creates a take without keys, at rest in the current pose, and shows it. */
export const createTake = command({
  id: 'take.create',
  args: {
    ...CHARACTER,
    /** Seconds of the take. */
    range,
    /** Default: the skeleton's name. A name in use gets a number. */
    name: optional(filledText),
  },
  label: (document, { characterId, name }) =>
    `New take ${cutName(name ?? newTakeName(requireCharacter(document, characterId)))}`,
  run: (document, { characterId, range, name }) =>
    changeCharacter(document, characterId, (c) => {
      if (!c.skeleton) throw new CommandError(`${c.name} has no skeleton, and its channels need DOFs.`);
      const called = name === undefined ? newTakeName(c) : uniqueTakeName(c, name);
      return withNewTake(withoutUnkeyed(c), called, range);
    }),
});

/** The name is also the file's, so it must differ from the character's other takes and from their files. */
export const renameTake = command({
  id: 'take.rename',
  args: { ...TAKE, name: filledText },
  label: (document, args) => `Rename ${nameOf(document, args, SHORT_NAME)} to ${cutName(args.name.trim(), SHORT_NAME)}`,
  run: (document, { characterId, take, name }) =>
    changeCharacter(document, characterId, (c) => {
      const index = takeIndex(c, take);
      const was = c.takes[index];
      const next = name.trim();
      if (was.name === next) return c;
      const other = c.takes.find((o) => o !== was && sameName(o.name, next));
      if (other) throw new CommandError(`${c.name} already has a take "${other.name}".`);
      const file = fileInTheWay(c, index, next);
      if (file) throw new CommandError(`${file.name} belongs to another take; saving "${next}" would overwrite it.`);
      return withTake(c, index, { ...was, name: next });
    }),
});

/** The duplicate is appended and shown. It shares the channels until one of the two changes. */
export const duplicateTake = command({
  id: 'take.duplicate',
  args: TAKE,
  label: (document, args) => `Duplicate ${nameOf(document, args)}`,
  run: (document, { characterId, take }) =>
    changeCharacter(document, characterId, (c) => {
      const was: Take = c.takes[takeIndex(c, take)];
      const copy = { ...was, name: uniqueTakeName(c, was.name) };
      return { ...withoutUnkeyed(c), takes: [...c.takes, copy], shownTake: c.takes.length };
    }),
});

/** If the take was shown, the next one is shown instead, or the previous one if it was the last. */
export const removeTake = command({
  id: 'take.remove',
  args: TAKE,
  label: (document, args) => `Remove ${nameOf(document, args)}`,
  run: (document, { characterId, take }) =>
    changeCharacter(document, characterId, (c) => {
      const index = takeIndex(c, take);
      const takes = c.takes.filter((_, i) => i !== index);
      if (index > c.shownTake) return { ...c, takes };
      if (index < c.shownTake) return { ...c, takes, shownTake: c.shownTake - 1 };
      return { ...withoutUnkeyed(c), takes, shownTake: Math.min(index, takes.length - 1) };
    }),
});

function takeIndex(character: Character, take: number | undefined): number {
  if (take !== undefined) return indexIn(take, 0, character.takes.length, 'take');
  requireTake(character);
  return character.shownTake;
}

function nameOf(document: Document, { characterId, take }: OfTake, length?: number): string {
  const character = requireCharacter(document, characterId);
  const named = take === undefined ? shownTake(character) : character.takes[take];
  return cutName(named?.name ?? 'take', length);
}
