/** Every file of the public set against the positions that an independent program got. */
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { readBvh } from '../../../src/formats/bvh/read.ts';
import type { Capture } from '../../../src/model/files.ts';
import { withPositions } from '../../../src/model/skeleton/position-channels.ts';
import type { BvhChannel } from '../../../src/model/skeleton/skeleton.ts';
import { character } from '../../helpers/builders.ts';
import { expectEqual } from '../../helpers/equal.ts';
import { conformance, describeShared, sharedBytes } from '../../helpers/shared.ts';
import { read, readInPieces, told } from '../read-in-pieces.ts';

type Point = readonly number[];

interface FileCase {
  readonly frames: number;
  readonly declared: number;
  readonly frame_time: number;
  readonly channels: number;
  /** Name, parent, channels; End Sites among them, with channels null. */
  readonly nodes: readonly (readonly [string, number, string | null])[];
  readonly rest: readonly Point[];
  readonly positions: Readonly<Record<string, readonly Point[]>>;
  readonly positions_add?: Readonly<Record<string, readonly Point[]>>;
  readonly tolerance: number;
}

interface MalformedCase {
  readonly file: string;
  readonly accept_lines: readonly number[];
  readonly what: string;
  readonly outcome: string;
}

const CHANNELS: Readonly<Record<string, BvhChannel>> = {
  Xposition: 'tx',
  Yposition: 'ty',
  Zposition: 'tz',
  Xrotation: 'rx',
  Yrotation: 'ry',
  Zrotation: 'rz',
};

/** Where joints and End Sites are, joint by joint, at a frame or at rest. */
function positionsOf({ skeleton, take }: Capture, frame: number | 'rest'): { joints: Point[]; endSites: Point[][] } {
  const moving = take && frame !== 'rest';
  const capture = character({ skeleton, ...(moving && { takes: [take], shownTake: 0 }) });
  const dofs = new Float64Array(dofCountOf(capture));
  poseAt(capture, moving ? frame * (take.samples?.frameSeconds ?? 0) : 0, dofs);
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), dofs, world);
  const at = (j: number, [x, y, z]: Point) =>
    [0, 1, 2].map((k) => {
      const m = (column: number) => world[16 * j + 4 * column + k];
      return m(0) * x + m(1) * y + m(2) * z + m(3);
    });
  return {
    joints: skeleton.joints.map((_, j) => at(j, [0, 0, 0])),
    endSites: skeleton.joints.map(({ endSites = [] }, j) => endSites.map((end) => at(j, end))),
  };
}

/** The reference's nodes in the order of the joints, and of the End Sites of each. */
function expectedOf(nodes: FileCase['nodes'], points: readonly Point[]) {
  const joints: Point[] = [];
  const endSites: Point[][] = [];
  const jointOfNode = new Map<number, number>();
  nodes.forEach(([, parent, channels], n) => {
    if (channels !== null) {
      jointOfNode.set(n, joints.length);
      joints.push(points[n]);
      endSites.push([]);
    } else endSites[jointOfNode.get(parent) ?? -1].push(points[n]);
  });
  return { joints, endSites };
}

function farthest(got: readonly Point[], expected: readonly Point[]): number {
  expect(got.length).toBe(expected.length);
  let worst = 0;
  got.forEach((point, i) => {
    for (let k = 0; k < 3; k++) {
      const off = Math.abs(point[k] - expected[i][k]);
      worst = off <= worst ? worst : off;
    }
  });
  return worst;
}

function expectPositions(
  captures: readonly Capture[],
  frame: number | 'rest',
  file: FileCase,
  points: readonly Point[],
) {
  const expected = expectedOf(file.nodes, points);
  const got = captures.map((capture) => positionsOf(capture, frame));
  const off = farthest(
    got.flatMap(({ joints }) => joints),
    expected.joints,
  );
  const offEnds = farthest(
    got.flatMap(({ endSites }) => endSites.flat()),
    expected.endSites.flat(),
  );
  expect(Math.max(off, offEnds), `frame ${frame}`).toBeLessThanOrEqual(file.tolerance);
}

