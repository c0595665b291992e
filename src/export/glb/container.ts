/**
 * The GLB container, and the accessors of its binary chunk (glTF 2.0, "GLB File Format"):
 *
 *     "glTF" 2 length │ length "JSON" {…} spaces │ length "BIN\0" bytes zeros
 *
 * Values are collected as typed arrays and written one after the other: no second copy of the whole is made.
 */

/** glTF's code for components of 32-bit floats. */
export const FLOAT = 5126;
/** glTF's code for components of unsigned bytes. */
export const UNSIGNED_BYTE = 5121;
/** glTF's code for components of unsigned 16-bit integers. */
export const UNSIGNED_SHORT = 5123;
/** glTF's code for components of unsigned 32-bit integers. */
export const UNSIGNED_INT = 5125;
/** glTF's code for a buffer view with vertex attributes. */
export const VERTICES = 34962;
/** glTF's code for a buffer view with vertex indices. */
export const INDICES = 34963;

type Values = Float32Array<ArrayBuffer> | Uint8Array<ArrayBuffer> | Uint16Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;

const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 } as const;
/** Shape of one element of an accessor. */
export type AccessorType = keyof typeof WIDTHS;

/** Part of the JSON. */
export type Json = { readonly [name: string]: unknown };

/** Properties that an accessor states beside its values. */
export interface AccessorOptions {
  readonly target?: typeof VERTICES | typeof INDICES;
  /** Whether to state the minimum and maximum of each component. */
  readonly bounds?: boolean;
}

/** Collects the binary chunk, with the buffer views and accessors into it. */
export class BinaryChunk {
  private readonly pieces: Uint8Array<ArrayBuffer>[] = [];
  private byteLength = 0;
  private readonly bufferViews: Json[] = [];
  private readonly accessors: Json[] = [];

  /** Adds values as an accessor; returns its index. */
  accessor(type: AccessorType, values: Values, { target, bounds }: AccessorOptions = {}): number {
    const width = WIDTHS[type];
    this.accessors.push({
      bufferView: this.view(values, target),
      componentType: componentType(values),
      count: values.length / width,
      type,
      ...(bounds && boundsOf(values, width)),
    });
    return this.accessors.length - 1;
  }

  /**
   * Adds an accessor of zeros but for some elements; returns its index.
   * @param count of all elements
   * @param indices ascending, each below `count`
   * @param values of these, x y z each
   */
  sparse(count: number, indices: Uint32Array, values: Float32Array<ArrayBuffer>, bounds: boolean): number {
    const last = indices.length ? indices[indices.length - 1] : 0;
    const small = last < 65536 ? Uint16Array.from(indices) : Uint32Array.from(indices);
    const all = indices.length < count ? Float32Array.of(...[0, 0, 0], ...extremes(values, 3)) : values;
    this.accessors.push({
      componentType: FLOAT,
      count,
      type: 'VEC3',
      ...(bounds && boundsOf(all, 3)),
      ...(indices.length && {
        sparse: {
          count: indices.length,
          indices: { bufferView: this.view(small), componentType: componentType(small) },
          values: { bufferView: this.view(values) },
        },
      }),
    });
    return this.accessors.length - 1;
  }

  /** Adds bytes or values as a buffer view; returns its index. */
  view(values: Values, target?: number): number {
    const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
    this.bufferViews.push({
      buffer: 0,
      byteOffset: this.byteLength,
      byteLength: bytes.length,
      ...(target && { target }),
    });
    this.push(bytes);
    const padding = -bytes.length & 3;
    if (padding) this.push(new Uint8Array(padding));
    return this.bufferViews.length - 1;
  }

  private push(bytes: Uint8Array<ArrayBuffer>): void {
    this.pieces.push(bytes);
    this.byteLength += bytes.length;
  }

  /**
   * The file.
   * @param json all but buffers, buffer views and accessors
   */
  file(json: Json): Uint8Array<ArrayBuffer>[] {
    const whole = {
      ...json,
      ...(this.accessors.length && { accessors: this.accessors }),
      ...(this.bufferViews.length && { bufferViews: this.bufferViews }),
      ...(this.byteLength && { buffers: [{ byteLength: this.byteLength }] }),
    };
    const text = new TextEncoder().encode(JSON.stringify(whole));
    const spaces = -text.length & 3;
    const jsonLength = text.length + spaces;
    const hasBinary = this.byteLength > 0;
    const length = 12 + 8 + jsonLength + (hasBinary ? 8 + this.byteLength : 0);
    const head = words(GLTF, 2, length, jsonLength, JSON_CHUNK);
    const pieces = [head, text, new Uint8Array(spaces).fill(32)];
    return hasBinary ? [...pieces, words(this.byteLength, BIN_CHUNK), ...this.pieces] : pieces;
  }
}

const GLTF = 0x46546c67;
const JSON_CHUNK = 0x4e4f534a;
const BIN_CHUNK = 0x004e4942;

/** Unsigned, least significant byte first. */
function words(...values: readonly number[]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(4 * values.length);
  const view = new DataView(bytes.buffer);
  values.forEach((value, i) => {
    view.setUint32(4 * i, value, true);
  });
  return bytes;
}

function componentType(values: Values): number {
  if (values instanceof Float32Array) return FLOAT;
  if (values instanceof Uint32Array) return UNSIGNED_INT;
  return values instanceof Uint16Array ? UNSIGNED_SHORT : UNSIGNED_BYTE;
}

function boundsOf(values: Values, width: number): Json {
  const all = extremes(values, width);
  return { min: all.slice(0, width), max: all.slice(width) };
}

/** Minimum of each component, then maximum of each. */
function extremes(values: Values, width: number): number[] {
  const all = [...new Array<number>(width).fill(Infinity), ...new Array<number>(width).fill(-Infinity)];
  for (let i = 0; i < values.length; i++) {
    const k = i % width;
    if (values[i] < all[k]) all[k] = values[i];
    if (values[i] > all[width + k]) all[width + k] = values[i];
  }
  return all;
}
