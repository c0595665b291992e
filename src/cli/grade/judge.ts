/**
 * Judges a submission: a folder or a zip with files and dumps.
 *
 * Files are compared by what they evaluate to. Each takes the place of the reference's file of the same name, first of
 * the same path, else of the same base name; where the submission has none, the reference's own stays. Dumps are
 * compared with the reference's dump of the same name, else with the reference's character that they fit best.
 */
import { relative, sep } from 'node:path';
import { runToEnd } from '../../evaluate/steps.ts';
import { openFiles } from '../../files/open/open-files.ts';
import type { DumpFile } from '../../files/open/open-in-steps.ts';
import { formatOf } from '../../files/readers.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, EMPTY_DOCUMENT, shownSkin, shownTake } from '../../model/document.ts';
import { isEmptyDump } from '../../model/dump.ts';
import { type BrokenFile, baseName, type ParsedFile, type SourceFile } from '../../model/files.ts';
import { vertexCount } from '../../model/skin.ts';
import { type Compared, type Comparison, compare } from '../../teaching/compare/compare.ts';
import { compareDumps } from '../../teaching/compare/compare-dumps.ts';
import { subjectText, unexplainedSentences } from '../../teaching/compare/compared-text.ts';
import type { ChannelTarget, FrameTarget, Targets } from '../../teaching/compare/targets.ts';
import { assumeTime, statesNoTime } from '../../teaching/dump/assumed-times.ts';
import { bestFit } from '../../teaching/dump/best-fit.ts';
import { fitDumps, type NamedDump } from '../../teaching/dump/fit-dump.ts';
import { fitDumpsAt } from '../../teaching/dump/times.ts';
import { Evaluator } from '../../teaching/program/evaluator.ts';
import { ownValues } from '../../teaching/program/own-values.ts';
import { RIGHT_PROGRAM } from '../../teaching/program/program.ts';
import { type Loaded, loadFound } from '../load.ts';
import type { GivenPath } from '../paths.ts';
import { fileBytes } from '../read-file.ts';
import { reasonOf } from '../reason.ts';
import type { ChannelCount, Grade, PartGrade, Verdict } from './grade.ts';
import { missingOf, type Need } from './needs.ts';
import { type Reference, timesFor } from './reference.ts';
import { lacking, type RightDump, rightDumpFor, withHeadings } from './right-dumps.ts';
import { sideBySide } from './side-by-side.ts';
import { filesOf } from './submissions.ts';

export interface JudgeOptions {
  /** The caller's, absolute: paths in results are relative to it. */
  readonly folder: string;
  readonly times: readonly number[] | undefined;
  readonly tolerance: number;
  /** Parts that a submission must have. */
  readonly needs: readonly Need[];
}

/** Of a matrix. */
const MIN_NUMBERS = 12;
const NOTHING_COMPARED: Compared = { world: 0, local: 0, positions: 0, vertices: 0, normals: 0, channels: 0 };

/**
 * Never throws: a submission that can't be judged has a problem that says why.
 * @param submission its folder, absolute
 */
export async function judge(submission: string, reference: Reference, options: JudgeOptions): Promise<Grade> {
  try {
    return await new Judging(submission, reference, options).grade();
  } catch (error) {
    const path = slashed(relative(options.folder, submission));
    return notJudged(
      path,
      withoutPlace('error', 'judging-failed', `Grading this submission failed: ${reasonOf(error)}.`, path),
    );
  }
}

export function notJudged(path: string, ...problems: readonly Diagnostic[]): Grade {
  return {
    name: baseName(path),
    path,
    verdict: 'not judged',
    loads: false,
    joints: 0,
    jointError: null,
    vertexError: null,
    channels: null,
    parts: [],
    problems,
  };
}

class Judging {
  private readonly path: string;
  private readonly problems: Diagnostic[] = [];
  private readonly parts: PartGrade[] = [];
  private loads = true;
  /** Whether nothing is missing. */
  private isWhole = true;

  constructor(
    private readonly submission: string,
    private readonly reference: Reference,
    private readonly options: JudgeOptions,
  ) {
    this.path = slashed(relative(options.folder, submission));
  }

