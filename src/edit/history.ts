/**
 * The way back and the way forth: documents that replace each other step by step, and steps known by name. Each past
 * document is kept as its difference to the one after it (`delta.ts`), each future one as its difference to the one
 * before; what was selected is kept as it was, for it changes between steps too.
 */
import type { Document } from '../model/document.ts';
import type { Selection } from '../model/session.ts';
import { applyDelta, type Delta, deltaTo } from './delta.ts';

export interface State {
  readonly document: Document;
  readonly selection: Selection;
}

/** A step as seen from one side. */
interface Step {
  readonly label: string;
  /** What leads to the document on the other side. */
  readonly delta: Delta | undefined;
  readonly selection: Selection;
  /** That document itself, as long as someone else keeps it: then nothing that looks at identity does work anew. */
  readonly document: WeakRef<Document>;
  /** What `delta` is the difference to. */
  readonly against: WeakRef<Document>;
  readonly next: Step | undefined;
}

export class History {
  private past: Step | undefined;
  private future: Step | undefined;

  /** Name of the step that going back takes back. */
  get undoLabel(): string | undefined {
    return this.past?.label;
  }

  get redoLabel(): string | undefined {
    return this.future?.label;
  }

  /** A step was taken; what could be redone is gone. */
  remember(label: string, before: State, after: State): void {
    this.past = stepTo(before, after, label, this.past);
    this.future = undefined;
  }

  /** The present was replaced without a step: what is kept against it is kept against the new one from now on. */
  rebase(present: State, next: State): void {
    const again = (step: Step) => stepTo(otherSide(step, present), next, step.label, step.next);
    this.past = this.past && again(this.past);
    this.future = this.future && again(this.future);
  }

  /** @param present what the last step, or the last rebase, led to */
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
  // A delta between two documents makes one.
  return { document: same ?? (applyDelta(present.document, delta) as Document), selection };
}
