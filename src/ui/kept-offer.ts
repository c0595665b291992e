/** What the page is told of work that an earlier one left behind, and what it can answer. */

/** A session that nobody works in. */
export interface KeptWork {
  readonly id: string;
  /** Milliseconds since 1970. */
  readonly savedAtMs: number;
  readonly characters: readonly { readonly name: string; readonly joints: number; readonly clips: number }[];
}

export interface KeptOffer {
  /** The one that is offered, then the others, newest first. */
  readonly works: readonly KeptWork[];
  /** Discarded a moment ago, and not gone yet. */
  readonly discarded?: KeptWork;
  /** Something else is being worked on meanwhile. */
  readonly isAside: boolean;
  restore(id: string): void;
  discard(id: string): void;
  /** Takes the last discarding back. */
  putBack(): void;
  /** Offers that one first. */
  choose(id: string): void;
  /** Not now: it is offered again with the next page. */
  later(): void;
}
