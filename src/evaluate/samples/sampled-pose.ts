/**
 * The pose from a character's samples: at a frame the file's values, and between frames interpolated.
 *
 *                         nearest          linear                      cubic
 *     lengths, weights    that frame's     linear                      Catmull-Rom
 *     a single angle      that frame's     the shorter way round       Catmull-Rom, each step the shorter way
 *     whole rotations     that frame's     slerp of the quaternions    Catmull-Rom of the quaternions, normalised
 *
 * Angles stay near those of the frames. Where the file jumps (179° to −179°, a step of 2°), the pose continues from the
 * first number in the first half and approaches the other in the second: the jump is halfway and changes no rotation.
 */
import { turnedNear } from '../../math/euler.ts';
import type { Samples } from '../../model/takes/samples.ts';
import type { CompiledTake } from '../compiled-take.ts';
import type { PoseRotations } from '../rotations/pose-rotations.ts';
import type { SampledJoints } from './sampled-joints.ts';
import { betweenEulers, betweenQuaternions } from './sampled-rotations.ts';
import { catmullRom, frameAt, sampleRow } from './sampling.ts';

/**
 * Writes those of the first `count` DOFs that follow the take's samples to `out`; others are left alone.
 * @param joints of the same take
 * @param rotations receives the joints' rotations, if samples give whole ones
 */
export function samplePose(
  samples: Samples,
  take: CompiledTake,
  joints: SampledJoints,
  timeSeconds: number,
  out: Float64Array,
  count: number,
  rotations?: PoseRotations,
): void {
  const frame = frameAt(samples, timeSeconds);
  const row = Math.floor(frame);
  const part = frame - row;
  if (part === 0 || samples.interpolation === 'nearest') {
    sampleRow(samples, take.columns, part < 0.5 ? row : row + 1, out, count);
    return;
  }
  betweenPlain(samples, joints, row, part, out, count);
  betweenAngles(samples, joints, row, part, out);
  betweenEulers(samples, joints, row, part, out, rotations);
  betweenQuaternions(samples, joints, row, part, out);
}

function betweenPlain(
  { values, scales, frameCount, interpolation }: Samples,
  { plainDofs, plainColumns }: SampledJoints,
  row: number,
  part: number,
  out: Float64Array,
  count: number,
): void {
  const width = scales.length;
  for (let i = 0; i < plainDofs.length; i++) {
    // Morph weights that the take has and the character lacks.
    if (plainDofs[i] >= count) continue;
    const column = plainColumns[i];
    const at = row * width + column;
    const here = values[at];
    const next = values[at + width];
    let value = here + (next - here) * part;
    if (interpolation === 'cubic') {
      const before = row > 0 ? values[at - width] : 2 * here - next;
      const after = row + 2 < frameCount ? values[at + 2 * width] : 2 * next - here;
      value = catmullRom(before, here, next, after, part);
    }
    out[plainDofs[i]] = value * scales[column];
  }
}

function betweenAngles(
  { values, scales, frameCount, interpolation }: Samples,
  { angleDofs, angleColumns }: SampledJoints,
  row: number,
  part: number,
  out: Float64Array,
): void {
  const width = scales.length;
  for (let i = 0; i < angleDofs.length; i++) {
    const column = angleColumns[i];
    const scale = scales[column];
    const at = row * width + column;
    const here = values[at] * scale;
    const asWritten = values[at + width] * scale;
    const next = turnedNear(asWritten, here);
    let value = here + (next - here) * part;
    if (interpolation === 'cubic') {
      const before = row > 0 ? turnedNear(values[at - width] * scale, here) : 2 * here - next;
      const after = row + 2 < frameCount ? turnedNear(values[at + 2 * width] * scale, next) : 2 * next - here;
      value = catmullRom(before, here, next, after, part);
    }
    out[angleDofs[i]] = part < 0.5 ? value : value + (asWritten - next);
  }
}
