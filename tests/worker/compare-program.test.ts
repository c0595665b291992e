import { describe, expect, it } from 'vitest';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { compareDumps } from '../../src/worker/compare-program.ts';
import { passageOf } from '../../src/worker/passage.ts';
import type { Progress } from '../../src/worker/protocol.ts';
import { characterOf, OWN } from '../teaching/lesson-files.ts';

const character = characterOf(...OWN.crawler);
const wanted = { local: false, vertices: false, normals: false };
const dumpOf = (values: Float64Array) => ({
  fileName: 'mine.txt',
  assumed: { time: 0.3 },
  dump: {
    name: 'mine',
    blocks: [{ values, starts: Uint32Array.of(0, values.length), lines: Uint32Array.of(1) }],
  },
});

describe('the compare job', () => {
  it('compares, and reports progress that only grows', () => {
    const program = { ...RIGHT_PROGRAM, joints: { ...RIGHT_PROGRAM.joints, concatenation: 'no parent' as const } };
    const { world } = new Evaluator(character).frame(program, 0.3, wanted);
    const seen: Progress[] = [];
    const input = { character, dumps: [dumpOf(world.slice())] };
    const output = compareDumps(structuredClone(input), (progress) => seen.push(progress));
    expect(output.comparison?.causes.map(({ code }) => code)).toContain('no-parent');
    expect(seen.length).toBeGreaterThan(10);
    expect(seen.map(({ done }) => done)).toEqual(seen.map(({ done }) => done).sort((a, b) => a - b));
    expect(() => structuredClone(output, { transfer: passageOf(output).transfer })).not.toThrow();
  });

  it('tells what would fit instead', () => {
    const output = compareDumps({ character, dumps: [dumpOf(Float64Array.of(1, 2))] }, () => undefined);
    expect(output).toMatchObject({
      diagnostics: [{ severity: 'error', code: 'dump-length', file: 'mine.txt', line: 1 }],
    });
    expect(output.comparison).toBeUndefined();
  });
});
