/**
 * The npm package, as a stranger gets it: packed, installed into an empty folder without a network, its types checked,
 * bundled, and the examples run there. `MARROW_NODES` names further versions of Node to run them with, separated as in
 * `PATH`.
 */
import { execFile } from 'node:child_process';
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { gzipSync } from 'node:zlib';
import type { Bone } from 'three';
import { build, type Rolldown } from 'vite';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { animReader } from '../../src/formats/anim/read.ts';
import { readWhole } from '../../src/formats/reader.ts';
import { commandJson, type PoseJson } from '../helpers/command.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const SAMPLES = join(ROOT, 'public/samples');
const CODE = join(ROOT, 'examples/code');
const nodes = [process.execPath, ...(process.env.MARROW_NODES?.split(delimiter).filter(Boolean) ?? [])];
const run = promisify(execFile);

const folder = mkdtempSync(join(tmpdir(), 'marrow-package-'));
const examples = readdirSync(CODE).filter((name) => name.endsWith('.mjs'));
const textOf = (path: string) => readFileSync(path, 'utf8');

/** npm by its own script, since Windows has none to execute. */
function npm(args: readonly string[], cwd: string) {
  return run('npm', [...args], { cwd, shell: process.platform === 'win32' });
}

beforeAll(async () => {
  const { stdout } = await npm(['pack', '--ignore-scripts', '--json', '--pack-destination', folder], ROOT);
  const [{ filename }] = JSON.parse(stdout) as readonly [{ filename: string }];
  writeFileSync(join(folder, 'package.json'), JSON.stringify({ private: true, type: 'module' }));
  await npm(['install', '--offline', '--no-audit', '--no-fund', join(folder, filename)], folder);
  for (const name of examples) writeFileSync(join(folder, name), textOf(join(CODE, name)));
});

afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** Runs an example in the folder. Returns what it prints. */
async function example(node: string, name: string, ...args: string[]): Promise<string> {
  const { stdout } = await run(node, [`${name}.mjs`, ...args], { cwd: folder });
  return stdout.trim();
}

describe('the package', () => {
  it('brings nothing but itself', () => {
    expect(readdirSync(join(folder, 'node_modules')).filter((name) => !name.startsWith('.'))).toEqual(['marrow']);
    const inside = readdirSync(join(folder, 'node_modules/marrow'), { recursive: true, encoding: 'utf8' });
    expect(inside.filter((path) => /\.ts$/.test(path) && !path.endsWith('.d.ts'))).toEqual([]);
    expect(inside.filter((path) => /three|codemirror/.test(path))).toEqual([]);
    expect(inside).toContain('README.md');
  });

  it('has types that a strict program compiles with, for Node and for bundlers', { timeout: 60_000 }, async () => {
    writeFileSync(join(folder, 'program.ts'), PROGRAM);
    const tsc = join(ROOT, 'node_modules/.bin/tsc');
    const strict = ['--strict', '--exactOptionalPropertyTypes', '--noEmit', '--target', 'es2022', '--types', ''];
    for (const module of ['nodenext', 'preserve']) {
      const args = [tsc, ...strict, '--lib', 'es2023,dom', '--module', module, 'program.ts'];
      const failed = await run(process.execPath, args, { cwd: folder }).then(
        () => '',
        (error: { stdout: string }) => error.stdout,
      );
      expect(failed).toBe('');
    }
  });

  it('is small in a bundle: a .skel and an .anim at a time', { timeout: 60_000 }, async () => {
    const sizes = await Promise.all([KEYS, POSES].map((program, i) => bundled(program, i)));
    expect(sizes[0]).toBeLessThan(25_000);
    expect(sizes[1]).toBeLessThan(30_500);
  });

  it('has the element, small beside the three.js that a page has', { timeout: 60_000 }, async () => {
    const size = await bundled("import 'marrow/viewer';", 2, /^three(\/|$)/);
    expect(size).toBeLessThan(75_000);
  });

  it('has the command', async () => {
    const marrow = join(folder, 'node_modules/marrow/build/package/marrow.js');
    const { stdout } = await run(process.execPath, [marrow, 'info', 'cube.skel'], { cwd: SAMPLES });
    expect(stdout).toContain('joints 1');
    expect(existsSync(join(folder, 'node_modules/.bin/marrow'))).toBe(true);
  });
});

describe.each(nodes)('the examples in %s', (node) => {
  it('world matrices are those of the command', async () => {
    const files = ['walker.skel', 'walker_walk.anim'].map((name) => join(SAMPLES, name));
    const printed = await example(node, 'world-matrices', ...files, 'head', '0.5');
    const { characters } = await commandJson<PoseJson>(['pose', ...files, '--time', '0.5']);
    const head = characters[0].joints.find(({ name }) => name === 'head');
    expect(printed.split(' ').map(Number)).toEqual(head?.world);
  });

  it('captures become GLB, and arrays that numpy reads', async () => {
    const captures = join(folder, 'captures');
    mkdirSync(captures, { recursive: true });
    writeFileSync(join(captures, 'wave.bvh'), BVH);
    writeFileSync(join(captures, 'broken.bvh'), 'HIERARCHY\nROOT');
    const converted = await example(node, 'bvh-to-glb', join(captures, 'wave.bvh'), 'wave.glb');
    expect(converted).toMatch(/^2 joints, 1 take/);
    expect(readFileSync(join(folder, 'wave.glb')).toString('latin1', 0, 4)).toBe('glTF');
    const exported = await example(node, 'folder-to-npz', 'captures', 'arrays');
    expect(exported).toBe('wave.bvh: 3 frames of 2 joints');
    const npz = readFileSync(join(folder, 'arrays/wave.npz')).toString('latin1');
    expect(npz.match(/[a-z_0-9]+\.npy/g)).toContain('positions.npy');
  });

  it('IK in a worker reaches its target', async () => {
    const printed = await example(node, 'ik-worker', join(SAMPLES, 'walker.skel'), 'hand_l', '0.3', '1', '0.3');
    expect(printed).toMatch(/^[\d.]+e-[5-9] from the target, at 0\.300 1\.000 0\.300$/);
  });
});

