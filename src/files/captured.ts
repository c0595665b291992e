/**
 * Facts that a motion capture file doesn't state, guessed when it is read: the space of its captures, and the meaning
 * of their position channels.
 */
import { guessSharedSpace } from '../evaluate/space/space-guess.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import type { Capture, ContentOf } from '../model/files.ts';
import { positionsMeant, withPositions } from '../model/skeleton/position-channels.ts';
import { sharedJoints } from '../model/skeleton/shared-joints.ts';

/** The content of a motion capture file, with what was guessed about it. */
export interface CapturedContent {
  readonly value: ContentOf<'bvh'>;
  readonly diagnostics: readonly Diagnostic[];
}

/**
 * Guesses the space of the captures of one file and the meaning of their position channels, and says so. Equal lists
 * of joints become one array.
 */
export function capturedContent(read: readonly Capture[], fileName: string): CapturedContent {
  const captures = read.map((capture) => {
    const joints = sharedJoints(capture.skeleton.joints);
    return joints === capture.skeleton.joints ? capture : { ...capture, skeleton: { ...capture.skeleton, joints } };
  });
  const isAdded = captures.some(({ skeleton, take }) => positionsMeant(skeleton, take) === 'add');
  const positions = isAdded ? 'add' : 'replace';
  // The size of a collapsed capture can't be measured.
  const meant = captures.map((capture) => {
    const skeleton = withPositions(capture.skeleton, positions);
    return skeleton === capture.skeleton ? capture : { ...capture, skeleton };
  });
  const message =
    'Position channels stay near 0 where OFFSETs do not, so they are added to OFFSET. ' +
    'If the skeleton comes apart, change Positions in the Character section.';
  return {
    value: { kind: 'bvh', captures: captures, guessed: { ...guessSharedSpace(meant), positions } },
    diagnostics: isAdded
      ? [withoutPlace('info', 'positions-near-zero', message, fileName, 'positions added to offsets')]
      : [],
  };
}
