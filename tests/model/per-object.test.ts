import { describe, expect, it, vi } from 'vitest';
import { perObject, perPair } from '../../src/model/per-object.ts';

describe('perObject', () => {
  it('perObject makes the result of an object once, and another one of an equal object', () => {
    const make = vi.fn(({ size }: { size: number }) => [size]);
    const of = perObject(make);
    const skin = { size: 2 };
    expect(of(skin)).toBe(of(skin));
    expect(of({ size: 2 })).not.toBe(of(skin));
    expect(make).toHaveBeenCalledTimes(2);
  });

  it('perObject keeps undefined as a result too', () => {
    const make = vi.fn(() => undefined);
    const of = perObject(make);
    const take = {};
    of(take);
    of(take);
    expect(make).toHaveBeenCalledTimes(1);
  });

  it('gives what it took over instead of making it', () => {
    const of = perObject((): string => {
      throw new Error('not to be made');
    });
    const skin = {};
    of.adopt(skin, 'from the worker');
    expect(of(skin)).toBe('from the worker');
  });

  it('perObject makes nothing for an object whose making failed, and tries again', () => {
    let fails = true;
    const of = perObject(() => {
      if (fails) throw new Error('not yet');
      return 1;
    });
    const skin = {};
    expect(() => of(skin)).toThrow('not yet');
    fails = false;
    expect(of(skin)).toBe(1);
  });
});

describe('perPair', () => {
  it('tells pairs apart by both objects', () => {
    const make = vi.fn((a: { n: number }, b: { n: number }) => 10 * a.n + b.n);
    const of = perPair(make);
    const [one, two] = [{ n: 1 }, { n: 2 }];
    expect([of(one, two), of(two, one), of(one, two)]).toEqual([12, 21, 12]);
    expect(make).toHaveBeenCalledTimes(2);
  });
});
