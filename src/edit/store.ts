/**
 * The one place where the document changes: a store of immutable states, and the history that undoes them.
 *
 * A step is known by the states on both sides of it rather than by an inverse command: going back can't be wrong. What
 * is kept of them is their difference (`history.ts`), so a step costs what it changed. (ProseMirror needs inverses for
 * collaboration; we don't.)
 */
import { type Channel, type ChannelClip, keysOf } from '../model/clip.ts';
import type { Document } from '../model/document.ts';
import { EMPTY_DOCUMENT, findCharacter, shownClip } from '../model/document.ts';
import type { ChannelKeys, Selection } from '../model/session.ts';
import { NOTHING_SELECTED } from '../model/session.ts';
import { sameValue } from './delta.ts';
import { followSources } from './drivers.ts';
import { History, type State } from './history.ts';
import { withoutNumbers, withParts } from './parts.ts';

/** A change to the document, by name: menu entry, undo entry and scripted call in one. */
export interface Command<Args, Result extends Document | Edit = Document> {
  /** Stable: `pose.setDof`. */
  readonly id: string;
  /** It makes a character: where none is named, none is meant. */
  readonly makesCharacter?: true;
  /** What the Edit menu says: "Set rx". */
  label(document: Document, args: Args): string;
  /** The document after the change; the very same object where nothing changes. Throws a `CommandError` to refuse. */
  run(document: Document, args: Args): Result;
}

/** A change that also says what is selected after it. What it does not say stays selected as far as it is still there. */
export interface Change {
  readonly document: Document;
  /** The character, and the joint of it, that it was about. */
  readonly selected?: SelectedJoint;
}

/** A change of keys: those it was about are selected, wherever they are now. */
export interface Edit extends Change {
  readonly keys: readonly ChannelKeys[];
}

/** A joint that a change was about, by its index after the change; absent: the character, and none of its joints. */
export interface SelectedJoint {
  readonly characterId: string;
  readonly joint?: number;
}

/** A command that can't be done, with a sentence for the person who asked for it. */
export class CommandError extends Error {
  override readonly name = 'CommandError';
}

/**
 * A drag: previews replace each other, and all of them are one step when committed. Anything else that changes the
 * document ends it first; from then on it does nothing more.
 */
export interface Gesture {
  /** The document as it was when the gesture began: previews are made from it, so nothing drifts. */
  readonly base: Document;
  /** Committed or cancelled, by its own hand or by something else that has happened. */
  readonly closed: boolean;
  preview(change: Document | Edit): void;
  /** @param label what the step is called, where it is known better by now than at the beginning */
  commit(label?: string): void;
  /** Everything as it was before. */
  cancel(): void;
}

/**
 * What becomes of a gesture when something else happens before its own end. A drag is `kept`: one has seen what one's
 * hand did. What is only being `tried`, as behind a dialog that has an Apply button, is put back.
 */
export type Unfinished = 'kept' | 'tried';

type Listener = (now: State, before: State) => void;

export class Store {
  private present: State;
  private readonly history = new History();
  private gesture: (Gesture & { readonly unfinished: Unfinished }) | undefined;
  private readonly listeners = new Set<Listener>();
  private readonly stepListeners = new Set<Listener>();
  /** Ids and revisions of parts: not of the document, for undo must not give one out again. */
  private counted = 0;
  private readonly count = () => ++this.counted;

  constructor(document: Document = EMPTY_DOCUMENT) {
    this.present = { document, selection: NOTHING_SELECTED };
  }

  get document(): Document {
    return this.present.document;
  }

  get selection(): Selection {
    return this.present.selection;
  }

  /** Name of the step that `undo` takes back. */
  get undoLabel(): string | undefined {
    return this.history.undoLabel;
  }

  get redoLabel(): string | undefined {
    return this.history.redoLabel;
  }

  /** Calls back after each change, with the state before it: identity tells what changed. Returns the way out. */
  subscribe(listener: Listener): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /**
   * Calls back after each step that was made in this document, by a command or a gesture that is over: once, with the
   * states on both sides. Not for previews, nor for documents made elsewhere, nor on the way back and forth.
   */
  onStep(listener: Listener): () => void {
    this.stepListeners.add(listener);
    return () => this.stepListeners.delete(listener);
  }

