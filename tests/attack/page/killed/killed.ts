/** The browser is killed while someone works: what comes back is whole, and lacks no more than the last two seconds. */
import { fileURLToPath } from 'node:url';
import { serveFolder } from '../../../helpers/server.ts';
import { stillPage } from '../../../helpers/still.ts';
import type { Attack, Attempt } from '../../attack.ts';
import { AUTOSAVE, DOWNLOAD, SAVE } from './large.ts';
import { MANY_KEYS } from './many-keys.ts';
import { Profile } from './profile.ts';
import { DRAG, EDIT, TABS } from './small.ts';
import type { Work } from './work.ts';

const DIST = fileURLToPath(new URL('../../../../dist', import.meta.url));
const MAX_LOST_MS = 2000;
const WORKS: readonly Work[] = [AUTOSAVE, SAVE, EDIT, DRAG, DOWNLOAD, TABS, MANY_KEYS];
/** Kills of one profile, each after the work of the one before was restored. */
const KILLS = 6;
/** Of one kind of work. */
interface Tally {
  kills: number;
  whileStoring: number;
  worstMs: number;
}

export const killed: Attack = {
  name: 'killed',
  shows: 'after a SIGKILL of browser or renderer the work is whole, and lacks no more than two seconds; so are files',
  async run(attempt) {
    const server = await serveFolder(DIST, '/marrow/');
    server.serve(await stillPage(DIST));
    const tallies = new Map<string, Tally>();
    try {
      for (let i = 0; attempt.goesOn(); i++) {
        const work = WORKS[i % WORKS.length];
        const tally = tallies.get(work.name) ?? { kills: 0, whileStoring: 0, worstMs: 0 };
        tallies.set(work.name, tally);
        await killAgain(attempt, server.url, work, tally);
      }
    } finally {
      await server.close();
    }
    for (const [name, { kills, whileStoring, worstMs }] of tallies) {
      attempt.note(`${name} ${kills}, ${whileStoring} while storing, ${Math.round(worstMs)} ms lost`);
    }
  },
};

async function killAgain(attempt: Attempt, url: string, work: Work, tally: Tally): Promise<void> {
  const profile = new Profile(url, work.before);
  try {
    let pages = await work.begin(profile);
    for (let i = 0; i < KILLS && attempt.goesOn(); i++) {
      const target = attempt.random() < 0.5 ? 'browser' : 'renderer';
      const check = await work.run(pages, profile, attempt);
      tally.kills++;
      const { storingMs } = profile;
      if (storingMs > 0) tally.whileStoring++;
      const killedMs = performance.now();
      await profile.kill(target);
      attempt.tried();
      const { lostMs, broken, pages: again } = await check(profile, killedMs);
      tally.worstMs = Math.max(tally.worstMs, lostMs);
      if (lostMs > MAX_LOST_MS) {
        const storing = storingMs > 0 ? `, which was storing for ${Math.round(storingMs)} ms` : '';
        attempt.gaveWay(`${work.name}: ${Math.round(lostMs)} ms lost by killing the ${target}${storing}`);
      }
      if (broken !== undefined) {
        attempt.gaveWay(`${work.name}, ${target} killed: ${broken}`);
        return;
      }
      pages = again;
    }
  } catch (error) {
    attempt.gaveWay(`${work.name}: ${error instanceof Error ? error.stack : String(error)}`);
  } finally {
    await profile.close();
  }
}
