/**
 * The motion path of one joint over the playback range, with marks at frames and keys (`path-marks.ts`): sampled when
 * the joint, the character or the range changes, not while playing.
 */
import {
  BufferGeometry,
  DynamicDrawUsage,
  GreaterDepth,
  InstancedBufferAttribute,
  InstancedMesh,
  type ShaderMaterial,
  Sphere,
} from 'three';
import { type PathTimes, timesOnPath } from '../../evaluate/ik/path-dofs.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { NO_TRAVEL, placementMatrix } from '../../evaluate/space/placements.ts';
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import { carrierOf, groundTravel } from '../../evaluate/travel.ts';
import { isVisible } from '../../evaluate/visible-points.ts';
import { timeBetween } from '../../math/time-between.ts';
import type { Character } from '../../model/document.ts';
import { shownTake } from '../../model/document.ts';
import { arePoints } from '../../model/skeleton/joint-types.ts';
import { lineMaterial, rawColor, segmentsGeometry } from '../scene/thick-lines.ts';
import { runInSlices } from '../slices.ts';
import type { StageTheme } from '../theme.ts';
import { type PathHandles, PathMarks } from './path-marks.ts';

/** Samples per second of the range, and at most. */
const SAMPLES_PER_SECOND = 60;
const MAX_SAMPLES = 1500;
/** Of dots and of diamonds: more would be a band. */
const MAX_MARKS = 4000;
/** Joints that are posed in one go, over all samples: some 20 ms. More are posed between frames. */
const AT_ONCE = 200_000;
/** Joints that are posed between two looks at the clock. */
const PER_STEP = 20_000;

/**
 * Positions of a joint at `count` times from `start` to `end` (seconds of the transport), x y z each, in the
 * character's space; NaN where a point is missing. `inPlace` subtracts the root's horizontal motion, as when drawing.
 */
export function samplePath(
  character: Character,
  joint: number,
  [start, end]: readonly [number, number],
  count: number,
  inPlace: boolean,
): Steps<Float64Array> {
  const timeOf = (i: number) => timeBetween(start, end, i / Math.max(1, count - 1));
  return placesAt(character, joint, timeOf, count, inPlace);
}

/** The same at any times. */
function* placesAt(
  character: Character,
  joint: number,
  timeOf: (i: number) => number,
  count: number,
  inPlace: boolean,
): Steps<Float64Array> {
  const path = new Float64Array(3 * count);
  if (!character.skeleton) return path;
  const skeleton = compileSkeleton(character.skeleton);
  const dofs = new Float64Array(dofCountOf(character));
  const world = new Float64Array(16 * skeleton.jointCount);
  const travel = new Float64Array(3);
  const carrier = carrierOf(character);
  const hasPoints = arePoints(character.skeleton);
  let left = PER_STEP;
  for (let i = 0; i < count; i++) {
    left -= skeleton.jointCount;
    if (left <= 0) {
      yield i / count;
      left = PER_STEP;
    }
    poseAt(character, timeOf(i), dofs);
    worldMatrices(skeleton, dofs, world);
    if (inPlace) groundTravel(skeleton, character.space, carrier, dofs, world, travel);
    const isThere = !hasPoints || isVisible(skeleton, joint, dofs);
    for (let k = 0; k < 3; k++) path[3 * i + k] = isThere ? world[16 * joint + 12 + k] - travel[k] : Number.NaN;
  }
  return path;
}

/** A path, and marks on it. */
interface Sampled {
  readonly path: Float64Array;
  readonly frames: Float64Array;
  readonly keys: Float64Array;
}

function* sampled(
  character: Character,
  joint: number,
  range: readonly [number, number],
  inPlace: boolean,
  { frames, keys }: PathTimes,
): Steps<Sampled> {
  const count = sampleCount(range);
  return {
    path: yield* samplePath(character, joint, range, count, inPlace),
    frames: yield* placesAt(character, joint, (i) => frames[i], frames.length, inPlace),
    keys: yield* placesAt(character, joint, (i) => keys[i], keys.length, inPlace),
  };
}

function sampleCount([start, end]: readonly [number, number]): number {
  return Math.min(MAX_SAMPLES, 2 + Math.ceil((end - start) * SAMPLES_PER_SECOND));
}

type Lines = InstancedMesh<BufferGeometry, ShaderMaterial>;

const WIDTH = 1.75;
const OPACITY = 0.85;
/** Of the parts behind a skin, which show through it. */
const COVERED_OPACITY = 0.45;
/** Covered parts are drawn after everything that may cover them. */
const ORDER = 5;
const COVERED_ORDER = 15;

export class Trail {
  readonly object: Lines;
  /** The parts that something opaque covers; below `object`. */
  readonly covered: Lines;
  private readonly marks = new PathMarks();
  private shown: { character: Character; joint: number; start: number; end: number; inPlace: boolean } | undefined;
  /** Ends the sampling of a path that isn't wanted any more. */
  private sampling = new AbortController();

