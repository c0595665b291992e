/** The built command against arguments, files, disks, pipes and kills. */
import type { Attack, Attempt } from '../attack.ts';
import { tryArguments } from './try-arguments.ts';
import { tryFiles, tryFolders, tryStreams } from './try-files.ts';
import { tryDisks, tryKills, tryPipes, tryTogether } from './try-outputs.ts';

/** Take a minute or so each: one in each round. */
const LONG: readonly ((attempt: Attempt) => Promise<void>)[] = [tryFolders, tryPipes, tryStreams, tryTogether];

export const commandLine: Attack = {
  name: 'command-line',
  shows: 'the command ends in words, with a documented code, and its outputs are whole or untouched',
  async run(attempt) {
    let [longest, most, killed, kills] = [0, 0, 0, 0];
    // Short runs come to one of these, by chance.
    const first = attempt.below(LONG.length);
    for (let round = 0; attempt.goesOn(); round++) {
      longest = Math.max(longest, await tryArguments(attempt, 300));
      most = Math.max(most, await tryFiles(attempt, 15));
      const count = 14;
      killed += await tryKills(attempt, count);
      kills += count;
      await tryDisks(attempt, 4);
      await LONG[(round + first) % LONG.length](attempt);
    }
    attempt.note(`${killed} of ${kills} killed in time`);
    attempt.note(`arguments took up to ${Math.round(longest)} ms`);
    attempt.note(`hard files up to ${Math.round(most)} MB`);
  },
};