const taking = (captures: readonly Capture[], positions: 'replace' | 'add') =>
  captures.map((capture) => ({ ...capture, skeleton: withPositions(capture.skeleton, positions) }));

describeShared('the motion capture files of the reference', () => {
  const { files } = conformance<{ files: Readonly<Record<string, FileCase>> }>('bvh-positions.json');

  describe.each(Object.entries(files))('%s', (name, file) => {
    const { value: captures = [], diagnostics } = readBvh(sharedBytes(`data/bvh/${name}`), name);

    it(`${name} has the hierarchy, the channels and the frames that are written`, () => {
      const parents = captures.flatMap(({ skeleton }) => skeleton.joints.map(({ parent }) => parent));
      const joints = captures.flatMap(({ skeleton }) => skeleton.joints);
      const nodes = file.nodes.filter(([, , channels]) => channels !== null);
      expect(joints.map((joint) => joint.name)).toEqual(nodes.map(([jointName]) => jointName));
      expect(joints.map(({ motion }) => motion.kind === 'bvh' && motion.channels)).toEqual(
        nodes.map(([, , channels]) => channels?.split(' ').flatMap((channel) => CHANNELS[channel] ?? [])),
      );
      expect(parents.filter((parent) => parent < 0)).toHaveLength(nodes.filter(([, parent]) => parent < 0).length);
      const samples = captures.map(({ take }) => take?.samples);
      expect(samples.reduce((sum, own) => sum + (own?.scales.length ?? 0), 0)).toBe(file.channels);
      for (const own of samples) {
        expect(own?.frameCount).toBe(file.frames);
        expect(own?.values).toHaveLength(file.frames * (own?.scales.length ?? 0));
        expect(own?.frameSeconds).toBeCloseTo(file.frame_time, 9);
      }
    });

    it(`${name} warns where the declared frames are not those there are, and of nothing else`, () => {
      const expected = file.frames === file.declared ? [] : ['count-mismatch'];
      expect(diagnostics.filter((d) => d.severity !== 'info').map((d) => d.code)).toEqual(expected);
    });

    it(`${name} rests as the offsets say, however position channels are taken`, () => {
      for (const positions of ['replace', 'add'] as const) {
        expectPositions(taking(captures, positions), 'rest', file, file.rest);
      }
    });

    it.each(Object.keys(file.positions))(`${name} has joints and End Sites where they belong, frame %s`, (frame) => {
      expectPositions(taking(captures, 'replace'), Number(frame), file, file.positions[frame]);
      const added = file.positions_add?.[frame];
      if (added) expectPositions(taking(captures, 'add'), Number(frame), file, added);
      // As it was read.
      expectPositions(captures, Number(frame), file, file.positions[frame]);
    });

    it(`${name} reads the same in pieces of any size`, () => {
      const bytes = sharedBytes(`data/bvh/${name}`);
      const whole = read(name, bytes);
      for (const size of [997, 65536]) {
        const cuts = Array.from({ length: Math.floor(bytes.length / size) }, (_, i) => size * (i + 1));
        expectEqual(readInPieces(name, bytes, cuts), whole);
      }
    });
  });
});

describeShared('the broken motion capture files of the reference', () => {
  const { malformed } = conformance<{ malformed: readonly MalformedCase[] }>('bvh-positions.json');

  it.each(malformed)('the broken file $file: $what', ({ file, accept_lines: lines, outcome }) => {
    const bytes = sharedBytes(`data/bvh/malformed/${file}`);
    const result = readBvh(bytes, file);
    const problems = result.diagnostics.filter((d) => d.severity !== 'info');
    expect(problems).toHaveLength(1);
    expect(lines).toContain(problems[0].line);
    expect(problems[0].excerpt).toBeDefined();
    if (outcome === 'refuse') expect(result.value).toBeUndefined();
    if (file === 'frames-1e9.bvh') {
      expect(told(result)).toEqual(['warning count-mismatch 22:1']);
      expect(result.value?.[0].take?.samples).toMatchObject({ frameCount: 4 });
      expect(result.value?.[0].take?.samples?.values.buffer.byteLength).toBeLessThan(8 * bytes.length);
    }
  });
});
