import { describe, expect, it } from 'vitest';
import { isAside, type Label, labelPlace, labelSpot, oneForEach } from '../../../../src/ui/editors/ik/ik-labels.ts';

const label = (change: Partial<Label>): Label => ({
  text: 'foot',
  kind: 'name',
  x: 0,
  y: 0,
  of: 'c1 0 1',
  side: 'right',
  ...change,
});

describe('labels beside points', () => {
  it('each pin has one label: its problem names the pin, too', () => {
    const name = label({});
    const gap = label({ kind: 'gap', text: 'foot: out of reach' });
    const other = label({ of: 'c1 0 2', text: 'hand' });
    expect(oneForEach([name, other, gap]).map(({ text }) => text)).toEqual(['foot: out of reach', 'hand']);
  });

  it('labels are on their side of the point, and inside the viewport', () => {
    expect(labelPlace({ side: 'right', lower: 0 }, 100, 50, 800, 600)).toBe(
      'translate(clamp(4.0px, 114.0px, calc(796.0px - 100%)), clamp(4.0px, calc(50.0px - 50%), calc(596.0px - 100%)))',
    );
    expect(labelPlace({ side: 'left', lower: 20 }, 100, 50, 800, 600)).toContain(
      'clamp(4.0px, calc(86.0px - 100%), calc(796.0px - 100%)), clamp(4.0px, calc(70.0px - 50%)',
    );
  });

  it('in a narrow viewport a problem is told below the toolbar, where it covers no character; names stay beside', () => {
    expect(isAside(label({ kind: 'gap' }), 390)).toBe(true);
    expect(isAside(label({ kind: 'gap' }), 800)).toBe(false);
    expect(isAside(label({}), 390)).toBe(false);
  });

  it('labels switch sides if there is no room on theirs', () => {
    expect(labelSpot(label({}), 400, 50, 800).side).toBe('right');
    expect(labelSpot(label({}), 790, 50, 800).side).toBe('left');
    expect(labelSpot(label({ side: 'left' }), 10, 50, 800).side).toBe('right');
    expect(labelSpot(label({}), 10, 50, 20).side).toBe('right');
  });

  it('labels cover no pin: they switch sides or shift vertically, unless nothing is free', () => {
    const at = (...pins: (readonly [number, number])[]) =>
      labelSpot(
        label({}),
        400,
        300,
        800,
        pins.map(([x, y]) => ({ x, y })),
      );
    expect(at([400, 300], [500, 300])).toEqual({ side: 'right', lower: 0 });
    expect(at([425, 302])).toEqual({ side: 'left', lower: 0 });
    const below = at([425, 302], [375, 300]);
    expect(below.side).toBe('right');
    expect(below.lower).toBeGreaterThan(18);
    const everywhere = [375, 425].flatMap((x) => Array.from({ length: 40 }, (_, i) => [x, 100 + 10 * i] as const));
    expect(at(...everywhere)).toEqual({ side: 'right', lower: 0 });
  });
});
