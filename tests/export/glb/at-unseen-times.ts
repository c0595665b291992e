/** Whether a character's GLB file shows it as it is here at times that no fitting has looked at. */
import { expect } from 'vitest';
import type { GlbOptions } from '../../../src/export/glb/options.ts';
import { type Glb, glbOf } from '../../helpers/glb.ts';
import { offBy } from '../../helpers/glb-off.ts';
import { bySamplers } from '../../helpers/glb-samplers.ts';
import type { Named } from './many-characters.ts';

/** Of the tolerance: what is measured between rows comes to a little more than at them. */
const MOST = 0.985;
const MAX_DEGREES = 2;
/** So many times this are nowhere near each other. */
const GOLDEN = 0.6180339887498949;

/** Expects joints, their axes and vertices within what the file promises, in programs of both kinds; returns the file. */
export function expectWithin({ name, character }: Named, options: Partial<GlbOptions>, count = 160): Glb {
  const made = glbOf(character, options);
  const { tolerance, takes } = made.report;
  const times = Array.from({ length: count }, (_, i) => (((i + 0.37) * GOLDEN) % 1) * takes[0].seconds);
  for (const arc of options.keys === 'cubic' ? (['slerp'] as const) : (['slerp', 'components'] as const)) {
    const off = offBy(character, made, bySamplers(made, arc), 0, times);
    const what = `${name}, ${options.keys}, ${arc}`;
    expect(Math.max(off.joints, off.asWritten, off.firstFour) / tolerance, what).toBeLessThanOrEqual(MOST);
    if (options.influences === undefined) expect(off.vertices / tolerance, what).toBeLessThanOrEqual(MOST);
    expect(off.degrees, what).toBeLessThanOrEqual(MAX_DEGREES);
  }
  return made;
}
