import { describe, expect, it } from 'vitest';
import { isolatedAfter } from '../../../../../src/ui/editors/curves/isolating.ts';
import type { CurveHit } from '../../../../../src/ui/editors/curves/scene/scene.ts';
import { cursorOf, intentOf, type Press } from '../../../../../src/ui/editors/curves/tools/intent.ts';
import { movesBoth, sameSlope } from '../../../../../src/ui/editors/curves/tools/slope.ts';
import { buttonMeant } from '../../../../../src/ui/widgets/focus/keyboard.ts';

const KEY: CurveHit = { kind: 'key', channel: 0, index: 0 };
const HANDLE: CurveHit = { kind: 'handle', channel: 0, index: 0, side: 'in' };
const CURVE: CurveHit = { kind: 'curve', channel: 0, timeSeconds: 0, value: 0 };
const EMPTY: CurveHit = { kind: 'empty' };
const press = (more: Partial<Press> = {}): Press => ({
  button: 0,
  shift: false,
  ctrl: false,
  alt: false,
  scaling: false,
  ...more,
});

describe('a press in the plot', () => {
  it('depends on what it hits', () => {
    expect([KEY, HANDLE, CURVE, EMPTY].map((hit) => intentOf(press(), hit))).toEqual(['keys', 'slope', 'curve', 'box']);
  });

  it('inserts on a curve with Ctrl, and only there', () => {
    expect([KEY, CURVE, EMPTY].map((hit) => intentOf(press({ ctrl: true }), hit))).toEqual(['keys', 'insert', 'box']);
  });

  it('pans with Alt or the middle button, but Alt on a handle drags that side only', () => {
    expect([KEY, CURVE, EMPTY].map((hit) => intentOf(press({ alt: true }), hit))).toEqual(['pan', 'pan', 'pan']);
    expect(intentOf(press({ alt: true }), HANDLE)).toBe('slope');
    expect(intentOf(press({ button: 1 }), KEY)).toBe('pan');
  });

  it('opens the menu with the right button, and zooms with Alt', () => {
    expect(intentOf(press({ button: 2 }), KEY)).toBe('menu');
    expect(intentOf(press({ button: 2, alt: true }), KEY)).toBe('zoom');
  });

  it('scales while S is held', () => {
    expect(intentOf(press({ scaling: true }), KEY)).toBe('scale');
  });

  it('a press in the plot has cursors that distinguish keys from background, and adding from moving', () => {
    expect(cursorOf('keys', press(), false)).toBe('move');
    expect(cursorOf('keys', press({ shift: true }), false)).toBe('copy');
    expect(cursorOf('keys', press({ shift: true }), true)).toBe('move');
    expect(cursorOf('insert', press(), false)).toBe('crosshair');
    expect(cursorOf('box', press(), false)).toBe('default');
  });
});

describe('the other handle', () => {
  const none = { alt: false, ctrl: false };

  it('follows if both slopes were equal, always, or never, by the option', () => {
    expect([true, false].map((equal) => movesBoth('auto', equal, none))).toEqual([true, false]);
    expect([true, false].map((equal) => movesBoth('together', equal, none))).toEqual([true, true]);
    expect([true, false].map((equal) => movesBoth('alone', equal, none))).toEqual([false, false]);
  });

  it('the other handle stays with Alt and follows with Ctrl, whatever the option', () => {
    for (const mode of ['auto', 'alone', 'together'] as const) {
      expect(movesBoth(mode, true, { alt: true, ctrl: false })).toBe(false);
      expect(movesBoth(mode, false, { alt: false, ctrl: true })).toBe(true);
    }
  });

  it('treats slopes as equal up to rounding', () => {
    expect(sameSlope(0.1 + 0.2, 0.3)).toBe(true);
    expect(sameSlope(1e6, 1e6 + 0.1)).toBe(false);
  });
});

describe('isolating channels', () => {
  it('isolates one, and shows all again on the second click', () => {
    expect(isolatedAfter(undefined, [3], false)).toEqual([3]);
    expect(isolatedAfter([3], [3], false)).toBeUndefined();
    expect(isolatedAfter([3, 4], [3], false)).toEqual([3]);
  });

  it('adds and removes with Ctrl', () => {
    expect(isolatedAfter([3], [1], true)).toEqual([1, 3]);
    expect(isolatedAfter([1, 3], [1], true)).toEqual([3]);
    expect(isolatedAfter([3], [3], true)).toBeUndefined();
  });
});

it('treats Ctrl+click as a Mac’s right click', () => {
  expect(buttonMeant({ button: 0, ctrlKey: true }, true)).toBe(2);
  expect(buttonMeant({ button: 0, ctrlKey: true }, false)).toBe(0);
  expect(buttonMeant({ button: 1, ctrlKey: true }, true)).toBe(1);
});
