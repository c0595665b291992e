/**
 * Compares a dump with another one number by number, for numbers of no open character: lists against
 * lists, in their order. Matrices may be in either layout; what the numbers mean is not needed.
 */
import type { Dump, DumpBlock } from '../../model/dump.ts';
import { matricesOf } from '../dump/matrix-layout.ts';
import { diagonalOf, larger } from './errors.ts';

/** How far the numbers of two dumps agree. */
export interface DumpComparison {
  readonly agrees: boolean;
  /** How many numbers were compared. */
  readonly numbers: number;
  /** Lengths over the size of what is compared, other numbers as they are. */
  readonly worst: number;
  /** The first wrong number: `line 7 has 0.5, expected 0.25`; absent if all agree. */
  readonly first?: string;
}

/**
 * Compares a dump with the right one, block by block.
 * @param tolerance of lengths over the size of what is compared, of other numbers as they are; greater than 0
 */
export function compareDumps(theirs: Dump, right: Dump, tolerance: number): DumpComparison {
  let worst = 0;
  let numbers = 0;
  if (theirs.blocks.length !== right.blocks.length) {
    const first = `${listed(theirs.blocks.length)}, expected ${right.blocks.length}`;
    return { agrees: false, numbers, worst: Number.POSITIVE_INFINITY, first };
  }
  let first: string | undefined;
  right.blocks.forEach((block, b) => {
    const found = compareBlocks(theirs.blocks[b], block, tolerance);
    worst = larger(worst, found.worst);
    numbers += found.numbers;
    first ??= found.first;
  });
  return { agrees: first === undefined, numbers, worst, ...(first && { first }) };
}

function compareBlocks(theirs: DumpBlock, right: DumpBlock, tolerance: number): Omit<DumpComparison, 'agrees'> {
  const at = theirs.lines[0] ?? 1;
  if (theirs.holds && right.holds && theirs.holds !== right.holds) {
    return wrong(`line ${at} has ${theirs.holds}, expected ${right.holds}`);
  }
  const own = numbersOf(right, undefined);
  const found = numbersOf(theirs, own.values);
  if (found.values.length !== own.values.length) {
    return wrong(`line ${at} has ${theirs.values.length} numbers, expected ${right.values.length}`);
  }
  let worst = 0;
  let first: string | undefined;
  own.values.forEach((value, i) => {
    const other = found.values[i];
    // Infinities and NaN may be right.
    const error = Object.is(value, other) ? 0 : larger(0, (other - value) / own.sizeAt(i));
    worst = Math.max(worst, error);
    if (error <= tolerance || first) return;
    first = `line ${lineOf(theirs, Math.floor((i / own.values.length) * theirs.values.length))} has ${short(other)}, expected ${short(value)}`;
  });
  return { numbers: own.values.length, worst, ...(first && { first }) };
}

const wrong = (first: string) => ({ numbers: 0, worst: Number.POSITIVE_INFINITY, first });

interface Numbers {
  readonly values: Float64Array;
  /** The number that an error of a value is divided by. */
  sizeAt(index: number): number;
}

/** Matrices column-major, whatever their layout. @param ours of the right dump, which decides where nothing else does */
function numbersOf(block: DumpBlock, ours: Float64Array | undefined): Numbers {
  const { values, holds, nesting } = block;
  const width = block.starts.length > 1 ? block.starts[1] - block.starts[0] : 0;
  const isIndexed = width === 4 && block.lines.every((_, r) => values[block.starts[r]] === values[0] + r);
  const each = matrixSize(values, width);
  const ofMatrices = holds ? holds === 'world' || holds === 'local' : width === 16 || width === 12 || width === 4;
  if (each && ofMatrices && !isIndexed && values.length > 0) {
    const joints = values.length / each;
    const { matrices } = matricesOf(values, joints, nesting, ours ?? inRows(values, each));
    const size = diagonalOf(matrices, 16, 12);
    return { values: matrices, sizeAt: (i) => (i % 16 >= 12 ? size : 1) };
  }
  if (width === 3 && holds !== 'normals' && holds !== 'channels') {
    const size = diagonalOf(values, 3, 0);
    return { values, sizeAt: () => size };
  }
  return { values, sizeAt: () => 1 };
}

/** How many numbers a matrix has: as many as a row, else 16 if those would all end with 0 0 0 1. */
function matrixSize(values: Float64Array, width: number): 12 | 16 | undefined {
  if (width === 12 || width === 16) return width;
  const ends = (places: readonly number[]) => {
    for (let o = 0; o < values.length; o += 16) {
      if (!places.every((place, i) => values[o + place] === (i < 3 ? 0 : 1))) return false;
    }
    return true;
  };
  if (values.length % 16 === 0 && (ends([12, 13, 14, 15]) || ends([3, 7, 11, 15]))) return 16;
  return values.length % 12 === 0 ? 12 : undefined;
}

/** Matrices as read by rows, for `matricesOf` of a dump without another one. */
function inRows(values: Float64Array, each: number): Float64Array {
  return Float64Array.from({ length: (16 * values.length) / each }, (_, i) => {
    const [joint, column, row] = [Math.floor(i / 16), Math.floor((i % 16) / 4), i % 4];
    if (each === 12 && row === 3) return column === 3 ? 1 : 0;
    return values[each * joint + 4 * row + column];
  });
}

function lineOf({ starts, lines }: DumpBlock, index: number): number {
  let row = 0;
  while (row + 1 < lines.length && starts[row + 1] <= index) row++;
  return lines[row] ?? 1;
}

function listed(count: number): string {
  return `${count} ${count === 1 ? 'list' : 'lists'} of numbers`;
}

function short(value: number): string {
  return String(Number(value.toPrecision(6)));
}
