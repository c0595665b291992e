import { expect, it } from 'vitest';
import { readSkel } from '../../src/formats/skel/read.ts';
import { conformance, describeShared, sharedBytes } from '../helpers/shared.ts';
import { readAsOpened } from './read-in-pieces.ts';

interface DiagnosticCase {
  readonly file: string;
  readonly with: readonly string[];
  readonly expect: 'error' | 'warning' | 'info' | 'diagnostic' | 'none' | 'none-or-error';
  readonly lines: readonly number[];
  readonly what: string;
}

interface SkeletonCase {
  readonly skel: string;
  readonly joint_count: number;
  readonly names: readonly string[];
  readonly parents: readonly number[];
  readonly offsets: readonly number[][];
  readonly boxmin: readonly number[][];
  readonly boxmax: readonly number[][];
  /** [xmin, xmax, ymin, ymax, zmin, zmax] */
  readonly limits: readonly number[][];
  readonly poses: readonly { readonly name: string; readonly pose: readonly number[][] }[];
}

describeShared('broken files', () => {
  const { cases } = conformance<{ cases: readonly DiagnosticCase[] }>('diagnostics.json');

  it.each(cases)('the broken file $file: $what', ({ file, with: others, expect: expected, lines }) => {
    const { value, diagnostics } = readAsOpened(file, sharedBytes(`data/malformed/${file}`));
    const problems = diagnostics.filter((d) => d.severity !== 'info');
    for (const d of diagnostics) expect(d.file).toBe(file);
    if (others.length > 0) {
      // What is wrong shows only beside the others; the file itself is sound.
      expect(problems).toEqual([]);
      expect(value).toBeDefined();
      return;
    }
    const wanted = diagnostics.filter(({ severity, line }) => {
      const fits = expected === 'diagnostic' ? severity !== 'info' : severity === expected;
      return fits && (lines.length === 0 || lines.includes(line));
    });
    if (expected === 'none') expect(problems).toEqual([]);
    else if (expected !== 'none-or-error') expect(wanted, JSON.stringify(diagnostics)).not.toEqual([]);
    if (expected === 'error') expect(value).toBeUndefined();
    else if (expected !== 'diagnostic' && expected !== 'none-or-error') expect(value).toBeDefined();
    // No complaint about a line that has nothing wrong.
    if (lines.length > 0) for (const d of problems) expect(lines, d.message).toContain(d.line);
  });
});

describeShared('skeletons of the reference', () => {
  const { skeletons } = conformance<{ skeletons: readonly SkeletonCase[] }>('skel-fk.json');

  it.each(skeletons)('$skel is read as it is written', (expected) => {
    const { value } = readSkel(sharedBytes(expected.skel), 'x.skel');
    expect(value).toHaveLength(1);
    const joints = value?.[0].joints ?? [];
    expect(joints).toHaveLength(expected.joint_count);
    expect(joints.map((j) => j.name)).toEqual(expected.names);
    expect(joints.map((j) => j.parent)).toEqual(expected.parents);
    expect(joints.map((j) => plain(j.offset))).toEqual(expected.offsets);
    expect(joints.map((j) => plain(j.box.min))).toEqual(expected.boxmin);
    expect(joints.map((j) => plain(j.box.max))).toEqual(expected.boxmax);
    expect(joints.map((j) => plain(j.limits.flatMap(({ min, max }) => [min, max])))).toEqual(expected.limits);
    expect(joints.map((j) => plain(j.pose))).toEqual(expected.poses.find(({ name }) => name === 'file')?.pose);
  });
});

/** The reference writes -0 as 0. */
function plain(values: readonly number[]): number[] {
  return values.map((v) => v + 0);
}
