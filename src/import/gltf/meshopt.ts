/** EXT_meshopt_compression: buffer views packed by meshoptimizer. Its decoder is fetched only for files that need it. */
import { ImportError } from '../imported.ts';

/** Unpacks buffer views. */
export interface MeshoptDecoder {
  /** @throws ImportError if the bytes are damaged */
  decode(
    count: number,
    stride: number,
    bytes: Uint8Array,
    mode: string,
    filter: string,
    called: string,
  ): Uint8Array<ArrayBuffer>;
}

/** Bytes that a view may unpack to: a count may be made up. */
const MAX_BYTES = 2 ** 29;

/** Fetches the decoder. Its `decode` limits how much bytes may become. */
export async function meshoptDecoder(): Promise<MeshoptDecoder> {
  const { MeshoptDecoder: decoder } = await import('meshoptimizer/decoder');
  await decoder.ready;
  return {
    decode(count, stride, bytes, mode, filter, called) {
      // Packed bytes are at least one for 16 elements of a byte of the stride.
      if (count * stride > MAX_BYTES || count * stride > (bytes.length + 32) * 4096) {
        const message = `${called} would unpack ${bytes.length} bytes to ${count * stride}.`;
        throw new ImportError('compressed-too-large', message);
      }
      const out = new Uint8Array(count * stride);
      try {
        decoder.decodeGltfBuffer(out, count, stride, bytes, mode, filter);
      } catch (error) {
        const reason = error instanceof Error ? error.message : String(error);
        throw new ImportError('compressed-damaged', `${called} can't be unpacked: ${reason}.`);
      }
      return out;
    },
  };
}
