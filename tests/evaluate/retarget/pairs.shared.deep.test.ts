/**
 * Real humanoids retargeted to each other, each two of them one way: arms and legs point like the source's, on planted
 * feet. There and back is `there-and-back.shared.deep.test.ts`.
 */
import { expect, it } from 'vitest';
import { describeShared } from '../../helpers/shared.ts';
import { captured, HUMANOIDS, pairFit, retargeted } from './captures.ts';

/** Degrees; the median of eight limb segments, each the mean over the take. */
const DIRECTIONS = 3;
/** Degrees, medians over the take: of each segment of arms and legs, of feet, whose soles are flat, and of hands; and at any frame. */
const LIMBS = 6;
const FEET = 35;
const HANDS = 25;
const TIPS = 55;
/** Leg lengths: hips move by a little for legs of other proportions. */
const HIPS = 0.045;
const SLIDE = 0.004;

/** The next half of the list, as in a circle: those of the other half have this one among theirs. */
function targetsOf(file: string): readonly string[] {
  const own = HUMANOIDS.indexOf(file);
  return [...HUMANOIDS.slice(own + 1), ...HUMANOIDS.slice(0, own)].slice(0, HUMANOIDS.length / 2);
}

describeShared('each of 14 real humanoids on each other', () => {
  it.each(HUMANOIDS)('%s on 7 other humanoids points its limbs in the same directions, on planted feet', (file) => {
    const source = captured(file);
    for (const target of targetsOf(file)) {
      const fit = pairFit(retargeted(source, captured(target)), source);
      const told = `${file} on ${target}: ${JSON.stringify(fit)}`;
      expect(fit.median, told).toBeLessThan(DIRECTIONS);
      expect(fit.hips, told).toBeLessThan(HIPS);
      expect(fit.limbs, told).toBeLessThan(LIMBS);
      expect(fit.feet, told).toBeLessThan(FEET);
      expect(fit.hands, told).toBeLessThan(HANDS);
      expect(fit.tips, told).toBeLessThan(TIPS);
      expect(fit.toesUp, told).toBe(0);
      expect(fit.slide, told).toBeLessThan(fit.sourceSlide + SLIDE);
    }
  });

  it.each(HUMANOIDS)('%s without planted feet points its limbs exactly', (file) => {
    const source = captured(file);
    for (const target of ['bandai-namco-bow-normal.bvh', 'lafan1-dance-10frames.bvh', 'mixamo-names.bvh']) {
      if (target === file) continue;
      const fit = pairFit(retargeted(source, captured(target), { plantsFeet: false }), source);
      const told = `${file} on ${target}: ${JSON.stringify(fit)}`;
      // Perception Neuron's bones change their lengths a little, which rotations can't follow.
      expect(fit.worst, told).toBeLessThan(file.startsWith('perception') ? 1 : 0.01);
    }
  });
});
