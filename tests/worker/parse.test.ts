import { strToU8, zipSync } from 'fflate';
import { describe, expect, it, vi } from 'vitest';
import { parse } from '../../src/worker/parse.ts';
import { tooLargeToPost } from '../../src/worker/parsed-blob.ts';
import { passageOf } from '../../src/worker/passage.ts';
import type { Progress } from '../../src/worker/protocol.ts';
import { walkerFiles } from '../helpers/hero.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';

const given = (path: string, content: string | Uint8Array<ArrayBuffer>) => ({ path, blob: new Blob([content]) });
const skel = 'balljoint root { offset 0 1 0 }';
const ignore = () => undefined;

describe('the parse job', () => {
  it('reads files by their endings, and keeps paths', async () => {
    const { files, diagnostics } = await parse({ files: [given('folder/A.SKEL', skel)] }, ignore);
    expect(diagnostics).toEqual([]);
    expect(files).toMatchObject([
      { kind: 'skel', source: { path: 'folder/A.SKEL', name: 'A.SKEL', bytes: skel.length } },
    ]);
  });

  it('says of a file whose numbers are too many for a browser to pass on how many, and what now', () => {
    const source = { name: 'day.bvh', path: 'day.bvh', bytes: 2.3e9 };
    expect(tooLargeToPost(source, [{ byteLength: 2 ** 31 - 1 }])).toBeUndefined();
    expect(tooLargeToPost(source, [{ byteLength: 8 }, { byteLength: 2.6e9 }])).toMatchObject({
      severity: 'error',
      file: 'day.bvh',
      message: expect.stringContaining('2.6 GB; the page can hold up to 2.1 GB per file'),
    });
  });

  it('lists a file with errors as broken, and goes on with the others', async () => {
    const { files, broken, diagnostics } = await parse(
      { files: [given('bad.skel', 'balljoint root { offset 0 x 0 }'), given('good.skel', skel)] },
      ignore,
    );
    expect(files.map((f) => f.source.name)).toEqual(['good.skel']);
    expect(broken).toMatchObject([{ kind: 'skel', source: { name: 'bad.skel' } }]);
    expect(diagnostics).toMatchObject([{ severity: 'error', file: 'bad.skel', line: 1 }]);
  });

  it('passes over what it does not know, and says so', async () => {
    const { files, diagnostics } = await parse({ files: [given('notes.txt', 'hello')] }, ignore);
    expect(files).toEqual([]);
    expect(diagnostics).toMatchObject([{ severity: 'warning', code: 'format-unknown', file: 'notes.txt' }]);
    expect(diagnostics[0].message).toContain('found a file without them');
  });

  it('skips unknown files, and reports them', async () => {
    const bytes = Uint8Array.of(1, 2, 3);
    const { files } = await parse({ files: [given('skin/face.BMP', bytes)] }, ignore);
    expect(files).toMatchObject([{ kind: 'texture', texture: { name: 'face.BMP', mime: 'image/bmp', bytes } }]);
  });

  it('names plain files that were edited since once each, by their paths where names are equal', async () => {
    const anim = 'animation { range 0 1 numchannels 1 channel { keys 1 { 0 0 flat flat } } }';
    const layer = { name: 'arm', file: 'walk.arm.anim', mode: 'additive' };
    const layers = (name: string) => {
      const flattened = { file: 'walk.anim', sha256: '0f'.repeat(32) };
      return given(`${name}.layers.json`, JSON.stringify({ base: 'walk.base.anim', flattened, layers: [layer] }));
    };
    const folder = (name: string) => [
      ...['walk.anim', 'walk.base.anim', layer.file].map((file) => given(`${name}/${file}`, anim)),
      ...['one', 'two'].map((file) => layers(`${name}/${file}`)),
    ];
    const edited = async (...names: string[]) => (await parse({ files: names.flatMap(folder) }, ignore)).layers?.edited;
    expect(await edited('a')).toEqual(['walk.anim']);
    expect(await edited('a', 'b')).toEqual(['a/walk.anim', 'b/walk.anim']);
  });

  it('unpacks zips into folders of their own', async () => {
    const zip = zipSync({
      'hero/hero.skel': strToU8(skel),
      'hero/readme.txt': strToU8('x'),
      '__MACOSX/hero.skel': strToU8(''),
    });
    const { files, diagnostics } = await parse({ files: [given('pack.zip', new Uint8Array(zip))] }, ignore);
    expect(files.map((f) => f.source.path)).toEqual(['pack.zip/hero/hero.skel']);
    expect(diagnostics.map((d) => d.file)).toEqual(['readme.txt']);
  });

  it('counts what it does not know in a zip of many such files', async () => {
    const many = Object.fromEntries(Array.from({ length: 1234 }, (_, i) => [`f${i}.xyz`, strToU8('x')]));
    const zip = zipSync({ ...many, 'hero.skel': strToU8(skel) });
    const { files, diagnostics } = await parse({ files: [given('pack.zip', new Uint8Array(zip))] }, ignore);
    expect(files).toHaveLength(1);
    expect(diagnostics).toMatchObject([{ severity: 'info', code: 'format-unknown', file: 'pack.zip' }]);
    expect(diagnostics[0].message).toMatch(
      /^1,234 files in it are of types that Marrow does not read; it reads \.skel/,
    );
  });

  it('refuses more files than a page can show, in a zip before it unpacks any, and reads as many as it can', async () => {
    const named = (count: number) => Array.from({ length: count }, (_, i) => `f${i}.skel`);
    const zipOf = (count: number) =>
      new Uint8Array(zipSync(Object.fromEntries(named(count).map((name) => [name, strToU8(skel)])), { level: 0 }));
    const most = await parse({ files: [given('pack.zip', zipOf(20))] }, ignore, 20);
    expect(most.files).toHaveLength(20);
    const zip = given('pack.zip', zipOf(21));
    const { files, broken, diagnostics } = await parse({ files: [zip, given('one.skel', skel)] }, ignore, 20);
    expect(files.map(({ source }) => source.name)).toEqual(['one.skel']);
    expect(broken).toEqual([]);
    expect(diagnostics).toMatchObject([{ severity: 'error', code: 'zip-refused', file: 'pack.zip' }]);
    expect(diagnostics[0].message).toBe(
      'The zip was not unpacked: it holds too many files; at most 20 can be opened at once; try one folder at a time.',
    );
    const drop = await parse({ files: named(2001).map((name) => given(name, skel)) }, ignore, 2000);
    expect(drop).toMatchObject({ files: [], broken: [], diagnostics: [{ code: 'too-many-files', file: '' }] });
    expect(drop.diagnostics[0].message).toMatch(/^None of the 2,001 files was opened: at most 2,000/);
  });

  it('says of a zip that is in order why it is not unpacked, and not that it is damaged', async () => {
    const zip = new Uint8Array(zipSync({ 'a.skel': strToU8(skel) }));
    const directory = new DataView(zip.buffer).getUint32(zip.length - 6, true);
    // Marked as encrypted.
    for (const flags of [6, directory + 8]) zip[flags] |= 1;
    const { diagnostics } = await parse({ files: [given('pack.zip', zip)] }, ignore);
    expect(diagnostics).toMatchObject([{ severity: 'error', code: 'zip-refused', file: 'pack.zip' }]);
    expect(diagnostics[0].message).toBe(
      'The zip was not unpacked: a.skel is encrypted; unpack the zip with its password first.',
    );
  });

  it('says so when a zip is damaged', async () => {
    const { diagnostics } = await parse({ files: [given('pack.zip', 'PK no zip')] }, ignore);
    expect(diagnostics).toMatchObject([{ severity: 'error', code: 'file-unreadable', file: 'pack.zip' }]);
  });

  it('says so when a file can’t be read any more', async () => {
    const gone = new Blob([skel]);
    gone.arrayBuffer = () => Promise.reject(new Error('the file was moved'));
    const { broken, diagnostics } = await parse({ files: [{ path: 'a.skel', blob: gone }] }, ignore);
    expect(broken).toHaveLength(1);
    expect(diagnostics[0].message).toContain('the file was moved');
  });

  it('tells of an error where it is, though its reader notices it later', async () => {
    const rows = Array.from({ length: 9 }, (_, i) => (i === 3 ? '1 2' : '1 2 3')).join('\n');
    const { diagnostics } = await parse({ files: [given('a.skin', `positions 9 {\n${rows}\n}\n`)] }, ignore);
    expect(diagnostics.filter(({ severity }) => severity === 'error')).toMatchObject([{ file: 'a.skin', line: 5 }]);
  });

  it('tells what it noticed if a file can’t be read a second time', async () => {
    const changed = new Blob(['balljoint a {\noffset 0 0\npose 0 0 0\n}\n']);
    const bytes = await changed.arrayBuffer();
    changed.arrayBuffer = vi
      .fn<() => Promise<ArrayBuffer>>(() => Promise.reject(new DOMException('changed', 'NotReadableError')))
      .mockReturnValueOnce(Promise.resolve(bytes));
    const { diagnostics } = await parse({ files: [{ path: 'a.skel', blob: changed }] }, ignore);
    expect(diagnostics).toMatchObject([{ code: 'number-expected', line: 3 }]);
  });

  it('reads small files eight at a time, in their order, and a large one in pieces', async () => {
    let reading = 0;
    const most: number[] = [];
    const files = Array.from({ length: 20 }, (_, i) => given(`a${i}.skel`, i === 9 ? skel + ' '.repeat(2e6) : skel));
    for (const { blob } of files) {
      const bytes = await blob.arrayBuffer();
      blob.arrayBuffer = async () => {
        most.push(++reading);
        await new Promise((resolve) => setTimeout(resolve));
        reading--;
        return bytes;
      };
    }
    const output = await parse({ files }, ignore);
    expect(output.files.map(({ source }) => source.path)).toEqual(files.map(({ path }) => path));
    expect(most).toHaveLength(19);
    expect(Math.max(...most)).toBe(8);
  });

  it.each([2, 20])(
    'measures the morphs of %i characters once each, on the skins that they belong to',
    async (count) => {
      const { facts } = await parse({ files: walkerFiles(count) }, ignore);
      expect(facts).toHaveLength(count);
      for (const { skin, morphs } of facts) {
        expect(morphs.map(({ name }) => name)).toEqual(
          ['blink', 'smile', 'breathe'].map((end) => `${skin.name}_${end}`),
        );
      }
    },
  );

  it('the parse job tells how far it is', async () => {
    const seen: Progress[] = [];
    await parse({ files: [given('a.skel', skel), given('b.skel', skel)] }, (p) => seen.push(p));
    expect(seen[0]).toMatchObject({ label: 'a.skel', of: 2 * skel.length });
  });

  it('names a file of another program before it is read, and counts its bytes and those of its buffers', async () => {
    const gltf = JSON.stringify({ asset: { version: '2.0' }, buffers: [{ uri: 'a.bin', byteLength: 4 }] });
    const bin = new Uint8Array(4);
    const of = 3 + gltf.length + bin.length;
    const seen: Progress[] = [];
    await parse({ files: [given('a.gltf', gltf), given('a.bin', bin), given('b.fbx', 'odd')] }, (p) => seen.push(p));
    expect(seen[0]).toEqual({ label: 'a.gltf', done: 0, of });
    expect(seen.find(({ label }) => label === 'b.fbx')?.done).toBe(gltf.length + bin.length);
  });
});

