import { afterEach, describe, expect, it, vi } from 'vitest';
import type { Vec3 } from '../../../../src/math/vec3.ts';
import { type Character, findCharacter } from '../../../../src/model/document.ts';
import { DEFAULT_DISPLAY } from '../../../../src/model/session.ts';
import type { Skin } from '../../../../src/model/skin.ts';
import { rigTool } from '../../../../src/ui/editors/rig/rig-tool.ts';
import { CharacterView } from '../../../../src/view/character-view.ts';
import { DrawnSkins } from '../../../../src/view/skin/drawn-skins.ts';
import { limbSkin } from '../../../helpers/limb.ts';
import { character, documentOf, skeleton } from '../../builders.ts';
import { ikPage, PIXELS_PER_UNIT } from '../ik/ik-page.ts';

const HELD = { button: 0, pointerType: 'mouse', altKey: false, shiftKey: false, ctrlKey: false, metaKey: false };
/** Its only joint is in front of the limb, and was when the limb was bound. */
const bones = {
  ...skeleton(['root', -1]),
  joints: skeleton(['root', -1]).joints.map((one) => ({ ...one, offset: [0, 2, 5] as const })),
};

function limb(z = 0): Skin {
  const skin = limbSkin([0, z]);
  const bindings = skin.bindings.slice();
  bindings.set(bones.joints[0].offset, 12);
  return { ...skin, bindings };
}

afterEach(() => void vi.unstubAllGlobals());

const rayAt = (x: number, y: number) => ({
  origin: [x / PIXELS_PER_UNIT, -y / PIXELS_PER_UNIT, 10],
  direction: [0, 0, -1],
});

/** Rig mode with the grid shown, where clicks add joints; places are in the scene. */
function adding(what: Partial<Character>) {
  const { wb, placeOf } = ikPage(documentOf(character(what)));
  const withDrawnSkin = (id: string) => {
    const shown = findCharacter(wb.store.document, id);
    const placements = wb.viewport.placementOf(id, 0);
    if (!shown || !placements) return undefined;
    const view = new CharacterView(new DrawnSkins());
    view.show(shown, DEFAULT_DISPLAY, undefined);
    return { view, character: shown, placements, placedFor: shown };
  };
  const eye = { ...wb.viewport.eye, rayAt };
  Object.assign(wb.viewport, { withDrawnSkin, eye, gridStep: 1 });
  wb.posing.mode.set('rig');
  wb.posing.rig.adding.set(true);
  if (what.skeleton) wb.store.select({ characterId: 'c1', joint: 0 });
  const tool = rigTool(wb);
  const click = (x: number, y: number, keys: Partial<typeof HELD> = {}): Vec3 => {
    tool.click?.({ ...HELD, clientX: PIXELS_PER_UNIT * x, clientY: -PIXELS_PER_UNIT * y, ...keys });
    return placeOf(wb.store.selection.joint ?? -1);
  };
  return { wb, click };
}

const close = (...at: Vec3) => at.map((part) => expect.closeTo(part, 2));

describe('a click that adds a joint', () => {
  it('on a skin adds it in the middle of the limb, in one undo step', () => {
    const { wb, click } = adding({ skeleton: bones, skins: [limb()] });
    const { document } = wb.store;
    expect(click(0.34, 5.31)).toEqual(close(0.34, 5.31, 0));
    expect(wb.store.document.characters[0].skeleton?.joints).toHaveLength(2);
    wb.store.undo();
    expect(wb.store.document).toEqual(document);
    expect(wb.store.undoLabel).toBeUndefined();
  });

  it('continues the chain inside the skin', () => {
    const { click } = adding({ skeleton: bones, skins: [limb(-3)] });
    expect(click(0.34, 5.31)).toEqual(close(0.34, 5.31, -3));
    expect(click(-0.2, 7.77)).toEqual(close(-0.2, 7.77, -3));
  });

  it('isn’t moved by the grid or round numbers inside of a skin, whichever keys are held', () => {
    const { click } = adding({ skeleton: bones, skins: [limb()] });
    expect(click(0.34, 5.31, { shiftKey: true })).toEqual(close(0.34, 5.31, 0));
    expect(click(0.34, 6.31, { ctrlKey: true })).toEqual(close(0.34, 6.31, 0));
  });

  it('off the skin adds it in the plane of its parent: on the grid, or free of it with Shift', () => {
    const { click } = adding({ skeleton: bones, skins: [limb()] });
    expect(click(3.34, 5.31)).toEqual(close(3, 5, 5));
    expect(click(4.34, 5.31, { shiftKey: true })).toEqual(close(4.34, 5.31, 5));
  });

  it('on a skin without a skeleton starts one inside it', () => {
    const { wb, click } = adding({ skins: [limbSkin([0, -3])] });
    expect(click(0.34, 5.31)).toEqual(close(0.34, 5.31, -3));
    expect(wb.store.document.characters).toHaveLength(1);
    wb.store.undo();
    expect(wb.store.document.characters[0].skeleton).toBeUndefined();
  });

  it('beside a skin without a skeleton starts one on the grid', () => {
    const { click } = adding({ skins: [limbSkin([0, -3])] });
    expect(click(3.34, 5.31)).toEqual(close(3, 5, 0));
  });
});
