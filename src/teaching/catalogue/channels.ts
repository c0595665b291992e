/** Mistakes in the values of channels. */
import { HERMITE, type HermiteBasis } from '../program/curve-rules.ts';
import { finer, inCurves, type Mistake, type Variant } from './mistake.ts';

const SMOOTH_FORMULA = 'm = (v[i+1] − v[i−1]) / (t[i+1] − t[i−1]); at the ends the slope of the segment';
const OFFSET_FORMULA = 'p(t) = p(t − n·P) + n·(v_last − v_first)';
const HERMITE_FORMULA = 'p(u) = a·u³ + b·u² + c·u + d; c = (t₁ − t₀)·m₀';

/** Ways in which a program deals with a negative remainder. */
const MODULO = [
  ['run on', 'the first segment continues backwards'],
  ['hold', 'the value of the first key is held'],
  ['run on first', 'the first segment continues backwards, in mirrored periods too'],
  ['hold first', 'the value of the first key is held, in mirrored periods too'],
] as const;
const SWAPPED = [
  ['columns', 'tan_in and tan_out as they are read'],
  ['slopes', 'the slopes as they are used'],
] as const;
const ROWS = ['a', 'b', 'c', 'd'];
const INPUTS = ['p₀', 'p₁', 'm₀', 'm₁'];

const PAIRS = [
  [0, 1],
  [0, 2],
  [0, 3],
  [1, 2],
  [1, 3],
  [2, 3],
] as const;

