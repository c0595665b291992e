/** Commands for the markers and labelled spans of a take. Each applies to the shown take unless another is given. */

import type { Document } from '../../model/document.ts';
import type { Marker } from '../../model/takes/markers.ts';
import type { Take } from '../../model/takes/take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName } from '../cut-name.ts';
import { sameValue } from '../delta.ts';
import { index, list, number, optional, record, text } from '../schema/shape.ts';
import { indices, TAKE } from '../schema/shared-shapes.ts';
import { requireTake, withTake } from '../takes.ts';

const marker = record({ timeSeconds: number, endSeconds: optional(number), label: text });

interface OfTake {
  readonly characterId: string;
  /** Index of the character's takes; default: the shown one. */
  readonly take?: number;
}

/** Adds markers, or spans. One that the take has already is not added again. */
export const addMarkers = command({
  id: 'markers.add',
  args: { ...TAKE, markers: list(marker) },
  label: (document, args) =>
    `Add ${args.markers.length === 1 ? 'marker' : `${args.markers.length} markers`} to ${nameOf(document, args)}`,
  run: (document, args) =>
    changed(document, args, (take) => {
      const own = take.markers ?? [];
      const added = args.markers.map(checkedMarker);
      const fresh = added.filter((marker) => !own.some((known) => sameValue(known, marker)));
      return fresh.length ? withMarkers(take, [...own, ...fresh]) : take;
    }),
});

/** Moves or renames a marker, or makes it a span. */
export const changeMarker = command({
  id: 'markers.change',
  args: {
    ...TAKE,
    /** Into the take's markers. */
    index,
    marker,
  },
  label: (document, args) => `Change marker of ${nameOf(document, args)}`,
  run: (document, args) =>
    changed(document, args, (take) => {
      const own = take.markers ?? [];
      const index = indexIn(args.index, 0, own.length, 'marker');
      const next = checkedMarker(args.marker);
      return sameValue(own[index], next) ? take : withMarkers(take, own.with(index, next));
    }),
});

/** Removes markers of a take, by index. */
export const removeMarkers = command({
  id: 'markers.remove',
  args: {
    ...TAKE,
    indices,
  },
  label: (document, args) =>
    `Delete ${args.indices.length === 1 ? 'marker' : `${args.indices.length} markers`} of ${nameOf(document, args)}`,
  run: (document, args) =>
    changed(document, args, (take) => {
      const own = take.markers ?? [];
      const gone = new Set(args.indices.map((i) => indexIn(i, 0, own.length, 'marker')));
      return gone.size
        ? withMarkers(
            take,
            own.filter((_, i) => !gone.has(i)),
          )
        : take;
    }),
});

function nameOf(document: Document, { characterId, take }: OfTake): string {
  const character = requireCharacter(document, characterId);
  return cutName(character.takes[take ?? character.shownTake]?.name ?? 'take');
}

function changed(document: Document, args: OfTake, change: (take: Take) => Take): Document {
  return changeCharacter(document, args.characterId, (c) => {
    if (args.take === undefined) requireTake(c);
    const index = args.take === undefined ? c.shownTake : indexIn(args.take, 0, c.takes.length, 'take');
    return withTake(c, index, change(c.takes[index]));
  });
}

function checkedMarker({ timeSeconds: time, endSeconds: end, label }: Marker): Marker {
  // A file has one line for each.
  const plain = label.replace(/\s+/g, ' ').trim();
  if (end === undefined) return { timeSeconds: time, label: plain };
  if (end < time) throw new CommandError(`A span ends at ${end} s, before its start at ${time} s.`);
  return { timeSeconds: time, endSeconds: end, label: plain };
}
