/**
 * Accessors: lists of numbers or vectors in buffer views, as the file has them where that is one list, else as doubles.
 * Normalised integers become fractions:
 *
 *     unsigned  c / (2ⁿ − 1)          signed  max(c / (2ⁿ⁻¹ − 1), −1)
 */
import { ImportError } from '../imported.ts';
import type { Buffers } from './buffers.ts';
import { countOf, type Document, type Json, objectOf, shown, textOf } from './json.ts';

/** Numbers of a file: a view of its own bytes, which must not be changed, or doubles. */
export type NumberList = InstanceType<
  | typeof Float64Array<ArrayBuffer>
  | typeof Float32Array<ArrayBuffer>
  | typeof Uint32Array<ArrayBuffer>
  | typeof Uint16Array<ArrayBuffer>
  | typeof Int16Array<ArrayBuffer>
  | typeof Uint8Array<ArrayBuffer>
  | typeof Int8Array<ArrayBuffer>
>;

interface Component {
  readonly bytes: number;
  /** The largest value of an integer; 0 for floats. */
  readonly largest: number;
  read(view: DataView, at: number): number;
  /** Of packed numbers, in the order of bytes of all machines that browsers run on, which is that of files. */
  list(buffer: ArrayBuffer, offset: number, count: number): NumberList;
}

const COMPONENTS: Readonly<Record<number, Component>> = {
  5120: { bytes: 1, largest: 127, read: (view, at) => view.getInt8(at), list: (...of) => new Int8Array(...of) },
  5121: { bytes: 1, largest: 255, read: (view, at) => view.getUint8(at), list: (...of) => new Uint8Array(...of) },
  5122: {
    bytes: 2,
    largest: 32767,
    read: (view, at) => view.getInt16(at, true),
    list: (...of) => new Int16Array(...of),
  },
  5123: {
    bytes: 2,
    largest: 65535,
    read: (view, at) => view.getUint16(at, true),
    list: (...of) => new Uint16Array(...of),
  },
  5125: {
    bytes: 4,
    largest: 4294967295,
    read: (view, at) => view.getUint32(at, true),
    list: (...of) => new Uint32Array(...of),
  },
  5126: {
    bytes: 4,
    largest: 0,
    read: (view, at) => view.getFloat32(at, true),
    list: (...of) => new Float32Array(...of),
  },
};

const WIDTHS: Readonly<Record<string, number>> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 };

/** Numbers that a file may leave out because they are 0, besides one for each of its bytes. */
const MAX_ZEROS = 2 ** 16;

/** Elements of `width` numbers each. */
export interface Numbers {
  readonly count: number;
  readonly width: number;
  readonly values: NumberList;
}

/** Values that replace those of some elements. */
export interface SparseNumbers {
  /** Ascending, each below the count. */
  readonly indices: Uint32Array;
  readonly width: number;
  readonly values: NumberList;
}

/** Reads the accessors of a file, each once. */
export class Accessors {
  private readonly known = new Map<number, Numbers>();
  private zeros = 0;

  constructor(
    private readonly document: Document,
    private readonly buffers: Buffers,
  ) {}

  /** Numbers per element. */
  width(index: unknown, where: string): number {
    return this.header(index, where).width;
  }

  /**
   * All numbers of an accessor, shared by all that ask for it.
   * @param width expected numbers per element
   * @param where what refers to it, for messages
   * @throws ImportError
   */
  numbers(index: unknown, width: number, where: string): Numbers {
    const found = this.known.get(Number(index)) ?? this.read(index, where);
    if (found.width !== width) {
      const message = `${where} needs ${width} numbers per element; accessor ${index} has ${found.width}.`;
      throw new ImportError('accessor-type-wrong', message);
    }
    this.known.set(Number(index), found);
    return found;
  }

  /** The elements of an accessor that differ from 0, if it says so; undefined if it lists all. */
  sparse(index: unknown, width: number, where: string): SparseNumbers | undefined {
    const { json, count, component, isNormalized, width: found } = this.header(index, where);
    if (json.bufferView !== undefined || found !== width) return undefined;
    const sparse = objectOf(json.sparse);
    if (!sparse) return { indices: new Uint32Array(0), width, values: new Float64Array(0) };
    return this.replaced(sparse, count, component, width, isNormalized, Number(index));
  }

