/** What edits frames, or a take as a whole, would change its channels and not what moves it besides. */
import type { Take } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';

const BESIDE = ['attached', 'layers', 'goals'] as const;

const WHAT: Readonly<Record<(typeof BESIDE)[number], readonly [has: string, first: string]>> = {
  attached: ['follows another character in spans of its time', 'Detach it first: Edit > Detach.'],
  layers: [
    'has layers',
    'Flatten them first: Keys > Layers > Flatten layers, or run "layers.flatten". To keep the layers, do it on a duplicate of the take.',
  ],
  goals: [
    'has limbs with goals',
    'Flatten limbs first: Edit > Limbs > Flatten limbs, or run "limbs.flatten". To keep the goals, do it on a duplicate of the take.',
  ],
};

/**
 * Refuses a take with layers, with goals of limbs, or that is attached in spans of its time, and says what to do first.
 * @param what is refused; default: all
 */
export function refuseLayers(take: Take, what: readonly (typeof BESIDE)[number][] = BESIDE): void {
  const found = what.find((part) => take[part]);
  if (!found) return;
  const [has, first] = WHAT[found];
  throw new CommandError(`${take.name} ${has}, and this changes takes as a whole. ${first}`);
}
