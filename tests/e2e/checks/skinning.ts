/** The page that draws skins alone, in any browser: vertices and pixels read back, and compared with the core. */
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { createServer } from 'vite';
import { expect } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { blendMorphs, compileSkin, deform } from '../../../src/evaluate/skin/deform.ts';
import { readMorph } from '../../../src/formats/morph/read.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { readSkin } from '../../../src/formats/skin/read.ts';
import { expectClose, WITHIN } from '../../helpers/close.ts';
import { sharedPath } from '../../helpers/shared.ts';
import type { Case, Picture } from '../pages/skinning.ts';

const ROOT = fileURLToPath(new URL('../../../', import.meta.url));

export interface SkinningPage {
  readonly page: Page;
  /** Warnings and errors so far. */
  readonly problems: readonly string[];
  close(): Promise<void>;
}

/** Opens the page of `tests/e2e/pages/skinning.ts`. */
export async function openSkinning(browser: Browser): Promise<SkinningPage> {
  const cacheDir = mkdtempSync(join(tmpdir(), 'marrow-vite-'));
  // The sources unbundled, without the project's own configuration.
  const server = await createServer({
    root: ROOT,
    configFile: false,
    cacheDir,
    logLevel: 'error',
    optimizeDeps: { noDiscovery: true },
    server: { port: 0, hmr: false, watch: null },
  });
  await server.listen();
  const page = await browser.newPage();
  const problems: string[] = [];
  page.on('console', (message) => {
    const isReadBack = message.text().includes('GPU stall due to ReadPixels');
    if (/error|warning/.test(message.type()) && !isReadBack) problems.push(message.text());
  });
  page.on('pageerror', (error) => problems.push(String(error)));
  const [url] = server.resolvedUrls?.local ?? [];
  await page.goto(`${url}tests/e2e/pages/skinning.html`);
  await page.waitForFunction(() => 'harness' in window);
  return {
    page,
    problems,
    async close() {
      await page.close();
      await server.close();
      rmSync(cacheDir, { recursive: true, force: true });
    },
  };
}

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

/** Vertices and normals on the GPU are the core's. */
export async function expectVertices(page: Page, what: Case): Promise<void> {
  const expected = reference(what);
  const got = await page.evaluate((w) => window.harness.vertices(w), what);
  const largest = expected.positions.reduce((most, x) => Math.max(most, Math.abs(x)), 1);
  const scaled = (list: ArrayLike<number>) => Array.from(list, (x) => x / largest);
  expectClose(scaled(got.positions), scaled(expected.positions), WITHIN.referenceFloat, 'positions on the GPU');
  expectClose(scaled(got.asked), scaled(expected.positions), WITHIN.referenceFloat, 'positions from getVertexPosition');
  // Unit normals from sums that may cancel: a wider tolerance than for positions.
  expectClose(got.normals, expected.normals, 20 * WITHIN.referenceFloat, 'normals on the GPU');
}

/** RGBA, bottom row first. */
export const bytesOf = ({ pixels }: Picture): Uint8Array => Buffer.from(pixels, 'base64');

/** Number of covered pixels that differ noticeably. */
export function differing(a: Picture, b: Picture, hair = 6): number {
  const [one, other] = [bytesOf(a), bytesOf(b)];
  let count = 0;
  for (let i = 0; i < one.length; i += 4) {
    let c = 0;
    while (c < 4 && Math.abs(one[i + c] - other[i + c]) <= hair) c++;
    if (c < 4) count++;
  }
  return count;
}

/** Three joints in a chain, and vertices with the given lists of attachments, with their own positions and normals. */
export function madeUp(lists: readonly (readonly (readonly [number, number])[])[], bindings: readonly string[]): Case {
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

export const IDENTITY = '1 0 0  0 1 0  0 0 1  0 0 0';
export const MOVED = '0 1 0  -1 0 0  0 0 1  0.5 2 -1';
export const SCALED = '2 0 0  0 0.5 0  0.3 0 1.5  0 1 0';
/** Lists of 0 to 9 attachments, whose weights sum to anything. */
export const LISTS = Array.from({ length: 10 }, (_, n) =>
  Array.from({ length: n }, (_, i) => [i % 3, 0.35 - 0.04 * i + 0.02 * n] as const),
);

export const file = (path: string) => readFileSync(sharedPath(path), 'latin1');
/** The files in a pose that moves every joint, or at rest. */
export function course(
  skel: string,
  skin: string,
  { bend = 0.5, far = 0, weights = [] as readonly number[] } = {},
): Case {
  const text = file(`data/${skel}`);
  const { dofCount } = compileSkeleton(need(readSkel(text, skel).value)[0]);
  const pose = [far, far, far, ...Array.from({ length: dofCount }, (_, d) => bend * Math.sin(7 * d)), ...weights];
  return { skel: text, skin: file(`data/${skin}`), pose };
}
export const AT_REST = { bend: 0 };

/** The reference's skins, in poses that move every joint. */
export const REFERENCE_SKINS: readonly (readonly [string, () => Case])[] = [
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

/** A texture from a BMP is drawn, v upward, and a broken one is not. */
/** Pixels without green and blue, which no lit texture of the tests has. */
function redPixels(picture: Picture): number {
  const pixels = bytesOf(picture);
  let count = 0;
  for (let i = 0; i < pixels.length; i += 4) if (pixels[i] > 60 && pixels[i + 1] < 8 && pixels[i + 2] < 8) count++;
  return count;
}

export async function expectTexture(page: Page): Promise<void> {
  const styled = (what: Case, display: object) =>
    page.evaluate(([w, d]) => window.harness.styled(w, d), [what, display] as const);
  const base64 = readFileSync(sharedPath('data/cse169/head.bmp')).toString('base64');
  const what = course('cse169/head.skel', 'cse169/head_tex.skin', AT_REST);
  const texture = { name: 'head.bmp', mime: 'image/bmp', base64 };
  const plain = await styled(what, { skin: 'textured' });
  const drawn = await styled({ ...what, texture }, { skin: 'textured' });
  expect(drawn.drawn).toBe(plain.drawn);
  expect(differing(plain, drawn, 20)).toBeGreaterThan(0.5 * drawn.drawn);
  const painted = what.skin.replace(/(triangles )(\d+)( \{\n)([\s\S]*?)(\})/, (_, head, count, open, rows, close) => {
    const all = rows.trim().split('\n');
    const block = (some: string[]) => `${head}${some.length}${open}${some.join('\n')}\n${close}\n`;
    expect(all).toHaveLength(Number(count));
    const [first, second] = [all.slice(0, count / 2), all.slice(count / 2)];
    return `${block(first)}material red { color 1 0 0 }\n${block(second)}`;
  });
  const halves = await styled({ ...what, skin: painted, texture }, { skin: 'textured' });
  expect(halves.drawn).toBe(drawn.drawn);
  const red = redPixels(halves);
  expect(red).toBeGreaterThan(0.2 * drawn.drawn);
  expect(differing(drawn, halves, 20)).toBeGreaterThan(0.8 * red);
  expect(differing(drawn, halves, 20)).toBeLessThan(drawn.drawn - 0.2 * drawn.drawn);
  const broken = { ...texture, base64: btoa('no picture') };
  const without = await styled({ ...what, texture: broken }, { skin: 'textured' });
  expect(differing(plain, without)).toBe(0);
}
