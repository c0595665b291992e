/** What the walker wears and carries: a scarf, a pack and a bedroll. */
import { along, around, loft, type Section } from '../shape/mesh.ts';
import { chainWeights, mixWeights } from '../shape/weights.ts';
import { at, bend, bentTube, joint, level, only, rowsOf, type WalkerShape } from './body-parts.ts';

/** A ring about the neck; its tube is the loft, closed on itself through a fold at the back. */
const scarf: WalkerShape = {
  name: 'scarf',
  point: (angle, v) => {
    // Here `angle` runs about the neck and v over and under the roll: 0 and 1 are both on its inside.
    const b = (v - 0.5) * 2 * Math.PI;
    const drop = 0.02 * Math.cos(angle);
    const thick = 0.066 + 0.008 * Math.cos(3 * angle);
    const out = thick * Math.cos(b);
    return [
      Math.sin(angle) * (0.13 + out),
      1.14 - drop + 0.95 * thick * Math.sin(b),
      -0.004 + Math.cos(angle) * (0.124 + out),
    ];
  },
  angles: around(16),
  rows: along(6),
  startPole: false,
  endPole: false,
  weights: () => mixWeights(only('chest'), only('neck'), 0.45),
};

const scarfTailSections = bentTube(
  [
    [0.07, 1.12, 0.15],
    [0.09, 1.06, 0.195],
    [0.095, 1.0, 0.212],
    [0.1, 0.93, 0.222],
    [0.1, 0.86, 0.232],
    [0.1, 0.79, 0.24],
    [0.1, 0.772, 0.241],
  ],
  [
    [0.03, 0.012],
    [0.044, 0.016],
    [0.048, 0.015],
    [0.052, 0.014],
    [0.056, 0.013],
    [0.058, 0.012],
    [0.05, 0.002],
  ],
);
const scarfTail: WalkerShape = {
  name: 'scarfTail',
  point: loft(scarfTailSections),
  angles: around(8),
  rows: rowsOf(scarfTailSections),
  startPole: false,
  endPole: false,
  weights: (p) =>
    chainWeights(-p[1], joint('chest'), [bend('scarf_1', -1.07, 0.04), bend('scarf_2', -at('scarf_2')[1], 0.06)]),
};

const packSections = [
  level(0.755, 0.001, 0.001, -0.275),
  level(0.757, 0.12, 0.06, -0.275, 3),
  level(0.79, 0.17, 0.098, -0.272, 3.4),
  level(0.87, 0.182, 0.108, -0.27, 3.4),
  level(0.96, 0.178, 0.105, -0.265, 3.4),
  level(1.04, 0.162, 0.092, -0.26, 3.4),
  level(1.075, 0.12, 0.065, -0.258, 3),
  level(1.078, 0.001, 0.001, -0.258),
];
const pack: WalkerShape = {
  name: 'pack',
  point: loft(packSections),
  angles: around(14),
  rows: rowsOf(packSections),
  startPole: true,
  endPole: true,
  weights: () => only('pack'),
};

/** Across the top of the pack: the loft runs from right to left. */
const bedrollSections = [-0.2, -0.199, -0.1, 0.1, 0.199, 0.2].map((x, i): Section => {
  const r = i === 0 || i === 5 ? 0.001 : 0.066;
  return { at: [x, 1.115, -0.285], side: [0, r, 0], front: [0, 0, -r] };
});
const bedroll: WalkerShape = {
  name: 'bedroll',
  point: loft(bedrollSections),
  angles: around(10),
  rows: [0, 0.2, 0.23, 0.77, 0.8, 1],
  startPole: true,
  endPole: true,
  weights: () => only('pack'),
};

export const GEAR: readonly WalkerShape[] = [scarf, scarfTail, pack, bedroll];
