/**
 * The only place where the document changes: a store of immutable states, and the history that undoes them.
 *
 * A step is defined by the states on both sides of it rather than by an inverse command, so undo can't be wrong. Only
 * their difference is stored (`history.ts`), so a step costs what it changed. (ProseMirror needs inverses for
 * collaboration; we don't.)
 */

import { dofCountOf } from '../evaluate/pose.ts';
import type { Document } from '../model/document.ts';
import { EMPTY_DOCUMENT, findCharacter, shownTake } from '../model/document.ts';
import type { ChannelKeys, SelectedPart, Selection } from '../model/session.ts';
import { NOTHING_SELECTED } from '../model/session.ts';
import { othersKept, withEachPart } from '../model/skeleton/selected-joints.ts';
import { withCurvesOfGoals } from '../model/takes/layer-code.ts';
import { type Channel, keysOf, type Take } from '../model/takes/take.ts';
import { type Change, documentIn, type Edit, isChange, type SelectedJoint } from './change.ts';
import type { Command } from './command.ts';
import { sameValue } from './delta.ts';
import { followed } from './follow/code.ts';
import { History, type State } from './history.ts';
import { withoutNumbers, withParts } from './parts.ts';

/**
 * A drag: previews replace each other, and together become one step when committed. Any other change of the document
 * ends it first; after that it has no effect.
 */
export interface Gesture {
  /** The document at the start of the gesture; previews are computed from it, so nothing drifts. */
  readonly base: Document;
  /** Committed or cancelled, by itself or by another change. */
  readonly closed: boolean;
  preview(change: Document | Change): void;
  /** @param label of the step, if it is now known better than at the start */
  commit(label?: string): void;
  /** Restores everything. */
  cancel(): void;
}

/**
 * Treatment of a gesture when another change precedes its end. A drag is `kept`, since the user saw its result. What is
 * only `tried`, as behind a dialog with an Apply button, is reverted.
 */
export type Unfinished = 'kept' | 'tried';

interface OpenGesture extends Gesture {
  /** The state at its start. */
  readonly before: State;
  readonly unfinished: Unfinished;
}

type Listener = (now: State, before: State) => void;
/** What a change says of itself. */
type Told = Pick<Change, 'done' | 'locked' | 'switches'>;
/** @param told by the change that made the step */
type StepListener = (now: State, before: State, told: Told) => void;

/** A document with its selection and history. All changes go through it, and listeners hear of each. */
export class Store {
  private present: State;
  private readonly history = new History();
  private gesture: OpenGesture | undefined;
  private readonly listeners = new Set<Listener>();
  private readonly stepListeners = new Set<StepListener>();
  /** For ids and revisions of parts. Not in the document, since undo must not make a number available again. */
  private counted = 0;
  private readonly count = () => ++this.counted;

  constructor(document: Document = EMPTY_DOCUMENT) {
    this.present = { document, selection: NOTHING_SELECTED };
  }

  /** The current document, with what is only previewed. */
  get document(): Document {
    return this.present.document;
  }

  /** The state without what is only tried, which a crash must not make permanent. */
  get confirmed(): State {
    const { gesture } = this;
    return gesture?.unfinished === 'tried' ? gesture.before : this.present;
  }

  /** The current selection. */
  get selection(): Selection {
    return this.present.selection;
  }

  /** Label of the step that `undo` would revert. */
  get undoLabel(): string | undefined {
    return this.history.undoLabel;
  }

  /** Label of the step that `redo` would repeat; undefined if there is none. */
  get redoLabel(): string | undefined {
    return this.history.redoLabel;
  }

  /** Differences that the history stores (`history-budget.ts`). */
  get stored(): History['stored'] {
    return this.history.stored;
  }

  /** Drops that many of the steps that undo would revert last. */
  forgetOldest(count: number): void {
    this.history.forgetOldest(count);
  }

  /**
   * Calls back after each change, with the previous state; compare identities to see what changed. Returns an
   * unsubscribe function.
   */
  subscribe(listener: Listener): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /**
   * Calls back once after each step made in this document by a command or a finished gesture, with the states on both
   * sides. Not for previews, documents from elsewhere, undo or redo.
   */
  onStep(listener: StepListener): () => void {
    this.stepListeners.add(listener);
    return () => this.stepListeners.delete(listener);
  }

