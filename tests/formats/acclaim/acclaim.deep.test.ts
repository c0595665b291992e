/** Skeletons and motions of Acclaim at random: written and read again, and there and back through other formats. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { toAcclaimBones } from '../../../src/evaluate/acclaim-bones.ts';
import { eachFrame } from '../../../src/evaluate/bake.ts';
import { bareCharacter } from '../../../src/evaluate/bare-character.ts';
import { toBvhCapture } from '../../../src/evaluate/bvh-capture.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { boneNames } from '../../../src/formats/acclaim/names.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Capture } from '../../../src/model/files.ts';
import { firstDofs, rootDofCount } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import {
  ACCLAIM_DOFS,
  type AcclaimDof,
  EULER_ORDERS,
  type Joint,
  type Limit,
  NO_BOX,
  type Skeleton,
  UNLIMITED,
} from '../../../src/model/skeleton/skeleton.ts';
import { restChannel, SAMPLED } from '../../../src/model/takes/take.ts';
import { ODD_ASF, readAmcText, readAsfText, writtenText } from '../../helpers/acclaim.ts';

/** Of the digits that files have. */
const small = fc.integer({ min: -300_000, max: 300_000 }).map((v) => v / 1e5);
const vec3: fc.Arbitrary<Vec3> = fc.tuple(small, small, small);
const limit: fc.Arbitrary<Limit> = fc.oneof(
  fc.record({ min: small, max: small }),
  fc.constant({ min: Number.NEGATIVE_INFINITY, max: Number.POSITIVE_INFINITY }),
);
const ROOT_DOFS: readonly AcclaimDof[] = ['tx', 'ty', 'tz', 'rx', 'ry', 'rz'];

interface Bone {
  readonly parent: number;
  readonly direction: Vec3;
  readonly length: number;
  readonly axes: Vec3;
  readonly order: (typeof EULER_ORDERS)[number];
  readonly dofs: readonly AcclaimDof[];
  readonly limits: readonly Limit[] | undefined;
}

const bone = (index: number): fc.Arbitrary<Bone> =>
  fc.shuffledSubarray([...ACCLAIM_DOFS]).chain((dofs) =>
    fc.record({
      parent: fc.nat(index - 1),
      direction: vec3.filter((v) => Math.hypot(...v) > 0.1),
      length: fc.double({ min: 0.1, max: 5, noNaN: true }),
      axes: fc.oneof(vec3, fc.constant([0, 0, 0] as Vec3)),
      order: fc.constantFrom(...EULER_ORDERS),
      dofs: fc.constant(dofs),
      limits: fc.option(fc.tuple(...dofs.map(() => limit)), { nil: undefined }),
    }),
  );

/** Joints in depth-first order, each at the tip of the one above. */
function joined(bones: readonly Bone[], root: Bone): readonly Joint[] {
  const order: number[] = [];
  const visit = (at: number) => {
    order.push(at);
    bones.forEach(({ parent }, b) => {
      if (parent === at && b + 1 !== at) visit(b + 1);
    });
  };
  visit(0);
  const all = [root, ...bones];
  return order.map((at, j): Joint => {
    const own = all[at];
    const parent = at === 0 ? -1 : order.indexOf(own.parent);
    const above = at === 0 || own.parent === 0 ? undefined : all[own.parent];
    const isLeaf = !bones.some((each, b) => each.parent === at && b + 1 !== at);
    return {
      name: j === 0 ? 'root' : `bone.${at}`,
      parent,
      offset: at === 0 ? own.direction : above ? tip(above) : [0, 0, 0],
      box: NO_BOX,
      motion: { kind: 'acclaim', dofs: own.dofs, axes: own.axes, order: own.order, frame: j === 0 ? 'root' : 'bone' },
      limits: own.limits ?? own.dofs.map(() => UNLIMITED),
      pose: own.dofs.map(() => 0),
      ...(j > 0 && { bone: { id: `${at}`, direction: unit(own.direction), length: own.length } }),
      ...(j > 0 && isLeaf && { endSites: [tip(own)] }),
    };
  });
}

