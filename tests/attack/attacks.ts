import type { Attack } from './attack.ts';
import { lostContext } from './page/lost-context.ts';

/** All attacks, in the order in which they run. */
export const ATTACKS: readonly Attack[] = [lostContext];
