/** The dialog for opening files of browsers that only have an input for that. */
import type { Check } from '../../helpers/check.ts';
import { ARM, ready, shown } from './page.ts';

export const OPENING: readonly Check[] = [
  {
    name: 'Ctrl+O opens the files that are picked',
    options: { before: () => void delete window.showOpenFilePicker },
    async run({ page }) {
      // Asked for before the page is used: a key could overtake the request to intercept the dialog.
      const asked = page.waitForEvent('filechooser');
      await ready(page);
      await page.keyboard.press('Control+o');
      const chooser = await asked;
      await chooser.setFiles({ name: 'arm.skel', mimeType: '', buffer: Buffer.from(ARM) });
      await shown(page, 'arm');
    },
  },
];
