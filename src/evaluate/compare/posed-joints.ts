/** Positions of joints of a character in the scene, or relative to its root, for comparing takes. */
import type { Character } from '../../model/document.ts';
import { compileSkeleton, worldMatrices } from '../kinematics.ts';
import { dofCountOf, poseAt } from '../pose.ts';
import { NO_TRAVEL, placementMatrix } from '../space/placements.ts';

/** As displayed; relative to the root's position; also relative to its orientation (`distance.ts`). */
export const ALIGNMENTS = ['world', 'root', 'turned'] as const;
/** Differences that are ignored when two motions are compared; see `ALIGNMENTS`. */
export type Alignment = (typeof ALIGNMENTS)[number];

/** Positions of some of a character's joints at successive times. */
export class PosedJoints {
  /** x y z of each, after the last `pose`. */
  readonly positions: Float64Array;
  private readonly dofs: Float64Array;
  private readonly world: Float64Array;
  private readonly compiled;
  private readonly toScene = new Float64Array(16);
  private readonly root = new Float64Array(16);

  /**
   * @param rootAt index of the root in `joints`
   * @param turn of the root's axes, nine numbers; absent: none
   * @throws Error if the character has no skeleton
   */
  constructor(
    private readonly character: Character,
    private readonly joints: readonly number[],
    private readonly rootAt: number,
    private readonly alignment: Alignment,
    private readonly turn?: Float64Array,
  ) {
    const { skeleton } = character;
    if (!skeleton) throw new Error(`${character.name} has no skeleton: there is nothing to measure.`);
    this.compiled = compileSkeleton(skeleton);
    this.dofs = new Float64Array(dofCountOf(character));
    this.world = new Float64Array(16 * skeleton.joints.length);
    this.positions = new Float64Array(3 * joints.length);
    placementMatrix(character.placements[0], character.space, NO_TRAVEL, this.toScene);
  }

  /** Fills `positions`; allocates nothing. */
  pose(timeSeconds: number): void {
    const { character, compiled, dofs, world, joints, positions, toScene: m, root } = this;
    poseAt(character, timeSeconds, dofs);
    worldMatrices(compiled, dofs, world);
    const fromRoot = this.alignment !== 'world' && joints.length > 0;
    if (fromRoot) rootInScene(m, world, 16 * joints[this.rootAt], root);
    if (fromRoot && this.turn) turnAxes(root, this.turn);
    for (let k = 0; k < joints.length; k++) {
      const o = 16 * joints[k] + 12;
      let x = m[0] * world[o] + m[4] * world[o + 1] + m[8] * world[o + 2] + m[12];
      let y = m[1] * world[o] + m[5] * world[o + 1] + m[9] * world[o + 2] + m[13];
      let z = m[2] * world[o] + m[6] * world[o + 1] + m[10] * world[o + 2] + m[14];
      if (fromRoot) {
        x -= root[12];
        y -= root[13];
        z -= root[14];
        if (this.alignment === 'turned') {
          const [dx, dy, dz] = [x, y, z];
          // The inverse rotation is the transpose, since its columns are orthonormal.
          x = root[0] * dx + root[1] * dy + root[2] * dz;
          y = root[4] * dx + root[5] * dy + root[6] * dz;
          z = root[8] * dx + root[9] * dy + root[10] * dz;
        }
      }
      positions[3 * k] = x;
      positions[3 * k + 1] = y;
      positions[3 * k + 2] = z;
    }
  }
}

/** Writes a joint's matrix in the scene, with normalised axes. */
function rootInScene(m: Float64Array, world: Float64Array, at: number, out: Float64Array): void {
  for (let c = 0; c < 4; c++) {
    const w = c === 3 ? 1 : 0;
    for (let r = 0; r < 3; r++) {
      const o = at + 4 * c;
      out[4 * c + r] = m[r] * world[o] + m[4 + r] * world[o + 1] + m[8 + r] * world[o + 2] + m[12 + r] * w;
    }
    if (c === 3) continue;
    const length = Math.hypot(out[4 * c], out[4 * c + 1], out[4 * c + 2]) || 1;
    for (let r = 0; r < 3; r++) out[4 * c + r] /= length;
  }
}

/** Multiplies the matrix's rotation by nine numbers from the right. */
function turnAxes(matrix: Float64Array, turn: Float64Array): void {
  for (let r = 0; r < 3; r++) {
    const [x, y, z] = [matrix[r], matrix[4 + r], matrix[8 + r]];
    for (let c = 0; c < 3; c++) matrix[4 * c + r] = x * turn[3 * c] + y * turn[3 * c + 1] + z * turn[3 * c + 2];
  }
}
