/** Models as a format can hold them, for fast-check. */
import fc from 'fast-check';
import type { Vec3 } from '../../src/math/vec3.ts';
import { type Channel, type ChannelClip, EXTRAPOLATIONS, FIXED, type Tangents } from '../../src/model/clip.ts';
import type { Morph, MorphRows } from '../../src/model/morph.ts';
import type { Rig } from '../../src/model/rig.ts';
import { EULER_ORDERS, type Joint, type Skeleton, UNLIMITED } from '../../src/model/skeleton.ts';
import type { Attachments, Skin } from '../../src/model/skin.ts';

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
  fc.string({ unit: 'binary', minLength: 1, maxLength: 8 }).filter((s) => /^[^ \t\r\n{}]+$/.test(s) && wellFormed(s)),
);
const fileName = fc
  .oneof(
    token,
    fc.string({ unit: 'binary', maxLength: 12 }).filter((s) => wellFormed(s)),
    fc.constantFrom('my file.skel', '', 'a{b}.skin', 'skin', ' x', 'x.morph y'),
  )
  .filter((s) => !/[\r\n"]/.test(s));

function wellFormed(text: string): boolean {
  return !/\p{Surrogate}/u.test(text);
}

const joint = (index: number): fc.Arbitrary<Joint> =>
  fc.record({
    name: fc.oneof(token, fc.constant('')),
    parent: index === 0 ? fc.constant(-1) : fc.nat(index - 1),
    offset: vec3,
    box: fc.oneof(
      fc.constant({ min: [-0.1, -0.1, -0.1] as Vec3, max: [0.1, 0.1, 0.1] as Vec3 }),
      fc.record({ min: vec3, max: vec3 }),
    ),
    motion: fc.constantFrom(...EULER_ORDERS).map((order) => ({ kind: 'ball' as const, order })),
    limits: fc.tuple(
      ...Array.from({ length: 3 }, () => fc.oneof(fc.constant(UNLIMITED), fc.record({ min: finite, max: finite }))),
    ),
    pose: fc.oneof(fc.constant([0, 0, 0]), fc.tuple(finite, finite, finite)),
  });

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
    return { name: 'x', joints: joints.map((j, i) => ({ ...j, parent: parents[i] })) };
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
        material: fc.record({ name: fc.oneof(token, fc.constant('')), texture: fileName }, { requiredKeys: ['name'] }),
        attachments: attachments(vertices, joints),
        triangles: fc
          .array(fc.nat(vertices - 1), { maxLength: 12 })
          .map((a) => Uint32Array.from(a.slice(0, a.length - (a.length % 3)))),
        bindings: fc
          .array(vec3, { minLength: joints, maxLength: joints })
          .map((all) => Float64Array.from(all.flatMap((d) => [1, 0, 0, 0, 0, 2, -0, 0, 0, 1e-3, 1, 0, ...d, 1]))),
      },
      { requiredKeys: ['name', 'positions', 'triangles', 'bindings'] },
    ),
  );

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
  fc.array(fc.tuple(fc.nat(3), finite), { minLength: length, maxLength: length }).map((all) => ({
    kinds: Uint8Array.from(all.map(([k]) => k)),
    slopes: Float64Array.from(all.map(([k, s]) => (k === FIXED ? s : 0))),
  }));

const channel: fc.Arbitrary<Channel> = fc.nat(6).chain((n) =>
  fc.record({
    extrapolateIn: fc.constantFrom(...EXTRAPOLATIONS),
    extrapolateOut: fc.constantFrom(...EXTRAPOLATIONS),
    times: doubles(n).map((times) => times.sort((a, b) => a - b)),
    values: doubles(n),
    tangentsIn: tangents(n),
    tangentsOut: tangents(n),
  }),
);

export const clip: fc.Arbitrary<ChannelClip> = fc.record({
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
