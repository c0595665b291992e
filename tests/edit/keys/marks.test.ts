import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { markKeys, markMoves, PLAIN, SELECTED } from '../../../src/edit/keys/marks.ts';
import { compileChannels } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import { type Channel, keysOf } from '../../../src/model/takes/take.ts';
import { LINEAR } from '../../../src/model/takes/tangent-kinds.ts';
import { channel } from '../../ui/builders.ts';
import { channels, someKeys } from '../../ui/editors/dope/arbitrary.ts';

const span = fc.record({
  from: fc.double({ min: -1, max: 1, noNaN: true }),
  secondsPerPixel: fc.double({ min: 0.001, max: 0.2, noNaN: true }),
});
/** Few pixels make every channel dense. */
const pixels = fc.constantFrom(1, 3, 40, 500);

describe('marks of keys', () => {
  it('hold a pixel exactly if a key lies in it, and say whether it is selected', () => {
    fc.assert(
      fc.property(channels, fc.func(fc.boolean()), span, pixels, (all, coin, { from, secondsPerPixel }, count) => {
        const marks = new Uint8Array(count).fill(255);
        markKeys(all, [...all.keys()], someKeys(all, coin), { from, secondsPerPixel }, marks);
        const walked = new Uint8Array(count);
        all.map(keysOf).forEach(({ times }, c) => {
          times.forEach((time, i) => {
            // Half open: what lies on the right edge is the next pixel's.
            if (time < from || time >= from + count * secondsPerPixel) return;
            const pixel = Math.min(count - 1, Math.floor((time - from) / secondsPerPixel));
            walked[pixel] |= coin(c, i) ? SELECTED : PLAIN;
          });
        });
        expect(marks).toEqual(walked);
      }),
    );
  });

  it('jump through a dense channel to the same marks, selected keys among them', () => {
    const times = Array.from({ length: 5000 }, (_, i) => i / 1000);
    const all = [channel(...times)];
    const marks = new Uint8Array(10);
    markKeys(all, [0], [{ channel: 0, indices: [0, 499, 2500] }], { from: 0, secondsPerPixel: 0.5 }, marks);
    const both = PLAIN | SELECTED;
    expect([...marks]).toEqual([both, PLAIN, PLAIN, PLAIN, PLAIN, both, PLAIN, PLAIN, PLAIN, PLAIN]);
  });

  it('marks of keys are of a pixel’s only colour where all of its keys are selected', () => {
    const all = [channel(...Array.from({ length: 100 }, (_, i) => i / 100))];
    const marks = new Uint8Array(2);
    const firstHalf = Array.from({ length: 50 }, (_, i) => i);
    markKeys(all, [0], [{ channel: 0, indices: firstHalf }], { from: 0, secondsPerPixel: 0.5 }, marks);
    expect([...marks]).toEqual([SELECTED, PLAIN]);
  });
});

function valued(times: readonly number[], values: readonly number[], kind = LINEAR): Channel {
  const kinds = () => new Uint8Array(times.length).fill(kind);
  return {
    ...channel(...times),
    values: Float64Array.from(values),
    tangentsIn: { kinds: kinds(), slopes: new Float64Array(times.length) },
    tangentsOut: { kinds: kinds(), slopes: new Float64Array(times.length) },
  };
}

describe('marks of what moves', () => {
  const eighths = { from: 0, secondsPerPixel: 0.125 };

  function moves(all: readonly Channel[], of: readonly number[]): string {
    const out = new Uint8Array(10);
    markMoves(compileChannels(all), of, eighths, out);
    return [...out].map((m) => (m ? '~' : '–')).join('');
  }

  it('omit spans whose curve is constant', () => {
    expect(moves([valued([0, 0.375, 0.875, 1.25], [1, 1, 2, 2])], [0])).toBe('–––~~~~–––');
  });

  it('marks of what moves are of a row wherever one of its channels moves', () => {
    const all = [valued([0, 0.5], [0, 0]), valued([0, 0.25, 0.5, 1], [0, 0, 1, 1])];
    expect(moves(all, [0])).toBe('––––––––––');
    expect(moves(all, [0, 1])).toBe('––~~––––––');
  });

  it('cover a span that begins before the view and ends behind it', () => {
    expect(moves([valued([-3, 5], [0, 1])], [0])).toBe('~~~~~~~~~~');
    expect(moves([valued([-3, 5], [1, 1])], [0])).toBe('––––––––––');
  });

  it('say from which key to which there can be a bar at all', () => {
    const out = new Uint8Array(10);
    const compiled = compileChannels([valued([0.25, 0.75], [0, 0]), valued([0.5], [0])]);
    expect(markMoves(compiled, [0, 1], eighths, out)).toEqual([2, 6]);
    expect(markMoves(compiled, [1], eighths, out)).toBeUndefined();
  });

  it('mark every pixel between keys in which the evaluator finds another value', () => {
    const keys = fc.array(fc.tuple(fc.integer({ min: 0, max: 200 }), fc.constantFrom(0, 1)), {
      minLength: 2,
      maxLength: 8,
    });
    fc.assert(
      fc.property(keys, fc.constantFrom(0, 1, 2), (drawn, kind) => {
        const inOrder = new Map([...drawn].sort((a, b) => a[0] - b[0]));
        const all = [
          valued(
            [...inOrder.keys()].map((t) => t / 128),
            [...inOrder.values()],
            kind,
          ),
        ];
        const compiled = compileChannels(all);
        const out = new Uint8Array(200);
        markMoves(compiled, [0], { from: 0, secondsPerPixel: 1 / 128 }, out);
        for (let p = 0; p < 200; p++) {
          const before = evaluateChannel(compiled, 0, (p + 0.25) / 128);
          const after = evaluateChannel(compiled, 0, (p + 0.75) / 128);
          if (before !== after) expect(out[p]).toBe(1);
        }
      }),
    );
  });
});
