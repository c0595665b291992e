import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { Capture } from '../../../src/model/files.ts';
import { anyCapture } from '../../edit/convert/captures.ts';
import { ALL_BVH, readCaptures, sharedCaptures } from '../../helpers/bvh-files.ts';
import { writeBvh } from '../../helpers/bvh-text.ts';
import { finite } from '../arbitraries.ts';

/** Without channels there are no frames. */
function hasChannels({ take }: Capture): boolean {
  return take?.samples?.scales.length !== 0;
}

/** What a file says, without what reading adds to it. */
function content(captures: readonly Capture[]) {
  return captures.map(({ skeleton, take }) => ({
    joints: skeleton.joints.map(({ name, parent, offset, motion, endSites }) => {
      return { name, parent, offset, motion, endSites: endSites ?? [] };
    }),
    frameSeconds: take?.samples?.frameSeconds,
    frameCount: take?.samples?.frameCount,
    values: Array.from(take?.samples?.values ?? []),
  }));
}

describe('a capture of BVH written and read', () => {
  it('a capture of BVH written and read is the same to the last bit, and written again the same bytes', () => {
    fc.assert(
      fc.property(anyCapture(finite).filter(hasChannels), (capture) => {
        const { text } = writeBvh([capture], 'x.bvh');
        const again = readCaptures('x.bvh', text);
        expect(content(again)).toEqual(content([capture]));
        expect(writeBvh(again, 'x.bvh').text).toBe(text);
      }),
    );
  });
});

describe('a real .bvh', () => {
  it.each(ALL_BVH)('%s reads back the same after writing, and writes the same bytes', (name) => {
    const captures = sharedCaptures(name);
    const { text, diagnostics } = writeBvh(captures, name);
    expect(diagnostics).toEqual([]);
    const again = readCaptures(name, text);
    // Everything, and not only what the file says.
    expect(again.map(({ skeleton }) => skeleton)).toEqual(captures.map(({ skeleton }) => skeleton));
    again.forEach(({ take }, i) => {
      const { samples, ...rest } = take ?? {};
      const { samples: before, ...restBefore } = captures[i].take ?? {};
      expect(rest).toEqual(restBefore);
      expect({ ...samples, values: [] }).toEqual({ ...before, values: [] });
      // Bit by bit, −0 too; `toEqual` takes seconds for a million numbers.
      expect(firstDifference(samples?.values, before?.values)).toBe(-1);
    });
    expect(writeBvh(again, name).text === text).toBe(true);
  });
});

function firstDifference(a: Float64Array = new Float64Array(0), b: Float64Array = new Float64Array(0)): number {
  if (a.length !== b.length) return Math.min(a.length, b.length);
  return a.findIndex((v, i) => !Object.is(v, b[i]));
}
