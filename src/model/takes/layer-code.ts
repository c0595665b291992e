/**
 * The code of layers, goals of limbs and attachments (`layers.ts` and `goals.ts` here, and in `evaluate/`), for what
 * has to do without: it is a separate script, which pages whose takes have none of these never load. Takes can't wait
 * for it to load, so code that brings any into a document, or is given one that may have some, passes it on before:
 *
 *     provideLayers();
 *
 * of `evaluate/layers.ts`.
 */
import type { Character, Unkeyed } from '../document.ts';
import type { GoalPlace, LimbRow, Limbs } from '../limbs.ts';
import type { Skeleton } from '../skeleton/skeleton.ts';
import type * as TakeGoals from './goals.ts';
import type * as LayerJoints from './layer-joints.ts';
import type * as Layers from './layers.ts';
import type { Goals, LayerSettings, Motion, Take } from './take.ts';

/** A layer at a time. */
export interface LayerInfo extends Omit<LayerSettings, 'weight' | 'ofWeight' | 'others'> {
  /** Within 0 … 1. */
  readonly weight: number;
  /** Whether keys and curves of the take are its own. */
  readonly active: boolean;
}

/** The layers of a take, ready for evaluation. */
export interface LayersOverBase {
  /** The motion beneath. */
  readonly base: Motion;
  /** Changes the first `count` values, from those of the base, by all layers that count. Allocates nothing. */
  add(timeSeconds: number, out: Float64Array, count: number): void;
}

/** Something that is wrong with the goals of a take. */
export interface GoalProblem {
  readonly code: 'goal-without-limb' | 'limb-joint-unknown' | 'limb-cycle';
  /** The index of the goal. */
  readonly goal: number;
  /** Within the goal: `space[1]`. */
  readonly path: string;
  /** A sentence. */
  readonly message: string;
}

/** The parts of a character that say where its root follows others, and where its limbs go. */
export type Follower = Pick<Character, 'skeleton' | 'limbs' | 'space' | 'placements' | 'leaders'>;

/**
 * The last part of posing, over poses within the limits, ready for evaluation: limbs that go to goals, a root that
 * follows a joint.
 */
export interface OverPose {
  /**
   * Changes a pose at a time of the take. Allocates nothing.
   * @param count number of the character's DOFs, if `dofs` may be longer
   * @param unkeyed values of goals, among others, that were set by hand at that time
   */
  solve(timeSeconds: number, dofs: Float64Array, clamps: boolean, count?: number, unkeyed?: Unkeyed): void;
}

/** The functions that the first script calls. */
export interface LayerCode
  extends Pick<typeof Layers, 'haveSameFiles' | 'withMotions'>,
    Pick<typeof TakeGoals, 'remapGoals' | 'takeOfChannels' | 'withGoalChannels'>,
    Pick<typeof LayerJoints, 'unknownJoints'> {
  /** Cached. Without a skeleton, layers with joints touch nothing. */
  overBase(take: Take, skeleton: Skeleton | undefined): LayersOverBase;
  /** What is wrong with goals, which are then not reached. */
  goalProblems(goals: Goals, limbs: Limbs, skeleton: Skeleton): readonly GoalProblem[];
  /** Cached. */
  takeLimbs(goals: Goals, limbs: Limbs, skeleton: Skeleton): OverPose;
  /** Puts the root where the take attaches it, and then its limbs to its goals. Cached. */
  overPose(take: Take, character: Follower): OverPose;
  /** What sets DOFs of limbs in IK, as values of their goals. */
  posedByGoals(
    character: Character,
    values: ReadonlyMap<number, number>,
    timeSeconds: number,
    keys: boolean,
  ): ReadonlyMap<number, number>;
  /** The goals of limbs that are in IK. @param dofs the pose that is displayed at that time */
  goalPlaces(character: Character, timeSeconds: number, dofs: Float64Array): GoalPlace[];
  /** All limbs of a character at a time of the transport. */
  limbRows(character: Character, timeSeconds: number): LimbRow[];
  /** All layers of a take at a time of it, from the lowest up. */
  infos(take: Take, timeSeconds: number): LayerInfo[];
}

let provided: LayerCode | undefined;

/** Passes on the functions, before there is a take with layers. */
export function provideLayerCode(code: LayerCode): void {
  provided = code;
}

/**
 * The functions that were provided.
 * @param name of the take that needs them
 * @throws Error if none were
 */
export function layerCode({ name }: Pick<Take, 'name'>): LayerCode {
  if (!provided) throw new Error(`${name}: call provideLayers() first.`);
  return provided;
}

/** The take with the curves of its goals as channels after those of all DOFs: see `withGoalChannels`. */
export function withCurvesOfGoals(take: Take, dofCount: number): Take {
  return take.goals ? layerCode(take).withGoalChannels(take, dofCount) : take;
}
