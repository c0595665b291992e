/** Unpacks the compressed arrays of FBX files: zlib data whose unpacked size is known. */
import { Unzlib, unzlibSync } from 'fflate';

/** So that data that unpacks to more than it says is noticed after at most 1032 times as many bytes. */
const STEP = 1 << 16;

/** Whether so many bytes can unpack to that size: deflate packs at most 1032 into one. */
export function canUnpackTo(packedBytes: number, size: number): boolean {
  return size <= 1040 * packedBytes + 64;
}

/**
 * The unpacked bytes; undefined if the data is damaged or unpacks to another size. What is beyond that size is never
 * kept, and hardly unpacked.
 */
export function inflateExactly(packed: Uint8Array, size: number): Uint8Array<ArrayBuffer> | undefined {
  if (!canUnpackTo(packed.length, size)) return undefined;
  return packed.length <= STEP ? inflatedAtOnce(packed, size) : inflatedInSteps(packed, size);
}

function inflatedAtOnce(packed: Uint8Array, size: number): Uint8Array<ArrayBuffer> | undefined {
  try {
    // Room for one byte more: data that unpacks to too much fills it, and is cut off there.
    const found = unzlibSync(packed, { out: new Uint8Array(size + 1) });
    return found.length === size ? found : undefined;
  } catch {
    return undefined;
  }
}

function inflatedInSteps(packed: Uint8Array, size: number): Uint8Array<ArrayBuffer> | undefined {
  const out = new Uint8Array(size);
  let at = 0;
  let isDone = false;
  const stream = new Unzlib((chunk, isLast) => {
    if (at + chunk.length <= size) out.set(chunk, at);
    at += chunk.length;
    isDone = isLast;
  });
  try {
    for (let from = 0; from < packed.length && at <= size; from += STEP) {
      stream.push(packed.subarray(from, from + STEP), from + STEP >= packed.length);
    }
  } catch {
    // fflate throws for damaged data; what is missing is told by the caller.
    return undefined;
  }
  return isDone && at === size ? out : undefined;
}
