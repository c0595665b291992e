/**
 * Writing motion capture: ours, in pieces of bytes as used for saving, against a loop that joins `String(value)` row by
 * row without checks. Goal: faster than that for captures' numbers (up to six decimals), and at most twice its time if
 * every number has all its digits.
 */
import { bench, describe } from 'vitest';
import { writeBvh } from '../../src/formats/bvh/write.ts';
import type { Capture } from '../../src/model/files.ts';
import { bvhJoint, captureOf } from '../helpers/bvh.ts';

const FRAMES = 5000;
const JOINTS = 60;

function capture(print: (value: number) => number): Capture {
  const joints = Array.from({ length: JOINTS }, (_, j) => bvhJoint(j - 1, ['rz', 'rx', 'ry'], { name: `j${j}` }));
  const rows = Array.from({ length: FRAMES }, (_, f) =>
    Array.from({ length: 3 * JOINTS }, (_, k) => print(90 * Math.sin((f * (k + 1)) / 500 + k))),
  );
  return captureOf({ name: 'take', joints }, rows);
}

function ours(written: Capture): number {
  let bytes = 0;
  for (const piece of writeBvh([written]).pieces) bytes += piece.length;
  return bytes;
}

function bare({ take }: Capture): number {
  const values = take?.samples?.values ?? new Float64Array(0);
  const row: string[] = new Array(3 * JOINTS);
  let length = 0;
  for (let at = 0; at < values.length; at += row.length) {
    for (let c = 0; c < row.length; c++) row[c] = String(values[at + c]);
    length += row.join(' ').length + 1;
  }
  return length;
}

for (const [name, print] of [
  ['four decimals', (value: number) => Number(value.toFixed(4))],
  ['all digits', (value: number) => value],
] as const) {
  describe(`a .bvh of ${FRAMES} rows of ${3 * JOINTS}, ${name}`, () => {
    const written = capture(print);
    bench('ours', () => void ours(written));
    bench('bare loop', () => void bare(written));
  });
}
