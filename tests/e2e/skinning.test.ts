/** Skinning on a real GPU (or in software): vertices and pixels read back and compared with the core. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { createServer, type ViteDevServer } from 'vite';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { blendMorphs, compileSkin, deform } from '../../src/evaluate/deform.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { readMorph } from '../../src/formats/morph/read.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { readSkin } from '../../src/formats/skin/read.ts';
import { launchChromium } from '../helpers/chromium.ts';
import { expectClose, WITHIN } from '../helpers/close.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';
import type { Case, Picture } from './pages/skinning.ts';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));
const cacheDir = mkdtempSync(join(tmpdir(), 'marrow-vite-'));
let server: ViteDevServer;
let browser: Browser;
let page: Page;
const problems: string[] = [];

beforeAll(async () => {
  // The sources unbundled, without the project's own configuration.
  server = await createServer({
    root: ROOT,
    configFile: false,
    cacheDir,
    logLevel: 'error',
    optimizeDeps: { noDiscovery: true },
    server: { port: 0, hmr: false, watch: null },
  });
  await server.listen();
  browser = await launchChromium();
  page = await browser.newPage();
  page.on('console', (message) => {
    const isReadBack = message.text().includes('GPU stall due to ReadPixels');
    if (/error|warning/.test(message.type()) && !isReadBack) problems.push(message.text());
  });
  page.on('pageerror', (error) => problems.push(String(error)));
  const [url] = server.resolvedUrls?.local ?? [];
  await page.goto(`${url}tests/e2e/pages/skinning.html`);
  await page.waitForFunction(() => 'harness' in window);
}, 120_000);

afterAll(async () => {
  await browser?.close();
  await server?.close();
  rmSync(cacheDir, { recursive: true, force: true });
});

const ask = {
  vertices: (what: Case) => page.evaluate((w) => window.harness.vertices(w), what),
  pictures: (what: Case) => page.evaluate((w) => window.harness.pictures(w), what),
  styled: (what: Case, display: object, joint?: number) =>
    page.evaluate(([w, d, j]) => window.harness.styled(w, d, j), [what, display, joint] as const),
  turned: (what: Case, plain: boolean) =>
    page.evaluate(([w, p]) => window.harness.turned(w, p), [what, plain] as const),
};

function need<T>(value: T | undefined): T {
  if (value === undefined) throw new Error('The test’s own file does not load.');
  return value;
}

/** The core's result, in doubles. */
function reference(what: Case): { positions: Float64Array; normals: Float64Array } {
  const skin = need(readSkin(what.skin, 'a.skin').value);
  const compiled = compileSkin(skin);
  const morphs = (what.morphs ?? []).map((text) => need(readMorph(text, 'a.morph').value));
  const dofs = Float64Array.from(what.pose);
  const positions = new Float64Array(skin.positions.length);
  const normals = new Float64Array(skin.positions.length);
  blendMorphs(compiled, morphs, dofs, dofs.length - morphs.length, positions, normals);
  let world: Float64Array | undefined;
  if (what.skel) {
    const skeleton = compileSkeleton(need(readSkel(what.skel, 'a.skel').value)[0]);
    world = new Float64Array(16 * skeleton.jointCount);
    worldMatrices(skeleton, dofs, world);
  }
  deform(compiled, world, positions, normals, positions, normals);
  return { positions, normals };
}

async function expectVertices(what: Case): Promise<void> {
  const expected = reference(what);
  const got = await ask.vertices(what);
  const largest = expected.positions.reduce((most, x) => Math.max(most, Math.abs(x)), 1);
  const scaled = (list: ArrayLike<number>) => Array.from(list, (x) => x / largest);
  expectClose(scaled(got.positions), scaled(expected.positions), WITHIN.referenceFloat, 'positions on the GPU');
  expectClose(scaled(got.asked), scaled(expected.positions), WITHIN.referenceFloat, 'positions from getVertexPosition');
  // Unit normals from sums that may cancel: a wider tolerance than for positions.
  expectClose(got.normals, expected.normals, 20 * WITHIN.referenceFloat, 'normals on the GPU');
}

/** Number of covered pixels that differ noticeably. */
function differing(a: Picture, b: Picture, hair = 6): number {
  let count = 0;
  for (let i = 0; i < a.pixels.length; i += 4) {
    const off = Math.max(...[0, 1, 2, 3].map((c) => Math.abs(a.pixels[i + c] - b.pixels[i + c])));
    if (off > hair) count++;
  }
  return count;
}

