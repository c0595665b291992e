/**
 * The records of an FBX file, the same for its binary and its text form: a name, values, and records inside.
 *
 *     Name: value, value { Name: … }
 */

import type { NumberPool } from './number-pool.ts';

/** A list of numbers; `l` arrays (64-bit integers) become doubles, exact up to 2^53. */
export type FbxNumbers = Float64Array | Float32Array | Int32Array | Uint8Array;

/** Integers are numbers where they are exact, else bigints. Raw data is a `Uint8Array`. */
export type FbxValue = number | bigint | string | FbxNumbers;

/** A record of the file. */
export interface FbxRecord {
  readonly name: string;
  readonly values: readonly FbxValue[];
  readonly children: readonly FbxRecord[];
  /** Offset of its first byte in the file. */
  readonly offset: number;
}

/** Those inside most records; shared. */
export const NO_RECORDS: readonly FbxRecord[] = [];

/** A file as records, before any meaning. */
export interface FbxFile {
  /** 7400 for 7.4. */
  readonly version: number;
  readonly isText: boolean;
  /** Holds its numbers, and what is computed of them on the way. */
  readonly pool: NumberPool;
  readonly records: readonly FbxRecord[];
}

/** The first record of that name inside another, if any. */
export function childOf(record: FbxRecord | undefined, name: string): FbxRecord | undefined {
  if (!record) return undefined;
  const { children } = record;
  for (let i = 0; i < children.length; i++) if (children[i].name === name) return children[i];
  return undefined;
}

/** All records of that name inside another. */
export function childrenOf(record: FbxRecord | undefined, name: string): readonly FbxRecord[] {
  return record?.children.filter((child) => child.name === name) ?? [];
}

/** A value as a number; undefined if it is none, or not finite. */
export function numberAt(record: FbxRecord | undefined, index = 0): number | undefined {
  const value = record?.values[index];
  const number = typeof value === 'bigint' ? Number(value) : value;
  return typeof number === 'number' && Number.isFinite(number) ? number : undefined;
}

/** A value as text; undefined if it is none. */
export function textAt(record: FbxRecord | undefined, index = 0): string | undefined {
  const value = record?.values[index];
  return typeof value === 'string' ? value : undefined;
}

/** A value that identifies an object: ids are integers of up to 64 bits. */
export function idAt(record: FbxRecord | undefined, index = 0): number | bigint | string | undefined {
  const value = record?.values[index];
  return typeof value === 'object' ? undefined : value;
}

const NO_NUMBERS = new Float64Array(0);

/** The numbers of a record: its array, or its single values; empty if there are none. */
export function numbersOf(record: FbxRecord | undefined): FbxNumbers {
  const first = record?.values[0];
  if (first !== undefined && typeof first === 'object') return first;
  if (first === undefined) return NO_NUMBERS;
  return Float64Array.from(record?.values.filter((value) => typeof value === 'number') ?? []);
}
