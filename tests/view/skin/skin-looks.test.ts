import { Color, MeshStandardMaterial, Texture } from 'three';
import { describe, expect, it } from 'vitest';
import { DEFAULT_DISPLAY, type SkinStyle } from '../../../src/model/session.ts';
import { CharacterView } from '../../../src/view/character-view.ts';
import { DrawnSkins } from '../../../src/view/skin/drawn-skins.ts';
import { looksOf } from '../../../src/view/skin/skin-looks.ts';
import { SkinMaterials } from '../../../src/view/skin/skin-materials.ts';
import { SKIN_THEMES } from '../../../src/view/skin/skin-theme.ts';
import { PLAIN_SKIN } from '../../../src/view/skin/skinning.ts';
import { character, paintedSkin, skin } from '../../helpers/builders.ts';

const RED = { name: 'red', color: [1, 0, 0] } as const;
const BLUE = { name: 'blue', color: [0, 0, 0.5] } as const;
const FUR = { name: 'fur', texture: 'fur.png' } as const;
const texcoords = new Float64Array(6);

const shown = (style: SkinStyle, ...materials: Parameters<typeof paintedSkin>[1][]) => {
  const view = new CharacterView(new DrawnSkins());
  view.show(character({ skins: [paintedSkin('hero', ...materials)] }), { ...DEFAULT_DISPLAY, skin: style }, undefined);
  return view;
};
const coloursOf = (view: CharacterView) =>
  [view.skinnedMeshes[0].material].flat().map((m) => (m instanceof MeshStandardMaterial ? m.color.getHexString() : ''));

describe('surfaces of a skin', () => {
  it('surfaces of a skin that look alike are drawn with one material, those next to each other at once', () => {
    const { looks, runs } = looksOf({ ...paintedSkin('x', RED, { ...RED, name: 'too' }, FUR, RED), texcoords });
    expect(looks).toEqual([{ color: [1, 0, 0] }, { texture: 'fur.png' }]);
    expect(runs).toEqual([
      { look: 0, triangleStart: 0, triangleCount: 2 },
      { look: 1, triangleStart: 2, triangleCount: 1 },
      { look: 0, triangleStart: 3, triangleCount: 1 },
    ]);
  });

  it('surfaces of a skin without texture coordinates have no texture, and colours out of range the nearest one', () => {
    const wild = { name: 'wild', color: [2, -1, 0.5] } as const;
    expect(looksOf(paintedSkin('x', FUR, wild)).looks).toEqual([{}, { color: [1, 0, 0.5] }]);
    expect(looksOf(skin()).looks).toEqual([{}]);
  });

  it('surfaces of a skin are drawn in their own linear colours, in groups of their triangles', () => {
    const view = shown('textured', RED, BLUE, { name: 'bare' });
    expect(coloursOf(view)).toEqual([
      new Color(1, 0, 0).getHexString(),
      new Color(0, 0, 0.5).getHexString(),
      new Color(SKIN_THEMES.dark.clay).getHexString(),
    ]);
    expect(view.skinnedMeshes[0].geometry.groups).toEqual([
      { start: 0, count: 3, materialIndex: 0 },
      { start: 3, count: 3, materialIndex: 1 },
      { start: 6, count: 3, materialIndex: 2 },
    ]);
    const own = coloursOf(view);
    view.setTint('comparedFirst');
    expect(coloursOf(view).every((colour, i) => colour !== own[i])).toBe(true);
    view.setTint(undefined);
    expect(coloursOf(view)).toEqual(own);
  });

  it.each(['solid', 'heat', 'xray', 'four'] as const)(
    'surfaces of a skin are drawn at once in the style %s',
    (style) => {
      const { material } = shown(style, RED, BLUE).skinnedMeshes[0];
      expect(material).not.toBeInstanceOf(Array);
    },
  );

  it('one surface in a colour is drawn at once', () => {
    const view = shown('textured', RED);
    expect(coloursOf(view)).toEqual([new Color(1, 0, 0).getHexString()]);
    expect(view.skinnedMeshes[0].geometry.groups).toEqual([]);
  });

  it('textures of surfaces show as they come, multiplied by the colour', () => {
    const materials = new SkinMaterials(PLAIN_SKIN, SKIN_THEMES.dark);
    const looks = [{ texture: 'fur.png' }, { texture: 'eye.png', color: [0.5, 1, 1] }, {}] as const;
    const made = (...textures: [string, Texture][]) => [materials.textured(looks, new Map(textures))].flat();
    const mapOf = (m: unknown) => (m instanceof MeshStandardMaterial ? m.map : undefined);
    expect(made().map(mapOf)).toEqual([null, null, null]);
    expect(made()[0]).toBe(materials.solid());
    const [fur, eye] = [new Texture(), new Texture()];
    expect(made(['eye.png', eye]).map(mapOf)).toEqual([null, eye, null]);
    const both = made(['eye.png', eye], ['fur.png', fur]);
    expect(both.map(mapOf)).toEqual([fur, eye, null]);
    expect(made(['eye.png', eye], ['fur.png', fur])).toEqual(both);
    const [first, second] = both;
    expect(first instanceof MeshStandardMaterial && first.color.getHex()).toBe(0xffffff);
    expect(second instanceof MeshStandardMaterial && second.color.r).toBe(0.5);
  });
});
