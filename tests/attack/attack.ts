/**
 * An attack: what tries to break the program, for as long as it is given. It draws all its chances from one seed, so
 * that a run can be repeated.
 */
export interface Attack {
  /** For `--only`, and the table. */
  readonly name: string;
  /** What holds if it finds nothing. */
  readonly shows: string;
  run(attempt: Attempt): Promise<void>;
}

/** Chances of one seed. */
export interface Chance {
  /** The next number of the seed's sequence, from 0 to 1 (excluding). */
  random(): number;
  /** A whole number from 0 up to `count` (excluding). */
  below(count: number): number;
}

/** One run of an attack. */
export interface Attempt extends Chance {
  readonly seed: number;
  /** What an earlier run kept in tests/repro/, to be done again instead of chance. */
  readonly replay?: string;
  /** Extensions of the files that the readers are given; absent: all. */
  readonly files?: readonly string[];
  /** The readers' inputs are only read, but for one in so many; absent: each is checked as a whole. */
  readonly wholeOneIn?: number;
  /** False: pages' heaps aren't read, which takes seconds and tells nothing of a few tries. */
  readonly readsHeap?: boolean;
  /** Whether there is time for another try. True at least once. */
  goesOn(): boolean;
  /** Counts tries: of inputs, events, kills. */
  tried(count?: number): void;
  /** Something gave way. With the input that did it, it is kept in tests/repro/. */
  gaveWay(what: string, reproducer?: Reproducer): void;
  /** A figure for the table: `heap 31 → 32 MB`. */
  note(figure: string): void;
}

export interface Reproducer {
  /** Of its file; its extension says what it is: `bvh`, `json`. */
  readonly extension: string;
  readonly content: string | Uint8Array;
}

/** Numbers from 0 to 1 (excluding), the same for the same seed: mulberry32. */
export function randomFrom(seed: number): () => number {
  let state = seed | 0;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** The same chances for the same seed. */
export function chanceOf(seed: number): Chance {
  const random = randomFrom(seed);
  return { random, below: (count) => Math.floor(random() * count) };
}
