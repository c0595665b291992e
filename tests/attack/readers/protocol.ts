/** What the attack on the readers and its thread tell each other. */
import type { Fault } from './check.ts';
import type { Seed } from './corpus.ts';
import type { Input } from './inputs.ts';

export interface Orders {
  readonly corpus: readonly Seed[];
  readonly seed: number;
  /** The first input. */
  readonly from: number;
  /** One of so many inputs is checked as a whole; the others are only read. */
  readonly wholeOneIn: number;
  /** One number: the input that is read. */
  readonly at: SharedArrayBuffer;
}

/** An input that gave way, made smaller. */
export interface Found {
  readonly index: number;
  readonly fault: Fault;
  readonly input: Input;
}
