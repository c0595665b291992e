import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { applyDelta, deltaTo } from '../../src/edit/delta.ts';

const numbers = fc.oneof(
  fc.array(fc.constantFrom(0, -0, 1, 2, Number.NaN), { maxLength: 8 }).map((list) => Float64Array.from(list)),
  fc.array(fc.nat(3), { maxLength: 8 }).map((list) => Uint8Array.from(list)),
);
const { plain } = fc.letrec<{ plain: unknown }>((tie) => ({
  plain: fc.oneof(
    { maxDepth: 3 },
    fc.constantFrom(undefined, null, 0, -0, 1, 'a', 'b', true),
    numbers,
    fc.array(tie('plain'), { maxLength: 4 }),
    fc.dictionary(fc.constantFrom('a', 'b', 'c', '__proto__x'), tie('plain'), { noNullPrototype: true }),
  ),
}));

describe('deltaTo and applyDelta', () => {
  it('make any plain value out of any other', () =>
    fc.assert(
      fc.property(plain, plain, (target, from) => {
        expect(applyDelta(from, deltaTo(target, from))).toStrictEqual(target);
      }),
      { numRuns: 2000 },
    ));

  it('find nothing between a value and a copy of it', () =>
    fc.assert(
      fc.property(plain, (value) => {
        expect(deltaTo(structuredClone(value), value)).toBeUndefined();
      }),
    ));

  it('share equal parts with the other value', () => {
    const skin = { positions: new Float64Array(3) };
    const from = { name: 'a', skin, takes: [{ name: 'walk' }, { name: 'run' }] };
    const target = { ...from, name: 'b', takes: [from.takes[0], { name: 'jump' }] };
    const made = applyDelta(from, deltaTo(target, from));
    expect(made).toStrictEqual(target);
    expect((made as typeof from).skin).toBe(skin);
    expect((made as typeof from).takes[0]).toBe(from.takes[0]);
  });

  it('deltaTo and applyDelta keep of a long column only the numbers that are others, however far apart', () => {
    const from = Float64Array.from({ length: 100_000 }, (_, i) => i);
    const target = from.slice();
    for (const i of [0, 500, 502, 99_999]) target[i] = -1;
    expect(deltaTo(target, from)).toEqual({
      kind: 'runs',
      runs: [
        { start: 0, numbers: Float64Array.of(-1) },
        { start: 500, numbers: Float64Array.of(-1, 501, -1) },
        { start: 99_999, numbers: Float64Array.of(-1) },
      ],
    });
  });

  it('deltaTo and applyDelta keep of a column that has grown or shrunk only the stretch that is another', () => {
    const from = Float64Array.from({ length: 100_000 }, (_, i) => i);
    const target = Float64Array.from({ length: 100_001 }, (_, i) => (i < 500 ? i : i === 500 ? -1 : i - 1));
    const delta = deltaTo(target, from);
    expect(delta).toEqual({ kind: 'stretch', head: 500, middle: Float64Array.of(-1), tail: 99_500 });
    expect(deltaTo(from, target)).toEqual({ kind: 'stretch', head: 500, middle: new Float64Array(0), tail: 99_500 });
  });

  it('make any column out of any other of its length', () => {
    const column = fc.array(fc.constantFrom(0, -0, 1, Number.NaN), { minLength: 100, maxLength: 100 });
    fc.assert(
      fc.property(column, column, fc.array(fc.nat(99)), (a, b, same) => {
        const [target, from] = [Float64Array.from(a), Float64Array.from(b)];
        for (const i of same) from[i] = target[i];
        expect(applyDelta(from, deltaTo(target, from))).toStrictEqual(target);
      }),
    );
  });

  it('deltaTo and applyDelta keep of a list that lost an element only that one', () => {
    const list = [{ id: 1 }, { id: 2 }, { id: 3 }];
    const shorter = [list[0], list[2]];
    const delta = deltaTo(list, shorter);
    expect(delta).toEqual({ kind: 'stretch', head: 1, middle: [{ id: 2 }], tail: 1 });
    expect(applyDelta(shorter, delta)).toEqual(list);
  });

  it('store anything but plain data whole', () => {
    const blob = new Date(0);
    expect(deltaTo({ blob }, { blob: new Date(1) })).toEqual({
      kind: 'object',
      changed: [{ key: 'blob', delta: { kind: 'value', value: blob } }],
      gone: [],
    });
  });
});
