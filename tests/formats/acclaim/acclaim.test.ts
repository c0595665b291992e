/** What the files of Acclaim say, and what is told about those that say something else. */
import { describe, expect, it } from 'vitest';
import { eachFrame } from '../../../src/evaluate/bake.ts';
import { bareCharacter } from '../../../src/evaluate/bare-character.ts';
import { endSitePositions } from '../../../src/evaluate/end-sites.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { skeletonNameFor } from '../../../src/files/acclaim-names.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import { ODD_AMC, ODD_ASF, readAmcText, readAsfText, writtenText } from '../../helpers/acclaim.ts';

const told = (diagnostics: readonly { severity: string; code: string; line: number; column: number }[]) =>
  diagnostics.map(({ severity, code, line, column }) => `${severity} ${code} ${line}:${column}`);

describe('an .asf', () => {
  it('has bones as joints, with their DOFs, limits and rest', async () => {
    const { value, diagnostics } = await readAsfText(ODD_ASF);
    expect(diagnostics).toEqual([]);
    const joints = value?.skeleton.joints ?? [];
    expect(joints.map(({ name, parent }) => `${parent} ${name}`)).toEqual([
      '-1 root',
      '0 low',
      '1 rod',
      '2 slide',
      '1 stick',
    ]);
    expect(dofsOf(joints[0].motion).map(({ name }) => name)).toEqual(['tx', 'ty', 'tz', 'rz', 'rx', 'ry']);
    expect(dofsOf(joints[2].motion)).toMatchObject([{ name: 'rx' }, { name: 'l', unit: 'length' }]);
    expect(joints[1].limits).toEqual([
      { min: -3.1, max: 3.1 },
      { min: -2, max: 2 },
      { min: -Infinity, max: Infinity },
    ]);
    expect(joints[1].bone).toMatchObject({ id: '1', kept: ['bodymass 3.5'] });
    expect(joints[4].endSites).toEqual([[0.6, 0.8, 0]]);
    expect(value?.skeleton.acclaim).toMatchObject({ name: 'Oddity', documentation: ['begin and end are words here'] });
  });

  it('is written as it was, so that it is read and written the same again', async () => {
    const first = await readAsfText(ODD_ASF);
    if (!first.value) throw new Error('It was not read.');
    const text = writtenText(first.value, 'x.asf');
    const again = await readAsfText(text);
    expect(again.value).toEqual(first.value);
    expect(again.value && writtenText(again.value, 'x.asf')).toBe(text);
    const degrees = await readAsfText(ODD_ASF.replace('angle rad', 'angle deg').replace('-0.8 1.02', '-80 10.2'));
    expect(degrees.value && writtenText(degrees.value, 'x.asf')).toContain('axis -1.1 -80 10.2 XYZ');
  });

  it.each([
    ['no hierarchy', (t: string) => t.slice(0, t.indexOf(':hierarchy')), 'error hierarchy-missing 0:0'],
    ['no bone', (t: string) => t.replace(/:bonedata[^:]*/, ':bonedata\n'), 'error bone-missing'],
    [
      'a bone without its end',
      (t: string) => t.replace('bodymass 3.5\n  end', 'bodymass 3.5'),
      'error end-missing 16:3',
    ],
    [
      'an unknown bone in the hierarchy',
      (t: string) => t.replace('rod slide\n', 'rod slid\n'),
      'error bone-unknown 55:9',
    ],
    [
      'a bone with two parents',
      (t: string) => t.replace('low rod stick', 'low rod stick\n    rod stick'),
      'error bone-two-parents 55:9',
    ],
    ['a loop', (t: string) => t.replace('low rod stick', 'low stick'), 'warning bone-outside'],
    ['bones in a loop', (t: string) => t.replace('low rod stick', 'low stick\n    slide rod'), 'error bone-loop'],
    ['an unknown DOF', (t: string) => t.replace('dof rx l', 'dof rx q'), 'error dof-unknown 34:12'],
    ['letters that are no order', (t: string) => t.replace('YZX', 'YZY'), 'error order-unknown'],
    ['no number', (t: string) => t.replace('length 1.2\n', 'length 1.2x\n'), 'error not-a-number'],
    ['an infinite number', (t: string) => t.replace('length 1.2\n', 'length 1e999\n'), 'error number-too-large'],
    [
      'a length without a direction',
      (t: string) => t.replace('direction 1 0 0', 'direction 0 0 0'),
      'error direction-zero',
    ],
    [
      'a direction of another length',
      (t: string) => t.replace('direction 1 0 0', 'direction 2 0 0'),
      'warning direction-length',
    ],
    ['too few limits', (t: string) => t.replace('           (-inf inf)\n', ''), 'warning limits-count'],
    ['an unknown keyword', (t: string) => t.replace('position 1', 'place 1'), 'warning keyword-unknown 13:3'],
    [
      'an unknown section',
      (t: string) => t.replace(':hierarchy', ':muscles\nx\n:hierarchy'),
      'warning keyword-unknown',
    ],
    ['two bones of a name', (t: string) => t.replace('name rod', 'name low'), 'error bone-repeated'],
    ['nothing', () => '', 'error file-empty'],
  ])('with %s is told where', async (_, change, expected) => {
    const { value, diagnostics } = await readAsfText(change(ODD_ASF));
    expect(told(diagnostics).join('\n')).toContain(expected);
    expect(value === undefined).toBe(diagnostics.some(({ severity }) => severity === 'error'));
  });

  it('is written with names that are no words of the file', async () => {
    const { value } = await readAsfText(ODD_ASF);
    if (!value) throw new Error('It was not read.');
    const { skeleton } = value;
    const joints = skeleton.joints.map((joint, j) => (j === 1 ? { ...joint, name: 'End' } : joint));
    const again = await readAsfText(writtenText({ ...value, skeleton: { ...skeleton, joints } }, 'x.asf'));
    expect(again.diagnostics).toEqual([]);
    expect(again.value?.skeleton.joints[1]).toEqual({ ...skeleton.joints[1], name: '_End' });
  });

  it('is the same with any line ends', async () => {
    const { value } = await readAsfText(ODD_ASF);
    for (const end of ['\r\n', '\r']) {
      const other = await readAsfText(ODD_ASF.replaceAll('\n', end));
      expect(other.value).toEqual(value);
    }
  });
});

