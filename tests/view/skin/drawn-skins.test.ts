import { type Mesh, PerspectiveCamera, type Sphere } from 'three';
import { describe, expect, it } from 'vitest';
import { DEFAULT_PLACEMENT } from '../../../src/model/document.ts';
import { DEFAULT_DISPLAY, type Display } from '../../../src/model/session.ts';
import type { Skin } from '../../../src/model/skin.ts';
import { CharacterView } from '../../../src/view/character-view.ts';
import { DrawnSkins } from '../../../src/view/skin/drawn-skins.ts';
import { placedOf } from '../../../src/view/skin/shared-skins.ts';
import { character, joint, skin } from '../../helpers/builders.ts';

const SKELETON = { name: 'one', joints: [joint(-1)] };
const HEIGHT = 0.5;

/** A character with a skin of its own, equal to all others unless said otherwise, at x z. */
function at(id: string, x: number, z: number, own: Partial<Skin> = {}) {
  return character({
    id,
    skeleton: { ...SKELETON },
    skins: [{ ...skin(id, 0), positions: Float64Array.of(0, 0, 0, 0.1, HEIGHT, 0, -0.1, HEIGHT, 0), ...own }],
    placements: [{ ...DEFAULT_PLACEMENT, position: [x, 0, z] }],
  });
}

/** Looks from z = 10 towards the origin, and sees about 5 to each side there. */
function seen(): PerspectiveCamera {
  const camera = new PerspectiveCamera(53, 1, 0.1, 100);
  camera.position.z = 10;
  camera.updateMatrixWorld();
  return camera;
}

function shown(characters: readonly ReturnType<typeof at>[], display: Partial<Display> = {}) {
  const skins = new DrawnSkins();
  const views = characters.map((each) => {
    const view = new CharacterView(skins);
    view.show(each, { ...DEFAULT_DISPLAY, skin: 'solid', ...display }, undefined);
    return view;
  });
  const batches = () => skins.object.children.filter(({ visible }) => visible) as Mesh[];
  /** Of each batch the views that it draws, in order. */
  const drawn = () =>
    batches().map(({ geometry }) => {
      const count = 'instanceCount' in geometry ? Number(geometry.instanceCount) : 0;
      const placed = placedOf(geometry);
      return Array.from({ length: count }, (_, i) =>
        views.findIndex((view) => view.skinnedMeshes[0]?.skeleton.firstMatrix === placed.getY(i)),
      );
    });
  return { skins, views, batches, drawn };
}

describe('skins that are drawn', () => {
  it('skins that are equal are drawn at once, from files of their own too, the nearest first', () => {
    const { skins, drawn, views } = shown([at('a', 0, -3), at('b', 1, 2), at('c', -1, 0)]);
    skins.aim(seen());
    expect(drawn()).toEqual([[1, 2, 0]]);
    expect(new Set(views.map((view) => view.skinnedMeshes[0].geometry)).size).toBe(1);
  });

  it('skins that are transparent are drawn the farthest first', () => {
    const { skins, drawn } = shown([at('a', 0, -3), at('b', 1, 2), at('c', -1, 0)], { skin: 'xray' });
    skins.aim(seen());
    expect(drawn()).toEqual([[0, 2, 1]]);
  });

  it.each([
    ['a vertex', { positions: Float64Array.of(0, 0, 0, 0.1, HEIGHT, 0.01, -0.1, HEIGHT, 0) }],
    ['a normal', { normals: Float64Array.of(0, 1, 0, 0, 0, 1, 0, 0, 1) }],
    ['a triangle', { triangles: Uint32Array.of(0, 2, 1) }],
    ['weights', { attachments: attached(0.5) }],
  ])('skins that differ in %s are drawn apart', (_, own) => {
    const same = { attachments: attached(1) };
    const { skins, drawn } = shown([at('a', 0, 0, same), at('b', 1, 0, { ...same, ...own }), at('c', 2, 0, same)]);
    skins.aim(seen());
    expect(drawn().sort((a, b) => a.length - b.length)).toEqual([[1], [0, 2]]);
  });

  it('skins out of view are not drawn, unless their shadow may be in it', () => {
    const { skins, drawn } = shown([at('near', 0, 0), at('beside', 30, 0), at('behind', 0, 30)]);
    skins.aim(seen());
    expect(drawn()).toEqual([[0]]);
    skins.aim(seen(), ({ center }: Sphere) => center.x > 20);
    expect(drawn()).toEqual([[0, 1]]);
    const turned = seen();
    turned.position.set(0, 0, 40);
    turned.updateMatrixWorld();
    skins.aim(turned);
    expect(drawn()).toEqual([[2, 0]]);
  });

  it('what is drawn is uploaded again only when it changes', () => {
    const { skins, views, batches } = shown([at('a', 0, 0), at('b', 1, 0)]);
    skins.aim(seen());
    const { version } = placedOf(batches()[0].geometry);
    for (let frame = 0; frame < 3; frame++) {
      for (const view of views) view.seek(frame);
      skins.aim(seen());
    }
    expect(placedOf(batches()[0].geometry).version).toBe(version);
    views[0].setVisible(false);
    skins.aim(seen());
    expect(placedOf(batches()[0].geometry).version).toBeGreaterThan(version);
  });

  it('skins that are hidden, changed or gone leave nothing behind', () => {
    const { skins, views, batches } = shown([at('a', 0, 0), at('b', 1, 0)]);
    views[0].setVisible(false);
    views[1].show(at('b', 1, 0), { ...DEFAULT_DISPLAY, skin: 'hidden' }, undefined);
    expect(skins.object.children).toEqual([]);
    views[0].setVisible(true);
    skins.aim(seen());
    expect(batches()).toHaveLength(1);
    let freed = 0;
    views[0].skinnedMeshes[0].geometry.addEventListener('dispose', () => freed++);
    views[0].dispose();
    expect(skins.object.children).toEqual([]);
    expect(freed).toBe(0);
    views[1].dispose();
    expect(freed).toBe(1);
  });

  it.each([50, 1000])('%i equal skins come and go in one batch', (count) => {
    const many = Array.from({ length: count }, (_, i) => at(`c${i}`, (i % 7) - 3, -Math.floor(i / 7) / 4));
    const { skins, views, drawn } = shown(many);
    skins.aim(seen());
    expect(drawn()).toHaveLength(1);
    expect(new Set(drawn()[0]).size).toBe(count);
    for (const view of views.slice(10)) view.dispose();
    skins.aim(seen());
    expect(drawn()[0].toSorted((a, b) => a - b)).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
  });

  it('a skin far from the origin is placed in doubles, before the GPU’s floats', () => {
    const far = 1e7;
    const { skins, batches } = shown([at('far', far + 0.125, 0)]);
    const camera = seen();
    camera.position.x = far;
    camera.updateMatrixWorld();
    skins.aim(camera);
    const [batch] = batches();
    const toView = 4 * placedOf(batch.geometry).getX(0);
    const rows = [...(skins.placements.texture.image.data ?? [])].slice(toView, toView + 12);
    expect(rows).toEqual([1, 0, 0, 0.125, 0, 1, 0, 0, 0, 0, 1, -10]);
  });
});

function attached(weight: number) {
  return {
    start: Uint32Array.of(0, 1, 2, 3),
    joints: new Uint32Array(3),
    weights: new Float64Array(3).fill(weight),
  };
}
