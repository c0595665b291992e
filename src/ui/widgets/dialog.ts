/** Content of a dialog; `dialogs.ts` shows it. */
export interface DialogContent {
  readonly title: string;
  readonly body: HTMLElement;
  /** CSS class of the dialog. */
  readonly kind: string;
  /** The title is for screen readers only. */
  readonly bare?: boolean;
  /** A press beside it doesn't close it: what waits for an answer would be lost. */
  readonly stays?: boolean;
}
