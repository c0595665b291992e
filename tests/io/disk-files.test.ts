import { afterEach, describe, expect, it, vi } from 'vitest';
import {
  asksWhereToSave,
  DiskError,
  NotNowError,
  pickTarget,
  readAgain,
  versionOnDisk,
  writeTo,
} from '../../src/io/disk-access.ts';
import { diskFileOf, pickFiles } from '../../src/io/disk-files.ts';
import { fromDataTransfer } from '../../src/io/given.ts';

afterEach(() => vi.unstubAllGlobals());

/** A handle on one file that lives here; `fails` is what the disk says to the next thing that is tried. */
function handle(name: string, text = '', fails?: string) {
  const state = { text, modified: 1, permission: 'granted', asked: [] as string[], fails };
  const trouble = () => {
    if (state.fails) throw new DOMException('no', state.fails);
  };
  const made = {
    kind: 'file',
    name,
    async getFile() {
      trouble();
      return new File([state.text], name, { lastModified: state.modified });
    },
    async createWritable() {
      trouble();
      let written = '';
      return {
        async write(content: Blob) {
          written += await content.text();
        },
        close: async () => {
          state.text = written;
          state.modified++;
        },
      };
    },
    queryPermission: async () => state.permission,
    async requestPermission({ mode }: { mode: string }) {
      state.asked.push(mode);
      return 'granted';
    },
  };
  // A handle as far as it is used here.
  return { state, handle: made as unknown as FileSystemFileHandle };
}

function folder(name: string, ...inside: unknown[]) {
  const made = { kind: 'directory', name, values: () => inside.values() };
  return made as unknown as FileSystemDirectoryHandle;
}

function item(file: File | null, from: { handle?: unknown; entry?: unknown; refuses?: boolean } = {}) {
  return {
    kind: 'file',
    getAsFile: () => file,
    webkitGetAsEntry: () => from.entry ?? null,
    ...('handle' in from && { getAsFileSystemHandle: async () => from.handle }),
    ...(from.refuses && { getAsFileSystemHandle: () => Promise.reject(new DOMException('no', 'NotAllowedError')) }),
  };
}

/** A drop, which the browser takes back when the event is over. */
async function drop(...items: { kind: string }[]) {
  const list = [...items];
  const found = fromDataTransfer({ items: list } as unknown as DataTransfer);
  list.length = 0;
  return found;
}

describe('a drop', () => {
  it('a drop gives files with their handles', async () => {
    const { handle: own } = handle('a.skel', 'x');
    const [given] = await drop(item(new File(['x'], 'a.skel', { lastModified: 5 }), { handle: own }));
    expect(given).toMatchObject({ path: 'a.skel', handle: own, version: '5 1' });
  });

  it('gives files without, where the browser has none or refuses', async () => {
    const files = ['c', 'b', 'a'].map((name) => new File([name], `${name}.skel`));
    const given = await drop(item(files[0]), item(files[1], { handle: null }), item(files[2], { refuses: true }));
    expect(given.map(({ path }) => path)).toEqual(['a.skel', 'b.skel', 'c.skel']);
    expect(given.some((g) => g.handle)).toBe(false);
  });

  it('gives what is in folders, with handles, under their paths, without what is hidden', async () => {
    const parts = ['a.skel', '.DS_Store'].map((name) => handle(name, 'x').handle);
    const deep = folder('inner', handle('b.anim', 'y').handle);
    const given = await drop(item(null, { handle: folder('outer', ...parts, deep) }));
    expect(given.map(({ path }) => path)).toEqual(['outer/a.skel', 'outer/inner/b.anim']);
    expect(given[0].handle).toBe(parts[0]);
  });

  it('of thousands asks only the first for what is beside their handles, which takes the system a while', async () => {
    let asked = 0;
    const items = Array.from({ length: 1000 }, (_, i) => {
      const name = `${i}.skel`;
      const given = item(new File(['x'], name), { handle: handle(name).handle });
      return {
        ...given,
        webkitGetAsEntry: () => {
          asked++;
          return null;
        },
      };
    });
    const given = await drop(...items);
    expect(given.map(({ path }) => path)).toEqual(items.map((_, i) => `${i}.skel`));
    expect(given.every((g) => g.handle)).toBe(true);
    expect(asked).toBeLessThan(200);
    asked = 0;
    await drop(...items.map(({ getAsFileSystemHandle: _none, ...rest }) => rest));
    expect(asked).toBe(1000);
  });

  it('gives what is in folders of older browsers', async () => {
    const file = {
      isFile: true,
      fullPath: '/outer/a.skel',
      file: (done: (f: File) => void) => done(new File([], 'a.skel')),
    };
    let pieces = [[file], []];
    const readEntries = (done: (piece: unknown[]) => void) => {
      const [piece, ...rest] = pieces;
      pieces = rest;
      done(piece);
    };
    const entry = { isDirectory: true, createReader: () => ({ readEntries }) };
    expect((await drop(item(null, { entry }))).map(({ path }) => path)).toEqual(['outer/a.skel']);
  });
});

