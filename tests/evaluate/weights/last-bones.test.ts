import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type BoneSegments, boneSegments, isPoint } from '../../../src/evaluate/weights/bones.ts';
import { heatWeights } from '../../../src/evaluate/weights/heat-weights.ts';
import { lastBones } from '../../../src/evaluate/weights/last-bones.ts';
import { surfaceSides } from '../../../src/evaluate/weights/surface-sides.ts';
import { triangleTree } from '../../../src/evaluate/weights/triangle-tree.ts';
import { visibleBones } from '../../../src/evaluate/weights/visible-bones.ts';
import { weld } from '../../../src/evaluate/weights/weld.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { readSkin } from '../../../src/formats/skin/read.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Attachments } from '../../../src/model/skin.ts';
import { describeShared, sharedPath } from '../../helpers/shared.ts';
import { characterOf } from '../../teaching/lesson-files.ts';
import { bonesFrom, finish, type Mesh, together, tube, weightOf } from './meshes.ts';

/** Sums of coordinates of a few units. */
const SAME = 1e-9;
/** Weights are kept in ten-thousandths. */
const ROUNDED = 1.0001e-4;

const point = (at: Vec3): [Vec3, Vec3] => [at, at];

function grown(mesh: Mesh, bones: BoneSegments): BoneSegments {
  const welded = finish(weld(mesh.positions, mesh.triangles));
  return finish(lastBones(finish(triangleTree(welded)), finish(surfaceSides(welded)), bones));
}

function endOf({ ends }: BoneSegments, bone: number): readonly number[] {
  return [...ends.subarray(6 * bone + 3, 6 * bone + 6)];
}

/** How many vertices follow each joint more than any other. */
function dominated({ start, joints, weights }: Attachments, jointCount: number): number[] {
  const counts = Array<number>(jointCount).fill(0);
  for (let v = 0; v + 1 < start.length; v++) {
    let main = start[v];
    for (let a = start[v]; a < start[v + 1]; a++) if (weights[a] > weights[main]) main = a;
    counts[joints[main]]++;
  }
  return counts;
}