  private header(index: unknown, where: string) {
    const json = this.document.at('accessors', index, where);
    const component = COMPONENTS[Number(json.componentType)];
    const width = WIDTHS[textOf(json.type) ?? ''];
    const count = countOf(json.count);
    if (!component || !width || count === undefined) {
      const message = `Accessor ${index} has the type ${shown(json.type)}, components ${shown(json.componentType)} and the count ${shown(json.count)}, which glTF doesn't know.`;
      throw new ImportError('accessor-type-wrong', message);
    }
    return { json, component, width, count, isNormalized: json.normalized === true };
  }

  private read(index: unknown, where: string): Numbers {
    const { json, component, width, count, isNormalized } = this.header(index, where);
    const called = `Accessor ${index}`;
    const sparse = objectOf(json.sparse);
    let values: NumberList;
    if (json.bufferView === undefined) {
      this.zeros += count * width;
      const most = MAX_ZEROS + this.buffers.budget.bytes;
      if (this.zeros > most) {
        const message = `${called} has ${count} elements without any bytes; up to ${most} numbers of this file are read.`;
        throw new ImportError('accessor-too-large', message);
      }
      values = new Float64Array(count * width);
    } else {
      const offset = countOf(json.byteOffset) ?? 0;
      values = this.elements(json.bufferView, offset, count, width, component, isNormalized, called);
    }
    if (sparse) {
      const given = this.replaced(sparse, count, component, width, isNormalized, Number(index));
      // The list without replacements may be the file's.
      const whole = new Float64Array(values);
      given.indices.forEach((element, i) => {
        for (let k = 0; k < width; k++) whole[element * width + k] = given.values[i * width + k];
      });
      values = whole;
    }
    return { count, width, values };
  }

  private elements(
    viewIndex: unknown,
    offset: number,
    count: number,
    width: number,
    { bytes: size, largest, read, list }: Component,
    isNormalized: boolean,
    called: string,
  ): NumberList {
    const { bytes, stride: stated } = this.buffers.view(viewIndex, called);
    // Columns of small matrices start at multiples of four bytes.
    const rows = width === 4 ? 4 : Math.sqrt(width);
    const isMatrix = width === 9 || width === 16;
    const column = isMatrix ? Math.ceil((rows * size) / 4) * 4 : width * size;
    const packed = isMatrix ? column * rows : column;
    const stride = stated ?? packed;
    const end = count ? offset + (count - 1) * stride + packed : offset;
    if (end > bytes.length || (stride < packed && count > 1)) {
      const found = `${called} needs ${end} bytes of its buffer view, which has ${bytes.length}.`;
      throw new ImportError('accessor-too-long', `${found} The file may have been cut off: copy or export it again.`);
    }
    this.buffers.budget.spend(count * width, called);
    const isScaled = isNormalized && largest > 0;
    if (stride === packed && !isMatrix) {
      const start = bytes.byteOffset + offset;
      const isAligned = start % size === 0;
      const packedValues = isAligned
        ? list(bytes.buffer, start, count * width)
        : list(bytes.slice(offset, end).buffer, 0, count * width);
      if (!isScaled) return packedValues;
      const whole = new Float64Array(packedValues);
      for (let i = 0; i < whole.length; i++) whole[i] = Math.max(whole[i] / largest, -1);
      return whole;
    }
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const values = new Float64Array(count * width);
    const perColumn = isMatrix ? rows : width;
    for (let e = 0; e < count; e++) {
      const at = offset + e * stride;
      for (let k = 0; k < width; k++) {
        const value = read(view, at + Math.floor(k / perColumn) * column + (k % perColumn) * size);
        values[e * width + k] = isScaled ? Math.max(value / largest, -1) : value;
      }
    }
    return values;
  }

  private replaced(
    sparse: Json,
    count: number,
    component: Component,
    width: number,
    isNormalized: boolean,
    index: number,
  ): SparseNumbers {
    const called = `The sparse values of accessor ${index}`;
    const given = countOf(sparse.count) ?? 0;
    const where = objectOf(sparse.indices);
    const what = objectOf(sparse.values);
    const kind = COMPONENTS[Number(where?.componentType)];
    if (!where || !what || !kind || kind.largest === 0) {
      throw new ImportError('accessor-type-wrong', `${called} have no indices or no values.`);
    }
    const at = this.elements(where.bufferView, countOf(where.byteOffset) ?? 0, given, 1, kind, false, called);
    const values = this.elements(
      what.bufferView,
      countOf(what.byteOffset) ?? 0,
      given,
      width,
      component,
      isNormalized,
      called,
    );
    const beyond = at.find((element) => element >= count);
    if (beyond !== undefined) {
      throw new ImportError('index-out-of-range', `${called} are for element ${beyond} of ${count}.`);
    }
    return { indices: Uint32Array.from(at), width, values };
  }
}