  async grade(): Promise<Grade> {
    const { reference, path, problems, parts } = this;
    const handedIn = filesOf(this.submission, this.options.folder);
    problems.push(...handedIn.problems);
    if (hasErrors(handedIn.problems)) this.loads = false;
    const given = handedIn.files.map((file) => file.path);
    const counterparts = new Map<string, string>();
    for (const { source, kind } of reference.files) {
      const own = kind === 'dump' ? undefined : this.counterpartOf(source, given);
      if (own !== undefined) counterparts.set(source.path, own);
    }
    const used = new Set(counterparts.values());
    // Programs, pictures and notes are left alone.
    const read = handedIn.files.filter(({ path: file }) => used.has(file) || formatOf(file)?.kind === 'dump');
    if (read.length === 0) {
      if (hasErrors(problems)) return notJudged(path, ...problems);
      const names = reference.files.map(({ source }) => source.name).join(', ');
      const message = `Expected files with the reference's names (${names}) or a dump, found none.`;
      return notJudged(path, withoutPlace('error', 'nothing-to-judge', message, path));
    }
    const loaded = await loadFound(read, this.options.folder, read, reference.skeletons);
    problems.push(...loaded.diagnostics.filter(({ code }) => code !== 'format-unknown'));
    if (used.size > 0) this.judgeFiles(loaded, counterparts);
    for (const file of loaded.files) if (file.kind === 'dump' && !used.has(file.source.path)) this.judgeDump(file);
    for (const { path: file, content } of loaded.all) {
      const isEmpty = content === undefined || isEmptyDump(content);
      if (isEmpty && !used.has(file) && rightDumpFor(baseName(file), reference.dumps)) this.emptyDump(file);
      // A page of prose with a number in it is no dump, and nothing is missing without it.
      else if (!content && !used.has(file) && this.looksLikeNumbers(read.find(({ path: own }) => own === file)))
        this.loads = false;
    }
    this.tellMissingDumps(given);
    const missing = missingOf(this.options.needs, parts, path);
    problems.push(...missing);
    if (missing.length > 0) this.isWhole = false;
    if (parts.length === 0 && !hasErrors(problems)) {
      const message = 'Nothing in it could be compared with the reference.';
      problems.push(withoutPlace('error', 'nothing-to-judge', message, path));
    }
    const channels = parts.flatMap((part) => part.channels ?? []);
    return {
      name: baseName(path),
      path,
      verdict: this.verdict(),
      loads: this.loads,
      joints: Math.max(0, ...parts.map((part) => part.joints)),
      jointError: largest(parts.map(({ jointError }) => jointError)),
      vertexError: largest(parts.map(({ vertexError }) => vertexError)),
      channels: channels.length > 0 ? sumOf(channels) : null,
      parts,
      problems,
    };
  }

  private verdict(): Verdict {
    const { parts, loads, isWhole } = this;
    if (parts.length === 0) return 'not judged';
    if (parts.some(({ agrees }) => !agrees)) return 'wrong';
    return loads && isWhole ? 'right' : 'incomplete';
  }

  /** Numbers that the reference has, and the submission doesn't. */
  private tellMissingDumps(given: readonly string[]): void {
    const { dumps } = this.reference;
    const there = new Set(given.map((file) => rightDumpFor(baseName(file), dumps)));
    for (const dump of dumps) {
      if (there.has(dump)) continue;
      this.isWhole = false;
      const message = `Expected numbers in a file called ${dump.file.source.name}, as in the reference; found none.`;
      this.problems.push(withoutPlace('error', 'dump-missing', message, this.path));
    }
  }

  private looksLikeNumbers(file: GivenPath | undefined): boolean {
    try {
      return file !== undefined && isMostlyNumbers(file.bytes ?? fileBytes(file.absolute, MAX_LOOKED_AT));
    } catch {
      // What can't be read may be anything.
      return true;
    }
  }

  /** The file of the same path within the submission, else of the same base name and highest up. */
  private counterpartOf({ path, name }: SourceFile, given: readonly string[]): string | undefined {
    const inside = (file: string) => file.slice(this.path.length + 1).toLowerCase();
    const same = given.find((file) => inside(file) === path.toLowerCase());
    if (same !== undefined) return same;
    const named = given.filter((file) => baseName(file).toLowerCase() === name.toLowerCase());
    const depth = (file: string) => file.split('/').length;
    return named.sort((a, b) => depth(a) - depth(b))[0];
  }

