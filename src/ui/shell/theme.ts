/** Dark or light: the system's, unless the person says otherwise. */
import type { Uses } from '../state/workbench.ts';

/** @param changed after the page's colours have changed, for what is drawn rather than styled */
export function followTheme(wb: Uses<'viewport' | 'settings'>, signal: AbortSignal, changed: () => void): void {
  const system = window.matchMedia('(prefers-color-scheme: light)');
  let shown = '';
  const show = () => {
    const { theme } = wb.settings.get();
    const next = theme === 'system' ? (system.matches ? 'light' : 'dark') : theme;
    if (next === shown) return;
    shown = next;
    document.documentElement.dataset.theme = next;
    // The browser's own bar goes on where the menu bar ends, also where the theme is not the system's.
    const surface = getComputedStyle(document.documentElement).getPropertyValue('--surface');
    for (const meta of document.querySelectorAll<HTMLMetaElement>('meta[name=theme-color]')) meta.content = surface;
    wb.viewport.setTheme(next);
    changed();
  };
  system.addEventListener('change', show, { signal });
  const stop = wb.settings.subscribe(show);
  signal.addEventListener('abort', stop);
  show();
}
