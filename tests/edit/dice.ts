/**
 * Choices that fast-check makes but a test has to interpret: which key, of a document that is only there when its turn
 * comes. Numbers from 0 up to 1, thrown beforehand, so that a failure can be repeated.
 */
import fc from 'fast-check';

export class Dice {
  private next = 0;

  constructor(private readonly numbers: readonly number[]) {}

  /** From 0 up to, not including, 1. */
  number(): number {
    return this.numbers[this.next++ % this.numbers.length];
  }

  /** From 0 up to, not including, `count`. */
  below(count: number): number {
    return Math.floor(this.number() * count);
  }

  /** Throws for an empty list. */
  pick<T>(list: readonly T[]): T {
    if (list.length === 0) throw new Error('There is nothing to pick from.');
    return list[this.below(list.length)];
  }

  some<T>(list: readonly T[], share = this.number()): T[] {
    return list.filter(() => this.number() < share);
  }

  is(share: number): boolean {
    return this.number() < share;
  }
}

/** From 0 up to 1, each part as likely as the next. (`fc.double` goes by bits: half of its numbers are below 1e-150.) */
export const evenly = fc.noBias(fc.integer({ min: 0, max: 2 ** 30 - 1 })).map((n) => n / 2 ** 30);

/**
 * Enough numbers for one step of a test; they come round again. A `Dice` is made of them anew in every run. They are
 * not made smaller: a failure is found by leaving steps out, and smaller numbers would be other choices.
 */
export const thrown = fc.noShrink(fc.array(evenly, { minLength: 23, maxLength: 23 }));
