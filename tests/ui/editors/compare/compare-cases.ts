/** The reference's dumps, compared as the page does. */
import { readDump } from '../../../../src/formats/dump/read.ts';
import type { Character } from '../../../../src/model/document.ts';
import { Evaluator } from '../../../../src/teaching/program/evaluator.ts';
import { RIGHT_PROGRAM } from '../../../../src/teaching/program/program.ts';
import type { BannerSubject } from '../../../../src/ui/editors/compare/banner-text.ts';
import type { ComparedResult } from '../../../../src/ui/state/dump-comparison.ts';
import { compareDumps } from '../../../../src/worker/compare-program.ts';
import { sharedBytes } from '../../../helpers/shared.ts';
import { characterOf } from '../../../teaching/lesson-files.ts';

export interface ComparedCase extends BannerSubject {
  readonly character: Character;
  readonly result: ComparedResult | undefined;
}

/** A dump, as text or by its name in the reference; its time if it states none. */
export interface CaseDump {
  readonly name: string;
  readonly bytes?: Uint8Array | string;
  readonly time?: number;
}

/** Of dumps of the reference, compared once: many tests begin with the same. */
const known = new Map<string, ComparedCase>();

/** @param files in `data/` @param time shown, of the take; undefined: the file pose */
export function comparedCase(
  files: readonly string[],
  dumpName: string,
  time?: number,
  tolerance = 1e-4,
  bytes?: Uint8Array | string,
): ComparedCase {
  const key = JSON.stringify([files, dumpName, time, tolerance]);
  const found = bytes === undefined ? known.get(key) : undefined;
  if (found) return found;
  const dump = { name: dumpName, ...(bytes !== undefined && { bytes }), ...(time !== undefined && { time }) };
  const made = comparedDumps(files, [dump], time, tolerance);
  if (bytes === undefined) known.set(key, made);
  return made;
}

/** Several dumps, the last of which was given last. */
export function comparedDumps(
  files: readonly string[],
  given: readonly CaseDump[],
  time?: number,
  tolerance = 1e-4,
): ComparedCase {
  const character = characterOf(...files.map((file) => `data/${file}`));
  const dumps = given.map(({ name, time: own, bytes = sharedBytes(`conformance/compare/${name}`) }) => {
    const { value } = readDump(bytes, name);
    if (!value) throw new Error(`${name} can't be read.`);
    return { fileName: name, dump: value, assumed: { time: own } };
  });
  const { comparison, targets, diagnostics } = compareDumps({ character, dumps, tolerance }, () => undefined);
  const result = comparison && targets && { comparison, targets, character, tolerance };
  return {
    state: {
      dumps,
      newest: given.slice(-1).map(({ name }) => name),
      tolerance,
      phase: result ? { kind: 'done' } : { kind: 'misfit', diagnostics },
      ...(result && { result }),
    },
    character,
    result,
    frame: comparison?.frames.findIndex((frame) => frame.time === time) ?? -1,
    time,
  };
}

/** World matrices as a program prints them, right or with one joint moved by 1 along x. */
export function printedMatrices(character: Character, times: readonly number[], moved?: number): string {
  const evaluator = new Evaluator(character);
  const blocks = times.map((time) => {
    const { world } = evaluator.frame(RIGHT_PROGRAM, time, { local: false, vertices: false, normals: false });
    const rows = Array.from({ length: world.length / 16 }, (_, j) => {
      const row = [...world.subarray(16 * j, 16 * j + 16)];
      if (j === moved) row[12] += 1;
      return row.join(' ');
    });
    return `time ${time}\n${rows.join('\n')}\n`;
  });
  return blocks.join('');
}
