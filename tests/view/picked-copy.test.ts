import { describe, expect, it } from 'vitest';
import { DEFAULT_PLACEMENT } from '../../src/model/document.ts';
import { PickedCopy } from '../../src/view/picked-copy.ts';

const wasp = { id: 'c1', placements: [DEFAULT_PLACEMENT, DEFAULT_PLACEMENT, DEFAULT_PLACEMENT] };

describe('the copy that is worked on', () => {
  it('the copy that is worked on is the first until another is picked', () => {
    const picked = new PickedCopy();
    expect(picked.of(wasp)).toBe(0);
    picked.follow({ characterId: 'c1', placement: 2, joint: 4 });
    expect(picked.of(wasp)).toBe(2);
  });

  it('stays the one that was picked while joints are chosen elsewhere', () => {
    const picked = new PickedCopy();
    picked.follow({ characterId: 'c1', placement: 1, joint: 4 });
    picked.follow({ characterId: 'c1', joint: 5 });
    picked.follow({ characterId: 'c1' });
    expect(picked.of(wasp)).toBe(1);
  });

  it('the copy that is worked on is the first again of another character, and of one that comes back', () => {
    const picked = new PickedCopy();
    picked.follow({ characterId: 'c1', placement: 1 });
    picked.follow({ characterId: 'c2' });
    expect(picked.of({ ...wasp, id: 'c2' })).toBe(0);
    picked.follow({ characterId: 'c1' });
    expect(picked.of(wasp)).toBe(0);
  });

  it('the copy that is worked on is the first where the one that was picked is gone', () => {
    const picked = new PickedCopy();
    picked.follow({ characterId: 'c1', placement: 2 });
    expect(picked.of({ ...wasp, placements: [DEFAULT_PLACEMENT] })).toBe(0);
  });
});
