/** Textures as glTF embeds them, told by their content. */
import type { Texture } from '../../../model/files.ts';
import { readBmp } from './bmp.ts';
import { writePng } from './png.ts';

/** An image in a format that glTF has. */
export interface EmbeddedImage {
  readonly mime: 'image/png' | 'image/jpeg' | 'image/webp';
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** The image of a texture, a bitmap as PNG; undefined if it is none that viewers read. */
export function imageOf({ bytes }: Texture): EmbeddedImage | undefined {
  const starts = (at: number, ...head: readonly number[]) => head.every((byte, i) => bytes[at + i] === byte);
  if (starts(0, 0x89, 0x50, 0x4e, 0x47)) return { mime: 'image/png', bytes };
  if (starts(0, 0xff, 0xd8, 0xff)) return { mime: 'image/jpeg', bytes };
  // RIFF … WEBP
  if (starts(0, 0x52, 0x49, 0x46, 0x46) && starts(8, 0x57, 0x45, 0x42, 0x50)) return { mime: 'image/webp', bytes };
  const pixels = readBmp(bytes);
  return pixels && { mime: 'image/png', bytes: writePng(pixels) };
}