  /** @param redraw called when a path that takes longer is there */
  constructor(private readonly redraw: () => void = () => undefined) {
    const lift = 1e-5;
    const behind = { depthFunc: GreaterDepth, depthWrite: false } as const;
    this.object = this.lines(lineMaterial({ width: WIDTH, opacity: OPACITY, lift }), ORDER);
    const dim = lineMaterial({ width: WIDTH, opacity: COVERED_OPACITY, lift, butt: true }, behind);
    this.covered = this.lines(dim, COVERED_ORDER);
    this.object.visible = false;
    this.object.add(this.covered, this.marks.object);
  }

  /** What of it can be dragged, as drawn; undefined while no path is. */
  get held(): PathHandles | undefined {
    return this.object.visible ? this.marks.handles : undefined;
  }

  /** Lights up one of the handles, by index; undefined: none. */
  light(handle: number | undefined): void {
    if (this.marks.light(handle)) this.redraw();
  }

  setTheme(theme: StageTheme): void {
    this.marks.setTheme(theme);
    for (const { material } of [this.object, this.covered]) {
      material.uniforms.color.value.copy(rawColor(theme.selected));
    }
  }

  /** Shows the joint's path, or nothing. `range` in seconds of the transport; default: the take's own. */
  show(
    character: Character | undefined,
    joint: number | undefined,
    range: readonly [number, number] | undefined,
    inPlace: boolean,
  ): void {
    const take = character && shownTake(character);
    const [start, end] = range ?? take?.range ?? [0, 0];
    const has = character?.skeleton && joint !== undefined && joint < character.skeleton.joints.length && end > start;
    if (!has) {
      this.sampling.abort();
      this.object.visible = false;
      this.shown = undefined;
      return;
    }
    const { shown } = this;
    const same =
      shown?.character === character &&
      shown.joint === joint &&
      shown.start === start &&
      shown.end === end &&
      shown.inPlace === inPlace;
    if (same) return;
    this.shown = { character, joint, start, end, inPlace };
    this.sampling.abort();
    this.sampling = new AbortController();
    const times = timesOnPath(character, joint, [start, end], MAX_MARKS);
    const steps = sampled(character, joint, [start, end], inPlace, times);
    const count = sampleCount([start, end]) + times.frames.length + times.keys.length;
    if (count * character.skeleton.joints.length <= AT_ONCE) {
      this.draw(character, joint, times, runToEnd(steps));
      return;
    }
    // Until then the former one, if it is of the same joint.
    if (shown?.character.id !== character.id || shown.joint !== joint) this.object.visible = false;
    runInSlices(steps, this.sampling.signal).then(
      (made) => {
        if (!made) return;
        this.draw(character, joint, times, made);
        this.redraw();
      },
      // Not awaited: errors are reported like those thrown while drawing.
      (error: unknown) => reportError(error),
    );
  }

  dispose(): void {
    this.sampling.abort();
    this.object.geometry.dispose();
    this.marks.dispose();
    for (const lines of [this.object, this.covered]) {
      lines.material.dispose();
      lines.dispose();
    }
  }

  private lines(material: ShaderMaterial, renderOrder: number): Lines {
    const made = new InstancedMesh(new BufferGeometry(), material, 0);
    made.frustumCulled = false;
    made.matrixAutoUpdate = false;
    made.renderOrder = renderOrder;
    return made;
  }

  private draw(character: Character, joint: number, times: PathTimes, { path, frames, keys }: Sampled): void {
    this.marks.show(character, joint, times, frames, keys);
    const count = path.length / 3;
    const segments = new Float64Array(6 * (count - 1));
    let length = 0;
    for (let i = 0; i + 1 < count; i++) {
      if (Number.isNaN(path[3 * i] + path[3 * i + 3])) continue;
      segments.set(path.subarray(3 * i, 3 * i + 6), length);
      length += 6;
    }
    this.object.geometry.dispose();
    this.object.geometry = segmentsGeometry(segments.subarray(0, length));
    this.covered.geometry = this.object.geometry;
    // It is never culled, and three.js would complain of paths beyond 32-bit floats.
    this.object.geometry.boundingSphere = new Sphere();
    this.place(character);
    this.object.visible = true;
  }

  private place({ placements, space }: Character): void {
    const matrices = new Float32Array(16 * placements.length);
    const matrix = new Float64Array(16);
    placements.forEach((placement, p) => {
      placementMatrix(placement, space, NO_TRAVEL, matrix);
      matrices.set(matrix, 16 * p);
    });
    this.object.instanceMatrix = new InstancedBufferAttribute(matrices, 16).setUsage(DynamicDrawUsage);
    this.covered.instanceMatrix = this.object.instanceMatrix;
    this.object.count = this.covered.count = placements.length;
  }
}
