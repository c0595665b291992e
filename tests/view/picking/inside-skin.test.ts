import { describe, expect, it } from 'vitest';
import { placementMatrix } from '../../../src/evaluate/space/placements.ts';
import { type Character, DEFAULT_PLACEMENT } from '../../../src/model/document.ts';
import { DEFAULT_DISPLAY } from '../../../src/model/session.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import type { Ray } from '../../../src/view/camera/eye.ts';
import { CharacterView } from '../../../src/view/character-view.ts';
import { insideSkin } from '../../../src/view/picking/inside-skin.ts';
import { DrawnSkins } from '../../../src/view/skin/drawn-skins.ts';
import { character, morph, skeleton } from '../../helpers/builders.ts';
import { limbSkin } from '../../helpers/limb.ts';

const pose = (...values: number[]) => {
  const all = filePose(skeleton(), 0);
  values.forEach((value, i) => {
    all[i] = value;
  });
  return all;
};

/** What is found in the skin of a character from z 50 along −z. */
function found(what: Character, x: number, y: number) {
  const view = new CharacterView(new DrawnSkins());
  view.show(what, DEFAULT_DISPLAY, undefined);
  const placements = new Float64Array(16);
  placementMatrix(what.placements[0], what.space, new Float64Array(3), placements, 0);
  const viewport = {
    withDrawnSkin: () => ({ view, character: what, placements, placedFor: what }),
    pickedCopy: () => 0,
    eye: { rayAt: (px: number, py: number): Ray => ({ origin: [px, py, 50], direction: [0, 0, -1] }) },
  };
  const at = (px: number, py: number) => insideSkin(viewport, what, px, py);
  return { now: at(x, y), view, at };
}

describe('inside of a skin as it is drawn', () => {
  it('a point picked on a limb is inside of it as it is posed', () => {
    const limb = { skins: [limbSkin()], skeleton: skeleton() };
    expect(found(character(limb), 0.2, 5.3).now).toEqual([0.2, 5.3, expect.closeTo(0, 9)]);
    expect(found(character({ ...limb, pose: pose(4, 1, -3) }), 0.2, 5.3).now).toBeUndefined();
    expect(found(character({ ...limb, pose: pose(4, 1, -3) }), 4.2, 5.3).now).toEqual([
      4.2,
      5.3,
      expect.closeTo(-3, 9),
    ]);
  });

  it('and follows each further pose, and where the character is placed', () => {
    const moved = { ...DEFAULT_PLACEMENT, position: [10, 0, -7] as const, scale: 2 };
    const limb = character({ skins: [limbSkin()], skeleton: skeleton(), placements: [moved] });
    const { now, view, at } = found(limb, 10.2, 5.3);
    expect(now?.[2]).toBeCloseTo(-7, 9);
    view.show({ ...limb, pose: pose(0, 0, 1) }, DEFAULT_DISPLAY, undefined);
    expect(at(10.2, 5.3)?.[2]).toBeCloseTo(-5, 9);
  });

  it('morphs count, and a character without a skeleton too', () => {
    const skin = limbSkin();
    const far = { ...morph('far'), positions: everythingBack(skin.positions, 6) };
    const limb = withoutSkeleton({ skins: [skin], morphs: [far], pose: [0, 0, 0, 1] });
    expect(found(limb, 0.2, 5.3).now?.[2]).toBeCloseTo(-6, 5);
    expect(found(withoutSkeleton({ skins: [skin] }), 0.2, 5.3).now?.[2]).toBeCloseTo(0, 9);
    expect(found(character({ skeleton: skeleton(), skins: [] }), 0, 0.5).now).toBeUndefined();
  });
});

function withoutSkeleton(change: Partial<Character>): Character {
  const { skeleton: _, ...bare } = character(change);
  return bare;
}

/** Of all vertices, that far along −z. */
function everythingBack(positions: Float64Array, by: number) {
  return {
    indices: Uint32Array.from({ length: positions.length / 3 }, (_, v) => v),
    values: positions.map((value, i) => (i % 3 === 2 ? value - by : value)),
  };
}
