/** Skins in sessions kept by earlier versions: they had one material, for all of their triangles. */
import { type Material, oneSurface, type Skin } from '../../model/skin.ts';

type FormerSkin = Omit<Skin, 'surfaces'> & { readonly material?: Material };

export function isFormerSkin(value: object): value is FormerSkin {
  return 'triangles' in value && 'bindings' in value && !('surfaces' in value);
}

export function skinOf({ material, ...skin }: FormerSkin): Skin {
  return { ...skin, surfaces: oneSurface(skin.triangles, material) };
}

/** What earlier versions had at a path into a skin: its material. */
export function formerMaterial(value: object, key: string | number): Material | undefined {
  const isSkin = key === 'material' && 'triangles' in value && 'surfaces' in value;
  // The compiler can't know what the file was read as.
  return isSkin ? (value as Skin).surfaces[0].material : undefined;
}