function inDegrees({ axes: [x, y, z], limits, ...own }: Bone): Bone {
  const angle = (v: number) => 30 * v * RADIANS_PER_DEGREE;
  return {
    ...own,
    axes: [angle(x), angle(y), angle(z)],
    limits: limits?.map(({ min, max }, d) =>
      own.dofs[d].startsWith('r') ? { min: angle(min), max: angle(max) } : { min, max },
    ),
  };
}

function unit(v: Vec3): Vec3 {
  const size = Math.hypot(...v);
  return [v[0] / size, v[1] / size, v[2] / size];
}

function tip({ direction, length }: Bone): Vec3 {
  const [x, y, z] = unit(direction);
  return [x * length, y * length, z * length];
}

/** A skeleton and a few frames of it. */
const capture: fc.Arbitrary<Capture> = fc
  .record({
    bones: fc
      .integer({ min: 1, max: 5 })
      .chain((count) => fc.tuple(...Array.from({ length: count }, (_, i) => bone(i + 1)))),
    root: bone(1).chain((own) =>
      fc.shuffledSubarray([...ROOT_DOFS], { minLength: 1 }).map((dofs): Bone => ({ ...own, dofs, limits: undefined })),
    ),
    isRadians: fc.boolean(),
    length: fc.constantFrom(1, 0.45, 2.54),
    frames: fc.integer({ min: 1, max: 3 }),
    seed: fc.array(small, { minLength: 40, maxLength: 40 }),
  })
  .map(({ bones, root, isRadians, length, frames, seed }): Capture => {
    // Angles as a file of degrees gives them.
    const inFile = (own: Bone) => (isRadians ? own : inDegrees(own));
    const joints = joined(bones.map(inFile), inFile(root));
    const skeleton: Skeleton = {
      name: 'x',
      joints,
      acclaim: { version: '1.10', name: 'x', units: ['mass 1.0'], length, angle: isRadians ? 'rad' : 'deg' },
    };
    const dofs = joints.flatMap(({ motion }) => dofsOf(motion));
    const scales = Float64Array.from(dofs, ({ unit: of }) => (of === 'angle' && !isRadians ? RADIANS_PER_DEGREE : 1));
    const values = Float64Array.from({ length: frames * dofs.length }, (_, i) => {
      const value = seed[(7 * i) % seed.length];
      return dofs[i % dofs.length].unit === 'angle' && !isRadians ? 30 * value : value;
    });
    const firstChannel = rootDofCount(skeleton);
    return {
      skeleton,
      take: {
        name: 'x_walk',
        range: [0, (frames - 1) / 60],
        channels: Array.from({ length: firstChannel + dofs.length }, (_, c) =>
          c < firstChannel ? restChannel() : SAMPLED,
        ),
        samples: {
          frameCount: frames,
          frameSeconds: 1 / 60,
          startSeconds: 0,
          firstChannel,
          values,
          scales,
          interpolation: 'linear',
        },
      },
    };
  });

/** The largest distance of a joint of one from the joint of its name in the other, over all frames. */
function apart(a: Capture, b: Capture): number {
  const [one, other] = [a, b].map(placesOf);
  let most = 0;
  one.forEach((places, frame) => {
    for (const [name, at] of places) {
      const there = other[frame].get(name) ?? [Number.NaN, 0, 0];
      most = Math.max(most, Math.hypot(...at.map((v, k) => v - there[k])));
    }
  });
  return most;
}

function placesOf({ skeleton, take }: Capture): ReadonlyMap<string, readonly number[]>[] {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  const frames: Map<string, readonly number[]>[] = [];
  const { samples } = take ?? {};
  if (!samples) throw new Error('A take without samples.');
  eachFrame(bareCharacter(skeleton, take), samples, (dofs) => {
    worldMatrices(compiled, dofs, world);
    frames.push(new Map(skeleton.joints.map(({ name }, j) => [name, [...world.subarray(16 * j + 12, 16 * j + 15)]])));
  });
  return frames;
}