  private judgeFiles(loaded: Loaded, counterparts: ReadonlyMap<string, string>): void {
    const { reference, problems } = this;
    const readByPath = new Map(loaded.files.map((file) => [file.source.path, file]));
    // In the reference's folders and order, so that the same files belong together.
    const files: ParsedFile[] = [];
    const broken: BrokenFile[] = [];
    for (const file of reference.files) {
      if (file.kind === 'dump') continue;
      const own = counterparts.get(file.source.path);
      const theirs = own === undefined ? file : readByPath.get(own);
      if (theirs) {
        const source = { ...theirs.source, name: file.source.name, path: file.source.path };
        const of = file.kind === 'amc' ? file.of : undefined;
        files.push(theirs.kind === 'amc' && of ? { ...theirs, source, of } : { ...theirs, source });
      } else broken.push({ kind: file.kind, source: file.source });
    }
    if (broken.length > 0) this.loads = false;
    const called = ({ path, name }: SourceFile) => counterparts.get(path) ?? name;
    const opened = openFiles(EMPTY_DOCUMENT, files, broken, undefined, called);
    // What the reference's own files say is the teacher's affair.
    const theirs = new Set(counterparts.values());
    const found = opened.diagnostics.filter(({ file, code }) => theirs.has(file) && code !== 'format-unknown');
    problems.push(...found);
    if (hasErrors(found)) this.loads = false;
    const characters = byKey(opened.document.characters);
    for (const [key, right] of byKey(reference.characters)) {
      const given = right.sources.flatMap(({ path }) => counterparts.get(path) ?? []);
      const own = given.filter((path) => readByPath.has(path));
      const character = characters.get(key);
      const comparable = character && withoutUnread(right, character);
      if (own.length > 0 && comparable) this.parts.push(this.judgeCharacter(comparable, character, own));
    }
  }

  private judgeCharacter(right: Character, theirs: Character, files: readonly string[]): PartGrade {
    const mismatches: string[] = [];
    const compareCounts = (what: string, count: (character: Character) => number) => {
      const [expected, found] = [count(right), count(theirs)];
      if (expected !== found) mismatches.push(`${found} ${what}, expected ${expected}`);
      return expected === found && expected > 0;
    };
    const hasJoints = compareCounts('joints', ({ skeleton }) => skeleton?.joints.length ?? 0);
    const hasVertices = compareCounts('vertices', (character) => {
      const skin = shownSkin(character);
      return skin ? vertexCount(skin) : 0;
    });
    compareCounts('channels', (character) => shownTake(character)?.channels.length ?? 0);
    const times = timesFor(right, this.options.times);
    const evaluator = new Evaluator(theirs);
    const frames = !(hasJoints || hasVertices)
      ? []
      : times.map((time): FrameTarget => {
          const wanted = { local: false, vertices: hasVertices, normals: hasVertices };
          const { world, vertices, normals } = evaluator.frame(RIGHT_PROGRAM, time, wanted);
          return {
            time,
            ...(hasJoints && { world: world.slice() }),
            ...(hasVertices && { vertices: vertices.slice(), normals: normals.slice() }),
          };
        });
    return this.part(files, right, { frames, channels: channelsOf(right, theirs, times) }, mismatches);
  }

  private judgeDump(file: DumpFile): void {
    const right = rightDumpFor(file.source.name, this.reference.dumps);
    const dump = right ? withHeadings(file.dump, right.file.dump) : file.dump;
    if (right && !right.of) this.judgeNumbers(file, right);
    else this.judgeFitted({ ...file, dump }, right);
  }

  /** Nothing of theirs is compared where the reference has numbers. */
  private emptyDump(path: string): void {
    this.loads = false;
    if (this.problems.some(({ file, severity }) => file === path && severity === 'error')) return;
    const message = "Expected numbers, as in the reference's file of this name, found none.";
    this.problems.push(withoutPlace('error', 'dump-empty', message, path));
  }

