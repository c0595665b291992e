/**
 * Blocks of a dump as they are to be fitted. Programs that walk the skeleton print the local and the world matrix of
 * each joint in turn, so that each is a block of its own; all that are of one kind and time belong together.
 */
import type { DumpBlock, DumpLabel } from '../../model/dump.ts';

/**
 * Joins the matrices of one kind and time, if each joint has a block of its own.
 * @param joints of the character, whose matrices are joined only if that makes 12 or 16 numbers for each
 */
export function joinedBlocks(blocks: readonly DumpBlock[], joints: number): readonly DumpBlock[] {
  const groups = new Map<string, number[]>();
  blocks.forEach(({ holds, time }, b) => {
    if (holds !== 'world' && holds !== 'local') return;
    const key = `${holds} ${time}`;
    groups.set(key, [...(groups.get(key) ?? []), b]);
  });
  const out: (DumpBlock | undefined)[] = [...blocks];
  for (const group of groups.values()) {
    const count = group.reduce((sum, b) => sum + blocks[b].values.length, 0);
    if (group.length !== joints || group.length < 2 || (count !== 12 * joints && count !== 16 * joints)) continue;
    for (const b of group) out[b] = undefined;
    out[group[0]] = joined(
      group.map((b) => blocks[b]),
      group.map((b) => labelOf(blocks, b)),
    );
  }
  return out.filter((block) => block !== undefined);
}

/** Its own, or that of the block before: the name is printed once, before both matrices. */
function labelOf(blocks: readonly DumpBlock[], b: number): DumpLabel | null {
  return blocks[b].labels?.[0] ?? blocks[b - 1]?.labels?.[0] ?? null;
}

function joined(parts: readonly DumpBlock[], labels: readonly (DumpLabel | null)[]): DumpBlock {
  const { holds, time, nesting } = parts[0];
  const starts = [0];
  for (const part of parts) {
    const from = starts[starts.length - 1];
    for (const start of part.starts.subarray(1)) starts.push(from + start);
  }
  const isLabelled = labels.every((label) => label !== null);
  return {
    ...(holds !== undefined && { holds }),
    ...(time !== undefined && { time }),
    ...(nesting !== undefined && { nesting }),
    values: Float64Array.from(parts.flatMap(({ values }) => [...values])),
    starts: Uint32Array.from(starts),
    lines: Uint32Array.from(parts.flatMap(({ lines }) => [...lines])),
    ...(isLabelled && {
      labels: parts.flatMap(({ lines }, p) => Array.from(lines, (_, r) => (r === 0 ? labels[p] : null))),
    }),
  };
}
