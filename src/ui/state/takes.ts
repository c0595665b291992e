/**
 * State of the list of takes outside the document: order, filter, selection, and the two takes being compared. Neither
 * remembered nor undoable.
 */
import type { TakeRef } from '../../edit/commands/takes.ts';
import type { Alignment } from '../../evaluate/distance.ts';
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import { twinOf } from '../../model/drawn-id.ts';
import { perObject } from '../../model/per-object.ts';
import { type Observable, observable } from '../kit/observable.ts';

const TAKE_COLUMNS = ['name', 'character', 'duration', 'frames', 'rate', 'start', 'x', 'z', 'file'] as const;
export type TakeColumn = (typeof TAKE_COLUMNS)[number];

export interface TakeOrder {
  readonly column: TakeColumn;
  readonly descending: boolean;
}

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

/** Two takes, one over the other. */
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

/** The two characters; undefined if one of the takes no longer exists. */
export function comparedIn(
  document: Document,
  comparison: Comparison | undefined,
): readonly [Compared, Compared] | undefined {
  if (!comparison) return undefined;
  const { first, second } = comparison;
  const [a, b] = [playing(document, first), playing(document, second)];
  if (!a || !b) return undefined;
  const drawnAs = a.id === b.id ? twinOf(b.id) : b.id;
  return [
    { character: a, drawnAs: a.id },
    { character: b, drawnAs },
  ];
}

/** A character showing each of its takes, by index of the take. */
const showingEach = perObject((character: Character) =>
  character.clips.map((_, shownClip) => ({ ...character, shownClip })),
);

/** The character showing that take: the same object for the same character. */
function playing(document: Document, { characterId, clip }: TakeRef): Character | undefined {
  const character = findCharacter(document, characterId);
  if (!character?.clips[clip]) return undefined;
  if (character.shownClip === clip) return character;
  return showingEach(character)[clip];
}

/** The document as drawn: a character appears twice if two of its takes are compared. */
export function drawnDocument(document: Document, comparison: Comparison | undefined): Document {
  const compared = comparedIn(document, comparison);
  if (!compared) return document;
  const [a, b] = compared;
  if (a.drawnAs === b.drawnAs || a.character.id !== b.character.id) return document;
  const { isHidden } = a.character;
  const twin: Character = { ...b.character, id: b.drawnAs, ...(isHidden && { isHidden }) };
  const characters = document.characters.map((c) => (c.id === a.character.id ? a.character : c));
  return { ...document, characters: [...characters, twin] };
}