  /** Applies a command as one step, or none if it changes nothing, or nothing that steps are about. */
  apply<Args>(command: Command<Args, Document | Change>, args: Args): void {
    this.settle();
    if (command.isNoStep) {
      this.amend(command.run(this.document, args));
      return;
    }
    const before = this.present;
    const change = command.run(before.document, args);
    const next = this.stateAfter(before, change);
    this.step(command.label(before.document, args), next);
    this.tellStep(next, before, toldBy(change));
  }

  /**
   * Replaces the document by one made elsewhere (by opening files), as one step. If that was made from this store's
   * document, call `settle` before, or changes that are only tried would become part of it.
   */
  replace(label: string, change: Document | Change): void {
    this.settle();
    this.step(label, this.stateAfter(this.present, change));
  }

  /** A document made from this store's as `replace` will have it: what is made for its characters beforehand fits them. */
  asReplaced(document: Document): Document {
    return this.followed(this.document, document);
  }

  /** Adopts a document from another page: like `replace`, or like `amend` without a label. */
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

  /** Ends the current gesture: a drag is committed, what is only tried is reverted. */
  settle(): void {
    if (this.gesture?.unfinished === 'tried') this.gesture.cancel();
    else this.gesture?.commit();
  }

  /** Begins a gesture; ends the current one. */
  begin(label: string, unfinished: Unfinished = 'kept'): Gesture {
    this.settle();
    const before = this.present;
    let previewed = before.selection;
    let told: Told = {};
    const close = (end: (called?: string) => void) => (called?: string) => {
      if (!isOpen()) return;
      this.gesture = undefined;
      end(called);
    };
    const isOpen = () => this.gesture === gesture;
    const gesture: OpenGesture = {
      base: before.document,
      before,
      unfinished,
      get closed() {
        return !isOpen();
      },
      preview: (change) => {
        // From the initial selection: keys that a drag has overwritten reappear as it continues.
        const selection = this.selection === previewed ? before.selection : this.selection;
        if (!isOpen()) return;
        const next = this.stateAfter({ document: before.document, selection }, change);
        previewed = next.selection;
        told = toldBy(change);
        this.become(next);
      },
      commit: close((called = label) => {
        const after = this.present;
        if (after.document === before.document) return;
        this.history.remember(called, before, after);
        this.become(after);
        this.tellStep(after, before, told);
      }),
      cancel: close(() => this.become(before)),
    };
    this.gesture = gesture;
    return gesture;
  }

  /**
   * Changes the document without a step of its own, for transient parts of it: undo still reverts the previous step.
   */
  amend(change: Document | Change): void {
    const next = this.stateAfter(this.present, change);
    // Undo never returns to the middle of a gesture.
    if (!this.gesture) this.history.rebase(this.present, next);
    this.become(next);
  }

  /** Selecting is not a step, but undo restores the selection. */
  select(selection: Selection): void {
    this.become({ document: this.document, selection });
  }

  /** Reverts the last step, after ending the current gesture; false if there is none. */
  undo(): boolean {
    this.settle();
    const before = this.history.undo(this.present);
    if (before) this.become(before);
    return before !== undefined;
  }

  /** Repeats the step that was undone last, after ending the current gesture; false if there is none. */
  redo(): boolean {
    this.settle();
    const after = this.history.redo(this.present);
    if (after) this.become(after);
    return after !== undefined;
  }

  /** Consequences of a change: characters follow what they contain of others, and parts are numbered. */
  private followed(before: Document, after: Document): Document {
    return withParts(before, followed(before, after), this.count);
  }

  private stateAfter(before: State, change: Document | Change): State {
    return stateAfter(before, change, this.followed(before.document, documentIn(change)));
  }

  private step(label: string, next: State): void {
    if (next.document !== this.document) this.history.remember(label, this.present, next);
    this.become(next);
  }

  private tellStep(next: State, before: State, told: Told): void {
    if (next.document === before.document) return;
    tellAll(this.stepListeners, next, before, told);
  }

  private become(next: State): void {
    const before = this.present;
    if (next.document === before.document && next.selection === before.selection) {
      // Menu labels must still update after a committed gesture.
      tellAll(this.listeners, before, before);
      return;
    }
    this.present = next;
    tellAll(this.listeners, next, before);
  }
}

