/** Makes characters from the content of a `.bvh`: for each root its skeleton, and its columns of the rows. */

import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';
import type { Capture } from '../../model/files.ts';
import { rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { rangeOfSamples, type Samples } from '../../model/takes/samples.ts';
import { restChannel, SAMPLED, type Take } from '../../model/takes/take.ts';
import type { Root } from './hierarchy.ts';
import type { MotionRows } from './motion.ts';

/** Named after the file; if there are several, also after their roots. */
export function capturesOf(stem: string, roots: readonly Root[], motion: MotionRows): readonly Capture[] {
  const names = roots.length === 1 ? [stem] : namesOf(stem, roots);
  if (motion.frameCount === 0) return roots.map(({ joints }, r) => ({ skeleton: { name: names[r], joints } }));
  const width = motion.values.length / motion.frameCount;
  let from = 0;
  return roots.map(({ joints }, r) => {
    const skeleton: Skeleton = { name: names[r], joints };
    const scales = scalesOf(joints);
    const first = from;
    from += scales.length;
    if (scales.length === 0) return { skeleton };
    const values = scales.length === width ? motion.values : columns(motion, width, first, scales.length);
    return { skeleton, take: takeOf(skeleton, samplesOf(skeleton, motion, values, scales)) };
  });
}

/** `take Hips`, `take Hips 2`. */
function namesOf(stem: string, roots: readonly Root[]): string[] {
  const taken = new Set<string>();
  /** The next number to try: ten thousand roots may have one name. */
  const next = new Map<string, number>();
  return roots.map(({ name }, r) => {
    const base = `${stem} ${name || r + 1}`;
    let unique = base;
    for (let i = next.get(base) ?? 2; taken.has(unique); i++) {
      unique = `${base} ${i}`;
      next.set(base, i + 1);
    }
    taken.add(unique);
    return unique;
  });
}

function scalesOf(joints: Root['joints']): Float64Array {
  return Float64Array.from(
    joints.flatMap((joint) => dofsOf(joint.motion).map(({ unit }) => (unit === 'angle' ? RADIANS_PER_DEGREE : 1))),
  );
}

/** Columns [first, first + count) of every row. */
function columns({ values, frameCount }: MotionRows, width: number, first: number, count: number): Float64Array {
  const own = new Float64Array(frameCount * count);
  for (let frame = 0; frame < frameCount; frame++) {
    const at = frame * width + first;
    for (let k = 0; k < count; k++) own[frame * count + k] = values[at + k];
  }
  return own;
}

function samplesOf(skeleton: Skeleton, motion: MotionRows, values: Float64Array, scales: Float64Array): Samples {
  const { frameCount, frameSeconds } = motion;
  const firstChannel = rootDofCount(skeleton);
  return { frameCount, frameSeconds, startSeconds: 0, firstChannel, values, scales, interpolation: 'linear' };
}

function takeOf({ name }: Skeleton, samples: Samples): Take {
  const { firstChannel, scales } = samples;
  const channels = Array.from({ length: firstChannel + scales.length }, (_, c) =>
    c < firstChannel ? restChannel() : SAMPLED,
  );
  return { name, range: rangeOfSamples(samples), channels, samples };
}