  /** One step. Nothing happens where the command changes nothing. */
  apply<Args>(command: Command<Args, Document | Edit>, args: Args): void {
    this.settle();
    const before = this.present;
    const next = this.stateAfter(before, command.run(before.document, args));
    this.step(command.label(before.document, args), next);
    this.tellStep(next, before);
  }

  /**
   * A document made elsewhere (files opened) as one step. Whoever makes it from this store's document calls `settle`
   * before, or what is only being tried would be made part of it.
   */
  replace(label: string, change: Document | Change): void {
    this.settle();
    this.step(label, this.stateAfter(this.present, change));
  }

  /** A document of another page: the same as `replace`, or as `amend` where it is no step. */
  adopt(label: string | undefined, { document, selection }: State): void {
    this.settle();
    const next = { document: this.followed(EMPTY_DOCUMENT, withoutNumbers(document)), selection };
    if (label !== undefined) {
      this.step(label, next);
      return;
    }
    this.history.rebase(this.present, next);
    this.become(next);
  }

  /** Ends a gesture that is under way: a drag is committed, what is only being tried is put back. */
  settle(): void {
    if (this.gesture?.unfinished === 'tried') this.gesture.cancel();
    else this.gesture?.commit();
  }

  /** Begins a gesture; one that is under way ends. */
  begin(label: string, unfinished: Unfinished = 'kept'): Gesture {
    this.settle();
    const before = this.present;
    let previewed = before.selection;
    const close = (end: (called?: string) => void) => (called?: string) => {
      if (!isOpen()) return;
      this.gesture = undefined;
      end(called);
    };
    const isOpen = () => this.gesture === gesture;
    const gesture: Gesture & { readonly unfinished: Unfinished } = {
      base: before.document,
      unfinished,
      get closed() {
        return !isOpen();
      },
      preview: (change) => {
        // From what was selected at first: keys that a drag has passed over come back as it goes on.
        const selection = this.selection === previewed ? before.selection : this.selection;
        if (!isOpen()) return;
        const next = this.stateAfter({ document: before.document, selection }, change);
        previewed = next.selection;
        this.become(next);
      },
      commit: close((called = label) => {
        const after = this.present;
        if (after.document === before.document) return;
        this.history.remember(called, before, after);
        this.become(after);
        this.tellStep(after, before);
      }),
      cancel: close(() => this.become(before)),
    };
    this.gesture = gesture;
    return gesture;
  }

  /** Changes the document without a step of its own, for what is fleeting in it: undo goes on from before. */
  amend(change: Document | Change): void {
    const next = this.stateAfter(this.present, change);
    // The middle of a gesture is no place to go back to.
    if (!this.gesture) this.history.rebase(this.present, next);
    this.become(next);
  }

  /** Selecting is no step, but undo brings back what was selected. */
  select(selection: Selection): void {
    this.become({ document: this.document, selection });
  }

  undo(): boolean {
    this.settle();
    const before = this.history.undo(this.present);
    if (before) this.become(before);
    return before !== undefined;
  }

  redo(): boolean {
    this.settle();
    const after = this.history.redo(this.present);
    if (after) this.become(after);
    return after !== undefined;
  }

  /** What a change entails: drivers follow their sources, and parts are numbered. */
  private followed(before: Document, after: Document): Document {
    return withParts(before, followSources(before, after), this.count);
  }

  private stateAfter(before: State, change: Document | Change): State {
    return stateAfter(before, change, this.followed(before.document, documentIn(change)));
  }

  private step(label: string, next: State): void {
    if (next.document !== this.document) this.history.remember(label, this.present, next);
    this.become(next);
  }

  private tellStep(next: State, before: State): void {
    if (next.document === before.document) return;
    for (const listener of this.stepListeners) listener(next, before);
  }

