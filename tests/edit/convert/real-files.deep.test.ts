/** Every real file of motion capture through `.skel` and `.anim` and back, by the evaluators of both sides. */
import { describe, expect, it } from 'vitest';
import { formatOf } from '../../../src/files/readers.ts';
import { animOf, bvhOf, skelOf } from '../../../src/files/save/character-files.ts';
import { readWhole } from '../../../src/formats/reader.ts';
import type { Capture, FileContent } from '../../../src/model/files.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { ALL_BVH, readCaptures, sharedCaptures } from '../../helpers/bvh-files.ts';
import { writeFile } from '../../helpers/write-file.ts';
import { characterOf, frameTimes, heightOf, worstDistance } from './round-trip.ts';

/** Of the capture's height: how far any joint may be off, in any frame. */
const TOLERANCE = 1e-9;

/** Of each file: more of them take longer, and show nothing else. */
const MAX_FRAMES = 100;

/** The beginning of a capture. */
function beginningOf({ skeleton, take }: Capture): Capture {
  const { samples } = take ?? {};
  if (!take || !samples || samples.frameCount <= MAX_FRAMES) return { skeleton, ...(take && { take }) };
  const values = samples.values.slice(0, MAX_FRAMES * samples.scales.length);
  const [start] = take.range;
  const range = [start, start + (MAX_FRAMES - 1) * samples.frameSeconds] as const;
  return { skeleton, take: { ...take, range, samples: { ...samples, frameCount: MAX_FRAMES, values } } };
}

/** Through the text of a file. */
function throughFile(content: FileContent, name: string): FileContent {
  const written = writeFile(content, name);
  const read = formatOf(name)?.reader(name);
  if (!written || !read) throw new Error(`${name} has no format.`);
  const { value, diagnostics } = readWhole(read, written.text);
  if (!value) throw new Error(`${name} was not read: ${diagnostics[0].message}`);
  return value;
}

function asSkelAndAnim({ skeleton, take }: Capture): Capture {
  const own = skelOf({ skeleton, pose: filePose(skeleton, 0) });
  if (!own) throw new Error('There is a skeleton.');
  const skel = throughFile({ kind: 'skel', skeletons: [own] }, 'x.skel');
  const anim = take && throughFile({ kind: 'anim', take: animOf({ skeleton }, take) }, 'x.anim');
  if (skel.kind !== 'skel' || (anim && anim.kind !== 'anim')) throw new Error('Files are of the kind asked for.');
  return { skeleton: skel.skeletons[0], ...(anim && { take: anim.take }) };
}

function throughBvh(capture: Capture, framesPerSecond: number): Capture {
  const [{ capture: bvh }] = bvhOf(characterOf(capture), framesPerSecond);
  const written = writeFile({ kind: 'bvh', captures: [bvh] }, 'x.bvh');
  return readCaptures('x.bvh', written?.text ?? '')[0];
}

describe('a real .bvh as .skel and .anim', () => {
  it.each(ALL_BVH)('%s has every joint and End Site where it was, there and back', (name) => {
    for (const capture of sharedCaptures(name).map(beginningOf)) {
      const height = heightOf(capture);
      const times = frameTimes(capture);
      const there = asSkelAndAnim(capture);
      const toSkel = worstDistance(characterOf(capture), characterOf(there), times) / height;
      const back = throughBvh(there, 1 / (capture.take?.samples?.frameSeconds ?? 1));
      const roundTrip = worstDistance(characterOf(capture), characterOf(back), times) / height;
      const again = asSkelAndAnim(back);
      const secondTrip = worstDistance(characterOf(there), characterOf(again), times) / height;
      if (process.env.SAY_ERRORS) console.log(name, toSkel, roundTrip, secondTrip);
      expect(Math.max(toSkel, roundTrip, secondTrip)).toBeLessThan(TOLERANCE);
      expect(back.take?.samples?.frameCount).toBe(capture.take?.samples?.frameCount);
      expect(back.skeleton.joints).toHaveLength(capture.skeleton.joints.length);
    }
  });
});
