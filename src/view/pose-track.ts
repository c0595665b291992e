/**
 * A character's motion as three.js plays it: an `AnimationClip` of one track, whose values are all of the character's
 * DOFs, in an `AnimationMixer`.
 *
 *     transport's time ─► action.time ─► mixer.update(0) ─► our interpolant ─► evaluate/pose.ts ─► Dofs
 *
 * One track with as many values as there are DOFs is far cheaper than one a DOF: what a track costs in bindings, mixing
 * and calls is then paid once a character. Its keyframes are the channels' own, or the clip's samples, in doubles: the
 * interpolant reads those and not the floats that three.js keeps in a track, so tangents, steps and extrapolation are
 * exact at any time, before 0 and past the end too, and a take of 100,000 frames is not copied to be played. What the
 * clip leaves free (DOFs without a channel, a pose set by hand, limits) comes out of the same function that the command
 * line uses.
 *
 * How it has to be done with three.js 0.187:
 *  - The property that a track drives needs `fromArray` and `toArray`; a bare typed array is replaced by a number.
 *  - `createInterpolant` is put on the instance: the constructor sets its own there, over any method.
 *  - A clip's duration must be above 0. Nothing else is made of it, or of the track's own time, for the transport wraps,
 *    bounces and stops by itself; `mixer.setTime`, `LoopOnce` and ping-pong would wrap, revert or invert the time.
 */
import { type AnimationAction, AnimationClip, AnimationMixer, Interpolant, NumberKeyframeTrack, Object3D } from 'three';
import { dofCountOf, type PoseSource, poseFrom, poseSource } from '../evaluate/pose.ts';
import { PoseRotations } from '../evaluate/pose-rotations.ts';
import { type Character, shownClip } from '../model/document.ts';

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

/** What a mixer is made for: three.js finds the track's property on it by name. */
class Posed extends Object3D {
  readonly dofs: Dofs;

  constructor(count: number) {
    super();
    this.dofs = new Dofs(count);
  }
}

const TRACK = '.dofs' satisfies `.${keyof Posed & string}`;

/** Interpolates the keyframes of a character's channels; the mixer lends it the buffer. */
class PoseInterpolant extends Interpolant {
  constructor(
    times: Float32Array,
    values: Float32Array,
    private readonly player: PosePlayer,
  ) {
    super(times, values, values.length, new Float64Array(values.length));
  }

  override evaluate(timeSeconds: number): Float64Array {
    // The buffer is the constructor's above, or the mixer's, which is one of doubles too.
    const out = this.resultBuffer as Float64Array;
    poseFrom(this.player.source, timeSeconds, out, this.player.rotations);
    return out;
  }

  /** Of no use: `evaluate` is ours. */
  override interpolate_(): Float64Array {
    return this.evaluate(0);
  }
}

/** Plays one character. Made anew when its DOFs or its clip change; anything else is seen without. */
export class PosePlayer {
  /** Of the character whose pose and clip are read. It holds the compiled clip, or each frame might have to make it. */
  source: PoseSource;
  /** Those that samples gave to the joints at that time, beside `dofs`; undefined where no samples drive the character. */
  rotations: PoseRotations | undefined;
  /** Each DOF's value at the time of the last `seek`, in the order of `model/dofs.ts`. */
  readonly dofs: Float64Array;
  readonly clip: AnimationClip;
  private readonly mixer: AnimationMixer;
  private readonly action: AnimationAction;

  constructor(character: Character) {
    this.source = poseSource(character);
    this.rotations = rotationsFor(this.source);
    const { count } = this.source;
    const track = new NumberKeyframeTrack(TRACK, [0], new Float32Array(count));
    // three.js declares the three methods it puts here one by one; it only ever calls this one.
    Object.assign(track, { createInterpolant: () => new PoseInterpolant(track.times, track.values, this) });
    const clip = shownClip(character);
    const duration = clip ? clip.range[1] - clip.range[0] : 0;
    this.clip = new AnimationClip(clip?.name ?? 'pose', duration > 0 ? duration : 1, [track]);
    const posed = new Posed(count);
    this.dofs = posed.dofs.values;
    this.mixer = new AnimationMixer(posed);
    this.action = this.mixer.clipAction(this.clip).play();
  }

  /** Replaced after an edit that keeps DOFs and clip. */
  set character(character: Character) {
    this.source = poseSource(character);
    this.rotations = rotationsFor(this.source);
  }

  get character(): Character {
    return this.source.character;
  }

  /** Whether this can go on playing the character after an edit. */
  fits(character: Character): boolean {
    return dofCountOf(character) === this.dofs.length && shownClip(character) === shownClip(this.character);
  }

  /** Fills `dofs`. Any time, also before 0 and past the clip's end; allocates nothing. */
  seek(timeSeconds: number): void {
    this.action.time = timeSeconds;
    this.mixer.update(0);
  }
}

function rotationsFor({ skeleton, joints }: PoseSource): PoseRotations | undefined {
  return skeleton && joints && new PoseRotations(skeleton.jointCount);
}
