/** The result of judging a submission: plain data, which threads pass on and `--json` prints. */

import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Compared, FirstWrong } from '../../teaching/compare/compare.ts';
import { comparedText } from '../../teaching/compare/compared-text.ts';
import type { SideBySide } from './side-by-side.ts';

/** `incomplete`: what could be compared is right, but something could not be read, or is missing. */
export const VERDICTS = ['right', 'wrong', 'incomplete', 'not judged'] as const;
export type Verdict = (typeof VERDICTS)[number];

export interface Grade {
  /** Name of the folder or zip. */
  readonly name: string;
  /** Relative to the caller's folder. */
  readonly path: string;
  readonly verdict: Verdict;
  /** Whether all files that have a counterpart were read without errors. */
  readonly loads: boolean;
  /** How many were compared, and the largest errors; null if none were. */
  readonly joints: number;
  readonly jointError: number | null;
  readonly vertexError: number | null;
  readonly channels: ChannelCount | null;
  readonly parts: readonly PartGrade[];
  /** With paths relative to the caller's folder, and lines. */
  readonly problems: readonly Diagnostic[];
}

export interface ChannelCount {
  readonly right: number;
  readonly of: number;
}

/** A character by what its files evaluate to, or a file with numbers. */
export interface PartGrade {
  /** Paths relative to the caller's folder. */
  readonly files: readonly string[];
  readonly agrees: boolean;
  /** Numbers of items, over all times. */
  readonly compared: Compared;
  /** Numbers of a dump that were compared with another dump's, one by one; absent: with a character's. */
  readonly numbers?: number;
  /** How many, of joints and vertices. */
  readonly times: number;
  /** Times of joints and vertices; null is the file pose. */
  readonly frameTimes: readonly (number | null)[];
  /** Number of joints of the character, if joints were compared. */
  readonly joints: number;
  /** Largest error of all kinds; null if it is not a number, or if nothing could be compared. */
  readonly worst: number | null;
  readonly jointError: number | null;
  readonly vertexError: number | null;
  readonly channels: ChannelCount | null;
  /** What can't be compared: "7 joints, expected 19". */
  readonly mismatches: readonly string[];
  readonly first?: FirstWrong;
  /** Time of the first wrong joint or vertex. */
  readonly time?: number;
  /** Names of joints. */
  readonly own: readonly string[];
  readonly inherited: readonly string[];
  readonly causes: readonly GradedCause[];
  /** What no mistake explains, and how it differs, in sentences. */
  readonly unexplained: readonly string[];
  /** Of what is wrong first; absent if all agrees, or if nothing could be compared. */
  readonly shown?: SideBySide;
}

export interface GradedCause {
  readonly code: string;
  readonly detail: string;
  /** Other ways to make the mistake that explain the same. */
  readonly alternatives?: readonly string[];
  /** What it explains, if not all: `world matrices`. */
  readonly about?: string;
  readonly sentence: string;
  readonly formula: string;
  readonly explains: number;
  readonly of: number;
}

/** The part to tell about in a line: the first that is wrong. */
export function wrongPart({ parts }: Grade): PartGrade | undefined {
  return parts.find(({ agrees }) => !agrees);
}

/** `joint 7 "hip" at 1.5 s`; empty if all agree. */
export function firstWrongText({ first, time, mismatches }: PartGrade): string {
  if (mismatches.length > 0) return mismatches.join('; ');
  if (!first) return '';
  const place = `${first.what} ${first.index}${first.name ? ` "${first.name}"` : ''}`;
  if (first.what === 'channel') return `${place}${first.time === undefined ? '' : ` at ${first.time} s`}`;
  return `${place} ${timeText(time)}`;
}

/** `23 world matrices at 11 times; 72 channels`, `694 vertices in the file pose`; `276 numbers, one by one`. */
export function gradedText({ compared, times, numbers, frameTimes }: PartGrade): string {
  if (numbers !== undefined) return `${numbers} numbers, one by one`;
  const text = comparedText(compared, times);
  return frameTimes.length === 1 ? `${text} ${timeText(frameTimes[0])}` : text;
}

function timeText(time: number | null | undefined): string {
  return time === undefined || time === null ? 'in the file pose' : `at ${time} s`;
}

/** The first cause, and those that explain the same numbers as well. */
export function equalCauses({ causes }: PartGrade): readonly GradedCause[] {
  const [best] = causes;
  return causes.filter(
    ({ about, explains, of }) => about === best.about && explains === best.explains && of === best.of,
  );
}

/** Of the first causes: all that explain the same numbers as well; empty if none are known. */
export function causesText(part: PartGrade): string {
  return equalCauses(part)
    .map(({ code, detail }) => `${code}${detail && ` (${detail})`}`)
    .join(' or ');
}

/** `2 right, 1 wrong`: those that there are, or `0 right`. */
export function countsText(grades: readonly Grade[], numberText: (count: number) => string = String): string {
  const counts = VERDICTS.map((verdict) => ({
    verdict,
    count: grades.filter((grade) => grade.verdict === verdict).length,
  }));
  return counts
    .filter(({ verdict, count }) => count > 0 || verdict !== 'incomplete')
    .map(({ verdict, count }) => `${numberText(count)} ${verdict}`)
    .join(', ');
}

/** Of errors: three digits, enough to see how large they are. */
export function errorText(error: number | null): string {
  if (error === null) return '';
  return Number.isFinite(error) ? String(Number(error.toPrecision(3))) : 'not a number';
}

/** `path:line:column`, as far as known. */
export function placeOf({ file, line, column }: Diagnostic): string {
  return [file, ...(line > 0 ? [line] : []), ...(line > 0 && column > 0 ? [column] : [])].join(':');
}
