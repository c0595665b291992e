/** What others can look at: links, and pages with the characters in them. Loaded on first use. */

import { wordsOf } from '../model/display-words.ts';
import { sentenceOf } from '../model/failure.ts';
import type { Messages } from '../ui/state/messages.ts';
import type { Sharing } from '../ui/state/workbench.ts';
import { numbersOf } from '../view/camera/view-numbers.ts';
import type { AttributeName } from '../viewer/attributes.ts';
import type { Runs } from '../worker/client.ts';
import { forMessage } from '../worker/tracked-takes.ts';
import { type CopiedParts, copyLink } from './link/copy-link.ts';
import { numberText } from './link/number-text.ts';

/** What is shared, and how. */
export interface SharedParts extends CopiedParts {
  readonly messages: Pick<Messages, 'note'>;
  readonly worker: Runs<'webPage'>;
  readonly disk: { download(name: string, content: Blob): void };
}

export function sharingOf(parts: SharedParts): Sharing {
  const { store, worker, messages, disk } = parts;
  const made = () => {
    // As it is: where the page is looked at may follow another system.
    const theme = document.documentElement.dataset.theme === 'dark' ? 'dark' : 'light';
    const characters = store.document.characters.map(forMessage);
    return worker.run('webPage', { characters, theme, attributes: attributesOf(parts) });
  };
  return {
    copyLink: () => copyLink(parts),
    webPage: async () => (await made()).page,
    async saveWebPage() {
      try {
        const { name, page } = await made();
        disk.download(name, page);
        messages.note(`${name} was saved: ${Math.ceil(page.size / 1000)} kB.`);
      } catch (error) {
        messages.note(`The page could not be made. ${sentenceOf(error)}`, 'error');
      }
    },
  };
}

/** The element's, by which it shows what the viewport shows. */
function attributesOf({ transport, settings, viewport }: SharedParts): Readonly<Record<string, string>> {
  const { timeSeconds, playing, loop, rate } = transport.get();
  const { display } = settings.get();
  const { clientWidth, clientHeight } = viewport.canvas;
  const said: Partial<Record<AttributeName | 'autoplay' | 'data-aspect', string>> = {
    controls: '',
    ...(playing && { autoplay: '' }),
    ...(loop !== 'once' && { loop: '' }),
    ...(rate !== 1 && { speed: numberText(rate) }),
    time: numberText(timeSeconds),
    camera: numbersOf(viewport.camera.view).map(numberText).join(','),
    'data-aspect': numberText(clientWidth / clientHeight),
    show: wordsOf(display).join(' '),
    ...(display.followRoot && { follow: '' }),
  };
  return said;
}
