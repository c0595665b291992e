/** Images that a skin's material may name. Their bytes are kept as they are; the view decodes them. */
import type { Texture } from '../../model/files.ts';
import { bytesReader, type Reader } from '../reader.ts';

/** Without dots. */
export const TEXTURE_EXTENSIONS = ['bmp', 'png', 'jpg', 'jpeg', 'webp'] as const;

/** MIME types that are not called after the extension. */
const TYPES: Readonly<Record<string, string>> = { jpg: 'jpeg' };

/** @param extension of images, in lower case */
export function textureMime(extension: string): string {
  return `image/${TYPES[extension] ?? extension}`;
}

export function textureReader(fileName: string): Reader<Texture> {
  const mime = textureMime(fileName.slice(fileName.lastIndexOf('.') + 1).toLowerCase());
  return bytesReader(fileName, (bytes) => ({ name: fileName, mime, bytes }));
}