function framesOf({ take }: Capture) {
  const { samples } = take ?? {};
  if (!samples) throw new Error('A take without samples.');
  return samples;
}

async function readAgain({ skeleton, take }: Capture): Promise<Capture> {
  const asf = writtenText({ kind: 'asf', skeleton }, 'x.asf');
  if (!take) throw new Error('No take.');
  const amc = writtenText({ kind: 'amc', skeleton, take }, 'x_walk.amc');
  const { value, diagnostics } = await readAmcText(amc, asf);
  if (!value) throw new Error(JSON.stringify(diagnostics));
  return value;
}

describe('random skeletons of Acclaim', () => {
  it('are written and read to the same digit, with any DOFs, orders, axes, limits and units', async () => {
    await fc.assert(
      fc.asyncProperty(capture, async (given) => {
        const { skeleton } = await readAgain(given);
        const names = given.skeleton.joints.map(({ name }) => name);
        // Children away from the tip of the bone above get bones between.
        const kept = skeleton.joints.filter(({ name }) => names.includes(name));
        expect(kept.map(({ motion }) => motion)).toEqual(given.skeleton.joints.map(({ motion }) => motion));
        expect(kept.map(({ limits }) => limits)).toEqual(given.skeleton.joints.map(({ limits }) => limits));
        const text = writtenText({ kind: 'asf', skeleton }, 'x.asf');
        const again = await readAsfText(text);
        expect(again.value && writtenText(again.value, 'x.asf')).toBe(text);
      }),
      { numRuns: 60 },
    );
  });

  it('have their values to the same digit, and their joints where they were', async () => {
    await fc.assert(
      fc.asyncProperty(capture, async (given) => {
        const again = await readAgain(given);
        expect([...framesOf(again).values]).toEqual([...framesOf(given).values]);
        expect(apart(given, again)).toBeLessThan(1e-9);
      }),
      { numRuns: 60 },
    );
  });

  it('come back from .bvh with their joints where they were', async () => {
    await fc.assert(
      fc.asyncProperty(capture, async (given) => {
        const { capture: bvh } = toBvhCapture(bareCharacter(given.skeleton, given.take), framesOf(given));
        expect(apart(given, bvh)).toBeLessThan(1e-9);
        const { capture: bones } = toAcclaimBones(bareCharacter(bvh.skeleton, bvh.take), framesOf(given));
        expect(apart(given, await readAgain(bones))).toBeLessThan(1e-9);
      }),
      { numRuns: 60 },
    );
  });

  it('have derivatives, and screws, that are those of their matrices', () => {
    fc.assert(
      fc.property(capture, ({ skeleton, take }) => {
        const compiled = compileSkeleton(skeleton);
        const starts = firstDofs(skeleton);
        const { samples } = take ?? {};
        if (!samples) return;
        eachFrame(bareCharacter(skeleton, take), { ...samples, frameCount: 1 }, (dofs) => {
          skeleton.joints.forEach(({ motion }, j) => {
            dofsOf(motion).forEach((_, d) => {
              const at = starts[j] + d;
              const [before, after, slope] = [0, 1, 2].map(() => new Float64Array(16));
              const value = dofs[at];
              dofs[at] = value - 1e-5;
              compiled.motions[j].write(dofs, starts[j], before, 0);
              dofs[at] = value + 1e-5;
              compiled.motions[j].write(dofs, starts[j], after, 0);
              dofs[at] = value;
              compiled.motions[j].writeDerivative(dofs, starts[j], d, slope, 0);
              const off = slope.map((v, k) => Math.abs(v - (after[k] - before[k]) / 2e-5));
              expect(Math.max(...off)).toBeLessThan(1e-7);
            });
          });
        });
      }),
    );
  });
});

