/**
 * `marrow compare`: numbers that another program printed, against those of the character in the other files. Says which
 * joint, vertex or channel is wrong first, and which mistake explains all of it.
 */
import { runToEnd } from '../../evaluate/steps.ts';
import { dumpFormat } from '../../files/readers.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import { compare } from '../../teaching/compare/compare.ts';
import { DEFAULT_TOLERANCE } from '../../teaching/compare/errors.ts';
import { assumeTime, statesNoTime } from '../../teaching/dump/assumed-times.ts';
import { bestFit } from '../../teaching/dump/best-fit.ts';
import { type Fitted, fitDumps, type NamedDump, onlyTime } from '../../teaching/dump/fit-dump.ts';
import { joinedCharacters } from '../../teaching/dump/joined-characters.ts';
import { fitDumpsAt } from '../../teaching/dump/times.ts';
import { withPins } from '../compare-pin.ts';
import { comparisonJson, comparisonText } from '../compare-text.ts';
import { loadAny, openLoaded } from '../load.ts';
import { files } from '../options/inputs.ts';
import { type Kind, number, numbers, positive } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { PIN } from '../pin-argument.ts';
import { printJson, report } from '../report.ts';

const TIMES = numbers('T,T,…', 1);
/** Each once, since each names a dump or a list. */
const DISTINCT_TIMES: Kind<readonly number[]> = {
  ...TIMES,
  what: `${TIMES.what}, each once`,
  read(text, misfit) {
    const times = TIMES.read(text, misfit);
    return new Set(times).size < times.length ? misfit() : times;
  },
};

export const compareCommand = shellCommand({
  name: 'compare',
  summary: "Finds where another program's numbers are wrong, and which mistake explains them.",
  inputs: files('FILE… DUMP…', {
    FILE: 'The files of one character: `.skel`, `.skin`, `.morph`, `.anim`, or `.bvh`, Acclaim, glTF, FBX, NumPy.',
    DUMP: 'What your program prints, as text, CSV, JSON, OBJ or PLY.',
  }),
  options: {
    time: option(
      number('T'),
      'Sets the time, in seconds, of dumps that state none; otherwise they count as the file pose.',
    ),
    times: option(
      DISTINCT_TIMES,
      'Sets the times of dumps that state none, one after the other within a dump or one for each dump.',
    ),
    tolerance: option(
      positive('X'),
      "Allows numbers to be off by this much, as a fraction of the character's size or in radians.",
      { default: DEFAULT_TOLERANCE },
    ),
    pin: option(
      PIN,
      'Compares with inverse kinematics: matrices or joint positions after your solver, from the file pose or that of `--time`, has moved this point of a joint, by default its tip or origin, to x,y,z.',
      { isRepeated: true },
    ),
    'one-step': flag(
      'Compares with one step of the solver, Jᵀe of any length, damped or pseudo-inverse; this also finds a Jacobian read in the wrong order and a step in degrees.',
    ),
    json: flag(
      'Prints JSON: what was compared, what is wrong first, the causes, or, if none, the pattern of the errors.',
    ),
  },
  exclusive: [['time', 'times']],
  about: [
    'Names, brackets, commas, units and headings around the numbers of a dump are skipped.',
    {
      heading: 'Numbers of a dump',
      terms: {
        matrices:
          '12 or 16 numbers per joint, in one line or in rows, by rows or by columns; world matrices, or local ones under the heading "local".',
        points: '3 numbers per joint or vertex; normals have the heading "normals".',
        channels: 'Rows of a time and a value per channel, or "channel N" above rows of a time and a value.',
      },
    },
    'Joints are in depth-first order, or have their name or index before their numbers: `hip: …`, `hip (…)`, `hip vec3(…)`, `joint 7 (hip) …`.',
    'A dump states its time in a line above its numbers, `time 1.5` or `t = 1.5 s`, as `"time": 1.5` in JSON, or at the end of its name, `mine@1.5.txt`; several times may follow each other.',
    'A dump of inverse kinematics states its target in a line, `target hand 0.3 1.2 0`, with the line "one step" if it is of one step; in JSON as `"targets": [{"joint": "hand", "position": [0.3, 1.2, 0]}]` and `"oneStep": true`. Any solution agrees; otherwise Marrow names the mistake, such as the wrong end effector or a step of unscaled Jᵀe.',
  ],
  examples: [
    'marrow compare wasp.skel wasp_walk.anim mine.txt --time 1.5',
    'marrow compare arm.skel mine.txt --pin hand=0.3,1.2,0',
  ],
  exits: { 0: 'all agree', 1: 'numbers differ', 2: 'wrong usage, or a file is missing, has errors or does not fit' },
  async run({ inputs, options: { time, tolerance, pin: pins, 'one-step': isOneStep, json, ...options } }, io) {
    const times = time === undefined ? (options.times ?? []) : [time];
    const {
      document,
      dumps,
      diagnostics: opened,
    } = openLoaded(await loadAny(inputs, io.folder, { otherwise: dumpFormat(), asNumbers: true }));
    const diagnostics = [...opened];
    const named = dumps.map(({ dump, source }): NamedDump => ({ fileName: source.path, dump }));
    const { fitted, character, dumps: fittedDumps } = fitBest(document.characters, named, times, tolerance);
    if (!hasErrors(diagnostics)) {
      const found = fitted.targets
        ? fitted.diagnostics
        : (ofSeveral(document.characters, named, times) ?? fitted.diagnostics);
      diagnostics.push(...missing(document.characters, named), ...found);
    }
    report(diagnostics, io);
    if (hasErrors(diagnostics) || !fitted.targets || !character) {
      if (json) await printJson({ diagnostics }, io);
      return 2;
    }
    const targets = withPins(fitted.targets, character.skeleton, pins, isOneStep);
    const comparison = runToEnd(compare(character, targets, tolerance));
    const isNamed = document.characters.length > 1;
    const told = { comparison, character, isNamed, targets, dumps: fittedDumps, asked: times };
    if (json) await printJson({ ...comparisonJson(told), diagnostics }, io);
    else await io.out(comparisonText(told));
    return comparison.agrees ? 0 : 1;
  },
});

