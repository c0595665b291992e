/**
 * Reading 100 MB of arrays against inflating the same bytes by fflate and copying them. Goal: at most 1.5 times that.
 * Both begin with the bytes of the file, which neither copies.
 */
import { unzipSync, zipSync } from 'fflate';
import { bench, describe } from 'vitest';
import { treesOf } from '../../src/evaluate/tree-fit/known-trees.ts';
import { bundled } from '../helpers/bundled.ts';
import { npyOf } from '../helpers/numpy.ts';

type Numpy = typeof import('../../src/import/numpy/read.ts');

// As in the page: bundled, and with nothing else in its functions' memory.
const { readNumpy } = await bundled<Numpy>('src/import/numpy/read.ts');

const BYTES = 100e6;
/** What is measured has noise, so that its last digits pack no better than those of AMASS. */
const noise = () => 1e-3 * Math.random();
const swing = (frame: number, k: number) => 0.6 * Math.sin((frame * (k % 7)) / 90 + k);

/** Frames of that many numbers. */
function arrayOf(
  width: number,
  shape: (frames: number) => readonly number[],
  write: (row: Float32Array, frame: number) => void,
) {
  const frames = Math.floor(BYTES / (4 * width));
  const data = new Float32Array(frames * width);
  for (let frame = 0; frame < frames; frame++) write(data.subarray(frame * width, (frame + 1) * width), frame);
  return npyOf([shape(frames), data]);
}

function writePoses(row: Float32Array, frame: number): void {
  for (let k = 0; k < row.length; k++) row[k] = swing(frame, k) + noise();
}

const [{ parents }] = treesOf(22);

/** A body: bones of constant length that swing. */
function writePlaces(row: Float32Array, frame: number): void {
  parents.forEach((parent, j) => {
    const [a, b] = [2 * swing(frame, j), swing(frame, j + 3)];
    const bone = [Math.cos(a) * Math.cos(b), Math.sin(b), Math.sin(a) * Math.cos(b)];
    for (let k = 0; k < 3; k++) row[3 * j + k] = (parent < 0 ? 0 : row[3 * parent + k]) + 0.2 * bone[k] + noise();
  });
}

const POSES = arrayOf(156, (frames) => [frames, 156], writePoses);
const PLACES = arrayOf(66, (frames) => [frames, 22, 3], writePlaces);
const FILES: readonly (readonly [what: string, Uint8Array<ArrayBuffer>])[] = [
  ['poses of AMASS, 52 joints', new Uint8Array(zipSync({ 'poses.npy': POSES }))],
  ['positions of 22 joints', new Uint8Array(zipSync({ 'positions.npy': PLACES }))],
];

for (const [what, file] of FILES) {
  describe(`${BYTES / 1e6} MB of ${what}, deflated`, () => {
    const options = { iterations: 3, time: 0, warmupIterations: 1, warmupTime: 0 };
    bench(
      'read as a take',
      () => {
        const { value: read, diagnostics } = readNumpy({ fileName: 'x.npz', bytes: file });
        if (!read) throw new Error(diagnostics[0].message);
      },
      options,
    );
    bench(
      'inflated and copied',
      () => {
        for (const bytes of Object.values(unzipSync(file))) bytes.slice();
      },
      options,
    );
  });
}
