/** The textures of a character as images that go into a file, found by the names that materials have for them. */
import type { Character } from '../../model/document.ts';
import { baseName, sameName } from '../../model/files.ts';
import { type EmbeddedImage, imageOf } from './images/images.ts';

/** An image with its name, without folders. */
export interface NamedImage {
  readonly name: string;
  readonly image: EmbeddedImage;
}

/** Images by name, each made once. */
export class GivenTextures {
  /** Names of textures that are not there, or are no images that viewers read. */
  readonly missing: string[] = [];
  private readonly known = new Map<string, NamedImage>();

  constructor(private readonly textures: Character['textures']) {}

  /** The image of a texture, the same object each time; undefined, and noted as missing, if there is none. */
  of(name: string): NamedImage | undefined {
    const key = baseName(name).toLowerCase();
    const before = this.known.get(key);
    if (before) return before;
    const texture = this.textures.find((one) => sameName(baseName(one.name), baseName(name)));
    const image = texture && imageOf(texture);
    if (!image) {
      this.missing.push(name);
      return undefined;
    }
    const found = { name: baseName(name), image };
    this.known.set(key, found);
    return found;
  }
}

/** Colour of a surface that states none: a light grey. */
export const PLAIN_COLOR: readonly [number, number, number] = [0.8, 0.8, 0.8];

/** The colour of a material within what formats hold. */
export function heldColor(color: readonly number[]): number[] {
  return color.map((c) => Math.min(1, Math.max(0, c)));
}