/** A sheet of 2 × `along` vertices in the plane x = `at`, as high as `width`, from z `from` to z `to`. */
function sheet(at: number, y: number, width: number, from: number, to: number, along = 12): Mesh {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (let i = 0; i <= along; i++) {
    const z = from + ((to - from) * i) / along;
    positions.push(at, y - width / 2, z, at, y + width / 2, z);
    if (i > 0) triangles.push(2 * i - 2, 2 * i - 1, 2 * i, 2 * i - 1, 2 * i + 1, 2 * i);
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

describe('a last joint without box, in a tube', () => {
  const [around, along, length] = [12, 40, 8];
  const mesh = tube({ around, along, radius: 0.4, length });
  const height = (v: number) => mesh.positions[3 * v + 1];

  it('a last joint without box, in a tube has what lies beyond it, and none of what lies before, wherever it is', () => {
    fc.assert(
      fc.property(fc.double({ min: 2, max: 6, noNaN: true }), (at) => {
        const bones = bonesFrom(
          [
            [0, 0, 0],
            [0, at, 0],
          ],
          point([0, at, 0]),
        );
        const { attachments } = finish(heatWeights(mesh, bones, 4));
        for (let v = 0; 3 * v < mesh.positions.length; v++) {
          const [beyond, weight] = [height(v) - at, weightOf(attachments, v, 1)];
          const isRight = (beyond <= 0.4 || weight > 0.5) && (beyond >= -0.4 || weight < 0.5);
          if (isRight && (beyond <= 1.5 || weight > 0.9)) continue;
          expect.fail(`vertex ${v}, ${beyond} beyond the joint, has a weight of ${weight}`);
        }
      }),
      { numRuns: 10 },
    );
  });

  it('a last joint without box, in a tube has a bone to the tube’s end', () => {
    const bones = bonesFrom(
      [
        [0, 0, 0],
        [0, 4, 0],
      ],
      point([0, 4, 0]),
    );
    const [x, y, z] = endOf(grown(mesh, bones), 1);
    expect(Math.abs(x)).toBeLessThan(SAME);
    expect(Math.abs(z)).toBeLessThan(SAME);
    // The cap at the end draws the middle a little farther out; no bone leaves the mesh.
    expect(y).toBeGreaterThan(0.95 * length);
    expect(y).toBeLessThanOrEqual(length + SAME);
  });

  it('a last joint without box, in a tube has a limb that runs back beside its parent', () => {
    // Down again beside the first half: its vertices are the nearest to the first bone, which they do not see.
    const other = tube({ around, along: 20, radius: 0.4, length: 4, at: [1, 0] });
    const bar = tube({ around, along: 6, radius: 0.4, length: 1.8 });
    const across = bar.positions.map((_, i) => {
      const [x, y, z] = bar.positions.subarray(i - (i % 3), i - (i % 3) + 3);
      return [y - 0.4, 4 - x, z][i % 3];
    });
    const first = tube({ around, along: 20, radius: 0.4, length: 4 });
    const bent = together(first, { ...bar, positions: across }, other);
    const bones = bonesFrom(
      [
        [0, 0, 0],
        [0, 4, 0],
      ],
      [
        [0, 4, 0],
        [1, 4, 0],
      ],
      point([1, 4, 0]),
    );
    const { attachments } = finish(heatWeights(bent, bones, 4));
    const before = bent.positions.length / 3 - other.positions.length / 3;
    for (let v = 0; 3 * v < other.positions.length; v++) {
      if (other.positions[3 * v + 1] < 3) expect(weightOf(attachments, before + v, 2)).toBeGreaterThan(0.9);
    }
    for (let v = 0; 3 * v < first.positions.length; v++) expect(weightOf(attachments, v, 2)).toBeLessThan(0.1);
  });
});

describe('the bone of a last joint', () => {
  it('the bone of a last joint stays a point in the middle of what is around it, and where no vertex is its own', () => {
    const ring = tube({ around: 12, along: 12, radius: 0.5, length: 2 });
    const centre = point([0, 1, 0]);
    const [, y] = endOf(grown(ring, bonesFrom(centre)), 0);
    expect(Math.abs(y - 1)).toBeLessThan(SAME);
    // Beside another bone, which runs through all of the tube.
    const aside = bonesFrom(
      [
        [0, 0, 0],
        [0, 2, 0],
      ],
      point([9, 1, 0]),
    );
    expect(isPoint(grown(ring, aside).ends, 1)).toBe(true);
    const bare = { positions: ring.positions, triangles: new Uint32Array(0) };
    expect(isPoint(grown(bare, bonesFrom(centre)).ends, 0)).toBe(true);
  });

  it('the bone of a last joint is left alone where it has a length', () => {
    const mesh = tube({ around: 8, along: 8, radius: 0.5, length: 4 });
    const bones = bonesFrom(
      [
        [0, 0, 0],
        [0, 2, 0],
      ],
      [
        [0, 2, 0],
        [0, 2.5, 0],
      ],
    );
    expect(grown(mesh, bones)).toBe(bones);
  });
});

describe('a point at the end of a bone', () => {
  it('warms what lies beyond alone, though the bone’s end is as near', () => {
    const { positions, triangles } = tube({ around: 12, along: 23, radius: 0.5, length: 6 });
    const mesh = finish(weld(positions, triangles));
    const bones = bonesFrom(
      [
        [0, 0, 0],
        [0, 3, 0],
      ],
      point([0, 3, 0]),
    );
    const { start, joints } = finish(visibleBones(finish(triangleTree(mesh)), finish(surfaceSides(mesh)), bones));
    for (let v = 0; v < mesh.vertexCount; v++) {
      expect([...joints.subarray(start[v], start[v + 1])]).toEqual([mesh.positions[3 * v + 1] > 3 ? 1 : 0]);
    }
  });
});

describe('a sheet', () => {
  const body = tube({ around: 16, along: 20, radius: 0.5, length: 4 });
  const wings = together(body, sheet(0.6, 3, 0.3, 0, 4), sheet(-0.6, 3, 0.3, 0, 4));
  const count = body.positions.length / 3;
  const spine: [Vec3, Vec3] = [
    [0, 0, 0],
    [0, 4, 0],
  ];

  it('follows the last joint that it begins at, to its far end', () => {
    const bones = bonesFrom(
      spine,
      [
        [0, 3, 0],
        [0.6, 3, 0],
      ],
      [
        [0, 3, 0],
        [-0.6, 3, 0],
      ],
      point([0.6, 3, 0]),
      point([-0.6, 3, 0]),
    );
    const [x, y, z] = endOf(grown(wings, bones), 3);
    expect([x, y]).toEqual([expect.closeTo(0.6, 1), expect.closeTo(3, 1)]);
    expect(z).toBeGreaterThan(3);
    const { attachments } = finish(heatWeights(wings, bones, 4));
    for (let v = count; 3 * v < wings.positions.length; v++) {
      if (wings.positions[3 * v + 2] < 1) continue;
      expect(weightOf(attachments, v, wings.positions[3 * v] > 0 ? 3 : 4)).toBeGreaterThan(0.9);
    }
  });

  it('around its parent’s bone, as clothes are, is not its own', () => {
    // Without caps and with a slit, so that it has no volume.
    const shirt = sheet(0.1, 2, 0.4, -1, 4);
    const bones = bonesFrom(
      [
        [0, 2, -1],
        [0, 2, 0],
      ],
      [
        [0, 2, 0],
        [0, 2, 1],
      ],
      point([0, 2, 1]),
    );
    const { attachments } = finish(heatWeights(shirt, bones, 4));
    for (let v = 0; 3 * v < shirt.positions.length; v++) {
      if (shirt.positions[3 * v + 2] < 0.5) expect(weightOf(attachments, v, 2)).toBeLessThan(0.5);
    }
    const [, , z] = endOf(grown(shirt, bones), 2);
    expect(z).toBeGreaterThan(3.5);
  });
});

describe('the crawler without its boxes', () => {
  const { skeleton, skins } = characterOf('crawler.skel', 'crawler.skin');
  const [skin] = skins;
  if (!skeleton || !skin?.attachments) throw new Error('no crawler');
  const made = skin.attachments;
  const { joints } = skeleton;
  const isLast = (j: number) => !joints.some(({ parent }) => parent === j);
  const given = boneSegments(skeleton, skin.bindings);
  // The last joints' bones end where they begin.
  const bones: BoneSegments = {
    ...given,
    ends: given.ends.map((x, i) => (isLast(given.joints[Math.floor(i / 6)]) && i % 6 > 2 ? given.ends[i - 3] : x)),
  };
  const { attachments } = finish(heatWeights(skin, bones, 4));

  it('the crawler without its boxes has its last joints’ limbs', () => {
    const [ours, theirs] = [dominated(attachments, joints.length), dominated(made, joints.length)];
    joints.forEach((_, j) => {
      if (isLast(j)) expect(ours[j]).toBeGreaterThan(theirs[j] / 2);
    });
  });
});

describe('a body with two arms and two wings that mirror each other', () => {
  const mirrored = ({ positions, triangles }: Mesh): Mesh => ({
    positions: positions.map((x, i) => (i % 3 === 0 ? -x : x)),
    triangles: triangles.toReversed(),
  });
  const upright = tube({ around: 10, along: 20, radius: 0.25, length: 4 });
  const lying = upright.positions.map((_, i) => {
    const [x, y, z] = upright.positions.subarray(i - (i % 3), i - (i % 3) + 3);
    return [0.2 + y, 2 - x, z][i % 3];
  });
  const body = tube({ around: 16, along: 20, radius: 0.6, length: 4 });
  const half = together(body, { ...upright, positions: lying }, sheet(0.7, 3, 0.3, 0, 4));
  const mesh = together(half, mirrored(half));
  const count = half.positions.length / 3;
  const side = (x: number): [Vec3, Vec3][] => [
    [
      [0, 2, 0],
      [x, 2, 0],
    ],
    [
      [0, 3, 0],
      [x / 2, 3, 0],
    ],
    [
      [x, 2, 0],
      [2 * x, 2, 0],
    ],
    point([2 * x, 2, 0]),
    point([x / 2, 3, 0]),
  ];
  const bones = bonesFrom(
    [
      [0, 0, 0],
      [0, 4, 0],
    ],
    ...side(1.3),
    ...side(-1.3),
  );
  const { attachments } = finish(heatWeights(mesh, bones, 16));

  it('a mirrored body has mirrored weights', () => {
    let most = 0;
    for (let v = 0; v < count; v++) {
      for (let joint = 0; joint < 11; joint++) {
        const other = joint === 0 ? 0 : joint > 5 ? joint - 5 : joint + 5;
        const difference = weightOf(attachments, v, joint) - weightOf(attachments, count + v, other);
        most = Math.max(most, Math.abs(difference));
      }
    }
    expect(most).toBeLessThan(2 * ROUNDED);
  });

  it('a mirrored body has limbs at the last joints of both arms and both wings', () => {
    const main = dominated(attachments, 11);
    for (const joint of [4, 5, 9, 10]) expect(main[joint]).toBeGreaterThan(20);
  });
});

describeShared('the wasp, whose joints have no boxes', () => {
  const read = (name: string) => readFileSync(sharedPath(`data/cse169/${name}`), 'utf8');
  const skeleton = readSkel(read('wasp.skel'), 'wasp.skel').value?.[0];
  const skin = readSkin(read('wasp.skin'), 'wasp.skin').value;
  if (!skeleton || !skin?.attachments) throw new Error('no wasp');
  const { joints } = skeleton;
  const { attachments } = finish(heatWeights(skin, boneSegments(skeleton, skin.bindings), 4));
  const ours = dominated(attachments, joints.length);
  const theirs = dominated(skin.attachments, joints.length);

  it('the wasp, whose joints have no boxes has its knees’, its wings’, its head’s and its tail’s vertices at their joints', () => {
    joints.forEach(({ name }, j) => {
      if (/^knee/.test(name)) expect(ours[j], name).toBeGreaterThanOrEqual(40);
      if (/^(wing|head|tail_04)/.test(name)) expect(ours[j], name).toBeGreaterThanOrEqual(theirs[j]);
    });
  });

  it('the wasp, whose joints have no boxes has as many vertices on the left as on the right', () => {
    joints.forEach(({ name }, j) => {
      const other = joints.findIndex((joint) => joint.name === name.replace(/_r$/, '_l'));
      expect(ours[j], name).toBe(ours[other]);
    });
  });
});
