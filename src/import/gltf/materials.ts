/**
 * Materials and textures: of each material the base colour and its image, the only ones that a skin can have. Where the
 * base is black, the colour that the material emits and its image are these.
 */
import { textureMime, tooManyPixels } from '../../formats/texture/read.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { baseName, type SourceFile, type Texture } from '../../model/files.ts';
import { DistinctNames } from '../../model/names/distinct-names.ts';
import { isBlack } from '../black.ts';
import { cleanName } from '../clean-names.ts';
import { counted, type Import, ImportError, type Remarks } from '../imported.ts';
import type { SceneMaterial } from '../scene.ts';
import type { Buffers } from './buffers.ts';
import { readDataUri, unescaped } from './data-uri.ts';
import { countOf, type Document, extensionOf, type Json, numberOf, numbersOf, objectOf, textOf } from './json.ts';

/** The materials and textures of a file. */
export interface Materials {
  readonly materials: readonly SceneMaterial[];
  readonly textures: readonly Texture[];
  /** Texture mappings, by the indices of the materials. */
  readonly mappings: readonly Mapping[];
  /** Files that were used. */
  readonly sources: readonly SourceFile[];
}

/** How a material finds its texture's place of a vertex. */
export interface Mapping {
  /** Number of `TEXCOORD_0` and so on. */
  readonly set: number;
  /** Six numbers a b c d e f: u′ = a·u + b·v + c, v′ = d·u + e·v + f; v down. Absent: none. */
  readonly transform?: readonly number[];
}

const NO_MAPPING: Mapping = { set: 0 };

/** Those that a character can't have, with what a message calls them. */
const OTHER_TEXTURES = {
  normalTexture: 'normal',
  occlusionTexture: 'occlusion',
} as const;

/** The images that materials name, each read once. */
class Images {
  readonly textures: Texture[] = [];
  /** Files beside the document. */
  readonly sources: SourceFile[] = [];
  private readonly distinct = new DistinctNames();
  private readonly names = new Map<number, string | undefined>();

  constructor(
    private readonly document: Document,
    private readonly buffers: Buffers,
    private readonly given: Import,
    private readonly remarks: Remarks,
  ) {}

  /** Name of a texture's image; undefined if it can't be used. */
  async nameOf(texture: Json): Promise<string | undefined> {
    const webp = extensionOf(texture, 'EXT_texture_webp')?.source;
    const index = countOf(texture.source ?? webp);
    if (index === undefined) {
      if (extensionOf(texture, 'KHR_texture_basisu')) this.remarks.leaveOut('Basis Universal textures (KTX2)');
      if (extensionOf(texture, 'EXT_texture_avif')) this.remarks.leaveOut('AVIF textures');
      return undefined;
    }
    if (!this.names.has(index))
      this.names.set(index, await this.read(this.document.at('images', index, 'A texture'), index));
    return this.names.get(index);
  }

  private async read(image: Json, index: number): Promise<string | undefined> {
    const uri = textOf(image.uri);
    let bytes: Uint8Array<ArrayBuffer> | undefined;
    let stated = textOf(image.mimeType);
    if (uri === undefined) bytes = this.buffers.view(image.bufferView, `image ${index}`).bytes;
    else {
      const inside = readDataUri(uri);
      if (inside) {
        bytes = inside.bytes;
        stated ??= inside.mime;
      } else {
        const found = await this.given.beside(unescaped(uri));
        // Named all the same: it may be opened later. That it is missing is told with the character.
        if (!found) return baseName(unescaped(uri));
        bytes = found.bytes;
        this.sources.push(found.source);
      }
    }
    const pixels = tooManyPixels(bytes);
    if (pixels !== undefined) {
      this.remarks.leaveOut(`the image ${index}, which has ${pixels} pixels`);
      return undefined;
    }
    const mime = mimeOf(bytes) ?? stated;
    const extension = EXTENSIONS[mime ?? ''];
    if (!mime || !extension) {
      this.remarks.leaveOut(`the image ${index}, which is ${mime ?? 'of unknown type'}`);
      return undefined;
    }
    const file = uri === undefined || uri.startsWith('data:') ? undefined : baseName(unescaped(uri));
    const called = cleanName(file ?? textOf(image.name) ?? '') || `texture_${index}`;
    const name = this.distinct.add(textureNamed(called, extension));
    // A copy: the file's own bytes would all be kept with it, and passed from the worker.
    this.textures.push({ name, mime, bytes: bytes.slice() });
    return name;
  }
}

