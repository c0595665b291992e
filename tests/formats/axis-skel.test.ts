/** The axis-angle form of `.skel`: reading, writing, and what keeps a skeleton from it. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { degreesOf, radiansOf } from '../../src/formats/skel/degrees.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import { axisAngleObstacle, inAxisAngleForm, inHierarchyForm } from '../../src/model/skeleton/axis-angle.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import { DEFAULT_BOX, type Joint, type Skeleton, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { expectClose } from '../helpers/close.ts';
import { conformance, describeShared, sharedBytes } from '../helpers/shared.ts';
import { axisAngleSkeleton, finite } from './arbitraries.ts';
import { bytesOf, read, readInPieces, told } from './read-in-pieces.ts';

const axskel = (text: string) => readSkel(text, 'arm.axskel');
function sound(text: string): Skeleton {
  const { value, diagnostics } = axskel(text);
  expect(diagnostics).toEqual([]);
  return value?.[0] as Skeleton;
}
const ARM = '0.5 0 1 0 0 1\n1.5 1 0 0 30 1\n1 2 0 0 60 0\n';

interface AxisSkelFk {
  readonly files: readonly {
    readonly file: string;
    readonly reach: number;
    readonly parent: readonly number[];
    readonly sets: readonly { readonly angles: readonly number[]; readonly tips: readonly (readonly number[])[] }[];
  }[];
}

function tipsAt(skeleton: Skeleton, dofs: readonly number[]): number[] {
  const world = new Float64Array(16 * skeleton.joints.length);
  worldMatrices(compileSkeleton(skeleton), Float64Array.from(dofs), world);
  return skeleton.joints.flatMap(({ length = 0 }, j) =>
    [0, 1, 2].map((k) => world[16 * j + 12 + k] + world[16 * j + 4 + k] * length),
  );
}

describeShared('tips of axis-angle skeletons, against the reference', () => {
  it.each(conformance<AxisSkelFk>('axis-skel-fk.json').files)(
    'tips of $file are where the reference has them',
    ({ file, reach, parent, sets }) => {
      const { value, diagnostics } = readSkel(sharedBytes(`data/axis-skel/${file}`), file);
      expect(diagnostics).toEqual([]);
      const skeleton = value?.[0] as Skeleton;
      expect(skeleton.joints.map((joint) => joint.parent)).toEqual(parent);
      sets.forEach(({ angles, tips }, set) => {
        const pose = set === 0 ? filePose(skeleton, 0) : [0, 0, 0, ...angles.map(radiansOf)];
        expectClose(tipsAt(skeleton, pose), tips.flat(), 1e-6 * reach);
      });
    },
  );
});

describeShared('axis-angle files with something wrong', () => {
  it.each([
    ['missing-child.axskel', 'error joint-missing 2:14'],
    ['non-number.axskel', 'error not-a-number 2:7'],
    ['zero-axis.axskel', 'error axis-zero 2:5'],
  ])('%s: %s', (file, expected) => {
    const result = readSkel(sharedBytes(`data/axis-skel/malformed/${file}`), file);
    expect(told(result)).toEqual([expected]);
    expect(result.value).toBeUndefined();
  });
});

describe('reading the axis-angle form', () => {
  it('gives hinges with bones, each at the tip of its parent, angles in radians', () => {
    const skeleton = sound('2 0 3 0 90 2 0 1 0 0 -45 0 .5 0 0 -1 0 0');
    const joint = { name: '', box: DEFAULT_BOX, limits: [UNLIMITED] };
    expect(skeleton).toEqual({
      name: 'arm',
      form: 'axis-angle',
      joints: [
        {
          ...joint,
          parent: -1,
          offset: [0, 0, 0],
          motion: { kind: 'hinge', axis: [0, 3, 0] },
          pose: [Math.PI / 2],
          length: 2,
        },
        {
          ...joint,
          parent: 0,
          offset: [0, 2, 0],
          motion: { kind: 'hinge', axis: [1, 0, 0] },
          pose: [-Math.PI / 4],
          length: 0,
        },
        {
          ...joint,
          parent: 0,
          offset: [0, 2, 0],
          motion: { kind: 'hinge', axis: [0, 0, -1] },
          pose: [0],
          length: 0.5,
        },
      ],
    });
  });

  it('reading the axis-angle form is told by content, whatever the file is called', () => {
    expect(readSkel(ARM, 'arm.skel').value).toEqual(axskel(ARM).value);
    expect(axskel('balljoint root {\n}').value?.[0]).not.toHaveProperty('form');
    expect(read('arm.axskel', ARM).value?.kind).toBe('skel');
  });

  it('takes line ends, blanks and cuts anywhere', () => {
    const messy = `\uFEFF  ${ARM.replace(/ /g, '\r\r\n\t')}\n\n`;
    const { value } = axskel(ARM);
    expect(axskel(messy)).toEqual({ value, diagnostics: [] });
    const bytes = bytesOf(messy);
    const cuts = fc.array(fc.nat(bytes.length), { maxLength: 12 });
    fc.assert(
      fc.property(cuts, (at) => {
        expect(readInPieces('arm.axskel', bytes, at)).toEqual({
          value: { kind: 'skel', skeletons: value },
          diagnostics: [],
        });
      }),
    );
  });

  it('reads trees of any depth, and writes them', () => {
    const depth = 30_000;
    const text = `${'1 1 0 0 1 1\n'.repeat(depth - 1)}1 1 0 0 1 0\n`;
    const skeleton = sound(text);
    expect(skeleton.joints).toHaveLength(depth);
    expect(skeleton.joints[depth - 1].parent).toBe(depth - 2);
    expect(writeSkel([skeleton]).text === text).toBe(true);
  });

  it.each([
    ['1', ['error number-expected 1:2']],
    ['1 0 1 0 0', ['error number-expected 1:10']],
    ['1 0 1 0 0 1', ['error joint-missing 1:11']],
    ['1 0 1 0 0 2\n1 0 1 0 0 1\n1 0 1 0 0 0\n\n', ['error joint-missing 3:11']],
    ['1 0 1 0 0 1e300', ['error joint-missing 1:11']],
    ['1 0 1 0 0 1.5', ['error count-fractional 1:11']],
    ['1 0 1 0 0 -1', ['error count-negative 1:11']],
    ['1 0 1 0 0 many', ['error not-a-number 1:11']],
    ['1e999 0 1 0 0 0', ['error number-too-large 1:1']],
    ['1 0 1 0 nan 0', ['error not-a-number 1:9']],
    ['nan 0 1 0 0 0', ['error not-a-number 1:1']],
    ['1 0 1 0 1,5 0', ['error not-a-number 1:9']],
    ['-1 0 1 0 0 0', ['error length-negative 1:1']],
    ['1 0 -0 0.0 0 0', ['error axis-zero 1:3']],
    ['1 0 1 0 0 0\n1 0 1 0 0 0', ['error trailing 2:1']],
    ['1 0 1 0 0 0 end', ['error trailing 1:13']],
    ['1 0 1 { 0 0', ['error number-expected 1:7']],
    ['x 0 1 0 0 0', ['error not-a-number 1:1']],
    ['', ['error joint-missing 1:1']],
    [
      '-1 0 0 0 0 1\n2 1 zero 0 0 0\n3',
      ['error length-negative 1:1', 'error axis-zero 1:4', 'error not-a-number 2:5', 'error trailing 3:1'],
    ],
  ])('finds what is wrong with %j', (text, expected) => {
    const result = axskel(text);
    expect(told(result)).toEqual(expected);
    expect(result.value).toBeUndefined();
  });

  it('says in words which joint is missing, and who wants it', () => {
    const { diagnostics } = axskel('1 0 1 0 0 2\n0.5 1 0 0 20 0\n');
    expect(diagnostics[0].message).toBe(
      'Expected 2 children of joint #0, as line 1 says, found 1 before the end of the file.',
    );
    expect(diagnostics[0].excerpt).toEqual({ text: '0.5 1 0 0 20 0', caret: 13 });
  });
});

describe('writing the axis-angle form', () => {
  it('brings any such skeleton back, and the same bytes from then on', () => {
    fc.assert(
      fc.property(axisAngleSkeleton, (skeleton) => {
        const { text, diagnostics } = writeSkel([skeleton]);
        expect(diagnostics).toEqual([]);
        const again = axskel(text);
        expect(again).toEqual({ value: [{ ...skeleton, name: 'arm' }], diagnostics: [] });
        expect(writeSkel(again.value ?? []).text).toBe(text);
      }),
      { numRuns: 150 },
    );
  });

  it('brings it back from the hierarchy form too, but for the form', () => {
    fc.assert(
      fc.property(axisAngleSkeleton, (skeleton) => {
        const { text } = writeSkel([inHierarchyForm(skeleton)]);
        const { value = [] } = readSkel(text, 'arm.skel');
        expect(text).toMatch(/^hingejoint \{/);
        expect(value.map(inAxisAngleForm)).toEqual([{ ...skeleton, name: 'arm' }]);
      }),
    );
  });

  it('writes the shortest degrees that read back the same', () => {
    expect([30, -8.4, 0.1, 65, 1e-7, 123456.789].map((d) => degreesOf(radiansOf(d)))).toEqual([
      30, -8.4, 0.1, 65, 1e-7, 123456.789,
    ]);
    expect(degreesOf(Math.PI)).toBe(180);
    expect(Object.is(degreesOf(-0), -0)).toBe(true);
    // Next to the smallest doubles there are, dozens of degrees are the same radians.
    const ordinary = finite.filter((v) => v === 0 || Math.abs(v) > 1e-300);
    fc.assert(
      fc.property(ordinary, (degrees) => {
        const again = degreesOf(radiansOf(degrees));
        const isSame = Object.is(radiansOf(again), radiansOf(degrees));
        if (!isSame || `${again}`.length > `${degrees}`.length) expect.fail(`${degrees} is written as ${again}`);
      }),
      { numRuns: 2000 },
    );
  });

  it('writes any radians to within the last place, and the same from then on', () => {
    const radians = fc.double({ min: -1e3, max: 1e3, noNaN: true });
    fc.assert(
      fc.property(radians, (angle) => {
        const degrees = degreesOf(angle);
        const isNear = Math.abs(radiansOf(degrees) - angle) <= Number.EPSILON * Math.abs(angle);
        if (!isNear || !Object.is(degreesOf(radiansOf(degrees)), degrees))
          expect.fail(`${angle} is written as ${degrees}`);
      }),
      { numRuns: 2000 },
    );
  });

  it('writing the axis-angle form says that names are lost', () => {
    const { joints } = sound(ARM);
    const named: Skeleton = { name: 'arm', form: 'axis-angle', joints: joints.map((j) => ({ ...j, name: 'x' })) };
    const { text, diagnostics } = writeSkel([named]);
    expect(text).toBe(ARM);
    expect(diagnostics.map((d) => `${d.severity} ${d.code}`)).toEqual(['info names-left-out']);
  });

  const arm = sound(ARM);
  const changed = (j: number, change: Partial<Joint>): Skeleton => {
    return { ...arm, joints: arm.joints.map((joint, i) => (i === j ? { ...joint, ...change } : joint)) };
  };
  const { length: _, ...boneless } = arm.joints[1];
  it.each<[string, Skeleton]>([
    ['joint 1 "elbow" is not a hinge.', changed(1, { name: 'elbow', motion: { kind: 'prismatic', axis: [1, 0, 0] } })],
    ['joint 1 has no bone length.', { ...arm, joints: arm.joints.map((joint, j) => (j === 1 ? boneless : joint)) }],
    ["joint 2 is not at its parent's tip.", changed(2, { offset: [0, 1, 0] })],
    ['joint 0 is the root but is not at 0 0 0.', changed(0, { offset: [0, 1, 0] })],
    ['joint 1 has limits.', changed(1, { limits: [{ min: -1, max: 1 }] })],
    ['joint 2 has its own box.', changed(2, { box: { min: [0, 0, 0], max: [1, 1, 1] } })],
    [
      'joint 1 follows another joint.',
      changed(1, { couples: [{ dof: 'r', joint: 0, follows: 'r', gain: 1, offset: 0 }] }),
    ],
  ])('takes the hierarchy form where %s', (why, skeleton) => {
    expect(axisAngleObstacle(skeleton)).toBe(why);
    const { text, diagnostics } = writeSkel([skeleton]);
    expect(text).toMatch(/^hingejoint \{/);
    expect(diagnostics.map((d) => `${d.code}: ${d.message}`)).toEqual([
      `form-changed: arm can't be written in axis-angle form: ${why}`,
    ]);
    expect(readSkel(text, 'arm.axskel').value?.[0].joints).toEqual(skeleton.joints);
  });

  it('takes the hierarchy form for several trees', () => {
    const { text, diagnostics } = writeSkel([arm, arm]);
    expect(text.match(/^hingejoint/gm)).toHaveLength(2);
    expect(diagnostics.map((d) => d.code)).toEqual(['form-changed', 'form-changed']);
  });
});
