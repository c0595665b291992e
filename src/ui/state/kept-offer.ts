/** Sessions left by an earlier page, as offered, and the possible answers. */

/** A session that no page has open. */
export interface KeptWork {
  readonly id: string;
  /** Milliseconds since 1970. */
  readonly savedAtMs: number;
  readonly characters: readonly { readonly name: string; readonly joints: number; readonly takes: number }[];
}

export interface KeptOffer {
  /** The offered one, then the others, newest first. */
  readonly works: readonly KeptWork[];
  /** Just discarded, and still restorable. */
  readonly discarded?: KeptWork;
  /** Something else is being worked on meanwhile. */
  readonly isAside: boolean;
  /** Answered with *Not now*: only listed in the menu. */
  readonly isPutOff: boolean;
  /** Requested from the menu: it gets the focus. */
  readonly isAskedFor: boolean;
  restore(id: string): void;
  discard(id: string): void;
  /** Undoes the last discarding. */
  putBack(): void;
  /** Offers that one first. */
  choose(id: string): void;
  /** Not now: offered again on request, and by the next page. */
  later(): void;
  /** Shows a postponed offer again. */
  again(): void;
}
