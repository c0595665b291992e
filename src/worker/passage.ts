/** What it takes to pass a message on. */
import { trackedOf } from '../model/takes/tracked-take.ts';

/**
 * Buffers of fewer bytes are cloned: handing one over takes both sides some 20 µs, in which this much is copied several
 * times.
 */
const MIN_BYTES = 1 << 16;
/** Cloned bytes that take as long as an object. */
const BYTES_PER_OBJECT = 1 << 10;

export interface Passage {
  /** The large buffers of typed arrays in the message, each once, to be transferred instead of copied. */
  readonly transfer: ArrayBuffer[];
  /** Number of objects in it, cloned bytes included. */
  readonly weight: number;
}

export function passageOf(message: unknown): Passage {
  const transfer = new Set<ArrayBuffer>();
  let weight = 0;
  const stack: unknown[] = [message];
  while (stack.length) {
    const item = stack.pop();
    weight++;
    if (ArrayBuffer.isView(item)) {
      const { buffer } = item;
      if (buffer instanceof ArrayBuffer && buffer.byteLength >= MIN_BYTES) transfer.add(buffer);
      else weight += item.byteLength / BYTES_PER_OBJECT;
    } else if (Array.isArray(item)) {
      // Lists of numbers are long and contain no buffers: checking the first item is enough.
      if (typeof item[0] === 'number') weight += (8 * item.length) / BYTES_PER_OBJECT;
      else for (const each of item) if (typeof each === 'object') stack.push(each);
    } else if (typeof item === 'object' && item !== null) {
      for (const each of Object.values(trackedOf(item) ?? item))
        if (typeof each === 'object' && each !== null) stack.push(each);
    }
  }
  return { transfer: [...transfer], weight };
}
