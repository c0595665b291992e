/**
 * Characters of other programs, as people have them: a VRM and an FBX like Mixamo's are dropped, saved as text, and taken
 * out again as GLB, each step measured. Before, both are keyed; the VRM is played and posed by hand, and the FBX, a
 * hundred times as large, retargeted in between.
 */
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { unzipSync, zipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import type { Character } from '../../src/model/document.ts';
import { type Glb, glbOf } from '../helpers/glb.ts';
import { hero, vrmOf, WALKER_FILES } from '../helpers/hero.ts';
import { inOnePage } from '../helpers/one-page.ts';
import { type DroppedFile, dropFiles, dropPaths, type OpenPage } from '../helpers/page.ts';
import { posed } from '../helpers/posed.ts';
import { mixamoFile } from '../import/fbx/mixamo-file.ts';
import { fbxBytes } from '../import/fbx/write-fbx.ts';
import { GltfMaker, glbOf as glbFile } from '../import/make-gltf.ts';
import { noDisk } from './checks/saving.ts';

/** Names of joints and where they are, and all vertices. */
interface Shape {
  readonly joints: Readonly<Record<string, readonly number[]>>;
  readonly vertices: readonly number[];
}

const shapeAt = (page: Page, name: string, seconds: number): Promise<Shape> =>
  page.evaluate(
    async ([own, time]) => {
      window.marrow.seek(time);
      await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
      const worlds = window.marrow.worldMatrices(own);
      const { joints = [] } = window.marrow.characters().find((c) => c.name === own) ?? {};
      return {
        joints: Object.fromEntries(joints.map((joint, j) => [joint.name, worlds[j].slice(12, 15)])),
        vertices: window.marrow.vertices(own),
      };
    },
    [name, seconds] as const,
  );

/** The largest distance of Mixamo's joints and of vertices. */
function distance(a: Shape, b: Shape): number {
  const names = Object.keys(a.joints).filter((name) => name.startsWith('mixamorig:'));
  expect(names).toHaveLength(19);
  expect(a.vertices).toHaveLength(b.vertices.length);
  const between = (p: readonly number[], q: readonly number[]) => Math.hypot(...p.map((value, k) => value - q[k]));
  let farthest = Math.max(...names.map((name) => between(a.joints[name], b.joints[name])));
  for (let i = 0; i < a.vertices.length; i += 3) {
    farthest = Math.max(farthest, between(a.vertices.slice(i, i + 3), b.vertices.slice(i, i + 3)));
  }
  return farthest;
}

/** @param order of the vertices in the file */
function expected(character: Character, seconds: number, scale: number, order: Iterable<number>): Shape {
  const { skeleton, skins, morphs, takes } = character;
  if (!skeleton) throw new Error('no skeleton');
  const { worlds, positions } = posed({ skeleton, skins, morphs, takes, textures: [] }, 0, seconds);
  const at = (j: number) => [12, 13, 14].map((k) => scale * worlds[16 * j + k]);
  return {
    joints: Object.fromEntries(skeleton.joints.map(({ name }, j) => [name, at(j)])),
    vertices: [...order].flatMap((v) => [0, 1, 2].map((k) => scale * positions[3 * v + k])),
  };
}

const opened = (page: Page, name: string) =>
  page.waitForFunction((own) => window.marrow.characters().some((c) => c.name === own), name);
const removeAll = (page: Page) =>
  page.evaluate(() => {
    for (const { id } of window.marrow.characters()) void window.marrow.run('character.remove', { characterId: id });
  });

/** Drawing in software takes most of the time. */
const SMALL = { width: 1024, height: 640 };
/** Seconds of the takes. */
const LENGTH = 0.4;
/** Frames of them. */
const TIMES = [0.1, 0.3];
/** Between keys. */
const POSED = 0.21;

/** Plays the hero, poses it by a slider and by a drag of the bone, and keys that. */
async function poseAndKey(page: Page): Promise<void> {
  const arm = () =>
    page.evaluate(() => {
      const { joints = [] } = window.marrow.characters().find((c) => c.name === 'hero') ?? {};
      return window.marrow.worldMatrices('hero')[joints.findIndex(({ name }) => name === 'mixamorig:LeftForeArm')];
    });
  const still = await arm();
  await page.evaluate(() => window.marrow.play());
  await expect.poll(arm).not.toEqual(still);
  await page.evaluate(() => window.marrow.pause());

  // Posed by the slider of a DOF and by a drag of the bone, and keyed.
  await shapeAt(page, 'hero', POSED);
  const search = page.getByRole('searchbox').first();
  await search.fill('LeftForeArm');
  // To the row, and what it is of.
  await search.press('Enter');
  await page.keyboard.press('Enter');
  // Selected by the search, it is in view when all rows are there again.
  await search.fill('');
  await page.locator('[role=treeitem][aria-selected=true]', { hasText: 'LeftForeArm' }).waitFor();
  // The DOFs of the joint come before those of the root.
  await page.getByRole('button', { name: /^mixamorig:LeftForeArm/ }).waitFor();
  const dof = page.locator('.dof[data-driver=driven]').first();
  const slider = await dof.locator('.lil-slider').boundingBox();
  if (!slider) throw new Error('A slider was expected.');
  await page.mouse.move(slider.x + 0.5 * slider.width, slider.y + 0.5 * slider.height);
  await page.mouse.down();
  await page.mouse.move(slider.x + 0.6 * slider.width, slider.y + 0.5 * slider.height, { steps: 3 });
  await page.mouse.up();
  await expect.poll(() => page.locator('.dof[data-driver=unkeyed]').count()).toBe(1);
  const before = await arm();
  const at = await page.evaluate(([x, y, z]) => window.marrow.pointOnPage([x, y, z], 'hero'), before.slice(12, 15));
  if (!at) throw new Error('The arm was expected on the page.');
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x, at.y - 40, { steps: 4 });
  await page.mouse.up();
  const undone = () => page.evaluate(() => window.marrow.steps().undo ?? '');
  await page.keyboard.press('k');
  await expect.poll(undone).toMatch(/^Key /);
  await expect.poll(() => page.locator('.dof[data-driver=unkeyed]').count()).toBe(0);
}

