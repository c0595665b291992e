import { describe, expect, it } from 'vitest';
import { DEFAULT_PLACEMENT } from '../../src/model/document.ts';
import { PickedCopy } from '../../src/view/picked-copy.ts';

const wasp = { id: 'c1', placements: [DEFAULT_PLACEMENT, DEFAULT_PLACEMENT, DEFAULT_PLACEMENT] };

describe('the copy that is worked on', () => {
  it('the edited instance is the first until another is picked', () => {
    const picked = new PickedCopy();
    expect(picked.of(wasp)).toBe(0);
    picked.follow({ characterId: 'c1', placement: 2, joint: 4 });
    expect(picked.of(wasp)).toBe(2);
  });

  it('the edited instance stays while joints are selected elsewhere', () => {
    const picked = new PickedCopy();
    picked.follow({ characterId: 'c1', placement: 1, joint: 4 });
    picked.follow({ characterId: 'c1', joint: 5 });
    picked.follow({ characterId: 'c1' });
    expect(picked.of(wasp)).toBe(1);
  });

  it('the edited instance is the first again for another character, and when it is selected again', () => {
    const picked = new PickedCopy();
    picked.follow({ characterId: 'c1', placement: 1 });
    picked.follow({ characterId: 'c2' });
    expect(picked.of({ ...wasp, id: 'c2' })).toBe(0);
    picked.follow({ characterId: 'c1' });
    expect(picked.of(wasp)).toBe(0);
  });

  it('the edited instance is the first if the picked one is gone', () => {
    const picked = new PickedCopy();
    picked.follow({ characterId: 'c1', placement: 2 });
    expect(picked.of({ ...wasp, placements: [DEFAULT_PLACEMENT] })).toBe(0);
  });
});
