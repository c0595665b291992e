import { describe, expect, it } from 'vitest';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { DEFAULT_PLACEMENT } from '../../../../src/model/document.ts';
import { jointOfOtherCopy } from '../../../../src/ui/editors/rig/other-copies.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import type { Hit } from '../../../../src/view/picking/picking.ts';
import { character, skeleton } from '../../builders.ts';

const twice = character({
  skeleton: skeleton(['hips', -1], ['leg', 0]),
  placements: [DEFAULT_PLACEMENT, { ...DEFAULT_PLACEMENT, position: [100, 0, 0] }],
});
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A unit is a pixel; the hips are at 0, the leg at 30, the second instance a hundred to the right. */
function found(hit: Partial<Hit> | undefined, clientX: number, picked = 0, what = twice) {
  const worlds = Float64Array.from([...IDENTITY, ...IDENTITY]);
  worlds[16 + 12] = 30;
  const viewport = {
    pointing: { pick: () => hit && { characterId: 'c1', placement: 1, ...hit } },
    pickedCopy: () => picked,
    character: () => ({ worlds }),
    placementOf: (_id: string, placement: number) => {
      const toScene = Float64Array.from(IDENTITY);
      toScene[12] = 100 * placement;
      return toScene;
    },
    eye: { toScreen: ([x, y]: Vec3) => ({ x, y, depth: 1 }) },
  };
  const at = { clientX, clientY: 0, button: 0, pointerType: 'mouse' };
  const pointer = { ...at, altKey: false, shiftKey: false, ctrlKey: false, metaKey: false };
  // The rest of the viewport needs a browser.
  return jointOfOtherCopy({ viewport: viewport as unknown as Workbench['viewport'] }, what, pointer);
}

describe('a joint of a copy that has no handles', () => {
  it('finds the joint nearest to the pointer, whichever bone or box of it was hit', () => {
    expect(found({ joint: 0 }, 104)).toEqual({ joint: 0, placement: 1 });
    expect(found({ joint: 0 }, 126)).toEqual({ joint: 1, placement: 1 });
  });

  it('finds no joint between joints, on the ground, or under a skin of another instance', () => {
    expect(found({ joint: 0 }, 115)).toBeUndefined();
    expect(found(undefined, 100)).toBeUndefined();
    expect(found({ joint: 0, vertex: 3 }, 100)).toBeUndefined();
  });

  it('finds no joint of the instance with the handles, nor of another character', () => {
    expect(found({ joint: 0 }, 100, 1)).toBeUndefined();
    expect(found({ joint: 0, characterId: 'c2' }, 100)).toBeUndefined();
    expect(found({ joint: 0 }, 100, 0, { ...twice, placements: [DEFAULT_PLACEMENT] })).toBeUndefined();
  });
});
