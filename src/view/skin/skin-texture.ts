/**
 * A skin's texture, from the bytes of its file: BMP, PNG, JPEG or WebP, decoded by the browser off the main thread. `v`
 * runs up and coordinates wrap; images start at the top row, so v is flipped in the texture's transform.
 * (`imageOrientation: 'flipY'` and `flipY` don't work the same in all browsers.)
 */
import { LinearMipmapLinearFilter, RepeatWrapping, SRGBColorSpace, Texture } from 'three';
import type { Texture as Picture } from '../../model/files.ts';
import { perObject } from '../../model/per-object.ts';

/** Decoded once per image. */
const decoded = perObject((picture: Picture) =>
  createImageBitmap(new Blob([picture.bytes], { type: picture.mime }), {
    premultiplyAlpha: 'none',
    colorSpaceConversion: 'none',
  }),
);

/** @throws DOMException if the browser can't decode the bytes */
export async function skinTexture(picture: Picture): Promise<Texture> {
  const texture = new Texture(await decoded(picture));
  texture.name = picture.name;
  texture.flipY = false;
  texture.repeat.set(1, -1);
  texture.offset.set(0, 1);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.anisotropy = 8;
  texture.colorSpace = SRGBColorSpace;
  texture.needsUpdate = true;
  return texture;
}