  private judgeFitted(file: DumpFile, right: RightDump | undefined): void {
    const named = { fileName: file.source.path, dump: file.dump };
    const characters = right?.of ? [right.of.character] : [...this.reference.characters, ...this.reference.joined];
    const found = this.fitted(named, characters, right);
    if (!found) {
      // A note with some numbers in it is no dump.
      const count = file.dump.blocks.reduce((sum, { values }) => sum + values.length, 0);
      const severity = !right && count < MIN_NUMBERS ? 'info' : 'warning';
      const assumed = 'not compared';
      const [first] = characters;
      const diagnostics = first ? fitDumpsAt(first, [named], this.options.times ?? []).diagnostics : [];
      this.problems.push(...diagnostics.map((d): Diagnostic => ({ ...d, severity, assumed })));
      if (severity === 'warning') this.isWhole = false;
      if (right) this.parts.push(uncompared(file.source.path, ["numbers that differ from the reference's"], null));
      return;
    }
    const { character, targets } = found;
    const mismatches = right?.of ? lacking(targets, right.of.targets) : [];
    this.parts.push(this.part([file.source.path], character, targets, mismatches));
  }

  /** A dump of one time that states none is of the reference's, or of one of those asked for or the file pose. */
  private fitted(named: NamedDump, characters: readonly Character[], right: RightDump | undefined) {
    const { times = [], tolerance } = this.options;
    const best = bestFit(characters, [named], times) ?? bestFit(characters, [named], []);
    const targets = best?.fitted.targets;
    if (!best || !targets) return undefined;
    const { character } = best;
    const asked = right?.of ? right.of.targets.frames.map(({ time }) => time) : [...times, undefined];
    if (targets.frames.length !== 1 || !statesNoTime(named) || asked.length < (right ? 1 : 2))
      return { character, targets };
    const timed = runToEnd(assumeTime(character, named, asked, tolerance));
    return { character, targets: fitDumps(character, [timed], undefined).targets ?? targets };
  }

  /** Number by number, since they are of no open character. */
  private judgeNumbers({ source, dump }: DumpFile, right: RightDump): void {
    const { agrees, numbers, worst, first } = compareDumps(dump, right.file.dump, this.options.tolerance);
    this.parts.push({
      ...uncompared(source.path, first ? [first] : [], numbers > 0 ? worst : null),
      agrees,
      numbers,
    });
  }

  private part(files: readonly string[], right: Character, targets: Targets, mismatches: readonly string[]): PartGrade {
    const comparison = runToEnd(compare(right, targets, this.options.tolerance));
    return gradeOf(files, right, targets, comparison, mismatches, this.options.tolerance);
  }
}

/** A dump that was compared with no character. */
function uncompared(path: string, mismatches: readonly string[], worst: number | null): PartGrade {
  return {
    files: [path],
    agrees: false,
    compared: NOTHING_COMPARED,
    times: 0,
    joints: 0,
    worst,
    jointError: null,
    vertexError: null,
    channels: null,
    mismatches,
    frameTimes: [],
    own: [],
    inherited: [],
    causes: [],
    unexplained: [],
  };
}

function gradeOf(
  files: readonly string[],
  right: Character,
  targets: Targets,
  comparison: Comparison,
  mismatches: readonly string[],
  tolerance: number,
): PartGrade {
  const { agrees, compared, worst, first, frames, own, inherited, causes } = comparison;
  const shown = sideBySide(targets, comparison);
  const named = (joints: readonly number[]) => joints.map((j) => right.skeleton?.joints[j]?.name || `joint ${j}`);
  const wrong = frames.find((frame) => !frame.agrees);
  const errorIn = (pick: (frame: Comparison['frames'][number]) => Float64Array) =>
    largest(frames.map((frame) => (pick(frame).length > 0 ? pick(frame).reduce((a, b) => Math.max(a, b), 0) : null)));
  return {
    files,
    agrees: agrees && mismatches.length === 0,
    compared,
    times: frames.length,
    joints: Math.max(0, ...frames.map(({ jointErrors }) => jointErrors.length)),
    worst: frames.length > 0 || compared.channels > 0 ? worst : null,
    jointError: errorIn(({ jointErrors }) => jointErrors),
    vertexError: errorIn(({ vertexErrors, normalErrors }) => (vertexErrors.length > 0 ? vertexErrors : normalErrors)),
    channels: countChannels(right, targets.channels, tolerance),
    mismatches,
    ...(first && { first }),
    ...(wrong?.time !== undefined && { time: wrong.time }),
    ...(shown && { shown }),
    frameTimes: frames.map(({ time }) => time ?? null),
    own: named(own),
    inherited: named(inherited),
    causes: causes.map(({ code, detail, alternatives, sentences, formulas, explains, of, about }) => ({
      code,
      detail,
      ...(alternatives.length > 0 && { alternatives }),
      ...(about && { about: subjectText(about, false) }),
      sentence: sentences.join(' '),
      formula: [...new Set(formulas)].join('; '),
      explains,
      of,
    })),
    unexplained: unexplainedSentences(comparison, false),
  };
}

