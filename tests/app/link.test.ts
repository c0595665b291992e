/** What an address asks for, however it is written. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { readLink } from '../../src/app/link/read-link.ts';
import { wordsOf } from '../../src/model/display-words.ts';
import { DEFAULT_DISPLAY, type Display } from '../../src/model/session.ts';
import { numbersOf, viewOf } from '../../src/view/camera/view-numbers.ts';
import { anyText } from '../helpers/any-text.ts';

describe('a link', () => {
  it('a link says what to show and how', () => {
    const query =
      '?files=a.skel&take=walk,a%2Cb&time=1.25&play=1&range=0,2&select=hand+l&camera=0,1,3,0,1,0&show=bones,names&panel=curves&theme=dark&utm=x';
    expect(readLink(query)).toEqual({
      takes: ['walk', 'a,b'],
      time: 1.25,
      plays: true,
      range: [0, 2],
      joint: 'hand l',
      camera: { target: [0, 1, 0], distance: 3, polar: Math.PI / 2, azimuth: 0 },
      display: expect.objectContaining({ skin: 'hidden', boxes: 'hidden', bones: true, names: true, axes: false }),
      panel: 'curves',
      theme: 'dark',
      wrong: [],
    });
    expect(readLink('?sample=walker')).toEqual({ sample: 'walker', takes: [], wrong: [] });
  });

  it('a link tells each thing that can’t be, and what was expected', () => {
    const { wrong, ...rest } = readLink('?time=soon&play=2&range=2,1&camera=1,2,3&show=bones,wings&panel=x&theme=red');
    expect(wrong.map((text) => text.replace(/expected (show|nothing).*/, 'expected …'))).toEqual([
      'time=soon (expected seconds)',
      'range=2,1 (expected two times, the first before the second)',
      'play=2 (expected 0, 1)',
      'camera=1,2,3 (expected six numbers: the position, and another one that it looks at)',
      'show=bones,wings (expected …',
      expect.stringMatching(/^panel=x \(expected curves, dope/),
      'theme=red (expected system, light, dark)',
    ]);
    expect(rest).toEqual({ takes: [] });
    for (const camera of ['0,0,0,0,0,0', '1e9,0,0,0,0,0', '1,2,3,4,5,', 'NaN,0,0,0,0,1']) {
      expect(readLink(`?camera=${camera}`).wrong.length).toBe(1);
    }
  });

  it('a link of any text is read, and gives numbers that can be drawn', () => {
    const names = ['files', 'sample', 'take', 'time', 'play', 'range', 'select', 'camera', 'show', 'panel', 'theme'];
    const value = fc.oneof(
      anyText(),
      fc.array(fc.double(), { maxLength: 7 }).map(String),
      fc.constantFrom('%', '%zz', '&&', '=', ',', 'skin|bones', '__proto__', 'constructor'),
    );
    const part = fc.tuple(fc.constantFrom(...names), value).map(([name, text]) => `${name}=${text}`);
    fc.assert(
      fc.property(fc.array(part), (parts) => {
        const { time = 0, range = [0, 1], camera, display = {}, wrong } = readLink(`?${parts.join('&')}`);
        const { target = [0, 0, 0], distance = 1, polar = 1, azimuth = 0 } = camera ?? {};
        expect([time, ...range, ...target, distance, polar, azimuth].every(Number.isFinite)).toBe(true);
        expect(distance).toBeGreaterThan(0);
        for (const name of Object.keys(display)) expect(Object.hasOwn(DEFAULT_DISPLAY, name)).toBe(true);
        expect(wrong.length).toBeLessThanOrEqual(names.length);
      }),
    );
  });

  it('a link has the camera and the display of its page', () => {
    const angle = fc.double({ min: -3, max: 3, noNaN: true });
    const view = fc.record({
      target: fc.tuple(angle, angle, angle),
      azimuth: angle,
      polar: fc.double({ min: 0.01, max: 3.13, noNaN: true }),
      distance: fc.double({ min: 0.1, max: 100, noNaN: true }),
    });
    fc.assert(
      fc.property(view, (from) => {
        const to = viewOf(numbersOf(from));
        numbersOf(to ?? from).forEach((value, i) => void expect(value).toBeCloseTo(numbersOf(from)[i], 9));
        expect(to?.polar).toBeCloseTo(from.polar, 6);
      }),
    );
    const display: fc.Arbitrary<Display> = fc.record({
      ...Object.fromEntries(
        Object.entries(DEFAULT_DISPLAY).map(([name, value]) => [
          name,
          typeof value === 'boolean' ? fc.boolean() : fc.constant(value),
        ]),
      ),
      skin: fc.constantFrom('hidden', 'solid', 'textured', 'wire', 'xray', 'heat', 'four'),
      boxes: fc.constantFrom('hidden', 'bare', 'wire', 'solid'),
    }) as fc.Arbitrary<Display>;
    fc.assert(
      fc.property(display, (shown) => {
        const read = readLink(`?show=${wordsOf(shown).join(',')}`).display;
        for (const [name, value] of Object.entries(read ?? {}))
          expect([name, value]).toEqual([name, shown[name as keyof Display]]);
        expect(wordsOf({ ...DEFAULT_DISPLAY, ...read })).toEqual(wordsOf(shown));
      }),
    );
  });
});
