/** What the banner says: whether all agrees, what is wrong first, and which mistake explains it. */

import { type Diagnostic, hasErrors } from '../../../model/diagnostic.ts';
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Comparison, FirstWrong, FrameComparison } from '../../../teaching/compare/compare.ts';
import {
  comparedText,
  explainedNoun,
  subjectText,
  unexplainedSentences,
} from '../../../teaching/compare/compared-text.ts';
import { firstWrongOf, type PlacedFirst } from '../../../teaching/compare/first-wrong.ts';
import type { Cause } from '../../../teaching/search/found-causes.ts';
import type { ComparedResult, CompareState } from '../../state/dump-comparison.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';

export interface BannerText {
  readonly tone: 'agrees' | 'differs' | 'trouble' | 'working';
  /** Sentences. */
  readonly text: string;
  /** From 0 to 1 while it is compared. */
  readonly share?: number;
  /** A time of the take that is told of and isn't shown; seconds. */
  readonly goTo?: number;
  /** The problem told, of a dump that doesn't fit. */
  readonly problem?: Diagnostic;
  /** Whether comparing again may help. */
  readonly canRetry?: boolean;
}

export interface BannerSubject {
  readonly state: CompareState;
  /** Undefined if it was removed. */
  readonly character: Character | undefined;
  /** The frame shown; −1 if none of those compared is. */
  readonly frame: number;
  /** Time of the take; undefined: the file pose. */
  readonly time: number | undefined;
  /** Whether the character is one of several, and is named. */
  readonly isNamed?: boolean;
}

export function bannerText({ state, character, frame, time, isNamed = false }: BannerSubject): BannerText {
  const { phase, result } = state;
  if (!character) return { tone: 'trouble', text: 'The compared character was removed. Undo restores it.' };
  switch (phase.kind) {
    case 'misfit': {
      const problem = phase.diagnostics.find((d) => hasErrors([d]));
      const others = phase.diagnostics.length - 1;
      const more = others > 0 ? ` ${others} more ${others === 1 ? 'problem' : 'problems'}.` : '';
      return {
        tone: 'trouble',
        text: `Not compared with ${character.name}. ${problem ? `${problem.file}: ${problem.message}` : ''}${more}`,
        ...(problem && { problem }),
      };
    }
    case 'failed':
      return { tone: 'trouble', text: `Not compared. ${phase.message}`, canRetry: true };
    case 'cancelled':
      return { tone: 'trouble', text: 'The comparison was cancelled.', canRetry: true };
    case 'working':
    case 'done':
  }
  const share = phase.kind === 'working' ? { share: phase.share } : {};
  if (!result) return { tone: 'working', text: `Comparing with ${character.name}`, ...share };
  const told = resultText({ result, newest: state.newest }, frame, time);
  const instead = state.replaced ? `${state.newest.join(', ')} instead of ${state.replaced.join(', ')}. ` : '';
  return { ...told, text: `${isNamed ? `${character.name}: ` : ''}${instead}${told.text}`, ...share };
}

function resultText(
  { result, newest }: { readonly result: ComparedResult; readonly newest: readonly string[] },
  frame: number,
  time: number | undefined,
): BannerText {
  const { comparison, targets, character, tolerance } = result;
  const { agrees, frames, compared, worst, reached = [] } = comparison;
  const now = frames[frame];
  if (agrees) {
    const what = comparedText(compared, frames.length);
    const at = whenText(comparison, time);
    const text = `All agree: ${what}${at}, within ${numberText(tolerance)}. The largest error is ${numberText(worst)}.`;
    return { tone: 'agrees', text: [text, ...reached].join(' '), ...goToFrame(frames[0], now) };
  }
  const names = targets.origins?.fileNames ?? [];
  const isOfSeveral = names.length > 1;
  const asked = new Set(names.flatMap((name, dump) => (newest.includes(name) ? [dump] : [])));
  const isOfSome = asked.size > 0 && asked.size < names.length;
  const ofAsked = firstWrongOf(result, isOfSome ? asked : undefined, frame);
  const placed = ofAsked ?? firstWrongOf(result, undefined, frame);
  const wrong = placed && frames[placed.frame];
  const firstTime = wrong ? wrong.time : placed?.first.time;
  const hereAgrees = now?.agrees === true && wrong !== undefined;
  const of = isOfSeveral && placed ? ` in ${names[placed.dump]}` : '';
  const sentences = [
    ...(isOfSome && !ofAsked ? [`${newest.filter((name) => names.includes(name)).join(', ')}: all agree.`] : []),
    ...(hereAgrees
      ? [`Agrees at ${timeText(now.time)}.`]
      : !now && frames.length > 0 && !isOfSeveral
        ? [`Compared${whenText(comparison, time)}.`]
        : []),
    ...(placed
      ? [
          `First wrong${of}${whereFirst(comparison, firstTime, hereAgrees, wrong)}: ${placeText(placed.first, character)}.`,
        ]
      : []),
    ...causeSentences(result, placed, placed && names[placed.dump]),
    ...unexplainedSentences(comparison, isOfSeveral),
  ];
  const channelTime = placed?.frame === -1 && placed.first.time !== time ? placed.first.time : undefined;
  return {
    tone: 'differs',
    text: sentences.join(' '),
    ...(channelTime === undefined ? goToFrame(wrong, now) : { goTo: channelTime }),
  };
}

function goToFrame(told: FrameComparison | undefined, now: FrameComparison | undefined): { readonly goTo?: number } {
  return told && told !== now && told.time !== undefined ? { goTo: told.time } : {};
}

