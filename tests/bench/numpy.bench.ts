/**
 * Reading 100 MB of arrays against inflating the same bytes by fflate and copying them. Goal: at most 1.5 times that.
 */
import { unzipSync, zipSync } from 'fflate';
import { bench, describe } from 'vitest';
import { bundled } from '../helpers/bundled.ts';
import { npyOf } from '../helpers/numpy.ts';

type Numpy = typeof import('../../src/import/numpy/read.ts');

// As in the page: bundled, and with nothing else in its functions' memory.
const { readNumpy } = await bundled<Numpy>('src/import/numpy/read.ts');

const BYTES = 100e6;
/** Motion that is measured, so that its last digits are noise, as those of AMASS are. */
const value = (frame: number, k: number) => 0.6 * Math.sin((frame * (k % 7)) / 90 + k) + 1e-3 * Math.random();

function arrayOf(width: number, shape: (frames: number) => readonly number[], bytes = BYTES): Uint8Array {
  const frames = Math.floor(bytes / (4 * width));
  const data = new Float32Array(frames * width);
  for (let frame = 0, i = 0; frame < frames; frame++) for (let k = 0; k < width; k++) data[i++] = value(frame, k);
  return npyOf([shape(frames), data]);
}

const FILES: readonly (readonly [what: string, Uint8Array])[] = [
  ['poses of AMASS, 52 joints', zipSync({ 'poses.npy': arrayOf(156, (frames) => [frames, 156]) })],
  ['positions of 22 joints', zipSync({ 'positions.npy': arrayOf(66, (frames) => [frames, 22, 3]) })],
];

for (const [what, file] of FILES) {
  describe(`${BYTES / 1e6} MB of ${what}, deflated`, () => {
    const options = { iterations: 3, time: 0, warmupIterations: 1, warmupTime: 0 };
    bench(
      'read as a take',
      () => {
        const { value: read, diagnostics } = readNumpy({ fileName: 'x.npz', bytes: new Uint8Array(file) });
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
