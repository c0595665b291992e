/** The browser is killed while someone works: what comes back is whole, and lacks no more than the last two seconds. */
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { env } from 'node:process';
import { fileURLToPath } from 'node:url';
import { type BrowserContext, chromium, type Page } from 'playwright-core';
import { ARM, kept, ready, restore, shown } from '../../e2e/checks/autosave.ts';
import { CHROMIUM_FLAGS, findChromium } from '../../helpers/chromium.ts';
import { dropFiles } from '../../helpers/page.ts';
import { serveFolder } from '../../helpers/server.ts';
import type { Attack, Attempt } from '../attack.ts';

const DIST = fileURLToPath(new URL('../../../dist', import.meta.url));
const MAX_LOST_MS = 2000;
const EXAMPLE = {
  'samples/samples.json': JSON.stringify([{ id: 'post', label: 'Post', description: '', files: ['post.skel'] }]),
  'samples/post.skel': 'balljoint post { boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1 }',
};

interface Edit {
  readonly value: number;
  /** When it was done, by the clock of this process. */
  readonly atMs: number;
}

export const killed: Attack = {
  name: 'killed',
  shows: 'after a SIGKILL of browser or renderer in mid-edit the work is whole, and lacks no more than two seconds',
  async run(attempt) {
    const server = await serveFolder(DIST, '/marrow/');
    server.serve(EXAMPLE);
    let worst = 0;
    try {
      while (attempt.goesOn()) {
        worst = Math.max(worst, await killOnce(attempt, server.url));
        attempt.tried();
      }
    } finally {
      await server.close();
    }
    attempt.note(`up to ${Math.round(worst)} ms lost`);
  },
};

/** Returns the age of the oldest edit that was lost, in milliseconds. */
async function killOnce(attempt: Attempt, url: string): Promise<number> {
  const profile = mkdtempSync(join(tmpdir(), 'marrow-killed-'));
  try {
    let context = await open(profile);
    const edits: Edit[] = [];
    const target = attempt.random() < 0.5 ? 'browser' : 'renderer';
    try {
      const page = await pageOf(context, url);
      await dropFiles(page, [{ name: 'arm.skel', bytes: ARM }]);
      await shown(page, 'arm');
      await kept(page);
      const untilMs = performance.now() + 500 + attempt.random() * 4000;
      for (let i = 1; performance.now() < untilMs; i++) {
        await setBoth(page, i / 10_000);
        edits.push({ value: i / 10_000, atMs: performance.now() });
        // Pauses, too, in which it is saved.
        if (attempt.random() < 0.1) await page.waitForTimeout(attempt.below(1200));
      }
    } finally {
      kill(profile, target);
    }
    const killedMs = performance.now();
    await context.close().catch(() => undefined);
    context = await open(profile);
    try {
      const page = await pageOf(context, url);
      await restore(page);
      await shown(page, 'arm');
      const dofs = await page.evaluate(() => [...window.marrow.characters()[0].dofs]);
      if (dofs.length !== 9 || dofs[6] !== dofs[7]) attempt.gaveWay(`half a document: ${dofs.join(' ')}`);
      const lost = edits.filter(({ value }) => value > dofs[6]);
      const ageMs = lost.length > 0 ? killedMs - lost[0].atMs : 0;
      if (ageMs > MAX_LOST_MS) attempt.gaveWay(`${Math.round(ageMs)} ms of work lost by killing the ${target}`);
      return ageMs;
    } finally {
      await context.close();
    }
  } finally {
    rmSync(profile, { recursive: true, force: true });
  }
}

/** One step that changes two values: half of it would show. */
async function setBoth(page: Page, value: number): Promise<void> {
  await page.evaluate((v) => {
    return window.marrow.run('pose.setDofs', {
      dofs: [
        { index: 6, value: v },
        { index: 7, value: v },
      ],
    });
  }, value);
}

async function open(profile: string): Promise<BrowserContext> {
  const { path, env: extra } = findChromium();
  const all = Object.entries({ ...env, ...extra }).flatMap(([name, value]) =>
    value === undefined ? [] : [[name, value]],
  );
  return chromium.launchPersistentContext(profile, {
    executablePath: path,
    env: Object.fromEntries(all),
    args: [...CHROMIUM_FLAGS],
    viewport: { width: 960, height: 600 },
    serviceWorkers: 'block',
    reducedMotion: 'reduce',
  });
}

async function pageOf(context: BrowserContext, url: string): Promise<Page> {
  const page = context.pages()[0] ?? (await context.newPage());
  await page.goto(url);
  await ready(page);
  return page;
}

/** Kills the browser that runs on this profile, or those of its renderers that have a page. Linux only. */
function kill(profile: string, target: 'browser' | 'renderer'): void {
  const all = readdirSync('/proc').flatMap((pid) => {
    if (!/^\d+$/.test(pid)) return [];
    try {
      const command = readFileSync(`/proc/${pid}/cmdline`, 'utf8');
      const parent = Number(/^\d+ \(.*\) \S (\d+)/s.exec(readFileSync(`/proc/${pid}/stat`, 'utf8'))?.[1]);
      return [{ pid: Number(pid), parent, command }];
    } catch {
      // It has ended meanwhile.
      return [];
    }
  });
  const browser = all.find(({ command }) => command.includes(profile) && !command.includes('--type='));
  if (!browser) throw new Error('The browser has no process.');
  const descends = (pid: number): boolean =>
    pid === browser.pid || all.some((one) => one.pid === pid && one.parent !== pid && descends(one.parent));
  const renderers = all.filter(({ pid, command }) => command.includes('--type=renderer') && descends(pid));
  for (const { pid } of target === 'browser' ? [browser] : renderers) process.kill(pid, 'SIGKILL');
}