/** ` at 1.5 s`, ` at 5 times`; empty for channels, which have times of their own, and the pose that is shown. */
function whenText({ frames }: Comparison, time: number | undefined): string {
  if (frames.length === 0) return '';
  if (frames.length > 1) return ` at ${frames.length} times`;
  const [{ time: own }] = frames;
  if (own === undefined) return time === undefined ? '' : ' in the file pose';
  return ` at ${timeText(own)}`;
}

function whereFirst(
  { frames }: Comparison,
  time: number | undefined,
  isElsewhere: boolean,
  frame: FrameComparison | undefined,
): string {
  if (!frame || !(frames.length > 1 || isElsewhere)) return '';
  return time === undefined ? ' in the file pose' : ` at ${timeText(time)}`;
}

function timeText(time: number | undefined): string {
  return time === undefined ? 'the file pose' : `${shown(time, 4)} s`;
}

/** `hip_03_r`, `vertex 12`, `channel 3 (hip.rx) at 0.4 s`. */
export function placeText({ what, index, name, time }: FirstWrong, { skeleton }: Character): string {
  if (what === 'joint') return jointName(skeleton, index);
  const named = `${what === 'normal' ? 'the normal of vertex' : what} ${index}${name ? ` (${name})` : ''}`;
  return time === undefined ? named : `${named} at ${timeText(time)}`;
}

/**
 * The cause of what is wrong first: other parts of the numbers may have other causes.
 *
 * @param file the dump that it is in, of several
 */
function causeSentences(
  result: ComparedResult,
  placed: PlacedFirst | undefined,
  file: string | undefined,
): readonly string[] {
  const { causes } = result.comparison;
  const isOfPlaced = ({ about }: Cause) =>
    !about ||
    (about.kinds.some((kind) => placed?.kinds.includes(kind)) &&
      (file === undefined || about.files.length === 0 || about.files.includes(file)));
  const best = causes.find(isOfPlaced);
  const others = causes.filter(({ about }) => !best || subjectKey(about) !== subjectKey(best.about)).length;
  const more = others > 0 ? [`${plural(others, 'more cause')} in Compare.`] : [];
  if (!best) return more;
  // The dump was just named.
  const isNamed = file !== undefined && best.about?.files.join() === file;
  const about = best.about && !isNamed ? `In the ${subjectText(best.about, best.about.files.length > 0)}: ` : '';
  const explains = `${explainsText(best, result)}${equalText(best, causes)}`;
  return [`${about}${best.sentences.join(' ')}`, explains, ...more];
}

function subjectKey(about: Cause['about']): string {
  return JSON.stringify(about ?? null);
}

/** Other causes and ways that explain the same numbers as well; a few are told, more are counted. */
function equalText(best: Cause, causes: readonly Cause[]): string {
  const isWhole = ({ explains, of }: Cause) => explains === of;
  const equal = causes.filter(
    (cause) => cause !== best && isWhole(cause) && isWhole(best) && subjectKey(cause.about) === subjectKey(best.about),
  );
  const told = [...best.alternatives.map((other) => `${other}.`), ...equal.map(({ sentences }) => sentences.join(' '))];
  if (told.length === 0) return '';
  return told.length === 1 ? ` Equally: ${told[0]}` : ` ${told.length} others explain it equally; see Compare.`;
}

const JOINT_KINDS = ['world', 'local', 'positions'] as const;

/** `Explains all 23 joints.`, `Explains all 19 wrong joints.`, `Explains 20 of 23 joints.` */
export function explainsText(cause: Cause, { comparison, tolerance }: ComparedResult): string {
  const { explains, of, frames, about } = cause;
  const { compared } = comparison;
  const noun = explainedNoun(cause, compared);
  const many = noun === 'vertex' ? 'vertices' : `${noun}s`;
  const times = frames.length;
  // Items of all times are counted; whole ones are told as there are in the character.
  const isEven = times > 1 && of % times === 0;
  const at = times > 1 ? ` at ${isEven && explains === of ? 'all ' : ''}${times} times` : '';
  if (explains < of) return `Explains ${explains} of ${of} ${of === 1 ? noun : many}${at}.`;
  // Those that are right are explained too, which is no news.
  const isOfAll = JOINT_KINDS.every((kind) => compared[kind] === 0 || !about || about.kinds.includes(kind));
  const errors = noun === 'joint' && isOfAll ? frames.map((frame) => comparison.frames[frame]?.jointErrors ?? []) : [];
  const wrong = errors.reduce((sum, each) => sum + each.filter((error) => !(error <= tolerance)).length, 0);
  if (wrong > 0 && wrong < of) {
    return wrong === 1 ? `Explains the only wrong ${noun}.` : `Explains all ${wrong} wrong ${many}${at}.`;
  }
  const count = isEven ? of / times : of;
  return count === 1 ? `Explains the only ${noun}${at}.` : `Explains all ${count} ${many}${at}.`;
}

/** Of errors: two digits, enough to see how large they are. */
export function numberText(value: number): string {
  if (!Number.isFinite(value)) return 'not a number';
  const isShort = value === 0 || (value >= 1e-4 && value < 1e6);
  return isShort ? String(Number(value.toPrecision(2))) : powerText(value, 1);
}

/** `1.2·10⁻⁷`. @param decimals of the first factor */
export function powerText(value: number, decimals: number): string {
  const [digits, power] = value.toExponential(decimals).split('e');
  const exponent = [...String(Math.abs(Number(power)))].map((digit) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(digit)]).join('');
  return `${digits}·10${Number(power) < 0 ? '⁻' : ''}${exponent}`;
}
