/** Kind of image that bytes are, by how they begin. */

const SIGNATURES: readonly (readonly [extension: string, at: number, bytes: readonly number[]])[] = [
  ['png', 0, [0x89, 0x50, 0x4e, 0x47]],
  ['jpg', 0, [0xff, 0xd8, 0xff]],
  ['webp', 8, [0x57, 0x45, 0x42, 0x50]],
  ['bmp', 0, [0x42, 0x4d]],
];

/** The extension of an image that browsers show, without the dot; undefined for anything else. */
export function imageType(bytes: Uint8Array): string | undefined {
  return SIGNATURES.find(([, at, own]) => own.every((byte, i) => bytes[at + i] === byte))?.[0];
}
