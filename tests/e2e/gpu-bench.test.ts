/** What `npm run bench -- gpu` measures with, in software: that both pages draw and every frame of them is seen. */
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { Pages, type Reference } from '../bench/gpu/pages.ts';
import { builtPeer } from '../bench/gpu/peer/build.ts';
import { SMALL, scenesOf } from '../bench/gpu/scenes/scenes.ts';
import { sharedChromium } from '../helpers/page.ts';
import { type StaticServer, serveFolder } from '../helpers/server.ts';

let server: StaticServer;
let pages: Pages;

beforeAll(async () => {
  server = await serveFolder(fileURLToPath(new URL('../../dist', import.meta.url)), '/');
  // Small and without a second of warming up, since nothing is measured.
  const how = { size: { width: 960, height: 500 }, warmUpSeconds: 0.01 };
  pages = new Pages(await sharedChromium(), server, await builtPeer(), 0.01, false, how);
});

afterAll(async () => {
  await server?.close();
});

it('frames of the built page are seen whole, with their script, and how long its files took to open', async () => {
  const scene = scenesOf(SMALL).find(({ name }) => name === 'morphs');
  if (!scene) throw new Error('There is no such scene.');
  const { frames, openingMs } = await pages.marrow(scene);
  expect(frames.whole.length).toBeGreaterThanOrEqual(5);
  expect(Math.min(...frames.whole, openingMs ?? 0)).toBeGreaterThan(0);
  expect(Math.max(...frames.script)).toBeGreaterThan(0);
});

it('three.js alone draws the walker that the built page writes, on a canvas as large, and the tentacle', async () => {
  // To find the keys that are needed would take half of the time of these tests.
  const reference = await pages.reference(10);
  expect(reference.size.width).toBeGreaterThan(400);
  const small: Reference = { ...reference, size: { width: 160, height: 120 } };
  for (const scene of [
    { kind: 'walkers', count: 2 },
    { kind: 'tentacle', vertices: 2000 },
  ] as const) {
    const { whole, script } = await pages.threeAlone(scene, small);
    expect(whole.length).toBeGreaterThanOrEqual(5);
    expect(script.length).toBeGreaterThanOrEqual(whole.length - 1);
  }
});
