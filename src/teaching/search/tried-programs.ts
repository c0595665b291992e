/**
 * Tries programs against another program's numbers: whether all are explained, or at least all that the mistake
 * touches. One trial has all numbers; a small one has those of few vertices and samples, and only tells what is not
 * worth trying with all.
 */
import { type Character, shownTake } from '../../model/document.ts';
import { larger, matrixError, pointError } from '../compare/errors.ts';
import type { ChannelTarget, FrameTarget } from '../compare/targets.ts';
import { channelValue, RIGHT_CURVES } from '../program/curve-rules.ts';
import { Evaluator, type FrameNumbers } from '../program/evaluator.ts';
import { nearestSide } from '../program/jumps.ts';
import { valuesNearest } from '../program/own-values.ts';
import { type Program, RIGHT_PROGRAM } from '../program/program.ts';
import { type Cell, frameNearest } from './cells.ts';

/** The effect of a program on our numbers of a cell, and how near they come to theirs. */
export interface CellOutcome {
  /** Whether any number is changed by more than the tolerance. */
  readonly touches: boolean;
  /** Whether all numbers are theirs, within the tolerance; and all those that are changed. */
  readonly agrees: boolean;
  readonly isPartial: boolean;
  /** How many numbers the program changes. */
  readonly evidence: number;
  /** The largest error of what is explained. */
  readonly residual: number;
  /** Joints, vertices or channels that agree, and how many there are. */
  readonly agree: number;
  readonly of: number;
}

/** Our own numbers of a frame. */
interface Own extends FrameNumbers {
  /** Lengths are divided by it. */
  readonly size: number;
}

/** The numbers that programs are tried against, cell by cell. */
export class Trial {
  private readonly evaluator: Evaluator;
  private readonly own: readonly Own[];
  /** Our values of the channels of each cell. */
  private readonly ownChannels: readonly Float64Array[];
  /** For each wrong cell it, and the right ones of its dump. */
  private readonly beside: readonly (readonly number[])[];
  /** Targets of the pieces, per frame. */
  private readonly targets: readonly (readonly FrameTarget[])[];
  /** Per frame. */
  private readonly pieces: readonly (readonly { readonly cell: number; readonly target: FrameTarget }[])[];

  /** @param sizes of the whole character, per frame */
  constructor(
    private readonly character: Character,
    private readonly frames: readonly FrameTarget[],
    private readonly cells: readonly Cell[],
    private readonly sizes: readonly number[],
    private readonly tolerance: number,
  ) {
    this.evaluator = new Evaluator(character);
    this.pieces = frames.map((_, f) =>
      cells.flatMap(({ pieces }, cell) =>
        pieces.flatMap(({ frame, target }) => (frame === f ? [{ cell, target }] : [])),
      ),
    );
    this.targets = this.pieces.map((pieces) => pieces.map(({ target }) => target));
    this.own = frames.map((_, f): Own => {
      const numbers = this.frame(RIGHT_PROGRAM, f);
      return {
        size: sizes[f],
        world: numbers.world.slice(),
        local: numbers.local.slice(),
        vertices: numbers.vertices.slice(),
        normals: numbers.normals.slice(),
      };
    });
    this.ownChannels = cells.map(({ channels }) => valuesNearest(character, channels, tolerance));
    this.beside = cells.flatMap(({ isWrong, dump }, c) => {
      const right = cells.flatMap((cell, r) => (cell.dump === dump && !cell.isWrong ? [r] : []));
      return isWrong ? [[c, ...right]] : [];
    });
  }

  /**
   * Per cell. Stops early if no wrong cell can be explained; then `agrees` and `isPartial`, or one of them, are false
   * for it, or for a right one of its dump, which a cause must leave right.
   *
   * @param forPart whether cells may be explained in part
   */
  run(program: Program, forPart: boolean): readonly CellOutcome[] {
    const states = this.cells.map(() => new State(this.tolerance, forPart));
    const isHopeless = () => this.beside.every((cells) => cells.some((c) => states[c].isHopeless));
    this.cells.forEach(({ channels }, c) => {
      if (channels.channels.length === 0) return;
      if (program.curves !== RIGHT_CURVES) this.tryChannels(program, channels, this.ownChannels[c], states[c]);
      else countChannels(channels, this.ownChannels[c], states[c]);
    });
    for (let f = 0; f < this.frames.length && !isHopeless(); f++) {
      const numbers = this.frame(program, f);
      for (const { cell, target } of this.pieces[f]) {
        if (!states[cell].isHopeless) this.tryFrame(numbers, this.own[f], target, states[cell]);
      }
    }
    return states.map((state) => state.outcome());
  }

