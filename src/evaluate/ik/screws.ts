/** The joints that are products of screws, all but those that stretch and quaternions, as flat lists (`chain.ts`). */
import type { CompiledSkeleton } from '../kinematics.ts';
import type { PinArrays, ScrewColumns, Screws, Slots } from './state.ts';
import type { IkVariables } from './variables.ts';

/** The kind of an axis that is none of x, y and z. */
export const SLANTED = 3;

/** @param takesScrews by slot */
export function screwsOf(
  compiled: CompiledSkeleton,
  { joint, takesScrews }: Slots,
  { ofDof, followers }: IkVariables,
): Screws {
  const joints = Array.from(joint);
  const first = new Int32Array(joints.length + 1);
  const all = joints.flatMap((j, s) => {
    const own = takesScrews[s] ? (compiled.motions[j].screws ?? []) : [];
    first[s + 1] = first[s] + own.length;
    return own.map((screw) => ({ ...screw, dof: compiled.firstDof[j] + screw.dof }));
  });
  return {
    first,
    dof: Int32Array.from(all, ({ dof }) => dof),
    variable: Int32Array.from(all, ({ dof }) => ofDof[dof]),
    follower: Int32Array.from(all, ({ dof }) => followers.ofDof[dof]),
    axisKind: Uint8Array.from(all, ({ axis }) => {
      const along = axis.indexOf(1);
      return along < 0 ? SLANTED : along;
    }),
    axes: Float64Array.from(all.flatMap(({ axis }) => axis)),
    turns: Uint8Array.from(all, ({ turn }) => turn),
    slides: Float64Array.from(all, ({ slide }) => slide),
    angles: new Float64Array(all.length),
    turned: new Float64Array(2 * all.length),
    lines: new Float64Array(6 * all.length),
  };
}

/** Which pins are moved by which screws. */
export function screwColumnsOf(
  { first, variable, follower, turns, slides }: Screws,
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
