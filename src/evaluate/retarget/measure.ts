/**
 * Measures a retargeted character as it is displayed, with its limits, linked DOFs and unpaired joints: whether its
 * arms and legs point like the source's, and how far its feet slide while the source's foot is in contact, over the
 * ground from where the contact began; and the same for the source, at the target's size.
 */
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import type { Character } from '../../model/document.ts';
import { worldMatrices } from '../kinematics.ts';
import { type PoseSource, poseFrom, poseSource } from '../pose.ts';
import { retargetPlan } from './make-plan.ts';
import type { FootTrack, RetargetPlan, Tip } from './plan.ts';
import { sourcePose } from './source-pose.ts';
import { toScene } from './travel.ts';

/** How well a retargeted take follows its source. */
export interface Measured {
  /** Degrees between the same bones of arms and legs, over all of them: average and maximum; 0 without any. */
  readonly limbsMean: number;
  readonly limbsWorst: number;
  readonly limbs: number;
  /** The same from ankles to toes and from wrists to middle fingers, where both have these joints. */
  readonly tipsMean: number;
  readonly tipsWorst: number;
  readonly tips: number;
  /** Metres: the maximum over all contacts. */
  readonly worst: number;
  /** Metres: the maximum per contact, averaged. */
  readonly mean: number;
  /** The same for the source, times the scale. */
  readonly sourceWorst: number;
  readonly sourceMean: number;
  /** Number of contacts measured, and of all. */
  readonly contacts: number;
  readonly allContacts: number;
  /** Height of the joint relative to standing, during contacts: minimum and maximum. Metres. */
  readonly lowest: number;
  readonly highest: number;
  /** On the source's own skeleton: how far the worst joint is from the source's, in proportion; metres. */
  readonly departure?: number;
}

/** Samples per second of a contact, and number of times at which limbs are compared, evenly over the take. */
const RATE = 60;
/** Most poses measured of one contact: a foot may stand for hours. */
const MAX_POSES = 10_000;
const MOMENTS = 48;

/** A displayed pose with that of its source: positions in the scene. */
class Pair {
  readonly plan: RetargetPlan;
  private readonly shown: PoseSource;
  private readonly dofs: Float64Array;
  private readonly world: Float64Array;
  private readonly offset: number;

  constructor(character: Character, plan: RetargetPlan) {
    this.plan = plan;
    this.shown = poseSource(character);
    this.dofs = new Float64Array(this.shown.count);
    this.world = new Float64Array(16 * plan.target.jointCount);
    this.offset = character.timeOffsetSeconds + (character.driver?.source.timeOffsetSeconds ?? 0);
  }

  /** @param seconds of the source's take */
  pose(seconds: number): void {
    const { plan } = this;
    poseFrom(this.shown, seconds - this.offset, this.dofs);
    worldMatrices(plan.target, this.dofs, this.world);
    sourcePose(plan.played, seconds, plan.dofs);
    worldMatrices(plan.source, plan.dofs, plan.sourceWorld);
  }

  own(joint: number, out: Float64Array): void {
    for (let k = 0; k < 3; k++) out[k] = this.world[16 * joint + 12 + k];
    toScene(this.plan.targetSpace, out);
  }

  source(joint: number, out: Float64Array): void {
    for (let k = 0; k < 3; k++) out[k] = this.plan.sourceWorld[16 * joint + 12 + k];
    toScene(this.plan.sourceSpace, out);
  }
}

/**
 * Measures a retargeted character over its source's take.
 * @param mostContacts limit per foot, evenly over the take: long takes have thousands
 * @throws Error if nothing is retargeted to the character
 */
export function measureRetarget(character: Character, mostContacts = Infinity): Measured {
  const { driver, skeleton } = character;
  if (!driver || !skeleton) throw new Error(`${character.name} is not retargeted.`);
  const plan = retargetPlan(driver, character, skeleton);
  const pair = new Pair(character, plan);
  return { ...measureLimbs(pair), ...measureFeet(pair, mostContacts) };
}

