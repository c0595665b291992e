/**
 * The middle of the page: the viewport, kept in step with the document, a strip of what is drawn over its top edge, and
 * the message line over its foot. A click picks; a drag is the camera's.
 */
import { NOTHING_SELECTED } from '../model/session.ts';
import { SKIN_STYLES } from './actions/view-actions.ts';
import { actionsOf, runAction } from './actions.ts';
import { button, element, keepsFocusElsewhere } from './dom.ts';
import { icon } from './icons.ts';
import { isMac } from './keys.ts';
import { menuButton } from './menu.ts';
import { itemOf } from './menu-entries.ts';
import { messageLine } from './message-line.ts';
import { shortcutsFor, shortcutText } from './shortcuts.ts';
import type { Workbench } from './workbench.ts';

/** A press that moved further was a drag. */
const CLICK_PIXELS = 4;
const TOGGLES = ['bones', 'axes', 'names', 'normals', 'grid', 'shadow', 'orthographic'] as const;

export function viewportPane(wb: Workbench, signal: AbortSignal): HTMLElement {
  const { viewport, viewportElement, store, settings } = wb;
  viewportElement.classList.add('viewport');
  viewport.canvas.tabIndex = 0;
  viewport.canvas.setAttribute('role', 'img');
  viewport.canvas.setAttribute('aria-label', 'Viewport. Arrow keys up and down go from joint to joint.');
  const show = () => viewport.show(store.document, store.selection, settings.get().display);
  const stops = [
    store.subscribe((now, before) => {
      if (now !== before) show();
    }),
    settings.subscribe((now, before) => {
      if (now.display !== before.display) show();
    }),
  ];
  signal.addEventListener('abort', () => {
    for (const stop of stops) stop();
  });
  pickOnClick(wb, signal);
  show();
  const hint = emptyHint(wb);
  return element(
    'main',
    { class: 'stage', 'aria-label': 'Viewport', 'data-panel': 'viewport' },
    viewportElement,
    hint,
    displayStrip(wb),
    messageLine(wb),
  );
}

function pickOnClick(wb: Workbench, signal: AbortSignal): void {
  const { canvas } = wb.viewport;
  let down: PointerEvent | undefined;
  canvas.addEventListener(
    'pointerdown',
    (event) => {
      down = event.button === 0 && event.isPrimary ? event : undefined;
      canvas.focus({ preventScroll: true });
    },
    { signal },
  );
  canvas.addEventListener(
    'pointerup',
    (event) => {
      const from = down;
      down = undefined;
      if (!from || Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) > CLICK_PIXELS) return;
      const hit = wb.viewport.pick(event.clientX, event.clientY);
      wb.store.select(hit ?? NOTHING_SELECTED);
    },
    { signal },
  );
}

function displayStrip(wb: Workbench): HTMLElement {
  const actions = actionsOf(wb);
  const strip = element('div', { class: 'display-strip tools', role: 'toolbar', 'aria-label': 'What is drawn' });
  const skin = keepsFocusElsewhere(element('button', { type: 'button', class: 'tool text-tool' }));
  const boxes = keepsFocusElsewhere(button('Boxes', { class: 'tool' }, icon('boxes'), () => {}));
  const within = (prefix: string) => actions.filter((a) => a.id.startsWith(prefix));
  menuButton(skin, 'Skin', () => within('draw.skin.').map((a) => itemOf(wb, a)));
  menuButton(boxes, 'Boxes', () => within('draw.boxes.').map((a) => itemOf(wb, a)));
  strip.append(skin, boxes);
  const shown: (() => void)[] = [];
  for (const what of TOGGLES) {
    const action = actions.find((a) => a.id === `draw.${what}`);
    if (!action || typeof action.label !== 'string' || !action.icon) continue;
    const made = keepsFocusElsewhere(
      button(action.label, { class: 'tool' }, icon(action.icon), () => runAction(wb, action.id)),
    );
    const [shortcut] = shortcutsFor(action, wb.settings.get());
    if (shortcut) made.title = `${action.label} (${shortcutText(shortcut, isMac)})`;
    shown.push(() => made.setAttribute('aria-pressed', String(action.checked?.(wb) ?? false)));
    strip.append(made);
  }
  const show = () => {
    const { display } = wb.settings.get();
    const label = SKIN_STYLES.find(([style]) => style === display.skin)?.[1] ?? '';
    skin.replaceChildren(icon('skin'), display.skin === 'heat' ? 'Influence' : label, icon('fold'));
    skin.setAttribute('aria-label', `Skin: ${label}`);
    skin.title = 'Skin';
    boxes.setAttribute('aria-pressed', String(display.boxes !== 'hidden'));
    for (const update of shown) update();
  };
  wb.settings.subscribe(show);
  show();
  return strip;
}

function emptyHint(wb: Workbench): HTMLElement {
  const open = element('button', { type: 'button', class: 'link' }, 'open files');
  open.addEventListener('click', () => wb.files.open());
  const hint = element(
    'div',
    { class: 'stage-hint' },
    element('p', {}, 'Drop character files here'),
    element('p', { class: 'faint' }, '.skel .skin .morph .anim .rig, a folder or a zip, or ', open),
  );
  const show = () => {
    hint.hidden = wb.store.document.characters.length > 0;
  };
  wb.store.subscribe(show);
  show();
  return hint;
}
