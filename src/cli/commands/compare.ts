/**
 * `marrow compare`: numbers that another program printed, against those of the character in the other files. Says which
 * joint, vertex or channel is wrong first, and which mistake explains all of it.
 */
import { runToEnd } from '../../evaluate/steps.ts';
import { type Comparison, compare, type FirstWrong, type FrameComparison, worstError } from '../../lesson/compare.ts';
import { comparedText } from '../../lesson/compared-text.ts';
import { fitDumpsAt } from '../../lesson/dump-times.ts';
import { DEFAULT_TOLERANCE } from '../../lesson/errors.ts';
import type { Fitted, NamedDump } from '../../lesson/fit-dump.ts';
import { joinedFigures } from '../../lesson/joined-figures.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { dumpFormat } from '../../project/readers.ts';
import { type Arguments, numberOf, numbersOf, parseArguments, UsageError } from '../arguments.ts';
import type { CliCommand } from '../io.ts';
import { loadFiles, openLoaded } from '../load.ts';
import { printJson, report } from '../report.ts';

export const compareCommand: CliCommand = {
  name: 'compare',
  usage: 'FILE… DUMP… [--time T | --times T,T,…] [--tolerance X] [--json]',
  summary: "where another program's numbers are wrong, and the mistake that explains them",
  exits: { 0: 'all agree', 1: 'numbers differ', 2: 'wrong usage, or a file is missing, has errors or does not fit' },
  async run(args, io) {
    const given = parseArguments(args, { time: 'value', times: 'value', tolerance: 'value', json: 'flag' });
    const times = timesOf(given);
    const toleranceText = given.value('tolerance');
    const tolerance = toleranceText === undefined ? DEFAULT_TOLERANCE : numberOf('tolerance', toleranceText);
    if (!(tolerance > 0)) throw new UsageError(`--tolerance takes a number above 0, not ${tolerance}.`);
    const { document, dumps, diagnostics: opened } = openLoaded(loadFiles(given.files, io.folder, dumpFormat()));
    const diagnostics = [...opened];
    const named = dumps.map(({ dump, source }): NamedDump => ({ fileName: source.path, dump }));
    const { fitted, character } = fitFirst(document.characters, named, times);
    if (!hasErrors(diagnostics)) diagnostics.push(...missing(document.characters, named), ...fitted.diagnostics);
    report(diagnostics, io);
    if (hasErrors(diagnostics) || !fitted.targets || !character) {
      if (given.flag('json')) await printJson({ diagnostics }, io);
      return 2;
    }
    const comparison = runToEnd(compare(character, fitted.targets, tolerance));
    if (given.flag('json')) await printJson({ ...asJson(comparison), diagnostics }, io);
    else await io.out(asText(comparison, character));
    return comparison.agrees ? 0 : 1;
  },
};

/** Of dumps that state none; empty if not given. */
function timesOf(given: Arguments): readonly number[] {
  const [time, times] = [given.value('time'), given.value('times')];
  if (time !== undefined && times !== undefined) throw new UsageError('Give one of --time and --times.');
  if (time !== undefined) return [numberOf('time', time)];
  if (times === undefined) return [];
  const numbers = numbersOf('times', times);
  if (numbers.length === 0) throw new UsageError('--times takes at least one number; found none.');
  if (new Set(numbers).size < numbers.length) throw new UsageError('--times takes each time once.');
  return numbers;
}

/** The character that the dumps fit best, or all roots of a file; else the first one, with what is wrong. */
function fitFirst(characters: readonly Character[], dumps: readonly NamedDump[], times: readonly number[]) {
  const none: Fitted = { diagnostics: [] };
  const tried = [...characters, ...joinedFigures(characters)].map((character) => ({
    character,
    fitted: fitDumpsAt(character, dumps, times),
  }));
  const fits = tried.flatMap(({ character, fitted }) => {
    const { targets } = fitted;
    return targets ? [{ character, fitted, worst: tried.length > 1 ? worstError(character, targets) : 0 }] : [];
  });
  fits.sort((a, b) => (a.worst === b.worst ? 0 : a.worst - b.worst));
  return fits[0] ?? tried[0] ?? { fitted: none, character: undefined };
}

