/**
 * The one place where the document changes: a store of immutable states, and the history that undoes them.
 *
 * History keeps whole documents rather than inverse steps. Documents share every part that did not change, so an entry
 * costs what its step changed, and going back can't be wrong. (ProseMirror needs inverses for collaboration; we don't.)
 */
import type { Document } from '../model/document.ts';
import { EMPTY_DOCUMENT, findCharacter } from '../model/document.ts';
import type { Selection } from '../model/session.ts';
import { NOTHING_SELECTED } from '../model/session.ts';

/** A change to the document, by name: menu entry, undo entry and scripted call in one. */
export interface Command<Args> {
  /** Stable: `pose.setDof`. */
  readonly id: string;
  /** What the Edit menu says: "Set rx". */
  label(document: Document, args: Args): string;
  /** The document after the change; the very same object where nothing changes. Throws a `CommandError` to refuse. */
  run(document: Document, args: Args): Document;
}

/** A command that can't be done, with a sentence for the person who asked for it. */
export class CommandError extends Error {
  override readonly name = 'CommandError';
}

export interface State {
  readonly document: Document;
  readonly selection: Selection;
}

/** A named step, with what it takes to go back before it. */
interface Step {
  readonly label: string;
  readonly before: State;
}

/** A drag: previews replace each other, and all of them are one step when committed. */
export interface Gesture {
  /** The document as it was when the gesture began: previews are made from it, so nothing drifts. */
  readonly base: Document;
  preview(document: Document): void;
  commit(): void;
  /** Everything as it was before. */
  cancel(): void;
}

type Listener = (now: State, before: State) => void;

export class Store {
  private present: State;
  private undoSteps: readonly Step[] = [];
  private redoSteps: readonly { readonly label: string; readonly after: State }[] = [];
  private gesture: Gesture | undefined;
  private readonly listeners = new Set<Listener>();

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
    return this.undoSteps.at(-1)?.label;
  }

  get redoLabel(): string | undefined {
    return this.redoSteps.at(-1)?.label;
  }

  /** Calls back after each change, with the state before it: identity tells what changed. Returns the way out. */
  subscribe(listener: Listener): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** One step. Nothing happens where the command changes nothing. */
  apply<Args>(command: Command<Args>, args: Args): void {
    this.gesture?.commit();
    const next = command.run(this.document, args);
    this.step(command.label(this.document, args), { document: next, selection: selectionIn(next, this.selection) });
  }

  /** A document made elsewhere (files opened), with the selection that goes with it, as one step. */
  replace(label: string, next: State): void {
    this.gesture?.commit();
    this.step(label, next);
  }

  /** Begins a drag; one that was under way is committed. */
  begin(label: string): Gesture {
    this.gesture?.commit();
    const before = this.present;
    const close = (end: () => void) => () => {
      if (this.gesture !== gesture) return;
      this.gesture = undefined;
      end();
    };
    const gesture: Gesture = {
      base: before.document,
      preview: (document) => {
        if (this.gesture === gesture) this.become({ document, selection: this.selection });
      },
      commit: close(() => {
        const after = this.present;
        if (after.document === before.document) return;
        this.undoSteps = [...this.undoSteps, { label, before }];
        this.redoSteps = [];
        this.become(after);
      }),
      cancel: close(() => this.become(before)),
    };
    this.gesture = gesture;
    return gesture;
  }

  /** Changes the document without a step of its own, for what is fleeting in it: undo goes on from before. */
  amend(document: Document): void {
    this.become({ document, selection: this.selection });
  }

  /** Selecting is no step, but undo brings back what was selected. */
  select(selection: Selection): void {
    this.become({ document: this.document, selection });
  }

  undo(): boolean {
    this.gesture?.commit();
    const step = this.undoSteps.at(-1);
    if (!step) return false;
    this.undoSteps = this.undoSteps.slice(0, -1);
    this.redoSteps = [...this.redoSteps, { label: step.label, after: this.present }];
    this.become(step.before);
    return true;
  }

  redo(): boolean {
    this.gesture?.commit();
    const step = this.redoSteps.at(-1);
    if (!step) return false;
    this.redoSteps = this.redoSteps.slice(0, -1);
    this.undoSteps = [...this.undoSteps, { label: step.label, before: this.present }];
    this.become(step.after);
    return true;
  }

  private step(label: string, next: State): void {
    if (next.document === this.document) return;
    this.undoSteps = [...this.undoSteps, { label, before: this.present }];
    this.redoSteps = [];
    this.become(next);
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

/** Nothing stays selected of a character that is gone. */
function selectionIn(document: Document, selection: Selection): Selection {
  const { characterId } = selection;
  return characterId === undefined || findCharacter(document, characterId) ? selection : NOTHING_SELECTED;
}
