/** The buffers of all typed arrays in a message, each once, to be transferred instead of copied. */
export function transferables(message: unknown): ArrayBuffer[] {
  const buffers = new Set<ArrayBuffer>();
  const stack: unknown[] = [message];
  while (stack.length) {
    const item = stack.pop();
    if (ArrayBuffer.isView(item)) {
      if (item.buffer instanceof ArrayBuffer && item.byteLength) buffers.add(item.buffer);
    } else if (Array.isArray(item)) {
      // Lists of numbers are long and contain no buffers: checking the first item is enough.
      if (typeof item[0] !== 'number') for (const each of item) if (typeof each === 'object') stack.push(each);
    } else if (typeof item === 'object' && item !== null) {
      for (const each of Object.values(item)) if (typeof each === 'object' && each !== null) stack.push(each);
    }
  }
  return [...buffers];
}