function missing(characters: readonly Character[], dumps: readonly NamedDump[]): Diagnostic[] {
  if (characters.length === 0) {
    return [
      withoutPlace('error', 'character-missing', 'Expected the files of a character to compare with, found none.', ''),
    ];
  }
  if (dumps.length > 0) return [];
  const message = 'Expected a dump: numbers of joints, vertices or channels printed by another program; found none.';
  return [withoutPlace('error', 'dump-missing', message, '')];
}

function asJson({ agrees, compared, layout, worst, first, frames, own, inherited, causes }: Comparison) {
  const shown = frames.find((frame) => !frame.agrees) ?? frames[0];
  return {
    agrees,
    ...(shown?.time !== undefined && { time: shown.time }),
    compared,
    ...(layout && { layout }),
    worst,
    ...(first && { first }),
    own,
    inherited,
    causes: causes.map(({ code, detail, alternatives, explains, of, residual, sentences, formulas }) => ({
      code,
      detail,
      ...(alternatives.length > 0 && { alternatives }),
      explains,
      of,
      residual,
      sentence: sentences.join(' '),
      formula: formulas.join('; '),
    })),
    ...(frames.length > 1 && {
      times: frames.map((frame) => ({
        ...(frame.time !== undefined && { time: frame.time }),
        agrees: frame.agrees,
        worst: frame.worst,
        ...(frame.first && { first: frame.first }),
        own: frame.own,
        inherited: frame.inherited,
      })),
    }),
  };
}

function asText(comparison: Comparison, character: Character): string {
  const { agrees, compared, layout, worst, first, frames, own, inherited, causes } = comparison;
  const lines = [`Compared: ${comparedText(compared, frames.length)}.`];
  if (layout) lines.push(`Matrices of ${layout.numbers} numbers, ${layout.order}.`);
  if (frames.length > 1) lines.push(`Times: ${frames.map(timeText).join(', ')}.`);
  if (agrees || !first) lines.push(`All agree. The largest error is ${short(worst)}.`);
  else {
    lines.push(`First wrong: ${placeOf(first)}, by ${short(first.error)}. The largest error is ${short(worst)}.`);
    const list = (joints: readonly number[]) => {
      const named = joints.slice(0, MAX_NAMED).map((j) => nameOf(character, j));
      const more = joints.length - named.length;
      return more > 0 ? `${named.join(', ')} and ${more} more` : named.join(', ');
    };
    if (own.length > 0) lines.push(`Wrong by themselves: ${list(own)}.`);
    if (inherited.length > 0) lines.push(`Wrong only because a parent is: ${list(inherited)}.`);
    for (const { code, detail, alternatives, sentences, formulas, explains, of, residual } of causes) {
      lines.push(
        '',
        `${code}${detail && ` (${detail})`}`,
        ...sentences.map((sentence) => `  ${sentence}`),
        ...alternatives.map((other) => `  Equally: ${other}.`),
        ...[...new Set(formulas)].map((formula) => `    ${formula}`),
        `  Explains ${explains} of ${of}; what remains is at most ${short(residual)}.`,
      );
    }
    if (causes.length === 0) lines.push('', 'No known mistake, nor two together, explains these numbers.');
  }
  return `${lines.join('\n')}\n`;
}

/** As text; JSON has all. */
const MAX_NAMED = 20;

/** `1.5 s differs by 0.27`. */
function timeText({ time, agrees, worst }: FrameComparison): string {
  const at = time === undefined ? 'the file pose' : `${time} s`;
  return `${at} ${agrees ? 'agrees' : `differs by ${short(worst)}`}`;
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
