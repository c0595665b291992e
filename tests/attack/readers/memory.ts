/**
 * What a reading takes in memory, as an engine counts it that may collect garbage at any time: the heap and the array
 * buffers that are alive.
 *
 *     kept     what the result holds: alive after a full collection, less what was alive before
 *     peak     the most that was alive behind any collection while it was read, less what was before
 *
 * Garbage does not count: it is collected before memory becomes scarce. New objects have a megabyte in the attack's
 * thread (`NEW_SPACE_MB`), so a collection follows each megabyte, and finds the peak within one. The resident size of
 * the process, which other tests quote, counts garbage, and what an engine keeps for later.
 */
import { GCProfiler, getHeapStatistics, setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import type { FileContent } from '../../../src/model/files.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';

/** For `maxYoungGenerationSizeMb`: three times what new objects may fill. */
export const NEW_SPACE_MB = 3;

/** Allowed for each byte of a file, and for any file. */
const PER_BYTE = 10;
const BASE = 1 << 20;
/**
 * Allowed besides for each thing that a file holds in few bytes, as a joint in `JOINT{}`: an object of the model has
 * eight bytes for each of its fields, also for those that are not written, and a joint that is not closed has another.
 */
const PER_THING = 512;
/** For each row of a dump, whose JSON is a list of lists. */
const PER_ROW = 128;

/** What a file holds: joints, skeletons, takes, poses; links and the blocks of a dump count twice. */
export interface Held {
  readonly things: number;
  readonly rows: number;
  /** Of formats that pack numbers: how many they may become. */
  readonly numbers?: number;
}

export interface Taken<T> {
  readonly result: T;
  /** The most bytes that may have been alive: an upper bound, found without collecting anything. */
  readonly most: number;
  /** The most at a collection; 0 without any. */
  readonly peak: number;
}

export function mostBytes(fileBytes: number, { things, rows, numbers = 0 }: Held): number {
  return 8 * numbers + PER_BYTE * fileBytes + PER_THING * things + PER_ROW * rows + BASE;
}

/** What a text opened before it was refused: at most a thing for each bracket or keyword. */
export function openedBy(bytes: Uint8Array): Held {
  return { things: textOf(bytes).match(/[{[]|joint|root/gi)?.length ?? 0, rows: 0 };
}

function textOf(bytes: Uint8Array): string {
  return Buffer.from(bytes.buffer, bytes.byteOffset, bytes.length).toString('latin1');
}

/** @param bytes from which it was read */
export function heldBy(content: FileContent, bytes: Uint8Array): Held {
  switch (content.kind) {
    case 'skel':
      return { things: sumOf(content.skeletons, thingsOf), rows: 0 };
    case 'bvh':
      return { things: sumOf(content.captures, ({ skeleton, take }) => thingsOf(skeleton) + (take ? 1 : 0)), rows: 0 };
    case 'pose':
      return { things: sumOf(content.poses, ({ joints }) => 1 + joints.length), rows: 0 };
    case 'dump': {
      const { blocks } = content.dump;
      // What begins like JSON was tried as JSON first, which opens its brackets.
      const { things } = /^\s*[[{]/.test(textOf(bytes)) ? openedBy(bytes) : { things: 0 };
      return { things: things + 2 * blocks.length, rows: sumOf(blocks, ({ lines }) => lines.length) };
    }
    default:
      return { things: 0, rows: 0 };
  }
}

function thingsOf({ joints }: Skeleton): number {
  return 1 + sumOf(joints, ({ couples }) => 1 + 2 * (couples?.length ?? 0));
}

function sumOf<T>(list: readonly T[], of: (each: T) => number): number {
  return list.reduce((sum, each) => sum + of(each), 0);
}

function alive(): number {
  const { used_heap_size: heap, external_memory: buffers } = getHeapStatistics();
  return heap + buffers;
}

/** Reads, and says what that took at most. Costs little. */
export async function taken<T>(read: () => T | Promise<T>): Promise<Taken<T>> {
  const before = alive();
  const profiler = new GCProfiler();
  profiler.start();
  const result = await read();
  const at = profiler.stop().statistics.map(({ afterGC: { heapStatistics: after } }) => {
    return after.usedHeapSize + after.externalMemory;
  });
  return { result, most: Math.max(alive(), ...at) - before, peak: Math.max(before, ...at) - before };
}

let collect: (() => void) | undefined;

/** A full garbage collection. */
function collectGarbage(): void {
  if (!collect) {
    setFlagsFromString('--expose-gc');
    // The function of that name, which only new contexts have.
    collect = runInNewContext('gc') as () => void;
  }
  // The second one ends the sweeping of the first, which goes on beside the program.
  collect();
  collect();
}

/** The same read again, exactly: slow. What another reading left behind, such as caches, counts as well. */
export async function takenExactly(read: () => unknown): Promise<{ readonly kept: number; readonly peak: number }> {
  collectGarbage();
  const before = alive();
  // A collection of new objects alone leaves garbage among the old, where lists go that were outgrown.
  setFlagsFromString('--gc-global');
  try {
    const { result, peak } = await taken(read);
    collectGarbage();
    const kept = alive() - before;
    // Held until here.
    if (result === alive) throw new Error('never');
    return { kept, peak: Math.max(kept, peak) };
  } finally {
    // Of the whole process: other threads are slower with it.
    setFlagsFromString('--no-gc-global');
  }
}