/** Retargets the hero to the walker, and from it; the walker is removed again. */
async function retarget(page: Page): Promise<void> {
  await dropFiles(page, WALKER_FILES);
  await opened(page, 'walker');
  const turns = (name: string, from: string, to: string) =>
    page.evaluate(
      async ([own, a, b]) => {
        const directions: number[][] = [];
        for (const seconds of [0.2, 0.35]) {
          window.marrow.seek(seconds);
          await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
          const { joints = [] } = window.marrow.characters().find((c) => c.name === own) ?? {};
          const worlds = window.marrow.worldMatrices(own);
          const at = (joint: string) => worlds[joints.findIndex((j) => j.name === joint)].slice(12, 15);
          const way = at(b).map((value, k) => value - at(a)[k]);
          directions.push(way.map((value) => value / Math.hypot(...way)));
        }
        return directions.flat();
      },
      [name, from, to] as const,
    );
  const ids = Object.fromEntries(
    await page.evaluate(() => window.marrow.characters().map(({ name, id }) => [name, id] as const)),
  );
  for (const [target, source] of [
    ['walker', 'hero'],
    ['hero', 'walker'],
  ]) {
    const limbs = { hero: ['mixamorig:LeftUpLeg', 'mixamorig:LeftLeg'], walker: ['thigh_l', 'shin_l'] };
    const [a, b] = [source, target].map((name) => (name === 'hero' ? limbs.hero : limbs.walker));
    await page.evaluate(([to, from]) => window.marrow.run('retarget.set', { characterId: to, sourceId: from }), [
      ids[target],
      ids[source],
    ] as const);
    const theirs = await turns(source, a[0], a[1]);
    const own = await turns(target, b[0], b[1]);
    for (const [k, value] of own.entries()) expect(Math.abs(value - theirs[k])).toBeLessThan(0.1);
    await page.evaluate(([to]) => window.marrow.run('retarget.clear', { characterId: to }), [ids[target]] as const);
  }
  await page.evaluate((id) => void window.marrow.run('character.remove', { characterId: id }), ids.walker);
}

