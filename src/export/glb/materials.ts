/** Materials of a skin, with their textures inside the file. */
import type { Character } from '../../model/document.ts';
import type { Skin } from '../../model/skin.ts';
import { GivenTextures, heldColor, type NamedImage, PLAIN_COLOR } from '../shared/given-textures.ts';
import type { BinaryChunk, Json } from './container.ts';

/** The materials of a skin as JSON, with what is missing. */
export interface GlbMaterials {
  /** Materials, one per surface, textures and images, and the extensions that they need. */
  readonly json: Json;
  /** Names of textures that are not there, or are no images that viewers read. */
  readonly missing: readonly string[];
}

/** Makes materials of a skin's surfaces, and adds their images to the binary chunk, each once. */
export function addMaterials(chunk: BinaryChunk, { textures }: Character, skin: Skin): GlbMaterials {
  const images: Json[] = [];
  const entries: Json[] = [];
  const given = new GivenTextures(textures);
  const known = new Map<NamedImage, number>();
  const extensions = new Set<string>();
  const textureOf = (texture: string): number | undefined => {
    const one = given.of(texture);
    if (!one) return undefined;
    const before = known.get(one);
    if (before !== undefined) return before;
    const { name, image } = one;
    const isWebp = image.mime === 'image/webp';
    if (isWebp) extensions.add(WEBP);
    const source = images.length;
    images.push({ name, mimeType: image.mime, bufferView: chunk.view(image.bytes) });
    entries.push(isWebp ? { extensions: { [WEBP]: { source } } } : { source });
    known.set(one, entries.length - 1);
    return entries.length - 1;
  };
  const made = skin.surfaces.map(({ material }): Json => {
    const index = material?.texture && skin.texcoords ? textureOf(material.texture) : undefined;
    const factor = material?.color && [...heldColor(material.color), 1];
    return {
      ...(material && { name: material.name }),
      doubleSided: true,
      pbrMetallicRoughness: {
        ...((factor || index === undefined) && { baseColorFactor: factor ?? [...PLAIN_COLOR, 1] }),
        ...(index !== undefined && { baseColorTexture: { index } }),
        metallicFactor: 0,
        roughnessFactor: 0.7,
      },
    };
  });
  return {
    json: {
      materials: made,
      ...(entries.length > 0 && { textures: entries, images }),
      ...(extensions.size > 0 && { extensionsUsed: [...extensions], extensionsRequired: [...extensions] }),
    },
    missing: given.missing,
  };
}

const WEBP = 'EXT_texture_webp';
