/** Makes a plan (`plan.ts`) for each driver. */
import { backMultiply3 } from '../../math/mat3.ts';
import { type Character, type Driver, shownTake } from '../../model/document.ts';
import { filePose } from '../../model/skeleton/dofs.ts';
import { dofsOf, factorsOf } from '../../model/skeleton/joint-types.ts';
import type { Motion, Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import type { JointPair } from '../../model/takes/retarget.ts';
import type { Take } from '../../model/takes/take.ts';
import { type CompiledSkeleton, compileSkeleton, localMatrices } from '../kinematics.ts';
import { retargetCarrier } from '../space/carrier.ts';
import { metresPerUnit } from '../space/metres.ts';
import { alignment, type Bodies, bodiesOf, bodyFrame, driven, sourceBody } from './align.ts';
import { upRotation } from './body.ts';
import { footTracks } from './contacts.ts';
import { fingerBases } from './fingers.ts';
import { jointFit } from './fit.ts';
import { hipsTrack } from './hips.ts';
import { automaticScale } from './leg-length.ts';
import { limitedTurns } from './legs.ts';
import { type Limb, limbsOf } from './limbs.ts';
import type { Carrier, CopiedDof, RetargetPlan, Slide, SpaceRule, Tip } from './plan.ts';
import { asksTake, ownReference, type PlayedTake, sourceReference } from './reference.ts';
import { LIMB_SIDES } from './roles.ts';
import { sameBones, sameJoints } from './same-bones.ts';
import { playedSource } from './source-pose.ts';

/** By the driver's pairs, whose identity is kept when the source changes (`edit/drivers.ts`). */
const plans = new WeakMap<
  readonly JointPair[],
  {
    driver: Driver;
    skeleton: Skeleton;
    space: Space | undefined;
    clamps: boolean;
    take: Take | undefined;
    plan: RetargetPlan;
  }
>();

/**
 * Cached per driver, and made again when its inputs change. The source's name and time offset don't matter, so dragging
 * the source along the timeline keeps the plan.
 */
export function retargetPlan(driver: Driver, character: Character, skeleton: Skeleton): RetargetPlan {
  const { space, clampsToLimits } = character;
  const take = shownTake(character);
  const known = plans.get(driver.pairs);
  if (
    known &&
    known.skeleton === skeleton &&
    known.space === space &&
    known.clamps === clampsToLimits &&
    (known.take === take || !known.plan.asksOwnTake) &&
    (known.driver === driver || plansAlike(known.driver, driver))
  ) {
    return known.plan;
  }
  const plan = planRetarget(driver, skeleton, space, clampsToLimits, take);
  plans.set(driver.pairs, { driver, skeleton, space, clamps: clampsToLimits, take, plan });
  return plan;
}

/** Compares drivers with the same pairs. */
function plansAlike({ options, source: a }: Driver, { options: otherOptions, source: b }: Driver): boolean {
  return (
    options === otherOptions &&
    a.skeleton === b.skeleton &&
    a.take === b.take &&
    a.pose === b.pose &&
    a.clampsToLimits === b.clampsToLimits &&
    a.space === b.space &&
    a.limbs === b.limbs &&
    a.placements === b.placements &&
    a.leaders === b.leaders
  );
}

/**
 * Prepares everything about one retargeting that is the same at all times.
 * @param ownTake of the target: needed if its file pose is not a standing one
 */
export function planRetarget(
  driver: Driver,
  skeleton: Skeleton,
  space: Space | undefined,
  clamps: boolean,
  ownTake?: Take,
): RetargetPlan {
  const { source, options, pairs } = driver;
  const target = compileSkeleton(skeleton);
  const played = playedSource(source);
  const filed = bodiesOf(source.skeleton, source.space, skeleton, space, pairs);
  const { range } = source.take;
  const same = sameBones(filed, sourceBody(filed));
  const asksOwnTake = !same.directions && asksTake(filed);
  const bodies = asksOwnTake ? { ...filed, rest: ownReference(filed, takeOf(skeleton, clamps, ownTake)) } : filed;
  const reference = sourceReference(bodies, { played, range }, same.directions ? 'rest' : options.reference);
  const { corrections, slopes } = alignment(bodies, reference);
  const sourceSpace = ruleOf(source.space);
  const targetSpace = ruleOf(space);
  const across = new Float64Array(9);
  backMultiply3(targetSpace.up, 0, sourceSpace.up, 0, across, 0);
  const compiledSource = compileSkeleton(source.skeleton);
  const scale = options.scale ?? automaticScale(bodies, reference);
  const restDofs = Float64Array.from(filePose(skeleton, 0));
  const limbs = limbsOf(filed, target, restDofs, clamps);
  const carrier = carrierOf(driver, skeleton, target);
  const plain: RetargetPlan = {
    source: compiledSource,
    target,
    played,
    range,
    sourceOf: bodies.sourceOf,
    across,
    corrections,
    slopes: same.directions ? [] : slopes,
    fits: skeleton.joints.map((joint, j) => (bodies.sourceOf[j] >= 0 ? jointFit(target, joint, j, clamps) : undefined)),
    bones: bonesOf(bodies, limbs),
    fronts: frontsOf(bodies),
    limbs,
    tips: tipsOf(bodies),
    slides: slidesOf(bodies, target, carrier.joint),
    copied: copiedDofs(bodies, target, compiledSource, (scale * sourceSpace.metres) / targetSpace.metres),
    carrier,
    asksOwnTake,
    restDofs,
    scale,
    carried: carriedJoints(bodies, carrier.joint),
    shift: 0,
    plantsFeet: options.plantsFeet,
    sameBones: same,
    isCopy: clamps === source.clampsToLimits && (options.scale ?? 1) === 1 && sameJoints(filed),
    feet: [],
    sourceSpace,
    targetSpace,
    dofs: new Float64Array(played.dofCount),
    sourceWorld: new Float64Array(16 * compiledSource.jointCount),
    targetWorld: new Float64Array(16 * target.jointCount),
    wanted: new Float64Array(9 * target.jointCount),
  };
  const standing = footTracks(plain, bodies, reference);
  if (!options.plantsFeet || same.lengths || standing.feet.length === 0) return standing;
  const carried = { ...standing, hips: hipsTrack(standing) };
  return { ...carried, feet: limitedTurns(carried) };
}

function ruleOf(space: Space | undefined): SpaceRule {
  return { up: upRotation(space), metres: space ? metresPerUnit(space) : 1, lift: space?.lift ?? 0 };
}

function takeOf(skeleton: Skeleton, clampsToLimits: boolean, take: Take | undefined): PlayedTake | undefined {
  if (!take) return undefined;
  return { played: playedSource({ skeleton, take, pose: filePose(skeleton, 0), clampsToLimits }), range: take.range };
}

function carrierOf(driver: Driver, skeleton: Skeleton, { travel, slides }: CompiledSkeleton): Carrier {
  const joint = retargetCarrier(driver, skeleton);
  return { joint, dofs: joint > 0 ? slides.slice(3 * joint, 3 * joint + 3) : travel };
}

function carriedJoints(bodies: Bodies, carrier: number): number[] {
  const thighs = LIMB_SIDES.map((side) => driven(bodies, `${side} thigh`)).filter((j) => j >= 0);
  if (thighs.length === 2) return thighs;
  const hips = driven(bodies, 'hips');
  if (hips >= carrier) return [hips];
  return bodies.sourceOf[carrier] >= 0 ? [carrier] : [];
}

/** The joints that slide: paired, with position DOFs on both sides, below joints that are a pair too. */
function slidesOf({ source, target, sourceOf }: Bodies, compiled: CompiledSkeleton, carrier: number) {
  const compiledSource = compileSkeleton(source);
  const rest = Float64Array.from(filePose(source, 0));
  const restLocals = new Float64Array(16 * source.joints.length);
  localMatrices(compiledSource, rest, restLocals);
  const restDofs = filePose(target, 0);
  const dofsAlong = ({ slides, travel }: CompiledSkeleton, { joints }: Skeleton, j: number) =>
    j === 0 ? travel : slidesFirst(joints[j].motion) ? slides.slice(3 * j, 3 * j + 3) : NO_SLIDES;
  return target.joints.map(({ parent: above }, j): Slide | undefined => {
    const s = sourceOf[j];
    const dofs = dofsAlong(compiled, target, j);
    if (j === carrier || s < 0 || dofs.every((d) => d < 0) || dofsAlong(compiledSource, source, s).every((d) => d < 0))
      return undefined;
    const { parent } = source.joints[s];
    if (above >= 0 && (parent < 0 || sourceOf[above] !== parent)) return undefined;
    return {
      source: s,
      parent: above < 0 ? -1 : parent,
      sourceRest: restLocals.slice(16 * s + 12, 16 * s + 15),
      dofs,
      rest: Float64Array.from(dofs, (d) => (d < 0 ? 0 : restDofs[d])),
    };
  });
}

const NO_SLIDES = Int32Array.of(-1, -1, -1);

/** Whether positions are applied before rotations and scales, if in any order. */
function slidesFirst(motion: Motion): boolean {
  const isSlide = (name: string) => /^t[xyz]$/.test(name);
  const factors = factorsOf(motion) ?? [];
  return factors.findLastIndex(isSlide) < factors.filter(isSlide).length;
}

/** Copied DOFs of pairs whose joints have the same ones: those that neither rotate nor slide. */
function copiedDofs(
  { source, target, sourceOf }: Bodies,
  compiled: CompiledSkeleton,
  compiledSource: CompiledSkeleton,
  lengths: number,
): CopiedDof[] {
  return target.joints.flatMap(({ motion }, j) => {
    const s = sourceOf[j];
    const others = s < 0 ? [] : dofsOf(source.joints[s].motion);
    const own = dofsOf(motion);
    if (own.length !== others.length || own.some(({ name }, d) => name !== others[d].name)) return [];
    return own.flatMap(({ name, unit }, d): CopiedDof[] => {
      if (/^[rq]/.test(name) || (/^t[xyz]/.test(name) && slidesFirst(motion))) return [];
      const factor = unit === 'length' ? lengths : 1;
      return [{ target: compiled.firstDof[j] + d, source: compiledSource.firstDof[s] + d, factor }];
    });
  });
}

function tipsOf({ feet, roles, sourceOf, sourceParts, target, source }: Bodies): Tip[] {
  const toes = feet.flatMap(({ own, source: other }): Tip[] =>
    typeof own.tip === 'number' && typeof other.tip === 'number'
      ? [[own.joints[0], own.tip, other.joints[0], other.tip]]
      : [],
  );
  const fingers = LIMB_SIDES.flatMap((side): Tip[] => {
    const hand = driven({ roles, sourceOf }, `${side} hand`);
    const finger = hand < 0 ? undefined : fingerBases(target, roles, hand).get('middle');
    const other = finger === undefined ? undefined : fingerBases(source, sourceParts, sourceOf[hand]).get('middle');
    return finger === undefined || other === undefined ? [] : [[hand, finger, sourceOf[hand], other]];
  });
  return [...toes, ...fingers];
}

/** In each joint's own space at the reference pose; constant for joints that only rotate. */
function bonesOf({ rest, target }: Bodies, limbs: readonly Limb[]): Float64Array {
  const out = new Float64Array(3 * target.joints.length);
  for (const { upper, lower, end } of limbs) {
    for (const [j, to] of [
      [upper, lower],
      [lower, end],
    ]) {
      const way = Float64Array.from([0, 1, 2], (k) => rest.points[3 * to + k] - rest.points[3 * j + k]);
      const length = Math.hypot(...way);
      if (!(length > 0)) continue;
      for (let k = 0; k < 3; k++) {
        const o = 9 * j + 3 * k;
        const along = rest.rotations[o] * way[0] + rest.rotations[o + 1] * way[1] + rest.rotations[o + 2] * way[2];
        out[3 * j + k] = along / length;
      }
    }
  }
  return out;
}

/** z of the body's frame at rest. */
function frontsOf(bodies: Bodies): Float64Array {
  const frame = bodyFrame(bodies.rest, bodies, (t) => t);
  const { rotations: r } = bodies.rest;
  const out = new Float64Array(r.length / 3);
  // Transposed: from the scene's axes to the joint's own.
  for (let i = 0; i < out.length; i++) {
    out[i] = r[3 * i] * frame[6] + r[3 * i + 1] * frame[7] + r[3 * i + 2] * frame[8];
  }
  return out;
}
