/** Dark or light: the system's, unless the person says otherwise. */
import type { ThemeName } from '../../view/theme.ts';
import { type Observable, observable } from '../kit/observable.ts';
import type { Uses } from '../state/workbench.ts';

/** Gives the theme that is shown, and tells when the page's colours have changed: for what is drawn rather than styled. */
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
    document.documentElement.dataset.theme = theme;
    // The browser's own bar goes on where the menu bar ends, also where the theme is not the system's.
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
