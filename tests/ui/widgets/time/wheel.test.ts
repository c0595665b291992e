import { expect, it } from 'vitest';
import { wheelTurn } from '../../../../src/ui/widgets/time/wheel.ts';

const notch = { deltaX: 0, deltaY: 60, deltaMode: 0, shiftKey: false, ctrlKey: false, metaKey: false, altKey: false };

it('a wheel zooms both axes, time alone with Ctrl, the other axis with Alt', () => {
  const zoom = { what: 'zoom', factor: 1.15, pixels: 60 };
  expect(wheelTurn(notch)).toEqual({ ...zoom, axes: 'both' });
  expect(wheelTurn({ ...notch, ctrlKey: true })).toEqual({ ...zoom, axes: 'time' });
  expect(wheelTurn({ ...notch, metaKey: true })).toEqual({ ...zoom, axes: 'time' });
  expect(wheelTurn({ ...notch, altKey: true })).toEqual({ ...zoom, axes: 'other' });
});

it('a wheel pans with Shift, whether or not a system makes it sideways, and where it is sideways by itself', () => {
  expect(wheelTurn({ ...notch, shiftKey: true })).toEqual({ what: 'pan', pixels: 60 });
  expect(wheelTurn({ ...notch, deltaX: 60, deltaY: 0, shiftKey: true })).toEqual({ what: 'pan', pixels: 60 });
  expect(wheelTurn({ ...notch, deltaX: -30, deltaY: 7 })).toEqual({ what: 'pan', pixels: -30 });
});

it('a wheel that counts in lines turns as far, and back exactly as far', () => {
  expect(wheelTurn({ ...notch, deltaMode: 1, deltaY: 3 })).toEqual(wheelTurn({ ...notch, deltaY: 48 }));
  const [there, back] = [wheelTurn(notch), wheelTurn({ ...notch, deltaY: -60 })];
  expect(there.what === 'zoom' && back.what === 'zoom' && there.factor * back.factor).toBeCloseTo(1, 12);
});