/** Reads all materials, with images inside the file and beside it; what can't be used is left out with a remark. */
export async function readMaterials(
  document: Document,
  buffers: Buffers,
  given: Import,
  remarks: Remarks,
): Promise<Materials> {
  const images = new Images(document, buffers, given, remarks);
  const further = new Map<string, number>();
  const materials: SceneMaterial[] = [];
  const mappings: Mapping[] = [];
  let emitters = 0;
  for (const [index, json] of document.all('materials').entries()) {
    const rough = objectOf(json.pbrMetallicRoughness);
    const { base, emitted } = colorsOf(json);
    const isEmitter = emitted !== undefined && isBlack(base.factor);
    if (emitted && !isEmitter) emitters++;
    const { info, factor } = isEmitter ? emitted : base;
    let texture: string | undefined;
    if (info) {
      try {
        texture = await images.nameOf(document.at('textures', info.index, `Material ${index}`));
      } catch (error) {
        // A picture is no reason to lose the character.
        if (!(error instanceof ImportError)) throw error;
        remarks.warn(error.code, error.message, 'drawn without it');
      }
    }
    for (const [key, called] of Object.entries(OTHER_TEXTURES)) if (json[key]) count(further, called);
    if (rough?.metallicRoughnessTexture) count(further, 'metallic');
    const color = colorOf(factor, texture !== undefined);
    materials.push({
      name: textOf(json.name) ?? '',
      ...(color && { color }),
      ...(texture !== undefined && { texture }),
    });
    mappings.push(info ? mappingOf(info) : NO_MAPPING);
  }
  const total = [...further.values()].reduce((sum, n) => sum + n, 0);
  if (total) remarks.leaveOut(`${counted(total, 'further texture')} of materials (${[...further.keys()].join(', ')})`);
  if (emitters) remarks.leaveOut(`the emissive colour of ${counted(emitters, 'material')}`);
  const { textures, sources } = images;
  return { materials, textures, mappings, sources };
}

/** A colour of a material and its image, as the file states them. */
interface Tint {
  /** Linear red, green and blue; absent: white. */
  readonly factor?: readonly number[];
  readonly info?: Json;
}

/** The colour that a material reflects, and that which it emits, if any. */
function colorsOf(json: Json): { readonly base: Tint; readonly emitted?: Tint } {
  const rough = objectOf(json.pbrMetallicRoughness);
  const glossy = extensionOf(json, 'KHR_materials_pbrSpecularGlossiness');
  const base = {
    info: objectOf(rough?.baseColorTexture) ?? objectOf(glossy?.diffuseTexture),
    factor: numbersOf(rough?.baseColorFactor, 4) ?? numbersOf(glossy?.diffuseFactor, 4),
  };
  const strength = numberOf(extensionOf(json, 'KHR_materials_emissive_strength')?.emissiveStrength) ?? 1;
  const factor = numbersOf(json.emissiveFactor, 3)?.map((c) => Math.min(1, Math.max(0, c * strength)));
  return factor && !isBlack(factor) ? { base, emitted: { info: objectOf(json.emissiveTexture), factor } } : { base };
}

function count(counts: Map<string, number>, key: string): void {
  counts.set(key, (counts.get(key) ?? 0) + 1);
}

/** White, which changes nothing, is left out beside a texture. */
function colorOf(factor: readonly number[] | undefined, isTextured: boolean): Vec3 | undefined {
  if (!factor) return undefined;
  const color: Vec3 = [factor[0], factor[1], factor[2]];
  return isTextured && color.every((c) => c === 1) ? undefined : color;
}

/** The KHR_texture_transform of a texture: T(offset) · R(rotation) · S(scale). */
function mappingOf(info: Json): Mapping {
  const own = extensionOf(info, 'KHR_texture_transform');
  const set = countOf(own?.texCoord) ?? countOf(info.texCoord) ?? 0;
  if (!own) return { set };
  const [ox, oy] = numbersOf(own.offset, 2) ?? [0, 0];
  const [sx, sy] = numbersOf(own.scale, 2) ?? [1, 1];
  const angle = numberOf(own.rotation) ?? 0;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return { set, transform: [sx * c, sy * s, ox, -sx * s, sy * c, oy] };
}

const EXTENSIONS: Readonly<Record<string, string>> = {
  'image/png': 'png',
  'image/jpeg': 'jpg',
  'image/webp': 'webp',
  'image/bmp': 'bmp',
};

/** By the first bytes, which are right more often than what files say. */
function mimeOf(bytes: Uint8Array): string | undefined {
  const text = String.fromCharCode(...bytes.subarray(0, 12));
  if (text.startsWith('\x89PNG')) return textureMime('png');
  if (text.startsWith('\xff\xd8\xff')) return textureMime('jpg');
  if (text.startsWith('RIFF') && text.slice(8) === 'WEBP') return textureMime('webp');
  if (text.startsWith('BM')) return textureMime('bmp');
  return undefined;
}

/** The name with that extension, unless it has an equivalent one. */
function textureNamed(name: string, extension: string): string {
  const own = name.slice(name.lastIndexOf('.') + 1).toLowerCase();
  return own === extension || (own === 'jpeg' && extension === 'jpg') ? name : `${name}.${extension}`;
}
