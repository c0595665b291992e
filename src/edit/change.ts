/** The result of a command. */
import type { Document } from '../model/document.ts';
import type { ChannelKeys } from '../model/session.ts';

/** A change with the selection after it. Whatever it does not specify stays selected if it still exists. */
export interface Change {
  readonly document: Document;
  /** Keys that are selected after it, at their new positions; absent: those that were, if they still exist. */
  readonly keys?: readonly ChannelKeys[];
  /** The same of several characters, by id, instead. */
  readonly keysOf?: ReadonlyMap<string, readonly ChannelKeys[]>;
  /** The character, and its joint, that was changed. */
  readonly selected?: SelectedJoint;
  /** Number of locked DOFs that would have been changed, and were left alone; absent for none. */
  readonly locked?: number;
  /** Number of keys that switch limbs, and were left as steps among others; absent for none. */
  readonly switches?: number;
  /** A sentence on what it has done, for what else is said of it; absent where its label says all. */
  readonly done?: string;
}

/** A change of keys, which are selected at their new positions. */
export interface Edit extends Change {
  readonly keys: readonly ChannelKeys[];
}

/** The changed joint, by its index after the change; without `joint`: the character without a selected joint. */
export interface SelectedJoint {
  readonly characterId: string;
  readonly joint?: number;
}

/** Whether a command's result states a selection, rather than being a document alone. */
export function isChange(change: Document | Change): change is Change {
  return 'document' in change;
}

/** The document of a change in either form. */
export function documentIn(change: Document | Change): Document {
  return isChange(change) ? change.document : change;
}