describe('an .amc', () => {
  it('has its values by bones, in any order', async () => {
    const { value, diagnostics } = await readAmcText(ODD_AMC);
    expect(diagnostics).toEqual([]);
    const { samples } = value?.take ?? {};
    expect(samples?.frameSeconds).toBe(1 / 60);
    expect([...(samples?.values ?? [])].slice(0, 16)).toEqual([
      ...[0.4, -0.2, 0.3, 0.5, 0.25, -0.75],
      ...[0.1, 0.2, 0.3, 0.5, 0.25, 0.1, 0.2, 0.3, -0.5, 1],
    ]);
    const lines = ODD_AMC.split('\n');
    const shuffled = [...lines.slice(0, 10), lines[12], lines[10], lines[13], lines[11], ''].join('\r\n');
    expect((await readAmcText(shuffled)).value?.take).toEqual(value?.take);
  });

  it('is written and read to the same digit', async () => {
    const { value } = await readAmcText(ODD_AMC);
    if (!value) throw new Error('It was not read.');
    const text = writtenText(value, 'x_walk.amc');
    expect((await readAmcText(text)).value?.take).toEqual(value.take);
    expect(text).toContain('rod -0.5 -0.125\n');
  });

  it.each([
    ['an unknown bone', (t: string) => t.replace('low 0.2', 'lov 0.2'), 'error bone-unknown 12:1'],
    ['too few values', (t: string) => t.replace('low 0.2 0.1 -0.3', 'low 0.2 0.1'), 'error values-count 12:9'],
    ['too many values', (t: string) => t.replace('low 0.2 0.1 -0.3', 'low 0.2 0.1 -0.3 7'), 'error values-count 12:18'],
    ['a broken line', (t: string) => t.replace('low 0.2 0.1 -0.3', 'low 0.2 0.1\n-0.3'), 'error values-count'],
    ['no number', (t: string) => t.replace('low 0.2', 'low 0,2'), 'error not-a-number 12:5'],
    ['values before the first frame', (t: string) => t.replace('60\n1\n', '60\n'), 'error frame-missing 5:1'],
    ['no frame', (t: string) => t.slice(0, t.indexOf('\n1\n')), 'error frames-none'],
    ['frames that do not rise by one', (t: string) => t.replace('\n2\n', '\n5\n'), 'warning frame-number 10:1'],
    ['a missing bone', (t: string) => t.replace('rod 0.5 0.25\n', ''), 'warning bone-missing'],
    ['a bone twice', (t: string) => t.replace('rod 0.5 0.25\n', 'low 1 2 3\n'), 'warning bone-missing'],
    ['a rate of no length', (t: string) => t.replace('SECOND 60', 'SECOND 1e-320'), 'warning rate-wrong 4:21'],
    ['no rate', (t: string) => t.replace(':SAMPLES-PER-SECOND 60\n', ''), 'info rate-assumed'],
    ['an unknown keyword', (t: string) => t.replace(':RADIANS', ':RADIANS\n:SOMETHING'), 'warning keyword-unknown 4:1'],
  ])('with %s is told where', async (_, change, expected) => {
    const { value, diagnostics } = await readAmcText(change(ODD_AMC));
    expect(told(diagnostics).join('\n')).toContain(expected);
    expect(value === undefined).toBe(diagnostics.some(({ severity }) => severity === 'error'));
  });

  it('keeps the values of a bone that is missing in a frame', async () => {
    const { value } = await readAmcText(ODD_AMC.replace('rod -0.5 -0.125\n', ''));
    const { values = new Float64Array() } = value?.take.samples ?? {};
    expect([...values.subarray(16 + 9, 16 + 11)]).toEqual([0.5, 0.25]);
  });

  it('waits for its skeleton', async () => {
    const { value, diagnostics, isWaiting } = await readAmcText(ODD_AMC, '');
    expect([value, isWaiting]).toEqual([undefined, true]);
    expect(diagnostics).toMatchObject([{ severity: 'error', code: 'skeleton-missing' }]);
  });

  it('waits for another skeleton if the only one has other bones, and other names', async () => {
    const others = ODD_ASF.replaceAll('low', 'high');
    const named = await readAmcText(ODD_AMC, others);
    expect([named.value, named.isWaiting]).toEqual([undefined, undefined]);
    const other = await readAmcText(ODD_AMC, others, ['walk.amc', 'x.asf']);
    expect([other.value, other.isWaiting]).toEqual([undefined, true]);
    expect(told(other.diagnostics).join()).toContain('error bone-unknown 7:1');
    const same = await readAmcText(ODD_AMC, ODD_ASF, ['walk.amc', 'x.asf']);
    expect(same.diagnostics).toContainEqual(
      expect.objectContaining({ code: 'skeleton-assumed', assumed: 'used x.asf, the only one' }),
    );
    expect(told((await readAmcText(ODD_AMC)).diagnostics).join()).not.toContain('skeleton-assumed');
  });

  it('moves the children of a bone that lengthens, and its end', async () => {
    const { value } = await readAmcText(
      ODD_AMC,
      ODD_ASF.replace('low rod stick\n    rod slide', 'low rod stick slide'),
    );
    if (!value?.take.samples) throw new Error('It was not read.');
    const { skeleton, take } = value;
    const rod = skeleton.joints.findIndex(({ name }) => name === 'rod');
    const compiled = compileSkeleton(skeleton);
    const world = new Float64Array(16 * compiled.jointCount);
    const lengths: number[] = [];
    eachFrame(bareCharacter(skeleton, take), value.take.samples, (dofs) => {
      worldMatrices(compiled, dofs, world);
      const end = endSitePositions(skeleton, world, dofs).find(({ joint }) => joint === rod);
      lengths.push(Math.hypot(...(end?.position ?? []).map((v, k) => v - world[16 * rod + 12 + k])));
    });
    expect(lengths[0]).toBeCloseTo(2.25, 12);
    expect(lengths[1]).toBeCloseTo(1.875, 12);
  });
});

it.each([
  ['01_01.amc', ['0.asf', '01.asf', '02.asf'], '01.asf'],
  ['07_05-walk.amc', ['06-walk.asf', '07-walk.asf'], '07-walk.asf'],
  ['walk.amc', ['anyone.asf'], 'anyone.asf'],
  ['walk.amc', ['a.asf', 'b.asf'], undefined],
  ['A_1.AMC', ['b.asf', 'a.asf'], 'a.asf'],
])('the skeleton of %s among %j is %s', (name, skeletons, expected) => {
  expect(skeletonNameFor(name, skeletons)).toBe(expected);
});
