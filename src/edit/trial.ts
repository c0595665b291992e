/**
 * A change that is shown before anyone has decided on it: behind a dialog with Apply and Cancel. One step of undo when
 * kept, no trace when put back. Where something else changes the document first it is put back too, for nobody said yes
 * to it, and the trial is over: what it would do was worked out for a document that is there no more.
 */
import type { Document } from '../model/document.ts';
import type { Edit, Gesture, Store } from './store.ts';

export class Trial {
  private readonly gesture: Gesture;
  private readonly unsubscribe: () => void;

  /** @param ended something else has happened and it is over: called once, not after `keep` or `putBack` */
  constructor(store: Store, label: string, ended: () => void) {
    this.gesture = store.begin(label, 'tried');
    this.unsubscribe = store.subscribe(() => {
      if (!this.gesture.closed) return;
      this.unsubscribe();
      ended();
    });
  }

  /** The document that it is tried on. */
  get base(): Document {
    return this.gesture.base;
  }

  get over(): boolean {
    return this.gesture.closed;
  }

  /** Instead of what was shown before. */
  show(change: Document | Edit): void {
    this.gesture.preview(change);
  }

  /** @param label what the step is called, where it is more exact than at the start */
  keep(label?: string): void {
    this.unsubscribe();
    this.gesture.commit(label);
  }

  putBack(): void {
    this.unsubscribe();
    this.gesture.cancel();
  }
}
