/**
 * A frame of the built page while the walking example plays with three layers, both legs and both arms in IK: all script of
 * the main thread, in thread time. Goal: at most twice that of the same page without, measured in turn.
 */
import { existsSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { bench, describe } from 'vitest';
import { median } from '../../src/evaluate/retarget/ground.ts';
import { withPage } from '../helpers/page.ts';
import { drawNothing, hasChromium, meter } from './page-meter.ts';

const WINDOWS = 9;
const LIMBS = [
  { joints: ['thigh_l', 'shin_l', 'foot_l'], orient: true, mirrored: true },
  { joints: ['upper_arm_l', 'forearm_l', 'hand_l'], mirrored: true },
];
const options = {
  size: { width: 700, height: 500 },
  before: drawNothing,
  drawn: true,
  walking: true,
  fullMotion: true,
};

/** Adds layers and limbs to the walking example, with keys in each. */
async function addControls(page: Page): Promise<void> {
  await page.evaluate(async (limbs) => {
    const [{ id: characterId, joints }] = window.marrow.characters();
    const named = (name: string) => joints.findIndex((joint) => joint.name === name);
    const run = async (id: string, args: object) => window.marrow.run(id, { characterId, ...args });
    const dofs = Array.from({ length: 12 }, (_, k) => 12 + k);
    for (let layer = 0; layer < 3; layer++) {
      await run('layers.add', {});
      for (const timeSeconds of [0, 0.4, 0.8]) await run('pose.key', { timeSeconds, dofs });
    }
    for (const limb of limbs) await run('limbs.add', { ...limb, joints: limb.joints.map(named) });
    for (const limb of [0, 1, 2, 3]) {
      await run('limbs.switch', { timeSeconds: 0, limb, to: 'ik' });
      for (const timeSeconds of [0.3, 0.6, 0.9]) await run('limbs.key', { timeSeconds, limb });
    }
  }, LIMBS);
}

const ready = (page: Page) => page.waitForFunction(() => window.marrow?.characters().length);

describe.skipIf(!hasChromium())('limbs and layers on the page (skipped where there is no Chromium)', () => {
  bench(
    'a frame with them',
    async () => {
      if (!existsSync('dist/index.html')) throw new Error('There is no built page: "npm run build" first.');
      const [plain, rigged]: number[][] = [[], []];
      await withPage(async ({ page }) => {
        await ready(page);
        const plainMs = await meter(page);
        await withPage(async ({ page: other }) => {
          await ready(other);
          await addControls(other);
          const riggedMs = await meter(other);
          for (let w = 0; w < WINDOWS; w++) {
            plain.push(await plainMs());
            rigged.push(await riggedMs());
          }
        }, options);
      }, options);
      const ratio = median(rigged.map((ms, i) => ms / plain[i]));
      console.log(
        `${median(rigged).toFixed(2)} ms of script a frame, without ${median(plain).toFixed(2)}: ${ratio.toFixed(2)} times`,
      );
    },
    { iterations: 1, time: 0, warmupIterations: 0, warmupTime: 0 },
  );
});