/** Their values of the channels that both have. Captures are compared by their joints. */
function channelsOf(right: Character, theirs: Character, times: readonly (number | undefined)[]): ChannelTarget {
  const [own, take] = [shownTake(right), shownTake(theirs)];
  const count = own && take && !own.samples && !take.samples ? Math.min(own.channels.length, take.channels.length) : 0;
  const at = times.filter((time) => time !== undefined);
  const channels = Uint32Array.from({ length: count * at.length }, (_, i) => Math.floor(i / at.length));
  const target = {
    channels,
    times: Float64Array.from(channels, (_, i) => at[i % at.length]),
    values: new Float64Array(0),
  };
  return { ...target, values: ownValues(theirs, target) };
}

function countChannels(right: Character, target: ChannelTarget, tolerance: number): ChannelCount | null {
  if (target.channels.length === 0) return null;
  const own = ownValues(right, target);
  const wrong = new Set<number>();
  target.channels.forEach((c, i) => {
    if (!(Math.abs(own[i] - target.values[i]) <= tolerance)) wrong.add(c);
  });
  const of = new Set(target.channels).size;
  return { right: of - wrong.size, of };
}

/** The right character without the parts that theirs lacks for their errors; undefined if that can't be compared. */
function withoutUnread(right: Character, { unread = [], skins, takes }: Character): Character | undefined {
  if (unread.length === 0) return right;
  if (unread.some(({ name }) => formatOf(name)?.kind === 'morph')) return undefined;
  return {
    ...right,
    ...(skins.length === 0 && { skins: [], shownSkin: 0 }),
    ...(takes.length === 0 && { takes: [], shownTake: -1 }),
  };
}

/** By their files, read or not; roots of one file in order. */
function byKey(characters: readonly Character[]): ReadonlyMap<string, Character> {
  const keyed = new Map<string, Character>();
  for (const character of characters) {
    const { sources, unread = [] } = character;
    const paths = [...sources, ...unread].map(({ path }) => path);
    const files = paths.sort().join('\n');
    for (let root = 0; ; root++) {
      const key = `${files}\n${root}`;
      if (keyed.has(key)) continue;
      keyed.set(key, character);
      break;
    }
  }
  return keyed;
}

function sumOf(counts: readonly ChannelCount[]): ChannelCount {
  return counts.reduce((sum, { right, of }) => ({ right: sum.right + right, of: sum.of + of }), { right: 0, of: 0 });
}

function largest(errors: readonly (number | null)[]): number | null {
  return errors.reduce((most, error) => (error === null ? most : Math.max(most ?? 0, error)), null);
}

/** Of a dump; larger files are dumps of that size, or something else. */
const MAX_LOOKED_AT = 64 << 20;
const NUMBER = /^[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?$/i;

/** Whether a text that can't be read as a dump was meant as one: at least as many numbers as a matrix, and as words. */
function isMostlyNumbers(bytes: Uint8Array): boolean {
  const words = new TextDecoder().decode(bytes).split(/[\s,;:=()[\]{}"]+/);
  const numbers = words.filter((word) => NUMBER.test(word)).length;
  return numbers >= MIN_NUMBERS && 2 * numbers >= words.length;
}

function slashed(path: string): string {
  return path.split(sep).join('/');
}
