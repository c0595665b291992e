/**
 * The page in a frame of another one (`?embed=1`): the viewport, a play button, a scrubber, and a link that opens the
 * whole page. It stores nothing and asks nothing; keys are its own only while it has the focus, and it pauses out of
 * sight.
 */
import { floorOf } from '../../edit/floor.ts';
import { intoRange, pause, play, stepFrames } from '../../edit/playback.ts';
import { fetchFiles } from '../../io/fetch-files.ts';
import { EMPTY_DOCUMENT } from '../../model/document.ts';
import { cutText } from '../../model/names/cut-text.ts';
import type { Display } from '../../model/session.ts';
import type { Uses } from '../../ui/state/workbench.ts';
import type { ThemeName } from '../../view/theme.ts';
import { type KeyTarget, listenToKeys } from '../../viewer/keys.ts';
import { Parts } from '../../viewer/parts.ts';
import { adoptStyle } from '../../viewer/style.ts';
import { selectJoint } from '../link/open-link.ts';
import type { Opener } from '../opening.ts';
import { type FromEmbedded, originOf, readMessage, type ToEmbedded } from './embed-messages.ts';

/** What an embedded page is made of. */
export interface EmbeddedParts
  extends Uses<'store' | 'transport' | 'viewport' | 'viewportElement' | 'settings' | 'messages'> {
  readonly opener: Opener;
  readonly theme: { get(): ThemeName; subscribe(listener: () => void): void };
}

/** Takes the place of what is in `root`. @param opening resolves when what the address asks for is open */
export function embed(root: HTMLElement, wb: EmbeddedParts, opening: Promise<unknown>): void {
  const host = document.createElement('div');
  host.style.cssText = 'position:fixed;inset:0;aspect-ratio:auto';
  const shadow = host.attachShadow({ mode: 'open' });
  adoptStyle(shadow);
  const { transport, viewport, store } = wb;
  const toggle = () => transport.update((now) => (now.playing ? pause(now, false) : play(now)));
  const seek = (timeSeconds: number) => transport.update((now) => ({ ...now, timeSeconds }));
  const parts = new Parts(shadow, { toggle, seek });
  parts.stage.append(wb.viewportElement);
  wb.viewportElement.style.cssText = 'position:absolute;inset:0';
  parts.add(wholePage());
  parts.setControls(true);
  root.className = '';
  root.replaceChildren(host);
  listenToKeys(parts.stage, keyTarget(wb, toggle), new AbortController().signal);

  const showTime = () => {
    const { playing, timeSeconds, range } = transport.get();
    parts.setPlaying(playing);
    parts.setTime(timeSeconds, range);
  };
  transport.subscribe(showTime);
  showTime();
  const showName = () => {
    const { characters } = store.document;
    parts.setName(characters.map(({ name }) => name).join(', ') || 'Character');
    viewport.setFloor(wb.settings.get().display.floorAtLowest ? floorOf(characters) : 0);
    void annotate(wb);
  };
  store.subscribe((now, before) => {
    if (now.document !== before.document) showName();
  });
  showName();
  const showTheme = () => parts.setTheme(wb.theme.get());
  wb.theme.subscribe(showTheme);
  showTheme();
  const showMessages = () => parts.setMessage(wordsOf(wb), store.document.characters.length === 0);
  wb.messages.list.subscribe(showMessages);
  pauseOutOfSight(host, wb);
  talk(wb, opening);
}

/** Opens the whole page, with the same link. */
function wholePage(): HTMLElement {
  const link = document.createElement('a');
  const query = location.search.replace(/^\?/, '').split('&');
  const kept = query.filter((part) => !/^embed(-origin)?(=|$)/.test(part));
  link.href = `${location.pathname}${kept.length > 0 ? `?${kept.join('&')}` : ''}`;
  link.target = '_blank';
  link.rel = 'noopener';
  link.textContent = 'Open in Marrow';
  return link;
}

function keyTarget({ viewport: { camera }, transport }: EmbeddedParts, toggle: () => void): KeyTarget {
  return {
    toggle,
    turn: (azimuth, polar) => camera.turn(azimuth, polar),
    approach: (factor) => {
      camera.view = { ...camera.view, distance: camera.view.distance * factor };
    },
    frame: () => camera.frameAll(),
    step: (frames) => transport.update((now) => intoRange(stepFrames(now, frames))),
  };
}

