/**
 * Finds out what the numbers of a dump are, for a character: how many there are, how wide their rows are, their labels
 * and what headings say. Numbers that fit nothing get a diagnostic with what was found and what would do.
 *
 *     matrices    16 or 12 numbers per joint, rows or columns first; with an index before them
 *     points      3 per vertex or joint; with an index before them; 6: positions and normals
 *     channels    rows `time value …`; pairs of a channel; lists with their times
 */
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, isMoved, shownSkin, shownTake } from '../../model/document.ts';
import type { Dump, DumpBlock, DumpHeading, DumpKind, DumpLabel } from '../../model/dump.ts';
import { vertexCount } from '../../model/skin.ts';
import type { FrameKind, FrameTarget, MatrixLayout, Origins, SolverTask, Targets } from '../compare/targets.ts';
import { goalsOf, type StatedGoal } from '../ik/stated-goals.ts';
import { Evaluator, type FrameTime } from '../program/evaluator.ts';
import { RIGHT_PROGRAM } from '../program/program.ts';
import { isOfOneTime, readSamples } from './channel-blocks.ts';
import { type Entry, entriesOf, evenly, isCount, isInRows, isUnit, Misfit, oddRow, widthOf } from './entries.ts';
import { counted, foundText } from './found.ts';
import { joinedBlocks } from './joined-blocks.ts';
import { JointNames, withKnownLabels, withTimes } from './labels.ts';
import { matricesOf } from './matrix-layout.ts';
import { placesOf } from './places.ts';

/** The meaning of dumps' numbers for a character. */
export interface Fitted {
  /** Absent if a dump doesn't fit. */
  readonly targets?: Targets;
  readonly diagnostics: readonly Diagnostic[];
}

/** A dump with the file that it came from. */
export interface NamedDump {
  /** For diagnostics. */
  readonly fileName: string;
  readonly dump: Dump;
  /** Time of its numbers that state no time; absent: the time for all dumps. */
  readonly assumed?: { readonly time: FrameTime };
}

/**
 * Finds out what the numbers of dumps are for a character.
 * @param time of dumps that state none; undefined: the only time that others state, else the file pose
 */
export function fitDumps(character: Character, dumps: readonly NamedDump[], time: FrameTime): Fitted {
  const fit = new Fit(character, time ?? onlyTime(dumps));
  for (const dump of dumps) fit.add(dump);
  return fit.result();
}

/** The only time that dumps state; undefined if none or several are. */
export function onlyTime(dumps: readonly NamedDump[]): FrameTime {
  const stated = new Set(dumps.flatMap(({ dump }) => [dump.time, ...dump.blocks.map((block) => block.time)]));
  stated.delete(undefined);
  return stated.size === 1 ? [...stated][0] : undefined;
}

/** Misfits of one kind that are told of a dump: the blocks of a hundred frames are all alike. */
const MAX_ALIKE = 3;

class Fit {
  private readonly diagnostics: Diagnostic[] = [];
  private readonly frames: FrameTarget[] = [];
  private readonly samples: { channel: number; time: number; value: number; dump: number }[] = [];
  /** Which dump each kind of each frame is of. */
  private readonly sources: Partial<Record<FrameKind, number>>[] = [];
  private readonly fileNames: string[] = [];
  private layout: MatrixLayout | undefined;
  /** Headings of the dump. */
  private headings: readonly DumpHeading[] = [];
  /** Goals of the dump; those of joints that are known. */
  private goals: readonly StatedGoal[] = [];
  private isOneStep = false;
  private readonly names: readonly string[];
  private readonly joints: JointNames;
  private readonly vertices: number;
  private readonly channels: number;
  private readonly evaluator: Evaluator;

  constructor(
    private readonly character: Character,
    private readonly time: FrameTime,
  ) {
    this.names = character.skeleton?.joints.map(({ name }) => name) ?? [];
    this.joints = new JointNames(this.names);
    const skin = shownSkin(character);
    this.vertices = skin ? vertexCount(skin) : 0;
    this.channels = shownTake(character)?.channels.length ?? 0;
    this.evaluator = new Evaluator(character);
  }

