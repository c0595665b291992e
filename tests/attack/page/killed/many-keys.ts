/** Edits of a take that no file holds, of thousands of channels: what is stored of it is what has changed. */
import type { Page } from 'playwright-core';
import { kept, shown } from '../../../e2e/checks/autosave.ts';
import { dropFiles } from '../../../helpers/page.ts';
import { restored } from './small.ts';
import { Edits, forAWhile, type Work } from './work.ts';

const JOINTS = 4000;
/** First and last joint: their channels are stored far apart. Each edit gives all one value: half of one would show. */
const EDITED = [3, 4, 3 * JOINTS + 1, 3 * JOINTS + 2];

export const MANY_KEYS: Work = {
  name: 'many keys',
  async begin(profile) {
    const page = await profile.open();
    const joints = Array.from({ length: JOINTS - 1 }, (_, i) => `balljoint j${i} { offset ${i / 100} 0 0 }`);
    await dropFiles(page, [{ name: 'star.skel', bytes: `balljoint centre {\n${joints.join('\n')}\n}` }]);
    await shown(page, 'star');
    await page.evaluate(async (edited) => {
      // Drawn in software, it would take seconds for each frame.
      await window.marrow.run('character.setHidden', { ids: [window.marrow.characters()[0].id], hidden: true });
      await window.marrow.run('take.create', { range: [0, 1] });
      await window.marrow.run('pose.setDofs', { dofs: edited.map((index) => ({ index, value: 0 })) });
      await window.marrow.run('pose.key');
    }, EDITED);
    await kept(page);
    return [page];
  },
  async run([page], _profile, attempt) {
    const [base] = await valuesOf(page);
    const edits = new Edits();
    await forAWhile(page, attempt, async (i) => {
      await page.evaluate(
        ([channels, value]) =>
          window.marrow.run('keys.set', { keys: channels.map((channel) => ({ channel, indices: [0] })), value }),
        [EDITED, base + i / 1000] as const,
      );
      edits.note(base + i / 1000);
    });
    return async (again, killedMs) => {
      const back = await restored(await again.open(), 'star');
      const [value, ...others] = [...new Set(await valuesOf(back))];
      const broken =
        others.length > 0 || Number.isNaN(value) ? `half an edit: ${value} ${others.join(' ')}` : undefined;
      return { pages: [back], lostMs: edits.lostMs(value, killedMs), ...(broken && { broken }) };
    };
  },
};

/** Of the edited channels. */
function valuesOf(page: Page): Promise<number[]> {
  return page.evaluate(
    (channels) => channels.map((channel) => window.marrow.keys(channel)[0]?.value ?? Number.NaN),
    EDITED,
  );
}