/** All listeners are told, even if one throws: what keeps the work must not depend on what shows it. */
function tellAll<A extends readonly unknown[]>(listeners: ReadonlySet<(...args: A) => void>, ...args: A): void {
  let thrown: { readonly error: unknown } | undefined;
  for (const listener of listeners) {
    try {
      listener(...args);
    } catch (error) {
      thrown ??= { error };
    }
  }
  if (thrown) throw thrown.error;
}

function toldBy(change: Document | Change): Told {
  return isChange(change) ? change : {};
}

/** A document with the selection after a change: as specified by the change, otherwise what still exists. */
function stateAfter(before: State, change: Document | Change, document: Document): State {
  const { keys, keysOf, selected }: Partial<Change> = isChange(change) ? change : {};
  const { selection } = before;
  const kept = withEachPart(selection, (part) => {
    const { characterId } = part;
    const isActive = characterId === selection.characterId;
    const own = keysOf ? characterId && keysOf.get(characterId) : isActive ? keys : undefined;
    return partKept(before.document, part, document, own || undefined, keysOf !== undefined);
  });
  const about = selected && document !== before.document ? withJoint(kept, selected) : kept;
  return { document, selection: withEachPart(about, (part) => withoutLostJoints(part, before.document, document)) };
}

/** The same object if that joint, and no vertex, is already selected. Keys stay selected for the same character. */
function withJoint(selection: Selection, { characterId, joint }: SelectedJoint): Selection {
  const isSame = selection.characterId === characterId && selection.joint === joint;
  if (isSame && selection.vertex === undefined) return selection;
  const keys = selection.characterId === characterId ? selection.keys : undefined;
  return { characterId, ...(joint !== undefined && { joint }), ...(keys && { keys }) };
}

/** If the active joint was removed, its character stays selected; others stay while they are the same joints. */
function withoutLostJoints(part: SelectedPart, before: Document, document: Document): SelectedPart {
  const { characterId, joint } = part;
  if (characterId === undefined || joint === undefined) return part;
  const skeleton = findCharacter(document, characterId)?.skeleton;
  if (!skeleton || joint >= skeleton.joints.length) return { characterId };
  const { others, ...alone } = part;
  const was = findCharacter(before, characterId)?.skeleton;
  if (!others) return part;
  const kept = was ? othersKept(others, was, skeleton) : [];
  if (kept === others) return part;
  return kept.length ? { ...alone, others: kept } : alone;
}

/**
 * @param keys of its character that the change selects
 * @param ofSeveral whether the change says so of each character
 */
function partKept(
  before: Document,
  part: SelectedPart,
  document: Document,
  keys: Edit['keys'] | undefined,
  ofSeveral: boolean,
): SelectedPart {
  const { characterId } = part;
  // Nothing of a removed character stays selected.
  if (characterId === undefined) return part;
  if (!findCharacter(document, characterId)) return NOTHING_SELECTED;
  const was = takeOf(before, characterId);
  const now = takeOf(document, characterId);
  const isOther = document !== before && was === now && !ofSeveral;
  // If nothing changed, they may belong to a character other than the selected one.
  if (keys && !isOther && hasKeys(now, keys)) return withSelectedKeys(part, keys);
  if (!part.keys || was === now) return part;
  const kept = part.keys.filter(({ channel }) => hasSameKeys(was?.channels[channel], now?.channels[channel]));
  return kept.length === part.keys.length ? part : withSelectedKeys(part, kept);
}

function hasKeys(take: Take | undefined, keys: readonly ChannelKeys[]): boolean {
  return keys.every(({ channel, indices }) => {
    const { length } = keysOf(take?.channels[channel]).times;
    return indices.every((index) => index < length);
  });
}

/** Keys are identified by index: they are the same if the column of times is, or if an equal channel was read again. */
function hasSameKeys(was: Channel | undefined, now: Channel | undefined): boolean {
  return was !== undefined && now !== undefined && (keysOf(was).times === keysOf(now).times || sameValue(was, now));
}

function takeOf(document: Document, characterId: string): Take | undefined {
  const character = findCharacter(document, characterId);
  const take = character && shownTake(character);
  return take && withCurvesOfGoals(take, dofCountOf(character));
}

/** A part, or a selection, with these keys; the same object if they are equal. */
export function withSelectedKeys(part: SelectedPart, keys: readonly ChannelKeys[]): SelectedPart {
  if (sameKeys(part.keys ?? [], keys)) return part;
  const { keys: _before, ...rest } = part;
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
