/**
 * Bones: one that is longer or shorter than usual in this take by 5 % and 1 cm; and an arm or leg bone whose length
 * differs from that of the other side by 8 % and 2 cm, flagged at the first frame.
 */
import { displaces } from '../../model/skeleton/joint-types.ts';
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import { between, type Survey } from '../survey.ts';
import { type Check, flagOf, largest, Span } from './check.ts';

const OFF = 0.05;
const OFF_METRES = 0.01;
const UNEVEN = 0.08;
const UNEVEN_METRES = 0.02;

export class Bones implements Check {
  private readonly spans: readonly { readonly joint: number; readonly length: number; readonly span: Span }[];
  private readonly flags: Flag[] = [];

  constructor(
    private readonly frames: TakeFrames,
    private readonly survey: Survey,
  ) {
    const { joints } = frames.skeleton;
    // The hips and all above them carry the body over the ground: what is between them is no bone.
    const moving = new Set<number>();
    for (let j = survey.hips; j >= 0; j = joints[j].parent) moving.add(j);
    // Bones of joints that only rotate have one length.
    this.spans = joints.flatMap(({ parent, motion }, joint) => {
      if (moving.has(joint) || parent < 0 || !displaces(motion)) return [];
      return [{ joint, length: survey.lengthOf(joint), span: new Span(1) }];
    });
  }

  frame(frame: number, points: Float64Array): void {
    const { skeleton } = this.frames;
    for (const { joint, length, span } of this.spans) {
      const off = Math.abs(between(points, joint, skeleton.joints[joint].parent) - length);
      if (off > OFF_METRES && off > OFF * length) span.add(frame, off);
      else if (span.isOver(frame)) this.close(joint, span);
    }
  }

  private close(joint: number, span: Span): void {
    const { frames } = this;
    if (span.isOpen) this.flags.push(flagOf(frames, 'bone', span.start, span.end, span.amount, joint));
    span.clear();
  }

  end(): readonly Flag[] {
    for (const { joint, span } of this.spans) this.close(joint, span);
    return [...this.uneven(), ...largest(this.flags)];
  }

  private uneven(): Flag[] {
    const { frames, survey } = this;
    const { hinges } = survey;
    return [false, true].flatMap((isKnee) => {
      const [left, right] = hinges.filter((hinge) => hinge.isKnee === isKnee);
      if (!left || !right) return [];
      return (['middle', 'lower'] as const).flatMap((end) => {
        const [a, b] = [survey.lengthOf(left[end]), survey.lengthOf(right[end])];
        const off = Math.abs(a - b);
        if (off <= UNEVEN_METRES || off <= UNEVEN * Math.max(a, b)) return [];
        return [flagOf(frames, 'bone', 0, 0, off, a < b ? left[end] : right[end])];
      });
    });
  }
}
