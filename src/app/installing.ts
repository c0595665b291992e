/** Installing the page as an app, where the browser offers it. */

import type { Offline } from '../ui/state/offline.ts';
import type { Observable } from '../ui/widgets/observable.ts';

/** Not in TypeScript's DOM library, because not every browser has it. https://wicg.github.io/manifest-incubations/ */
interface InstallPromptEvent extends Event {
  prompt(): Promise<unknown>;
}
declare global {
  interface WindowEventMap {
    beforeinstallprompt: InstallPromptEvent;
  }
}

/** The browser may offer it at any time after the page was loaded. */
export function offerInstalling(offline: Observable<Offline>, page: Pick<Window, 'addEventListener'>): void {
  const withdraw = () => offline.update(({ install: _, ...others }) => others);
  page.addEventListener('beforeinstallprompt', (event) => {
    // Phones would show a bar over the page.
    event.preventDefault();
    const install = () => {
      // It can be used once; the browser sends another one if it is cancelled.
      withdraw();
      void event.prompt();
    };
    offline.update((now) => ({ ...now, install }));
  });
  page.addEventListener('appinstalled', withdraw);
}
