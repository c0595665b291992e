/** How each joint is marked that was compared: in lists, and where it is drawn. */
import type { FrameComparison } from './compare.ts';

/**
 * `own`: its own local matrix is wrong. `inherited`: wrong only because a parent is. `differs`: wrong, and which of
 * both isn't known, as of positions.
 */
export type JointMark = 'agrees' | 'own' | 'inherited' | 'differs';

/** The words for each mark, as lists show them. */
export const MARK_TEXTS: Readonly<Record<JointMark, string>> = {
  agrees: 'agrees',
  own: 'own error',
  inherited: 'inherited',
  differs: 'differs',
};

/** One per joint; empty if no joints were compared. */
export function jointMarks(
  { jointErrors, own, inherited }: Pick<FrameComparison, 'jointErrors' | 'own' | 'inherited'>,
  tolerance: number,
): readonly JointMark[] {
  const marks = Array.from(jointErrors, (error): JointMark => (error <= tolerance ? 'agrees' : 'differs'));
  for (const joint of inherited) marks[joint] = 'inherited';
  for (const joint of own) marks[joint] = 'own';
  return marks;
}
