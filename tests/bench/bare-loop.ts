/** The baseline for readers of numbers: a loop over the bytes without checks. */

/**
 * Parses the bytes' numbers into a Float32Array. Assumes that everything is a number, and accumulates rounding errors.
 */
export function bareLoop(bytes: Uint8Array, count: number): Float32Array {
  const out = new Float32Array(count);
  const end = bytes.length;
  let n = 0;
  let i = 0;
  while (i < end) {
    let c = bytes[i];
    if ((c < 48 || c > 57) && c !== 45 && c !== 46) {
      i++;
      continue;
    }
    let sign = 1;
    if (c === 45) {
      sign = -1;
      c = bytes[++i];
    }
    let v = 0;
    while (c >= 48 && c <= 57) {
      v = v * 10 + (c - 48);
      c = bytes[++i];
    }
    if (c === 46) {
      let f = 0.1;
      c = bytes[++i];
      while (c >= 48 && c <= 57) {
        v += f * (c - 48);
        f *= 0.1;
        c = bytes[++i];
      }
    }
    if (c === 101) {
      let exponent = 0;
      c = bytes[++i];
      const negative = c === 45;
      if (negative || c === 43) c = bytes[++i];
      while (c >= 48 && c <= 57) {
        exponent = exponent * 10 + (c - 48);
        c = bytes[++i];
      }
      v *= 10 ** (negative ? -exponent : exponent);
    }
    out[n++] = sign * v;
  }
  return out;
}

/** Counts the numbers. */
export function countNumbers(bytes: Uint8Array): number {
  let n = 0;
  let isInside = false;
  for (const c of bytes) {
    const isPart = (c >= 48 && c <= 57) || c === 45 || c === 46;
    if (isPart && !isInside) n++;
    isInside = isPart || (isInside && (c === 101 || c === 43));
  }
  return n;
}
