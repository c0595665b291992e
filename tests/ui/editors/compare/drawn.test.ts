import { describe, expect, it } from 'vitest';
import { readDump } from '../../../../src/formats/dump/read.ts';
import { multiplyAffine } from '../../../../src/math/mat4.ts';
import { jointMarks } from '../../../../src/teaching/compare/joint-marks.ts';
import {
  comparedParts,
  errorsOfSkin,
  fillHeat,
  heatTop,
  tellsOwn,
  theirJoints,
} from '../../../../src/ui/editors/compare/drawn.ts';
import type { ShownComparison } from '../../../../src/ui/state/dump-comparison.ts';
import { compareDumps } from '../../../../src/worker/compare-program.ts';
import { describeShared, sharedBytes } from '../../../helpers/shared.ts';
import { characterOf, OWN, SHARED } from '../../../teaching/lesson-files.ts';

/** The first frame of what is compared. */
function compared(paths: readonly string[], text: Uint8Array | string, time?: number): ShownComparison {
  const { value } = readDump(text, 'mine.txt');
  if (!value) throw new Error('No dump.');
  const character = characterOf(...paths);
  const input = { character, dumps: [{ fileName: 'mine.txt', dump: value, assumed: { time } }], tolerance: 1e-4 };
  const { comparison, targets } = compareDumps(input, () => undefined);
  if (!comparison || !targets) throw new Error('Nothing was compared.');
  const result = { comparison, targets, character, tolerance: 1e-4 };
  return { result, index: 0, theirs: targets.frames[0], frame: comparison.frames[0] };
}

const dumpOf = (name: string) => sharedBytes(`conformance/compare/${name}`);

describeShared('what is drawn of the reference’s dumps', () => {
  it('a joint has the verdict that the comparison gives it', () => {
    const shown = compared(SHARED.lafan, dumpOf('d020.txt'), 0.199998);
    const verdicts = jointMarks(shown.frame, 1e-4);
    expect(verdicts).toHaveLength(22);
    expect(verdicts[0]).toBe('own');
    expect(new Set(verdicts.slice(1))).toEqual(new Set(['inherited']));
    expect([tellsOwn(shown), comparedParts(shown)]).toEqual([true, ['joints']]);
  });

  it('of positions only it is told which joints differ', () => {
    const shown = compared(SHARED.wasp, dumpOf('d012.txt'), 1.15);
    const verdicts = jointMarks(shown.frame, 1e-4);
    const wrong = [...shown.frame.jointErrors.keys()].filter((j) => shown.frame.jointErrors[j] > 1e-4);
    expect(tellsOwn(shown)).toBe(false);
    expect(wrong.length).toBeGreaterThan(0);
    expect(verdicts.flatMap((verdict, j) => (verdict === 'differs' ? [j] : []))).toEqual(wrong);
    expect(new Set(verdicts)).toEqual(new Set(['agrees', 'differs']));
    const { skeleton } = shown.result.character;
    expect(skeleton && theirJoints(skeleton, shown)).toBe(shown.theirs.positions);
  });

  it('vertices have the colours of their errors, the worst has the brightest', () => {
    const shown = compared(SHARED.nine, dumpOf('d025.txt'));
    const errors = errorsOfSkin(shown.frame);
    const heat = new Float32Array(errors.length);
    const top = heatTop(shown);
    const worst = fillHeat(errors, 1e-4, top, heat);
    expect(comparedParts(shown)).toEqual(['skin']);
    expect(worst).toBe(errors.indexOf(Math.max(...errors)));
    expect(top).toBeGreaterThanOrEqual(errors[worst ?? -1]);
    expect(top).toBeLessThan(2.6 * errors[worst ?? -1]);
    expect(Math.max(...heat.map((part, v) => Math.abs(part - errors[v] / top)))).toBeLessThan(1e-7);
  });
});

describe('what is drawn of a comparison', () => {
  it('of local matrices the other program’s skeleton is their products', () => {
    const character = characterOf(...OWN.crawler);
    const joints = character.skeleton?.joints ?? [];
    const row = (j: number) => [1, 0, 0, 0.5 * j, 0, 1, 0, 1, 0, 0, 1, 0.25, 0, 0, 0, 1];
    const text = `local\n${joints.map((_, j) => row(j).join(' ')).join('\n')}`;
    const shown = compared(OWN.crawler, text);
    const made = character.skeleton && theirJoints(character.skeleton, shown);
    const { local } = shown.theirs;
    if (!made || !local) throw new Error('No local matrices.');
    const expected = new Float64Array(16);
    joints.forEach(({ parent }, j) => {
      if (parent < 0) expected.set(local.subarray(16 * j, 16 * j + 16));
      else multiplyAffine(made, 16 * parent, local, 16 * j, expected, 0);
      expect([...made.subarray(16 * j, 16 * j + 16)]).toEqual([...expected]);
    });
    expect(made[12 + 16 * 2]).toBeGreaterThan(0);
  });

  it('errors that aren’t finite are as bright as the largest, and worse than it', () => {
    const heat = new Float32Array(5);
    const errors = Float64Array.of(0, 0.25, Number.POSITIVE_INFINITY, 0.5, Number.NaN);
    expect([2, 4]).toContain(fillHeat(errors, 1e-4, 0.5, heat));
    expect([...heat]).toEqual([0, 0.5, 1, 1, 1]);
  });

  it('errors within the tolerance have no worst vertex, and stay dark', () => {
    const heat = new Float32Array(3);
    expect(fillHeat(Float64Array.of(0, 2e-8, 1e-8), 1e-4, 1e-4, heat)).toBeUndefined();
    expect(Math.max(...heat)).toBeLessThan(0.001);
  });

  it('the scale of vertices is the same at all times that were compared, and that of the tolerance if all agree', () => {
    const frameOf = (...vertexErrors: number[]) => {
      const frame: Partial<ShownComparison['frame']> = {
        vertexErrors: Float64Array.from(vertexErrors),
        normalErrors: new Float64Array(0),
      };
      // Only its errors are read.
      return frame as ShownComparison['frame'];
    };
    const shownOf = (...frames: ShownComparison['frame'][]) => {
      const result = { ...compared(OWN.crawler, 'positions\n'.concat('0 0 0\n'.repeat(joints))).result };
      const comparison = { ...result.comparison, frames };
      const all = { ...result, comparison };
      return frames.map(
        (frame, index): ShownComparison => ({ result: all, index, theirs: all.targets.frames[0], frame }),
      );
    };
    const joints = characterOf(...OWN.crawler).skeleton?.joints.length ?? 0;
    const [first, second] = shownOf(frameOf(0, 0.015), frameOf(0.3, Number.POSITIVE_INFINITY));
    expect([heatTop(first), heatTop(second)]).toEqual([0.5, 0.5]);
    expect(shownOf(frameOf(0, 1e-9)).map(heatTop)).toEqual([1e-4]);
  });
});
