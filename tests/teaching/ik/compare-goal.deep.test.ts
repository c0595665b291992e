/** Numbers of a student's solver of inverse kinematics, right and with mistakes. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { add, dot, subtract, type Vec3, ZERO } from '../../../src/math/vec3.ts';
import { compareGoal } from '../../../src/teaching/ik/compare-goal.ts';
import { characterFrom } from '../lesson-files.ts';
import {
  ARMS,
  ARMS_TEXT,
  HAND,
  jacobian,
  OTHER_HAND,
  positionsOf,
  reached,
  START,
  stepped,
  tipOf,
  transposeStep,
  worldOf,
} from './student-arm.ts';

const ARM = characterFrom('arms.axskel', ARMS_TEXT);
const TARGET: Vec3 = [0.4, 1.6, 1.1];
const TOLERANCE = 1e-4;
const KINDS = ['world', 'positions'] as const;

function compared(
  angles: readonly number[],
  { isOneStep = false, kind = 'world', joint = HAND, target = TARGET }: Asked = {},
) {
  if (!ARM.skeleton) throw new Error('The arms have no skeleton.');
  const numbers = kind === 'world' ? { world: worldOf(angles) } : { positions: positionsOf(angles) };
  const goal = { joint, point: [0, ARMS[joint][0], 0] as const, target };
  const frame = { time: undefined, ...numbers };
  return compareGoal(ARM, ARM.skeleton, frame, goal, isOneStep, TOLERANCE);
}

interface Asked {
  readonly isOneStep?: boolean;
  readonly kind?: (typeof KINDS)[number];
  readonly joint?: number;
  readonly target?: Vec3;
}

const codesOf = (found: ReturnType<typeof compared>) => found.causes.map(({ code }) => code);
const STEP = transposeStep(START, HAND, TARGET);
/** By the best length, to first order. */
const BEST = (() => {
  const columns = jacobian(START, HAND, tipOf(START, HAND));
  const moved = columns.reduce((sum, column, j) => add(sum, column, STEP[j]), ZERO);
  return STEP.reduce((sum, part) => sum + part * part, 0) / dot(moved, moved);
})();

describe('a solver of inverse kinematics', () => {
  it.each(KINDS)('is right with any pose that reaches the target: %s', (kind) => {
    const angles = reached(HAND, TARGET);
    expect(compared(angles, { kind })).toMatchObject({ agrees: true, causes: [] });
    // The other arm may be anywhere.
    expect(compared(stepped(angles, [0, 0, 0, 0, 0.3, -0.4]), { kind })).toMatchObject({ agrees: true, causes: [] });
  });

  it('is right with the nearest pose to a target out of reach, and only with that', () => {
    const far: Vec3 = [0, 9, 0.5];
    const angles = reached(HAND, far);
    expect(compared(angles, { target: far })).toMatchObject({ agrees: true, causes: [] });
    expect(compared(stepped(angles, [0, 0.2, 0, 0, 0, 0]), { target: far })).toMatchObject({
      agrees: false,
      causes: [],
    });
  });

  it('is told where the numbers are no pose of the skeleton', () => {
    const world = worldOf(START);
    world[16 * 2 + 12] += 0.2;
    if (!ARM.skeleton) throw new Error('The arms have no skeleton.');
    const goal = { joint: HAND, point: [0, ARMS[HAND][0], 0] as const, target: TARGET };
    const found = compareGoal(ARM, ARM.skeleton, { time: undefined, world }, goal, false, TOLERANCE);
    expect(found).toMatchObject({ agrees: false, isPose: false, causes: [] });
  });

  it.each([
    ['the other hand', OTHER_HAND, 'the tip of joint 5'],
    ['the bone before', HAND - 1, 'the tip of joint 2'],
  ])('is told that it moves the wrong end effector: %s', (_, joint, detail) => {
    const found = compared(reached(joint, TARGET));
    expect(found).toMatchObject({ agrees: false, causes: [{ code: 'ik-end-effector', detail, explains: 6, of: 6 }] });
    expect(found.causes[0].sentences[0]).toMatch(/^You bring .* to the target; it should be the tip of joint 3\.$/);
  });

  it('is told so by joint positions where these tell', () => {
    const found = compared(reached(HAND - 1, TARGET), { kind: 'positions' });
    expect(found).toMatchObject({
      agrees: false,
      causes: [{ code: 'ik-end-effector', detail: 'the origin of joint 3' }],
    });
    expect(compared(reached(OTHER_HAND, TARGET), { kind: 'positions' })).toMatchObject({ agrees: false, causes: [] });
  });

  it.each([1, 2, 5])('is told that it adds Jᵀe unscaled, after %i steps', (count) => {
    let angles = START;
    for (let i = 0; i < count; i++) angles = stepped(angles, transposeStep(angles, HAND, TARGET));
    const found = compared(angles);
    expect(found).toMatchObject({ agrees: false, causes: [{ code: 'ik-step-unscaled' }] });
    expect(found.causes[0].detail).toContain('α = 1');
  });
});

