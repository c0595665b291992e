/** What the panel shows of one joint or vertex. */
import type { PoseSteps } from '../../../teaching/steps/dof-steps.ts';
import type { Stages } from './stages.ts';

export interface StepsView {
  /** Cards from left to right. */
  readonly element: HTMLElement;
  /** The card of each stage, to be scrolled to. */
  readonly cards: readonly HTMLElement[];
  /** Computes all steps, and returns what the slider goes through; as many stages each time. */
  follow(pose: PoseSteps): Stages;
  /** Shows the numbers computed last. */
  fill(): void;
}
