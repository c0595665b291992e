/**
 * Windows bitmaps, which glTF lacks, as pixels: 1, 4, 8, 16, 24 and 32 bits, with palettes and masks, from either end,
 * run-length encoded or not ("Bitmap Storage", learn.microsoft.com).
 */

/** A picture of 8 bits a channel. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  /** Red, green, blue, alpha from the top left, row by row. */
  readonly rgba: Uint8Array<ArrayBuffer>;
  readonly hasAlpha: boolean;
}

/** More than this is a mistake, or an attack. */
const MAX_PIXELS = 64_000_000;

/** Compression. */
const RGB = 0;
const RLE8 = 1;
const RLE4 = 2;
const BITFIELDS = 3;
const ALPHA_BITFIELDS = 6;

/** The pixels of a bitmap; undefined if it is broken or of a kind that no one writes. */
export function readBmp(bytes: Uint8Array): Pixels | undefined {
  if (bytes.length < 26 || bytes[0] !== 0x42 || bytes[1] !== 0x4d) return undefined;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const start = view.getUint32(10, true);
  const headSize = view.getUint32(14, true);
  const isCore = headSize === 12;
  if (!isCore && (headSize < 40 || bytes.length < 14 + headSize)) return undefined;
  const width = isCore ? view.getUint16(18, true) : view.getInt32(18, true);
  const rows = isCore ? view.getUint16(20, true) : view.getInt32(22, true);
  const bits = view.getUint16(isCore ? 24 : 28, true);
  const compression = isCore ? RGB : view.getUint32(30, true);
  const height = Math.abs(rows);
  if (!(width > 0 && height > 0) || width * height > MAX_PIXELS) return undefined;
  const rgba = new Uint8Array(4 * width * height);
  const put = (x: number, y: number, r: number, g: number, b: number, a = 255) => {
    if (x >= width || y >= height) return;
    const o = 4 * (width * (rows < 0 ? y : height - 1 - y) + x);
    rgba[o] = r;
    rgba[o + 1] = g;
    rgba[o + 2] = b;
    rgba[o + 3] = a;
  };
  const hasMasks = compression === BITFIELDS || compression === ALPHA_BITFIELDS;
  const masksAfter = hasMasks && headSize === 40 ? (compression === BITFIELDS ? 12 : 16) : 0;
  const paletteAt = 14 + headSize + masksAfter;
  const entry = isCore ? 3 : 4;
  const fromPalette = (x: number, y: number, index: number) => {
    const o = paletteAt + entry * index;
    if (o + 3 <= Math.min(start, bytes.length)) put(x, y, bytes[o + 2], bytes[o + 1], bytes[o]);
  };

  if (compression === RLE8 || compression === RLE4) {
    if (bits !== (compression === RLE8 ? 8 : 4)) return undefined;
    for (let i = 3; i < rgba.length; i += 4) rgba[i] = 255;
    readRuns(bytes, start, compression === RLE4, height, fromPalette);
    return { width, height, rgba, hasAlpha: false };
  }
  const stride = 4 * Math.ceil((width * bits) / 32);
  if (start + stride * height > bytes.length) return undefined;
  if (bits === 1 || bits === 4 || bits === 8) {
    if (compression !== RGB) return undefined;
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        const byte = bytes[start + y * stride + ((x * bits) >> 3)];
        fromPalette(x, y, (byte >> (8 - bits - ((x * bits) & 7))) & ((1 << bits) - 1));
      }
    }
    return { width, height, rgba, hasAlpha: false };
  }
  if ((bits !== 16 && bits !== 24 && bits !== 32) || (compression !== RGB && !hasMasks)) return undefined;
  const mask = (i: number) => (54 + 4 * i + 4 <= bytes.length ? view.getUint32(54 + 4 * i, true) : 0);
  const hasAlphaMask = compression === ALPHA_BITFIELDS || headSize >= 56;
  const masks = hasMasks
    ? [mask(0), mask(1), mask(2), hasAlphaMask ? mask(3) : 0]
    : bits === 16
      ? [0x7c00, 0x3e0, 0x1f, 0]
      : [0xff0000, 0xff00, 0xff, 0];
  const channels = masks.map(channelOf);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const o = start + y * stride + (x * bits) / 8;
      const word =
        bits === 16
          ? view.getUint16(o, true)
          : (bytes[o] | (bytes[o + 1] << 8) | (bytes[o + 2] << 16) | (bits === 32 ? bytes[o + 3] << 24 : 0)) >>> 0;
      const [r, g, b, a] = channels.map((channel) => channel(word));
      put(x, y, r, g, b, masks[3] ? a : 255);
    }
  }
  return { width, height, rgba, hasAlpha: masks[3] !== 0 };
}

/** The value of some bits of a word, from 0 to 255. */
function channelOf(mask: number): (word: number) => number {
  if (mask === 0) return () => 0;
  const shift = 31 - Math.clz32(mask & -mask);
  const most = mask >>> shift;
  return (word) => Math.round((((word & mask) >>> shift) * 255) / most);
}

function readRuns(
  bytes: Uint8Array,
  start: number,
  isHalf: boolean,
  height: number,
  put: (x: number, y: number, index: number) => void,
): void {
  let x = 0;
  let y = 0;
  const at = (o: number, i: number) =>
    isHalf ? (i % 2 ? bytes[o + (i >> 1)] & 15 : bytes[o + (i >> 1)] >> 4) : bytes[o + i];
  for (let o = start; o + 1 < bytes.length && y < height; ) {
    const count = bytes[o];
    const value = bytes[o + 1];
    o += 2;
    if (count > 0) {
      for (let i = 0; i < count; i++) put(x++, y, isHalf ? (i % 2 ? value & 15 : value >> 4) : value);
    } else if (value === 0) {
      x = 0;
      y++;
    } else if (value === 1) return;
    else if (value === 2) {
      x += bytes[o] ?? 0;
      y += bytes[o + 1] ?? 0;
      o += 2;
    } else {
      for (let i = 0; i < value && o + (isHalf ? i >> 1 : i) < bytes.length; i++) put(x++, y, at(o, i));
      const length = isHalf ? Math.ceil(value / 2) : value;
      o += length + (length & 1);
    }
  }
}
