/** Random arguments, most of them in this process, since one of its own takes a quarter of a second. */
import { COMMANDS } from '../../../src/cli/run.ts';
import { command } from '../../helpers/command.ts';
import type { Attempt } from '../attack.ts';
import { randomArguments } from './arguments.ts';
import { marrow } from './process.ts';
import { makeScene } from './scene.ts';
import { tell } from './tell.ts';
import { leftovers } from './whole.ts';

/** None of them has much to do. */
const MAX_MS = 10_000;

/** Tries this many. Returns the longest time, in milliseconds. */
export async function tryArguments(attempt: Attempt, count: number): Promise<number> {
  const scene = makeScene();
  let longest = 0;
  try {
    for (let i = 0; i < count; i++) {
      const args = randomArguments(COMMANDS[attempt.below(COMMANDS.length)], attempt.below);
      const isProcess = attempt.below(20) === 0;
      const begun = performance.now();
      const ended = await (isProcess ? marrow(args, scene.folder) : inProcess(args, scene.folder));
      const ms = performance.now() - begun;
      longest = Math.max(longest, ms);
      const late = ms > MAX_MS ? [`it took ${Math.round(ms)} ms`] : [];
      tell(attempt, args, ended, [...leftovers(scene.folder), ...late]);
    }
  } finally {
    scene.remove();
  }
  return longest;
}

/** An exception, which the process would tell in its own words, is a fault. */
async function inProcess(args: readonly string[], folder: string) {
  try {
    return await command(args, folder, async () => 'takes/t0.bvh\n');
  } catch (error) {
    return { err: `${error instanceof Error ? error.stack : error}` };
  }
}
