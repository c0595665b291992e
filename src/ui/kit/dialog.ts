/** What a dialog is made of; `dialogs.ts` shows it. */
export interface DialogContent {
  readonly title: string;
  readonly body: HTMLElement;
  /** Class of the dialog. */
  readonly kind: string;
  /** The title is for screen readers only. */
  readonly bare?: boolean;
}
