/**
 * State of the list of takes outside the document: order, filter, selection, and the two takes being compared. Neither
 * remembered nor undoable.
 */

import type { TakeRef } from '../../edit/commands/takes.ts';
import { RETARGETED, withoutDriver } from '../../edit/drivers.ts';
import type { Alignment } from '../../evaluate/compare/posed-joints.ts';
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import { twinOf } from '../../model/drawn-id.ts';
import { perObject } from '../../model/per-object.ts';
import { type Observable, observable } from '../widgets/observable.ts';
import type { SortOrder } from '../widgets/table/sort-heads.ts';

const TAKE_COLUMNS = ['name', 'character', 'duration', 'frames', 'rate', 'start', 'x', 'z', 'file'] as const;
export type TakeColumn = (typeof TAKE_COLUMNS)[number];

export type TakeOrder = SortOrder<TakeColumn>;

export interface TakesView {
  /** Absent: the document's own order. */
  readonly order?: TakeOrder;
  /** Part of a name. */
  readonly filter: string;
  /** Keys of rows. */
  readonly chosen: ReadonlySet<string>;
  /** The row with the keyboard focus. */
  readonly focused?: string;
}

/**
 * Two takes, one over the other. Of two characters, what they play: the comparison follows when one shows another take,
 * is retargeted, or baked. Of one character, what it plays and the second take.
 */
export interface Comparison {
  readonly first: TakeRef;
  readonly second: TakeRef;
}

/** What a comparison has changed, and what is needed to restore it. */
export interface ComparisonOverlay {
  readonly comparison: Comparison;
  readonly before: Document;
  readonly after: Document;
  /** Playback ranges before and during the comparison; seconds of the transport. */
  readonly playedBefore: readonly [number, number];
  readonly played: readonly [number, number];
  /** Documents reached by undo and redo in which the takes are compared, and in which they aren't. */
  readonly compared: Document[];
  readonly apart: Document[];
}

/** How distances are shown; kept across comparisons. */
export interface DistanceView {
  readonly alignment: Alignment;
  /** Pairs of joints drawn individually, as rows of the distances. */
  readonly picked: readonly number[];
  readonly order: 'most' | 'mean' | 'name';
}

export class Takes {
  readonly view: Observable<TakesView> = observable<TakesView>({ filter: '', chosen: new Set() });
  readonly comparison: Observable<Comparison | undefined> = observable<Comparison | undefined>(undefined);
  /** Of the current or last comparison: undo may re-enter it. */
  overlay: ComparisonOverlay | undefined;
  readonly distances: Observable<DistanceView> = observable<DistanceView>({
    alignment: 'world',
    picked: [],
    order: 'most',
  });

  change(change: Partial<TakesView>): void {
    this.view.update((now) => ({ ...now, ...change }));
  }
}

/** One of the two compared takes, as it plays. */
export interface Compared {
  /** Showing the compared take. */
  readonly character: Character;
  /** Id for drawing: its own, or another if both takes are the same character's. */
  readonly drawnAs: string;
}

/** The two characters; undefined if one of them has nothing to play any more, or both play the same take. */
export function comparedIn(
  document: Document,
  comparison: Comparison | undefined,
): readonly [Compared, Compared] | undefined {
  if (!comparison) return undefined;
  const { first, second } = comparison;
  const isOne = first.characterId === second.characterId;
  const a = findCharacter(document, first.characterId);
  const b = isOne ? showing(document, second) : findCharacter(document, second.characterId);
  if (!a || !b || a === b || !plays(a) || !plays(b)) return undefined;
  return [
    { character: a, drawnAs: a.id },
    { character: b, drawnAs: isOne ? twinOf(b.id) : b.id },
  ];
}

/** The take that a character plays: a retargeted one, or its own; undefined if it plays none. */
export function playedTake(character: Character): TakeRef | undefined {
  const { id, driver, takes, shownTake } = character;
  if (driver) return { characterId: id, take: RETARGETED };
  return takes[shownTake] ? { characterId: id, take: shownTake } : undefined;
}

const plays = (character: Character) => playedTake(character) !== undefined;

/** Name of the take that a character plays: `walk`, `walk on wasp` if it is retargeted. */
export function playedName(character: Character): string {
  return character.driver ? `${takeName(character)} on ${character.name}` : takeName(character);
}

function takeName({ driver, takes, shownTake, name }: Character): string {
  if (driver) return driver.source.take.name || driver.source.name;
  return takes[shownTake]?.name ?? name;
}

/** A character showing each of its takes, by index of the take. */
const showingEach = perObject((character: Character) =>
  character.takes.map((_, shownTake) => ({ ...withoutDriver(character), shownTake })),
);

/** The character playing that take: the same object for the same character. */
export function showing(document: Document, { characterId, take }: TakeRef): Character | undefined {
  const character = findCharacter(document, characterId);
  if (take === RETARGETED) return character?.driver && character;
  if (!character?.takes[take]) return undefined;
  if (character.shownTake === take && !character.driver) return character;
  return showingEach(character)[take];
}

/** The document as drawn: a character appears twice, each with its take's name, if two of its takes are compared. */
export function drawnDocument(document: Document, comparison: Comparison | undefined): Document {
  const compared = comparedIn(document, comparison);
  if (!compared) return document;
  const [a, b] = compared;
  if (a.character.id !== b.character.id) return document;
  const { isHidden } = a.character;
  const named = { ...a.character, name: takeName(a.character) };
  const twin: Character = {
    ...b.character,
    id: b.drawnAs,
    name: takeName(b.character),
    ...(isHidden && { isHidden }),
  };
  const characters = document.characters.map((c) => (c.id === named.id ? named : c));
  return { ...document, characters: [...characters, twin] };
}
