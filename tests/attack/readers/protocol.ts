/** What the attack on the readers and its thread tell each other. */
import type { Fault } from './check.ts';
import type { Seed } from './corpus.ts';
import type { Input } from './inputs.ts';

export interface Orders {
  readonly corpus: readonly Seed[];
  readonly seed: number;
  /** The first input. */
  readonly from: number;
  /** Of 2 numbers: the input that is read, and the state of the thread. */
  readonly at: SharedArrayBuffer;
}

/** Of the thread, in `at[1]`: while it makes an input smaller, it may take longer. */
export const READS = 0;
export const SHRINKS = 1;

/** An input that gave way, made smaller. */
export interface Found {
  readonly index: number;
  readonly fault: Fault;
  readonly input: Input;
}
