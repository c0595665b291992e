/** What the page around an embedded one may say. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { originOf, readMessage } from '../../../src/app/embed/embed-messages.ts';

describe('messages of the page around', () => {
  it('messages are read', () => {
    expect(readMessage({ marrow: 'play' })).toEqual({ marrow: 'play' });
    expect(readMessage({ marrow: 'pause', more: 1 })).toEqual({ marrow: 'pause' });
    expect(readMessage({ marrow: 'seek', time: 1.5 })).toEqual({ marrow: 'seek', time: 1.5 });
    expect(readMessage({ marrow: 'open', files: ['a.skel'] })).toEqual({ marrow: 'open', files: ['a.skel'] });
    expect(readMessage({ marrow: 'select', joint: 'hand' })).toEqual({ marrow: 'select', joint: 'hand' });
    const view = { target: [0, 1, 0], distance: 3, azimuth: 0, polar: Math.PI / 2 };
    expect(readMessage({ marrow: 'camera', view: [0, 1, 3, 0, 1, 0] })).toEqual({ marrow: 'camera', view });
  });

  it('messages that can’t be followed are answered in words, and those of others not at all', () => {
    const wrong = [
      { marrow: 'seek', time: '1' },
      { marrow: 'seek', time: Number.NaN },
      { marrow: 'open', files: [] },
      { marrow: 'open', files: 'a.skel' },
      { marrow: 'camera', view: [0, 1, 3] },
      { marrow: 'select' },
      { marrow: 'dance' },
      { marrow: 7 },
      { marrow: { toString: 1 } },
      { marrow: 'camera', view: [{ toString: 1 }, 1, 3, 0, 1, 0] },
      { marrow: 'x'.repeat(1e6) },
    ];
    for (const data of wrong) expect(readMessage(data), JSON.stringify(data)).toMatch(/^The(re| message) .{1,300}\.$/);
    for (const data of [undefined, null, 'play', 7, [], { type: 'play' }]) expect(readMessage(data)).toBeUndefined();
  });

  it('an origin is read from any address there', () => {
    for (const address of ['https://a.example', 'https://A.example/', 'https://a.example:443/page?x#y'])
      expect(originOf(address)).toBe('https://a.example');
    for (const address of ['*', '/', 'null', 'a.example', 'http://', 'file:///a', 'data:,a', 'javascript:1'])
      expect(originOf(address), address).toBeUndefined();
  });

  it('messages of any kind are survived', () => {
    fc.assert(
      fc.property(fc.anything(), fc.anything(), (name, value) => {
        readMessage(name);
        readMessage({ marrow: name, time: value, files: value, view: value, joint: value });
      }),
    );
  });
});
