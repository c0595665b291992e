/**
 * One change by hand, from the first touch to the release: previews through a gesture of the store, one undo step at
 * the end, Escape puts everything back. Sliders, fields and handles all edit through this.
 */
import { type Command, CommandError, documentIn, type Edit, type Gesture, type Store } from '../edit/store.ts';
import type { Document } from '../model/document.ts';
import type { Messages } from './messages.ts';

export class HandEdit {
  private gesture: Gesture | undefined;
  private wasCancelled = false;

  constructor(
    private readonly store: Store,
    private readonly messages: Messages,
  ) {}

  /** After Escape, until the mouse is let go: whatever the control shows meanwhile is not so. */
  get cancelled(): boolean {
    return this.wasCancelled;
  }

  /** Shows the document as the command would leave it. */
  preview<Args>(command: Command<Args, Document | Edit>, args: Args): void {
    if (this.wasCancelled) return;
    try {
      const gesture = this.gesture ?? this.begin(command.label(this.store.document, args));
      const next = command.run(gesture.base, args);
      gesture.preview(next);
      if (this.store.document === documentIn(next)) return;
      // Something else has ended the gesture meanwhile: this goes on as a new one.
      this.end();
      const again = this.begin(command.label(this.store.document, args));
      again.preview(command.run(again.base, args));
    } catch (error) {
      if (!(error instanceof CommandError)) throw error;
      this.messages.note(error.message, 'warning');
    }
  }

  /** The release: one undo step. */
  commit(): void {
    this.gesture?.commit();
    this.end();
    this.wasCancelled = false;
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
    window.removeEventListener('keydown', this.onKey, true);
  }

  private readonly onKey = (event: KeyboardEvent) => {
    if (event.key !== 'Escape') return;
    event.preventDefault();
    event.stopPropagation();
    this.cancel();
    this.wasCancelled = true;
    // A field that was typed in lets go, which is its release.
    const focused = document.activeElement;
    if (focused instanceof HTMLInputElement && focused.type !== 'checkbox') {
      focused.blur();
      this.wasCancelled = false;
    }
  };
}
