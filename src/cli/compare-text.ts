/** What `marrow compare` prints. */

import { type Character, shownTake } from '../model/document.ts';
import {
  type Compared,
  type ComparedGoal,
  type Comparison,
  type FirstWrong,
  type FrameComparison,
  isExplained,
} from '../teaching/compare/compare.ts';
import {
  areEqual,
  comparedText,
  explainedNoun,
  subjectText,
  unexplainedSentences,
} from '../teaching/compare/compared-text.ts';
import type { Targets } from '../teaching/compare/targets.ts';
import { statesNoTime } from '../teaching/dump/assumed-times.ts';
import type { NamedDump } from '../teaching/dump/fit-dump.ts';
import type { Cause } from '../teaching/search/found-causes.ts';

/** A comparison, and what was compared. */
export interface ToldComparison {
  readonly comparison: Comparison;
  readonly character: Character;
  /** Whether there are others. */
  readonly isNamed: boolean;
  readonly targets: Targets;
  /** With the times that are assumed. */
  readonly dumps: readonly NamedDump[];
  /** By `--time` or `--times`. */
  readonly asked: readonly number[];
}

/** What `--json` prints. */
export function comparisonJson(told: ToldComparison) {
  const { agrees, compared, layout, worst, first, frames, own, inherited, causes, pattern, goals } = told.comparison;
  const hints = hintsOf(told);
  const shown = frames.find((frame) => !frame.agrees) ?? frames[0];
  return {
    agrees,
    ...(shown?.time !== undefined && { time: shown.time }),
    compared,
    ...(layout && { layout }),
    worst,
    ...(first && { first: placeJson(first) }),
    own,
    inherited,
    causes: causes.map(causeJson),
    ...(pattern && { pattern }),
    ...(goals && { goals: goals.map((goal) => goalJson(goal, frames)) }),
    ...(hints.length > 0 && { hints }),
    ...(frames.length > 1 && {
      times: frames.map((frame) => ({
        ...(frame.time !== undefined && { time: frame.time }),
        agrees: frame.agrees,
        worst: frame.worst,
        ...(frame.first && { first: placeJson(frame.first) }),
        own: frame.own,
        inherited: frame.inherited,
      })),
    }),
  };
}

/** Distances, and whether the joints are a pose at all. */
function goalJson({ frame, ...goal }: ComparedGoal, frames: Comparison['frames']) {
  const { time } = frames[frame];
  return { ...goal, ...(time !== undefined && { time }) };
}

function causeJson(cause: Cause) {
  const { code, detail, alternatives, explains, of, residual, sentences, formulas, about } = cause;
  return {
    code,
    detail,
    ...(alternatives.length > 0 && { alternatives }),
    ...(about && { kinds: about.kinds, files: about.files }),
    explains,
    of,
    residual,
    sentence: sentences.join(' '),
    formula: formulas.join('; '),
  };
}

/** What is printed without `--json`. */
export function comparisonText(told: ToldComparison): string {
  const { comparison, character, dumps, isNamed } = told;
  const isOfSeveral = dumps.length > 1;
  const { agrees, compared, layout, worst, first, frames, largest, own, inherited, causes, reached = [] } = comparison;
  const lines = [`Compared${isNamed ? ` with ${character.name}` : ''}: ${comparedText(compared, frames.length)}.`];
  if (layout) lines.push(`Matrices of ${layout.numbers} numbers, ${layout.order}.`);
  lines.push(...dumpTimeLines(told));
  if (frames.length > 1) lines.push(`Times: ${frames.map(timeText).join(', ')}.`);
  if (agrees || !first) lines.push(...reached, `All agree. The largest error is ${short(worst)}.`);
  else {
    lines.push(`First wrong: ${placeOf(first)}, ${errorText(first)}.`);
    if (largest && !isSamePlace(largest, first))
      lines.push(`Largest error: ${placeOf(largest)}, ${errorText(largest)}.`);
    const list = (joints: readonly number[]) => {
      const named = joints.slice(0, MAX_NAMED).map((j) => nameOf(character, j));
      const more = joints.length - named.length;
      return more > 0 ? `${named.join(', ')} and ${more} more` : named.join(', ');
    };
    if (own.length > 0) lines.push(`Own error (wrong relative to the parent): ${list(own)}.`);
    if (inherited.length > 0) lines.push(`Inherited (wrong only because a parent is): ${list(inherited)}.`);
    lines.push(...causesLines(causes, compared, isOfSeveral));
    const rest = unexplainedSentences(comparison, isOfSeveral);
    if (rest.length > 0) lines.push('', ...rest);
  }
  const hints = hintsOf(told);
  if (hints.length > 0) lines.push('', ...hints);
  return `${lines.join('\n')}\n`;
}

