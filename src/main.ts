/** The page's entry: nothing but wiring. */
import { beginAutosave } from './app/autosave/begin.ts';
import { DiskHandles } from './app/disk-handles.ts';
import { SampleDisplay } from './app/example-display.ts';
import { fetchOpening, fetchSample, listSamples } from './app/examples.ts';
import { Faults } from './app/faults.ts';
import { fileActions } from './app/file-actions.ts';
import { followRange } from './app/follow-range.ts';
import { makeTakesWhenIdle } from './app/idle-takes.ts';
import { offerInstalling } from './app/installing.ts';
import { markUnsaved } from './app/leaving.ts';
import { Opener } from './app/opening.ts';
import { scriptingApi } from './app/scripting.ts';
import { Unsaved } from './app/unsaved.ts';
import { DEFAULT_PLAYBACK } from './edit/playback.ts';
import { Store } from './edit/store.ts';
import type { DumpFile } from './files/open/open-in-steps.ts';
import { download } from './io/download.ts';
import { onLaunched } from './io/launched.ts';
import { trustOwnScripts } from './io/trusted-scripts.ts';
import type { Character } from './model/document.ts';
import type { Display } from './model/session.ts';
import { startFirstPicture } from './ui/shell/first-picture.ts';
import { restOfPage } from './ui/shell/rest-of-page.ts';
import type { DumpComparison } from './ui/state/dump-comparison.ts';
import type { GuideName } from './ui/state/guide.ts';
import type { KeptOffer } from './ui/state/kept-offer.ts';
import type { AskedManual } from './ui/state/manual-link.ts';
import { Messages } from './ui/state/messages.ts';
import { NOT_OFFLINE, type Offline } from './ui/state/offline.ts';
import { onDemand, whenIdle } from './ui/state/on-demand.ts';
import { Posing } from './ui/state/posing.ts';
import { rememberedSettings } from './ui/state/settings.ts';
import { Timeline } from './ui/state/timeline.ts';
import type { ActionList, DialogName, Loading, Workbench } from './ui/state/workbench.ts';
import { oncePerFrame } from './ui/widgets/frame.ts';
import { observable } from './ui/widgets/observable.ts';
import { Viewport } from './view/viewport.ts';
import { WorkerPool } from './worker/pool.ts';

trustOwnScripts();
const root = document.getElementById('app');
if (!root) throw new Error('index.html has no element "app".');

/** In a frame of another page (`app/embed/embed.ts`). */
const isEmbedded = location.search.includes('embed=1');
const store = new Store();
const transport = observable(DEFAULT_PLAYBACK);
const messages = new Messages();
const loading = observable<Loading | undefined>(undefined);
const viewportElement = document.createElement('div');
const viewport = viewportIn(viewportElement);
const worker = new WorkerPool(() => new Worker(new URL('./worker/entry.ts', import.meta.url), { type: 'module' }));
const reducesMotion = () => window.matchMedia('(prefers-reduced-motion: reduce)').matches;
const offerSpaces = async (opened: readonly Character[]) => {
  const offers = await import('./app/space-offers.ts').catch(() => undefined);
  offers?.offerSpaces({ store, messages, camera: viewport.camera }, opened);
};
const opener = new Opener({
  store,
  transport,
  messages,
  loading,
  viewport,
  camera: viewport.camera,
  worker,
  reducesMotion,
  compare,
  offerSpaces,
});
const timeline = new Timeline();
/** Listed with the menus, after the first picture. */
let list = () => {};
const samples = new Promise<void>((resolve) => {
  list = resolve;
}).then(() => listSamples(document.baseURI));
const listed = () => {
  list();
  return samples;
};
let fillPanels = (_when: Promise<unknown>) => {};
const panelsFilled = new Promise((resolve) => {
  fillPanels = resolve;
});
const unsaved = new Unsaved(store);
const handles = new DiskHandles();

const settings = rememberedSettings(
  () => (isEmbedded ? undefined : localStorage),
  (now) => sampleDisplay.without(now),
);
const sampleDisplay = new SampleDisplay(settings, store);

/** What the page can do once everything is loaded. */
let actions: ActionList = {
  all: () => [],
  label: () => '',
  refusal: () => undefined,
  checked: () => undefined,
  run: () => undefined,
  attempt: () => undefined,
};

const workbench: Workbench = {
  store,
  get actions() {
    return actions;
  },
  viewport,
  viewportElement,
  transport,
  timeline,
  posing: new Posing(),
  settings,
  messages,
  loading,
  dialog: observable<DialogName | undefined>(undefined),
  files: fileActions({
    store,
    messages,
    loading,
    opener,
    samples,
    showSample: (shows) => sampleDisplay.show(shows),
    unsaved,
    handles,
    disk: { download },
    framesPerSecond: () => transport.get().framesPerSecond,
    timeline,
    settings,
    worker,
    pictured: { viewport, transport },
  }),
  kept: observable<KeptOffer | undefined>(undefined),
  offline: observable<Offline>(NOT_OFFLINE),
  comparing: observable<DumpComparison | undefined>(undefined),
  guide: observable<GuideName | undefined>(undefined),
  manual: observable<AskedManual | undefined>(undefined),
};

