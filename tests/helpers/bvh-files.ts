/** The real files of motion capture, read as the page reads them. */
import { readdirSync } from 'node:fs';
import { formatOf } from '../../src/files/readers.ts';
import { readWhole } from '../../src/formats/reader.ts';
import type { CapturedFigure } from '../../src/model/files.ts';
import { hasShared, sharedBytes, sharedPath } from './shared.ts';

/** Names of all that load without errors. */
export const BVH_FILES: readonly string[] = hasShared
  ? readdirSync(sharedPath('data/bvh')).filter((name) => name.endsWith('.bvh'))
  : [];

export function readFigures(name: string, bytes: Uint8Array | string): readonly CapturedFigure[] {
  const format = formatOf(name);
  if (!format) throw new Error(`${name} has no reader.`);
  const { value, diagnostics } = readWhole(format.reader(name), bytes);
  if (value?.kind !== 'bvh') throw new Error(`${name} was not read: ${diagnostics[0]?.message}`);
  return value.figures;
}

export function sharedFigures(name: string): readonly CapturedFigure[] {
  return readFigures(name, sharedBytes(`data/bvh/${name}`));
}
