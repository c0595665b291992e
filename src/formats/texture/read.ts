/** Images that a skin's material may name. Their bytes are kept as they are; the view decodes them. */
import type { Texture } from '../../model/files.ts';
import { NO_PLACE } from '../places.ts';
import { bytesReader, type Reader } from '../reader.ts';
import { imageSize } from './image-size.ts';

/** MIME types that are not called after the extension. */
const TYPES: Readonly<Record<string, string>> = { jpg: 'jpeg' };

/**
 * The MIME type of an image.
 * @param extension of images, in lower case
 */
export function textureMime(extension: string): string {
  return `image/${TYPES[extension] ?? extension}`;
}

/** Largest side that graphics cards draw, and most pixels: 400 MB of memory, decoded. */
const MAX_SIDE = 16_384;
const MAX_PIXELS = 100_000_000;

/** `50000 × 50000` if an image states more pixels than textures have. */
export function tooManyPixels(bytes: Uint8Array): string | undefined {
  const size = imageSize(bytes);
  if (!size) return undefined;
  const { width, height } = size;
  return Math.max(width, height) > MAX_SIDE || width * height > MAX_PIXELS ? `${width} × ${height}` : undefined;
}

/**
 * A reader of images, by the file's extension: keeps the bytes, and refuses an image with too many pixels by its
 * header.
 */
export function textureReader(fileName: string): Reader<Texture> {
  const mime = textureMime(fileName.slice(fileName.lastIndexOf('.') + 1).toLowerCase());
  return bytesReader(fileName, (bytes, report) => {
    const found = tooManyPixels(bytes);
    if (found !== undefined) {
      const now = `A texture may have up to ${MAX_SIDE} pixels per side and 100 million in total. Scale it down.`;
      report.error('texture-too-large', `The image has ${found} pixels. ${now}`, NO_PLACE);
      return undefined;
    }
    return { name: fileName, mime, bytes };
  });
}
