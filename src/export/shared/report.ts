/** A written file with a report on what it has, and what of the character it hasn't. */
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { vertexCount } from '../../model/skin.ts';
import type { FilePose } from './file-pose.ts';

/** A file in pieces, to be written one after the other, and what is in it. */
export interface ExchangeFile {
  readonly pieces: readonly Uint8Array<ArrayBuffer>[];
  readonly report: ExchangeReport;
}

/** How far writing has come. */
export interface ExchangeProgress {
  /** The current step: the name of a take. */
  readonly label: string;
  /** From 0 to 1, of all. */
  readonly fraction: number;
}

/** A file in numbers, and its losses. */
export interface ExchangeReport {
  readonly bytes: number;
  readonly joints: number;
  readonly vertices: number;
  readonly morphs: number;
  readonly takes: readonly TakeReport[];
  /** The character's size, and how far a point may be off, in the file's units. */
  readonly size: number;
  readonly tolerance: number;
  readonly losses: readonly Loss[];
}

/** A take in the file, in numbers. */
export interface TakeReport {
  readonly name: string;
  readonly seconds: number;
  /** Animated properties of nodes, and keys of all of them together. */
  readonly channels: number;
  readonly keys: number;
}

/** Something that the file, or a program that reads it, doesn't have as the character has it. */
export interface Loss {
  /** Stable: `influences-four`. */
  readonly code: string;
  /** A sentence. */
  readonly message: string;
  readonly severity: 'info' | 'warning';
  /** The largest distance of a vertex from where it should be, where that is known; in the file's units. */
  readonly displacement?: number;
}

/** A file of a character in its file pose, with its report. */
export function exchangeFile(
  pieces: ExchangeFile['pieces'],
  { skins, morphs }: Character,
  { joints, skin, size, tolerance }: FilePose,
  { takes, losses }: Pick<ExchangeReport, 'takes' | 'losses'>,
): ExchangeFile {
  const report = {
    bytes: pieces.reduce((sum, { length }) => sum + length, 0),
    joints: joints?.skeleton.joints.length ?? 0,
    vertices: skin ? vertexCount(skin) : 0,
    morphs: skins.length ? morphs.length : 0,
    ...{ takes, size, tolerance, losses },
  };
  return { pieces, report };
}

/** A length as it is printed: three digits that count. */
export function lengthText(length: number): string {
  return `${Number(length.toPrecision(3))}`;
}

/** A displacement with its fraction of the size: `0.0213 (0.8 % of the size)`. */
export function displacementText(length: number, size: number): string {
  return `${lengthText(length)} (${Number(((100 * length) / size).toPrecision(2))} % of the size)`;
}

/** The losses of a report as messages about a file. */
export function diagnosticsOf({ losses }: ExchangeReport, fileName: string): readonly Diagnostic[] {
  return losses.map(({ severity, code, message }) => withoutPlace(severity, code, message, fileName));
}
