/**
 * The teacher's dumps: a submission's dump of the same name is compared with them. One that agrees with a character of
 * the reference says to which character and times the numbers belong, so that mistakes are searched for; any other is
 * compared number by number.
 */

import type { DumpFile } from '../../files/open/open-in-steps.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import type { Dump } from '../../model/dump.ts';
import type { ParsedFile } from '../../model/files.ts';
import { worstError } from '../../teaching/compare/compare.ts';
import { FRAME_KINDS, type Targets } from '../../teaching/compare/targets.ts';
import { fitDumps } from '../../teaching/dump/fit-dump.ts';

export interface RightDump {
  readonly file: DumpFile;
  /** Whose numbers these are; absent: of no character of the reference. */
  readonly of?: { readonly character: Character; readonly targets: Targets };
}

/** @param diagnostics is told of dumps that contradict the characters */
export function rightDumps(
  files: readonly ParsedFile[],
  characters: readonly Character[],
  tolerance: number,
  diagnostics: Diagnostic[],
): readonly RightDump[] {
  return files.flatMap((file): RightDump[] => {
    if (file.kind !== 'dump') return [];
    let nearest = Number.POSITIVE_INFINITY;
    for (const character of characters) {
      const { targets } = fitDumps(character, [{ fileName: file.source.path, dump: file.dump }], undefined);
      if (!targets) continue;
      const worst = worstError(character, targets);
      if (worst <= tolerance) return [{ file, of: { character, targets } }];
      nearest = Math.min(nearest, worst);
    }
    if (characters.length > 0) {
      const found =
        nearest < Number.POSITIVE_INFINITY
          ? `numbers that are off by ${Number(nearest.toPrecision(3))}`
          : 'other numbers';
      const message = `Expected numbers of the reference's own characters, found ${found}.`;
      const assumed = 'compared number by number, without a search for mistakes';
      diagnostics.push(withoutPlace('warning', 'reference-dump', message, file.source.path, assumed));
    }
    return [{ file }];
  });
}

/** The reference's dump of a name, whatever its case; else the only one of that name without its extension. */
export function rightDumpFor(name: string, dumps: readonly RightDump[]): RightDump | undefined {
  const lower = name.toLowerCase();
  const same = dumps.find(({ file }) => file.source.name.toLowerCase() === lower);
  if (same) return same;
  const stem = (text: string) => text.replace(/\.[^.]*$/, '');
  const alike = dumps.filter(({ file }) => stem(file.source.name.toLowerCase()) === stem(lower));
  return alike.length === 1 ? alike[0] : undefined;
}

/** Their dump with the headings of the right one: what blocks hold, times, and targets, if it states none of its own. */
export function withHeadings(theirs: Dump, right: Dump): Dump {
  const statesTime = theirs.time !== undefined || theirs.blocks.some(({ time }) => time !== undefined);
  const times = right.blocks.map(({ time }) => time ?? right.time);
  const isAlike = theirs.blocks.length === right.blocks.length;
  const blocks = theirs.blocks.map((block, b) => {
    const holds = block.holds ?? (isAlike ? right.blocks[b].holds : undefined);
    const time = block.time ?? (isAlike && !statesTime ? times[b] : undefined);
    return { ...block, ...(holds && { holds }), ...(time !== undefined && { time }) };
  });
  const only = new Set(times).size === 1 ? times[0] : undefined;
  const { targets, isOneStep } = right;
  const solver = theirs.targets ? {} : { ...(targets && { targets }), ...(isOneStep && { isOneStep }) };
  return { ...theirs, ...solver, blocks, ...(!statesTime && !isAlike && only !== undefined && { time: only }) };
}

/** What the right dump has and theirs lacks: `no vertices at 1.5 s`. */
export function lacking(theirs: Targets, right: Targets): readonly string[] {
  const missing = right.frames.flatMap((frame) => {
    const at = frame.time === undefined ? '' : ` at ${frame.time} s`;
    const own = theirs.frames.find(({ time }) => time === frame.time);
    if (!own) return [`nothing${at}`];
    return FRAME_KINDS.flatMap((kind) => (frame[kind] && !own[kind] ? [`no ${NAMES[kind]}${at}`] : []));
  });
  const channels = new Set(theirs.channels.channels);
  const without = [...new Set(right.channels.channels)].filter((channel) => !channels.has(channel));
  return without.length > 0 ? [...missing, `no channel ${without.join(', ')}`] : missing;
}

const NAMES: Readonly<Record<(typeof FRAME_KINDS)[number], string>> = {
  world: 'world matrices',
  local: 'local matrices',
  positions: 'joint positions',
  vertices: 'vertices',
  normals: 'normals',
};