const annotated = new WeakSet<object>();

/** Names, paths and ghosts are fetched for links that show any. */
async function annotate({ viewport, settings, store }: EmbeddedParts): Promise<void> {
  const { names, trail, ghosts, characterNames }: Display = settings.get().display;
  const isNamed = characterNames && store.document.characters.length > 1;
  if (annotated.has(viewport) || !(names || trail || ghosts || isNamed)) return;
  annotated.add(viewport);
  const { Annotations } = await import('../../view/names/annotations.ts');
  viewport.annotate((...parts) => new Annotations(...parts));
}

function pauseOutOfSight(host: HTMLElement, { transport }: EmbeddedParts): void {
  let wasPlaying = false;
  const watching = new IntersectionObserver((entries) => {
    const isSeen = entries[entries.length - 1].isIntersecting;
    const { playing } = transport.get();
    if (isSeen && wasPlaying) transport.update(play);
    if (!isSeen) wasPlaying = playing;
    if (!isSeen && playing) transport.update((now) => pause(now, false));
  });
  watching.observe(host);
}

/** Warnings and errors, a line each. */
function wordsOf({ messages }: EmbeddedParts): string {
  const told = messages.list.get().filter(({ severity, unread }) => unread && severity !== 'info');
  return told.map(({ text }) => text).join('\n');
}

/** Follows messages of the page around, if the address names its origin, and tells it what happens. */
function talk(wb: EmbeddedParts, opening: Promise<unknown>): void {
  const named = new URLSearchParams(location.search).get('embed-origin');
  if (!named || window.parent === window) return;
  const origin = originOf(named);
  if (!origin) {
    const expected = 'expected the origin of the page around, such as https://course.example.edu';
    wb.messages.note(
      `The link asks for what can’t be: embed-origin=${cutText(named)} (${expected}).`,
      'warning',
      'until read',
    );
    return;
  }
  const tell = (message: FromEmbedded) => window.parent.postMessage(message, origin);
  const ready = () => {
    const characters = wb.store.document.characters.map(({ name }) => name);
    if (characters.length > 0) tell({ marrow: 'ready', characters, range: wb.transport.get().range });
  };
  window.addEventListener('message', (event) => {
    if (event.origin !== origin || event.source !== window.parent) return;
    const message = readMessage(event.data);
    if (typeof message === 'string') tell({ marrow: 'error', message });
    else if (message) void follow(message, wb, tell).then((isOpen) => isOpen && ready());
  });
  wb.transport.subscribe((now, before) => {
    if (now.timeSeconds === before.timeSeconds && now.playing === before.playing) return;
    tell({ marrow: 'time', time: now.timeSeconds, playing: now.playing });
  });
  wb.messages.list.subscribe((now, before) => {
    const known = new Set(before.map(({ id }) => id));
    for (const { severity, text } of now.filter(({ id }) => !known.has(id))) {
      if (severity !== 'info') tell({ marrow: 'error', message: text });
    }
  });
  void opening.then(ready);
}

/** Resolves to whether something else is open. */
async function follow(message: ToEmbedded, wb: EmbeddedParts, tell: (message: FromEmbedded) => void): Promise<boolean> {
  const { transport, viewport, store } = wb;
  switch (message.marrow) {
    case 'play':
      transport.update(play);
      break;
    case 'pause':
      transport.update((now) => pause(now, false));
      break;
    case 'seek':
      transport.update((now) => ({ ...now, timeSeconds: message.time }));
      break;
    case 'camera':
      viewport.camera.view = message.view;
      break;
    case 'select':
      if (!selectJoint(store, message.joint))
        tell({ marrow: 'error', message: `There is no joint ${cutText(message.joint)}.` });
      break;
    case 'open':
      return openInstead(message.files, wb);
  }
  return false;
}

/** What was open goes once the files are there. Resolves to whether they are. */
async function openInstead(addresses: readonly string[], { store, opener }: EmbeddedParts): Promise<boolean> {
  let areThere = false;
  await opener.open(async (signal) => {
    const files = await fetchFiles(addresses, document.baseURI, signal);
    areThere = true;
    store.replace('Open', { document: { ...EMPTY_DOCUMENT, charactersMade: store.document.charactersMade } });
    return files;
  });
  return areThere;
}
