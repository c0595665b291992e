/**
 * One edit by hand, from press to release: previews through a gesture of the store, one undo step on commit, Escape
 * restores everything. Used by sliders, fields and handles.
 *
 * Something else may change the document meanwhile: undo, a script, a file that was read. A slider's value still means
 * the same, so it continues in a new step. A drag of keys can't: it knows them by index in the old document, and its
 * amounts count from the press. Such an edit ends there, with its result so far as a step.
 */
import type { Change } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import { CommandError } from '../../../edit/command-error.ts';
import type { Gesture, Store } from '../../../edit/store.ts';
import type { Document } from '../../../model/document.ts';
import { cyclesChanged } from '../add-keys.ts';
import type { Messages } from '../messages.ts';
import { attempt } from './attempt.ts';

export class HandEdit {
  private gesture: Gesture | undefined;
  private wasCancelled = false;
  /** Applies the edit again by `add-keys.ts`, which may ask a question first. */
  private anew: (() => void) | undefined;

  /**
   * @param stillHolds for a drag that depends on the document at the press: whether that is still valid. Asked before
   *   the first preview; the drag ends when something else changes the document. Without it the edit continues.
   */
  constructor(
    private readonly store: Store,
    private readonly messages: Messages,
    private readonly stillHolds?: () => boolean,
  ) {}

  /** After Escape, or an end from elsewhere, until release: what the control then shows isn't the document's value. */
  get cancelled(): boolean {
    return this.wasCancelled || (this.stillHolds !== undefined && this.gesture?.closed === true);
  }

  /**
   * Shows the document as the command would change it.
   * @param anew of one that adds keys: applies it by `add-keys.ts`, in place of what is shown, if it changes a cycle
   */
  preview<Args>(command: Command<Args, Document | Change>, args: Args, anew?: () => void): void {
    if (!this.gesture && this.stillHolds?.() === false) this.wasCancelled = true;
    const { cancelled } = this;
    if (this.gesture?.closed) this.end();
    this.wasCancelled = cancelled;
    if (cancelled) return;
    try {
      const gesture = this.gesture ?? this.begin(command.label(this.store.document, args));
      gesture.preview(command.run(gesture.base, args));
      this.anew = anew;
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
      this.messages.note(error.message, 'warning');
    }
  }

  /** The release: one undo step. */
  commit(): void {
    const { gesture, anew } = this;
    this.end();
    this.wasCancelled = false;
    if (gesture && !gesture.closed && anew && cyclesChanged(gesture.base, this.store.document)) {
      gesture.cancel();
      attempt(this.messages, anew);
    } else gesture?.commit();
  }

  cancel(): void {
    this.gesture?.cancel();
    this.end();
  }

  private begin(label: string): Gesture {
    this.gesture = this.store.begin(label);
    window.addEventListener('keydown', this.onKey, true);
    return this.gesture;
  }

  private end(): void {
    this.gesture = undefined;
    this.anew = undefined;
    window.removeEventListener('keydown', this.onKey, true);
  }

  private readonly onKey = (event: KeyboardEvent) => {
    if (event.key !== 'Escape') return;
    event.preventDefault();
    event.stopPropagation();
    this.cancel();
    this.wasCancelled = true;
    // A focused text field is blurred, which is its release.
    const focused = document.activeElement;
    if (focused instanceof HTMLInputElement && focused.type !== 'checkbox') {
      focused.blur();
      this.wasCancelled = false;
    }
  };
}
