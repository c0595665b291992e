/** The materials of an FBX file as far as they are drawn: a diffuse colour or texture, embedded or by name. */

import { textureMime, tooManyPixels } from '../../formats/texture/read.ts';
import { type Vec3, ZERO } from '../../math/vec3.ts';
import { baseName, type Texture } from '../../model/files.ts';
import { isBlack } from '../black.ts';
import { fromBase64 } from '../gltf/data-uri.ts';
import type { SceneMaterial } from '../scene.ts';
import { type FbxDocument, type FbxObject, partsOfKind } from './document.ts';
import { imageType } from './images.ts';
import { childOf, textAt } from './records/record.ts';

/** The properties that the colour of a surface is connected to, by program. */
const COLOR =
  /^(DiffuseColor|Diffuse|.*\|(baseColor|base_color|base_color_map|basecolor|DiffuseTexture|TEX_color_map))$/i;
const GREY: Vec3 = [0.8, 0.8, 0.8];

/** Collects the materials and textures that meshes use, each once. */
export class Materials {
  readonly materials: SceneMaterial[] = [];
  readonly textures: Texture[] = [];
  /** Contents that are not drawn: other kinds of textures, images that browsers can't show. */
  readonly lost = new Set<string>();
  private readonly indices = new Map<number, number>();
  private readonly names = new Map<number, string>();

  constructor(private readonly document: FbxDocument) {}

  /** The indices of a model's materials, in the order of its slots. */
  of(model: FbxObject): number[] {
    return partsOfKind(this.document, model, 'Material').map((material) => {
      const known = this.indices.get(material.id);
      if (known !== undefined) return known;
      this.indices.set(material.id, this.materials.length);
      return this.materials.push(this.read(material)) - 1;
    });
  }

  private read(material: FbxObject): SceneMaterial {
    const { properties, name } = material;
    const links = this.document.partsOf(material.id).filter(({ object }) => /Texture$/.test(object.kind));
    const linked = (names: RegExp) => links.find(({ property }) => property !== undefined && names.test(property));
    const diffuse = properties.vector(
      'DiffuseColor',
      properties.vector('Diffuse', properties.vector('Maya|baseColor', GREY)),
    );
    const base = { color: times(diffuse, properties.number('DiffuseFactor') ?? 1), link: linked(COLOR) };
    const strength = properties.number('EmissiveFactor') ?? 1;
    const emitted = {
      color: times(properties.vector('EmissiveColor', ZERO), strength),
      link: linked(/^EmissiveColor$/),
    };
    const emits = !isBlack(emitted.color) || (emitted.link !== undefined && strength > 0);
    // What emits light and reflects none is seen by what it emits.
    const isEmitter = emits && !base.link && isBlack(base.color);
    if (emits && !isEmitter) this.lost.add('emissive colours');
    const { color, link } = isEmitter ? emitted : base;
    if (links.some((own) => own !== link && own !== emitted.link)) {
      this.lost.add('textures other than diffuse');
    }
    const texture = link && this.textureOf(link.object);
    return texture === undefined ? { name, color } : { name, texture };
  }

  /** The name of a texture, whose image is added if the file holds it; undefined if it has none. */
  private textureOf(object: FbxObject): string | undefined {
    if (object.kind === 'LayeredTexture') {
      const [first, ...others] = partsOfKind(this.document, object, 'Texture');
      if (others.length > 0) this.lost.add('texture layers after the first');
      return first && this.textureOf(first);
    }
    const known = this.names.get(object.id);
    if (known !== undefined) return known;
    const [video] = partsOfKind(this.document, object, 'Video');
    const file = fileNameOf(object) ?? (video && fileNameOf(video)) ?? object.name;
    const content = video && contentOf(video);
    const name = content ? this.embed(file || video.name || 'texture', content) : file;
    if (name) this.names.set(object.id, name);
    return name || undefined;
  }

  private embed(file: string, bytes: Uint8Array<ArrayBuffer>): string {
    const type = imageType(bytes);
    if (!type) {
      this.lost.add(`the image ${file}, which is not PNG, JPEG, WebP or BMP`);
      return file;
    }
    const pixels = tooManyPixels(bytes);
    if (pixels !== undefined) {
      this.lost.add(`the image ${file}, which has ${pixels} pixels`);
      return file;
    }
    const dot = file.lastIndexOf('.');
    const stem = dot > 0 ? file.slice(0, dot) : file;
    const own = textureMime(file.slice(dot + 1).toLowerCase()) === textureMime(type) ? file : `${stem}.${type}`;
    const isTaken = (name: string) =>
      this.textures.some(
        (texture) => texture.name.toLowerCase() === name.toLowerCase() && !sameBytes(texture.bytes, bytes),
      );
    let name = own;
    for (let n = 2; isTaken(name); n++) name = `${stem}_${n}.${type}`;
    if (!this.textures.some((texture) => texture.name === name)) {
      this.textures.push({ name, mime: textureMime(type), bytes });
    }
    return name;
  }
}

/** From 0 to 1. */
function times([r, g, b]: Vec3, factor: number): Vec3 {
  const limited = (value: number) => Math.min(1, Math.max(0, value * factor));
  return [limited(r), limited(g), limited(b)];
}

function fileNameOf({ record }: FbxObject): string | undefined {
  const path = ['RelativeFilename', 'FileName', 'Filename'].map((name) => textAt(childOf(record, name))).find(Boolean);
  return path && baseName(path);
}

/** The bytes of an embedded image, as they are or in base64; undefined if there are none. */
function contentOf({ record }: FbxObject): Uint8Array<ArrayBuffer> | undefined {
  const values = childOf(record, 'Content')?.values ?? [];
  const [first] = values;
  if (first instanceof Uint8Array) return first.length > 0 ? new Uint8Array(first) : undefined;
  const text = values.filter((value) => typeof value === 'string').join('');
  return text === '' ? undefined : fromBase64(text);
}

function sameBytes(a: Uint8Array, b: Uint8Array): boolean {
  return a.length === b.length && a.every((byte, i) => byte === b[i]);
}