const faults = new Faults(workbench);
followRange(store, transport);
makeTakesWhenIdle(store, (run) => whenIdle(workbench, run));
opener.subscribe(({ given, files }) => {
  handles.note(given);
  const replaced = unsaved.opened(files);
  if (replaced.length) {
    const text = `Unsaved changes to ${replaced.join(', ')} were replaced. Undo restores them.`;
    messages.note(text, 'warning', 'until read');
  }
});
markUnsaved(workbench.files, window);
offerInstalling(workbench.offline, window);
const forever = new AbortController().signal;
const theme = startFirstPicture(root, workbench, panelsFilled, forever);
viewport.setFramesPerSecond(transport.get().framesPerSecond);
transport.subscribe((now) => {
  viewport.setPlayedRange(now.range);
  viewport.setFramesPerSecond(now.framesPerSecond);
});

// Uncaught errors are shown in the page, since few have the console open.
const WRONG = 'Something went wrong. Your work is still here.';
window.addEventListener('error', ({ error, message }) => {
  // Sizes that change each other settle in the next frame; browsers tell it as an error.
  if (!message.startsWith('ResizeObserver loop')) faults.tell(WRONG, error ?? message);
});
window.addEventListener('unhandledrejection', ({ reason }) => faults.tell(WRONG, reason));

const opening = location.search.length > 1 ? openAddress() : openSample();
if (isEmbedded) void startEmbedded(root);
else startWorkbench(root);

/** Nothing of the workbench but its viewport. */
async function startEmbedded(frame: HTMLElement): Promise<void> {
  frame.replaceChildren(viewportElement);
  fillPanels(opening);
  const { embed } = await import('./app/embed/embed.ts');
  embed(frame, { ...workbench, opener, theme }, opening);
}

/** Menus, panels and keys, and what keeps work. */
function startWorkbench(frame: HTMLElement): void {
  const setActions = (all: ActionList) => {
    actions = all;
  };
  const rest = restOfPage(frame, opening, {
    beside: listed,
    mount: ({ mountWorkbench }) => mountWorkbench(frame, workbench, { theme, setActions }, forever),
  });
  fillPanels(rest.filled);
  window.marrow = scriptingApi(workbench, opener, rest);
  onLaunched((files) => void opener.open(() => files), window);
  void beginAutosave({ ...workbench, camera: viewport.camera, opener, worker, unsaved, handles }, opening);

  // Only the built page has a service worker.
  if (import.meta.env.PROD && 'serviceWorker' in navigator) void opening.then(() => whenIdle(workbench, storePage));
}

/** Stores the page for working offline. What fails in it isn't needed. */
async function storePage(): Promise<void> {
  const module = await import('./app/offline.ts').catch(() => undefined);
  await module?.startOffline({
    offline: workbench.offline,
    workers: navigator.serviceWorker,
    reload: () => location.reload(),
    onReturn: (listener) =>
      document.addEventListener('visibilitychange', () => {
        if (document.visibilityState === 'visible') listener();
      }),
    nowMs: Date.now,
  });
}

function compare(dumps: readonly DumpFile[]): void {
  const load = () => import('./app/comparing.ts');
  onDemand(messages, 'The comparison', load).then((module) => module?.compareDropped(workbench, worker, dumps));
}

/** What the address asks for. */
async function openAddress() {
  const module = await onDemand(messages, 'The link', () => import('./app/link/open-link.ts'));
  const parts = { ...workbench, opener, sampleDisplay, samples: listed, reducesMotion, openSample };
  return module ? module.openLink(parts, location.search) : openSample();
}

/** The opening example: a walking character. @param display what a link asks for besides */
function openSample(display: Partial<Display> = {}) {
  return opener.open(
    async (signal) => {
      const read = await fetchOpening(document.baseURI, signal);
      if (read) {
        sampleDisplay.show({ ...read.shows, ...display });
        for (const text of read.texts) handles.set(text.path, text);
        return { read: read.files };
      }
      const [first] = await listSamples(document.baseURI);
      if (!first) return [];
      sampleDisplay.show({ ...first.shows, ...display });
      return fetchSample(first, document.baseURI, signal);
    },
    { asOpeningSample: true },
  );
}

/** Reports missing WebGL2 in the page and stops. */
function viewportIn(element: HTMLElement): Viewport {
  try {
    return new Viewport(element, (draw) => oncePerFrame(draw, 'draw'), {
      textureFailed: (_id, texture) =>
        messages.note(`The texture ${texture.name} can’t be read by this browser; drawn without texture.`, 'warning'),
      drawingFailed: (error) => faults.tell('The viewport can’t be drawn. Your work can still be saved.', error),
    });
  } catch (error) {
    document.body.textContent =
      'Marrow needs WebGL 2, which is not available in this browser. Hardware acceleration may be turned ' +
      'off in its settings.';
    throw error;
  }
}