  add({ dump, fileName, assumed }: NamedDump): void {
    const time = assumed ? assumed.time : this.time;
    this.fileNames.push(fileName);
    this.isOneStep = dump.isOneStep ?? false;
    this.goals = [];
    this.attempt(() => {
      this.goals = goalsOf(dump.targets ?? [], this.character.skeleton);
    });
    for (const block of joinedBlocks(dump.blocks, this.names.length)) {
      this.attempt(() => this.block(block, dump, block.time ?? dump.time ?? time));
    }
    if (dump.blocks.length === 0) {
      const message = `Expected ${this.wouldDo()}; found no numbers of that kind.`;
      this.diagnostics.push(withoutPlace('error', 'dump-unknown', message, fileName));
    }
  }

  /** Tells what doesn't fit. */
  private attempt(work: () => void): void {
    const fileName = this.fileNames[this.fileNames.length - 1];
    try {
      work();
    } catch (error) {
      if (!(error instanceof Misfit)) throw error;
      const { code } = error;
      if (this.diagnostics.filter((one) => one.code === code && one.file === fileName).length === MAX_ALIKE) return;
      this.diagnostics.push({
        ...withoutPlace('error', error.code, error.message, fileName),
        line: error.line,
        column: error.line > 0 ? 1 : 0,
      });
    }
  }

  result(): Fitted {
    const { diagnostics, frames, layout, fileNames } = this;
    const samples = this.samples.sort((a, b) => a.channel - b.channel || a.time - b.time);
    if (diagnostics.some(({ severity }) => severity === 'error')) return { diagnostics };
    const channels = {
      channels: Uint32Array.from(samples, ({ channel }) => channel),
      times: Float64Array.from(samples, ({ time }) => time),
      values: Float64Array.from(samples, ({ value }) => value),
    };
    const dumps = Uint32Array.from(samples, ({ dump }) => dump);
    const origins: Origins = { fileNames, frames: this.sources, samples: dumps };
    return { targets: { frames, channels, ...(layout && { layout }), origins }, diagnostics };
  }

  private block(given: DumpBlock, dump: Dump, time: FrameTime): void {
    const holds = given.holds ?? kindOfName(dump.name);
    const width = widthOf(given);
    const isOther = holds !== 'channels' && this.names.length > 0 && [3, 12, 16].includes(width);
    const block = withKnownLabels(withTimes(given, this.channels, isOther), this.joints);
    this.headings = dump.headings ?? [];
    this.tellLeftOut(given, block);
    const isTimed = block.columns?.some((name) => /^(time|t|seconds)$/.test(name)) ?? false;
    if (block.channel !== undefined || holds === 'channels' || isTimed) {
      this.samplesOf(block, time);
      return;
    }
    const entries = entriesOf(block);
    const kind = this.kindOf(block, entries, holds, time);
    if (kind === 'channels') this.samplesOf(block, time);
    else if (kind === 'matrices') this.matrices(block, entries, holds === 'local' ? 'local' : 'world', time);
    else if (kind === 'joints') this.points('positions', entries, this.names.length, time, block);
    else if (kind === 'both') this.pairs(entries, time, block);
    else this.points(kind, entries, this.vertices, time, block);
  }

  /** Rows whose names are no joint's, beside those of all joints. */
  private tellLeftOut(given: DumpBlock, { lines }: DumpBlock): void {
    const count = given.lines.length - lines.length;
    if (count === 0) return;
    const kept = new Set(lines);
    const line = given.lines.find((each) => !kept.has(each)) ?? 0;
    const message = `Expected numbers of the ${counted(this.names.length, 'joint')} only, found ${counted(count, 'row')} with other names.`;
    const fileName = this.fileNames[this.fileNames.length - 1];
    this.diagnostics.push({ ...withoutPlace('info', 'dump-others', message, fileName, 'left out'), line, column: 1 });
  }

  // ——— what it is ———

