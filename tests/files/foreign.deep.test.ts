/** What isn't what its name says, and what isn't read at all. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { strToU8, zipSync } from 'fflate';
import { afterAll, describe, expect, it } from 'vitest';
import { HEAD_BYTES, otherContent, unreadMessage } from '../../src/files/foreign.ts';
import { FORMAT_KINDS, formatKindOf, KINDS, READABLE_EXTENSIONS } from '../../src/files/kinds.ts';
import type { Diagnostic } from '../../src/model/diagnostic.ts';
import { parse } from '../../src/worker/parse.ts';
import { readInPieces } from '../formats/read-in-pieces.ts';
import { ALL_FILES, fileBytes } from '../formats/shared-files.ts';
import { command, type InfoJson } from '../helpers/command.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-foreign-'));
afterAll(() => rmSync(folder, { recursive: true }));

const latin1 = (text: string) => Uint8Array.from(text, (c) => c.charCodeAt(0));
const LFS = 'version https://git-lfs.github.com/spec/v1\noid sha256:0123\nsize 1234567\n';

it.each(['zip', 'glb', 'gltf', 'fbx', 'npz', 'npy'] as const)('an empty .%s is said to be empty', async (kind) => {
  const path = join(folder, `empty.${kind}`);
  writeFileSync(path, '');
  const { code, err } = await command(['info', path], folder);
  rmSync(path);
  expect([code, err]).toEqual([1, `empty.${kind} error file-empty: The file is empty: copy or export it again.\n`]);
});

/** The start of a file, what its message calls it, and the extensions that it may have. */
const LIST: readonly (readonly [start: string, called: RegExp, own?: readonly string[]])[] = [
  [LFS, /Git LFS pointer/],
  ['\xef\xbb\xbf\r\n<!-- saved -->\n<!DOCTYPE html>\n<html>', /web page/],
  ['<html lang="en">', /web page/],
  ['404: Not Found', /web server/],
  ['%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n--- !u!74 &7400000\n', /Unity.*YAML/],
  ['%YAML 1.2\n---\na: 1\n', /YAML/, ['dump', 'table']],
  ['animVersion 1.1;\nmayaVersion 2018;\n', /Maya animation/],
  ['//Maya ASCII 2020 scene\n', /Maya scene/],
  ['\x1f\x8b\x08\0\0\0', /compressed with gzip/],
  ['BZh91AY&SY', /bzip2/],
  ['\xfd7zXZ\0', /xz/],
  ['\x28\xb5\x2f\xfd\0', /Zstandard/],
  ['7z\xbc\xaf\x27\x1c', /7z/],
  ['PK\x03\x04\x14\0', /zip archive/, ['numpy']],
  [`${'a.bvh'.padEnd(257, '\0')}ustar\0`, /tar archive/],
  ['%PDF-1.7', /PDF/],
  ['\x89PNG\r\n\x1a\n', /image/, ['texture']],
  ['GIF89a', /image/, ['texture']],
  ['\xff\xd8\xff\xe0', /image/, ['texture']],
  ['II*\0', /image/],
  ['\0\0\0\x18ftypmp42', /video/],
  ['BLENDER-v300', /Blender/],
  ['#usda 1.0', /USD/],
  ['<?xml version="1.0"?>\n<COLLADA xmlns="">', /COLLADA/],
  ['<?xml version="1.0"?>\n<a/>', /XML/, ['dump', 'table']],
  ['# made by\n\n# me\n:version 1.10\n:name VICON\n', /Acclaim skeleton/, ['asf']],
  ['#!OML:ASF F:\\VICON\\acclaim.asf\n:FULLY-SPECIFIED\n:DEGREES\n1\n', /Acclaim motion/, ['amc']],
  ['\x02P\0\0\0\0\0\0\0', /C3D.*\.c3d/, ['c3d']],
  ['\x93NUMPY\x01\0', /array of numpy/, ['numpy']],
  ['glTF\x02\0\0\0', /glTF.*\.glb/, ['gltf']],
  ['Kaydara FBX Binary  \0', /FBX.*\.fbx/, ['fbx']],
  ['; FBX 7.5.0 project file\n', /FBX.*\.fbx/, ['fbx']],
  [
    '{ "asset": { "version": "2.0" } }',
    /JSON/,
    ['gltf', 'markers', 'sets', 'layers', 'limbs', 'attach', 'dump', 'table'],
  ],
  ['\xff\xfeH\0I\0E\0R\0', /UTF-16/, ['dump', 'table']],
  ['H\0I\0E\0R\0A\0', /UTF-16/, ['dump', 'table']],
  ['balljoint\0\x01\x02\0\0\0\0\x03\0\0\0\x04', /binary/, ['gltf', 'fbx', 'texture', 'c3d', 'dump', 'table']],
  ['HIERARCHY\r\nROOT Hips\r\n{', /BVH.*\.bvh/, ['skel', 'axskel', 'skin', 'morph', 'anim', 'rig', 'bvh', 'pose']],
];

