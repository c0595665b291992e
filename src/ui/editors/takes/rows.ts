/** The takes of a document as rows of a table: one for each take of each character. */
import type { TakeRef } from '../../../edit/commands/takes.ts';
import { type Character, type Document, shownClip } from '../../../model/document.ts';
import { perObject } from '../../../model/per-object.ts';
import type { TakeColumn, TakeOrder } from '../../state/takes.ts';
import { followsText, movesText } from '../retarget/moved-text.ts';

export interface TakeRow extends TakeRef {
  /** The same for the same take of the same character. */
  readonly key: string;
  readonly name: string;
  /** Empty where the take is called the same. */
  readonly character: string;
  /** It is the one that its character shows, and that is seen. */
  readonly isShown: boolean;
  readonly isHidden: boolean;
  /** `aside: walker follows dance`, of one that another's take moves; `moves walker`, of the take that does. */
  readonly note: string;
  /** First to last second that is played, of the clip. */
  readonly range: readonly [number, number];
  readonly durationSeconds: number;
  /** Absent for a take that has keys only: how many frames it is depends on who counts. */
  readonly frameCount?: number;
  readonly framesPerSecond?: number;
  readonly offsetSeconds: number;
  /** Of the transport, when its first moment is played. */
  readonly startSeconds: number;
  /** Of the first placement. */
  readonly x: number;
  readonly z: number;
  /** Empty where it came from none. */
  readonly file: string;
}

export const takeKey = ({ characterId, clip }: TakeRef) => `${characterId}/${clip}`;

const rowsOf = perObject((character: Character): readonly TakeRow[] =>
  character.clips.map((_, clip) => rowOf(character, clip)),
);

/** In the document's order. Rows of characters that did not change are the same objects. */
export function takeRows(document: Document): TakeRow[] {
  const movers = new Set(document.characters.map(({ driver }) => driver?.sourceId));
  return document.characters.flatMap((character) => {
    const rows = rowsOf(character);
    if (!movers.has(character.id)) return rows;
    const note = movesText(document, character);
    return rows.map((row) => (row.clip === character.shownClip ? { ...row, note } : row));
  });
}

function rowOf(character: Character, index: number): TakeRow {
  const clip = character.clips[index];
  const { position } = character.placements[0];
  const { samples, range } = clip;
  const isHidden = character.isHidden ?? false;
  const key = takeKey({ characterId: character.id, clip: index });
  return {
    key,
    characterId: character.id,
    clip: index,
    name: clip.name,
    character: clip.name === character.name ? '' : character.name,
    // None of its own is, while another's moves it.
    isShown: !isHidden && !character.driver && character.shownClip === index,
    isHidden,
    note: character.driver ? `aside: ${character.name} ${followsText(character)}` : '',
    range,
    durationSeconds: range[1] - range[0],
    ...(samples && { frameCount: samples.frameCount, framesPerSecond: 1 / samples.frameSeconds }),
    offsetSeconds: character.timeOffsetSeconds,
    startSeconds: range[0] - character.timeOffsetSeconds,
    x: position[0],
    z: position[2],
    // That of its earlier name too: there it came from.
    file: character.parts?.clips[index]?.file?.source.path ?? '',
  };
}

/** Those that are looked for, in the order asked for. Of equal ones the document's first comes first. */
export function listedTakes(rows: readonly TakeRow[], filter: string, order: TakeOrder | undefined): TakeRow[] {
  const words = filter.toLowerCase().split(/\s+/).filter(Boolean);
  const found = rows.filter(({ name, character, file }) => {
    const text = `${name} ${character} ${file}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
  if (!order) return found;
  const sign = order.descending ? -1 : 1;
  return found.sort((a, b) => sign * compare(sortedBy(a, order.column), sortedBy(b, order.column)));
}

function sortedBy(row: TakeRow, column: TakeColumn): string | number {
  switch (column) {
    case 'name':
    case 'file':
    case 'x':
    case 'z':
      return row[column];
    case 'character':
      return row.character || row.name;
    case 'duration':
      return row.durationSeconds;
    case 'frames':
      return row.frameCount ?? -1;
    case 'rate':
      return row.framesPerSecond ?? -1;
    case 'start':
      return row.startSeconds;
  }
}

/** Takes are numbered: `walk_2` comes before `walk_10`. Made once, for making one is slow. */
const NAMES = new Intl.Collator('en', { numeric: true, sensitivity: 'base' });

function compare(a: string | number, b: string | number): number {
  if (typeof a === 'string' && typeof b === 'string') return NAMES.compare(a, b);
  return Number(a) - Number(b);
}

/** A character's take that is shown, as a row's key; undefined for one that shows none. */
export function shownKey(character: Character): string | undefined {
  return shownClip(character) && takeKey({ characterId: character.id, clip: character.shownClip });
}