/** Three joints in a chain, and vertices with the given lists of attachments, with their own positions and normals. */
function madeUp(lists: readonly (readonly (readonly [number, number])[])[], bindings: readonly string[]): Case {
  const rows = (value: (v: number) => readonly number[]) => lists.map((_, v) => value(v).join(' ')).join('\n');
  const skin = `
positions ${lists.length} { ${rows((v) => [Math.sin(v), Math.cos(2 * v), v / 5])} }
normals ${lists.length} { ${rows((v) => [0.6, v % 2 ? 0.8 : -0.8, 0.1 * v])} }
skinweights ${lists.length} { ${lists.map((l) => `${l.length} ${l.map(([j, w]) => `${j} ${w}`).join(' ')}`).join('\n')} }
triangles 0 { }
bindings ${bindings.length} { ${bindings.map((m) => `matrix { ${m} }`).join('\n')} }`;
  const skel = 'balljoint a { offset 0 1 0 balljoint b { offset 0 1 0.5 balljoint c { offset 0.3 1 0 } } }';
  return { skel, skin, pose: [0.2, -0.3, 0.4, 0.5, 0.6, -0.7, 0.8, -0.9, 1, 0.3, -0.2, 0.1] };
}

const IDENTITY = '1 0 0  0 1 0  0 0 1  0 0 0';
const MOVED = '0 1 0  -1 0 0  0 0 1  0.5 2 -1';
const SCALED = '2 0 0  0 0.5 0  0.3 0 1.5  0 1 0';
/** Lists of 0 to 9 attachments, whose weights sum to anything. */
const LISTS = Array.from({ length: 10 }, (_, n) =>
  Array.from({ length: n }, (_, i) => [i % 3, 0.35 - 0.04 * i + 0.02 * n] as const),
);

describe('vertices as the GPU makes them', () => {
  it('follow 0 to 9 attachments, with weights that do not sum to 1 and bindings with scale and shear', async () => {
    await expectVertices(madeUp(LISTS, [IDENTITY, MOVED, SCALED]));
  });

  it('vertices as the GPU makes them do so far from the origin', async () => {
    const what = madeUp(LISTS, [IDENTITY, MOVED, SCALED]);
    await expectVertices({ ...what, pose: what.pose.map((x, d) => (d < 3 ? 20_000 * x : x)) });
  });

  it('vertices as the GPU makes them do so with four attachments at most', async () => {
    await expectVertices(madeUp(LISTS.slice(0, 5), [MOVED, SCALED, IDENTITY]));
  });

  it('vertices as the GPU makes them stay where they are without a skeleton', async () => {
    const { skel: _, ...what } = madeUp(LISTS, [IDENTITY, MOVED, SCALED]);
    await expectVertices({ ...what, pose: [1, 2, 3] });
  });

  it.each([
    ['on the GPU', 0],
    ['on the CPU, past the 2,048 of three.js’s texture', 2100],
  ])('vertices as the GPU makes them are morphed before they are skinned, normals too, %s', async (_, idleMorphs) => {
    const what = madeUp(LISTS, [IDENTITY, MOVED, SCALED]);
    const morphs = [
      'positions 2 { 3 1 2 3  6 0 0 1 } normals 1 { 3 0 0 1 }',
      'positions 2 { 3 -1 0 0  0 5 5 5 } normals 2 { 3 1 0 0 0 0 1 0 }',
    ];
    await expectVertices({ ...what, morphs, pose: [...what.pose, 1.5, -0.5], idleMorphs });
  });

  it('had no complaint from WebGL', () => expect(problems).toEqual([]));
});

describe('light', () => {
  /** A square of four triangles around its centre, facing +z; one corner's normal may be flipped. */
  const square = (corner: string): Case => ({
    skin: `
positions 5 { -1 -1 0  1 -1 0  1 1 0  -1 1 0  0 0 0.1 }
normals 5 { ${corner}  0.3 -0.3 0.9  0.3 0.3 0.9  -0.3 0.3 0.9  0 0 1 }
skinweights 0 { }
triangles 4 { 0 1 4  1 2 4  2 3 4  3 0 4 }
bindings 0 { }`,
    pose: [0, 0, 0],
  });

  it('light falls on a corner whose normal points inward as if it pointed outward, without a tear', async () => {
    const right = await ask.turned(square('-0.3 -0.3 0.9'), false);
    const wrong = await ask.turned(square('0.3 0.3 -0.9'), false);
    expect(right.drawn).toBeGreaterThan(1000);
    expect(differing(right, wrong, 0)).toBe(0);
    // Differs if only the winding is used.
    const plain = await ask.turned(square('0.3 0.3 -0.9'), true);
    expect(differing(right, plain)).toBeGreaterThan(0.1 * right.drawn);
  });

  it('light falls on either winding, and on triangles wound differently, alike', async () => {
    const right = await ask.turned(square('-0.3 -0.3 0.9'), false);
    for (const winding of ['reversed', 'mixed'] as const) {
      expect(differing(right, await ask.turned({ ...square('-0.3 -0.3 0.9'), winding }, false), 0)).toBe(0);
    }
  });

  it('had no complaint from WebGL', () => expect(problems).toEqual([]));
});

