import { describe, expect, it } from 'vitest';
import { FORMAT_KINDS, type FormatKind, factsOf, isSaved, KINDS, READABLE_EXTENSIONS } from '../../src/files/kinds.ts';
import { type FetchedKind, formatOf } from '../../src/files/readers.ts';
import { outputOf } from '../../src/files/save/output.ts';
import { WRITERS } from '../../src/files/writers.ts';
import type { FileContent } from '../../src/model/files.ts';
import { type Joint, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { read } from '../formats/read-in-pieces.ts';
import { character, joint, morph, skeleton, skin, takeOfValues } from '../helpers/builders.ts';
import { bvhJoint, captureOf } from '../helpers/bvh.ts';

const HINGE: Joint = {
  ...joint(-1, { name: '', offset: [0, 0, 0] }),
  motion: { kind: 'hinge', axis: [0, 0, 1] },
  limits: [UNLIMITED],
  pose: [0],
  length: 1,
};

/** A file that is not written here, and what it is read as. */
interface GivenFile {
  readonly bytes: Uint8Array | string;
  readonly content: FileContent;
}

/** Content of each kind, or a file if it is only read. */
const EXAMPLES: Readonly<Record<Exclude<FormatKind, FetchedKind>, FileContent | GivenFile>> = {
  skel: { kind: 'skel', skeletons: [skeleton(2)] },
  axskel: { kind: 'skel', skeletons: [{ name: 'x', joints: [HINGE], form: 'axis-angle' }] },
  skin: { kind: 'skin', skin: skin() },
  morph: { kind: 'morph', morph: morph('x') },
  anim: { kind: 'anim', take: takeOfValues('x', [1]) },
  rig: { kind: 'rig', rig: { name: 'x', skeleton: 'x.skel', morphs: [] } },
  bvh: {
    kind: 'bvh',
    captures: [captureOf({ name: 'x', joints: [bvhJoint(-1, ['rx'], { name: 'hips' })] }, [[0], [5]])],
  },
  pose: { kind: 'pose', poses: [{ name: 'x', joints: [], weights: [] }] },
  markers: {
    kind: 'markers',
    markers: [
      { timeSeconds: 0.5, label: 'step' },
      { timeSeconds: 1, endSeconds: 2.5, label: 'a "quote"' },
    ],
  },
  sets: {
    kind: 'sets',
    sets: {
      sets: [
        { name: 'arm', color: '#4a90e2', joints: ['arm_l', '#7'] },
        { name: 'a "quote"', joints: [] },
      ],
      locked: [{ joint: 'shin_l', dofs: ['ry', 'rz'] }],
    },
  },
  layers: {
    kind: 'layers',
    layers: {
      base: 'walk.base.anim',
      flattened: { file: 'walk.anim', sha256: '0f'.repeat(32) },
      layers: [
        {
          ...{ name: 'arm', file: 'walk.arm.anim', mode: 'override', weight: 0.5, mute: true, solo: false },
          ...{ joints: ['arm_l', '#7'], root: true, morphs: false },
        },
      ],
    },
  },
  limbs: {
    kind: 'limbs',
    limbs: {
      limbs: [
        {
          ...{ name: 'leg', joints: ['thigh', '#7', 'foot'], tip: [0, -0.1, 0.2], orient: true },
          bend: { dof: 'rx', sign: -1 },
        },
      ],
      base: 'walk.base.anim',
      flattened: { file: 'walk.anim', sha256: '0f'.repeat(32) },
      goals: [
        { limb: 'leg', space: 'world', channels: { tx: { curve: 1 } } },
        {
          limb: 'arm',
          space: [
            [0, 'world'],
            [1.5, '#3'],
          ],
          channels: {},
        },
      ],
    },
  },
  attach: {
    kind: 'attach',
    attach: {
      base: 'sword.base.anim',
      flattened: { file: 'sword.anim', sha256: '0f'.repeat(32) },
      attached: [
        {
          ...{ character: 'walker', joint: '#7', span: [0.5, 2] },
          offset: { position: [0, -0.1, 0.2], rotation: [1, 0, 0.5] },
        },
      ],
    },
  },
  dump: {
    bytes: 'world\n0 1 2\n',
    content: {
      kind: 'dump',
      dump: {
        name: 'x',
        blocks: [
          {
            holds: 'world',
            values: Float64Array.of(0, 1, 2),
            starts: Uint32Array.of(0, 3),
            lines: Uint32Array.of(2),
          },
        ],
      },
    },
  },
  texture: {
    bytes: Uint8Array.of(1, 2),
    content: { kind: 'texture', texture: { name: 'x.bmp', mime: 'image/bmp', bytes: Uint8Array.of(1, 2) } },
  },
};

describe('the list of kinds of files', () => {
  it('finds a format by the end of a name, in any case', () => {
    expect(formatOf('wasp.skel')?.kind).toBe('skel');
    expect(formatOf('a/b.c/WASP.Walk.ANIM')?.kind).toBe('anim');
    expect(formatOf('skin')).toBeUndefined();
    expect(formatOf('head.BMP')?.kind).toBe('texture');
    expect(formatOf('head.txt')?.kind).toBe('dump');
    expect(formatOf('head.md')).toBeUndefined();
  });

  it('the list of formats has each extension once', () => {
    expect(new Set(READABLE_EXTENSIONS).size).toBe(READABLE_EXTENSIONS.length);
  });

  // Files of other programs have tests of their own, in tests/import.
  const streamed = FORMAT_KINDS.filter((kind) => kind in EXAMPLES) as readonly (keyof typeof EXAMPLES)[];

  it.each(streamed)('a file of kind %s is read, and what is written is read and written the same again', (kind) => {
    const name = `x.${KINDS[kind].extensions[0]}`;
    const example = EXAMPLES[kind];
    const bytes = 'bytes' in example ? example.bytes : writtenAs(name, example);
    const { value, diagnostics } = read(name, bytes);
    expect(diagnostics).toEqual([]);
    expect(value?.kind).toBe(KINDS[kind].content);
    expect(isSaved(kind)).toBe(!('bytes' in example));
    if ('bytes' in example) expect(value).toEqual(example.content);
    else expect(value && writtenAs(name, value)).toEqual(bytes);
    expect(value && Object.keys(factsOf(value))).not.toEqual([]);
  });

  it('the list of formats writes no picture', () => {
    const texture = { name: 'a.png', mime: 'image/png', bytes: new Uint8Array(0) };
    expect(() => writtenAs('a.png', { kind: 'texture', texture })).toThrow('There is no format for a.png.');
  });
});

function writtenAs(name: string, content: FileContent): Uint8Array {
  const output = outputOf({ name, content: () => content });
  const pieces = [...output.pieces()].map((piece) => (typeof piece === 'string' ? Buffer.from(piece) : piece));
  expect(output.diagnostics()).toEqual([]);
  return new Uint8Array(Buffer.concat(pieces));
}

it('the save dialog is told the range that an animation is saved with', () => {
  const take = { ...takeOfValues('walk', [1]), range: [0, 6.4] } as const;
  const told = WRITERS.anim.detail(character({ takes: [take], shownTake: 0 }), 30);
  expect(told).toContainEqual({ range: [0, 6.4] });
});
