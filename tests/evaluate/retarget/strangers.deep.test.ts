/** Takes of humanoids of kinds that no file here has, retargeted to each other. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { retargeted } from './captures.ts';
import { type Doing, type Looks, NAMINGS, RESTS, stranger, strangersFit, UNITS } from './strangers.ts';

/** Degrees, medians over the take: each segment of arms and legs, feet, whose soles are flat, hands; and at any frame. */
const LIMBS = 6;
const FEET = 35;
const HANDS = 25;
const TIPS = 55;

const number = (min: number, max: number) => fc.double({ min, max, noNaN: true });

const anyLooks: fc.Arbitrary<Looks> = fc.record({
  naming: fc.constantFrom(...NAMINGS),
  rest: fc.constantFrom(...RESTS),
  up: fc.constantFrom('y', 'z'),
  unit: fc.constantFrom(...UNITS),
  isQuaternion: fc.boolean(),
  hasOwnAxes: fc.boolean(),
  hasFingers: fc.boolean(),
  hasCollars: fc.boolean(),
  hasMoreSpine: fc.boolean(),
  hasToes: fc.boolean(),
  leg: number(0.5, 1.1),
  arm: number(0.55, 0.75),
  thigh: number(0.44, 0.56),
  slope: number(0, 1),
  seed: fc.nat(),
});

const anyDoing: fc.Arbitrary<Doing> = fc.record({
  stride: number(0, 0.5),
  crouch: number(0, 0.4),
  lean: number(-0.1, 0.5),
  kick: fc.oneof(fc.constant(0), number(0, 2)),
  arms: number(-0.2, 1.5),
  turn: number(-1, 1),
  tumble: fc.oneof(fc.constant(0), number(-2, 2)),
});

/** Small steps, which tell how one stands. */
const WALKING: Doing = { stride: 0.2, crouch: 0.05, lean: 0, kick: 0, arms: 0.1, turn: 0, tumble: 0 };

describe('humanoids of unseen kinds', () => {
  it('point arms, legs, feet and hands like each other, whatever their names, rest poses, axes, units and proportions', () => {
    fc.assert(
      fc.property(anyLooks, anyLooks, anyDoing, fc.boolean(), (looks, others, doing, hasTake) => {
        const source = stranger('source', looks, doing);
        const target = stranger('target', others, WALKING);
        // Bones along one axis say nothing about how they stand: only a take does.
        const isTold = hasTake || others.rest === 'x';
        const onto = isTold ? target.character : { ...target.character, takes: [], shownTake: -1 };
        const fit = strangersFit(retargeted(source.character, onto), target, source);
        expect(fit.limbs, fit.worst).toBeLessThan(LIMBS);
        expect(fit.feet, fit.worst).toBeLessThan(FEET);
        expect(fit.hands, fit.worst).toBeLessThan(HANDS);
        expect(fit.tips, fit.worst).toBeLessThan(TIPS);
        expect(fit.toesUp).toBe(0);
      }),
      { numRuns: 15 },
    );
  });
});