/** All known mistakes in channels, each with its variants. */
export const CHANNELS: readonly Mistake[] = [
  {
    code: 'tangent-smooth-mean',
    subject: 'channels',
    sentence: () =>
      "Your smooth tangents are the mean of the two segments' slopes. They should be the slope from the previous key to the next one.",
    formula: SMOOTH_FORMULA,
    variants: [inCurves('', { smooth: 'mean of segments' })],
  },
  {
    code: 'tangent-smooth-halved',
    subject: 'channels',
    sentence: () =>
      'Your smooth tangents are half the difference of the values before and after. It should be divided by the time between those two keys instead of 2.',
    formula: SMOOTH_FORMULA,
    variants: [
      inCurves('', { smooth: 'halved' }),
      finer(inCurves('at the ends the difference of the two values', { smooth: 'halved ends' })),
    ],
  },
  {
    code: 'tangent-smooth-flat-ends',
    subject: 'channels',
    sentence: () =>
      'Your smooth tangents are 0 at the first and last key. They should be the slope of the adjoining segment.',
    formula: SMOOTH_FORMULA,
    variants: [inCurves('', { smoothEnds: 'flat' })],
  },
  {
    code: 'tangent-linear-neighbour',
    subject: 'channels',
    sentence: () =>
      'Your linear tangents use the segment on the other side. In should be the slope of the segment before the key, out that of the segment after it.',
    formula: 'in: (v[i] − v[i−1]) / (t[i] − t[i−1]); out: (v[i+1] − v[i]) / (t[i+1] − t[i])',
    variants: [inCurves('', { linear: 'other side' })],
  },
  {
    code: 'tangents-swapped',
    subject: 'channels',
    sentence: () =>
      'You swap in and out tangents. A key lists time, value, in, out; a segment should use the out of its first key and the in of its second.',
    formula: 'keys { time value tan_in tan_out }',
    variants: SWAPPED.flatMap(([swapped, detail]) => [
      inCurves(detail, { swapped }),
      finer(inCurves(`${detail}, between keys only`, { swapped, swapsInsideOnly: true })),
    ]),
  },
  {
    code: 'tangents-unscaled',
    subject: 'channels',
    sentence: () =>
      "You don't multiply slopes by the length of the segment. They are per second and should be multiplied by t₁ − t₀.",
    formula: HERMITE_FORMULA,
    variants: [inCurves('', { isScaled: false })],
  },
  {
    code: 'tangents-ignored',
    subject: 'channels',
    sentence: () => 'You join keys by straight lines. Each segment should be a cubic Hermite curve.',
    formula: HERMITE_FORMULA,
    variants: [
      inCurves('lines', { between: 'line' }),
      finer(inCurves('lines, also outside', { between: 'line', linearSlope: 'segment' })),
    ],
  },
  {
    code: 'stepped',
    subject: 'channels',
    sentence: () => "You hold the previous key's value. Each segment should be a cubic Hermite curve.",
    formula: HERMITE_FORMULA,
    variants: [inCurves('', { between: 'step' })],
  },
  {
    code: 'extrapolation-ignored',
    subject: 'channels',
    sentence: (detail) => `You hold the end value ${detail}. The channel's extrapolation should be used.`,
    formula: 'extrapolate IN OUT: constant, linear, cycle, cycle_offset, bounce',
    variants: [
      inCurves('before the first and after the last key', { held: 'outside' }),
      finer(inCurves('before the first key', { held: 'before' })),
      finer(inCurves('after the last key', { held: 'after' })),
    ],
  },
  {
    code: 'extrapolation-exchanged',
    subject: 'channels',
    sentence: () =>
      'You swap the extrapolations before and after the keys. The first word should be for the time before the keys, the second for the time after.',
    formula: 'extrapolate IN OUT: IN before the first key, OUT after the last',
    variants: [inCurves('', { sides: 'exchanged' })],
  },
  {
    code: 'cycle-offset-missing',
    subject: 'channels',
    sentence: () => 'Your cycle_offset repeats without its offset. Each period should add v_last − v_first.',
    formula: OFFSET_FORMULA,
    variants: [inCurves('', { cycleOffset: 'none' })],
  },
  {
    code: 'cycle-offset-once',
    subject: 'channels',
    sentence: () =>
      'Your cycle_offset adds its offset once, however far the time is. It should add it for each period, n times.',
    formula: OFFSET_FORMULA,
    variants: [
      inCurves('', { cycleOffset: 'once' }),
      finer(inCurves('before the first key, too', { cycleOffset: 'once added' })),
    ],
  },
  {
    code: 'cycle-offset-sign',
    subject: 'channels',
    sentence: () =>
      'Your cycle_offset subtracts its offset where it should add it. It should have the opposite sign: n times the last value minus the first, n negative before the keys.',
    formula: OFFSET_FORMULA,
    variants: [inCurves('', { cycleOffset: 'subtracted' })],
  },
  {
    code: 'cycle-offset-count',
    subject: 'channels',
    sentence: (detail) =>
      `Your cycle_offset counts its periods off by one, and adds its offset ${detail} times. It should add it n times, with n = 0 between the keys.`,
    formula: OFFSET_FORMULA,
    variants: [
      inCurves('n + 1', { cycleOffset: 'once more' }),
      inCurves('n + 1 after the keys and n − 1 before them', { cycleOffset: 'once further' }),
      inCurves('n − 1', { cycleOffset: 'once less' }),
    ],
  },
  {
    code: 'cycle-offset-before',
    subject: 'channels',
    sentence: () =>
      'Your cycle_offset adds its offset before the first key. There n is negative, so the offset should be subtracted.',
    formula: 'n = ⌊(t − t_first) / P⌋',
    variants: [inCurves('', { cycleOffset: 'always added' })],
  },
  {
    code: 'bounce-as-cycle',
    subject: 'channels',
    sentence: () => 'Your bounce repeats like cycle. Every other period should run backwards.',
    formula: 'n odd: p(t_last − (t − t_first − n·P))',
    variants: [inCurves('', { bounce: 'none' })],
  },
  {
    code: 'bounce-parity',
    subject: 'channels',
    sentence: (detail) =>
      `Your bounce runs backwards in the wrong periods (${detail}). It should run backwards where n is odd.`,
    formula: 'n odd: p(t_last − (t − t_first − n·P))',
    variants: [
      inCurves('even ones', { bounce: 'even periods' }),
      inCurves('odd ones after the keys only', { bounce: 'odd after only' }),
    ],
  },
  {
    code: 'modulo-negative',
    subject: 'channels',
    sentence: (detail) =>
      `Your fmod of a negative time is negative, so ${detail}. Times before the first key should be folded with floor.`,
    formula: 'n = ⌊(t − t_first) / P⌋, t − n·P',
    variants: MODULO.flatMap(([modulo, detail]) => [
      modulo.endsWith('first') ? finer(inCurves(detail, { modulo })) : inCurves(detail, { modulo }),
      finer(inCurves(`${detail}, and periods are counted by floor`, { modulo: `${modulo}, floor` })),
    ]),
  },
  {
    code: 'period-of-range',
    subject: 'channels',
    sentence: () => "You use the range as the period. It should be the time from the channel's first key to its last.",
    formula: 'P = t_last − t_first',
    variants: [
      inCurves("counted from the range's start", { period: 'range' }),
      finer(inCurves("counted from the range's start, end segments continue", { period: 'range, run on' })),
      finer(inCurves('outside the range only', { period: 'range only' })),
      inCurves('counted from the first key', { period: 'length of range' }),
    ],
  },
  {
    code: 'linear-extrapolation-slope',
    subject: 'channels',
    sentence: () =>
      'Your linear extrapolation uses the slope of the end segment. It should use the tangent of the end key.',
    formula: 'tan_in of the first key, tan_out of the last',
    variants: [inCurves('', { linearSlope: 'segment' })],
  },
  {
    code: 'linear-extrapolation-tangent',
    subject: 'channels',
    sentence: (detail) =>
      `Your linear extrapolation continues by the wrong tangent: ${detail}. It should go by tan_in before the first key and by tan_out after the last.`,
    formula: 'tan_in of the first key, tan_out of the last',
    variants: [
      inCurves('the outgoing one before the first key, the incoming one after the last', {
        linearSlope: 'other tangents',
      }),
      finer(inCurves('the incoming one after the last key', { linearSlope: 'other tangent after' })),
      finer(inCurves('the outgoing one before the first key', { linearSlope: 'other tangent before' })),
    ],
  },
  {
    code: 'hermite-basis',
    subject: 'channels',
    sentence: (detail) => `A coefficient of your cubic is wrong: ${detail}.`,
    formula: 'a = 2p₀ − 2p₁ + m₀ + m₁; b = −3p₀ + 3p₁ − 2m₀ − m₁; c = m₀; d = p₀',
    variants: hermiteVariants(),
  },
];