describe('one step of a solver of inverse kinematics', () => {
  it.each(KINDS)('is right with Jᵀe of any length that brings the point nearer: %s', (kind) => {
    for (const by of [0.1, 0.5, 1]) {
      expect(compared(stepped(START, STEP, by * BEST), { isOneStep: true, kind })).toMatchObject({
        agrees: true,
        causes: [],
      });
    }
  });

  it.each(KINDS)('is right with damped least squares and the pseudo-inverse: %s', (kind) => {
    const tip = tipOf(START, HAND);
    const columns = jacobian(START, HAND, tip);
    for (const damping of [1e-9, 0.01, 0.3, 5]) {
      const rows = [0, 1, 2].map((r) =>
        [0, 1, 2].map((c) => columns.reduce((sum, column) => sum + column[r] * column[c], r === c ? damping : 0)),
      );
      const y = gauss(rows, subtract(TARGET, tip));
      const step = columns.map((column) => dot(column, y));
      for (const by of damping < 1e-6 ? [1, 0.2] : [1]) {
        expect(compared(stepped(START, step, by), { isOneStep: true, kind }), `${damping}`).toMatchObject({
          agrees: true,
        });
      }
    }
  });

  it.each(KINDS)('is told that Jᵀe is unscaled: %s', (kind) => {
    const found = compared(stepped(START, STEP), { isOneStep: true, kind });
    expect(found).toMatchObject({ agrees: false, causes: [{ code: 'ik-step-unscaled', detail: 'α = 1' }] });
    const long = compared(stepped(START, STEP, 1.3), { isOneStep: true, kind });
    expect(long).toMatchObject({ agrees: false, causes: [{ code: 'ik-step-unscaled', detail: 'α = 1.3' }] });
  });

  it.each(KINDS)('is told that it is added in degrees: %s', (kind) => {
    const tip = tipOf(START, HAND);
    const columns = jacobian(START, HAND, tip);
    const degrees = 180 / Math.PI;
    const damped = (damping: number) => {
      const rows = [0, 1, 2].map((r) =>
        [0, 1, 2].map((c) => columns.reduce((sum, column) => sum + column[r] * column[c], r === c ? damping : 0)),
      );
      const y = gauss(rows, subtract(TARGET, tip));
      return columns.map((column) => dot(column, y));
    };
    for (const step of [STEP, STEP.map((part) => BEST * part), damped(1e-9)]) {
      const found = compared(stepped(START, step, degrees), { isOneStep: true, kind });
      expect(found).toMatchObject({ agrees: false, causes: [{ code: 'ik-step-degrees' }] });
    }
    const twice = stepped(START, STEP, BEST * degrees);
    const again = transposeStep(twice, HAND, TARGET);
    const moved = jacobian(twice, HAND, tipOf(twice, HAND)).reduce(
      (sum, column, j) => add(sum, column, again[j]),
      ZERO,
    );
    const best = again.reduce((sum, part) => sum + part * part, 0) / dot(moved, moved);
    expect(compared(stepped(twice, again, best * degrees), { kind })).toMatchObject({
      agrees: false,
      causes: [{ code: 'ik-step-degrees', detail: '2 steps' }],
    });
  });

  it.each(KINDS)('is told that J is read in the wrong order: %s', (kind) => {
    const tip = tipOf(START, HAND);
    const error = subtract(TARGET, tip);
    const all = jacobian(START, HAND, tip);
    for (const columns of [all, all.slice(0, HAND + 1)]) {
      const n = columns.length;
      const byRows = [0, 1, 2].flatMap((k) => columns.map((column) => column[k]));
      const byColumns = columns.flat();
      for (const [detail, read] of [
        ['stored by rows, read by columns', (i: number, k: number) => byRows[3 * i + k]],
        ['stored by columns, read by rows', (i: number, k: number) => byColumns[k * n + i]],
      ] as const) {
        const step = all.map((_, i) => (i < n ? error.reduce((sum, e, k) => sum + read(i, k) * e, 0) : 0));
        const found = compared(stepped(START, step, 0.1), { isOneStep: true, kind });
        expect(found).toMatchObject({ agrees: false, causes: [{ code: 'ik-jacobian-transposed', detail }] });
      }
    }
  });

  it.each([
    [OTHER_HAND, 'the tip of joint 5'],
    [HAND - 1, 'the tip of joint 2'],
  ])('is told that it is for the wrong end effector: %i', (joint, detail) => {
    const found = compared(stepped(START, transposeStep(START, joint, TARGET), 0.05), { isOneStep: true });
    expect(found).toMatchObject({ agrees: false, causes: [{ code: 'ik-end-effector', detail }] });
  });
});