function causesLines(causes: readonly Cause[], compared: Compared, isOfSeveral: boolean): readonly string[] {
  const equal = `Each of these ${causes.length} mistakes explains it; these numbers can't tell them apart.`;
  const each = causes.flatMap((cause) => ['', ...causeLines(cause, compared, isOfSeveral)]);
  return areEqual(causes) ? ['', equal, ...each] : each;
}

function causeLines(cause: Cause, compared: Compared, isOfSeveral: boolean): readonly string[] {
  const { code, detail, alternatives, sentences, formulas, explains, of, residual, about } = cause;
  const noun = explainedNoun(cause, compared);
  const items = of === 1 ? noun : noun === 'vertex' ? 'vertices' : `${noun}s`;
  return [
    `${code}${detail && ` (${detail})`}${about ? `, in the ${subjectText(about, isOfSeveral)}` : ''}`,
    ...sentences.map((sentence) => `  ${sentence}`),
    ...alternatives.map((other) => `  Equally: ${other}.`),
    ...[...new Set(formulas)].map((formula) => `    ${formula}`),
    `  Explains ${explains} of ${of} ${items}; the largest remaining error is ${short(residual)}.`,
  ];
}

/** As scripts know it, without what is for people. */
function placeJson({ length: _length, ...place }: FirstWrong) {
  return place;
}

function isSamePlace(a: FirstWrong, b: FirstWrong): boolean {
  return a.what === b.what && a.index === b.index && a.time === b.time;
}

/** At which time each dump was compared, and why, where it isn't plain. */
function dumpTimeLines({ character, targets, dumps, asked }: ToldComparison): readonly string[] {
  const { origins, frames } = targets;
  return dumps.flatMap((named, d) => {
    const times = frames.flatMap(({ time }, f) => (Object.values(origins?.frames[f] ?? {}).includes(d) ? [time] : []));
    if (times.length === 0) return [];
    const isStated = !statesNoTime(named);
    const [time] = times;
    if (!isStated && time === undefined && !shownTake(character)) return [];
    const at = times.length > 1 ? `at ${times.length} times` : time === undefined ? 'in the file pose' : `at ${time} s`;
    const others = asked.filter((each) => !times.includes(each));
    const isAsked = !isStated && asked.length > 0;
    const why = isStated
      ? `, the time it states${others.length > 0 ? `; --time${asked.length > 1 ? 's' : ''} ${asked.join(',')} is only for dumps without a time` : ''}`
      : isAsked
        ? ', as asked'
        : time === undefined
          ? ', because it states no time'
          : ', the time the others state';
    return [`${dumps.length > 1 ? named.fileName : 'The dump'} is compared ${at}${why}.`];
  });
}

/** What may help where nothing explains the numbers. */
function hintsOf({ comparison, character, dumps }: ToldComparison): readonly string[] {
  if (isExplained(comparison)) return [];
  const { frames } = comparison;
  const timed = frames.filter(({ agrees, time }) => !agrees && time !== undefined);
  if (!shownTake(character) && timed.length > 0) {
    return [`The dump is from ${timed[0].time} s. Give the .anim too: without it, every time has the file pose.`];
  }
  const joints = character.skeleton?.joints.length ?? 0;
  const isAllWrong = frames.some(({ own, inherited }) => joints > 0 && own.length + inherited.length === joints);
  if (!shownTake(character) && isAllWrong) {
    return ['All joints differ. If the dump is from an animation, give the .anim too, and the time with --time T.'];
  }
  const isOfPose = frames.some(({ agrees, time }) => !agrees && time === undefined);
  if (shownTake(character) && isOfPose && dumps.some(statesNoTime)) {
    return ['The dump states no time. If it is not the file pose, give its time with --time T.'];
  }
  return [];
}

/** As text; JSON has all. */
const MAX_NAMED = 20;

/** `1.5 s differs by 0.27`. */
function timeText({ time, agrees, worst }: FrameComparison): string {
  const at = time === undefined ? 'the file pose' : `${time} s`;
  return `${at} ${agrees ? 'agrees' : `differs by ${short(worst)}`}`;
}

/** `by 1.9 (0.476 of the size 4)` of lengths; other errors have no unit. */
export function errorText({ what, error, length }: FirstWrong): string {
  if (!Number.isFinite(error)) return 'which is not a finite number';
  if (length !== undefined && length > 0)
    return `by ${short(length)} (${short(error)} of the size ${short(length / error)})`;
  return `by ${short(error)}${what === 'joint' ? ' in its rotation' : ''}`;
}

function placeOf({ what, index, name, time }: FirstWrong): string {
  return `${what} ${index}${name ? ` "${name}"` : ''}${time === undefined ? '' : ` at ${time} s`}`;
}

function nameOf({ skeleton }: Character, joint: number): string {
  return skeleton?.joints[joint]?.name || `joint ${joint}`;
}

function short(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(3))) : 'not a number';
}
