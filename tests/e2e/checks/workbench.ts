/** A character against the reference, in any browser. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import type { Check } from '../../helpers/check.ts';
import { expectClose } from '../../helpers/close.ts';
import { undoAll } from '../../helpers/one-page.ts';
import { dropFiles } from '../../helpers/page.ts';
import { conformance, sharedBytes } from '../../helpers/shared.ts';

interface Frame {
  readonly time: number;
  readonly world: readonly (readonly number[])[];
  readonly vertices?: readonly number[];
  readonly positions?: readonly (readonly number[])[];
}
interface AnimPose {
  readonly tolerance: { readonly float64: number; readonly float32: number };
  readonly cases: readonly { readonly skel: string; readonly frames: readonly Frame[] }[];
}

export const WASP = ['wasp.skel', 'wasp.skin', 'wasp_walk.anim'];
export const course = (names: readonly string[]) =>
  names.map((name) => ({ name, bytes: sharedBytes(`data/cse169/${name}`) }));
/** Waits for the opening example, or what was opened last. */
export const opened = (page: Page, name?: string) =>
  page.waitForFunction(
    (wanted) => window.marrow?.characters().some((c) => wanted === undefined || c.name === wanted),
    name,
  );
export const names = (page: Page) => page.evaluate(() => window.marrow.characters().map((c) => c.name));

/** Only with the reference files. */
export const REFERENCE: readonly Check[] = [
  {
    name: 'shows the wasp walking exactly as the reference says, scrubbed anywhere',
    async run({ page }) {
      await opened(page);
      await undoAll(page);
      await dropFiles(page, course(WASP));
      await opened(page, 'wasp');
      await expect.poll(() => names(page)).toEqual(['wasp']);
      const { tolerance, cases } = conformance<AnimPose>('anim-pose.json');
      for (const frame of cases[0].frames) {
        const shown = await page.evaluate((time) => {
          window.marrow.seek(time);
          return { world: window.marrow.worldMatrices(), vertices: window.marrow.vertices() };
        }, frame.time);
        expectClose(shown.world.flat(), frame.world.flat(), tolerance.float64);
        const listed = (frame.vertices ?? []).flatMap((v) => shown.vertices.slice(3 * v, 3 * v + 3));
        expectClose(listed, (frame.positions ?? []).flat(), tolerance.float32);
      }
    },
  },
];
