/** The real files of motion capture, read as the page reads them. */
import { readdirSync } from 'node:fs';
import { formatOf } from '../../src/files/readers.ts';
import { readWhole } from '../../src/formats/reader.ts';
import type { Capture } from '../../src/model/files.ts';
import { OWN_CAPTURES } from './own-files.ts';
import { hasShared, sharedBytes, sharedPath } from './shared.ts';

/** Names of those of the reference that load without errors. */
export const BVH_FILES: readonly string[] = hasShared
  ? readdirSync(sharedPath('data/bvh')).filter((name) => name.endsWith('.bvh'))
  : [];

/** With our own. */
export const ALL_BVH: readonly string[] = [...OWN_CAPTURES.keys(), ...BVH_FILES];

/** A file of motion capture, of the reference or our own. */
export function bvhBytes(name: string): Uint8Array {
  return OWN_CAPTURES.get(name) ?? sharedBytes(`data/bvh/${name}`);
}

export function readCaptures(name: string, bytes: Uint8Array | string): readonly Capture[] {
  const format = formatOf(name);
  if (!format) throw new Error(`${name} has no reader.`);
  const { value, diagnostics } = readWhole(format.reader(name), bytes);
  if (value?.kind !== 'bvh') throw new Error(`${name} was not read: ${diagnostics[0]?.message}`);
  return value.captures;
}

const known = new Map<string, readonly Capture[]>();

/** Read once. */
export function sharedCaptures(name: string): readonly Capture[] {
  const captures = known.get(name) ?? readCaptures(name, bvhBytes(name));
  known.set(name, captures);
  return captures;
}
