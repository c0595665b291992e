/** Skinning on a real GPU (or in software): vertices and pixels read back and compared with the core. */
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { sharedChromium } from '../helpers/page.ts';
import { describeShared } from '../helpers/shared.ts';
import {
  AT_REST,
  bytesOf,
  course,
  differing,
  expectTexture,
  expectVertices,
  IDENTITY,
  LISTS,
  MOVED,
  madeUp,
  openSkinning,
  REFERENCE_SKINS,
  SCALED,
  type SkinningPage,
} from './checks/skinning.ts';
import type { Case, Picture } from './pages/skinning.ts';

let harness: SkinningPage;

beforeAll(async () => {
  harness = await openSkinning(await sharedChromium());
}, 120_000);

afterAll(() => harness?.close());

const ask = {
  pictures: (what: Case) => harness.page.evaluate((w) => window.harness.pictures(w), what),
  styled: (what: Case, display: object, joint?: number) =>
    harness.page.evaluate(([w, d, j]) => window.harness.styled(w, d, j), [what, display, joint] as const),
  turned: (what: Case, plain: boolean) =>
    harness.page.evaluate(([w, p]) => window.harness.turned(w, p), [what, plain] as const),
};

describe('vertices as the GPU makes them', () => {
  it('follow 0 to 9 attachments, with weights that do not sum to 1 and bindings with scale and shear', async () => {
    await expectVertices(harness.page, madeUp(LISTS, [IDENTITY, MOVED, SCALED]));
  });

  it('vertices as the GPU makes them do so far from the origin', async () => {
    const what = madeUp(LISTS, [IDENTITY, MOVED, SCALED]);
    await expectVertices(harness.page, { ...what, pose: what.pose.map((x, d) => (d < 3 ? 20_000 * x : x)) });
  });

  it('vertices as the GPU makes them do so with four attachments at most', async () => {
    await expectVertices(harness.page, madeUp(LISTS.slice(0, 5), [MOVED, SCALED, IDENTITY]));
  });

  it('vertices as the GPU makes them stay where they are without a skeleton', async () => {
    const { skel: _, ...what } = madeUp(LISTS, [IDENTITY, MOVED, SCALED]);
    await expectVertices(harness.page, { ...what, pose: [1, 2, 3] });
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
    await expectVertices(harness.page, { ...what, morphs, pose: [...what.pose, 1.5, -0.5], idleMorphs });
  });

  it('had no complaint from WebGL', () => expect(harness.problems).toEqual([]));
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
      const lit = await ask.turned({ ...square('-0.3 -0.3 0.9'), winding }, false);
      expect(differing(right, lit, 0)).toBe(0);
    }
  });

  it('had no complaint from WebGL', () => expect(harness.problems).toEqual([]));
});

describeShared('the reference’s skins in a real browser', () => {
  it.each(REFERENCE_SKINS)('%s: vertices are the core’s', async (_, make) => expectVertices(harness.page, make()));

  it.each(REFERENCE_SKINS)('%s: the picture, shadow included, is that of the core’s vertices', async (_, make) => {
    const { skinned, rigid } = await ask.pictures(make());
    // Except for edge pixels, which rounding may change.
    expect(differing(skinned, rigid)).toBeLessThan(0.004 * skinned.drawn);
  });

  it.each([
    ['cse169/tube.skel', 'cse169/tube_smooth.skin'],
    ['cse169/wasp.skel', 'cse169/wasp.skin'],
  ])('%s, %s: no triangle is dark for its winding', async (skel, skin) => {
    const what = course(skel, skin, AT_REST);
    const away = (picture: Picture) => {
      const pixels = bytesOf(picture);
      let count = 0;
      // Blue is the normal's component toward the viewer: 128 is 0.
      for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 0 && pixels[i + 2] < 127) count++;
      return count;
    };
    const given = await ask.turned(what, false);
    expect(given.drawn).toBeGreaterThan(1000);
    expect(away(given)).toBe(0);
    // With three.js's own chunk there are some.
    const stock = await ask.turned(what, true);
    expect(away(stock)).toBeGreaterThan(0.05 * given.drawn);
    for (const winding of ['reversed', 'mixed'] as const) {
      const turned = await ask.turned({ ...what, winding }, false);
      expect(differing(given, turned)).toBeLessThan(0.002 * given.drawn);
    }
  });

  it('draws every style, of any number of attachments', async () => {
    for (const [, make] of REFERENCE_SKINS.slice(4)) {
      const what = make();
      const solid = await ask.styled(what, { skin: 'solid' });
      expect(solid.drawn).toBeGreaterThan(500);
      const hidden = await ask.styled(what, { skin: 'hidden' });
      expect(hidden.drawn).toBe(0);
      for (const skin of ['textured', 'wire', 'xray', 'heat', 'four'] as const) {
        const styled = await ask.styled(what, { skin }, 0);
        expect(styled.drawn).toBeGreaterThan(200);
      }
      const normals = await ask.styled(what, { skin: 'hidden', normals: true });
      expect(normals.drawn).toBeGreaterThan(50);
    }
  });

  it('draws a texture from a BMP, v upward', () => expectTexture(harness.page));

  it('had no complaint from WebGL', () => expect(harness.problems).toEqual([]));
});
