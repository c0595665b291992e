/**
 * Numbers that are written of the joints of a block of frames: positions, velocities and rotations, as rows of arrays.
 * Velocities are central differences, so those of a row are written with the next one.
 */
import type { Floats } from './data-array.ts';

/** Most frames of a block: what is computed of them fits into the processor's nearer memory. */
export const BLOCK = 32;

/** Numbers that are written of each joint, frame after frame. */
export interface JointRows {
  /** 3, 4, 4 and 6 numbers per joint. */
  readonly positions: Floats;
  readonly worldQuat: Floats;
  readonly localQuat: Floats;
  /** The first two columns of the local rotation. */
  readonly local6d: Floats;
  /** 3 per joint, a second: central differences of positions in doubles, one-sided at the ends. */
  readonly velocities: Floats;
  /** Rows per second. */
  readonly fps: number;
}

/** A block of frames as it was posed. */
export interface PosedBlock {
  readonly jointCount: number;
  /** Rotations, four numbers per frame, joint by joint. */
  readonly local: Float64Array;
  readonly world: Float64Array;
  /** Frame after frame x y z of each joint, and more. */
  readonly allPoints: Float64Array;
  /** How many numbers a frame has in `allPoints`. */
  readonly width: number;
}

/** Writes the joints of one block of frames after the other into the arrays of a take. */
export class JointRowWriter {
  /** Positions in the two rows before the block: six per joint. */
  private readonly trail: Float64Array;

  constructor(private readonly block: PosedBlock) {
    this.trail = new Float64Array(6 * block.jointCount);
  }

  /**
   * Writes the rows of a joint from `row` on, and velocities of the row before.
   *
   * @param count of frames, at most `BLOCK`
   */
  write(rows: JointRows, row: number, count: number, j: number): void {
    const { trail } = this;
    const { local, world, allPoints, width, jointCount } = this.block;
    const { positions, worldQuat, localQuat, local6d, velocities, fps } = rows;
    const t = 6 * j;
    let ax = trail[t];
    let ay = trail[t + 1];
    let az = trail[t + 2];
    let bx = trail[t + 3];
    let by = trail[t + 4];
    let bz = trail[t + 5];
    for (let b = 0; b < count; b++) {
      const at = (row + b) * jointCount + j;
      const o = 4 * (BLOCK * j + b);
      const p = b * width + 3 * j;
      const px = allPoints[p];
      const py = allPoints[p + 1];
      const pz = allPoints[p + 2];
      positions[3 * at] = px;
      positions[3 * at + 1] = py;
      positions[3 * at + 2] = pz;
      if (row + b > 0) {
        // From the row before that one, if there is one.
        const rate = row + b > 1 ? fps / 2 : fps;
        const v = 3 * (at - jointCount);
        velocities[v] = (px - ax) * rate;
        velocities[v + 1] = (py - ay) * rate;
        velocities[v + 2] = (pz - az) * rate;
        ax = bx;
        ay = by;
        az = bz;
      } else {
        ax = px;
        ay = py;
        az = pz;
      }
      bx = px;
      by = py;
      bz = pz;
      worldQuat[4 * at] = world[o];
      worldQuat[4 * at + 1] = world[o + 1];
      worldQuat[4 * at + 2] = world[o + 2];
      worldQuat[4 * at + 3] = world[o + 3];
      const x = local[o];
      const y = local[o + 1];
      const z = local[o + 2];
      const w = local[o + 3];
      localQuat[4 * at] = x;
      localQuat[4 * at + 1] = y;
      localQuat[4 * at + 2] = z;
      localQuat[4 * at + 3] = w;
      local6d[6 * at] = 1 - 2 * (y * y + z * z);
      local6d[6 * at + 1] = 2 * (x * y + w * z);
      local6d[6 * at + 2] = 2 * (x * z - w * y);
      local6d[6 * at + 3] = 2 * (x * y - w * z);
      local6d[6 * at + 4] = 1 - 2 * (x * x + z * z);
      local6d[6 * at + 5] = 2 * (y * z + w * x);
    }
    trail[t] = ax;
    trail[t + 1] = ay;
    trail[t + 2] = az;
    trail[t + 3] = bx;
    trail[t + 4] = by;
    trail[t + 5] = bz;
  }

  /** Writes velocities of the last of `count` rows. */
  end({ velocities, fps }: JointRows, count: number): void {
    const { trail } = this;
    const { jointCount } = this.block;
    const o = 3 * jointCount * (count - 1);
    for (let j = 0; j < jointCount; j++) {
      for (let k = 0; k < 3; k++) velocities[o + 3 * j + k] = (trail[6 * j + 3 + k] - trail[6 * j + k]) * fps;
    }
  }
}
