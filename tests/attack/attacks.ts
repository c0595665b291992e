import type { Attack } from './attack.ts';
import { commandLine } from './command/command-line.ts';
import { extremes } from './page/extremes.ts';
import { killed } from './page/killed/killed.ts';
import { longDay } from './page/long-day.ts';
import { lostContext } from './page/lost-context.ts';
import { openClose } from './page/open-close.ts';
import { randomWalk } from './page/random-walk.ts';
import { readers } from './readers/readers.ts';

/** All attacks, in the order in which they run. */
export const ATTACKS: readonly Attack[] = [
  lostContext,
  openClose,
  longDay,
  extremes,
  killed,
  randomWalk,
  readers,
  commandLine,
];
