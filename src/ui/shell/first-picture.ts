/**
 * What the first frame needs: the viewport in the frame of `index.html`, in sync with document, clock and theme, and
 * dropping files on the page. Menus, panels and keys follow (`rest-of-page.ts`).
 */
import type { Document } from '../../model/document.ts';
import { NOTHING_SELECTED } from '../../model/session.ts';
import { NO_TINTS, type ThemeName, type Tints } from '../../view/theme.ts';
import { startPlayer } from '../editors/transport/player.ts';
import { type Comparison, comparedIn, drawnDocument } from '../state/takes.ts';
import type { Uses } from '../state/workbench.ts';
import type { Observable } from '../widgets/observable.ts';
import { sizePanels } from './panel-sizes.ts';
import { dropTarget } from './start/drop-target.ts';
import { followTheme } from './theme.ts';

type Shown = Uses<
  'store' | 'actions' | 'viewport' | 'viewportElement' | 'transport' | 'timeline' | 'settings' | 'messages' | 'files'
>;

/**
 * Returns the current theme. `signal` removes the listeners on window and document.
 *
 * @param ready it doesn't play until then: frames that are drawn without a GPU would keep the panels from being filled
 */
export function startFirstPicture(
  root: HTMLElement,
  wb: Shown,
  ready: Promise<unknown>,
  signal: AbortSignal,
): Observable<ThemeName> {
  const { viewport, viewportElement, store, settings } = wb;
  const theme = followTheme(wb, signal);
  sizePanels(root, settings.get());
  viewportElement.classList.add('viewport');
  root.querySelector('.stage')?.prepend(viewportElement);
  // Read only when something is framed: doing so every frame would force a layout.
  viewport.camera.keepClear(() => {
    const head = root.querySelector<HTMLElement>('.stage-head');
    return head ? head.offsetTop + head.offsetHeight : 0;
  });
  const { review, takes } = wb.timeline;
  const { comparison } = takes;
  const show = () => {
    const { document, selection } = store;
    const shown = review.shown.get();
    if (shown) {
      viewport.show({ ...document, characters: [shown] }, NOTHING_SELECTED, settings.get().display, NO_TINTS);
      return;
    }
    const compared = comparison.get();
    viewport.show(drawnDocument(document, compared), selection, settings.get().display, tintsOf(document, compared));
  };
  const stops = [
    store.subscribe((now, before) => {
      if (now !== before) show();
    }),
    settings.subscribe((now, before) => {
      if (now.display !== before.display) show();
    }),
    comparison.subscribe(show),
    review.shown.subscribe(show),
  ];
  signal.addEventListener('abort', () => {
    for (const stop of stops) stop();
  });
  show();
  document.body.append(dropTarget(wb, signal));
  startPlayer(wb, signal, ready);
  return theme;
}

/** Tints of the two compared characters; none unless both exist. */
function tintsOf(document: Document, comparison: Comparison | undefined): Tints {
  const compared = comparedIn(document, comparison);
  if (!compared) return NO_TINTS;
  return new Map([
    [compared[0].drawnAs, 'comparedFirst'],
    [compared[1].drawnAs, 'comparedSecond'],
  ]);
}