describe('dialogs', () => {
  it('give what was picked, by name, with handles', async () => {
    const picked = ['b.skel', 'a.skel'].map((name) => handle(name).handle);
    vi.stubGlobal('window', { showOpenFilePicker: async () => picked });
    const given = await pickFiles();
    expect(given.map(({ path }) => path)).toEqual(['a.skel', 'b.skel']);
    expect(given[0].handle).toBe(picked[1]);
  });

  it('give nothing when they are given up', async () => {
    const giveUp = () => Promise.reject(new DOMException('', 'AbortError'));
    vi.stubGlobal('window', { showOpenFilePicker: giveUp, showSaveFilePicker: giveUp });
    expect(await pickFiles()).toEqual([]);
    expect(asksWhereToSave()).toBe(true);
    expect(await pickTarget('a.anim')).toBeUndefined();
  });

  it('dialogs of browsers without handles give what was picked, even after they have said that nothing was', async () => {
    const input = Object.assign(new EventTarget(), { files: [] as File[] });
    const opened = new Promise<void>((click) => Object.assign(input, { click }));
    vi.stubGlobal('window', {});
    vi.stubGlobal('document', { createElement: () => input });
    const picking = pickFiles();
    await opened;
    input.dispatchEvent(new Event('cancel'));
    input.files = [new File(['x'], 'b.skel'), new File(['y'], 'a.skel')];
    input.dispatchEvent(new Event('change'));
    expect((await picking).map(({ path }) => path)).toEqual(['a.skel', 'b.skel']);
  });

  it('dialogs that the browser does not open say to try again', async () => {
    for (const name of ['SecurityError', 'NotAllowedError']) {
      vi.stubGlobal('window', { showSaveFilePicker: () => Promise.reject(new DOMException('', name)) });
      await expect(pickTarget('a.anim')).rejects.toThrow(new NotNowError('Save again to choose where to save it.'));
    }
  });

  it('dialogs are not everywhere', () => {
    vi.stubGlobal('window', {});
    expect(asksWhereToSave()).toBe(false);
  });
});

describe('writing', () => {
  it('replaces the content, and tells the new version', async () => {
    const { handle: own, state } = handle('a.anim', 'old');
    expect(await writeTo(own, new Blob(['new']))).toBe(await versionOnDisk(own));
    expect(state.text).toBe('new');
    expect(state.asked).toEqual([]);
  });

  it('asks where the browser wants to be asked, and stops where the answer is no', async () => {
    const { handle: own, state } = handle('a.anim', 'old');
    state.permission = 'prompt';
    await writeTo(own, new Blob(['new']));
    expect(state.asked).toEqual(['readwrite']);
    own.requestPermission = async () => 'denied';
    await expect(writeTo(own, new Blob(['newer']))).rejects.toThrow('The browser has no permission.');
    own.requestPermission = () => Promise.reject(new DOMException('', 'SecurityError'));
    await expect(writeTo(own, new Blob(['newer']))).rejects.toBeInstanceOf(NotNowError);
    expect(state.text).toBe('new');
  });

  it.each([
    ['NotFoundError', 'It was moved, renamed or deleted.', true],
    ['InvalidStateError', 'It changed in the meantime. Try again.', false],
    ['AbortError', 'The browser or a virus scanner stopped it. Try again, or choose another location.', false],
    ['TypeMismatchError', 'A folder has that name.', false],
    ['UnknownError', 'Something went wrong. Try again. (UnknownError: no)', false],
    ['NoModificationAllowedError', 'Another program or tab is writing to it.', false],
    ['QuotaExceededError', 'There is not enough space.', false],
  ])('writing says %s in a sentence', async (name, message, isGone) => {
    const { handle: own } = handle('a.anim', 'old', name);
    const error = await writeTo(own, new Blob(['new'])).catch((e: unknown) => e);
    expect(error).toBeInstanceOf(DiskError);
    expect(error).toMatchObject({ message, isGone });
    expect(await versionOnDisk(own)).toBeUndefined();
  });
});

describe('reading again', () => {
  const page = 'http://localhost/';

  it('gives what a handle leads to now, under the path that it was opened as', async () => {
    const { handle: own, state } = handle('a.skel', 'old');
    const file = diskFileOf({ path: 'folder/a.skel', blob: await own.getFile(), handle: own, version: '1 3' });
    state.text = 'newer';
    state.modified = 9;
    const again = await readAgain(file ?? { path: '' }, page);
    expect(again).toMatchObject({ path: 'folder/a.skel', handle: own, version: '9 5' });
    expect(await again.blob.text()).toBe('newer');
  });

  it('gives a file without a handle for as long as it did not change', async () => {
    const file = new File(['x'], 'a.skel', { lastModified: 4 });
    const known = diskFileOf({ path: 'a.skel', blob: file, version: '4 1' });
    expect(await readAgain(known ?? { path: '' }, page)).toMatchObject({ blob: file, version: '4 1' });
    vi.spyOn(file, 'slice').mockReturnValue({
      arrayBuffer: () => Promise.reject(new DOMException('', 'NotReadableError')),
    } as unknown as Blob);
    await expect(readAgain(known ?? { path: '' }, page)).rejects.toThrow('Drop it again');
  });

  it('fetches an address, past the cache', async () => {
    const asked: unknown[] = [];
    vi.stubGlobal('fetch', async (url: URL, options: RequestInit) => {
      asked.push([url.href, options.cache]);
      return new Response('now', { headers: { etag: '"2"' } });
    });
    const address = `${page}given/a%20b.skel`;
    const again = await readAgain({ path: 'given/a b.skel', address, version: '"1"' }, page);
    expect(asked).toEqual([[address, 'no-cache']]);
    expect(again).toMatchObject({ path: 'given/a b.skel', address, version: '"2"' });
  });

  it('reading again is impossible for content of a script', () => {
    expect(diskFileOf({ path: 'a.skel', blob: new Blob(['x']) })).toBeUndefined();
  });
});
