import { Texture } from 'three';
import { expect, it, vi } from 'vitest';
import { SkinMaterials } from '../../../src/view/skin/skin-materials.ts';
import { SKIN_THEMES } from '../../../src/view/skin/skin-theme.ts';
import { PLAIN_SKIN } from '../../../src/view/skin/skinning.ts';

const LOOKS = [{ texture: 'face', color: undefined }];

function textured() {
  const texture = new Texture();
  const [listens, leaves] = [vi.spyOn(texture, 'addEventListener'), vi.spyOn(texture, 'removeEventListener')];
  const materials = new SkinMaterials(PLAIN_SKIN, SKIN_THEMES.dark);
  const make = (tint?: string) => {
    const made = [materials.textured(LOOKS, new Map([['face', texture]]), tint)].flat();
    const ended = vi.fn();
    for (const material of made) material.addEventListener('dispose', ended);
    return ended;
  };
  return { texture, materials, make, listens, leaves };
}

it('materials of a skin that is gone leave nothing with a texture that another skin goes on using', () => {
  const { materials, make, listens, leaves } = textured();
  const ended = [make(), make('#ff0000')];
  expect(listens).toHaveBeenCalledTimes(2);
  materials.dispose();
  expect(leaves.mock.calls).toEqual(listens.mock.calls);
  for (const each of ended) expect(each).toHaveBeenCalledTimes(1);
});

it('a material ends with the texture that it is made of, and is made anew for the next', () => {
  const { texture, materials, make } = textured();
  const ended = make();
  texture.dispose();
  expect(ended).toHaveBeenCalledTimes(1);
  make();
  materials.dispose();
  expect(ended).toHaveBeenCalledTimes(1);
});