describe('any target', () => {
  it('is judged alike: right steps agree, those of the other hand and of J misread are never another mistake', () => {
    const part = fc.integer({ min: -30, max: 30 }).map((tenths) => tenths / 10);
    fc.assert(
      fc.property(part, part, part, (...target) => {
        const asked = { isOneStep: true, target };
        const step = transposeStep(START, HAND, target);
        expect(compared(stepped(START, step, 0.01), asked)).toMatchObject({ agrees: true });
        const other = compared(stepped(START, transposeStep(START, OTHER_HAND, target), 0.02), asked);
        expect(other.agrees).toBe(false);
        // None: of a step too small to tell.
        expect(['', 'ik-end-effector']).toContain(codesOf(other).join());
        const tip = tipOf(START, HAND);
        const error = subtract(target, tip);
        const byColumns = jacobian(START, HAND, tip).flat();
        const misread = START.map((_, i) => error.reduce((sum, e, k) => sum + byColumns[k * 6 + i] * e, 0));
        const transposed = compared(stepped(START, misread, 0.02), asked);
        expect(['', 'ik-jacobian-transposed']).toContain(codesOf(transposed).join());
      }),
      { numRuns: 30 },
    );
  });
});

describe('what no mistake explains', () => {
  it('gets no cause: any other pose, after one step or many', () => {
    const angle = fc.integer({ min: -100, max: 100 }).map((hundredths) => hundredths / 100);
    fc.assert(
      fc.property(fc.array(angle, { minLength: 6, maxLength: 6 }), fc.boolean(), (step, isOneStep) => {
        fc.pre(step.filter((part) => part !== 0).length > 3);
        expect(codesOf(compared(stepped(START, step), { isOneStep }))).toEqual([]);
      }),
      { numRuns: 20 },
    );
  });

  it('is a pose that did not move, and a step away from the target', () => {
    for (const isOneStep of [false, true]) {
      expect(compared(START, { isOneStep })).toMatchObject({ agrees: false, causes: [] });
      expect(compared(stepped(START, STEP, -0.1), { isOneStep })).toMatchObject({ agrees: false, causes: [] });
    }
  });
});

/** Solves a small system. */
function gauss(rows: readonly (readonly number[])[], right: readonly number[]): Vec3 {
  const det = (m: readonly (readonly number[])[]) =>
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
    m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
    m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  const [x, y, z] = [0, 1, 2].map(
    (k) => det(rows.map((row, r) => row.map((value, c) => (c === k ? right[r] : value)))) / det(rows),
  );
  return [x, y, z];
}