  private become(next: State): void {
    const before = this.present;
    if (next.document === before.document && next.selection === before.selection) {
      // Labels in the menu still follow a committed gesture.
      for (const listener of this.listeners) listener(before, before);
      return;
    }
    this.present = next;
    for (const listener of this.listeners) listener(next, before);
  }
}

function isChange(change: Document | Change): change is Change {
  return 'document' in change;
}

/** The document of a change, whichever form it has. */
export function documentIn(change: Document | Change): Document {
  return isChange(change) ? change.document : change;
}

/** A document with what is selected in it after a change: what the change says, and else what is still there. */
function stateAfter(before: State, change: Document | Change | Edit, document: Document): State {
  const { keys, selected }: Partial<Edit> = isChange(change) ? change : {};
  const kept = selectionKept(before, document, keys);
  const about = selected && document !== before.document ? withJoint(kept, selected) : kept;
  return { document, selection: withoutLostJoint(about, document) };
}

/** The same object where that joint, and no vertex, is selected already. Keys stay where the character is the same. */
function withJoint(selection: Selection, { characterId, joint }: SelectedJoint): Selection {
  const isSame = selection.characterId === characterId && selection.joint === joint;
  if (isSame && selection.vertex === undefined) return selection;
  const keys = selection.characterId === characterId ? selection.keys : undefined;
  return { characterId, ...(joint !== undefined && { joint }), ...(keys && { keys }) };
}

/** Of a joint that is gone its character stays selected. */
function withoutLostJoint(selection: Selection, document: Document): Selection {
  const { characterId, joint } = selection;
  if (characterId === undefined || joint === undefined) return selection;
  const { length = 0 } = findCharacter(document, characterId)?.skeleton?.joints ?? [];
  return joint < length ? selection : { characterId };
}

/** @param keys that a change says are selected */
function selectionKept(
  { document: before, selection }: State,
  document: Document,
  keys: Edit['keys'] | undefined,
): Selection {
  const { characterId } = selection;
  // Nothing stays selected of a character that is gone.
  if (characterId === undefined) return selection;
  if (!findCharacter(document, characterId)) return NOTHING_SELECTED;
  const was = clipOf(before, characterId);
  const now = clipOf(document, characterId);
  const isOther = document !== before && was === now;
  // Where nothing changed, they may be of another character than the one that is selected.
  if (keys && !isOther && hasKeys(now, keys)) return withSelectedKeys(selection, keys);
  if (!selection.keys || was === now) return selection;
  const kept = selection.keys.filter(({ channel }) => hasSameKeys(was?.channels[channel], now?.channels[channel]));
  return kept.length === selection.keys.length ? selection : withSelectedKeys(selection, kept);
}

function hasKeys(clip: ChannelClip | undefined, keys: readonly ChannelKeys[]): boolean {
  return keys.every(({ channel, indices }) => {
    const { length } = keysOf(clip?.channels[channel]).times;
    return indices.every((index) => index < length);
  });
}

/** Keys are known by index: they are the same where the column of times is, or where the channel was read again. */
function hasSameKeys(was: Channel | undefined, now: Channel | undefined): boolean {
  return was !== undefined && now !== undefined && (keysOf(was).times === keysOf(now).times || sameValue(was, now));
}

function clipOf(document: Document, characterId: string): ChannelClip | undefined {
  const character = findCharacter(document, characterId);
  return character && shownClip(character);
}

/** The selection with these keys instead of its own; the same object where they are the same keys. */
export function withSelectedKeys(selection: Selection, keys: readonly ChannelKeys[]): Selection {
  if (sameKeys(selection.keys ?? [], keys)) return selection;
  const { keys: _before, ...rest } = selection;
  return keys.length ? { ...rest, keys } : rest;
}

function sameKeys(a: readonly ChannelKeys[], b: readonly ChannelKeys[]): boolean {
  if (a === b) return true;
  return (
    a.length === b.length &&
    a.every(({ channel, indices }, i) => {
      const other = b[i];
      if (channel !== other.channel || indices.length !== other.indices.length) return false;
      return indices === other.indices || indices.every((index, k) => index === other.indices[k]);
    })
  );
}
