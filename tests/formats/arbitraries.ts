/** Models as a format can hold them, for fast-check. */
import fc from 'fast-check';
import { radiansOf } from '../../src/formats/skel/degrees.ts';
import type { Vec3 } from '../../src/math/vec3.ts';
import type { Morph, MorphRows } from '../../src/model/morph.ts';
import type { Rig } from '../../src/model/rig.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import {
  AXIS_PAIRS,
  type BvhMotion,
  COMPOUND_DOFS,
  type Couple,
  DEFAULT_BOX,
  EULER_ORDERS,
  type Joint,
  type Motion,
  SCALE_MODES,
  type Skeleton,
  UNLIMITED,
} from '../../src/model/skeleton/skeleton.ts';
import type { Attachments, Material, Skin } from '../../src/model/skin.ts';
import { type Channel, EXTRAPOLATIONS, type Take, type Tangents } from '../../src/model/takes/take.ts';
import { FIXED_TANGENT, TANGENT_KINDS } from '../../src/model/takes/tangent-kinds.ts';
import { anyText } from '../helpers/any-text.ts';
import { asRead } from '../helpers/as-read.ts';

/** Any finite double, -0 included. */
export const finite = fc.oneof(
  fc.double({ noNaN: true, noDefaultInfinity: true }),
  fc.integer({ min: -1000, max: 1000 }),
  fc.constantFrom(0, -0, 0.1, -0.1, 100000, -100000),
);
const vec3: fc.Arbitrary<Vec3> = fc.tuple(finite, finite, finite);
const ordered = fc.tuple(finite, finite).map(([a, b]): [number, number] => (a <= b ? [a, b] : [b, a]));

