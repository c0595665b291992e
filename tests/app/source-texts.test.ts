import { zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { SourceTexts } from '../../src/app/source-texts.ts';
import type { DiskFile } from '../../src/io/disk-files.ts';
import { character, documentOf } from '../ui/builders.ts';
import { InThisThread } from './in-this-thread.ts';

const never = new AbortController().signal;
const SKEL = 'balljoint a {\n}\n';

function textsOf(onDisk?: DiskFile, again = SKEL) {
  return new SourceTexts({
    worker: new InThisThread(),
    handles: { at: () => onDisk },
    readAgain: async ({ path }) => ({ path, blob: new Blob([again]) }),
    edits: () => Promise.reject(new Error('Nothing is edited.')),
  });
}

async function readOf(texts: SourceTexts, path: string) {
  const shown: Blob[] = [];
  const map = await texts.read(
    path,
    never,
    (text) => shown.push(text),
    () => undefined,
  );
  return { map, text: await shown[0]?.text() };
}

describe('the text of a file as it was opened', () => {
  it('is that of the file given last under its path', async () => {
    const texts = textsOf();
    texts.note([{ path: 'x/a.skel', blob: new Blob(['old']) }]);
    texts.note([{ path: 'x/a.skel', blob: new Blob([SKEL]) }]);
    const { map, text } = await readOf(texts, 'x/a.skel');
    expect(text).toBe(SKEL);
    expect(map.index.count).toBe(3);
    expect(map.marks).toHaveLength(1);
    expect(texts.pathOf('a.skel')).toBe('x/a.skel');
    expect(texts.pathOf('b.skel')).toBeUndefined();
  });

  it('is found in a zip', async () => {
    const texts = textsOf();
    const zip = zipSync({ 'hero/a.skel': new TextEncoder().encode(SKEL) });
    texts.note([{ path: 'heroes.zip', blob: new Blob([new Uint8Array(zip)]) }]);
    expect((await readOf(texts, 'heroes.zip/hero/a.skel')).text).toBe(SKEL);
    expect(texts.given('heroes.zip/hero/a.skel')).toBe(texts.given('heroes.zip'));
    expect(texts.given('a.skel')).toBeUndefined();
    await expect(readOf(texts, 'heroes.zip/b.skel')).rejects.toThrow('The zip no longer contains b.skel.');
  });

  it('is read from disk after a restored session, and missed in a sentence if it is nowhere', async () => {
    expect((await readOf(textsOf({ path: 'a.skel' }), 'a.skel')).text).toBe(SKEL);
    await expect(readOf(textsOf(), 'a.skel')).rejects.toThrow('Open the file again.');
  });

  it('is known by the file as it was read: characters and text stay those of then', () => {
    const texts = textsOf();
    const source = { name: 'a.skel', path: 'x/a.skel', bytes: 1 };
    const file = { kind: 'skel', source, holds: 'a' } as const;
    const mark = { id: 1, revision: 1, file };
    const then = character({ parts: { skeleton: mark, skins: [], morphs: [], takes: [] } });
    const given = new Blob([SKEL]);
    texts.note([{ path: source.path, blob: given }]);
    expect(texts.opened(source)).toBeUndefined();
    texts.noteOpened(documentOf(then));
    texts.note([{ path: source.path, blob: new Blob(['broken']) }]);
    texts.noteOpened(documentOf({ ...then, name: 'later' }));
    expect(texts.opened(source)?.characters).toEqual([then]);
    expect(texts.opened(source)?.given).toBe(given);
  });

  it('is what was saved in place since, and the characters are those that were saved', () => {
    const texts = textsOf();
    const source = { name: 'a.skel', path: 'x/a.skel', bytes: 1 };
    const file = { kind: 'skel', source, holds: 'a' } as const;
    const then = character({ parts: { skeleton: { id: 1, revision: 1, file }, skins: [], morphs: [], takes: [] } });
    texts.note([{ path: source.path, blob: new Blob([SKEL]) }]);
    texts.noteOpened(documentOf(then));
    const [saved, now] = [new Blob(['saved']), { ...then, name: 'edited' }];
    texts.noteWritten('x/b.skel', new Blob(['other']), documentOf(now));
    expect(texts.opened(source)?.characters).toEqual([then]);
    texts.noteWritten(source.path, saved, documentOf(now));
    expect(texts.opened(source)).toEqual({ characters: [now], given: saved });
    expect(texts.given(source.path)).toBe(saved);
  });

  it('is offered for all kinds but images', () => {
    const texts = textsOf();
    expect(['a.skel', 'a.bvh', 'a.txt', 'a.png', 'a.unknown'].map((name) => texts.isText(name))).toEqual([
      ...[true, true, true, false, false],
    ]);
  });
});
