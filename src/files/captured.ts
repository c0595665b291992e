/**
 * Facts that a motion capture file doesn't state, guessed when it is read: the space of its figures, and the meaning of
 * their position channels.
 */
import { guessSharedSpace } from '../evaluate/space/space-guess.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import type { CapturedFigure, ContentOf } from '../model/files.ts';
import { positionsMeant, withPositions } from '../model/skeleton/position-channels.ts';
import { sharedJoints } from '../model/skeleton/shared-joints.ts';

/** The content of a motion capture file, with what was guessed about it. */
export interface CapturedContent {
  readonly value: ContentOf<'bvh'>;
  readonly diagnostics: readonly Diagnostic[];
}

/**
 * Guesses the space of the figures of one file and the meaning of their position channels, and says so. Equal lists
 * of joints become one array.
 */
export function capturedContent(read: readonly CapturedFigure[], fileName: string): CapturedContent {
  const figures = read.map((figure) => {
    const joints = sharedJoints(figure.skeleton.joints);
    return joints === figure.skeleton.joints ? figure : { ...figure, skeleton: { ...figure.skeleton, joints } };
  });
  const isAdded = figures.some(({ skeleton, take }) => positionsMeant(skeleton, take) === 'add');
  const positions = isAdded ? 'add' : 'replace';
  // The size of a collapsed figure can't be measured.
  const meant = figures.map((figure) => {
    const skeleton = withPositions(figure.skeleton, positions);
    return skeleton === figure.skeleton ? figure : { ...figure, skeleton };
  });
  const message =
    'Position channels stay near 0 where OFFSETs do not, so they are added to OFFSET. ' +
    'If the skeleton comes apart, change Positions in the Character section.';
  return {
    value: { kind: 'bvh', figures, guessed: { ...guessSharedSpace(meant), positions } },
    diagnostics: isAdded
      ? [withoutPlace('info', 'positions-near-zero', message, fileName, 'positions added to offsets')]
      : [],
  };
}
