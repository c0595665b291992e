/**
 * Reading Acclaim's motion against reading the same numbers as motion capture, to the same bytes: the names of bones in
 * each line are compared beside them. Goal: as many bytes in a second as a `.bvh`.
 */
import { bench, describe } from 'vitest';
import { type Joint, NO_BOX, type Skeleton, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { bundled } from '../helpers/bundled.ts';

// As in the page: bundled, and with nothing else in its functions' memory.
const { readAmc, readBvh, Report } = await bundled<typeof import('./amc-readers.ts')>('tests/bench/amc-readers.ts');

const BYTES = 20e6;
const BONES = 30;
const UTF8 = new TextEncoder();

const value = (frame: number, k: number) => (90 * Math.sin((frame * (k + 1)) / 500 + k)).toFixed(4);

function skeleton(): Skeleton {
  const joints = Array.from({ length: BONES }, (_, j): Joint => {
    const dofs = j === 0 ? (['tx', 'ty', 'tz', 'rx', 'ry', 'rz'] as const) : (['rx', 'ry'] as const);
    return {
      name: j === 0 ? 'root' : `lbone${j}`,
      parent: j - 1,
      offset: [0, 1, 0],
      box: NO_BOX,
      motion: { kind: 'acclaim', dofs, axes: [0, 0, 0], order: 'xyz', frame: j === 0 ? 'root' : 'bone' },
      limits: dofs.map(() => UNLIMITED),
      pose: dofs.map(() => 0),
    };
  });
  return { name: 'x', joints };
}

const width = 6 + 2 * (BONES - 1);

function amcText(names: readonly string[]): string {
  const frames: string[] = [':FULLY-SPECIFIED\n:DEGREES\n'];
  for (let frame = 0, size = 0; size < BYTES; frame++) {
    const bones = names.map((name, j) => {
      const count = j === 0 ? 6 : 2;
      const first = j === 0 ? 0 : 4 + 2 * j;
      return `${name} ${Array.from({ length: count }, (_, k) => value(frame, first + k)).join(' ')}\n`;
    });
    frames.push(`${frame + 1}\n${bones.join('')}`);
    size += frames[frame + 1].length;
  }
  return frames.join('');
}

function bvhText(): string {
  const open = Array.from({ length: BONES }, (_, j) => {
    const channels = j === 0 ? '6 Xposition Yposition Zposition' : '3';
    const turns = j === 0 ? 'Zrotation Yrotation Xrotation' : 'Zrotation Xrotation Yrotation';
    return `${j === 0 ? 'ROOT' : 'JOINT'} j${j}\n{\nOFFSET 0 1 0\nCHANNELS ${channels} ${turns}\n`;
  });
  const columns = 6 + 3 * (BONES - 1);
  const rows: string[] = [];
  for (let frame = 0, size = 0; size < BYTES; frame++) {
    rows.push(Array.from({ length: columns }, (_, k) => value(frame, k)).join(' '));
    size += rows[frame].length + 1;
  }
  const head = `HIERARCHY\n${open.join('')}${'}\n'.repeat(BONES)}MOTION\nFrames: ${rows.length}\nFrame Time: 0.01\n`;
  return `${head}${rows.join('\n')}\n`;
}

describe(`${BYTES / 1e6} MB of motion, ${width} numbers a frame`, () => {
  const of = skeleton();
  const amc = UTF8.encode(amcText(of.joints.map(({ name }) => name)));
  const bvh = UTF8.encode(bvhText());
  bench('.amc', () => void readAmc(amc, new Report('x.amc'), 'x', of));
  bench('.bvh', () => void readBvh(bvh, 'x.bvh'));
});
