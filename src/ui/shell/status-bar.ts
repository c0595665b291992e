/** The line at the viewport's foot: what the mouse does where it is, and on the right what the view does by itself. */
import { findCharacter } from '../../model/document.ts';
import { jointName } from '../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { JointRef } from '../state/ik-hand.ts';
import { meantJoint } from '../state/joints/meant-joint.ts';
import type { Posing } from '../state/posing.ts';
import type { Uses } from '../state/workbench.ts';
import { element } from '../widgets/dom.ts';
import { isMac } from '../widgets/focus/keyboard.ts';
import { oncePerFrame } from '../widgets/frame.ts';
import { shown as numberText } from '../widgets/numbers/number-text.ts';
import { macText } from './help/mouse-gestures.ts';
import { MOUSE_AREAS, type MouseArea, type MousePlace, mouseHints } from './help/mouse-hints.ts';

const AREAS = Object.entries(MOUSE_AREAS).map(([area, selector]) => ({
  // The keys of `MOUSE_AREAS`.
  area: area as MouseArea,
  selector,
}));

/** More are found in the shortcuts. */
const MAX_HINTS = 4;

export function statusBar(
  wb: Uses<'store' | 'posing' | 'timeline' | 'viewport' | 'settings'>,
  signal: AbortSignal,
): HTMLElement {
  const line = element('footer', { class: 'status-bar', 'aria-label': 'Mouse' });
  /** The pointer in the page; undefined if it isn't there. */
  let pointer: { readonly x: number; readonly y: number } | undefined;
  let isDown = false;
  let shown = '';
  const show = () => {
    // A drag keeps the line that it began with: nothing below it is highlighted meanwhile.
    if (isDown) return;
    // What is under a resting pointer may have been opened, closed or removed.
    const under = pointer && document.elementFromPoint(pointer.x, pointer.y);
    const place = under && placeAt(wb, under);
    const hints = place ? mouseHints(place).slice(0, MAX_HINTS) : [];
    const facts = place ? viewFacts(wb) : '';
    const text = JSON.stringify([hints, facts]);
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
      element('span', { class: 'status-facts' }, facts),
    );
  };
  const showSoon = oncePerFrame(show);
  window.addEventListener(
    'pointermove',
    ({ clientX: x, clientY: y, pointerType, buttons }) => {
      if (pointerType === 'touch') return;
      isDown = buttons !== 0;
      pointer = { x, y };
      showSoon();
    },
    { signal, passive: true },
  );
  const released = () => {
    isDown = false;
    showSoon();
  };
  window.addEventListener('pointerup', released, { signal, capture: true, passive: true });
  window.addEventListener('pointercancel', released, { signal, capture: true, passive: true });
  document.documentElement.addEventListener(
    'pointerleave',
    () => {
      pointer = undefined;
      showSoon();
    },
    { signal, passive: true },
  );
  // Modifiers change what a press would do.
  for (const type of ['keydown', 'keyup'] as const) window.addEventListener(type, showSoon, { signal, passive: true });
  window.addEventListener(
    'pointerdown',
    ({ pointerType }) => {
      isDown = pointerType !== 'touch';
    },
    { signal, capture: true, passive: true },
  );
  const stops = [
    wb.viewport.pointing.onHover(showSoon),
    wb.posing.mode.subscribe(showSoon),
    wb.posing.rig.adding.subscribe(showSoon),
    wb.timeline.view.subscribe(showSoon),
    wb.store.subscribe(showSoon),
    wb.settings.subscribe(showSoon),
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
  const hovered = area === 'viewport' ? viewport.pointing.hovered : undefined;
  const skeleton = hovered && findCharacter(store.document, hovered.characterId)?.skeleton;
  const place: MousePlace = {
    area,
    cursor,
    mode: posing.mode.get(),
    isPin: posing.ik.isOverPin,
    isAdding: posing.rig.adding.get(),
    snapsToFrames: timeline.view.get().snapsToFrames,
    ...(hovered && skeleton && jointThere(posing, hovered, skeleton)),
  };
  return place;
}

/** `Follows root · Grid 0.1`. */
function viewFacts({ settings, viewport }: Uses<'settings' | 'viewport'>): string {
  const { follow, followRoot } = settings.get().display;
  const { gridStep } = viewport;
  const following = follow ? 'Follows selection' : followRoot ? 'Follows root' : '';
  return [following, gridStep === undefined ? '' : `Grid ${numberText(gridStep)}`].filter(Boolean).join(' · ');
}

/** The joint that a click means there, and what a drag moves. */
function jointThere(
  { mode, ik: { over, whatMoves } }: Posing,
  { characterId, joint }: JointRef,
  skeleton: Skeleton,
): Pick<MousePlace, 'joint' | 'moves'> {
  const lit = over?.characterId === characterId ? over.joint : joint;
  const meant = mode.get() === 'pose' ? meantJoint(skeleton, lit, joint) : lit;
  return { joint: jointName(skeleton, meant), moves: whatMoves?.(characterId, lit) };
}

/** What comes after a gesture, in one sentence with it. */
function lowerFirst(text: string): string {
  return text.charAt(0).toLowerCase() + text.slice(1);
}
