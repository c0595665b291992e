import { describe, expect, it } from 'vitest';
import { type Label, labelPlace, oneForEach } from '../../../../src/ui/tools/ik/ik-labels.ts';

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
  it('are one for each pin: what is in its way says whose it is too', () => {
    const name = label({});
    const gap = label({ kind: 'gap', text: 'foot: out of reach' });
    const other = label({ of: 'c1 0 2', text: 'hand' });
    expect(oneForEach([name, other, gap]).map(({ text }) => text)).toEqual(['foot: out of reach', 'hand']);
  });

  it('stand on their side of the point, and never leave the picture', () => {
    expect(labelPlace(label({}), 100, 50, 800, 600)).toBe(
      'translate(clamp(4.0px, 114.0px, calc(796.0px - 100%)), clamp(4.0px, calc(50.0px - 50%), calc(596.0px - 100%)))',
    );
    expect(labelPlace(label({ side: 'left' }), 100, 50, 800, 600)).toContain(
      'clamp(4.0px, calc(86.0px - 100%), calc(796.0px',
    );
  });

  it('go to the other side of the point where there is no room on theirs', () => {
    const right = /clamp\(4\.0px, \d/;
    expect(labelPlace(label({}), 790, 50, 800, 600)).not.toMatch(right);
    expect(labelPlace(label({ side: 'left' }), 10, 50, 800, 600)).toMatch(right);
    expect(labelPlace(label({}), 10, 50, 20, 600)).toMatch(right);
  });
});
