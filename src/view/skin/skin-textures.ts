/** The textures of a skin that is shown, by the names in its materials. They come one by one as they are decoded. */
import type { Texture } from 'three';
import { baseName, type Texture as Picture, sameName } from '../../model/files.ts';
import type { SharedTextures } from './shared-textures.ts';

interface Shown {
  readonly picture: Picture;
  /** Undefined until it is decoded. */
  texture?: Texture;
}

export class SkinTextures {
  private shown: ReadonlyMap<string, Shown> = new Map();

  /**
   * @param onChange with those that are decoded
   * @param onFailed that one can't be decoded: it stays away
   */
  constructor(
    private readonly shared: SharedTextures,
    private readonly onChange: (textures: ReadonlyMap<string, Texture>) => void,
    private readonly onFailed: (picture: Picture, message: string) => void,
  ) {}

  /** Those that are decoded. */
  get decoded(): ReadonlyMap<string, Texture> {
    const found = new Map<string, Texture>();
    for (const [name, { texture }] of this.shown) if (texture) found.set(name, texture);
    return found;
  }

  /** Decodes what is new among the pictures of these names, and releases the others. */
  show(names: readonly string[], pictures: readonly Picture[]): void {
    const before = this.shown;
    const next = new Map<string, Shown>();
    const added: Shown[] = [];
    for (const name of names) {
      const picture = pictures.find((p) => sameName(p.name, baseName(name)));
      const known = before.get(name);
      if (!picture) continue;
      if (known?.picture === picture) next.set(name, known);
      else {
        const fresh = { picture };
        next.set(name, fresh);
        added.push(fresh);
      }
    }
    this.shown = next;
    if (typeof createImageBitmap === 'undefined') return;
    const dropped = [...before].flatMap(([name, each]) => (next.get(name) === each ? [] : [each]));
    if (dropped.some(({ texture }) => texture)) this.onChange(this.decoded);
    for (const each of added) this.decode(each);
    // After the others: an equal picture keeps its texture.
    for (const { picture } of dropped) this.shared.release(picture);
  }

  dispose(): void {
    this.show([], []);
  }

  private decode(each: Shown): void {
    const isWanted = () => [...this.shown.values()].includes(each);
    this.shared.acquire(each.picture).then(
      (texture) => {
        if (!isWanted()) return;
        each.texture = texture;
        this.onChange(this.decoded);
      },
      (error: unknown) => {
        if (isWanted()) this.onFailed(each.picture, error instanceof Error ? error.message : String(error));
      },
    );
  }
}
