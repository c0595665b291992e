/** Decoded pictures, one texture for all skins that have an equal one. */
import type { Texture } from 'three';
import { sameNumbers } from '../../math/same-numbers.ts';
import type { Texture as Picture } from '../../model/files.ts';
import { skinTexture } from './skin-texture.ts';

interface Shared {
  readonly picture: Picture;
  readonly texture: Promise<Texture>;
  owners: number;
}

export class SharedTextures {
  private readonly all = new Set<Shared>();

  /**
   * Resolves with the texture of a picture; release the picture when it isn't shown any more, whether or not it has.
   *
   * @throws DOMException if the browser can't decode it
   */
  acquire(picture: Picture): Promise<Texture> {
    let shared = this.find(picture);
    if (!shared) {
      shared = { picture, texture: skinTexture(picture), owners: 0 };
      this.all.add(shared);
    }
    shared.owners++;
    return shared.texture;
  }

  release(picture: Picture): void {
    const shared = this.find(picture);
    if (!shared || --shared.owners > 0) return;
    this.all.delete(shared);
    shared.texture.then(
      (texture) => texture.dispose(),
      // Whoever asked for it was told.
      () => {},
    );
  }

  private find(picture: Picture): Shared | undefined {
    for (const shared of this.all) if (areEqual(shared.picture, picture)) return shared;
    return undefined;
  }
}

function areEqual(a: Picture, b: Picture): boolean {
  return a === b || (a.mime === b.mime && sameNumbers(a.bytes, b.bytes));
}
