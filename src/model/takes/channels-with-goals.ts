/** Takes after edits of all their channels, those of goals among them (`withCurvesOfGoals`). */
import { layerCode } from './layer-code.ts';
import type { Channel, Take } from './take.ts';

/** The take with other channels, those of its goals after those of the DOFs. */
export function withChannelsOf(take: Take, channels: readonly Channel[], dofCount: number): Take {
  return take.goals ? layerCode(take).takeOfChannels(take, channels, dofCount) : { ...take, channels };
}
