/**
 * Firefox for the browser tests: a stock one (`firefox-path.ts`), driven by Playwright over WebDriver BiDi, without a
 * display; WebGL is drawn in software where there is no GPU. What the protocol lacks, no test for Firefox may use:
 * touch, double clicks, `fill` into fields that wait for `change`, colour schemes (always light) and motion (always
 * reduced).
 */
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { env } from 'node:process';
import { type Browser, firefox } from 'playwright-core';
import { firefoxPath } from './firefox-path.ts';

export interface Firefox {
  readonly browser: Browser;
  /** The folder of its downloads, of which Playwright doesn't tell. */
  readonly downloads: string;
}

/** The browser, or why there is none: the beginning of a sentence. */
export type FoundFirefox = Firefox | { readonly missing: string };

/**
 * Launches Firefox. One that was not asked for is passed over if it doesn't start or can't draw.
 *
 * @throws Error if the one that MARROW_FIREFOX names is not there or doesn't start
 */
export async function launchFirefox(): Promise<FoundFirefox> {
  const path = firefoxPath();
  if (!path) return { missing: 'Firefox not found' };
  try {
    return await launch(path);
  } catch (error) {
    if (env.MARROW_FIREFOX) throw error;
    const [why] = String(error).split('\n');
    return { missing: `Firefox (${path}) can’t be used (${why})` };
  }
}

async function launch(path: string): Promise<Firefox> {
  const downloads = mkdtempSync(join(tmpdir(), 'marrow-downloads-'));
  process.once('exit', () => rmSync(downloads, { recursive: true, force: true }));
  const browser = await firefox.launch({
    channel: 'moz-firefox',
    executablePath: path,
    downloadsPath: downloads,
    timeout: 20_000,
    // Without it, Firefox on Linux has no WebGL where there is no display.
    env: { ...definedIn(env), MOZ_WEBGL_FORCE_EGL: '1' },
    firefoxUserPrefs: {
      'webgl.force-enabled': true,
      // What the contexts of Chromium's tests emulate.
      'ui.prefersReducedMotion': 1,
      'layout.css.prefers-color-scheme.content-override': 1,
    },
  });
  try {
    withoutMediaFeatures(browser);
    const page = await browser.newPage();
    const draws = await page.evaluate(() => document.createElement('canvas').getContext('webgl2') !== null);
    await page.close();
    if (!draws) throw new Error('it has no WebGL 2');
    return { browser, downloads };
  } catch (error) {
    await browser.close();
    throw error;
  }
}

function definedIn(variables: NodeJS.ProcessEnv): Record<string, string> {
  return Object.fromEntries(
    Object.entries(variables).flatMap(([name, value]) => (value === undefined ? [] : [[name, value]])),
  );
}

/** What is behind Playwright's public browser, as far as it is used here. */
interface Behind {
  readonly _connection: {
    toImpl(browser: Browser): { _browserSession: { send(method: string, given: unknown): Promise<unknown> } };
  };
}

/** Playwright emulates media features in every context, and can't be told not to; Firefox 153 doesn't know how. */
function withoutMediaFeatures(browser: Browser): void {
  // Not public: there is no other way to leave out a command.
  const session = (browser as unknown as Behind)._connection.toImpl(browser)._browserSession;
  const send = session.send.bind(session);
  session.send = (method, given) =>
    method === 'emulation.setMediaFeaturesOverride' ? Promise.resolve({}) : send(method, given);
}
