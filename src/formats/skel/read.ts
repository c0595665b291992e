/** `.skel` in any of its forms: hierarchy, axis-angle, or rows with the index of a parent. */
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { type Reader, type ReadResult, readerByHead, readWhole } from '../reader.ts';
import { isAxskel } from './read-axis-angle.ts';
import { hierarchyReader } from './read-hierarchy.ts';
import { beginsParents, PARENTS_HEAD_BYTES, parentsReader } from './read-parents.ts';

/** A reader for a `.skel`: a skeleton for each root. */
export function skelReader(fileName: string): Reader<readonly Skeleton[]> {
  if (isAxskel(fileName)) return hierarchyReader(fileName);
  return readerByHead(PARENTS_HEAD_BYTES, (head) => (beginsParents(head) ? parentsReader : hierarchyReader)(fileName));
}

/** Reads a whole `.skel`. */
export function readSkel(bytes: Uint8Array | string, fileName: string): ReadResult<readonly Skeleton[]> {
  return readWhole(skelReader(fileName), bytes);
}
