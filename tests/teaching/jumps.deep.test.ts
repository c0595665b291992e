/** Numbers at the very time of a jump: rounding decides which side they are of, so either is right. */
import { describe, expect, it } from 'vitest';
import { shownTake } from '../../src/model/document.ts';
import { CATALOGUE } from '../../src/teaching/catalogue/all.ts';
import type { Targets } from '../../src/teaching/compare/targets.ts';
import { characterOf } from '../../src/teaching/kit/answers.ts';
import { channelValue } from '../../src/teaching/program/curve-rules.ts';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { sidesOf } from '../../src/teaching/program/jumps.ts';
import { type Program, RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { compared, namedIn } from './planted.ts';

const SKEL = 'balljoint root { offset 0 1 0 balljoint arm { offset 1 0 0 balljoint hand { offset 0.5 0.2 0 } } }';
const KEYS = 'keys 4 { 0 0.1 smooth smooth 0.2 0.5 smooth smooth 0.4 -0.2 smooth smooth 0.6 0.7 smooth smooth }';
const STEP = 'keys 4 { 0 0.1 smooth smooth 0.3 0.5 smooth smooth 0.3 -0.2 smooth smooth 0.6 0.7 smooth smooth }';
const channels = Array.from({ length: 12 }, (_, c) => {
  const kind = ['cycle cycle', 'cycle_offset cycle', 'bounce bounce', 'linear cycle'][c % 4];
  return `channel { extrapolate ${kind} ${c === 5 ? STEP : KEYS} }`;
});
const ANIM = `animation { range 0 2 numchannels 12 ${channels.join(' ')} }`;
const character = characterOf(
  ['mine.skel', 'mine.anim'],
  new Map([
    ['mine.skel', SKEL],
    ['mine.anim', ANIM],
  ]),
);
const take = shownTake(character);
/** Of cycles before and after the keys, as far as doubles tell them, and of two keys at one time. */
const JUMPS = [-1.2, -0.6, 0.3, 1.2, 1.8];
const [, , , CYCLE_AT] = JUMPS;

/** Values of all channels at times of no jump, and at the jumps those of a time beside. @param shift of the times at jumps */
function dumpOf(program: Program, beside: number, shift = 0): Targets {
  const plain = Array.from({ length: 40 }, (_, i) => -1.51 + 0.0913 * i);
  const samples = (take?.channels ?? []).flatMap((channel, c) => {
    const value = (time: number) =>
      Number(channelValue(channel, take?.range ?? [0, 1], time, program.curves).toFixed(7));
    return [
      ...plain.map((time) => ({ c, time, value: value(time) })),
      ...JUMPS.map((time) => ({ c, time: time + shift, value: value(time + beside) })),
    ].sort((a, b) => a.time - b.time);
  });
  return {
    frames: [],
    channels: {
      channels: Uint32Array.from(samples, ({ c }) => c),
      times: Float64Array.from(samples, ({ time }) => time),
      values: Float64Array.from(samples, ({ value }) => value),
    },
  };
}

describe('a sample at a jump', () => {
  it.each([
    ['at it, of before', -1e-8, 0],
    ['at it, of after', 1e-8, 0],
    ['less than 1e-9 s before, of after', 1e-8, -5e-10],
    ['less than 1e-9 s after, of before', -1e-8, 5e-10],
  ])('%s, is right', (_, beside, shift) => {
    expect(compared(character, dumpOf(RIGHT_PROGRAM, beside, shift))).toMatchObject({ agrees: true });
  });

  it.each([
    ['0.01 s', 0.01],
    ['1e-6 s, which is a float’s rounding of no such time,', 1e-6],
    ['2e-8 s, of nine digits,', 2e-8],
  ])('%s after it, of before, is wrong, and no mistake is named', (_, shift) => {
    expect(compared(character, dumpOf(RIGHT_PROGRAM, -1e-8, shift))).toMatchObject({ agrees: false, causes: [] });
  });

  it('half-way is wrong, and no mistake is named', () => {
    const [before, after] = [-1e-8, 1e-8].map((beside) => dumpOf(RIGHT_PROGRAM, beside));
    const values = before.channels.values.map((value, i) => (value + after.channels.values[i]) / 2);
    expect(compared(character, { ...before, channels: { ...before.channels, values } })).toMatchObject({
      agrees: false,
      causes: [],
    });
  });

  it.each(
    CATALOGUE.filter(({ subject }) => subject === 'channels').map(({ code, variants }) => [code, variants[0]] as const),
  )('hides no mistake, of whichever side: %s', (code, variant) => {
    for (const beside of [-1e-8, 1e-8]) {
      const found = compared(character, dumpOf(variant.apply(RIGHT_PROGRAM), beside));
      if (!found.agrees) expect(namedIn(found), String(beside)).toContain(code);
    }
  });
});

describe('a frame at a jump', () => {
  const evaluator = new Evaluator(character);
  const frameOf = (program: Program, time: number, of = evaluator): Targets => ({
    frames: [
      {
        time: CYCLE_AT,
        world: of
          .frame(program, time, { local: false, vertices: false, normals: false })
          .world.map((value) => Number(value.toFixed(6))),
      },
    ],
    channels: { channels: new Uint32Array(0), times: new Float64Array(0), values: new Float64Array(0) },
  });

  it.each([-1e-8, 1e-8])('is right on either side: %d s', (beside) => {
    expect(compared(character, frameOf(RIGHT_PROGRAM, CYCLE_AT + beside)).agrees).toBe(true);
  });

  it('is wrong of a time beside', () => {
    expect(compared(character, frameOf(RIGHT_PROGRAM, CYCLE_AT - 0.01)).agrees).toBe(false);
  });

  it.each([CYCLE_AT, CYCLE_AT + 1e-11])('has the unkeyed changes of its time on either side: %d s', (timeSeconds) => {
    const changed = { ...character, unkeyed: { timeSeconds, dofs: [2, 3, 7], values: [3, 1, 0.5] } };
    for (const beside of [-1e-8, 1e-8]) {
      const agrees = (of: Evaluator) => compared(changed, frameOf(RIGHT_PROGRAM, CYCLE_AT + beside, of)).agrees;
      expect([agrees(evaluator), agrees(new Evaluator(changed))]).toEqual([false, true]);
    }
  });

  it.each(['rotation-order', 'no-parent', 'tangent-smooth-mean', 'no-root-translation'])(
    'hides no mistake, of whichever side: %s',
    (code) => {
      const [variant] = CATALOGUE.find((mistake) => mistake.code === code)?.variants ?? [];
      for (const beside of [-0.001, -1e-8, 1e-8]) {
        const found = compared(character, frameOf(variant.apply(RIGHT_PROGRAM), CYCLE_AT + beside));
        if (beside === -0.001) expect(found.causes).toEqual([]);
        else if (!found.agrees) expect(namedIn(found), String(beside)).toContain(code);
      }
    },
  );
});

describe('the rounding of a time', () => {
  it('is that of a float for up to seven digits, else a billionth of a second', () => {
    expect(sidesOf(1.8)[1] - 1.8).toBeCloseTo(2.1e-7, 8);
    expect(sidesOf(1.80000001)[1] - 1.80000001).toBeCloseTo(1e-9, 12);
    expect(sidesOf(0)).toEqual([-1e-9, 1e-9]);
  });
});
