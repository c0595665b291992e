/**
 * The heart of the page in Firefox, where there is one: the same checks as in Chromium. One browser for all of them,
 * which ends with the file.
 */
import { afterAll, describe, expect, it } from 'vitest';
import type { Check } from '../helpers/check.ts';
import { launchFirefox } from '../helpers/firefox.ts';
import { withPage } from '../helpers/page.ts';
import { hasShared } from '../helpers/shared.ts';
import { RESTORING } from './checks/autosave.ts';
import { CAPTURE } from './checks/capture.ts';
import { CURVES } from './checks/curves.ts';
import { IK } from './checks/ik.ts';
import { OPENING } from './checks/opening.ts';
import { BY_HAND, LOOK } from './checks/page.ts';
import { POSING } from './checks/posing.ts';
import { BY_DOWNLOAD } from './checks/saving.ts';
import {
  expectTexture,
  expectVertices,
  IDENTITY,
  LISTS,
  MOVED,
  madeUp,
  openSkinning,
  REFERENCE_SKINS,
  SCALED,
} from './checks/skinning.ts';
import { REFERENCE } from './checks/workbench.ts';

const CHECKS: readonly Check[] = [
  ...OPENING,
  ...CAPTURE,
  ...(hasShared ? REFERENCE : []),
  ...BY_HAND,
  ...LOOK,
  ...CURVES,
  ...POSING,
  ...IK,
  ...BY_DOWNLOAD,
  ...RESTORING,
];

const firefox = await launchFirefox();

if ('missing' in firefox) {
  // Skinning is one more.
  const what = `${firefox.missing}: its ${CHECKS.length + 1} tests are skipped (set MARROW_FIREFOX).`;
  console.log(what);
  describe.skip(what, () => it('needs Firefox'));
} else {
  const { browser } = firefox;
  afterAll(() => browser.close());

  it('in Firefox, vertices on the GPU are the core’s, and a texture is drawn', async () => {
    const { page, problems, close } = await openSkinning(browser);
    try {
      await expectVertices(page, madeUp(LISTS, [IDENTITY, MOVED, SCALED]));
      if (hasShared) {
        for (const [, make] of REFERENCE_SKINS) await expectVertices(page, make());
        await expectTexture(page);
      }
      expect(problems).toEqual([]);
    } finally {
      await close();
    }
  });

  for (const { name, options, run } of CHECKS) it(`in Firefox, ${name}`, () => withPage(run, { ...options, firefox }));
}