function measureLimbs(pair: Pair): Omit<Measured, keyof ReturnType<typeof measureFeet>> {
  const { plan } = pair;
  const { tips } = plan;
  const bones = plan.limbs.flatMap(({ upper, lower, end }) => [[upper, lower] as const, [lower, end] as const]);
  const [start, end] = plan.range;
  const count = end > start ? MOMENTS : 1;
  const [a, b, c, d] = [0, 1, 2, 3].map(() => new Float64Array(3));
  const angleOf = ([from, to, sourceFrom, sourceTo]: Tip) => {
    pair.own(from, a);
    pair.own(to, b);
    pair.source(sourceFrom, c);
    pair.source(sourceTo, d);
    return degreesBetween(a, b, c, d);
  };
  let sum = 0;
  let limbsWorst = 0;
  let tipsSum = 0;
  let tipsWorst = 0;
  let departure = 0;
  for (let i = 0; i < count; i++) {
    pair.pose(start + ((end - start) * i) / Math.max(1, count - 1));
    for (const [from, to] of bones) {
      const angle = angleOf([from, to, plan.sourceOf[from], plan.sourceOf[to]]);
      sum += angle;
      limbsWorst = Math.max(limbsWorst, angle);
    }
    for (const tip of tips) {
      const angle = angleOf(tip);
      tipsSum += angle;
      tipsWorst = Math.max(tipsWorst, angle);
    }
    if (!plan.sameBones.lengths) continue;
    plan.sourceOf.forEach((s, j) => {
      if (s < 0) return;
      pair.own(j, a);
      pair.source(s, b);
      const off = a.map((v, k) => v - plan.scale * b[k] - (k === 1 ? plan.shift : 0));
      departure = Math.max(departure, Math.hypot(...off));
    });
  }
  return {
    limbs: plan.limbs.length,
    limbsMean: sum / Math.max(1, count * bones.length),
    limbsWorst,
    tips: tips.length,
    tipsMean: tipsSum / Math.max(1, count * tips.length),
    tipsWorst,
    ...(plan.sameBones.lengths && { departure }),
  };
}

/** Between the direction from a to b and that from c to d. */
function degreesBetween(a: Float64Array, b: Float64Array, c: Float64Array, d: Float64Array): number {
  let dot = 0;
  let own = 0;
  let other = 0;
  for (let k = 0; k < 3; k++) {
    dot += (b[k] - a[k]) * (d[k] - c[k]);
    own += (b[k] - a[k]) ** 2;
    other += (d[k] - c[k]) ** 2;
  }
  const length = Math.sqrt(own * other);
  return length > 0 ? Math.acos(Math.min(1, Math.max(-1, dot / length))) / RADIANS_PER_DEGREE : 0;
}

function measureFeet(pair: Pair, mostContacts: number) {
  const { plan } = pair;
  const own = new Float64Array(3);
  const other = new Float64Array(3);
  const slides: number[] = [];
  const sourceSlides: number[] = [];
  let lowest = 0;
  let highest = 0;
  let allContacts = 0;
  for (const foot of plan.feet) {
    allContacts += foot.contacts.length / 2;
    for (const contact of spread(foot, mostContacts)) {
      const [from, to] = [foot.contacts[2 * contact], foot.contacts[2 * contact + 1]];
      const standing = plan.scale * foot.sourceHeight + foot.offsets[3 * contact + 1];
      const count = Math.max(2, Math.min(MAX_POSES, Math.round((to - from) * RATE) + 1));
      let [ownX, ownZ, otherX, otherZ] = [0, 0, 0, 0];
      let slid = 0;
      let sourceSlid = 0;
      for (let i = 0; i < count; i++) {
        pair.pose(from + ((to - from) * i) / (count - 1));
        pair.own(foot.ball, own);
        pair.source(foot.sourceBall, other);
        if (i === 0) [ownX, ownZ, otherX, otherZ] = [own[0], own[2], other[0], other[2]];
        slid = Math.max(slid, Math.hypot(own[0] - ownX, own[2] - ownZ));
        sourceSlid = Math.max(sourceSlid, plan.scale * Math.hypot(other[0] - otherX, other[2] - otherZ));
        lowest = Math.min(lowest, own[1] - standing);
        highest = Math.max(highest, own[1] - standing);
      }
      slides.push(slid);
      sourceSlides.push(sourceSlid);
    }
  }
  const mean = (values: readonly number[]) => values.reduce((a, b) => a + b, 0) / Math.max(1, values.length);
  return {
    worst: Math.max(0, ...slides),
    mean: mean(slides),
    sourceWorst: Math.max(0, ...sourceSlides),
    sourceMean: mean(sourceSlides),
    contacts: slides.length,
    allContacts,
    lowest,
    highest,
  };
}

/** Indices of up to that many contacts, evenly over all. */
function spread({ contacts }: FootTrack, most: number): number[] {
  const all = contacts.length / 2;
  const count = Math.min(all, most);
  return Array.from({ length: count }, (_, i) => Math.floor((i * all) / count));
}
