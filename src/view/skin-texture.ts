/**
 * A skin's picture, from the bytes of its file: BMP, PNG, JPEG or WebP, as the browser decodes them (off the main
 * thread). `v` runs up and coordinates wrap; pictures have their first row on top, so v is turned round in the
 * texture's transform. (`imageOrientation: 'flipY'` and `flipY` do not work alike in all browsers.)
 */
import { LinearMipmapLinearFilter, RepeatWrapping, SRGBColorSpace, Texture } from 'three';
import type { Texture as Picture } from '../model/files.ts';
import { perObject } from '../model/per-object.ts';

/** Decoded once for each picture, whatever shows it. */
const decoded = perObject((picture: Picture) =>
  createImageBitmap(new Blob([picture.bytes], { type: picture.mime }), {
    premultiplyAlpha: 'none',
    colorSpaceConversion: 'none',
  }),
);

/** @throws DOMException where the bytes are no picture that the browser knows. */
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