/** From the file to text and to GLB; the page is empty afterwards. */
async function goThrough({ page, download }: OpenPage, scale: number): Promise<void> {
  const size = 2.8 * scale;
  if (scale === 1) await poseAndKey(page);
  else {
    await page.evaluate(async (seconds) => {
      window.marrow.seek(seconds);
      await window.marrow.run('pose.setDofs', { dofs: [{ index: 4, value: 0.4 }], key: {} });
    }, POSED);
  }
  const keyed = [await shapeAt(page, 'hero', POSED), await shapeAt(page, 'hero', TIMES[1])];

  // Saved as text, and opened from that.
  const zip = await download(() => page.evaluate(() => window.marrow.run('save.all')));
  expect(zip.name).toBe('hero.zip');
  const kinds = Object.keys(unzipSync(zip.bytes)).map((name) => name.replace(/.*\./, ''));
  expect(new Set(kinds)).toEqual(new Set(['rig', 'skel', 'skin', 'anim', ...(scale === 1 ? ['morph', 'png'] : [])]));
  await removeAll(page);
  await dropFiles(page, [zip]);
  await opened(page, 'hero');
  for (const [i, seconds] of [POSED, TIMES[1]].entries()) {
    const shape = await shapeAt(page, 'hero', seconds);
    expect(distance(shape, keyed[i])).toBeLessThan(1e-5 * size);
  }

  if (scale !== 1) await retarget(page);

  // Taken out as GLB, and opened from that.
  await page.evaluate(() => void window.marrow.run('save.glb'));
  const save = page.locator('.exchange-dialog button[type=submit]');
  await expect.poll(() => save.isEnabled(), { timeout: 30_000 }).toBe(true);
  // Rounded.
  const told = /off by more than ([\d.]+) at any time/.exec(
    (await page.locator('.exchange-dialog').textContent()) ?? '',
  );
  const tolerance = 1.05 * Number(told?.[1]);
  expect(tolerance).toBeLessThan(size / 1500);
  const glb = await download(() => save.click());
  expect(glb.name).toBe('hero.glb');
  await removeAll(page);
  await dropFiles(page, [glb]);
  await opened(page, 'hero');
  for (const [i, seconds] of [POSED, TIMES[1]].entries()) {
    const shape = await shapeAt(page, 'hero', seconds);
    expect(distance(shape, keyed[i])).toBeLessThan(tolerance);
  }
  await removeAll(page);
}

const inPage = inOnePage({ before: noDisk, size: SMALL });

let made: Promise<{ readonly own: Character; readonly glb: Glb }> | undefined;
/** The hero, and written as GLB, which takes long: once for all tests. */
function written(): NonNullable<typeof made> {
  made ??= hero(LENGTH).then((own) => ({ own, glb: glbOf(own) }));
  return made;
}

/** The hero as `.gltf` with a buffer and an image in files of their own. */
async function separate(): Promise<readonly DroppedFile[]> {
  const { bytes, json } = (await written()).glb;
  const bin = bytes.subarray(28 + new DataView(bytes.buffer).getUint32(12, true));
  const [image] = json.images ?? [];
  const { byteOffset, byteLength } = json.bufferViews[image.bufferView];
  const gltf = {
    ...json,
    buffers: [{ uri: 'hero%20data.bin', byteLength: bin.length }],
    images: [{ uri: 'textures/hero.png' }],
  };
  return [
    { name: 'hero.gltf', bytes: JSON.stringify(gltf) },
    { name: 'hero data.bin', bytes: bin },
    { name: 'hero.png', bytes: bin.subarray(byteOffset, byteOffset + byteLength) },
  ];
}

