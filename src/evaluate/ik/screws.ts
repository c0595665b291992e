/**
 * The joints that are products of screws, all but those that stretch and quaternions, as flat lists: the quick way
 * through forward kinematics, on which the world axes that the Jacobian needs lie.
 *
 *     W = W_parent · T(offset) · Π T(slide·φ·a) · R(a, turn·φ)
 *
 * A turn about x, y or z mixes two columns of W, and its axis in the world is the third; about any other axis each
 * column turns by Rodrigues' formula, and the third is the cross product of two.
 */
import { setIdentity } from '../../math/mat4.ts';
import type { CompiledSkeleton } from '../kinematics.ts';
import type { IkProblem, PinArrays, ScrewColumns, Screws, Slots } from './state.ts';
import type { IkVariables } from './variables.ts';

/** Numbers of a screw's rule: its axis, whether it turns, how far it slides. */
const RULE = 5;
/** About a slanted axis. */
const SLANTED = 3;

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
    rules: Float64Array.from(all.flatMap(({ axis, turn, slide }) => [...axis, turn, slide])),
    turns: Uint8Array.from(all, ({ turn }) => turn),
    slides: Float64Array.from(all, ({ slide }) => slide),
    lines: new Float64Array(6 * all.length),
  };
}

/** Which pins are moved by which screws. */
export function screwColumnsOf(
  { first, variable, follower, turns, slides }: Screws,
  { parent }: Slots,
  { count, slot, row, holdsOrientation }: PinArrays,
  variables: IkVariables,
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
    firstHinge,
    hinges: Int32Array.from(hinges),
    hingeScales: Float64Array.from(hingeScales),
    others: Int32Array.from(others),
  };
}

/**
 * The world matrices of all slots that take screws, and the lines that the screws are on. One long loop, since a call a
 * joint costs as much as the joint.
 * @param writeOther writes the world matrix of a slot that doesn't
 */
export function writeMatrices(
  problem: IkProblem,
  dofs: Float64Array,
  writeOther: (problem: IkProblem, dofs: Float64Array, slot: number) => void,
): void {
  const { skeleton, slots, screws } = problem;
  const { hasRootTranslation } = skeleton;
  const { count, parent, offsets, worlds: w, takesScrews } = slots;
  const { first, dof, axisKind, rules, lines } = screws;
  for (let s = 0; s < count; s++) {
    if (takesScrews[s] === 0) {
      writeOther(problem, dofs, s);
      continue;
    }
    const o = 16 * s;
    const dx = offsets[3 * s];
    const dy = offsets[3 * s + 1];
    const dz = offsets[3 * s + 2];
    // Where the columns are before the next screw: the parent's, then its own.
    let g = 16 * parent[s];
    if (g < 0) {
      setIdentity(w, o);
      w[o + 12] = hasRootTranslation ? dx + dofs[0] : dx;
      w[o + 13] = hasRootTranslation ? dy + dofs[1] : dy;
      w[o + 14] = hasRootTranslation ? dz + dofs[2] : dz;
      g = o;
    } else {
      w[o + 12] = w[g + 12] + w[g] * dx + w[g + 4] * dy + w[g + 8] * dz;
      w[o + 13] = w[g + 13] + w[g + 1] * dx + w[g + 5] * dy + w[g + 9] * dz;
      w[o + 14] = w[g + 14] + w[g + 2] * dx + w[g + 6] * dy + w[g + 10] * dz;
    }
    for (let i = first[s]; i < first[s + 1]; i++) {
      const value = dofs[dof[i]];
      const kind = axisKind[i];
      const line = 6 * i;
      const rule = RULE * i;
      const slide = rules[rule + 4] * value;
      const angle = rules[rule + 3] * value;
      // A slide alone turns by nothing.
      const cos = Math.cos(angle);
      const sin = Math.sin(angle);
      lines[line + 3] = w[o + 12];
      lines[line + 4] = w[o + 13];
      lines[line + 5] = w[o + 14];
      if (kind < SLANTED) {
        const along = 4 * kind;
        const x = w[g + along];
        const y = w[g + along + 1];
        const z = w[g + along + 2];
        lines[line] = x;
        lines[line + 1] = y;
        lines[line + 2] = z;
        if (slide !== 0) {
          w[o + 12] += slide * x;
          w[o + 13] += slide * y;
          w[o + 14] += slide * z;
        }
        const u = kind === 2 ? 0 : along + 4;
        const v = kind === 0 ? 8 : along - 4;
        const u0 = w[g + u];
        const u1 = w[g + u + 1];
        const u2 = w[g + u + 2];
        const v0 = w[g + v];
        const v1 = w[g + v + 1];
        const v2 = w[g + v + 2];
        w[o + along] = x;
        w[o + along + 1] = y;
        w[o + along + 2] = z;
        w[o + u] = cos * u0 + sin * v0;
        w[o + u + 1] = cos * u1 + sin * v1;
        w[o + u + 2] = cos * u2 + sin * v2;
        w[o + v] = cos * v0 - sin * u0;
        w[o + v + 1] = cos * v1 - sin * u1;
        w[o + v + 2] = cos * v2 - sin * u2;
      } else {
        const a = rules[rule];
        const b = rules[rule + 1];
        const c = rules[rule + 2];
        const p0 = w[g];
        const p1 = w[g + 1];
        const p2 = w[g + 2];
        const q0 = w[g + 4];
        const q1 = w[g + 5];
        const q2 = w[g + 6];
        const x = p0 * a + q0 * b + w[g + 8] * c;
        const y = p1 * a + q1 * b + w[g + 9] * c;
        const z = p2 * a + q2 * b + w[g + 10] * c;
        lines[line] = x;
        lines[line + 1] = y;
        lines[line + 2] = z;
        if (slide !== 0) {
          w[o + 12] += slide * x;
          w[o + 13] += slide * y;
          w[o + 14] += slide * z;
        }
        // The columns are unit vectors, and the axis has the same parts along them before and after.
        const p = (1 - cos) * a;
        const q = (1 - cos) * b;
        const x0 = cos * p0 + sin * (y * p2 - z * p1) + p * x;
        const x1 = cos * p1 + sin * (z * p0 - x * p2) + p * y;
        const x2 = cos * p2 + sin * (x * p1 - y * p0) + p * z;
        const y0 = cos * q0 + sin * (y * q2 - z * q1) + q * x;
        const y1 = cos * q1 + sin * (z * q0 - x * q2) + q * y;
        const y2 = cos * q2 + sin * (x * q1 - y * q0) + q * z;
        w[o] = x0;
        w[o + 1] = x1;
        w[o + 2] = x2;
        w[o + 4] = y0;
        w[o + 5] = y1;
        w[o + 6] = y2;
        w[o + 8] = x1 * y2 - x2 * y1;
        w[o + 9] = x2 * y0 - x0 * y2;
        w[o + 10] = x0 * y1 - x1 * y0;
      }
      g = o;
    }
    // Nothing turned it.
    if (g !== o) for (let k = 0; k < 12; k++) w[o + k] = w[g + k];
  }
}
