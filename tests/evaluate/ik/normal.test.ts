import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { solveDamped, solveThree, systemSize, writeNormal } from '../../../src/evaluate/ik/normal.ts';
import type { JacobianShape } from '../../../src/evaluate/ik/state.ts';
import { expectClose } from '../../helpers/close.ts';

interface System {
  readonly blocks: number;
  readonly n: number;
  /** Rows one after the other. */
  readonly jacobian: Float64Array;
  readonly errors: Float64Array;
  readonly shape: JacobianShape;
  readonly damping: number;
}

const number = fc.double({ min: -2, max: 2, noNaN: true });

/** Blocks of three rows, each moved by some of the unknowns. */
const system: fc.Arbitrary<System> = fc
  .tuple(fc.integer({ min: 1, max: 5 }), fc.integer({ min: 1, max: 20 }))
  .chain(([blocks, n]) =>
    fc.record({
      moves: fc.array(fc.array(fc.boolean(), { minLength: n, maxLength: n }), { minLength: blocks, maxLength: blocks }),
      numbers: fc.array(number, { minLength: 3 * blocks * n, maxLength: 3 * blocks * n }),
      errors: fc.array(number, { minLength: 3 * blocks, maxLength: 3 * blocks }),
      damping: fc.double({ min: 1e-3, max: 10, noNaN: true }),
    }),
  )
  .map(({ moves, numbers, errors, damping }) => {
    const [blocks, n] = [moves.length, moves[0].length];
    const columns = moves.map((does) => does.flatMap((is, v) => (is ? [v] : [])));
    const first = new Int32Array(blocks + 1);
    for (let b = 0; b < blocks; b++) first[b + 1] = first[b] + columns[b].length;
    return {
      blocks,
      n,
      jacobian: Float64Array.from(numbers, (x, i) => (moves[Math.floor(i / n / 3)][i % n] ? x : 0)),
      errors: Float64Array.from(errors),
      shape: {
        first,
        column: Int32Array.from(columns.flat()),
        shared: Int32Array.from(
          columns.flatMap((a) => columns.map((b) => 1 + Math.max(-1, ...a.filter((v) => b.includes(v))))),
        ),
      },
      damping,
    };
  });

function stepOf({ blocks, n, jacobian, errors, shape, damping }: System): Float64Array {
  const rows = 3 * blocks;
  const size = systemSize(rows, n);
  const normal = new Float64Array(size * size).fill(7);
  const step = new Float64Array(n).fill(7);
  writeNormal(jacobian, rows, n, shape, normal);
  const factor = new Float64Array(size * size).fill(7);
  const solution = new Float64Array(size).fill(7);
  expect(solveDamped(jacobian, rows, n, shape, errors, normal, damping, factor, solution, step)).toBe(true);
  return step;
}

/** (JᵀJ + λI)·h + Jᵀe, which is 0 for the step. */
function left({ blocks, n, jacobian, errors, damping }: System, step: Float64Array): number[] {
  const rows = 3 * blocks;
  const at = Array.from({ length: rows }, (_, r) =>
    step.reduce((sum, h, v) => sum + jacobian[r * n + v] * h, errors[r]),
  );
  return Array.from(step, (h, v) => at.reduce((sum, e, r) => sum + jacobian[r * n + v] * e, damping * h));
}

describe('a damped step', () => {
  it('a damped step is what both systems say, with any number of errors and unknowns', () => {
    fc.assert(
      fc.property(system, (any) => {
        const step = stepOf(any);
        expectClose(
          left(any, step),
          Array.from(step, () => 0),
          1e-10,
        );
      }),
      { numRuns: 300 },
    );
  });

  it('a damped step of three errors is the same by the shorter formula', () => {
    fc.assert(
      fc.property(
        system.filter(({ blocks, n }) => blocks === 1 && n >= 3),
        (any) => {
          const step = new Float64Array(any.n);
          expect(solveThree(any.jacobian, any.n, any.errors, any.damping, new Float64Array(3), step)).toBe(true);
          expectClose(step, stepOf(any), 1e-10);
        },
      ),
    );
  });

  it('a damped step is none where numbers have left the range', () => {
    const shape = { first: Int32Array.of(0, 3), column: Int32Array.of(0, 1, 2), shared: Int32Array.of(3) };
    for (const wrong of [Number.NaN, 1e300]) {
      const jacobian = new Float64Array(9).fill(wrong);
      const [normal, factor] = [new Float64Array(9), new Float64Array(9)];
      const [errors, solution, step] = [Float64Array.of(1, 1, 1), new Float64Array(3), new Float64Array(3)];
      writeNormal(jacobian, 3, 3, shape, normal);
      expect(solveDamped(jacobian, 3, 3, shape, errors, normal, 1, factor, solution, step)).toBe(false);
      expect(solveThree(jacobian, 3, errors, 1, solution, step)).toBe(false);
    }
  });
});
