/** Materials of a skin, with their textures inside the file. */
import type { Character } from '../../model/document.ts';
import { baseName, sameName } from '../../model/files.ts';
import type { Skin } from '../../model/skin.ts';
import { imageOf } from '../shared/images/images.ts';
import type { BinaryChunk, Json } from './container.ts';

/** The materials of a skin as JSON, with what is missing. */
export interface GlbMaterials {
  /** Materials, one per surface, textures and images, and the extensions that they need. */
  readonly json: Json;
  /** Names of textures that are not there, or are no images that viewers read. */
  readonly missing: readonly string[];
}

/** Colour of what has none: a light grey. */
const PLAIN = [0.8, 0.8, 0.8, 1];

/** Makes materials of a skin's surfaces, and adds their images to the binary chunk, each once. */
export function addMaterials(chunk: BinaryChunk, { textures }: Character, skin: Skin): GlbMaterials {
  const images: Json[] = [];
  const entries: Json[] = [];
  const missing: string[] = [];
  const known = new Map<string, number>();
  const extensions = new Set<string>();
  const textureOf = (name: string): number | undefined => {
    const base = baseName(name).toLowerCase();
    const before = known.get(base);
    if (before !== undefined) return before;
    const texture = textures.find((one) => sameName(baseName(one.name), baseName(name)));
    const image = texture && imageOf(texture);
    if (!image) {
      missing.push(name);
      return undefined;
    }
    const isWebp = image.mime === 'image/webp';
    if (isWebp) extensions.add(WEBP);
    const source = images.length;
    images.push({ name: baseName(name), mimeType: image.mime, bufferView: chunk.view(image.bytes) });
    entries.push(isWebp ? { extensions: { [WEBP]: { source } } } : { source });
    known.set(base, entries.length - 1);
    return entries.length - 1;
  };
  const made = skin.surfaces.map(({ material }): Json => {
    const index = material?.texture && skin.texcoords ? textureOf(material.texture) : undefined;
    const factor = material?.color && [...material.color.map((c) => Math.min(1, Math.max(0, c))), 1];
    return {
      ...(material && { name: material.name }),
      doubleSided: true,
      pbrMetallicRoughness: {
        ...((factor || index === undefined) && { baseColorFactor: factor ?? PLAIN }),
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
    missing,
  };
}

const WEBP = 'EXT_texture_webp';