/** One token that is no number and no brace. */
export const token = fc.oneof(
  fc.constantFrom('root', 'hip_l', 'Größe', '骨', 'offset', 'balljoint', '"x', '12', '-', '\u{1F9B4}', '\uFEFFx'),
  anyText({ minLength: 1, maxLength: 8 }).filter((s) => /^[^ \t\r\n{}]+$/.test(s) && wellFormed(s)),
);
const fileName = fc
  .oneof(
    token,
    anyText({ maxLength: 12 }).filter((s) => wellFormed(s)),
    fc.constantFrom('my file.skel', '', 'a{b}.skin', 'skin', ' x', 'x.morph y'),
  )
  .filter((s) => !/[\r\n"]/.test(s));

function wellFormed(text: string): boolean {
  return !/\p{Surrogate}/u.test(text);
}

/** Any length but zero, which a reader refuses. */
const axis = fc.oneof(vec3, fc.constant([1, 0, 0] as Vec3)).filter((v) => v.some((part) => part !== 0));
const order = fc.constantFrom(...EULER_ORDERS);

type SkelKind = Exclude<Motion['kind'], 'bvh' | 'acclaim' | 'point'>;

const PARAMETERS: { readonly [K in SkelKind]: fc.Arbitrary<Omit<Extract<Motion, { kind: K }>, 'kind'>> } = {
  ball: fc.record({ order }),
  hinge: fc.record({ axis }),
  universal: fc.record({ order: fc.constantFrom(...AXIS_PAIRS) }),
  quaternion: fc.constant({}),
  prismatic: fc.record({ axis }),
  translational: fc.constant({}),
  free: fc.record({ order }),
  screw: fc.record({ axis, pitch: finite }),
  scale: fc.record({ mode: fc.constantFrom(...SCALE_MODES), axis }),
  shear: fc.constant({}),
  fixed: fc.constant({}),
  compound: fc.record({ dofs: fc.shuffledSubarray([...COMPOUND_DOFS]) }),
};

/** All that `.skel` can say of how a joint moves. */
export const motion: fc.Arbitrary<Motion> = fc.oneof(
  // Each kind has the parameters that are listed for it.
  ...Object.entries(PARAMETERS).map(([kind, parameters]) => parameters.map((own) => ({ kind, ...own }) as Motion)),
);

/** A joint of BVH: any channels, in any order. */
export const bvhMotion: fc.Arbitrary<BvhMotion> = fc.record({
  kind: fc.constant('bvh' as const),
  channels: fc.shuffledSubarray(['tx', 'ty', 'tz', 'rx', 'ry', 'rz'] as const),
  positions: fc.constantFrom('replace' as const, 'add' as const),
});

const limit = fc.oneof(fc.constant(UNLIMITED), fc.record({ min: finite, max: finite }));

const joint = (index: number): fc.Arbitrary<Joint> =>
  motion.chain((own) => {
    const dofs = dofsOf(own);
    const each = <T>(arbitrary: fc.Arbitrary<T>) => fc.tuple(...dofs.map(() => arbitrary));
    return fc.record(
      {
        name: fc.oneof(token, fc.constant('')),
        parent: index === 0 ? fc.constant(-1) : fc.nat(index - 1),
        offset: vec3,
        box: fc.oneof(
          fc.constant({ min: [-0.1, -0.1, -0.1] as Vec3, max: [0.1, 0.1, 0.1] as Vec3 }),
          fc.record({ min: vec3, max: vec3 }),
        ),
        motion: fc.constant(own),
        limits: each(limit),
        pose: fc.oneof(fc.constant(dofs.map(({ rest }) => rest)), each(finite)),
        length: finite.filter((l) => l >= 0),
        role: fc.constantFrom('hips', 'leftUpperArm'),
      },
      { requiredKeys: ['name', 'parent', 'offset', 'box', 'motion', 'limits', 'pose'] },
    );
  });

/** Some DOFs made to follow others, at random but never round and round: each follows one that comes before it. */
function coupled(joints: readonly Joint[]): fc.Arbitrary<readonly Joint[]> {
  const all = joints.flatMap((one, j) => dofsOf(one.motion).map(({ name }) => ({ joint: j, name })));
  const follows = all.map((_, i) => fc.option(fc.tuple(fc.nat(Math.max(0, i - 1)), finite, finite), { freq: 3 }));
  return fc.tuple(...follows).map((chosen) =>
    joints.map((one, j) => {
      const couples = all.flatMap(({ joint: owner, name }, i): Couple[] => {
        const choice = chosen[i];
        if (owner !== j || i === 0 || !choice) return [];
        const [before, gain, offset] = choice;
        return [{ dof: name, joint: all[before].joint, follows: all[before].name, gain, offset }];
      });
      return couples.length ? { ...one, couples } : one;
    }),
  );
}

/** Joints in pre-order: a parent is the joint before or one of its ancestors. */
export const skeleton: fc.Arbitrary<Skeleton> = fc
  .integer({ min: 1, max: 12 })
  .chain((n) => fc.tuple(...Array.from({ length: n }, (_, i) => joint(i))))
  .map((joints) => {
    const parents: number[] = [];
    joints.forEach(({ parent }, i) => {
      const line: number[] = [];
      for (let j = i - 1; j >= 0; j = parents[j]) line.push(j);
      parents.push(i === 0 ? -1 : line[parent % line.length]);
    });
    return joints.map((j, i) => ({ ...j, parent: parents[i] }));
  })
  .chain((joints) => fc.oneof(fc.constant(joints), coupled(joints)))
  .map((joints) => ({ name: 'x', joints }));

/** Hinges, each at its parent's tip, in poses that degrees can say: all that the axis-angle form holds. */
export const axisAngleSkeleton: fc.Arbitrary<Skeleton> = fc
  .array(fc.record({ length: finite.filter((l) => l >= 0), axis, degrees: finite, line: fc.nat() }), {
    minLength: 1,
    maxLength: 12,
  })
  .map((all) => {
    const joints: Joint[] = [];
    for (const { length, axis: own, degrees, line } of all) {
      const ancestors: number[] = [];
      for (let j = joints.length - 1; j >= 0; j = joints[j].parent) ancestors.push(j);
      const parent = ancestors[line % ancestors.length] ?? -1;
      joints.push({
        name: '',
        parent,
        offset: [0, joints[parent]?.length ?? 0, 0],
        box: DEFAULT_BOX,
        motion: { kind: 'hinge', axis: own },
        limits: [UNLIMITED],
        pose: [radiansOf(degrees)],
        length,
      });
    }
    return { name: 'x', joints, form: 'axis-angle' };
  });

const doubles = (length: number) =>
  fc.array(finite, { minLength: length, maxLength: length }).map((a) => Float64Array.from(a));

export const skin: fc.Arbitrary<Skin> = fc
  .record({ vertices: fc.integer({ min: 1, max: 6 }), joints: fc.integer({ min: 1, max: 3 }) })
  .chain(({ vertices, joints }) =>
    fc.record(
      {
        name: fc.constant('x'),
        positions: doubles(3 * vertices),
        normals: doubles(3 * vertices),
        texcoords: doubles(2 * vertices),
        attachments: attachments(vertices, joints),
        painted: painted(vertices),
        bindings: fc
          .array(vec3, { minLength: joints, maxLength: joints })
          .map((all) => Float64Array.from(all.flatMap((d) => [1, 0, 0, 0, 0, 2, -0, 0, 0, 1e-3, 1, 0, ...d, 1]))),
      },
      { requiredKeys: ['name', 'positions', 'painted', 'bindings'] },
    ),
  )
  .map(({ painted, ...rest }) => ({ ...rest, ...painted }));

const material: fc.Arbitrary<Material> = fc.record(
  { name: fc.oneof(token, fc.constant('')), texture: fileName, color: vec3 },
  { requiredKeys: ['name'] },
);

/** Triangles in some blocks, all with a material but possibly the first. */
function painted(vertices: number): fc.Arbitrary<Pick<Skin, 'triangles' | 'surfaces'>> {
  const triangles = fc.array(fc.nat(vertices - 1), { maxLength: 12 }).map((a) => a.slice(0, a.length - (a.length % 3)));
  const others = fc.array(fc.tuple(material, triangles), { maxLength: 3 });
  return fc.tuple(fc.tuple(fc.option(material), triangles), others).map(([first, more]) => {
    let triangleStart = 0;
    const surfaces = [first, ...more].map(([material, { length }]) => {
      const surface = { ...(material && { material }), triangleStart, triangleCount: length / 3 };
      triangleStart += length / 3;
      return surface;
    });
    return { triangles: Uint32Array.from([first, ...more].flatMap(([, indices]) => indices)), surfaces };
  });
}

function attachments(vertices: number, joints: number): fc.Arbitrary<Attachments> {
  const row = fc.array(fc.tuple(fc.nat(joints - 1), finite), { maxLength: 6 });
  return fc.array(row, { minLength: vertices, maxLength: vertices }).map((rows) => {
    const start = [0];
    for (const r of rows) start.push(start[start.length - 1] + r.length);
    return {
      start: Uint32Array.from(start),
      joints: Uint32Array.from(rows.flat().map(([j]) => j)),
      weights: Float64Array.from(rows.flat().map(([, w]) => w)),
    };
  });
}

const morphRows = (minLength: number): fc.Arbitrary<MorphRows> =>
  fc
    .uniqueArray(fc.oneof(fc.nat(50), fc.nat(0xfffffffe)), { minLength, maxLength: 8 })
    .chain((indices) => doubles(3 * indices.length).map((values) => ({ indices: Uint32Array.from(indices), values })));

export const morph: fc.Arbitrary<Morph> = fc.record({
  name: fc.constant('x'),
  positions: morphRows(1),
  normals: morphRows(0),
});

const tangents = (length: number): fc.Arbitrary<Tangents> =>
  fc.array(fc.tuple(fc.nat(TANGENT_KINDS.length - 1), finite), { minLength: length, maxLength: length }).map((all) => ({
    kinds: Uint8Array.from(all.map(([k]) => k)),
    slopes: Float64Array.from(all.map(([k, s]) => (k === FIXED_TANGENT ? s : 0))),
  }));

const extrapolations = {
  extrapolateIn: fc.constantFrom(...EXTRAPOLATIONS),
  extrapolateOut: fc.constantFrom(...EXTRAPOLATIONS),
};
const keyed: fc.Arbitrary<Channel> = fc.integer({ min: 1, max: 6 }).chain((n) =>
  fc
    .record({
      kind: fc.constant('keys' as const),
      ...extrapolations,
      times: doubles(n).map((times) => times.sort((a, b) => a - b)),
      values: doubles(n),
      tangentsIn: tangents(n),
      tangentsOut: tangents(n),
    })
    .map(asRead),
);
/** As a file of no keys is read. */
const keyless = fc.record({ kind: fc.constant('rest' as const), value: fc.constant(0), ...extrapolations });
const channel = fc.oneof({ weight: 6, arbitrary: keyed }, { weight: 1, arbitrary: keyless });

export const take: fc.Arbitrary<Take> = fc.record({
  name: fc.constant('x'),
  range: ordered,
  channels: fc.array(channel, { minLength: 1, maxLength: 4 }),
});

export const rig: fc.Arbitrary<Rig> = fc.record(
  {
    name: token,
    skeleton: fileName,
    skin: fileName,
    morphs: fc.array(fileName, { maxLength: 3 }),
    animation: fileName,
  },
  { requiredKeys: ['name', 'morphs'] },
);
