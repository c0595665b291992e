/** Small glTF files, by hand: numbers become accessors of their own. */

export interface Made {
  readonly json: Record<string, unknown>;
  readonly buffers: readonly Uint8Array<ArrayBuffer>[];
}

export class GltfMaker {
  readonly accessors: Record<string, unknown>[] = [];
  readonly views: Record<string, unknown>[] = [];
  private readonly chunks: Uint8Array[] = [];
  private length = 0;

  /** A view of some bytes; its index. */
  view(values: ArrayBufferView, more: Record<string, unknown> = {}): number {
    const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength).slice();
    const padding = (4 - (this.length % 4)) % 4;
    this.chunks.push(new Uint8Array(padding), bytes);
    this.length += padding + bytes.length;
    return (
      this.views.push({ buffer: 0, byteOffset: this.length - bytes.length, byteLength: bytes.length, ...more }) - 1
    );
  }

  /**
   * An accessor; its index.
   * @param more `stride`: bytes from one element to the next, where other values lie between them
   */
  add(type: keyof typeof WIDTHS, values: Values, { stride, ...more }: More = {}): number {
    const count = values.length / WIDTHS[type];
    const componentType = COMPONENTS[values.constructor.name];
    const bufferView = this.view(values, stride === undefined ? {} : { byteStride: stride });
    return this.accessors.push({ bufferView, componentType, type, count, ...boundsOf(type), ...more }) - 1;
  }

  /** An accessor of floats without bytes: zeros, but for what `more` replaces. */
  bare(type: keyof typeof WIDTHS, count: number, more: Record<string, unknown> = {}): number {
    return this.accessors.push({ componentType: 5126, type, count, ...boundsOf(type), ...more }) - 1;
  }

  made(rest: Record<string, unknown>): Made {
    const bytes = new Uint8Array(this.length);
    let at = 0;
    for (const chunk of this.chunks) {
      bytes.set(chunk, at);
      at += chunk.length;
    }
    return {
      json: {
        asset: { version: '2.0' },
        accessors: this.accessors,
        bufferViews: this.views,
        buffers: [{ byteLength: bytes.length }],
        ...rest,
      },
      buffers: [bytes],
    };
  }
}

/** Readers ask for them, of positions. */
function boundsOf(type: keyof typeof WIDTHS) {
  return type === 'VEC3' && { min: [0, 0, 0], max: [1, 1, 1] };
}

type More = Record<string, unknown> & { readonly stride?: number };
type Values = Float32Array | Uint8Array | Uint16Array | Uint32Array | Int8Array | Int16Array;
const WIDTHS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 } as const;
const COMPONENTS: Readonly<Record<string, number>> = {
  Int8Array: 5120,
  Uint8Array: 5121,
  Int16Array: 5122,
  Uint16Array: 5123,
  Uint32Array: 5125,
  Float32Array: 5126,
};

/** As one file, padded as the format asks. */
export function glbOf({ json, buffers: [binary] }: Made): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const padded = (n: number) => Math.ceil(n / 4) * 4;
  const out = new Uint8Array(12 + 8 + padded(text.length) + 8 + padded(binary.length));
  const view = new DataView(out.buffer);
  out.fill(32, 20, 20 + padded(text.length));
  const header = [0x46546c67, 2, out.length, padded(text.length), 0x4e4f534a];
  for (const [i, n] of header.entries()) view.setUint32(4 * i, n, true);
  out.set(text, 20);
  const at = 20 + padded(text.length);
  view.setUint32(at, padded(binary.length), true);
  view.setUint32(at + 4, 0x004e4942, true);
  out.set(binary, at + 8);
  return out;
}
