/**
 * Undo and redo: documents that replace each other, in labelled steps. Each past document is stored as its difference
 * from the next one (`delta.ts`), each future one as its difference from the previous. Selections are stored whole,
 * since they also change between steps.
 */
import type { Document } from '../model/document.ts';
import type { Selection } from '../model/session.ts';
import { applyDelta, type Delta, deltaTo } from './delta.ts';

/** A document with its selection, as undo restores them. */
export interface State {
  readonly document: Document;
  readonly selection: Selection;
}

/** The difference that a step stores; undefined if both sides are equal. */
export type StoredDelta = Delta | undefined;

/** A step seen from one side. */
interface Step {
  readonly label: string;
  /** Leads to the document on the other side. */
  readonly delta: StoredDelta;
  readonly selection: Selection;
  /** That document itself while something else retains it, to preserve identities and what is cached by them. */
  readonly document: WeakRef<Document>;
  /** The document that `delta` is relative to. */
  readonly against: WeakRef<Document>;
}

/** Steps that can be undone and redone. */
export class History {
  /** The next one to undo last. */
  private past: Step[] = [];
  /** The next one to redo last. */
  private future: Step[] = [];

  /** Label of the step that undo would revert. */
  get undoLabel(): string | undefined {
    return this.past.at(-1)?.label;
  }

  /** Label of the step that redo would repeat; undefined if there is none. */
  get redoLabel(): string | undefined {
    return this.future.at(-1)?.label;
  }

  /** Differences that the steps store, in the order of time. */
  get stored(): { readonly past: readonly StoredDelta[]; readonly future: readonly StoredDelta[] } {
    const deltas = (steps: readonly Step[]) => steps.map(({ delta }) => delta);
    return { past: deltas(this.past), future: deltas(this.future).reverse() };
  }

  /** Records a step; redo steps are dropped. */
  remember(label: string, before: State, after: State): void {
    this.past.push(stepTo(before, after, label));
    this.future = [];
  }

  /** Drops that many of the steps that undo would revert last. */
  forgetOldest(count: number): void {
    this.past.splice(0, count);
  }

  /** The present was replaced without a step: stored differences become relative to the new one. */
  rebase(present: State, next: State): void {
    for (const steps of [this.past, this.future]) {
      const step = steps.pop();
      if (step) steps.push(stepTo(otherSide(step, present), next, step.label));
    }
  }

  /**
   * The state before the last step, which can then be redone; undefined if there is none.
   * @param present the result of the last step or rebase
   */
  undo(present: State): State | undefined {
    return across(present, this.past, this.future);
  }

  /**
   * The state after the next step, which can then be undone; undefined if there is none.
   * @param present the current state
   */
  redo(present: State): State | undefined {
    return across(present, this.future, this.past);
  }
}

/** Takes the last of `from`, and puts the way back into `to`. */
function across(present: State, from: Step[], to: Step[]): State | undefined {
  const step = from.at(-1);
  if (!step) return undefined;
  const other = otherSide(step, present);
  from.pop();
  to.push(stepTo(present, other, step.label));
  return other;
}

function stepTo({ document, selection }: State, { document: against }: State, label: string): Step {
  const delta = deltaTo(document, against);
  return { label, delta, selection, document: new WeakRef(document), against: new WeakRef(against) };
}

function otherSide({ delta, document, against, selection }: Step, present: State): State {
  const same = against.deref() === present.document ? document.deref() : undefined;
  // A delta between two documents makes a document.
  return { document: same ?? (applyDelta(present.document, delta) as Document), selection };
}
