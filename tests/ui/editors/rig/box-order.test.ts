import { describe, expect, it } from 'vitest';
import { DEFAULT_BOX } from '../../../../src/model/skeleton/skeleton.ts';
import { whyNoCorner } from '../../../../src/ui/editors/rig/box-order.ts';

describe('a corner of a box that is typed', () => {
  it('a corner of a box that is typed may not pass the other one, and the message names the axis', () => {
    expect(whyNoCorner(DEFAULT_BOX, 'min', [0, 0.5, 0])).toBe(
      'The box would go from 0.5 to 0.1 along y, but “from” must be below “to”.',
    );
    expect(whyNoCorner(DEFAULT_BOX, 'max', [0, 0, -0.2])).toContain('from −0.1 to −0.2 along z');
  });

  it('a corner of a box that is typed may coincide with the other one', () => {
    expect(whyNoCorner(DEFAULT_BOX, 'min', [0.1, 0.1, 0.1])).toBeUndefined();
  });

  it('a corner of a box that is typed may be anything along an axis that the file has reversed', () => {
    const crossed = { min: [1, 0, 0], max: [-1, 2, 2] } as const;
    expect(whyNoCorner(crossed, 'min', [5, 0, 0])).toBeUndefined();
    expect(whyNoCorner(crossed, 'min', [5, 3, 0])).toContain('along y');
  });
});
