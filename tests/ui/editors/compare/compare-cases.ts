/** The reference's dumps, compared as the page does. */
import { readDump } from '../../../../src/formats/dump/read.ts';
import type { Character } from '../../../../src/model/document.ts';
import type { BannerSubject } from '../../../../src/ui/editors/compare/banner-text.ts';
import type { ComparedResult } from '../../../../src/ui/state/dump-comparison.ts';
import { compareDumps } from '../../../../src/worker/compare.ts';
import { sharedBytes } from '../../../helpers/shared.ts';
import { characterOf } from '../../../lesson/lesson-files.ts';

export interface ComparedCase extends BannerSubject {
  readonly character: Character;
  readonly result: ComparedResult | undefined;
}

/** @param files in `data/` @param time shown, of the clip; undefined: the file pose */
export function comparedCase(
  files: readonly string[],
  dumpName: string,
  time?: number,
  tolerance = 1e-4,
  bytes: Uint8Array | string = sharedBytes(`conformance/compare/${dumpName}`),
): ComparedCase {
  const character = characterOf(...files.map((file) => `data/${file}`));
  const { value } = readDump(bytes, dumpName);
  if (!value) throw new Error(`${dumpName} can't be read.`);
  const dumps = [{ fileName: dumpName, dump: value, assumed: { time } }];
  const { comparison, targets, diagnostics } = compareDumps({ character, dumps, tolerance }, () => undefined);
  const result = comparison && targets && { comparison, targets, character, tolerance };
  return {
    state: {
      dumps,
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
