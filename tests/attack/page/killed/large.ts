/** Work on a take of many keys, which takes long to store, to save and to zip. All its keys have one value: none has another. */
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { unzipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { ARM, kept, shown } from '../../../e2e/checks/autosave.ts';
import { dropFiles } from '../../../helpers/page.ts';
import type { Profile } from './profile.ts';
import { restored } from './small.ts';
import { Edits, type Found, type Work } from './work.ts';

const KEYS = 30_000;
/** Translation and turn of the root, turn of the elbow. */
const CHANNELS = 9;
const EDITED = [3, 4, 5, 6];

/** Stores all changed keys with each edit, slowly; the kill comes meanwhile. */
export const AUTOSAVE: Work = {
  name: 'autosave',
  before: slowStore,
  begin: openTake,
  async run([page], profile, attempt) {
    const [base] = await valuesOf(page);
    const edits = new Edits();
    const count = 1 + attempt.below(3);
    for (let i = 1; i <= count; i++) {
      const stores = profile.nextStore();
      await raise(page);
      edits.note(base + i);
      await stores;
      await page.waitForTimeout(attempt.below(300));
    }
    return async (again, killedMs) => {
      const back = await restored(await again.open(), 'arm');
      const [value, ...others] = [...new Set(await valuesOf(back))];
      const broken = others.length > 0 ? `half a take: ${value} ${others.slice(0, 9).join(' ')}` : undefined;
      return { pages: [back], lostMs: edits.lostMs(value, killedMs), ...(broken && { broken }) };
    };
  },
};

/** Saved in place, slowly, and killed meanwhile. */
export const SAVE: Work = {
  name: 'save',
  before: slowPrivateDisk,
  async begin(profile) {
    const page = await profile.open();
    for (const [name, text] of [
      ['arm.skel', ARM],
      ['arm.anim', take()],
    ] as const) {
      await page.evaluate(
        async ([file, content]) => {
          const handle = await (await navigator.storage.getDirectory()).getFileHandle(file, { create: true });
          const stream = await handle.createWritable();
          await stream.write(content);
          await stream.close();
        },
        [name, text],
      );
    }
    await page.keyboard.press('Control+o');
    return opened(page);
  },
  async run([page], _profile, attempt) {
    const [base] = await valuesOf(page);
    const value = base + 1;
    await raise(page);
    await kept(page);
    await page.keyboard.press('Control+s');
    await page.waitForTimeout(attempt.below(900));
    return async (again) => {
      const back = await again.open();
      const bad = (broken: string): Found => ({ pages: [back], lostMs: 0, broken });
      const before = await onDisk(back);
      if (before !== base && before !== value) return bad(`half a file: ${before}`);
      await restored(back, 'arm');
      const values = await valuesOf(back);
      if (values.some((one) => one !== value)) return bad(`stored ${value}, restored ${values.join(' ')}`);
      const isMarked = () => back.evaluate(() => document.title.startsWith('•'));
      if (before !== value && !(await isMarked())) return bad('what is not on disk counts as saved');
      if (await isMarked()) await saveAgain(back);
      const after = await onDisk(back);
      return after === value ? { pages: [back], lostMs: 0 } : bad(`saved again, the file holds ${after}, not ${value}`);
    };
  },
};

/** Twice if the file was replaced before its version was stored. */
async function saveAgain(page: Page): Promise<void> {
  const isSaved = () => !document.title.startsWith('•');
  await page.keyboard.press('Control+s');
  const isSaid = () => page.getByText('has changed on disk').first().isVisible();
  for (let i = 0; i < 200 && !(await page.evaluate(isSaved)) && !(await isSaid()); i++) await page.waitForTimeout(100);
  if (await page.evaluate(isSaved)) return;
  await page.keyboard.press('Control+s');
  await page.waitForFunction(isSaved, undefined, { timeout: 20_000 }).catch(async () => {
    throw new Error(`Not saved again. The page says: ${await page.locator('.message-line').innerText()}`);
  });
}

/** Downloaded as a zip, and killed meanwhile: what has its name is all of it. */
export const DOWNLOAD: Work = {
  name: 'download',
  before: noPickers,
  begin: openTake,
  async run([page], _profile, attempt) {
    const [base] = await valuesOf(page);
    await raise(page);
    await kept(page);
    // Not awaited: the page is killed before it ends, or not.
    void page.evaluate(() => window.marrow.run('save.all')).catch(() => undefined);
    await page.waitForTimeout(attempt.below(1500));
    return async (again) => {
      const broken = brokenZip(again.downloads);
      const back = await restored(await again.open(), 'arm');
      const values = await valuesOf(back);
      const isBack = values.every((value) => value === base + 1);
      return { pages: [back], lostMs: 0, ...((broken || !isBack) && { broken: broken ?? 'stored work is not back' }) };
    };
  },
};

async function openTake(profile: Profile): Promise<readonly Page[]> {
  const page = await profile.open();
  await dropFiles(page, [
    { name: 'arm.skel', bytes: ARM },
    { name: 'arm.anim', bytes: take() },
  ]);
  return opened(page);
}

async function opened(page: Page): Promise<readonly Page[]> {
  await shown(page, 'arm');
  await kept(page);
  return [page];
}

function brokenZip(folder: string): string | undefined {
  for (const name of readdirSync(folder).filter((file) => file.endsWith('.zip'))) {
    const bytes = readFileSync(join(folder, name));
    // Chromium reserves the name by an empty file.
    if (bytes.length === 0) continue;
    try {
      const files = unzipSync(bytes);
      const text = Object.entries(files).find(([path]) => path.endsWith('.anim'))?.[1];
      if (text?.at(-1) !== '\n'.charCodeAt(0)) return `${name} lacks the take`;
    } catch (error) {
      return `${name}, ${bytes.length} bytes: ${String(error)}`;
    }
  }
  return undefined;
}

/** Raises all keys of the edited channels by 1. */
async function raise(page: Page): Promise<void> {
  await page.evaluate(
    ([channels, count]) => {
      const indices = Array.from({ length: count }, (_, k) => k);
      const keys = channels.map((channel) => ({ channel, indices }));
      return window.marrow.run('keys.move', { keys, seconds: 0, values: channels.map(() => 1) });
    },
    [EDITED, KEYS] as const,
  );
}

/** All values that keys of the edited channels have; of each channel once. */
function valuesOf(page: Page): Promise<number[]> {
  return page.evaluate(
    ([channels, count]) =>
      channels.flatMap((channel) => {
        const keys = window.marrow.keys(channel);
        return [...new Set(keys.length === count ? keys.map(({ value }) => value) : [Number.NaN, keys.length])];
      }),
    [EDITED, KEYS] as const,
  );
}

/** The value of the edited channels' keys in the file; a text that tells what is wrong with it. */
function onDisk(page: Page): Promise<number | string> {
  return page.evaluate(
    async ([edited, count]) => {
      const handle = await (await navigator.storage.getDirectory()).getFileHandle('arm.anim');
      const text = await (await handle.getFile()).text();
      const blocks = text.split(/channel\s*\{/).slice(1);
      const found = new Set<number>();
      for (const channel of edited) {
        const rows = (blocks[channel] ?? '')
          .split('\n')
          .filter((line) => /^\s*-?[\d.]+\s+-?[\d.]+\s+\S+\s+\S+\s*$/.test(line));
        if (rows.length !== count) return `channel ${channel} has ${rows.length} keys of ${text.length} characters`;
        for (const row of rows) found.add(Number(row.trim().split(/\s+/)[1]));
      }
      const [value] = found;
      return found.size === 1 && text.trimEnd().endsWith('}')
        ? value
        : `${[...found].slice(0, 9).join(' ')}, ends ${text.slice(-9)}`;
    },
    [EDITED, KEYS] as const,
  );
}

function take(): string {
  const still = 'channel { extrapolate constant constant keys 1 { 0 0 flat flat } }';
  const keys = Array.from({ length: KEYS }, (_, k) => `${k / 100} 0 flat flat`).join('\n');
  const long = `channel {\nextrapolate constant constant\nkeys ${KEYS} {\n${keys}\n} }`;
  const channels = Array.from({ length: CHANNELS }, (_, c) => (EDITED.includes(c) ? long : still));
  return `animation { range 0 10 numchannels ${CHANNELS}\n${channels.join('\n')}\n}\n`;
}

/** Runs in the page: each part of what is stored takes a while. */
function slowStore(): void {
  const { put } = IDBObjectStore.prototype;
  IDBObjectStore.prototype.put = function (value, key) {
    const untilMs = performance.now() + 40;
    while (performance.now() < untilMs);
    return put.call(this, value, key);
  };
}

/** Runs in the page: dialogs pick from the private file system, which is written in small pieces with pauses. */
function slowPrivateDisk(): void {
  window.showOpenFilePicker = async () => {
    const found: FileSystemFileHandle[] = [];
    for await (const entry of (await navigator.storage.getDirectory()).values()) {
      if (entry.kind === 'file') found.push(entry);
    }
    return found;
  };
  const { write } = FileSystemWritableFileStream.prototype;
  FileSystemWritableFileStream.prototype.write = async function (data) {
    if (!(data instanceof Blob)) return write.call(this, data);
    const piece = Math.ceil(data.size / 16);
    for (let from = 0; from < data.size; from += piece) {
      await write.call(this, data.slice(from, from + piece));
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    return undefined;
  };
}

/** Runs in the page: without dialogs that ask where to save, files are downloaded. */
function noPickers(): void {
  Reflect.deleteProperty(window, 'showSaveFilePicker');
}
