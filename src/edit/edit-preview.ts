/**
 * A change that is previewed before it is confirmed, behind a dialog with Apply and Cancel. One undo step if kept, none
 * if reverted. If something else changes the document first, it is reverted too, since it was not confirmed, and the
 * preview ends: its result was computed for a document that no longer exists.
 */
import type { Document } from '../model/document.ts';
import type { Change } from './change.ts';
import type { Gesture, Store } from './store.ts';

/** A change that is shown and not yet confirmed. */
export class EditPreview {
  private readonly gesture: Gesture;
  private readonly unsubscribe: () => void;

  /** @param ended called once if something else ended the preview, but not after `keep` or `putBack` */
  constructor(store: Store, label: string, ended: () => void) {
    this.gesture = store.begin(label, 'tried');
    this.unsubscribe = store.subscribe(() => {
      if (!this.gesture.closed) return;
      this.unsubscribe();
      ended();
    });
  }

  /** The document that it is applied to. */
  get base(): Document {
    return this.gesture.base;
  }

  /** Whether it has ended, by itself or by another change. */
  get over(): boolean {
    return this.gesture.closed;
  }

  /** Replaces the previous preview. */
  show(change: Document | Change): void {
    this.gesture.preview(change);
  }

  /**
   * Keeps the preview as one undo step.
   * @param label of the step, if more exact than at the start
   */
  keep(label?: string): void {
    this.unsubscribe();
    this.gesture.commit(label);
  }

  /** Ends it and restores the document; no undo step. */
  putBack(): void {
    this.unsubscribe();
    this.gesture.cancel();
  }
}
