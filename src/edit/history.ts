/**
 * Undo and redo: documents that replace each other, in labelled steps. Each past document is stored as its difference
 * from the next one (`delta.ts`), each future one as its difference from the previous. Selections are stored whole,
 * since they also change between steps.
 */
import type { Document } from '../model/document.ts';
import type { Selection } from '../model/session.ts';
import { applyDelta, type Delta, deltaTo } from './delta.ts';

export interface State {
  readonly document: Document;
  readonly selection: Selection;
}

/** A step seen from one side. */
interface Step {
  readonly label: string;
  /** Leads to the document on the other side. */
  readonly delta: Delta | undefined;
  readonly selection: Selection;
  /** That document itself while something else retains it, to preserve identities and what is cached by them. */
  readonly document: WeakRef<Document>;
  /** The document that `delta` is relative to. */
  readonly against: WeakRef<Document>;
  readonly next: Step | undefined;
}

export class History {
  private past: Step | undefined;
  private future: Step | undefined;

  /** Label of the step that undo would revert. */
  get undoLabel(): string | undefined {
    return this.past?.label;
  }

  get redoLabel(): string | undefined {
    return this.future?.label;
  }

  /** Records a step; redo steps are dropped. */
  remember(label: string, before: State, after: State): void {
    this.past = stepTo(before, after, label, this.past);
    this.future = undefined;
  }

  /** The present was replaced without a step: stored differences become relative to the new one. */
  rebase(present: State, next: State): void {
    const again = (step: Step) => stepTo(otherSide(step, present), next, step.label, step.next);
    this.past = this.past && again(this.past);
    this.future = this.future && again(this.future);
  }

  /** @param present the result of the last step or rebase */
  undo(present: State): State | undefined {
    const step = this.past;
    if (!step) return undefined;
    const before = otherSide(step, present);
    this.past = step.next;
    this.future = stepTo(present, before, step.label, this.future);
    return before;
  }

  redo(present: State): State | undefined {
    const step = this.future;
    if (!step) return undefined;
    const after = otherSide(step, present);
    this.future = step.next;
    this.past = stepTo(present, after, step.label, this.past);
    return after;
  }
}

function stepTo({ document, selection }: State, { document: against }: State, label: string, next?: Step): Step {
  const delta = deltaTo(document, against);
  return { label, delta, selection, document: new WeakRef(document), against: new WeakRef(against), next };
}

function otherSide({ delta, document, against, selection }: Step, present: State): State {
  const same = against.deref() === present.document ? document.deref() : undefined;
  // A delta between two documents makes a document.
  return { document: same ?? (applyDelta(present.document, delta) as Document), selection };
}
