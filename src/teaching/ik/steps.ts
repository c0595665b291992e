/**
 * Steps of solvers of inverse kinematics, each with one number that programs choose:
 *
 *     transpose        Δφ = α·Jᵀe
 *     damped           Δφ = Jᵀ(JJᵀ + λI)⁻¹e
 *     pseudo-inverse   Δφ = α·J⁺e                      0 < α ≤ 1
 */
import { add, cross, dot, scaled, type Vec3 } from '../../math/vec3.ts';
import type { SeenPoint } from './jacobian.ts';

/** Steps of a kind: the number is relative to what is usual here. */
export interface StepKind {
  step(relative: number): readonly number[];
  /** The largest number. */
  readonly most: number;
  /** Whether it is right only if it brings the point nearer: the others are what their formula says. */
  readonly mustGain: boolean;
}

/** Fraction of JJᵀ's mean: a pseudo-inverse, where some directions can't be moved in. */
const MIN_DAMPING = 1e-6;
/** Damping so small that even angles 57 times as large don't show it. */
const EXACT = 1e-12;
const MOST = 1e3;

/** All that are right for the point. @param columns of J that steps are of; all by default */
export function rightKinds(seen: SeenPoint, columns: readonly Vec3[] = seen.columns): readonly StepKind[] {
  const { error } = seen;
  const rows = rowsOf(seen.columns);
  const mean = (rows[0][0] + rows[1][1] + rows[2][2]) / 3;
  if (!(mean > 0)) return [];
  const damped = (relative: number) => along(columns, solved(rows, relative * mean, error));
  const inverse = damped(MIN_DAMPING);
  return [
    kindAlong(along(columns, error), bestLength(seen)),
    { step: damped, most: MOST, mustGain: false },
    { step: (relative) => inverse.map((part) => relative * part), most: 1, mustGain: false },
  ];
}

/** Δφ = α·Jᵀe, the number relative to the best α. */
export function transposeKind(seen: SeenPoint): StepKind {
  return kindAlong(transposed(seen), bestLength(seen));
}

/** Δφ = α·g for any direction g. @param unit the α that 1 stands for */
export function kindAlong(direction: readonly number[], unit: number): StepKind {
  return { step: (relative) => direction.map((part) => relative * unit * part), most: MOST, mustGain: true };
}

/** Steps without a number: Jᵀe, α·Jᵀe with the best α, and J⁺e. */
export function wholeSteps(seen: SeenPoint): readonly (readonly number[])[] {
  const { columns, error } = seen;
  const rows = rowsOf(columns);
  const step = transposed(seen);
  const best = bestLength(seen);
  const inverse = along(columns, solved(rows, EXACT * (rows[0][0] + rows[1][1] + rows[2][2]), error));
  return [step, step.map((part) => best * part), inverse];
}

/** Jᵀe. */
export function transposed({ columns, error }: SeenPoint): readonly number[] {
  return along(columns, error);
}

/** The α that brings α·Jᵀe nearest to the target, to first order: e·JJᵀe / |JJᵀe|². */
export function bestLength({ columns, error }: SeenPoint): number {
  const [x, y, z] = rowsOf(columns);
  const moved: Vec3 = [dot(x, error), dot(y, error), dot(z, error)];
  const square = dot(moved, moved);
  return square > 0 ? dot(error, moved) / square : 0;
}

/** Steps of who reads J's numbers in the other order, with what was done. */
export function misread({
  columns,
  error,
}: SeenPoint): readonly (readonly [what: string, direction: readonly number[]])[] {
  // Programs have all joints in J, or only those that move the point.
  const moving = [...columns.keys()].filter((v) => columns[v].some((part) => part !== 0));
  return [[...columns.keys()], moving].flatMap((those) => {
    const n = those.length;
    const byRows = [0, 1, 2].flatMap((k) => those.map((v) => columns[v][k]));
    const byColumns = those.flatMap((v) => columns[v]);
    const spread = (of: (i: number) => Vec3) => {
      const out = columns.map(() => 0);
      those.forEach((v, i) => {
        out[v] = dot(of(i), error);
      });
      return out;
    };
    return [
      ['stored by rows, read by columns', spread((i) => [byRows[3 * i], byRows[3 * i + 1], byRows[3 * i + 2]])],
      ['stored by columns, read by rows', spread((i) => [byColumns[i], byColumns[n + i], byColumns[2 * n + i]])],
    ] as const;
  });
}

function along(columns: readonly Vec3[], by: Vec3): readonly number[] {
  return columns.map((column) => dot(column, by));
}

/** The rows of JJᵀ. */
function rowsOf(columns: readonly Vec3[]): readonly [Vec3, Vec3, Vec3] {
  let [x, y, z]: [Vec3, Vec3, Vec3] = [
    [0, 0, 0],
    [0, 0, 0],
    [0, 0, 0],
  ];
  for (const column of columns) {
    x = add(x, column, column[0]);
    y = add(y, column, column[1]);
    z = add(z, column, column[2]);
  }
  return [x, y, z];
}

/** (JJᵀ + λI)⁻¹e by Cramer's rule. */
function solved([x, y, z]: readonly [Vec3, Vec3, Vec3], damping: number, error: Vec3): Vec3 {
  const a = add(x, [damping, 0, 0]);
  const b = add(y, [0, damping, 0]);
  const c = add(z, [0, 0, damping]);
  const over = 1 / dot(a, cross(b, c));
  // The matrix is symmetric, so its rows are its columns.
  return scaled([dot(error, cross(b, c)), dot(a, cross(error, c)), dot(a, cross(b, error))], over);
}
