/**
 * A character's motion as three.js plays it: an `AnimationClip` of one track, whose values are all of the character's
 * DOFs, in an `AnimationMixer`.
 *
 *     transport's time ─► action.time ─► mixer.update(0) ─► our interpolant ─► evaluate/pose.ts ─► Dofs
 *
 * One track for all DOFs is far cheaper than one per DOF: the cost of a track in bindings, mixing and calls is paid
 * once per character. The interpolant reads the channels' own keys, or the take's samples, in doubles rather than the
 * floats of a three.js track. So tangents, steps and extrapolation are exact at any time, also before 0 and past the
 * end, and a take of 100,000 frames isn't copied to be played. Everything else (DOFs without a channel, unkeyed
 * changes, limits) is evaluated by the same function as on the command line.
 *
 * What three.js 0.187 requires:
 * - The property that a track drives needs `fromArray` and `toArray`; a bare typed array is replaced by a number.
 * - `createInterpolant` is put on the instance: the constructor sets its own there, hiding any method.
 * - A take's duration must be above 0. It is used for nothing else, nor is the track's own time: the transport itself
 *   wraps, bounces and stops; `mixer.setTime`, `LoopOnce` and ping-pong would wrap, revert or invert the time.
 */
import { type AnimationAction, AnimationClip, AnimationMixer, Interpolant, NumberKeyframeTrack, Object3D } from 'three';
import { dofCountOf, type PoseSource, poseFrom, poseSource } from '../../evaluate/pose.ts';
import { PoseRotations } from '../../evaluate/rotations/pose-rotations.ts';
import { type Character, shownTake } from '../../model/document.ts';

/** The property that the track drives. */
class Dofs {
  readonly values: Float64Array;

  constructor(count: number) {
    this.values = new Float64Array(count);
  }

  fromArray(source: ArrayLike<number>, offset = 0): this {
    for (let d = 0; d < this.values.length; d++) this.values[d] = source[offset + d];
    return this;
  }

  toArray(target: number[] | Float64Array = [], offset = 0): number[] | Float64Array {
    for (let d = 0; d < this.values.length; d++) target[offset + d] = this.values[d];
    return target;
  }
}

/** The mixer's root: three.js finds the track's property on it by name. */
class Posed extends Object3D {
  readonly dofs: Dofs;

  constructor(count: number) {
    super();
    this.dofs = new Dofs(count);
  }
}

const TRACK = '.dofs' satisfies `.${keyof Posed & string}`;

/** Interpolates a character's channels; the mixer provides the buffer. */
class PoseInterpolant extends Interpolant {
  constructor(
    times: Float32Array,
    values: Float32Array,
    private readonly player: PosePlayer,
  ) {
    super(times, values, values.length, new Float64Array(values.length));
  }

  override evaluate(timeSeconds: number): Float64Array {
    // The constructor's buffer above, or the mixer's, which holds doubles too.
    const out = this.resultBuffer as Float64Array;
    poseFrom(this.player.source, timeSeconds, out, this.player.rotations);
    return out;
  }

  /** Never called: `evaluate` is overridden. */
  override interpolate_(): Float64Array {
    return this.evaluate(0);
  }
}

/** Plays one character. Recreated when its DOFs or take change; other edits need nothing. */
export class PosePlayer {
  /** Source of pose and take. Keeps the compiled take alive, so that frames don't have to recompile it. */
  source: PoseSource;
  /** Sampled rotations of joints at that time, beside `dofs`; undefined unless samples drive the character. */
  rotations: PoseRotations | undefined;
  /** Each DOF's value at the time of the last `seek`, in the order of `model/dofs.ts`. */
  readonly dofs: Float64Array;
  readonly take: AnimationClip;
  private readonly mixer: AnimationMixer;
  private readonly action: AnimationAction;

  constructor(character: Character) {
    this.source = poseSource(character);
    this.rotations = rotationsFor(this.source);
    const { count } = this.source;
    const track = new NumberKeyframeTrack(TRACK, [0], new Float32Array(count));
    // three.js assigns this method per instance; it calls no other.
    Object.assign(track, { createInterpolant: () => new PoseInterpolant(track.times, track.values, this) });
    const take = shownTake(character);
    const duration = take ? take.range[1] - take.range[0] : 0;
    this.take = new AnimationClip(take?.name ?? 'pose', duration > 0 ? duration : 1, [track]);
    const posed = new Posed(count);
    this.dofs = posed.dofs.values;
    this.mixer = new AnimationMixer(posed);
    this.action = this.mixer.clipAction(this.take).play();
  }

  /** Replace after an edit that keeps DOFs and take. */
  set character(character: Character) {
    this.source = poseSource(character);
    this.rotations = rotationsFor(this.source);
  }

  get character(): Character {
    return this.source.character;
  }

  /** Whether it can play the edited character. */
  fits(character: Character): boolean {
    return dofCountOf(character) === this.dofs.length && shownTake(character) === shownTake(this.character);
  }

  /** Fills `dofs`. Any time, also before 0 and past the take's end; allocates nothing. */
  seek(timeSeconds: number): void {
    this.action.time = timeSeconds;
    this.mixer.update(0);
  }
}

function rotationsFor({ skeleton, motion }: PoseSource): PoseRotations | undefined {
  return skeleton && motion?.joints && new PoseRotations(skeleton.jointCount);
}
