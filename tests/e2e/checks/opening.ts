/** The dialog for opening files of browsers that only have an input for that. */
import type { Check } from '../../helpers/check.ts';
import { ARM, ready, shown } from './page.ts';

export const OPENING: readonly Check[] = [
  {
    name: 'Ctrl+O opens the files that are picked',
    options: { before: () => void delete window.showOpenFilePicker },
    async run({ page }) {
      await ready(page);
      const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.keyboard.press('Control+o')]);
      await chooser.setFiles({ name: 'arm.skel', mimeType: '', buffer: Buffer.from(ARM) });
      await shown(page, 'arm');
    },
  },
];
