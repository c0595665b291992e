/**
 * Joints that are products of screws (all except quaternions and those that stretch) as a flat list of LINKS, one per
 * screw (`chain.ts`). A joint without a screw, or one that is no product of screws, is a single link.
 */
import type { Vec3 } from '../../math/vec3.ts';
import type { CompiledSkeleton } from '../kinematics.ts';
import type { Links, PinArrays, ScrewColumns, Slots } from './state.ts';
import type { IkVariables } from './variables.ts';

/**
 * Kind of a link: it rotates about x, y, z (0, 1, 2) or another axis, only slides, is constant, or uses its joint's own
 * rule.
 */
export const SLANTED = 3;
/** The link only translates along its axis. */
export const SLIDES = 4;
/** The link is constant: a joint without DOFs. */
export const STANDS = 5;
/** The link uses its joint's own rule. */
export const OTHER = 6;

/** Numbers per link in `Links.plan`: what it does, its DOF, the slot it continues from, the slot for its matrix. */
export const PLAN = 4;
/** In place of a slot to continue from: the previous link, or the common space. */
export const BEFORE = -1;
/** The link continues from the space of the world matrices. */
export const WORLD = -2;
/** Numbers per link in `Links.rules`: its offset from what it continues from, its axis, its slide along that. */
export const RULES = 7;

const STILL = { dof: -1, axis: [0, 0, 0], turn: 0, slide: 0 } as const;

/**
 * The joints of a problem as links.
 * @param isKept by slot, whether its matrix is needed
 */
export function linksOf(
  compiled: CompiledSkeleton,
  { joint, parent, takesScrews, isKept }: Slots,
  { ofDof, followers }: IkVariables,
): Links {
  const first = new Int32Array(joint.length + 1);
  const all = Array.from(joint).flatMap((j, s) => {
    const screws = takesScrews[s] ? (compiled.motions[j].screws ?? []) : [];
    const own = screws.map((screw) => ({ ...screw, dof: compiled.firstDof[j] + screw.dof }));
    const links = own.length > 0 ? own : [STILL];
    first[s + 1] = first[s] + links.length;
    const above = parent[s];
    const follows = above < 0 ? WORLD : above === s - 1 && takesScrews[above] ? BEFORE : above;
    return links.map((link, k) => ({
      ...link,
      does: takesScrews[s] ? whatItDoes(link) : OTHER,
      offset: k === 0 ? [...compiled.offsets.subarray(3 * j, 3 * j + 3)] : [0, 0, 0],
      from: k === 0 ? follows : BEFORE,
      // A joint's own rule always writes its matrix, and needs the slot.
      kept: !takesScrews[s] || (k === links.length - 1 && isKept[s]) ? s : -1,
    }));
  });
  const indexIn = (list: Int32Array) => Int32Array.from(all, ({ dof }) => (dof < 0 ? -1 : list[dof]));
  return {
    first,
    plan: Int32Array.from(all.flatMap(({ does, dof, from, kept }) => [does, dof, from, kept])),
    rules: Float64Array.from(all.flatMap(({ offset, axis, slide }) => [...offset, ...axis, slide])),
    variable: indexIn(ofDof),
    follower: indexIn(followers.ofDof),
    turns: Uint8Array.from(all, ({ turn }) => turn),
    slides: Float64Array.from(all, ({ slide }) => slide),
    angles: new Float64Array(all.length),
    turned: new Float64Array(2 * all.length),
    lines: new Float64Array(6 * all.length),
  };
}

function whatItDoes({ dof, axis, turn }: { dof: number; axis: Vec3; turn: number }): number {
  if (dof < 0) return STANDS;
  if (turn === 0) return SLIDES;
  const along = axis.indexOf(1);
  // Off by a last digit counts as another axis.
  return along < 0 || axis.filter((part) => part === 0).length < 2 ? SLANTED : along;
}

/** Which screws move which pins. */
export function screwColumnsOf(
  { first, variable, follower, turns, slides }: Links,
  { parent, allScrews }: Slots,
  { count, slot, row, holdsOrientation }: PinArrays,
  variables: IkVariables,
  rootMoves: boolean,
): ScrewColumns {
  const firstHinge = new Int32Array(count + 1);
  const hinges: number[] = [];
  const hingeScales: number[] = [];
  const others: number[] = [];
  for (let p = 0; p < count; p++) {
    for (let s = slot[p]; s >= 0; s = parent[s]) {
      for (let i = first[s]; i < first[s + 1]; i++) {
        const v = variable[i];
        if (v < 0) continue;
        if (follower[i] < 0 && turns[i] === 1 && slides[i] === 0 && holdsOrientation[p] === 0) {
          hinges.push(6 * i, row[p] * variables.count + v);
          hingeScales.push(variables.scale[v]);
        } else others.push(i, p);
      }
    }
    firstHinge[p + 1] = hingeScales.length;
  }
  return {
    areAll: allScrews && others.length === 0 && !rootMoves,
    firstHinge,
    hinges: Int32Array.from(hinges),
    hingeScales: Float64Array.from(hingeScales),
    others: Int32Array.from(others),
  };
}
