/**
 * `.amc`, a motion of Acclaim, with the skeleton that says which values its bones have.
 *
 *     amc   = { ":FULLY-SPECIFIED" | ":DEGREES" | ":RADIANS" | ":SAMPLES-PER-SECOND" n } { frame }
 *     frame = NUMBER, on a line of its own, and lines BONE v …
 *
 * Bones come in any order, nearly always in that of the frame before: then the loop of all numbers (`scan.ts`) compares
 * their names as labels, and reads the numbers of the whole frame into place. All other lines are read word by word.
 * A bone that is missing keeps its values.
 */
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import { firstDofs, rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { LONGEST_FRAME, rangeOfSamples, type Samples, SHORTEST_FRAME } from '../../model/takes/samples.ts';
import { restChannel, SAMPLED, type Take } from '../../model/takes/take.ts';
import { NO_PLACE, WHOLE_FILE } from '../places.ts';
import { ParseError, type Report } from '../report.ts';
import { type Labels, labelsOf, type Scan, scanNumbers } from '../scan.ts';
import { shortName } from '../words.ts';
import { AcclaimLines } from './lines.ts';

/** Frames per second of a file that states none. */
export const SAMPLES_PER_SECOND = 120;
/** For messages. */
const MIN_RATE = (1 / LONGEST_FRAME).toPrecision(3);
const MAX_RATE = Math.round(1 / SHORTEST_FRAME);
/** As many as are told. */
const UNKNOWN_TOLD = 100;
/** Values that may be held without bytes for them: bones that are missing keep theirs. */
const UNWRITTEN_VALUES = 4_000_000;

/** Local names for the loops: some module loaders look up imported ones at every use. */
const LF = 10;
const CR = 13;
const scanned = scanNumbers;

/** A bone of the skeleton: where its values go. */
interface Target {
  readonly name: string;
  readonly bytes: Uint8Array;
  readonly column: number;
  readonly width: number;
  /** The frame in which it was last given, from 1. */
  seen: number;
  isMissed: boolean;
}

/** The take of an `.amc`; undefined, with errors in the report, if it is none. @param name of the take */
export function readAmc(bytes: Uint8Array, report: Report, name: string, skeleton: Skeleton): Take | undefined {
  const reading = new Reading(bytes, report, skeleton);
  reading.read();
  return report.hasErrors ? undefined : reading.take(name);
}

const UTF8 = new TextEncoder();

/** Lines of bones as labels of numbers. */
function linesOf(bytes: Uint8Array, bones: readonly Target[]): Labels {
  return labelsOf(
    bytes,
    bones.map(({ bytes: label, column: from, width }) => ({ label, from, to: from + width })),
  );
}

class Reading {
  private readonly lines: AcclaimLines;
  private readonly targets: readonly Target[];
  private readonly byName: ReadonlyMap<string, Target>;
  /** Those that have values. */
  private readonly moving: readonly Target[];
  private readonly width: number;
  private values = new Float64Array(0);
  /** Frames begun. */
  private frames = 0;
  /** The bones of the frame before, in their order, and as labels. */
  private before: readonly Target[] = [];
  private labels: Labels;
  /** This frame's are as many of those, and then others. */
  private same = 0;
  private others: Target[] = [];
  /** Those with values that the frame before lacks. */
  private missing: readonly Target[] = [];
  private readonly scan: Scan = { at: 0, count: 0, limit: 0, lineFeeds: 0 };
  private angle: 'deg' | 'rad';
  private perSecond: number | undefined;
  /** The number of the frame before. */
  private number = Number.NaN;
  private firstAt = 0;
  private toldNumbers = false;
  /** Names that no bone has, told once. */
  private readonly unknown = new Set<string>();

  constructor(
    private readonly bytes: Uint8Array,
    private readonly report: Report,
    private readonly skeleton: Skeleton,
  ) {
    this.lines = new AcclaimLines(bytes, report);
    this.labels = linesOf(bytes, []);
    this.angle = skeleton.acclaim?.angle ?? 'deg';
    const starts = firstDofs(skeleton);
    const first = rootDofCount(skeleton);
    this.targets = skeleton.joints.map(({ name, motion }, j) => ({
      name,
      bytes: UTF8.encode(name),
      column: starts[j] - first,
      width: dofsOf(motion).length,
      seen: 0,
      isMissed: false,
    }));
    this.byName = new Map(this.targets.map((target) => [target.name, target]));
    this.moving = this.targets.filter(({ width }) => width > 0);
    this.width = this.targets.reduce((sum, { width }) => sum + width, 0);
  }

  read(): void {
    const { lines, bytes } = this;
    // The number loop needs a separator at the end.
    let end = bytes.length;
    while (end > 0 && bytes[end - 1] !== LF) end--;
    while (lines.line(this.quickLines(lines.after, end))) this.slowLine();
    if (this.frames === 0) {
      this.report.error('frames-none', 'Expected frames, found none.', bytes.length > 0 ? NO_PLACE : WHOLE_FILE);
    } else this.endFrame();
  }

  /** Reads lines of frames that look like those of the frame before; returns where the first other one starts. */
  private quickLines(from: number, end: number): number {
    const { bytes } = this;
    let at = from;
    while (at < end && this.frames > 0) {
      at = this.quickBones(at, end);
      const c = bytes[at];
      if (!(c >= 48 && c <= 57)) return at;
      let i = at;
      let number = 0;
      while (bytes[i] >= 48 && bytes[i] <= 57 && number < 1e9) number = 10 * number + bytes[i++] - 48;
      while (bytes[i] === 32 || bytes[i] === 9 || bytes[i] === CR) i++;
      if (bytes[i] !== LF || i >= end) return at;
      this.beginFrame(number, at);
      at = i + 1;
    }
    return at;
  }

  /** Lines of bones in the order of the frame before; returns where the first other one starts. */
  private quickBones(from: number, end: number): number {
    const { bytes, scan, values, labels } = this;
    if (this.others.length > 0 || this.same === this.before.length) return from;
    scan.at = from;
    scan.count = scan.limit = 0;
    labels.base = (this.frames - 1) * this.width;
    labels.next = this.same;
    scanned(bytes, end, values, scan, undefined, labels);
    this.same = labels.next;
    return labels.at;
  }

  /** Any line. */
  private slowLine(): void {
    const { lines } = this;
    const { words } = lines;
    if (words.length === 0) return;
    if (lines.whole().startsWith(':')) {
      this.header();
      return;
    }
    const first = lines.text(0);
    const target = this.byName.get(first) ?? (first.toLowerCase() === 'root' ? this.targets[0] : undefined);
    if (!target && words.length === 1 && /^\d+$/.test(first)) this.beginFrame(Number(first), words[0].from);
    else if (!target) {
      if (this.unknown.has(first)) return;
      if (this.unknown.size < UNKNOWN_TOLD) this.unknown.add(first);
      const message = `Expected the number of a frame or a bone of ${this.skeletonName}, found "${shortName(first)}".`;
      lines.error('bone-unknown', message);
    } else if (this.frames === 0) {
      lines.error('frame-missing', `Expected the number of a frame before the values of "${shortName(first)}".`);
      throw new ParseError('frame-missing');
    } else this.boneLine(target);
  }

  private boneLine(target: Target): void {
    const { lines } = this;
    const found = lines.words.length - 1;
    if (found !== target.width) {
      const message = `Expected ${target.width} values of the bone "${shortName(target.name)}", as ${this.skeletonName} lists, found ${found}.`;
      lines.error('values-count', message, Math.min(found, target.width + 1));
      return;
    }
    const base = (this.frames - 1) * this.width + target.column;
    for (let i = 0; i < target.width; i++)
      this.values[base + i] = lines.number(i + 1, `a value of "${target.name}"`) ?? 0;
    if (this.others.length === 0 && this.before[this.same] === target) this.same++;
    else this.others.push(target);
  }

  private header(): void {
    const { lines } = this;
    switch (lines.keyword(0)) {
      case ':degrees':
        this.angle = 'deg';
        break;
      case ':radians':
        this.angle = 'rad';
        break;
      case ':samples-per-second': {
        const rate = lines.number(1, 'the samples per second');
        if (rate === undefined) break;
        if (1 / rate >= SHORTEST_FRAME && 1 / rate <= LONGEST_FRAME) this.perSecond = rate;
        else {
          const message = `Expected from ${MIN_RATE} to ${MAX_RATE} samples per second, found ${shortName(lines.text(1))}.`;
          lines.warn('rate-wrong', message, 'ignored it', 1);
        }
        break;
      }
      case ':fully-specified':
        break;
      default:
        lines.warnUnknown('an .amc file', ':FULLY-SPECIFIED, :DEGREES, :RADIANS or :SAMPLES-PER-SECOND');
    }
  }

  private beginFrame(number: number, at: number): void {
    if (this.frames > 0) {
      this.endFrame();
      if (number !== this.number + 1 && !this.toldNumbers) {
        this.toldNumbers = true;
        const message = `Expected frame ${this.number + 1}, found ${number}.`;
        this.report.warn('frame-number', message, this.lines.placeAt(at), 'frames count as they come');
      }
    } else this.firstAt = at;
    this.number = number;
    this.frames++;
    if (this.frames * this.width > this.values.length) this.grow(at);
  }

  /** Room for the rest of the file, as long as the frames so far. */
  private grow(at: number): void {
    const { width, bytes, frames } = this;
    const needed = frames * width;
    const perFrame = frames > 1 ? (at - this.firstAt) / (frames - 1) : bytes.length;
    const expected = (frames + (bytes.length - at) / Math.max(1, perFrame)) * width;
    const most = UNWRITTEN_VALUES + bytes.length;
    if (needed > most) {
      const message = `Expected values in the frames, found ${frames} frames with hardly any: they would take too much memory.`;
      this.report.error('frames-bare', message, this.lines.placeAt(at));
      throw new ParseError('frames-bare');
    }
    const grown = new Float64Array(Math.ceil(Math.max(needed, Math.min(most, 1.02 * expected + width))));
    grown.set(this.values);
    this.values = grown;
  }

  private endFrame(): void {
    const { before, same, others, frames } = this;
    this.same = 0;
    // Nearly all frames have the bones of the first.
    if (frames === 1 || others.length > 0 || same !== before.length)
      this.changeBones([...before.slice(0, same), ...others]);
    if (frames === 1) return;
    const { values, width } = this;
    for (const { column, width: count } of this.missing) {
      const to = (frames - 1) * width + column;
      values.copyWithin(to, to - width, to - width + count);
    }
  }

  /** This frame has other bones than the one before, or is the first. */
  private changeBones(bones: readonly Target[]): void {
    const { frames } = this;
    this.others = [];
    this.before = bones;
    this.labels = linesOf(this.bytes, bones);
    for (const bone of bones) bone.seen = frames;
    this.missing = this.moving.filter(({ seen }) => seen !== frames);
    if (this.report.hasErrors) return;
    for (const target of this.missing) {
      if (target.isMissed) continue;
      target.isMissed = true;
      const assumed = frames === 1 ? 'used 0' : 'used the values of the frame before';
      const message = `The bone "${shortName(target.name)}" is missing in frame ${frames}.`;
      this.report.warn('bone-missing', message, NO_PLACE, assumed);
    }
  }

  private get skeletonName(): string {
    return `${this.skeleton.name}.asf`;
  }

  take(name: string): Take {
    const { frames, width, skeleton } = this;
    if (this.perSecond === undefined) {
      const message = `The file states no frame rate.`;
      this.report.info('rate-assumed', message, NO_PLACE, `used ${SAMPLES_PER_SECOND} frames per second`);
    }
    const unit = this.angle === 'deg' ? RADIANS_PER_DEGREE : 1;
    const firstChannel = rootDofCount(skeleton);
    const length = frames * width;
    const samples: Samples = {
      frameCount: frames,
      frameSeconds: 1 / (this.perSecond ?? SAMPLES_PER_SECOND),
      startSeconds: 0,
      firstChannel,
      values: this.values.length - length > length / 8 ? this.values.slice(0, length) : this.values.subarray(0, length),
      scales: Float64Array.from(
        skeleton.joints.flatMap(({ motion }) => dofsOf(motion).map((dof) => (dof.unit === 'angle' ? unit : 1))),
      ),
      interpolation: 'linear',
    };
    const channels = Array.from({ length: firstChannel + width }, (_, c) =>
      c < firstChannel ? restChannel() : SAMPLED,
    );
    return { name, range: rangeOfSamples(samples), channels, samples };
  }
}