  /** Equal for programs that do the same here. */
  fingerprint(program: Program): string {
    let sum = 0;
    const add = (values: Float64Array) => {
      for (let i = 0; i < values.length; i++) sum += Math.cos(i) * values[i];
    };
    this.frames.forEach((_, f) => {
      const { world, local, vertices, normals } = this.frame(program, f);
      for (const values of [world, local, vertices, normals]) add(values);
    });
    const take = shownTake(this.character);
    for (const { channels: of } of this.cells) {
      of.channels.forEach((c, i) => {
        const channel = take?.channels[c];
        if (take && channel?.kind === 'keys')
          sum += Math.sin(i) * channelValue(channel, take.range, of.times[i], program.curves);
      });
    }
    return sum.toPrecision(12);
  }

  private frame(program: Program, f: number): FrameNumbers {
    return frameNearest(this.evaluator, program, this.frames[f].time, this.targets[f], this.sizes[f]);
  }

  private tryFrame(now: FrameNumbers, own: Own, target: FrameTarget, state: State): void {
    const { world, local, positions, vertices, normals } = target;
    const { size } = own;
    if (world || local || positions) {
      for (let j = 0; j < this.evaluator.jointCount && !state.isHopeless; j++) {
        const o = 16 * j;
        let change = 0;
        let error = 0;
        if (world) {
          change = matrixError(now.world, own.world, o, size);
          error = matrixError(now.world, world, o, size);
        }
        if (local) {
          change = Math.max(change, matrixError(now.local, own.local, o, size));
          error = Math.max(error, matrixError(now.local, local, o, size));
        }
        if (positions) {
          change = Math.max(change, pointError(now.world, o + 12, own.world, o + 12, size));
          error = Math.max(error, pointError(now.world, o + 12, positions, 3 * j, size));
        }
        state.add(change, error, world || local ? MATRIX : POINT);
      }
    }
    const count = (vertices ?? normals)?.length ?? 0;
    for (let o = 0; o < count && !state.isHopeless; o += 3) {
      let change = 0;
      let error = 0;
      if (vertices) {
        change = pointError(now.vertices, o, own.vertices, o, size);
        error = pointError(now.vertices, o, vertices, o, size);
      }
      if (normals) {
        change = Math.max(change, pointError(now.normals, o, own.normals, o, 1));
        error = Math.max(error, pointError(now.normals, o, normals, o, 1));
      }
      state.add(change, error, POINT);
    }
  }

  private tryChannels(program: Program, target: ChannelTarget, ownValues: Float64Array, state: State): void {
    const take = shownTake(this.character);
    const { channels, times, values } = target;
    if (!take) return;
    for (let from = 0; from < channels.length && !state.isHopeless; ) {
      const c = channels[from];
      const channel = take.channels[c];
      let change = 0;
      let error = 0;
      let changed = 0;
      let i = from;
      for (; i < channels.length && channels[i] === c; i++) {
        const now =
          channel.kind === 'keys'
            ? nearestSide(times[i], values[i], this.tolerance, (time) =>
                channelValue(channel, take.range, time, program.curves),
              )
            : ownValues[i];
        const own = larger(0, now - ownValues[i]);
        if (own > this.tolerance) changed++;
        change = Math.max(change, own);
        error = larger(error, now - values[i]);
      }
      state.add(change, error, changed);
      from = i;
    }
  }
}

/** Rules of joints and skins leave channels as they are. */
function countChannels({ channels, values }: ChannelTarget, ownValues: Float64Array, state: State): void {
  for (let from = 0; from < channels.length && !state.isHopeless; ) {
    let error = 0;
    let i = from;
    for (; i < channels.length && channels[i] === channels[from]; i++) error = larger(error, ownValues[i] - values[i]);
    state.add(0, error, 0);
    from = i;
  }
}

/** Numbers of an item that can tell a mistake: of a matrix, of a point. */
const MATRIX = 12;
const POINT = 3;

/** The knowledge about a cell. */
class State {
  isHopeless = false;
  private touches = false;
  private agrees = true;
  private isPartial = true;
  private residual = 0;
  private evidence = 0;
  private agree = 0;
  private of = 0;

  constructor(
    private readonly tolerance: number,
    private readonly forPart: boolean,
  ) {}

  /** An item of some numbers that the program changes by `change`, and that is `error` from theirs then. */
  add(change: number, error: number, numbers: number): void {
    const { tolerance } = this;
    const isTouched = !(change <= tolerance);
    const agrees = error <= tolerance;
    this.of++;
    if (agrees) this.agree++;
    if (agrees && error > this.residual) this.residual = error;
    this.touches ||= isTouched;
    if (isTouched) this.evidence += numbers;
    this.agrees &&= agrees;
    this.isPartial &&= agrees || !isTouched;
    this.isHopeless = !this.agrees && !(this.forPart && this.isPartial);
  }

  outcome(): CellOutcome {
    const { touches, agrees, isPartial, residual, evidence, agree, of } = this;
    return { touches, agrees, isPartial, residual, evidence, agree, of };
  }
}
