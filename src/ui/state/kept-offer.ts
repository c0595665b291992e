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
  /** Answered with *Not now*: only the menu tells of it still. */
  readonly isPutOff: boolean;
  /** By whoever was shown it a moment ago: the focus goes there. */
  readonly isAskedFor: boolean;
  restore(id: string): void;
  discard(id: string): void;
  /** Takes the last discarding back. */
  putBack(): void;
  /** Offers that one first. */
  choose(id: string): void;
  /** Not now: it is offered again when it is asked for, and with the next page. */
  later(): void;
  /** Brings what was put off before the person again. */
  again(): void;
}
