/** The built command against arguments, files, disks, pipes and kills. */
import type { Attack } from '../attack.ts';
import { tryArguments } from './try-arguments.ts';
import { tryFiles, tryFolders, tryStreams } from './try-files.ts';
import { tryDisks, tryKills, tryPipes, tryTogether } from './try-outputs.ts';

export const commandLine: Attack = {
  name: 'command-line',
  shows: 'the command ends in words, with a documented code, and its outputs are whole or untouched',
  async run(attempt) {
    let [longest, most, killed, kills] = [0, 0, 0, 0];
    for (let round = 0; attempt.goesOn(); round++) {
      longest = Math.max(longest, await tryArguments(attempt, 300));
      most = Math.max(most, await tryFiles(attempt, 15));
      const count = 14;
      killed += await tryKills(attempt, count);
      kills += count;
      await tryDisks(attempt, 4);
      if (round % 4 === 1) await tryFolders(attempt);
      if (round % 4 === 2) await tryPipes(attempt);
      if (round % 4 === 3) {
        await tryStreams(attempt);
        await tryTogether(attempt);
      }
    }
    attempt.note(`${killed} of ${kills} killed in time`);
    attempt.note(`arguments took up to ${Math.round(longest)} ms`);
    attempt.note(`hard files up to ${Math.round(most)} MB`);
  },
};