it('bones of three.js follow an .anim: their world matrices are those of the command', async () => {
  if (!existsSync(join(folder, 'node_modules/three'))) {
    symlinkSync(join(ROOT, 'node_modules/three'), join(folder, 'node_modules/three'), 'junction');
  }
  const files = ['crawler.skel', 'crawler_walk.anim'].map((name) => join(SAMPLES, name));
  const { bonesOf } = await import(/* @vite-ignore */ join(folder, 'three-bones.mjs'));
  const { root, bones, range, update } = bonesOf(...files.map(textOf));
  update(0.7);
  // Made by the same three.js, which the folder links to.
  const made = bones as readonly Bone[];
  (root as Bone).updateMatrixWorld();
  const { characters } = await commandJson<PoseJson>(['pose', ...files, '--time', '0.7']);
  characters[0].joints.forEach(({ world }, joint) => {
    made[joint].matrixWorld.elements.forEach((value, k) => void expect(value).toBeCloseTo(world[k], 12));
  });
  expect(range).toEqual(readWhole(animReader(''), readFileSync(files[1])).value?.range);
});

it('the manual shows the examples as they are, and each has fewer than 40 lines', () => {
  const pages = ['programs', 'element', 'notebooks'].map((name) => textOf(join(ROOT, `docs/guide/${name}.md`)));
  const code = readdirSync(CODE).map((name) => textOf(join(CODE, name)));
  expect(code.filter((text) => !pages.some((page) => page.includes(`\n${text}\`\`\``)))).toEqual([]);
  expect(code.filter((text) => text.split('\n').length > 40)).toEqual([]);
});

/** Gzipped bytes of a program, as vite bundles it for a page: of what is loaded at once. */
async function bundled(program: string, index: number, external?: RegExp): Promise<number> {
  const input = join(folder, `bundled-${index}.js`);
  writeFileSync(input, program);
  const made = await build({
    root: folder,
    configFile: false,
    logLevel: 'error',
    build: { write: false, modulePreload: false, rolldownOptions: { input, ...(external && { external }) } },
  });
  // Of one configuration, without watching.
  const { output } = made as Rolldown.RolldownOutput;
  const sizeOf = (file: string): number => {
    const chunk = output.find((one) => one.fileName === file);
    return chunk?.type === 'chunk' ? gzipSync(chunk.code, { level: 9 }).length : 0;
  };
  const [{ fileName, imports }] = output;
  return [fileName, ...imports].reduce((sum, file) => sum + sizeOf(file), 0);
}

const KEYS = `
import { evaluateChannel, worldMatrices } from 'marrow/evaluate';
import { readAnim, readSkel } from 'marrow/formats';
console.log(readSkel, readAnim, evaluateChannel, worldMatrices);
`;

const POSES = `
import { poseAt, worldMatrices } from 'marrow/evaluate';
import { readAnim, readSkel } from 'marrow/formats';
import { createCharacter } from 'marrow/model';
console.log(readSkel, readAnim, createCharacter, poseAt, worldMatrices);
`;

const PROGRAM = `
import { takeArrays, writeNpz } from 'marrow/dataset';
import { bakeRetarget, deformSkin, poseAt, retarget, worldMatrices } from 'marrow/evaluate';
import { convertCharacter, type FbxSettings, type GlbSettings, writeFbx, writeGlb } from 'marrow/export';
import { readBvh, readSkel, readSkin, writeSkel } from 'marrow/formats';
import { readCharacters, readGltf } from 'marrow/import';
import { type Character, createCharacter, type Skeleton, vertexCount } from 'marrow/model';

export async function all(text: string, bytes: ArrayBuffer, other: Uint8Array): Promise<readonly string[]> {
  const { skeleton, diagnostics } = readSkel(text, 'a.skel');
  const { skin } = readSkin(other);
  if (!skeleton || !skin) return diagnostics.map(({ line, message }) => line + message);
  const checked: Skeleton = skeleton;
  const { captures, take } = readBvh(bytes);
  const character: Character = createCharacter({ skeleton: checked, skins: [skin], ...(take && { takes: [take] }) });
  const dofs = poseAt(character, 1, new Float64Array(9));
  const positions = new Float64Array(3 * vertexCount(skin));
  deformSkin(character, dofs, positions, positions);
  const { characters } = await readCharacters([{ name: 'a.skel', content: text }]);
  const { character: model } = await readGltf(bytes);
  const target = model ?? characters[0];
  const settings: GlbSettings = { keys: 'cubic' };
  const rate: FbxSettings = { framesPerSecond: 30 };
  const made = bakeRetarget(retarget(target, character, { plantsFeet: false }), 30);
  const size = writeGlb(made, settings).bytes.length + writeNpz(takeArrays(made, { fps: 30 })).length + writeFbx(made, rate).bytes.length;
  const first: number = worldMatrices(checked, dofs)[0];
  return [writeSkel(checked).text, ...convertCharacter(made, 'bvh').map((file) => file.text), first + size + captures[0].skeleton.name];
}
`;

const BVH = `HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Head
  {
    OFFSET 0 0.6 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0.2 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.0333333
0 0.9 0 0 0 0 10 0 0
0 0.9 0 0 0 0 0 20 0
0 0.9 0 0 0 0 0 0 30
`;
