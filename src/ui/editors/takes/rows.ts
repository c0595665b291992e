/** The takes of a document as rows of a table: one for each take of each character. */
import type { TakeRef } from '../../../edit/commands/takes.ts';
import { RETARGETED } from '../../../edit/drivers.ts';
import { frameRateOf } from '../../../evaluate/samples/frame-rate.ts';
import { framesOfTake } from '../../../evaluate/samples/key-frames.ts';
import type { Character, Document, Driver } from '../../../model/document.ts';
import { perObject } from '../../../model/per-object.ts';
import { baseOf, type Take } from '../../../model/takes/take.ts';
import { playedTake, type TakeColumn, type TakeOrder } from '../../state/takes.ts';
import { movesText } from '../retarget/moved-text.ts';

export interface TakeRow extends TakeRef {
  /** Stable for the same take of the same character. */
  readonly key: string;
  readonly name: string;
  /** Empty if the take has the same name. */
  readonly character: string;
  /** The take shown by its visible character. */
  readonly isShown: boolean;
  readonly isHidden: boolean;
  /** `retargeted` for another character's take that moves this one; `drives walker` for the source take. */
  readonly note: string;
  /** First to last second played, of the take. */
  readonly range: readonly [number, number];
  readonly durationSeconds: number;
  readonly isKeyed: boolean;
  /** Both absent for keys at uneven times, which have no frames. */
  readonly frameCount?: number;
  readonly framesPerSecond?: number;
  readonly offsetSeconds: number;
  /** Time of the transport at which its first frame plays. */
  readonly startSeconds: number;
  /** x of the first placement. */
  readonly x: number;
  readonly z: number;
  /** Empty without a file. */
  readonly file: string;
}

export const takeKey = ({ characterId, take }: TakeRef) => `${characterId}/${take}`;

const rowsOf = perObject((character: Character): readonly TakeRow[] => {
  const own = character.takes.map((_, take) => rowOf(character, take));
  const { driver } = character;
  return driver ? [...own, retargetedRow(character, driver)] : own;
});

/** In the document's order. Rows of unchanged characters are the same objects. */
export function takeRows(document: Document): TakeRow[] {
  const movers = new Set(document.characters.map(({ driver }) => driver?.sourceId));
  return document.characters.flatMap((character) => {
    const rows = rowsOf(character);
    if (!movers.has(character.id)) return rows;
    const note = movesText(document, character);
    return rows.map((row) => (row.take === character.shownTake ? { ...row, note } : row));
  });
}

function rowOf(character: Character, index: number): TakeRow {
  const take = character.takes[index];
  const { position } = character.placements[0];
  const { range } = take;
  const isHidden = character.isHidden ?? false;
  const key = takeKey({ characterId: character.id, take: index });
  return {
    key,
    characterId: character.id,
    take: index,
    name: take.name,
    character: take.name === character.name ? '' : character.name,
    // No take is shown while another character's moves it.
    isShown: !isHidden && !character.driver && character.shownTake === index,
    isHidden,
    note: '',
    range,
    durationSeconds: range[1] - range[0],
    ...framesIn(take),
    offsetSeconds: character.timeOffsetSeconds,
    startSeconds: range[0] - character.timeOffsetSeconds,
    x: position[0],
    z: position[2],
    // Under its earlier name too, since it came from that file.
    file: character.parts?.takes[index]?.file?.source.path ?? '',
  };
}

/** The take of another character, as it moves this one. */
function retargetedRow(character: Character, { source }: Driver): TakeRow {
  const { range, name } = source.take;
  const { position } = character.placements[0];
  const offsetSeconds = character.timeOffsetSeconds + source.timeOffsetSeconds;
  const ref = { characterId: character.id, take: RETARGETED };
  return {
    ...ref,
    key: takeKey(ref),
    name: name || source.name,
    character: character.name,
    isShown: !character.isHidden,
    isHidden: character.isHidden ?? false,
    note: `retargeted to ${character.name}`,
    range,
    durationSeconds: range[1] - range[0],
    ...framesIn(source.take),
    offsetSeconds,
    startSeconds: range[0] - offsetSeconds,
    x: position[0],
    z: position[2],
    file: '',
  };
}

function framesIn(take: Take): Pick<TakeRow, 'isKeyed' | 'frameCount' | 'framesPerSecond'> {
  const isKeyed = baseOf(take).samples === undefined;
  const framesPerSecond = frameRateOf(take);
  if (framesPerSecond === undefined) return { isKeyed };
  return { isKeyed, framesPerSecond, frameCount: framesOfTake(take, framesPerSecond).frameCount };
}

/** Filtered and sorted; equal ones keep the document's order. */
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

/** Takes are numbered: `walk_2` sorts before `walk_10`. Created once, as that is slow. */
const NAMES = new Intl.Collator('en', { numeric: true, sensitivity: 'base' });

function compare(a: string | number, b: string | number): number {
  if (typeof a === 'string' && typeof b === 'string') return NAMES.compare(a, b);
  return Number(a) - Number(b);
}

/** Row key of the take that a character plays; undefined if it plays none. */
export function shownKey(character: Character): string | undefined {
  const played = playedTake(character);
  return played && takeKey(played);
}
