/** Characters of any joints with any curves and extrapolation, some with a skin and morphs. */
import fc from 'fast-check';
import type { Character } from '../../src/model/document.ts';
import { rootDofCount } from '../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import { type Skeleton, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { EXTRAPOLATIONS, type KeyedChannel } from '../../src/model/takes/take.ts';
import { FIXED_TANGENT } from '../../src/model/takes/tangent-kinds.ts';
import { motion } from '../formats/arbitraries.ts';
import { character, joint, skin } from '../helpers/builders.ts';

const value = fc.double({ min: -2, max: 2, noNaN: true });
const extrapolation = fc.constantFrom(...EXTRAPOLATIONS);

/** Values around `rest`, so that scales are not 0. */
const channel = (rest: number) =>
  fc
    .record({
      times: fc.array(fc.integer({ min: -8, max: 16 }), { minLength: 1, maxLength: 4 }),
      values: fc.array(value, { minLength: 4, maxLength: 4 }),
      slopes: fc.array(value, { minLength: 8, maxLength: 8 }),
      kinds: fc.array(fc.integer({ min: 0, max: 3 }), { minLength: 8, maxLength: 8 }),
      extrapolateIn: extrapolation,
      extrapolateOut: extrapolation,
    })
    .map(({ times, values, slopes, kinds, extrapolateIn, extrapolateOut }): KeyedChannel => {
      const sorted = [...times].sort((a, b) => a - b);
      const tangents = (from: number) => ({
        kinds: Uint8Array.from(sorted, (_, k) => kinds[from + k]),
        slopes: Float64Array.from(sorted, (_, k) => (kinds[from + k] === FIXED_TANGENT ? slopes[from + k] : 0)),
      });
      return {
        kind: 'keys',
        extrapolateIn,
        extrapolateOut,
        times: Float64Array.from(sorted, (t) => t / 8),
        values: Float64Array.from(sorted, (_, k) => rest + values[k] * (rest === 1 ? 0.3 : 1)),
        tangentsIn: tangents(0),
        tangentsOut: tangents(4),
      };
    });

/** Vertices of the skin, and morphs. */
const VERTICES = 6;
const MORPHS = 2;

/** A skin whose vertices hang on two joints each, or one. */
const skinOn = ({ joints }: Skeleton) => {
  const places = fc.array(value, { minLength: 3 * VERTICES, maxLength: 3 * VERTICES });
  const pairs = fc.array(
    fc.tuple(fc.nat(joints.length - 1), fc.nat(joints.length - 1), fc.double({ min: 0.1, max: 0.9, noNaN: true })),
    { minLength: VERTICES, maxLength: VERTICES },
  );
  return fc.tuple(places, pairs).map(([positions, attached]) =>
    skin('any', joints.length - 1, {
      // One of them is away from the joints, so that the character has a size.
      positions: Float64Array.from([...positions.slice(3), 1, 1, 1]),
      normals: Float64Array.from({ length: 3 * VERTICES }, (_, i) => (i % 3 === 2 ? 1 : 0)),
      attachments: {
        start: Uint32Array.from({ length: VERTICES + 1 }, (_, v) => 2 * v),
        joints: Uint32Array.from(attached.flatMap(([a, b]) => [b, a])),
        weights: Float64Array.from(attached.flatMap(([, , part]) => [part, 1 - part])),
      },
    }),
  );
};

/** A morph of some vertices with weights far above 1. */
const morphed = fc
  .tuple(
    fc.uniqueArray(fc.nat(VERTICES - 1), { minLength: 1 }),
    fc.array(value, { minLength: 18, maxLength: 18 }),
    channel(0),
  )
  .map(([vertices, values, by]) => ({
    positions: { indices: Uint32Array.from(vertices), values: Float64Array.from(values.slice(0, 3 * vertices.length)) },
    channel: { ...by, values: by.values.map((weight) => 6 * weight) },
  }));

/** Keys are at eighths of a second, where values may jump. */
export const anyone = fc
  .array(motion, { minLength: 1, maxLength: 4 })
  // Pitches and axes of 1e300 leave every program's floats.
  .filter((all) => all.every((of) => of.kind !== 'screw' || Math.abs(of.pitch) < 10))
  .map((motions): Skeleton => {
    const joints = motions.map((of, i) =>
      joint(i - 1, {
        name: `j${i}`,
        offset: [0, 1, 0.2],
        motion: of,
        limits: dofsOf(of).map((_, d) => (d === 0 ? { min: -1.5, max: 1.5 } : UNLIMITED)),
        pose: dofsOf(of).map(({ rest }) => rest),
      }),
    );
    return { name: 'any', joints };
  })
  .chain((skeleton) => {
    const rests = [
      ...Array.from({ length: rootDofCount(skeleton) }, () => 0),
      ...skeleton.joints.flatMap(({ motion: of }) => dofsOf(of).map(({ rest }) => rest)),
    ];
    return fc.tuple(
      fc.constant(skeleton),
      fc.tuple(...rests.map(channel)),
      fc.option(fc.tuple(skinOn(skeleton), fc.array(morphed, { minLength: MORPHS, maxLength: MORPHS })), { freq: 2 }),
    );
  })
  .map(([skeleton, channels, body]): Character => {
    const [own, morphs] = body ?? [undefined, []];
    return character({
      name: 'any',
      skeleton,
      ...(own && { skins: [own] }),
      morphs: morphs.map(({ positions }, m) => ({ name: `m${m}`, positions, normals: NOTHING })),
      takes: [{ name: 'take', range: [-0.5, 2.75], channels: [...channels, ...morphs.map((each) => each.channel)] }],
      shownTake: 0,
    });
  });

const NOTHING = { indices: new Uint32Array(0), values: new Float64Array(0) };
