/**
 * All mistakes that the search knows: kinematics, skinning, channels. Codes of pairs are in this order. The search, the
 * sentences and the test files go by this list.
 */
import { CHANNELS } from './channels.ts';
import { KINEMATICS } from './kinematics.ts';
import type { Mistake } from './mistake.ts';
import { SKINNING } from './skinning.ts';

/** All known mistakes, in the order in which they are tried. */
export const CATALOGUE: readonly Mistake[] = [...KINEMATICS, ...SKINNING, ...CHANNELS];
