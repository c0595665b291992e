/**
 * Tells how matrices were written from their numbers: a matrix that moves points has 0 0 0 1 as its last row, and a
 * rotation's rows and columns have length 1.
 */
import type { MatrixLayout } from '../compare/targets.ts';

type Order = MatrixLayout['order'];

/**
 * Matrices of joints from printed numbers, and the layout that these have.
 * @param numbers 12 or 16 per joint, as printed
 * @param nesting of JSON: a list of rows, or one list by columns; decides where the numbers don't
 * @param ours column-major, 16 per joint; decides where nothing else does
 */
export function matricesOf(
  numbers: Float64Array,
  joints: number,
  nesting: 'flat' | 'rows' | undefined,
  ours: Float64Array,
): { readonly layout: MatrixLayout; readonly matrices: Float64Array } {
  const each = numbers.length / joints === 12 ? 12 : 16;
  const order = each === 16 ? orderOf16(numbers, nesting, ours) : orderOf12(numbers, ours);
  return { layout: { order, numbers: each }, matrices: inColumns(numbers, joints, { order, numbers: each }) };
}

function orderOf16(numbers: Float64Array, nesting: 'flat' | 'rows' | undefined, ours: Float64Array): Order {
  const isAffine = (a: number, b: number, c: number) => {
    for (let o = 0; o < numbers.length; o += 16) {
      if (!(isZero(numbers[o + a]) && isZero(numbers[o + b]) && isZero(numbers[o + c]))) return false;
    }
    return true;
  };
  const byRows = isAffine(12, 13, 14);
  const byColumns = isAffine(3, 7, 11);
  if (byRows !== byColumns) return byRows ? 'row-major' : 'column-major';
  // Without translations neither is told; JSON has its own convention.
  if (byRows) return nesting === 'flat' ? 'column-major' : 'row-major';
  return nearest(numbers, 16, ours);
}

/** Or not a number, which tells nothing: the other matrices decide. */
function isZero(value: number): boolean {
  return !(Math.abs(value) >= 1e-6);
}

function orderOf12(numbers: Float64Array, ours: Float64Array): Order {
  const columns = rotations(numbers, [0, 3, 6, 1, 4, 7, 2, 5, 8]);
  const rows = rotations(numbers, [0, 1, 2, 4, 5, 6, 8, 9, 10]);
  if (columns !== rows) return rows > columns ? 'row-major' : 'column-major';
  return nearest(numbers, 12, ours);
}

/** How many have rows of length 1 at these places. */
function rotations(numbers: Float64Array, places: readonly number[]): number {
  let count = 0;
  for (let o = 0; o < numbers.length; o += 12) {
    let isOne = true;
    for (let r = 0; r < 9; r += 3) {
      const [x, y, z] = [0, 1, 2].map((k) => numbers[o + places[r + k]]);
      isOne &&= Math.abs(Math.hypot(x, y, z) - 1) < 1e-3;
    }
    if (isOne) count++;
  }
  return count;
}

/** Row-major if both are as near. */
function nearest(numbers: Float64Array, each: 12 | 16, ours: Float64Array): Order {
  const joints = numbers.length / each;
  const distance = (order: Order) => {
    const matrices = inColumns(numbers, joints, { order, numbers: each });
    let sum = 0;
    for (let i = 0; i < matrices.length; i++) {
      const difference = Math.abs(matrices[i] - ours[i]);
      sum += difference < 1e6 ? difference : 1e6;
    }
    return sum;
  };
  return distance('column-major') < distance('row-major') ? 'column-major' : 'row-major';
}

function inColumns(numbers: Float64Array, joints: number, { order, numbers: each }: MatrixLayout): Float64Array {
  const out = new Float64Array(16 * joints);
  const rows = each / 4;
  for (let j = 0; j < joints; j++) {
    for (let c = 0; c < 4; c++) {
      for (let r = 0; r < rows; r++)
        out[16 * j + 4 * c + r] = numbers[each * j + (order === 'row-major' ? 4 * r + c : rows * c + r)];
    }
    if (each === 12) out[16 * j + 15] = 1;
  }
  return out;
}
