import { describe, expect, it } from 'vitest';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { DEFAULT_PLACEMENT } from '../../../../src/model/document.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

/** Placements after duplicating an instance, with the last one drawn at this size. */
function placesAfter(size: Vec3 | undefined): readonly Vec3[] {
  const last = { ...DEFAULT_PLACEMENT, position: [5, 1, 2] as const, scale: 3 };
  const placements = [DEFAULT_PLACEMENT, last];
  const { wb } = workbench(documentOf(character({ skeleton: skeleton(['root', -1]), placements })));
  const asked: number[] = [];
  const sizeOf = (_id: string, placement: number) => {
    asked.push(placement);
    return size;
  };
  Object.assign(wb.viewport, { sizeOf });
  runAction(wb, 'character.copy');
  expect(asked).toEqual([1]);
  const after = wb.store.document.characters[0].placements;
  expect(after.map(({ scale }) => scale)).toEqual([1, 3, 3]);
  return after.map(({ position }) => position);
}

describe('a character shown once more', () => {
  it('a duplicated instance is beside the last one, clear of everything drawn of it', () => {
    const [, , beside] = placesAfter([4, 9, 9]);
    expect(beside[0]).toBeGreaterThan(9);
    expect(beside[0]).toBeLessThan(11);
    expect(beside.slice(1)).toEqual([1, 2]);
  });

  it('a duplicated instance is apart from one without width, or not drawn', () => {
    expect(placesAfter([0, 2, 0])[2][0]).toBeGreaterThan(5);
    expect(placesAfter(undefined)[2][0]).toBeGreaterThan(5);
  });
});
