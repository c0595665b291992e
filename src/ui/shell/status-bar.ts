/** The line at the foot of the page: what the mouse does where it is. */
import { findCharacter } from '../../model/document.ts';
import { jointName } from '../../model/joint-name.ts';
import { element } from '../kit/dom.ts';
import { oncePerFrame } from '../kit/frame.ts';
import { isMac } from '../kit/keyboard.ts';
import type { Uses } from '../state/workbench.ts';
import { macText } from './mouse-gestures.ts';
import { MOUSE_AREAS, type MouseArea, type MousePlace, mouseHints } from './mouse-hints.ts';

const AREAS = Object.entries(MOUSE_AREAS).map(([area, selector]) => ({
  // The keys of `MOUSE_AREAS`.
  area: area as MouseArea,
  selector,
}));

export function statusBar(wb: Uses<'store' | 'posing' | 'timeline' | 'viewport'>, signal: AbortSignal): HTMLElement {
  const line = element('footer', { class: 'status-bar', 'aria-label': 'Mouse' });
  let under: Element | undefined;
  let isDown = false;
  let shown = '';
  const show = () => {
    // A drag keeps the line that it began with: nothing below it is highlighted meanwhile.
    if (isDown) return;
    const place = under && placeAt(wb, under);
    const hints = place ? mouseHints(place) : [];
    const text = JSON.stringify(hints);
    if (text === shown) return;
    shown = text;
    line.replaceChildren(
      ...hints.map(([what, how]) =>
        element(
          'span',
          { class: 'status-hint' },
          element('kbd', {}, isMac ? macText(how) : how),
          ` ${lowerFirst(what)}`,
        ),
      ),
    );
  };
  const showSoon = oncePerFrame(show);
  window.addEventListener(
    'pointermove',
    ({ target, pointerType, buttons }) => {
      if (pointerType === 'touch') return;
      isDown = buttons !== 0;
      under = target instanceof Element ? target : undefined;
      showSoon();
    },
    { signal, passive: true },
  );
  window.addEventListener(
    'pointerdown',
    ({ pointerType }) => {
      isDown = pointerType !== 'touch';
    },
    { signal, capture: true, passive: true },
  );
  const stops = [
    wb.viewport.onHover(showSoon),
    wb.posing.mode.subscribe(showSoon),
    wb.posing.rig.adding.subscribe(showSoon),
    wb.timeline.view.subscribe(showSoon),
  ];
  signal.addEventListener('abort', () => {
    for (const stop of stops) stop();
  });
  return line;
}

function placeAt(
  { store, posing, timeline, viewport }: Uses<'store' | 'posing' | 'timeline' | 'viewport'>,
  target: Element,
) {
  const found = AREAS.find(({ selector }) => target.closest(selector));
  if (!found) return undefined;
  const { area } = found;
  const cursor = target instanceof HTMLElement ? target.style.cursor : '';
  const hovered = area === 'viewport' ? viewport.hovered : undefined;
  const skeleton = hovered && findCharacter(store.document, hovered.characterId)?.skeleton;
  const place: MousePlace = {
    area,
    cursor,
    mode: posing.mode.get(),
    isAdding: posing.rig.adding.get(),
    snapsToFrames: timeline.view.get().snapsToFrames,
    ...(hovered && skeleton && { joint: jointName(skeleton, hovered.joint) }),
  };
  return place;
}

/** What comes after a gesture, in one sentence with it. */
function lowerFirst(text: string): string {
  return text.charAt(0).toLowerCase() + text.slice(1);
}