const CONTENTS = LIST.map(([start, called, own = []]) => ({ start, called, own }));

const EXTENSIONS = FORMAT_KINDS.map((kind) => KINDS[kind].extensions[0]);

async function onPage(name: string, bytes: Uint8Array<ArrayBuffer>): Promise<readonly Diagnostic[]> {
  return (await parse({ files: [{ path: name, blob: new Blob([bytes]) }] }, () => undefined)).diagnostics;
}

async function byCommand(name: string, bytes: Uint8Array) {
  writeFileSync(join(folder, name), bytes);
  const { code, out } = await command(['info', name, '--json'], folder);
  const pose = await command(['pose', name], folder);
  rmSync(join(folder, name));
  return { codes: [code, pose.code], diagnostics: (JSON.parse(out) as InfoJson).diagnostics };
}

describe('a file that is not what its name says', () => {
  it.each(CONTENTS)(
    '$start is named under the extension of any other kind, once, by page and command',
    async ({ start, called, own }) => {
      const bytes = latin1(start);
      for (const extension of [...EXTENSIONS, 'zip']) {
        const name = `take.${extension}`;
        const kind = formatKindOf(name) ?? 'zip';
        if (own.includes(kind) || (kind === 'zip' && start.startsWith('PK'))) continue;
        const told = await onPage(name, bytes);
        expect(told, name).toMatchObject([{ severity: 'error', code: 'other-kind', file: name }]);
        expect(told[0].message, name).toMatch(called);
        expect(told[0].message, name).toMatch(
          new RegExp(`^This looks like .*, not a \\.${extension.split('.').at(-1)} file\\. [A-Z].*\\.$`),
        );
        const { codes, diagnostics } = await byCommand(name, bytes);
        expect(codes, name).toEqual([1, 1]);
        expect(diagnostics, name).toEqual(told);
      }
    },
  );

  it('the same is said of it however it is cut, and whatever follows', () => {
    for (const { start, own } of CONTENTS) {
      for (const kind of FORMAT_KINDS) {
        const name = `x.${KINDS[kind].extensions[0]}`;
        if (own.includes(kind)) continue;
        const bytes = latin1(start + ' rest\n{ 1 2 3 }'.repeat(200));
        const { value, diagnostics } = readInPieces(name, bytes, [1, 3, start.length, HEAD_BYTES - 1, HEAD_BYTES + 7]);
        expect(value).toBeUndefined();
        expect(diagnostics).toHaveLength(1);
        expect(diagnostics).toEqual(readInPieces(name, bytes, []).diagnostics);
      }
    }
  });

  it('nothing is said of a heading of dashes, or of an empty file', () => {
    for (const text of ['--- world matrices ---\n1 2 3\n', '', 'BLENDER\n', 'version 1\n']) {
      expect(otherContent('walk.txt', 'dump', latin1(text))).toBeUndefined();
    }
  });

  it('the first bytes are looked at in no time, whatever they are', () => {
    const parts = [
      '#',
      '#\n',
      '\n',
      '# a\n\n',
      '<!-- -->',
      '<!--',
      '<?xml ',
      ' ',
      '//\n',
      '{ ',
      '%YAML',
      ':',
      '-',
      '---',
    ];
    const started = performance.now();
    let looks = 0;
    for (const a of parts) {
      for (const b of parts) {
        for (const kind of ['bvh', 'dump'] as const) otherContent('x.bvh', kind, latin1((a + b).repeat(HEAD_BYTES)));
        looks += 2;
      }
    }
    expect((performance.now() - started) / looks).toBeLessThan(20);
  });
});

