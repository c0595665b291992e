/** Real takes, posed at their frames and between them. */
import { expect, it } from 'vitest';
import { compileSkeleton, localMatrices, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { readBvh } from '../../src/formats/bvh/read.ts';
import type { Character } from '../../src/model/document.ts';
import { character } from '../helpers/builders.ts';
import { expectClose } from '../helpers/close.ts';
import { conformance, describeShared, sharedBytes } from '../helpers/shared.ts';

type Positions = Readonly<Record<string, readonly (readonly number[])[]>>;

interface Expected {
  readonly files: Readonly<
    Record<
      string,
      {
        readonly frame_time: number;
        readonly nodes: readonly (readonly [name: string, parent: number, channels: string | null])[];
        readonly tolerance: number;
        readonly positions: Positions;
        /** Of an exporter that meant offset plus channel. */
        readonly positions_add?: Positions;
      }
    >
  >;
}

describeShared('takes of the reference files', () => {
  const { files } = conformance<Expected>('bvh-positions.json');

  /** A character for each character of a file. */
  const takesOf = (name: string): Character[] => {
    const { value } = readBvh(sharedBytes(`data/bvh/${name}`), name);
    return (value ?? []).map((capture) =>
      character({ skeleton: capture.skeleton, takes: capture.take ? [capture.take] : [], shownTake: 0 }),
    );
  };

  it.each(Object.keys(files))('%s is in the right place at its frames', (name) => {
    const { frame_time, nodes, tolerance, positions } = files[name];
    const takes = takesOf(name);
    for (const [frame, expected] of Object.entries(positions)) {
      const joints = takes.flatMap((c) => positionsOf(c, Number(frame) * frame_time));
      const found = expected.filter((_, n) => nodes[n][2] !== null);
      expect(joints).toHaveLength(found.length);
      joints.forEach((position, j) => {
        position.forEach((x, axis) => {
          expect(Math.abs(x - found[j][axis]), `frame ${frame}, joint ${j}`).toBeLessThanOrEqual(tolerance);
        });
      });
    }
  });

  it.each(Object.keys(files))('%s is halfway between two frames as far from the one as from the other', (name) => {
    for (const c of takesOf(name)) {
      const samples = c.takes[0].samples;
      if (!c.skeleton || !samples) throw new Error('A take has a skeleton and samples.');
      const step = samples.frameSeconds;
      for (let frame = 0; frame + 1 < Math.min(samples.frameCount, 600); frame += 7) {
        const [from, half, to] = [0, 0.5, 1].map((t) => localsOf(c, (frame + t) * step));
        for (let j = 0; j < c.skeleton.joints.length; j++) {
          // Half the turn from frame to frame, by the length of the chord between the matrices: 2·√2·sin(angle / 2).
          const chord = (a: Float64Array, b: Float64Array) =>
            Math.hypot(...[0, 1, 2, 4, 5, 6, 8, 9, 10].map((k) => a[16 * j + k] - b[16 * j + k]));
          const turn = (a: Float64Array, b: Float64Array) => 2 * Math.asin(Math.min(1, chord(a, b) / Math.sqrt(8)));
          const angles = c.skeleton.joints[j].motion;
          // Two angles by themselves do not make a slerp.
          if (angles.kind === 'bvh' && angles.channels.filter((name) => name.startsWith('r')).length === 2) continue;
          expectClose([turn(from, half), turn(half, to)], new Array(2).fill(turn(from, to) / 2), 1e-7, `joint ${j}`);
        }
      }
    }
  });
});

function positionsOf(c: Character, time: number): number[][] {
  const out = new Float64Array(dofCountOf(c));
  poseAt(c, time, out);
  const joints = c.skeleton?.joints ?? [];
  const world = new Float64Array(16 * joints.length);
  if (c.skeleton) worldMatrices(compileSkeleton(c.skeleton), out, world);
  return joints.map((_, j) => [...world.subarray(16 * j + 12, 16 * j + 15)]);
}

function localsOf(c: Character, time: number): Float64Array {
  const out = new Float64Array(dofCountOf(c));
  poseAt(c, time, out);
  const locals = new Float64Array(16 * (c.skeleton?.joints.length ?? 0));
  if (c.skeleton) localMatrices(compileSkeleton(c.skeleton), out, locals);
  return locals;
}
