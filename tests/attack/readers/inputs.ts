/** The inputs of a seed: each by its number, whatever came before it. */
import { randomFrom } from '../attack.ts';
import type { Seed } from './corpus.ts';
import { below, mutated, pick } from './mutate.ts';
import { jsonMutated } from './mutate-glb.ts';
import { arrayMutated } from './mutate-npz.ts';
import type { Subject } from './subjects.ts';

export interface Input {
  readonly subject: Subject;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** Seeds above this size are rare, since each of their inputs takes the time of many. */
const SMALL_BYTES = 8000;
const SHARE_OF_LARGE = 1 / 250;

interface SeedsOf {
  readonly subject: Subject;
  readonly small: readonly Seed[];
  readonly large: readonly Seed[];
}

/** All seeds by subject, and those with the same content. */
export class Inputs {
  private readonly bySubject: readonly SeedsOf[];

  constructor(
    seeds: readonly Seed[],
    private readonly seed: number,
  ) {
    const subjects = [...new Set(seeds.map(({ subject }) => subject))];
    this.bySubject = subjects.map((subject) => {
      const own = seeds.filter((each) => each.subject === subject);
      return {
        subject,
        small: own.filter(({ bytes }) => bytes.length <= SMALL_BYTES),
        large: own.filter(({ bytes }) => bytes.length > SMALL_BYTES),
      };
    });
  }

  private randomOf(index: number): () => number {
    return randomFrom(Math.imul(this.seed ^ 0x9e3779b9, 0x85ebca6b) + Math.imul(index, 0x2545f491));
  }

  /** Of the input with that number; cheap. */
  subjectAt(index: number): Subject {
    return pick(this.randomOf(index), this.bySubject).subject;
  }

  /** The same for the same seed and number. */
  at(index: number): Input {
    const random = this.randomOf(index);
    const { small, large } = pick(random, this.bySubject);
    const isLarge = small.length === 0 ? random() < 0.2 : large.length > 0 && random() < SHARE_OF_LARGE;
    // A subject without small files: most of its inputs are the beginnings of large ones.
    const own = small.length === 0 || isLarge ? large : small;
    const seed = own[below(random, own.length)];
    const cut = small.length === 0 && !isLarge ? { ...seed, bytes: seed.bytes.subarray(0, SMALL_BYTES) } : seed;
    const inside: ((...given: Parameters<typeof mutated>) => Uint8Array<ArrayBuffer> | undefined) | undefined =
      cut.subject === 'glb' ? jsonMutated : cut.subject === 'npz' ? arrayMutated : undefined;
    const made = inside && random() < 0.5 ? inside(cut, own, random) : undefined;
    return { subject: cut.subject, bytes: made ?? mutated(cut, own, random) };
  }
}