describe('the parse job on motion capture', () => {
  const head =
    'HIERARCHY\nROOT Hips\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n}\nMOTION\nFrames: 200000\nFrame Time: .01\n';
  // In parts, which Node's stream gives one by one as a browser's gives chunks.
  const part = '1.25 -2.5 30\n'.repeat(20000);
  const take = { path: 'walk.bvh', blob: new Blob([head, ...Array.from({ length: 10 }, () => part)]) };

  it('tells how far it is while the bytes come in, up to the last one', async () => {
    const seen: Progress[] = [];
    await parse({ files: [take, given('b.skel', skel)] }, (p) => seen.push(p));
    const ofTake = seen.filter((p) => p.label === 'walk.bvh').map((p) => p.done);
    expect(ofTake.length).toBeGreaterThan(2);
    expect(ofTake).toEqual([...ofTake].sort((a, b) => a - b));
    expect(seen.every((p) => p.of === take.blob.size + skel.length)).toBe(true);
  });

  it('hands the samples over without a copy, in hardly more memory than they take', async () => {
    const output = await parse({ files: [take] }, ignore);
    const [file] = output.files;
    const values = file.kind === 'bvh' ? file.captures[0].take?.samples?.values : undefined;
    expect(values).toHaveLength(600000);
    expect(passageOf(output).transfer).toContain(values?.buffer);
    expect(values?.buffer.byteLength).toBeLessThan(1.15 * 8 * 600000);
  });
});

describeShared('the parse job on real files', () => {
  it('works out what the page needs to know of each skin', async () => {
    const { facts, files } = await parse(
      { files: [given('wasp.skin', new Uint8Array(sharedBytes('data/cse169/wasp.skin')))] },
      ignore,
    );
    expect(facts).toHaveLength(1);
    expect(files[0].kind === 'skin' && files[0].skin).toBe(facts[0].skin);
  });
});
