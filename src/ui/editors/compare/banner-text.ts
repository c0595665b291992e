/** What the banner says: whether all agrees, what is wrong first, and which mistake explains it. */
import type { Comparison, FirstWrong } from '../../../lesson/compare.ts';
import { comparedText, explainedNoun, subjectText } from '../../../lesson/compared-text.ts';
import type { Cause } from '../../../lesson/found-causes.ts';
import { type Diagnostic, hasErrors } from '../../../model/diagnostic.ts';
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/joint-name.ts';
import { plural, shown } from '../../kit/number-text.ts';
import type { CompareState } from '../../state/dump-comparison.ts';

export interface BannerText {
  readonly tone: 'agrees' | 'differs' | 'trouble' | 'working';
  /** Sentences. */
  readonly text: string;
  /** From 0 to 1 while it is compared. */
  readonly share?: number;
  /** A time of the clip that is told of and isn't shown; seconds. */
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
  /** Time of the clip; undefined: the file pose. */
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
  const told = resultText(result.comparison, result.tolerance, character, frame, time);
  return { ...told, ...(isNamed && { text: `${character.name}: ${told.text}` }), ...share };
}

function resultText(
  comparison: Comparison,
  tolerance: number,
  character: Character,
  frame: number,
  time: number | undefined,
): BannerText {
  const { agrees, frames, compared, worst } = comparison;
  const now = frames[frame];
  const wrong = now && !now.agrees ? now : frames.find((f) => !f.agrees);
  const told = wrong ?? frames[0];
  const isElsewhere = told !== undefined && told !== now;
  const toldTime = told?.time;
  const goTo = isElsewhere && toldTime !== undefined ? { goTo: toldTime } : {};
  const at = whenText(comparison, time);
  if (agrees) {
    const what = comparedText(compared, frames.length);
    const text = `All agree: ${what}${at}, within ${numberText(tolerance)}. The largest error is ${numberText(worst)}.`;
    return { tone: 'agrees', text, ...goTo };
  }
  const first = wrong?.first ?? comparison.first;
  const firstTime = wrong?.time ?? first?.time;
  const hereAgrees = now?.agrees === true && wrong !== undefined;
  const sentences = [
    ...(hereAgrees ? [`Agrees at ${timeText(now.time)}.`] : !now && frames.length > 0 ? [`Compared${at}.`] : []),
    ...(first ? [`First wrong${whereFirst(comparison, firstTime, hereAgrees)}: ${placeText(first, character)}.`] : []),
    causeText(comparison),
  ];
  const channelTime =
    first?.what === 'channel' && first.time !== undefined && first.time !== time ? first.time : undefined;
  return {
    tone: 'differs',
    text: sentences.join(' '),
    ...goTo,
    ...(frames.length === 0 && channelTime !== undefined && { goTo: channelTime }),
  };
}

/** ` at 1.5 s`, ` at 5 times`; empty for channels, which have times of their own, and the pose that is shown. */
function whenText({ frames }: Comparison, time: number | undefined): string {
  if (frames.length === 0) return '';
  if (frames.length > 1) return ` at ${frames.length} times`;
  const [{ time: own }] = frames;
  if (own === undefined) return time === undefined ? '' : ' in the file pose';
  return ` at ${timeText(own)}`;
}

function whereFirst({ frames }: Comparison, time: number | undefined, isElsewhere: boolean): string {
  return (frames.length > 1 || isElsewhere) && time !== undefined ? ` at ${timeText(time)}` : '';
}

function timeText(time: number | undefined): string {
  return time === undefined ? 'the file pose' : `${shown(time, 4)} s`;
}

/** `hip_03_r`, `vertex 12`, `channel 3 (hip.rx) at 0.4 s`. */
function placeText({ what, index, name, time }: FirstWrong, { skeleton }: Character): string {
  if (what === 'joint') return jointName(skeleton, index);
  const named = `${what === 'normal' ? 'the normal of vertex' : what} ${index}${name ? ` (${name})` : ''}`;
  return time === undefined ? named : `${named} at ${timeText(time)}`;
}

function causeText(comparison: Comparison): string {
  const { causes, own, inherited } = comparison;
  const [best] = causes;
  if (best) {
    const others = comparison.causes.filter(({ about }) => JSON.stringify(about) !== JSON.stringify(best.about)).length;
    const about = best.about ? `In the ${subjectText(best.about, best.about.files.length > 0)}: ` : '';
    const more = others > 0 ? ` ${plural(others, 'more cause')} in Compare.` : '';
    return `${about}${best.sentences.join(' ')} ${explainsText(best, comparison)}${more}`;
  }
  const isTold = own.length + inherited.length > 1;
  const of = isTold ? ` Wrong by themselves: ${plural(own.length, 'joint')}; only inherited: ${inherited.length}.` : '';
  return `No known mistake, nor two together, explains it.${of}`;
}

/** `Explains all 23 joints.`, `Explains 20 of 23 joints.` */
export function explainsText(cause: Cause, { compared, frames }: Comparison): string {
  const { explains, of } = cause;
  const noun = explainedNoun(cause, compared);
  const many = noun === 'vertex' ? 'vertices' : `${noun}s`;
  // A part may be of one of the times.
  const times = noun === 'channel' || cause.about ? 1 : frames.length;
  // Items of all times are counted; whole ones are told as there are in the character.
  const isEven = times > 1 && of % times === 0;
  const at = times > 1 ? ` at ${isEven && explains === of ? 'all ' : ''}${times} times` : '';
  if (explains < of) return `Explains ${explains} of ${of} ${of === 1 ? noun : many}${at}.`;
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