  private kindOf(
    block: DumpBlock,
    entries: readonly Entry[],
    holds: DumpKind | undefined,
    time: FrameTime,
  ): 'matrices' | 'joints' | 'vertices' | 'normals' | 'both' | 'channels' {
    const { names, vertices, channels } = this;
    const joints = names.length;
    const count = block.values.length;
    const width = widthOf(block);
    const ofMatrices = joints > 0 && [12, 13, 16, 17].some((each) => count === each * joints);
    const isIndexed = width === 4 && isCount(entries.map(({ numbers }) => numbers[0]));
    const ofPoints = (each: number) => each > 0 && (count === 3 * each || (count === 4 * each && isIndexed));
    if (holds === 'world' || holds === 'local') {
      if (ofMatrices) return 'matrices';
      if (holds === 'world' && ofPoints(joints)) return 'joints';
      if (holds === 'world' && ofPoints(vertices)) return 'vertices';
      throw this.misfit(block);
    }
    const hasBoth = block.columns?.some((name) => /^n[xyz]$|^n[._][xyz]$/.test(name)) && block.columns.length === 6;
    if (vertices > 0 && count === 6 * vertices && (width === 6 || hasBoth)) return 'both';
    if (holds === 'normals' || holds === 'vertices') {
      if (ofPoints(vertices)) return holds;
      // Positions of as many points as there are joints are those of joints.
      if (holds === 'vertices' && ofPoints(joints)) return 'joints';
      throw this.misfit(block);
    }
    const isNormals = block.columns?.[0] !== undefined && /^n[._]?x$/.test(block.columns[0]);
    if (ofPoints(vertices) && isNormals) return 'normals';
    if (holds === 'positions') {
      if (ofPoints(joints)) return 'joints';
      if (ofPoints(vertices)) return 'vertices';
      throw this.misfit(block);
    }
    const wide = entries.every(({ numbers, label }) => label !== null && numbers.length >= 12) || width >= 12;
    const narrow = width === 3 || isIndexed;
    if (ofMatrices && (wide || !narrow)) return 'matrices';
    if (ofPoints(vertices) && (ofPoints(joints) ? this.isNearer(entries, time) : true)) {
      return isUnit(block.values, width) && !this.isSkinUnit() ? 'normals' : 'vertices';
    }
    if (ofPoints(joints)) return 'joints';
    if (ofMatrices) return 'matrices';
    // Several rows below a label are a matrix.
    const isByTime = entries.every(({ label, numbers }) => label === null || numbers.length <= width);
    if (channels > 0 && isInRows(block, channels + 1) && isByTime) return 'channels';
    if (isOfOneTime(block, channels)) return 'channels';
    if (channels > 0 && joints === 0 && vertices === 0) return 'channels';
    throw this.misfit(block);
  }

  /** As many vertices as joints: whether the points are nearer to the vertices. */
  private isNearer(entries: readonly Entry[], time: FrameTime): boolean {
    const { world, vertices } = this.evaluator.frame(RIGHT_PROGRAM, time, {
      local: false,
      vertices: true,
      normals: false,
    });
    let toJoints = 0;
    let toVertices = 0;
    entries.forEach(({ numbers }, i) => {
      for (let k = 0; k < 3; k++) {
        const value = numbers[numbers.length - 3 + k];
        toJoints += Math.abs(value - (world[16 * i + 12 + k] ?? 0));
        toVertices += Math.abs(value - (vertices[3 * i + k] ?? 0));
      }
    });
    return toVertices <= toJoints;
  }

  private isSkinUnit(): boolean {
    const skin = shownSkin(this.character);
    return skin !== undefined && isUnit(skin.positions, 3);
  }

  private wouldDo(): string {
    const { names, vertices, channels } = this;
    const joints = names.length;
    const parts = [
      ...(joints > 0 ? [`12 or 16 numbers for each of ${joints} joints (${12 * joints} or ${16 * joints})`] : []),
      ...(joints > 0 ? [`3 for each joint (${3 * joints})`] : []),
      ...(vertices > 0 ? [`3 for each of ${vertices} vertices (${3 * vertices})`] : []),
      ...(channels > 0 ? [`rows of a time and ${channels} ${channels === 1 ? 'value' : 'values'}`] : []),
    ];
    return parts.length > 0 ? parts.join(', or ') : 'a character to compare with';
  }

  private misfit(block: DumpBlock): Misfit {
    const { lines, holds } = block;
    const found = `found ${foundText(block, this.headings)}`;
    if ((holds === 'vertices' || holds === 'normals') && this.vertices === 0) {
      return new Misfit(
        'dump-length',
        `Expected a skin among the files, since these are ${holds}; ${found}.`,
        lines[0] ?? 0,
      );
    }
    const odd = oddRow(block);
    const odds = odd ? `; this one has ${odd.found} where others have ${odd.others}` : '';
    const kind = holds ? `, which is headed ${holds}` : '';
    return new Misfit('dump-length', `Expected ${this.wouldDo()}; ${found}${odds}${kind}.`, odd?.line ?? lines[0] ?? 0);
  }

  // ——— putting it in place ———