const BONES = [
  ['root', 6],
  ['low', 3],
  ['rod', 2],
  ['slide', 5],
  ['stick', 0],
] as const;

/** A line of a bone as it may stand among others: what is before it, its number, its values, what is after it, its end. */
const boneLine = fc.record({
  before: fc.constantFrom('', '', '', ' ', '\n', '# said\n'),
  bone: fc.nat(4),
  values: fc.array(fc.constantFrom('0.5', '-2', '1e-3', '3.64024e-015', '+.25', '12345678.875', '7.'), {
    minLength: 6,
    maxLength: 6,
  }),
  after: fc.constantFrom('', '', '', ' ', '\t', ' # low 1 2 3'),
  end: fc.constantFrom('\n', '\n', '\n', '\r\n', '\r'),
});

describe('a motion of Acclaim', () => {
  it('has the values of its lines, whatever their order, repetitions, gaps, blanks, comments and ends', async () => {
    await fc.assert(
      fc.asyncProperty(
        fc.array(boneLine, { maxLength: 7 }),
        fc.array(fc.record({ kept: fc.nat(7), others: fc.array(boneLine, { maxLength: 3 }) }), {
          minLength: 1,
          maxLength: 5,
        }),
        async (usual, changes) => {
          const row = new Array<number>(16).fill(0);
          const expected: number[] = [];
          let text = ':RADIANS\n:SAMPLES-PER-SECOND 60\n';
          // Most frames begin as the first.
          changes.forEach(({ kept, others }, frame) => {
            text += `${frame + 1}\n`;
            for (const { before, bone, values, after, end } of [...usual.slice(0, kept), ...others]) {
              const [name, count] = BONES[bone];
              text += `${before}${[name, ...values.slice(0, count)].join(' ')}${after}${end}`;
              const first = BONES.slice(0, bone).reduce((sum, [, width]) => sum + width, 0);
              for (let i = 0; i < count; i++) row[first + i] = Number(values[i]);
            }
            expected.push(...row);
          });
          const { value, diagnostics } = await readAmcText(text);
          expect(diagnostics.filter(({ code }) => code !== 'bone-missing')).toEqual([]);
          expect([...(value?.take.samples?.values ?? [])]).toEqual(expected);
        },
      ),
    );
  });
});

describe('files of hostile size', () => {
  it('an .asf is read in time with its size, whatever it repeats', async () => {
    const count = 50_000;
    const numbered = (line: (i: number) => string) => Array.from({ length: count }, (_, i) => line(i)).join('\n');
    const hostile = [
      ODD_ASF.replace('angle rad', `angle rad\n${numbered(() => 'mass 1')}`),
      ODD_ASF.replace('(-inf inf)', numbered(() => '0').replaceAll('\n', ' ')),
      ODD_ASF.replace(':bonedata', `:bonedata\n${numbered((i) => `begin\nname b${i}\nend`)}`).replace(
        'low rod stick',
        `low rod stick\n${numbered((i) => `b${i} b${i + 1}`).replace(/ b\d+$/, '')}`,
      ),
    ];
    const told = await Promise.all(hostile.map((text) => readAsfText(text)));
    expect(told.map(({ value }) => value?.skeleton.joints.length)).toEqual([5, 5, 5]);
    const { skeleton } = told[0].value ?? {};
    const same = skeleton && { ...skeleton, joints: [skeleton.joints[0], ...Array(count).fill(skeleton.joints[1])] };
    expect(same && new Set(boneNames(same)).size).toBe(count + 1);
  });

  it('an .amc takes no memory for frames without values', async () => {
    const bare = Array.from({ length: 3_000_000 }, (_, f) => `${f + 1}\n`).join('');
    const { diagnostics } = await readAmcText(`:FULLY-SPECIFIED\n${bare}`);
    expect(diagnostics.map(({ severity, code }) => `${severity} ${code}`)).toContain('error frames-bare');
  });
});