/** The first, since it looks for messages. */
inPage(
  'a .gltf with its files is opened from a folder, a zip, together and one by one; reading is cancelled',
  async ({ page }) => {
    const files = await separate();
    const [gltf, bin, png] = files;
    const folder = mkdtempSync(join(tmpdir(), 'marrow-gltf-'));
    try {
      const scene = join(folder, 'scene');
      mkdirSync(join(scene, 'textures'), { recursive: true });
      writeFileSync(join(scene, gltf.name), gltf.bytes);
      writeFileSync(join(scene, bin.name), bin.bytes);
      writeFileSync(join(scene, 'textures', png.name), png.bytes);
      const messages = () => page.locator('.lower').textContent();
      const said = page.locator('.message-line');
      const isWhole = async () => {
        await opened(page, 'hero');
        const [{ vertexCount, joints }] = await page.evaluate(() => window.marrow.characters());
        expect([vertexCount, joints.length]).toEqual([2019, 32]);
        await expect.poll(messages).toContain('Problems in your files appear here');
        await removeAll(page);
      };
      await dropPaths(page, [scene]);
      await isWhole();
      const zip = zipSync({
        'scene/hero.gltf': Buffer.from(gltf.bytes),
        'scene/hero data.bin': Buffer.from(bin.bytes),
        'scene/textures/hero.png': Buffer.from(png.bytes),
      });
      await dropFiles(page, [{ name: 'scene.zip', bytes: zip }]);
      await isWhole();
      await dropFiles(page, files);
      await isWhole();

      // One by one: what is missing is named, and nothing is opened without it.
      const parts = files.map((file) => ({ ...file, name: file.name.replace('hero', 'solo') }));
      const solo = { ...parts[0], bytes: String(gltf.bytes).replace('hero%20data', 'solo%20data') };
      await dropFiles(page, [solo]);
      await expect.poll(() => said.textContent()).toContain('solo%20data.bin');
      await expect.poll(() => page.evaluate(() => window.marrow.characters().length)).toBe(0);
      await dropFiles(page, [parts[1]]);
      await opened(page, 'solo');
      // And again, edited in another program.
      const renamed = { ...solo, bytes: solo.bytes.replace('mixamorig:Hips', 'mixamorig:Pelvis') };
      await dropFiles(page, [renamed]);
      const names = () => page.evaluate(() => window.marrow.characters()[0].joints.map(({ name }) => name));
      await expect.poll(names).toContain('mixamorig:Pelvis');
      await expect.poll(() => page.evaluate(() => window.marrow.characters().length)).toBe(1);

      // Large enough to be read for a while.
      const large = join(folder, 'large.glb');
      writeFileSync(large, largeGlb());
      const before = await page.evaluate(() => window.marrow.steps());
      // At once when it is said to be read, however fast that is.
      await page.evaluate(() => {
        const loaded = document.querySelector<HTMLElement>('.loaded');
        if (!loaded) throw new Error('The progress was expected.');
        new MutationObserver(() => {
          if (!loaded.textContent?.includes('large.glb')) return;
          document.body.dataset.read ??= loaded.textContent;
          [...loaded.querySelectorAll('button')].find(({ textContent }) => textContent === 'Cancel')?.click();
        }).observe(loaded, { subtree: true, childList: true, characterData: true });
      });
      await dropPaths(page, [large]);
      await expect.poll(() => said.textContent()).toContain('Open cancelled. Nothing was changed.');
      await expect.poll(() => page.evaluate(() => document.body.dataset.read)).toMatch(/Reading large\.glb, .* of \d/);
      await expect.poll(() => page.evaluate(() => window.marrow.steps())).toEqual(before);
      await expect.poll(() => names()).toContain('mixamorig:Pelvis');
      await dropFiles(page, [{ name: 'post.skel', bytes: 'balljoint post { }' }]);
      await opened(page, 'post');
    } finally {
      rmSync(folder, { recursive: true });
    }
  },
);

/** Points enough to be read for a while. */
function largeGlb(): Uint8Array {
  const maker = new GltfMaker();
  const POSITION = maker.add(
    'VEC3',
    new Float32Array(9 * LARGE).map((_, i) => (i * 7919) % 1009),
  );
  const made = maker.made({
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION } }] }],
  });
  return glbFile(made);
}

/** Triangles. */
const LARGE = 150_000;

inPage(
  'a VRM is played and posed, an FBX file like Mixamo’s retargeted, and both are keyed, saved as text and as GLB',
  async (open) => {
    const { page } = open;
    await removeAll(page);
    const { own, glb } = await written();
    const frames = Array.from({ length: 30 * LENGTH + 1 }, (_, f) => f / 30);
    const { triangles, positions } = own.skins[0];
    const files = [
      {
        name: 'hero.vrm',
        bytes: vrmOf(glb),
        scale: 1,
        within: 1 / 2000,
        of: own,
        order: Array.from({ length: positions.length / 3 }, (_, v) => v),
      },
      {
        name: 'hero.fbx',
        // At frames, in centimetres; keys are floats. Vertices come in the order of the corners of triangles.
        bytes: fbxBytes(mixamoFile(own, frames, 100)),
        scale: 100,
        within: 1e-4,
        of: { ...own, morphs: [] },
        order: new Set(triangles),
      },
    ];
    for (const { name, bytes, scale, within, of, order } of files) {
      await dropFiles(page, [{ name, bytes }]);
      await opened(page, 'hero');
      for (const seconds of TIMES) {
        const shape = await shapeAt(page, 'hero', seconds);
        expect(distance(shape, expected(of, seconds, scale, order))).toBeLessThan(2.8 * scale * within);
      }
      await goThrough(open, scale);
    }
  },
);