  /** Numbers of a solver are by themselves: those of others at the same time are the character's. */
  private frameAt(time: FrameTime): FrameTarget {
    const own = this.goals.filter((goal) => goal.time === undefined || goal.time === time);
    const dump = this.fileNames.length - 1;
    const isSame = (f: number) =>
      this.isSameTime(this.frames[f].time, time) &&
      (this.frames[f].solver ? Object.values(this.sources[f]).includes(dump) : own.length === 0);
    const known = [...this.frames.keys()].find(isSame);
    if (known !== undefined) return this.frames[known];
    const solver: SolverTask = { goals: own.map(({ goal }) => goal), isOneStep: this.isOneStep };
    const frame: FrameTarget = { time, ...(own.length > 0 && { solver }) };
    this.frames.push(frame);
    this.sources.push({});
    return frame;
  }

  /** What nothing moves is in its file pose at 0 s: programs print `time 0` there. */
  private isSameTime(a: FrameTime, b: FrameTime): boolean {
    return a === b || (!isMoved(this.character) && (a ?? 0) === (b ?? 0));
  }

  private put(kind: FrameKind, values: Float64Array, time: FrameTime, line: number): void {
    const frame = this.frameAt(time);
    if (frame[kind]) {
      const at = time === undefined ? 'without a time' : `at ${time} s`;
      throw new Misfit(
        'dump-repeated',
        `Expected one list of ${kind} ${at}, found a second one. Put "time T" before each.`,
        line,
      );
    }
    const { solver } = frame;
    if (solver && (kind === 'vertices' || kind === 'normals'))
      throw new Misfit(
        'target-kind',
        `Expected numbers of joints, since a target is stated; found ${kind}. Compare them without it.`,
        line,
      );
    if (solver?.isOneStep && solver.goals.length > 1)
      throw new Misfit(
        'target-steps',
        `Expected one target, since one step is judged for one alone; found ${solver.goals.length}.`,
        line,
      );
    frame[kind] = values;
    this.sources[this.frames.indexOf(frame)][kind] = this.fileNames.length - 1;
  }

  private matrices(block: DumpBlock, entries: readonly Entry[], kind: 'world' | 'local', time: FrameTime): void {
    const joints = this.names.length;
    const each = block.values.length / joints;
    const placed = this.placed(evenly(block, entries, each), joints, each % 4 === 1, block);
    const our = this.evaluator.frame(RIGHT_PROGRAM, time, { local: kind === 'local', vertices: false, normals: false });
    const { layout, matrices } = matricesOf(placed, joints, block.nesting, kind === 'local' ? our.local : our.world);
    this.layout ??= layout;
    this.put(kind, matrices, time, block.lines[0] ?? 0);
  }

  private points(kind: FrameKind, entries: readonly Entry[], count: number, time: FrameTime, block: DumpBlock): void {
    const each = block.values.length / count;
    this.put(kind, this.placed(evenly(block, entries, each), count, each === 4, block), time, block.lines[0] ?? 0);
  }

  private pairs(entries: readonly Entry[], time: FrameTime, block: DumpBlock): void {
    const both = this.placed(evenly(block, entries, 6), this.vertices, false, block);
    const half = (from: number) =>
      Float64Array.from({ length: both.length / 2 }, (_, i) => both[6 * Math.floor(i / 3) + from + (i % 3)]);
    const first = block.columns?.[0]?.startsWith('n') ? 3 : 0;
    this.put('vertices', half(first), time, block.lines[0] ?? 0);
    this.put('normals', half(3 - first), time, block.lines[0] ?? 0);
  }

  /** The numbers of all entries in the order of joints or vertices. */
  private placed(entries: readonly Entry[], count: number, isIndexed: boolean, block: DumpBlock): Float64Array {
    const width = (entries[0]?.numbers.length ?? 0) - (isIndexed ? 1 : 0);
    const out = new Float64Array(width * count);
    const labels = entries.map(({ label, numbers }): DumpLabel | null => (isIndexed ? { index: numbers[0] } : label));
    const places = placesOf(labels, count, entries, block, this.joints);
    entries.forEach(({ numbers }, e) => {
      out.set(isIndexed ? numbers.subarray(1) : numbers, width * places[e]);
    });
    return out;
  }

  private samplesOf(block: DumpBlock, time: FrameTime): void {
    const dump = this.fileNames.length - 1;
    readSamples(block, time, this.channels, (channel, t, value) =>
      this.samples.push({ channel, time: t, value, dump }),
    );
  }
}

function kindOfName(name: string): DumpKind | undefined {
  if (/local/i.test(name)) return 'local';
  if (/normal/i.test(name)) return 'normals';
  return undefined;
}
