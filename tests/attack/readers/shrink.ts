/** Makes an input that fails as small as time allows: by lines, then by bytes (Zeller and Hildebrandt's ddmin). */
import { type Fault, faultsOf } from './check.ts';
import type { Input } from './inputs.ts';

/** The input without what its fault does not need. @param budgetMs in all */
export async function shrunk(input: Input, { kind }: Fault, budgetMs: number): Promise<Input> {
  const until = performance.now() + budgetMs;
  const fails = async (bytes: Uint8Array<ArrayBuffer>) =>
    (await faultsOf({ ...input, bytes })).some((fault) => fault.kind === kind);
  let bytes = input.bytes;
  for (const cut of [linesOf, (all: Uint8Array) => Array.from(all, (_, i) => all.subarray(i, i + 1))]) {
    bytes = await ddmin(bytes, cut(bytes), fails, until);
  }
  return { ...input, bytes };
}

function linesOf(bytes: Uint8Array): readonly Uint8Array[] {
  const lines: Uint8Array[] = [];
  for (let from = 0; from < bytes.length; ) {
    const end = bytes.indexOf(10, from);
    const to = end < 0 ? bytes.length : end + 1;
    lines.push(bytes.subarray(from, to));
    from = to;
  }
  return lines;
}

async function ddmin(
  whole: Uint8Array<ArrayBuffer>,
  parts: readonly Uint8Array[],
  fails: (bytes: Uint8Array<ArrayBuffer>) => Promise<boolean>,
  until: number,
): Promise<Uint8Array<ArrayBuffer>> {
  let found = whole;
  let left = parts;
  for (let size = Math.ceil(left.length / 2); size >= 1; ) {
    let hasShrunk = false;
    for (let from = 0; from < left.length; ) {
      if (performance.now() > until) return found;
      const rest = [...left.slice(0, from), ...left.slice(from + size)];
      const bytes = new Uint8Array(Buffer.concat(rest));
      if (await fails(bytes)) {
        [left, found, hasShrunk] = [rest, bytes, true];
      } else from += size;
    }
    if (size === 1 && !hasShrunk) break;
    size = size === 1 ? 1 : Math.ceil(size / 2);
  }
  return found;
}
