/** What exporters leave behind by computing in single precision, and what moves by as little. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { importFile } from '../../src/files/imports.ts';
import type { WholeCharacter } from '../../src/model/files.ts';
import { farthest, posedNodes } from '../helpers/posed.ts';
import { characterOf } from './fbx/read-character.ts';
import { bone, read } from './fbx/small-files.ts';
import { curve, type Fbx, fbxBytes, prop } from './fbx/write-fbx.ts';
import { GltfMaker, glbOf } from './make-gltf.ts';

type Path = 'translation' | 'rotation' | 'scale';
type Track = readonly [path: Path, values: readonly (readonly number[])[]];

const PERSON = 1.7;

/** An armature of that scale around a chain of bones, which all have these tracks. */
async function chain(armature: number, tracks: readonly Track[], bones = 4): Promise<WholeCharacter> {
  const maker = new GltfMaker();
  const length = PERSON / bones / armature;
  const samplers: unknown[] = [];
  const channels: unknown[] = [];
  for (const [path, values] of tracks) {
    const input = maker.add('SCALAR', Float32Array.from(values.keys()));
    const output = maker.add(path === 'rotation' ? 'VEC4' : 'VEC3', Float32Array.from(values.flat()));
    const sampler = samplers.push({ input, output }) - 1;
    for (let b = 1; b <= bones; b++) channels.push({ sampler, target: { node: b, path } });
  }
  const nodes = Array.from({ length: bones + 1 }, (_, b) => ({
    name: `bone${b}`,
    ...(b < bones && { children: [b + 1] }),
    ...(b === 0 ? { scale: [armature, armature, armature] } : { translation: [0, length, 0] }),
  }));
  const made = maker.made({
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes,
    animations: [{ name: 'walk', samplers, channels }],
  });
  const { value } = await importFile('gltf', { fileName: 'x.glb', bytes: glbOf(made), beside: async () => undefined });
  const whole = value?.characters[0];
  if (!whole) throw new Error('not read');
  return whole;
}

const kindsOf = ({ skeleton }: WholeCharacter) => skeleton.joints.slice(1).map(({ motion }) => motion.kind);

const noise = fc.double({ min: -1, max: 1, noNaN: true });
const threeNoises = fc.array(fc.tuple(noise, noise, noise), { minLength: 1, maxLength: 6 });
const armature = fc.constantFrom(0.01, 1, 100);

const QUARTER: Track = [
  'rotation',
  [
    [0, 0, 0, 1],
    [Math.SQRT1_2, 0, 0, Math.SQRT1_2],
  ],
];

describe('noise of single precision in glTF', () => {
  it('scales that tremble about 1 are no scales, and joints stay where they were', async () => {
    await fc.assert(
      fc.asyncProperty(threeNoises, armature, async (noises, factor) => {
        const scales = noises.map((three) => three.map((n) => 1 + 4e-7 * n));
        const [whole, still] = await Promise.all([
          chain(factor, [QUARTER, ['scale', scales]]),
          chain(factor, [QUARTER]),
        ]);
        expect(kindsOf(whole)).toEqual(kindsOf(still));
        expect(farthest(posedNodes(whole, 0, 0.5), posedNodes(still, 0, 0.5))).toBeLessThan(1e-5);
      }),
      { numRuns: 25 },
    );
  });

  it('places that tremble are kept, in the unit of a scaled armature too', async () => {
    await fc.assert(
      fc.asyncProperty(threeNoises, armature, async (noises, factor) => {
        const length = PERSON / 4 / factor;
        const places = noises.map(([x, y, z]) => [x, y, z].map((n, k) => (k === 1 ? length : 0) + 4e-7 * length * n));
        expect(kindsOf(await chain(factor, [QUARTER, ['translation', places]]))).toEqual(
          kindsOf(await chain(factor, [QUARTER])),
        );
      }),
      { numRuns: 25 },
    );
  });

  it('what moves by a ten-thousandth does move', async () => {
    for (const factor of [0.01, 1, 100]) {
      const length = PERSON / 4 / factor;
      const scaled = await chain(factor, [
        [
          'scale',
          [
            [1, 1, 1],
            [1, 1.0001, 1],
          ],
        ],
      ]);
      const moved = await chain(factor, [
        [
          'translation',
          [
            [0, length, 0],
            [0, 1.0001 * length, 0],
          ],
        ],
      ]);
      expect(new Set(kindsOf(scaled))).toEqual(new Set(['compound']));
      expect(new Set(kindsOf(moved))).toEqual(new Set(['translational']));
    }
  });
});

describe('noise of single precision in FBX', () => {
  /** Two bones, of which the lower one doesn't inherit the scale of the upper one, whose scale has these keys. */
  const scaled = (values: readonly number[]): Fbx => ({
    objects: [
      bone(10, 'upper'),
      bone(11, 'lower', prop('InheritType', { int: 2 }), prop('Lcl Translation', 0, 1, 0)),
      { id: 1, kind: 'AnimationStack', name: 'Walk' },
      { id: 2, kind: 'AnimationLayer', name: 'Base' },
      { id: 3, kind: 'AnimationCurveNode', name: 'S', props: [prop('d|X', 1), prop('d|Y', 1), prop('d|Z', 1)] },
      curve(
        4,
        values.map((value, time) => ({ time, value, flags: 4 })),
      ),
    ],
    connections: [
      [10, 0],
      [11, 10],
      [2, 1],
      [3, 2],
      [3, 10, 'Lcl Scaling'],
      [4, 3, 'd|Y'],
    ],
  });

  it('scales that tremble about 1 are no scales, and nothing is said', () => {
    const bytes = fbxBytes(scaled([1.0000003, 0.9999997, 1, 1.0000002]));
    expect(characterOf(bytes).skeleton.joints.map(({ motion }) => motion.kind)).toEqual(['fixed', 'fixed']);
    expect(read(bytes).diagnostics.map(({ code }) => code)).toEqual(['fbx-space']);
  });

  it('a scale that moves by a ten-thousandth is one', () => {
    const { joints } = characterOf(fbxBytes(scaled([1, 1.0001]))).skeleton;
    expect(joints.map(({ motion }) => motion.kind)).toContain('compound');
  });
});
