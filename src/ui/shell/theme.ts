/** Dark or light: the system's theme unless the user has chosen one. */

import type { ThemeName } from '../../view/theme.ts';
import type { Uses } from '../state/workbench.ts';
import { write } from '../widgets/dom.ts';
import { type Observable, observable } from '../widgets/observable.ts';

/** Returns the current theme, which notifies when the page's colours change: for what is drawn rather than styled. */
export function followTheme(
  { settings, viewport }: Uses<'settings' | 'viewport'>,
  signal: AbortSignal,
): Observable<ThemeName> {
  const system = window.matchMedia('(prefers-color-scheme: light)');
  const wanted = (): ThemeName => {
    const { theme } = settings.get();
    return theme === 'system' ? (system.matches ? 'light' : 'dark') : theme;
  };
  const shown = observable(wanted());
  const show = () => {
    const theme = shown.get();
    write(document.documentElement.dataset, 'theme', theme);
    // The browser's own bar matches the menu bar, even if the theme isn't the system's.
    const surface = getComputedStyle(document.documentElement).getPropertyValue('--surface');
    for (const meta of document.querySelectorAll<HTMLMetaElement>('meta[name=theme-color]')) meta.content = surface;
    viewport.setTheme(theme);
  };
  shown.subscribe(show);
  const follow = () => shown.set(wanted());
  system.addEventListener('change', follow, { signal });
  const stop = settings.subscribe(follow);
  signal.addEventListener('abort', stop);
  show();
  return shown;
}
