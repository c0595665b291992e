/** The pages that are measured: the built one, and that of three.js alone. Each has a profile of its own. */
import type { Browser, Page } from 'playwright-core';
import type { ExtraFiles, StaticServer } from '../../helpers/server.ts';
import { type WatchedFrames, watchFrames } from './frame-watch.ts';
import { PEER_FOLDER } from './peer/build.ts';
import { type PeerView, queryOf } from './peer/scene.ts';
import type { Scene } from './scenes/scenes.ts';

const TIMEOUT_MS = 180_000;
const MIN_FRAMES = 5;
/** Files to open, by their paths from the page's address. */
const FILES_FOLDER = 'scene/';

export interface Watched {
  readonly frames: WatchedFrames;
  readonly openingMs?: number;
}

export interface Reference {
  /** The walker as a GLB that the built page writes. */
  readonly walker: Uint8Array;
  /** Of its canvas. */
  readonly size: PeerView['size'];
}

export interface Watching {
  /** Of the window. */
  readonly size: { readonly width: number; readonly height: number };
  /** Before frames count: shaders are compiled and caches filled. */
  readonly warmUpSeconds: number;
}

const USUAL: Watching = { size: { width: 1440, height: 900 }, warmUpSeconds: 1 };

export class Pages {
  constructor(
    private readonly browser: Browser,
    private readonly server: StaticServer,
    private readonly peer: ExtraFiles,
    private readonly seconds: number,
    private readonly shadow: boolean,
    private readonly how = USUAL,
  ) {}

  /** The built page with a scene that plays. */
  async marrow(scene: Scene): Promise<Watched> {
    const files = scene.files?.() ?? [];
    const contents = files.map(async ({ path, blob }) => [
      FILES_FOLDER + path,
      new Uint8Array(await blob.arrayBuffer()),
    ]);
    this.server.serve(Object.fromEntries(await Promise.all(contents)));
    return this.inPage(async (page) => {
      await this.openMarrow(page);
      const openingMs =
        files.length > 0
          ? await opened(
              page,
              files.map(({ path }) => path),
            )
          : undefined;
      await page.waitForFunction((count) => window.marrow.characters().length === count, scene.characters);
      await page.evaluate(async () => {
        await window.marrow.run('view.frameAll');
        window.marrow.play();
      });
      return { frames: await this.watched(page), openingMs };
    });
  }

  /** The same for three.js alone. */
  async threeAlone(scene: PeerView['scene'], { walker, size }: Reference): Promise<WatchedFrames> {
    this.server.serve({ ...this.peer, [`${PEER_FOLDER}walker.glb`]: walker });
    return this.inPage(async (page) => {
      const query = queryOf({ scene, size, shadow: this.shadow });
      await page.goto(`${this.server.url}${PEER_FOLDER}index.html${query}`);
      await page.waitForFunction(() => window.peerPlays);
      return this.watched(page);
    });
  }

  /**
   * What three.js alone is to draw as the built page does.
   * @param framesPerSecond of its take; default: as few keys as hold it
   */
  reference(framesPerSecond?: number): Promise<Reference> {
    this.server.serve();
    return this.inPage(async (page) => {
      await this.openMarrow(page);
      const { base64, size } = await page.evaluate(async (rate) => {
        const { bytes } = await window.marrow.glb({ keys: 'linear', ...(rate && { framesPerSecond: rate }) });
        const { width, height } = window.frameWatch.canvas();
        // Numbers of an array would each be a message's text and a node of its tree.
        const address = await new Promise<string>((resolve) => {
          const reader = new FileReader();
          reader.onload = () => resolve(String(reader.result));
          reader.readAsDataURL(new Blob([bytes]));
        });
        return { base64: address.slice(address.indexOf(',') + 1), size: { width, height } };
      }, framesPerSecond);
      return { walker: Buffer.from(base64, 'base64'), size };
    });
  }

  private async openMarrow(page: Page): Promise<void> {
    // The page remembers both.
    const settings = JSON.stringify({ firstSteps: false, display: { shadow: this.shadow } });
    await page.addInitScript((text) => localStorage.setItem('marrow.settings', text), settings);
    await page.goto(this.server.url);
    await page.waitForFunction(() => window.marrow?.characters().length && !document.querySelector('#app.frame'));
    // Panels are created when the page is idle.
    await page.locator('.inspector .lil-gui').first().waitFor({ state: 'attached' });
  }

  private async watched(page: Page): Promise<WatchedFrames> {
    const measured = (seconds: number) =>
      page.evaluate(([s, frames]) => window.frameWatch.measure(s, frames), [seconds, MIN_FRAMES] as const);
    await measured(this.how.warmUpSeconds);
    const frames = await measured(this.seconds);
    // The last may be about to come.
    if (frames.script.length < frames.whole.length - 1) {
      throw new Error(`Of ${frames.whole.length} frames only ${frames.script.length} were drawn.`);
    }
    return frames;
  }

  private async inPage<T>(body: (page: Page) => Promise<T>): Promise<T> {
    const context = await this.browser.newContext({
      viewport: this.how.size,
      // Camera moves are then immediate.
      reducedMotion: 'reduce',
      serviceWorkers: 'block',
      // three.js's loader fetches the pictures in a GLB from addresses that the policy of the built page refuses.
      bypassCSP: true,
    });
    try {
      const page = await context.newPage();
      page.setDefaultTimeout(TIMEOUT_MS);
      const errors: string[] = [];
      page.on('pageerror', (error) => errors.push(String(error)));
      await page.addInitScript(watchFrames);
      const result = await body(page);
      if (errors.length > 0) throw new Error(errors.join('\n'));
      return result;
    } finally {
      await context.close();
    }
  }
}

/** Opens files like one drop of all of them. Returns how long it took, without fetching them. */
async function opened(page: Page, paths: readonly string[]): Promise<number> {
  const { ms, problems } = await page.evaluate(
    async ([folder, names]) => {
      const files: File[] = [];
      for (const name of names) {
        const response = await fetch(folder + name);
        files.push(new File([await response.arrayBuffer()], name));
      }
      const begun = performance.now();
      const diagnostics = await window.marrow.open(files);
      const ms = performance.now() - begun;
      return { ms, problems: diagnostics.filter(({ severity }) => severity === 'error').map(({ message }) => message) };
    },
    [FILES_FOLDER, paths] as const,
  );
  if (problems.length > 0) throw new Error(problems.join('\n'));
  return ms;
}
