/** Reading a C3D of 100 MB, made in memory, against copying its numbers. Goal: within a second. */
import { bench, describe } from 'vitest';
import { bundled } from '../helpers/bundled.ts';
import { c3dOf } from '../helpers/c3d.ts';

type Points = typeof import('../../src/import/points/read.ts');

// As in the page: bundled, and with nothing else in its functions' memory.
const { readPoints } = await bundled<Points>('src/import/points/read.ts');

const BYTES = 100e6;
const POINTS = 60;
const BLOCK = 512;

/** A head for all frames, and then those: one in 50 points is missing. */
function longC3d(): Uint8Array<ArrayBuffer> {
  const labels = Array.from({ length: POINTS }, (_, p) => `M${p}`);
  const frameCount = Math.floor(BYTES / (16 * POINTS));
  const head = c3dOf({ labels, frames: Array.from({ length: frameCount }, () => []), isLong: true });
  const numbers = new Float32Array(4 * POINTS * frameCount);
  for (let i = 0; i < numbers.length; i += 4) {
    numbers[i] = 1000 * Math.sin(i / 1e5);
    numbers[i + 1] = 900 + (i % 640);
    numbers[i + 2] = 1000 * Math.cos(i / 1e5);
    numbers[i + 3] = i % 200 === 0 ? -1 : 0;
  }
  const start = Math.ceil(head.length / BLOCK) * BLOCK;
  const bytes = new Uint8Array(start + numbers.byteLength);
  bytes.set(head);
  bytes.set(new Uint8Array(numbers.buffer), start);
  return bytes;
}

const file = longC3d();

describe(`a C3D of ${Math.round(file.length / 1e6)} MB, ${POINTS} points`, () => {
  const options = { iterations: 5, time: 0, warmupIterations: 1, warmupTime: 0 };
  bench(
    'read as a take',
    () => {
      const { value, diagnostics } = readPoints('c3d', { fileName: 'x.c3d', bytes: file });
      if (!value) throw new Error(diagnostics[0].message);
    },
    options,
  );
  bench(
    'its numbers copied as doubles',
    () => {
      const numbers = new Float32Array(file.buffer, BLOCK * 4, (file.length - BLOCK * 4) >> 2);
      if (new Float64Array(numbers).length === 0) throw new Error('Nothing was copied.');
    },
    options,
  );
});
