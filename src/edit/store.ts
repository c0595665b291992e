/**
 * The one place where the document changes: a store of immutable states, and the history that undoes them.
 *
 * A step is known by the states on both sides of it rather than by an inverse command: going back can't be wrong. What
 * is kept of them is their difference (`history.ts`), so a step costs what it changed. (ProseMirror needs inverses for
 * collaboration; we don't.)
 */
import { type ChannelClip, keysOf } from '../model/clip.ts';
import type { Document } from '../model/document.ts';
import { EMPTY_DOCUMENT, findCharacter, shownClip } from '../model/document.ts';
import type { ChannelKeys, Selection } from '../model/session.ts';
import { NOTHING_SELECTED } from '../model/session.ts';
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

/** A change that also says which keys are selected after it: those it was about, wherever they are now. */
export interface Edit {
  readonly document: Document;
  readonly keys: readonly ChannelKeys[];
  /** The character, and the joint of it, that are selected after it; absent: those that were. */
  readonly selected?: SelectedJoint;
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
   * A document made elsewhere (files opened), with the selection that goes with it, as one step. Whoever makes it from
   * this store's document calls `settle` before, or what is only being tried would be made part of it.
   */
  replace(label: string, next: State): void {
    this.settle();
    const document = this.followed(this.document, next.document);
    this.step(label, document === next.document ? next : { ...next, document });
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
  amend(document: Document): void {
    const next = this.stateAfter(this.present, document);
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

  private stateAfter(before: State, change: Document | Edit): State {
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

function isEdit(change: Document | Edit): change is Edit {
  return 'document' in change;
}

/** The document of a change, whichever form it has. */
export function documentIn(change: Document | Edit): Document {
  return isEdit(change) ? change.document : change;
}

/** A document with what is selected in it after a change: what the change says, and else what is still there. */
function stateAfter(before: State, change: Document | Edit, document: Document): State {
  const kept = stateKept(before, change, document);
  const selected = isEdit(change) ? change.selected : undefined;
  if (!selected || kept.document === before.document) return kept;
  return { document: kept.document, selection: withJoint(kept.selection, selected) };
}

/** The same object where that joint, and no vertex, is selected already. Keys stay where the character is the same. */
function withJoint(selection: Selection, { characterId, joint }: SelectedJoint): Selection {
  const isSame = selection.characterId === characterId && selection.joint === joint;
  if (isSame && selection.vertex === undefined) return selection;
  const keys = selection.characterId === characterId ? selection.keys : undefined;
  return { characterId, ...(joint !== undefined && { joint }), ...(keys && { keys }) };
}

/** A document with what is still selected in it. */
function stateKept({ document: before, selection }: State, change: Document | Edit, document: Document): State {
  const edit = isEdit(change) ? change : undefined;
  const { characterId } = selection;
  // Nothing stays selected of a character that is gone.
  if (characterId === undefined) return { document, selection };
  const character = findCharacter(document, characterId);
  if (!character) return { document, selection: NOTHING_SELECTED };
  const isOther = document !== before && clipOf(before, characterId) === clipOf(document, characterId);
  if (edit && !isOther) return { document, selection: withKeys(selection, edit.keys) };
  if (!selection.keys || document === before) return { document, selection };
  // Keys are known by index: they stay selected where their channel's column of times stays.
  const was = clipOf(before, characterId)?.channels;
  const now = clipOf(document, characterId)?.channels;
  const kept = selection.keys.filter(
    ({ channel }) => was?.[channel] && keysOf(was[channel]).times === keysOf(now?.[channel]).times,
  );
  return { document, selection: kept.length === selection.keys.length ? selection : withKeys(selection, kept) };
}

function clipOf(document: Document, characterId: string): ChannelClip | undefined {
  const character = findCharacter(document, characterId);
  return character && shownClip(character);
}

/** The selection with these keys instead of its own; the same object where they are the same keys. */
export function withKeys(selection: Selection, keys: readonly ChannelKeys[]): Selection {
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
