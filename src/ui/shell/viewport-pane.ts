/**
 * The centre of the page: the viewport (`first-picture.ts`), the display controls along its top, and the message line
 * at its bottom. Pointer input goes to the mode's tool; what that doesn't use picks, or moves the camera.
 */
import { type Character, type Document, shownSkin } from '../../model/document.ts';
import type { Display, Selection } from '../../model/session.ts';
import type { Trail } from '../../view/motion/trail.ts';
import { Annotations } from '../../view/names/annotations.ts';
import { stageBanner } from '../editors/compare/stage-banner.ts';
import { pathFirst } from '../editors/path/path-first.ts';
import { modeBar } from '../editors/posing/mode-bar.ts';
import { withBoxSelect } from '../editors/viewport/box-select.ts';
import { type CanvasPointer, listenToCanvas } from '../editors/viewport/canvas-tools.ts';
import { displayBar } from '../editors/viewport/display-bar.ts';
import { currentCharacter, tryById } from '../state/actions/action.ts';
import { addsToSelection, selectHit } from '../state/joints/select-joints.ts';
import { onDemand } from '../state/on-demand.ts';
import type { Uses, Workbench } from '../state/workbench.ts';
import { element, setAttribute, setText, uniqueId, write } from '../widgets/dom.ts';
import { HAS_KEYS, REGION } from '../widgets/focus/focus.ts';
import { asksForMenu } from '../widgets/menu.ts';
import { setTooltip } from '../widgets/tooltip.ts';
import { heightsNote } from './heights-note.ts';
import { firstSteps } from './help/first-steps.ts';
import { messageLine } from './message-line.ts';
import { modeTools } from './mode-tools.ts';
import { pinsInFk } from './pins-in-fk.ts';
import { emptyStage } from './start/empty-stage.ts';
import { keptSession } from './start/kept-session.ts';
import { newVersion } from './start/new-version.ts';
import { takeOffer } from './take-offer.ts';

/** For screen readers. */
const VIEWPORT_KEYS =
  'Up and down arrows select the parent or child joint, with Shift left and right the previous or next sibling; left ' +
  'and right step frames, or turn a character without a take; with Control all four orbit the view. V chooses a DOF of the joint, plus and minus change it. F frames the ' +
  'selection. Shift F10 opens a menu. F6 moves to the next panel, question mark lists all shortcuts.';

export function viewportPane(wb: Workbench, signal: AbortSignal): HTMLElement {
  const { viewport, viewportElement } = wb;
  viewport.canvas.tabIndex = 0;
  setAttribute(viewport.canvas, HAS_KEYS, '');
  const keys = element('p', { class: 'off-screen', id: uniqueId('viewport-keys') }, VIEWPORT_KEYS);
  // It has keys of its own, so that screen readers pass them on.
  setAttribute(viewport.canvas, 'role', 'application');
  setAttribute(viewport.canvas, 'aria-label', 'Viewport');
  setAttribute(viewport.canvas, 'aria-describedby', keys.id);
  // The view's own buttons have labels, but it knows no tooltips.
  for (const made of viewportElement.querySelectorAll('button')) setTooltip(made, made.ariaLabel ?? undefined);
  viewport.annotate((characters, redraw, skins) => {
    const annotations = new Annotations(characters, redraw, skins);
    const { motion } = annotations;
    handTools(wb, motion.trail, signal);
    const stop = wb.transport.subscribe(({ playing, timeSeconds }, before) => {
      if (playing === before.playing) return;
      motion.isPlaying = playing;
      // What is too dear while it plays comes back.
      viewport.seek(timeSeconds);
    });
    signal.addEventListener('abort', stop);
    return annotations;
  });
  pinsInFk(wb, signal);
  const head = element('div', { class: 'stage-head' }, modeBar(wb), displayBar(wb));
  const stage = element(
    'main',
    { class: 'stage', 'aria-label': 'Viewport', 'data-panel': 'viewport' },
    viewportElement,
    keys,
    emptyStage(wb),
    head,
    fourAttachments(wb),
    guide(wb),
    element(
      'div',
      // A part of its own for F6. What leaves by itself is above, so that nothing moves under the pointer.
      { class: 'stage-foot', [REGION]: 'notes' },
      messageLine(wb),
      heightsNote(wb),
      missingNote(wb),
      weightsNote(wb),
      keptSession(wb),
      newVersion(wb),
      takeOffer(wb),
      firstSteps(wb, signal),
      stageBanner(wb),
    ),
  );
  drawCompared(wb, stage, signal);
  const showMode = () => {
    write(stage.dataset, 'mode', wb.posing.mode.get());
  };
  wb.posing.mode.subscribe(showMode);
  showMode();
  return stage;
}

/** What is compared with another program's numbers is drawn over the viewport. */
function drawCompared(wb: Workbench, stage: HTMLElement, signal: AbortSignal): void {
  const load = async () => {
    const module = await onDemand(wb.messages, 'The comparison overlay', () => import('../editors/compare/drawing.ts'));
    if (module && !signal.aborted) signal.addEventListener('abort', module.drawComparisons(wb, stage));
  };
  const stop = wb.comparing.subscribe((now) => {
    if (!now) return;
    stop();
    void load();
  });
  signal.addEventListener('abort', stop);
}