const file = (path: string) => readFileSync(sharedPath(path), 'latin1');
/** The files in a pose that moves every joint, or at rest. */
function course(skel: string, skin: string, { bend = 0.5, far = 0, weights = [] as readonly number[] } = {}): Case {
  const text = file(`data/${skel}`);
  const { dofCount } = compileSkeleton(need(readSkel(text, skel).value)[0]);
  const pose = [far, far, far, ...Array.from({ length: dofCount }, (_, d) => bend * Math.sin(7 * d)), ...weights];
  return { skel: text, skin: file(`data/${skin}`), pose };
}
const AT_REST = { bend: 0 };

describeShared('the reference’s skins in a real browser', () => {
  const all: readonly (readonly [string, () => Case])[] = [
    ['wasp', () => course('cse169/wasp.skel', 'cse169/wasp.skin')],
    ['wasp, far away', () => course('cse169/wasp.skel', 'cse169/wasp.skin', { far: 300 })],
    ['tube_smooth', () => course('cse169/tube.skel', 'cse169/tube_smooth.skin')],
    ['six attachments', () => course('synthetic/six.skel', 'synthetic/six.skin')],
    ['nine attachments', () => course('synthetic/nine.skel', 'synthetic/nine.skin')],
    [
      'head, morphed',
      () => ({
        ...course('cse169/head.skel', 'cse169/head.skin', { weights: [0.7, -0.4] }),
        morphs: [file('data/cse169/head1.morph'), file('data/cse169/head2.morph')],
      }),
    ],
  ];

  it.each(all)('%s: vertices are the core’s', async (_, make) => expectVertices(make()));

  it.each(all)('%s: the picture, shadow included, is that of the core’s vertices', async (_, make) => {
    const { skinned, rigid } = await ask.pictures(make());
    // Except for edge pixels, which rounding may change.
    expect(differing(skinned, rigid)).toBeLessThan(0.004 * skinned.drawn);
  });

  it.each([
    ['cse169/tube.skel', 'cse169/tube_smooth.skin'],
    ['cse169/wasp.skel', 'cse169/wasp.skin'],
  ])('%s, %s: no triangle is dark for its winding', async (skel, skin) => {
    const what = course(skel, skin, AT_REST);
    const away = ({ pixels }: Picture) => {
      let count = 0;
      // Blue is the normal's component toward the viewer: 128 is 0.
      for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 0 && pixels[i + 2] < 127) count++;
      return count;
    };
    const given = await ask.turned(what, false);
    expect(given.drawn).toBeGreaterThan(1000);
    expect(away(given)).toBe(0);
    // With three.js's own chunk there are some.
    expect(away(await ask.turned(what, true))).toBeGreaterThan(0.05 * given.drawn);
    for (const winding of ['reversed', 'mixed'] as const) {
      expect(differing(given, await ask.turned({ ...what, winding }, false))).toBeLessThan(0.002 * given.drawn);
    }
  });

  it('draws every style, of any number of attachments', async () => {
    for (const [, make] of all.slice(4)) {
      const what = make();
      const solid = await ask.styled(what, { skin: 'solid' });
      expect(solid.drawn).toBeGreaterThan(500);
      const hidden = await ask.styled(what, { skin: 'hidden' });
      expect(hidden.drawn).toBe(0);
      for (const skin of ['textured', 'wire', 'xray', 'heat'] as const) {
        expect((await ask.styled(what, { skin }, 0)).drawn).toBeGreaterThan(200);
      }
      expect((await ask.styled(what, { skin: 'hidden', normals: true })).drawn).toBeGreaterThan(50);
    }
  });

  it('draws a texture from a BMP, v upward', async () => {
    const base64 = readFileSync(sharedPath('data/cse169/head.bmp')).toString('base64');
    const what = course('cse169/head.skel', 'cse169/head_tex.skin', AT_REST);
    const texture = { name: 'head.bmp', mime: 'image/bmp', base64 };
    const plain = await ask.styled(what, { skin: 'textured' });
    const drawn = await ask.styled({ ...what, texture }, { skin: 'textured' });
    expect(drawn.drawn).toBe(plain.drawn);
    expect(differing(plain, drawn, 20)).toBeGreaterThan(0.5 * drawn.drawn);
    const broken = { ...texture, base64: btoa('no picture') };
    expect(differing(plain, await ask.styled({ ...what, texture: broken }, { skin: 'textured' }))).toBe(0);
  });

  it('had no complaint from WebGL', () => expect(problems).toEqual([]));
});