describe('the files at hand', () => {
  it('are all what their names say', () => {
    for (const path of ALL_FILES) {
      const kind = formatKindOf(path);
      if (kind) expect(otherContent(path, kind, fileBytes(path)), path).toBeUndefined();
    }
  });
});

describe('a kind of file that is not read', () => {
  const UNREAD = ['blend', 'ma', 'mb', 'max', 'usd', 'usdz', 'dae', 'abc', 'pkl', 'sto', 'vmd', '7z', 'pdf', 'mp4'];

  it.each(UNREAD)('.%s is named, with a way on, by page and command, which fail', async (extension) => {
    const name = `a.${extension}`;
    expect(READABLE_EXTENSIONS).not.toContain(extension);
    const message = unreadMessage(name);
    expect(message).toMatch(new RegExp(`^Marrow does not read \\.${extension}: this is .*\\. [A-Z].*\\.$`));
    expect(await onPage(name, latin1('x'))).toMatchObject([{ code: 'format-unknown', message }]);
    const { codes, diagnostics } = await byCommand(name, latin1('x'));
    expect(codes).toEqual([1, 1]);
    expect(diagnostics).toMatchObject([
      { severity: 'warning', code: 'format-unknown', message },
      { severity: 'error' },
    ]);
  });

  it('no kind that is read is among them', () => {
    for (const extension of READABLE_EXTENSIONS) expect(unreadMessage(`a.${extension}`)).toContain('it reads .skel');
  });

  it('is only a warning beside a file that is read', async () => {
    writeFileSync(join(folder, 'readme.md'), 'hello');
    writeFileSync(join(folder, 'a.skel'), 'balljoint a { }');
    const { code, err } = await command(['info', '.'], folder);
    expect(err).toContain('readme.md warning format-unknown: Marrow does not read this type of file; it reads .skel');
    expect(code).toBe(0);
    expect((await command(['info', 'readme.md'], folder)).code).toBe(1);
  });
});

describe('a zip on the command line', () => {
  it('is read as the folder that it is, buffers and all', async () => {
    const gltf = JSON.stringify({
      asset: { version: '2.0' },
      scenes: [{ nodes: [0] }],
      nodes: [{ name: 'hips', mesh: 0 }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
      accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0] }],
      bufferViews: [{ buffer: 0, byteLength: 36 }],
      buffers: [{ uri: 'mesh.bin', byteLength: 36 }],
    });
    const mesh = new Uint8Array(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0).buffer);
    const zip = zipSync({
      'a/b.skel': strToU8('balljoint b { balljoint c { } }'),
      'g/mesh.gltf': strToU8(gltf),
      'g/mesh.bin': mesh,
      '__MACOSX/._b.skel': strToU8('x'),
    });
    const { codes, diagnostics } = await byCommand('pack.zip', zip);
    expect(diagnostics.filter(({ severity }) => severity !== 'info')).toEqual([]);
    expect(codes).toEqual([0, 0]);
    writeFileSync(join(folder, 'pack.zip'), zip);
    const { out } = await command(['info', 'pack.zip', '--json'], folder);
    const { files } = JSON.parse(out) as InfoJson;
    expect(files.map(({ name, joints }) => [name, joints])).toEqual([
      ['pack.zip/a/b.skel', 2],
      ['pack.zip/g/mesh.gltf', expect.any(Number)],
    ]);
  });

  it('is an error if it is damaged, or holds nothing that is read', async () => {
    const damaged = await byCommand('pack.zip', latin1('PK\x03\x04\0'));
    expect(damaged.codes).toEqual([1, 1]);
    expect(damaged.diagnostics).toMatchObject([{ severity: 'error', code: 'zip-unreadable', file: 'pack.zip' }]);
    const empty = await byCommand('pack.zip', zipSync({ 'readme.md': strToU8('x') }));
    expect(empty.codes).toEqual([1, 1]);
  });
});

it('numbers of another program may look like a .skin', async () => {
  const text = new TextEncoder().encode('positions 2 {\n1 2 3\n4 5 6\n}\n');
  expect(await onPage('mine.txt', text)).toEqual([]);
});