/** Every wrong sign and every exchange within, of rows or of columns; and both reversals. */
function hermiteVariants(): readonly Variant[] {
  const variants: Variant[] = [];
  const seen = new Set([HERMITE.join()]);
  const add = (detail: string, basis: HermiteBasis) => {
    const key = basis.map((value) => value + 0).join();
    if (seen.has(key)) return;
    seen.add(key);
    variants.push(inCurves(detail, { basis }));
  };
  for (let i = 0; i < 16; i++)
    add(
      `sign of ${INPUTS[i % 4]} in ${ROWS[Math.floor(i / 4)]}`,
      HERMITE.map((v, k) => (k === i ? -v : v)),
    );
  for (let row = 0; row < 4; row++) {
    add(
      `sign of ${ROWS[row]}`,
      HERMITE.map((v, k) => (Math.floor(k / 4) === row ? -v : v)),
    );
    add(
      `${ROWS[row]} reversed`,
      HERMITE.map((v, k) => (Math.floor(k / 4) === row ? HERMITE[4 * row + 3 - (k % 4)] : v)),
    );
    for (const [c1, c2] of PAIRS) {
      const [i, j] = [4 * row + c1, 4 * row + c2];
      add(
        `${INPUTS[c1]} and ${INPUTS[c2]} swapped in ${ROWS[row]}`,
        HERMITE.map((v, k) => (k === i ? HERMITE[j] : k === j ? HERMITE[i] : v)),
      );
    }
  }
  for (const [x, y] of PAIRS) {
    const other = (at: number) => (at === x ? y : at === y ? x : at);
    add(
      `${ROWS[x]} and ${ROWS[y]} swapped`,
      HERMITE.map((_, k) => HERMITE[4 * other(Math.floor(k / 4)) + (k % 4)]),
    );
    add(
      `${INPUTS[x]} and ${INPUTS[y]} swapped`,
      HERMITE.map((_, k) => HERMITE[4 * Math.floor(k / 4) + other(k % 4)]),
    );
  }
  for (let c = 0; c < 4; c++)
    add(
      `sign of ${INPUTS[c]}`,
      HERMITE.map((v, k) => (k % 4 === c ? -v : v)),
    );
  const [a, b, c] = [0, 1, 2].map((row) => HERMITE.slice(4 * row, 4 * row + 4));
  add('1 − u for u', [
    ...a.map((value) => -value),
    ...a.map((value, k) => 3 * value + b[k]),
    ...a.map((value, k) => -3 * value - 2 * b[k] - c[k]),
    ...a.map((value, k) => value + b[k] + c[k] + HERMITE[12 + k]),
  ]);
  add(
    'a b c d reversed',
    HERMITE.map((_, k) => HERMITE[4 * (3 - Math.floor(k / 4)) + (k % 4)]),
  );
  add(
    'p₀ p₁ m₀ m₁ reversed',
    HERMITE.map((_, k) => HERMITE[4 * Math.floor(k / 4) + 3 - (k % 4)]),
  );
  add(
    'rows read as columns',
    HERMITE.map((_, k) => HERMITE[4 * (k % 4) + Math.floor(k / 4)]),
  );
  return variants;
}