/** What the mode's tool doesn't use picks. */
function handTools(wb: Workbench, trail: Trail, signal: AbortSignal): void {
  const modeTool = pathFirst(wb, trail, modeTools(wb, signal));
  // A take that is only reviewed is not in the document: the camera moves, and nothing is selected or posed.
  const isReviewing = () => wb.timeline.review.shown.get() !== undefined;
  const tool = () => (isReviewing() ? undefined : modeTool());
  const menus = () => onDemand(wb.messages, 'The viewport’s menu', () => import('./viewport-menu.ts'));
  const { canvas } = wb.viewport;
  canvas.addEventListener(
    'keydown',
    (event) => {
      if (!asksForMenu(event)) return;
      event.preventDefault();
      event.stopPropagation();
      void menus().then((module) => module?.openMenuByKey(wb));
    },
    { signal },
  );
  const pick = (at: CanvasPointer) => {
    if (!isReviewing()) selectHit(wb, wb.viewport.pointing.pick(at.clientX, at.clientY), addsToSelection(wb, at));
  };
  listenToCanvas(
    canvas,
    withBoxSelect(wb, tool, pick),
    {
      pick,
      claim: (isTools) => wb.viewport.pointing.take(isTools),
      menu(at) {
        const isSelected = tool()?.menu?.(at) ?? false;
        void menus().then((module) => module?.openMenuAt(wb, at, isSelected));
      },
    },
    signal,
  );
}

/** The legend and numbers of the skin style *Four attachments*, loaded with its first use. */
function fourAttachments(wb: Workbench): HTMLElement {
  const place = element('div', { hidden: true });
  const stop = wb.settings.subscribe(() => show());
  const show = () => {
    if (wb.settings.get().display.skin !== 'four') return;
    stop();
    const load = () => import('../editors/skin/four-card.ts');
    void onDemand(wb.messages, 'Four attachments', load).then((module) => {
      if (module) place.replaceWith(module.fourCard(wb));
    });
  };
  show();
  return place;
}

/** Guided first steps, loaded with their first use. */
function guide(wb: Workbench): HTMLElement {
  const place = element('div', { class: 'guide-place', hidden: true });
  let shown: { readonly element: HTMLElement; end(): void } | undefined;
  wb.guide.subscribe(async (name) => {
    shown?.end();
    shown = undefined;
    write(place, 'hidden', true);
    if (!name) return;
    const module = await onDemand(wb.messages, 'The guide', () => import('./help/guides/guide-card.ts'));
    // Closed meanwhile, or another was opened.
    if (!module || wb.guide.get() !== name) return;
    shown = module.guideCard(wb, name);
    place.replaceChildren(shown.element);
    write(place, 'hidden', false);
  });
  return place;
}

/** A hint when something is missing, or nothing that is shown can be visible. */
function missingNote(wb: Uses<'store' | 'settings'>): HTMLElement {
  const note = element('p', { class: 'stage-note', role: 'status' });
  const show = () => {
    const text = whatIsMissing(wb.store.document, wb.store.selection, wb.settings.get().display);
    write(note, 'hidden', text === '');
    setText(note, text);
  };
  wb.store.subscribe(show);
  wb.settings.subscribe(show);
  show();
  return note;
}

/** A skin bound to the root as a whole looks broken: the note says what is missing, with a button. */
function weightsNote(wb: Uses<'store' | 'actions'>): HTMLElement {
  const text = element('span');
  const find = element('button', { type: 'button', class: 'link' }, 'Automatic skin weights…');
  find.addEventListener('click', () => {
    const character = withoutWeights(wb.store.document, wb.store.selection);
    if (!character) return;
    if (currentCharacter(wb) !== character) wb.store.select({ characterId: character.id });
    tryById(wb, 'skin.weights');
  });
  const note = element('p', { class: 'stage-note' }, text, ' ', find);
  const show = () => {
    const { document, selection } = wb.store;
    const character = withoutWeights(document, selection);
    const skin = character && shownSkin(character);
    write(note, 'hidden', skin === undefined);
    setText(text, skin ? `${skin.name} has no weights, so it follows only the root.` : '');
  };
  wb.store.subscribe((now, before) => {
    if (now.document.characters !== before.document.characters || now.selection !== before.selection) show();
  });
  show();
  return note;
}

/** A character whose shown skin isn't moved by its joints, since it has no weights; the selected one first. */
export function withoutWeights({ characters }: Document, { characterId }: Selection): Character | undefined {
  const waits = (character: Character) => {
    const { skeleton, isHidden } = character;
    const skin = shownSkin(character);
    return !isHidden && skeleton !== undefined && skeleton.joints.length > 1 && skin && !skin.attachments;
  };
  return characters.find((c) => c.id === characterId && waits(c)) ?? characters.find(waits);
}

/** A sentence, or empty. */
export function whatIsMissing(document: Document, selection: Selection, display: Display): string {
  const alone = document.characters.find((c) => !c.skeleton && !c.skins.length && c.takes.length > 0);
  if (alone) return `${alone.name} has only an animation. Drop its .skel file.`;
  const needsJoint = display.skin === 'heat' && selection.joint === undefined;
  return needsJoint && document.characters.some(shownSkin) ? 'Select a joint to see its weights' : '';
}