/** The character that the dumps fit best, or all roots of a file; else the first one, with what is wrong. */
function fitBest(
  characters: readonly Character[],
  dumps: readonly NamedDump[],
  times: readonly number[],
  tolerance: number,
) {
  const all = [...characters, ...joinedCharacters(characters)];
  const best = bestFit(all, dumps, times);
  if (!best) {
    const none: Fitted = { diagnostics: [] };
    const [first] = all;
    return { character: first, fitted: first ? fitDumpsAt(first, dumps, times) : none, dumps };
  }
  const { character } = best;
  const time = onlyTime(dumps);
  // Asked for, or with nothing to choose from.
  if (times.length > 0 || time === undefined || !dumps.some(statesNoTime)) return { ...best, dumps };
  const timed = dumps.map((dump) => runToEnd(assumeTime(character, dump, [time, undefined], tolerance)));
  const fitted = fitDumps(character, timed, undefined);
  return fitted.targets ? { character, fitted, dumps: timed } : { ...best, dumps };
}

/** Dumps that fit no character together, though each fits one; undefined if that isn't so. */
function ofSeveral(
  characters: readonly Character[],
  dumps: readonly NamedDump[],
  times: readonly number[],
): readonly Diagnostic[] | undefined {
  if (characters.length < 2 || dumps.length < 2) return undefined;
  const each = dumps.map((dump) => ({ dump, character: bestFit(characters, [dump], times)?.character }));
  const fitting = characters.flatMap((character) => {
    const files = each.filter((one) => one.character === character).map(({ dump }) => dump.fileName);
    return files.length > 0 ? [`${files.join(', ')} of ${character.name}`] : [];
  });
  if (fitting.length < 2 || each.some(({ character }) => !character)) return undefined;
  const message = `Expected dumps of one character, found ${fitting.join('; ')}. Compare one character at a time.`;
  return [withoutPlace('error', 'dumps-of-several', message, '')];
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
